"""The one thread that talks to the store of votes: changes are passed on, and a store that hangs blocks nobody."""

import threading

import pytest
from serving import until

from app.model.votes import classroom
from app.model.votes import desk as desks
from app.model.votes.ballots import Away

CHOICE = {"step": "flips", "asks": {"options": ["over", "between"]}, "top": {"a": ".07"}}


HERE = "192.0.2.7"


class Slow:
    """A store in memory that counts reads. While `away` it fails; `gate` can delay it."""

    def __init__(self):
        self.texts, self.reads, self.away, self.gate = {}, 0, False, threading.Event()
        self.gate.set()

    def read(self, keys):
        self.gate.wait()
        if self.away:
            raise Away("nobody answers")
        self.reads += 1
        return {key: self.texts[key] for key in keys if key in self.texts}

    def change(self, key, function):
        self.gate.wait()
        if self.away:
            raise Away("nobody answers")
        text = function(self.texts.get(key))
        self.texts.pop(key, None)
        if text is not None:
            self.texts[key] = text


@pytest.fixture
def slow():
    return Slow()


@pytest.fixture
def desk(slow, monkeypatch):
    monkeypatch.setattr(desks, "store", lambda where, lasts: slow)
    monkeypatch.setattr(desks, "LOOK_EVERY", 0.02)
    monkeypatch.setattr(desks, "PAUSE", 0.1)
    return desks.Desk("")


def asked(desk, work):
    """The result, or the error."""
    found, done = [], threading.Event()
    desk.ask(work, lambda result: (found.append(result), done.set()))
    assert done.wait(20)
    return found[0]


def test_who_looks_is_told_what_is_new_and_250_pages_cost_one_read(desk, slow):
    room, key = asked(desk, lambda rooms: rooms.open(HERE, **CHOICE))
    teacher, students = [], [[] for _ in range(250)]
    desk.watch(room.code, teacher.append)
    ends = [desk.watch(room.code, student.append, votes=False) for student in students]
    until(lambda: len(teacher) == 1)
    before = slow.reads
    until(lambda: slow.reads > before + 5)
    assert len(teacher) == 1  # nothing has changed
    asked(desk, lambda rooms: rooms.vote(room.code, "phone", HERE, "over"))
    until(lambda: len(teacher) == 2)
    assert teacher[-1].votes == ("over",) and max(map(len, students)) <= 2
    ends[0]()
    seen = len(students[0])
    asked(desk, lambda rooms: rooms.close(key))
    until(lambda: all(student[-1] is None for student in students[1:]))
    assert teacher[-1] is None and len(students[0]) == seen
    # this is the total number of reads, not 251 times as many
    assert slow.reads < 2000


def test_a_store_that_hangs_or_goes_keeps_no_page_waiting_and_is_asked_again(desk, slow):
    room, _ = asked(desk, lambda rooms: rooms.open(HERE, **CHOICE))
    teacher = []
    desk.watch(room.code, teacher.append)
    until(lambda: len(teacher) == 1)
    slow.gate.clear()
    answers = []
    for phone in range(20):  # each call returns at once
        desk.ask(lambda rooms, phone=phone: rooms.vote(room.code, str(phone), HERE, "over"), answers.append)
    slow.away = True
    slow.gate.set()
    until(lambda: len(answers) == 20 and len(teacher) == 2)
    assert all(isinstance(answer, Away) for answer in answers) and isinstance(teacher[-1], Away)
    slow.away = False
    until(lambda: len(teacher) == 3)
    assert teacher[-1] == room
    assert asked(desk, lambda rooms: rooms.vote(room.code, "phone", HERE, "over")) is None
    until(lambda: teacher[-1].votes == ("over",))


def test_a_store_that_comes_back_empty_has_lost_the_class_and_nobody_has_closed_it(desk, slow):
    """All of it was lost, or the room alone; then the teacher opens another one, and closes it."""
    room, _ = asked(desk, lambda rooms: rooms.open(HERE, **CHOICE))
    news = [[], []]
    for each, votes in zip(news, (True, False), strict=True):
        desk.watch(room.code, each.append, votes=votes)
    until(lambda: all(news))
    slow.texts.clear()
    until(lambda: all(str(each[-1]) == "lost" for each in news))
    assert all(isinstance(each[-1], classroom.Refused) for each in news)
    second, key = asked(desk, lambda rooms: rooms.open(HERE, **CHOICE))
    seen, held = [], slow.texts[second.code]
    desk.watch(second.code, seen.append)
    until(lambda: seen)
    del slow.texts[second.code]
    until(lambda: str(seen[-1]) == "lost")
    slow.texts[second.code] = held
    until(lambda: isinstance(seen[-1], classroom.Room))
    asked(desk, lambda rooms: rooms.close(key))
    until(lambda: seen[-1] is None)
    assert [len(each) for each in news] == [2, 2]


def test_a_teacher_who_looks_keeps_his_room(desk, slow, monkeypatch):
    for module in (classroom, desks):
        monkeypatch.setattr(module, "USED", 0.0)
    room, _ = asked(desk, lambda rooms: rooms.open(HERE, **CHOICE))
    first = slow.texts[room.code]
    desk.watch(room.code, lambda news: None, votes=False)
    before = slow.reads
    until(lambda: slow.reads > before + 3)
    assert slow.texts[room.code] == first  # an open page on a student's phone does not
    desk.watch(room.code, lambda news: None)
    until(lambda: slow.texts[room.code] != first)
