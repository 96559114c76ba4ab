"""Votes of a class, in a file and in a Redis: one for each phone, the same for all workers, limited, and deleted in
time."""

import json
import os
import sqlite3
import stat
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from serving import redis_serving
from visiting import free_port

from app.model.votes import ballots, classroom
from app.model.votes import desk as desks
from app.model.votes.ballots import Away, Sqlite, store, usual
from app.model.votes.classroom import BETWEEN, LASTS, MOST_VOTES, ROOMS_OF_ADDRESS, USED, Refused, Room, Rooms

CHOICE = {"step": "flips", "asks": {"options": ["over", "between"]}, "top": {"a": ".07"}}
GUESS = CHOICE | {"asks": {"low": 0.0, "high": 10.0, "step": 0.1, "unit": "%"}}
HERE = "192.0.2.7"


class Clock:
    now = 1e9

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture(params=["a file", "a Redis"])
def place(request, tmp_path):
    """The store that both workers use."""
    if request.param == "a file":
        return str(tmp_path / "new" / "votes.sqlite")
    url = request.getfixturevalue("redis")
    import redis

    redis.Redis.from_url(url).flushall()
    return url


@pytest.fixture
def workers(place, clock):
    """Two workers of one server, each with its own store object, as in separate processes."""
    return [Rooms(store(place, LASTS), clock=clock) for _ in range(2)]


def refused(call, *args, **named):
    with pytest.raises(Refused) as caught:
        call(*args, **named)
    return str(caught.value)


def tally(rooms, code):
    return sorted(Room.of(code, rooms.look([code])[code]).votes)


def test_a_room_opened_at_one_worker_is_voted_in_at_the_other(workers):
    one, other = workers
    room, key = one.open(HERE, **CHOICE)
    assert other.ballot(room.code, "phone") == (replace(room, phones=1), None)
    other.vote(room.code, "phone", HERE, "over")
    one.vote(room.code, "another", HERE, "between")
    assert tally(one, room.code) == tally(other, room.code) == ["between", "over"]
    again = other.owned(key)
    assert (again.step, again.asks, again.top) == tuple(CHOICE.values()) and len(again.votes) == 2


def test_a_phone_has_one_vote_at_whichever_worker_and_may_change_it(workers, clock):
    one, other = workers
    code = one.open(HERE, **CHOICE)[0].code
    one.vote(code, "phone", HERE, "over")
    assert refused(other.vote, code, "phone", HERE, "between") == "fast"
    clock.now += BETWEEN
    other.vote(code, "phone", "198.51.100.1", "between")
    assert tally(one, code) == ["between"]
    assert one.ballot(code, "phone")[1] == "between" and one.ballot(code, "another")[1] is None


OTHER = {"step": "way", "asks": {"options": ["same", "other"]}, "top": {"a": ".07"}}


def test_looking_again_soon_writes_nothing(tmp_path, clock, monkeypatch):
    rooms, written = Rooms(Sqlite(tmp_path / "votes.sqlite"), clock=clock), []
    _, key = rooms.open(HERE, **CHOICE)
    monkeypatch.setattr(rooms._store, "change", lambda place, how: written.append(place))
    for later, changes in ((USED / 2, 0), (USED, 2)):  # of the room, and of the register
        clock.now += later
        rooms.owned(key)
        assert len(written) == changes


def test_a_file_that_is_busy_for_a_moment_is_waited_for(tmp_path, monkeypatch):
    once = iter([sqlite3.OperationalError("database is locked")])

    def execute(text):
        for error in once:
            raise error

    monkeypatch.setattr(sqlite3, "connect", lambda *_, **__: SimpleNamespace(execute=execute))
    Sqlite(tmp_path / "votes.sqlite")._open()
    assert next(once, None) is None  # it was raised


