"""Several visitors of Maps on one server: a visitor who waits sees his place, one who leaves costs nothing more, and
a map drawn for one visitor is there for the next."""

import asyncio
import hashlib
from itertools import count
from queue import Queue

import pytest
import visitors
from inside import inside
from serving import until
from wire import run as run_async

from app.model import pool
from app.model.maps import kept
from app.model.maps.maps import Map
from app.model.maps.solving import solve
from app.model.runs import MAPS
from app.state.map_text import MapText
from app.tabs.maps.steady import Steady
from app.text import say

pytestmark = pytest.mark.served

PATIENCE = 300  # s
LEFT, DRAWN = Map(cells=9, seconds=0.4), Map(cells=9, seconds=0.5)
WHOLE = 9 * 9


@pytest.fixture
def drawing(monkeypatch, tmp_path):
    """Maps are computed piece by piece, whenever go() is called, and stored in a folder of the test. seen: (seconds of
    the map, number of finished cells) after each piece."""
    seen, gate = [], Queue()

    def in_pieces(asked, look):
        for level in solve(asked, look):
            seen.append((asked.seconds, int((level.end != "").sum())))
            gate.get(timeout=PATIENCE)
            yield level

    def file(asked):
        return tmp_path / "maps" / f"{hashlib.sha256(repr(asked).encode()).hexdigest()}.npz"

    monkeypatch.setattr("app.tabs.maps.maps.solve", in_pieces)
    monkeypatch.setattr(kept, "_path", file)
    monkeypatch.setattr(Steady, "show", lambda *given: None)
    monkeypatch.setattr(pool, "SAY", 0.01)
    kept._memory.clear()
    yield seen, lambda: gate.put(None)
    kept._memory.clear()


class Others:
    """Visitors who keep the threads of MAPS busy until they are told to leave."""

    def __init__(self):
        self._gate, self._held, self._names = Queue(), 0, count()

    def hold(self):
        """Waits until no thread is free."""
        while MAPS._working.total() < MAPS.threads:
            self._held += 1
            busy = MAPS._working.total()
            MAPS.add(f"other {next(self._names)}", lambda: self._gate.get(timeout=PATIENCE))
            until(lambda busy=busy: MAPS._working.total() > busy)

    def free(self):
        """One thread."""
        self._held -= 1
        self._gate.put(None)


@pytest.fixture
def others():
    found = Others()
    found.hold()
    yield found
    while found._held:
        found.free()
    until(lambda: not MAPS._working)


async def come(here, asked, language):
    return await visitors.come(f"{here.url}?v=1&tab=maps&map={MapText.text(asked)}", language)


async def waits(page, language, place):
    [failure] = page.visitor.find("Failure")
    await page.until(
        lambda: page.now(failure, "waits") == (say("main.queue.waits", language, count=place) if place else "")
    )


async def stands(page, language):
    """The whole map, because the sentences about its worst run need all of it."""
    begins = say("maps.worst", language, energy="|", drift="").split("|")[0]
    await page.until(lambda: begins in page.visitor.says)


async def draw_at_once(here, drawing, others):
    seen, go = drawing
    english = await come(here, LEFT, "en")
    await waits(english, "en", 1)
    german = await come(here, DRAWN, "de")
    await waits(german, "de", 2)
    others.free()
    await asyncio.to_thread(until, lambda: seen)
    await waits(english, "en", 0)
    await waits(german, "de", 1)
    await english.leave()  # while its map is drawn; the other thread still works for others
    await asyncio.to_thread(here.wait_for_sessions, 1)
    for _ in range(2 * WHOLE):
        go()
    await waits(german, "de", 0)
    await stands(german, "de")
    drawn = [cells for seconds, cells in seen if seconds == DRAWN.seconds]
    left = [cells for seconds, cells in seen if seconds == LEFT.seconds]
    assert drawn[-1] == WHOLE and len(left) == 1 and left[0] < WHOLE
    await german.leave()
    await asyncio.to_thread(here.wait_for_sessions, 0)


async def ask_for_it_again(here, drawing):
    seen, _ = drawing
    pieces = len(seen)
    kept._memory.clear()  # so that only the file has it
    later = await come(here, DRAWN, "en")
    await stands(later, "en")
    assert len(seen) == pieces and MAPS._working.total() == MAPS.threads
    await later.leave()


def test_two_draw_at_once_one_leaves_and_a_third_finds_what_is_drawn(drawing, others):
    """The third waits for nobody: no thread is free."""
    with inside() as here:
        run_async(draw_at_once(here, drawing, others), PATIENCE)
        others.hold()
        run_async(ask_for_it_again(here, drawing), PATIENCE)
