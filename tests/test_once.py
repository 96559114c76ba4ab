"""What all pages share is computed once, whoever asks first."""

import threading

import pytest

from app.model import once
from app.model.once import Once
from app.model.runs import Run, Stopped


class Asking:
    """A Run of another page, in a thread of its own, that asks for the answer to `asked`."""

    def __init__(self, answers, asked, work):
        self.waits, self.run = threading.Event(), Run(lambda run: answers.find(run.wait, asked, work), print)
        wait = self.run.wait
        self.run.wait = lambda seconds: (self.waits.set(), wait(seconds))
        self._thread = threading.Thread(target=lambda: setattr(self, "found", self.run.result()), daemon=True)
        self._thread.start()

    def answer(self):
        self._thread.join()
        return self.found


@pytest.fixture
def asked(monkeypatch):
    """asked() gives an Asking whose work waits for go, and returns how often any has begun."""
    monkeypatch.setattr(once, "OTHERS", 0.001)
    answers, begun, go = Once(2), [], threading.Event()

    def ask(name="a", ends=lambda: None):
        def work():
            begun.append(name)
            go.wait()
            ends()
            return name, len(begun)

        return Asking(answers, name, work)

    ask.answers, ask.go = answers, go
    yield ask
    go.set()


def test_who_asks_for_the_same_waits_and_gets_the_same(asked):
    first, second = asked(), asked()
    while not (first.waits.is_set() or second.waits.is_set()):
        first._thread.join(0.001)
    asked.go.set()
    assert first.answer() == second.answer() == asked().answer() == ("a", 1)


def test_if_the_one_that_computes_ends_another_computes(asked):
    def ends():
        raise Stopped

    first = asked(ends=ends)
    while not asked.answers._claimed:
        first._thread.join(0.001)
    second = asked()
    second.waits.wait()
    asked.go.set()
    assert isinstance(first.answer(), Stopped) and second.answer() == ("a", 2)


def test_the_newest_stay_and_who_leaves_waits_no_longer(asked):
    asked.go.set()
    for name in "abac":
        asked(name).answer()
    assert "a" in asked.answers and "c" in asked.answers and "b" not in asked.answers
    asked.go.clear()
    first = asked("d")
    while not asked.answers._claimed:
        first._thread.join(0.001)
    second = asked("d")
    second.waits.wait()
    second.run.stop()
    assert isinstance(second.answer(), Stopped)