def test_a_class_goes_from_question_to_question_and_back(workers, clock):
    """The votes of each question are kept; none is accepted once the answer is shown; another class starts without
    votes."""
    one, other = workers
    room, key = one.open(HERE, **CHOICE)
    for phone, answer in (("a", "over"), ("b", "between")):
        other.ballot(room.code, phone, HERE)
        other.vote(room.code, phone, HERE, answer, "flips")
    other.ballot(room.code, "c", HERE)
    assert not one.owned(key).shown and one.owned(key).phones == 3
    assert one.reveal(key).shown and refused(other.vote, room.code, "c", HERE, "over") == "shown"
    asked = one.ask(key, **OTHER)
    assert (asked.step, asked.shown, asked.votes, asked.phones) == ("way", False, (), 3)
    assert other.ballot(room.code, "a")[1] is None
    assert refused(other.vote, room.code, "a", HERE, "over", "flips") == "moved"
    other.vote(room.code, "a", HERE, "other", "way")
    back = one.ask(key, **CHOICE)
    assert sorted(back.votes) == ["between", "over"] and other.ballot(room.code, "a")[1] == "over"
    assert one.ask(key, **CHOICE).votes == back.votes  # this question is already open
    assert one.ask(key, **OTHER).votes == ("other",)
    fresh = one.reset(key)
    assert (fresh.votes, fresh.phones, fresh.shown, fresh.step) == ((), 0, False, "way")
    assert one.ask(key, **CHOICE).votes == ()
    for call in (one.reveal, one.reset, one.ask):
        assert refused(call, f"{room.code}.{'x' * 22}", **(OTHER if call == one.ask else {})) == "over"


def test_phones_that_only_look_are_bounded(place, clock):
    rooms = Rooms(store(place, LASTS), votes_of_address=3, clock=clock)
    code = rooms.open(HERE, **CHOICE)[0].code
    for phone in range(5):
        rooms.ballot(code, str(phone), HERE)
        rooms.ballot(code, str(phone), HERE)
    assert rooms.ballot(code, "0")[0].phones == 3


def test_a_phone_hears_of_a_question_at_once_and_of_votes_now_and_then(monkeypatch):
    """The phones in a lecture hall are not told of each single vote."""
    heard, now = [], [100.0]
    monkeypatch.setattr(desks.time, "monotonic", lambda: now[0])
    watch = desks.Watch("ABCDEF", heard.append, votes=False)

    def text(step, votes, shown=False):
        record = {"step": step, "asks": {}, "top": {}, "shown": shown, "phones": {}}
        return json.dumps(record | {"votes": {str(i): ["over", "", 0.0] for i in range(votes)}})

    for at, what in ((0, text("a", 1)), (0.5, text("a", 2)), (1.0, text("a", 3)), (1.1, text("b", 0)),
                     (1.2, text("b", 0, True)), (1.3, text("b", 1, True)), (4.0, text("b", 1, True)),
                     (4.1, None)):  # fmt: skip
        now[0] = 100.0 + at
        watch.tell(what)
    assert [room and (room.step, len(room.votes), room.shown) for room in heard] == [
        ("a", 1, False), ("b", 0, False), ("b", 0, True), ("b", 1, True), None]  # fmt: skip


def test_only_answers_count(workers):
    rooms = workers[0]
    choice, guess = (rooms.open(HERE, **question)[0].code for question in (CHOICE, GUESS))
    for code, value in ((choice, "<script>"), (choice, 3.0), (choice, []), (guess, "over"), (guess, 11.0),
                        (guess, float("nan")), (guess, 10**400), (guess, True), (guess, None)):  # fmt: skip
        assert refused(rooms.vote, code, "phone", HERE, value) == "wrong"
    for code in ("ABCDEF", "", classroom.REGISTER, "ABC\ud800EF", "ABCDEFG"):
        assert refused(rooms.vote, code, "phone", HERE, "over") == "gone"
        assert rooms.ballot(code, "phone") == (None, None)
    rooms.vote(guess, "phone", HERE, 10.0)
    assert tally(rooms, guess) == [10.0] and tally(rooms, choice) == []


def test_one_address_has_so_many_votes_and_the_room_so_many(place, clock):
    rooms = Rooms(store(place, LASTS), votes_of_address=3, clock=clock)
    code = rooms.open(HERE, **CHOICE)[0].code
    for phone in range(3):  # one household: its provider assigns the first half of the address
        rooms.vote(code, str(phone), f"2001:db8:1:2:{phone}::9", "over")
    assert refused(rooms.vote, code, "who forgets who he was", "2001:db8:1:2:ffff::1", "over") == "crowded"
    clock.now += BETWEEN
    rooms.vote(code, "1", "2001:db8:1:2::7", "between")  # a phone that has voted may still change its vote
    for phone in range(3, MOST_VOTES):
        rooms.vote(code, str(phone), f"10.0.{phone // 100}.{phone % 100}", "over")
    assert refused(rooms.vote, code, "one too many", "10.9.9.9", "over") == "full"
    assert len(tally(rooms, code)) == MOST_VOTES


