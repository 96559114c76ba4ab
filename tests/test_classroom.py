"""A vote of a class: counted once a page, bounded, forgotten."""

import pytest

from app import lesson
from app.classroom import BETWEEN, BURST, LASTS, MOST_ROOMS, MOST_VOTES, Refused, Rooms

STEP = lesson.STEPS[0]
CHOICE, GUESS = lesson.Choice(("over", "between")), lesson.Guess(0.0, 10.0, 0.1, "%", 0.1, 0.1)


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def rooms(clock):
    return Rooms(clock)


def refused(call, *args):
    with pytest.raises(Refused) as caught:
        call(*args)
    return str(caught.value)


def test_a_page_has_one_vote_and_may_change_it(rooms, clock):
    code = rooms.open(STEP, {}, CHOICE).code
    rooms.vote(code, "page", "over")
    assert refused(rooms.vote, code, "page", "between") == "fast"
    clock.now += BETWEEN
    rooms.vote(code, "page", "between")
    rooms.vote(code, "another", "over")
    assert sorted(rooms.tally(code)) == ["between", "over"]


def test_only_answers_count(rooms):
    choice, guess = (rooms.open(STEP, {}, asks).code for asks in (CHOICE, GUESS))
    for code, value in ((choice, "<script>"), (choice, 3.0), (guess, "over"), (guess, 11.0), (guess, float("nan"))):
        assert refused(rooms.vote, code, "page", value) == "wrong"
    assert refused(rooms.vote, "NOROOM", "page", "over") == "gone"
    rooms.vote(guess, "page", 10.0)
    assert rooms.tally(guess) == [10.0] and rooms.tally(choice) == []


def test_bounds_on_votes_rooms_and_rate(rooms, clock):
    code = rooms.open(STEP, {}, CHOICE).code
    for page in range(BURST):
        rooms.vote(code, page, "over")
    assert refused(rooms.vote, code, "one more at once", "over") == "fast"
    for page in range(BURST, MOST_VOTES):
        clock.now += 1.0
        rooms.vote(code, page, "over")
    clock.now += 1.0
    assert refused(rooms.vote, code, "one too many", "over") == "full"
    rooms.vote(code, 0, "between")
    assert len(rooms.tally(code)) == MOST_VOTES
    for _ in range(MOST_ROOMS - 1):
        rooms.open(STEP, {}, CHOICE)
    assert refused(rooms.open, STEP, {}, CHOICE) == "full"


def test_gone_when_closed_and_after_a_while(rooms, clock):
    first, second = (rooms.open(STEP, {}, CHOICE).code for _ in range(2))
    rooms.close(first)
    assert rooms.room(first) is None and rooms.tally(first) == []
    clock.now += LASTS + 1
    assert rooms.room(second) is None
    assert first != second and len(first) == 6