def test_a_school_behind_one_address_can_vote(workers):
    code = workers[0].open(HERE, **CHOICE)[0].code
    for phone in range(120):
        workers[phone % 2].vote(code, str(phone), HERE, "over")
    assert len(tally(workers[0], code)) == 120


def test_rooms_are_bounded_by_address_and_in_all(workers, monkeypatch):
    one, other = workers
    keys = [workers[i % 2].open(HERE, **CHOICE)[1] for i in range(ROOMS_OF_ADDRESS)]
    assert refused(one.open, HERE, **CHOICE) == refused(other.open, HERE, **CHOICE) == "crowded"
    other.close(keys[0])
    one.open(HERE, **CHOICE)
    monkeypatch.setattr(classroom, "MOST_ROOMS", ROOMS_OF_ADDRESS + 1)
    one.open("192.0.2.200", **CHOICE)
    assert refused(other.open, "192.0.2.201", **CHOICE) == "full"


def test_only_its_key_opens_and_closes_a_room(workers):
    one, other = workers
    room, key = one.open(HERE, **CHOICE)
    stolen = f"{room.code}.{one.open(HERE, **CHOICE)[1].split('.')[1]}"
    assert refused(other.owned, stolen) == "over"
    other.close(stolen)
    one.vote(room.code, "phone", HERE, "over")
    assert other.owned(key).votes == ("over",)
    other.close(key)
    other.close(key)
    assert refused(one.owned, key) == "over" and one.look([room.code]) == {}
    assert one.ballot(room.code, "phone") == (None, None)
    assert refused(one.vote, room.code, "phone", HERE, "over") == "gone"


def test_a_room_lives_six_hours_after_its_last_use(workers, clock):
    one, other = workers
    (voted, key), (looked_at, _), (left, left_key) = (one.open(HERE, **CHOICE) for _ in range(3))
    for _ in range(4):
        clock.now += LASTS - USED
        one.vote(voted.code, "phone", HERE, "over")
        other.use(looked_at.code)
        one = Rooms(one._store, clock=clock)  # a restarted worker still knows the room
    assert refused(other.owned, left_key) == "over" and other.ballot(left.code, "phone") == (None, None)
    assert one.look([left.code])
    one.open(HERE, **CHOICE)  # this deletes expired rooms
    assert set(other.look([voted.code, looked_at.code, left.code])) == {voted.code, looked_at.code}
    clock.now += LASTS + 1
    assert refused(one.owned, key) == "over" and refused(one.vote, voted.code, "p", HERE, "over") == "gone"


def test_what_is_kept_tells_no_names(workers):
    rooms = workers[0]
    room, key = rooms.open(HERE, **CHOICE)
    rooms.vote(room.code, "the phone", HERE, "over")
    kept = rooms._store.read([room.code, classroom.REGISTER])
    assert len(kept) == 2
    for text in kept.values():
        assert HERE not in text and "the phone" not in text and key.split(".")[1] not in text


def test_workers_that_count_at_once_lose_nothing(place):
    first = Rooms(store(place, LASTS))
    code, each = first.open(HERE, **CHOICE)[0].code, 40

    def worker(number):
        rooms = Rooms(store(place, LASTS))
        for phone in range(each):
            rooms.vote(code, f"{number} {phone}", HERE, "over")

    with ThreadPoolExecutor(4) as threads:
        list(threads.map(worker, range(4)))
    assert len(tally(first, code)) == 4 * each


def test_a_new_file_is_opened_by_many_at_once(tmp_path):
    for attempt in range(10):
        path = tmp_path / str(attempt)
        with ThreadPoolExecutor(4) as threads:
            list(threads.map(lambda key, path=path: Sqlite(path).change(str(key), str), range(4)))
        assert len(Sqlite(path).read(map(str, range(4)))) == 4


@pytest.mark.skipif(os.name == "nt", reason="files have no such permissions there")
def test_the_file_is_its_users_alone(tmp_path):
    path = tmp_path / "state" / "votes.sqlite"
    kept = Sqlite(path)
    kept.change("key", lambda text: "text")
    modes = {each.name: stat.S_IMODE(each.stat().st_mode) for each in path.parent.iterdir()}
    assert modes == dict.fromkeys(("votes.sqlite", "votes.sqlite-wal", "votes.sqlite-shm"), 0o600)
    assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700


def test_a_file_that_cannot_be_is_said_and_one_that_comes_back_is_taken(tmp_path):
    blocked = tmp_path / "a file"
    blocked.write_text("in the way")
    rooms = Rooms(Sqlite(blocked / "votes.sqlite"))
    with pytest.raises(Away):
        rooms.open(HERE, **CHOICE)
    blocked.unlink()
    room, _ = rooms.open(HERE, **CHOICE)
    for each in blocked.iterdir():  # removed while a server uses it
        each.unlink()
    assert refused(rooms.vote, room.code, "phone", HERE, "over") == "gone"
    other = tmp_path / "of another kind"
    other.write_text("no database " * 100)
    with pytest.raises(Away):
        Rooms(Sqlite(other)).look([room.code])
    assert other.read_text() == "no database " * 100


@pytest.mark.slow
def test_a_file_that_another_holds_is_not_waited_for_for_ever(tmp_path):
    one, other = (Sqlite(tmp_path / "votes") for _ in range(2))
    one.change("key", lambda text: "before")

    def meanwhile(text):
        with pytest.raises(Away):
            other.change("key", lambda text: "stolen")
        assert other.read(["key"]) == {"key": "before"}  # but reading does not wait
        return "after"

    one.change("key", meanwhile)
    assert other.read(["key"]) == {"key": "after"}


def test_a_redis_that_is_not_there_is_said_and_one_that_comes_back_is_taken(redis):
    port = free_port()
    rooms = Rooms(store(f"redis://127.0.0.1:{port}/0", LASTS))
    with pytest.raises(Away):
        rooms.open(HERE, **CHOICE)
    for _ in range(2):  # it starts, stops, and starts again
        with redis_serving(port):
            code = rooms.open(HERE, **CHOICE)[0].code
            rooms.vote(code, "phone", HERE, "over")
            assert tally(rooms, code) == ["over"]
        with pytest.raises(Away):
            rooms.look([code])


def test_a_redis_forgets_by_itself(redis):
    kept = store(redis, 4000)
    kept.change("key", lambda text: "text")
    assert 3990 < kept._client.ttl("tippe:key") <= 4000


@pytest.mark.parametrize("where, says", [
    ("http://example.org", "the URL of a Redis"), ("redis://host:port", "the URL of a Redis"),
    ("redis://host/0?wrong=1", "the URL of a Redis"),
])  # fmt: skip
def test_a_place_that_cannot_be_is_a_sentence(where, says):
    with pytest.raises(ValueError, match=says):
        store(where, 1)


def test_without_the_package_a_redis_is_refused(monkeypatch):
    monkeypatch.setattr(ballots.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(ValueError, match="pip install 'redis"):
        store("redis://localhost", 1)


@pytest.mark.skipif(os.name == "nt", reason="another place there")
def test_the_usual_file_is_the_same_after_another_start_and_this_users_own(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    assert usual() == usual() == tmp_path / "state" / ballots.FOLDER / "votes.sqlite"
    assert not (tmp_path / "state").exists()  # nothing is created if nobody votes
    # if the home cannot be written to: among the temporary files, unless somebody else owns that folder
    monkeypatch.setattr(ballots.os, "access", lambda path, mode: False)
    monkeypatch.setattr(ballots.tempfile, "tempdir", str(tmp_path))
    ours = tmp_path / f"{ballots.FOLDER}-{os.getuid()}"
    assert usual() == usual() == ours / "votes.sqlite" and stat.S_IMODE(ours.stat().st_mode) == 0o700
    ours.chmod(0o777)
    assert usual().parent not in (ours, Path(tmp_path))
    ours.rmdir()
    ours.symlink_to(tmp_path)
    assert usual().parent not in (ours, Path(tmp_path))
