"""Visitors do not affect each other: pages on one server are opened, closed and collected in any order, one floods
the server, and an error is told only to the visitor whom it concerns."""

import asyncio
import gc
import html
import json
import sys
import types
from queue import Queue

import panel as pn
import pytest
import visitors
from inside import inside
from panel.viewable import Viewable
from serving import until
from wire import run

from app.page.session import Session
from app.text import say
from app.widgets.download import Download
from app.widgets.drawing import Drawing

pytestmark = pytest.mark.served

# What is opened, and something of it.
PARTS = (
    ("share", "", "share.panel.of_rolling"), ("panel", "time", "planes.keys.ledger"),
    ("room", "build-a-top", "build.bench.save"), ("room", "families", "family.map.start"),
    ("room", "learn", "learn.view.watch"),
)  # fmt: skip
PATIENCE = 300  # s


@pytest.fixture(scope="module")
def here():
    gc.freeze()  # objects of other tests, which each collection would traverse again
    with inside() as here:
        yield here
    gc.unfreeze()


@pytest.fixture
def idle(monkeypatch):
    """Pages that compute nothing slow."""
    monkeypatch.setattr("app.tabs.families.compare.share_map", lambda *asked: iter(()))


# --- in whichever order

ORDERS = ("+0 +1 -1 +2 -2", "+0 +1 +2 -0 -1")
"""Three pages are opened (+), and two of them closed: the oldest stays, or the youngest."""


async def opens(page, language, part):
    """Shows one of PARTS, which it has not shown yet, in this language."""
    other = "en" if language == "de" else "de"
    known, (kind, name, key) = page.visitor.models, part
    before = set(known)
    if kind == "panel":
        await page.set(page.visitor.choice("which"), "value", name)
    else:
        await page.head(kind, name)

    def said():
        return json.dumps([model for id, model in known.items() if id not in before], ensure_ascii=False)

    await page.until(lambda: say(key, language) in said())
    assert say(key, other) not in said()


async def come_and_go(here, order, parts):
    [stays] = {"0", "1", "2"} - {event[1] for event in order if event[0] == "-"}
    there = {}
    for what, page in order:
        if what == "+":
            mine = page == stays
            there[page] = await visitors.come(here.url + ("" if mine else "?tab=lab"), "de" if mine else "en")
        else:
            await there.pop(page).vanish()
        await asyncio.to_thread(here.wait_for_sessions, len(there))
        gc.collect()
    for part in parts:
        await opens(there[stays], "de", part)
    await there[stays].vanish()
    await asyncio.to_thread(here.wait_for_sessions, 0)


@pytest.mark.parametrize("turn", range(len(ORDERS)), ids=ORDERS)
def test_who_stays_keeps_his_page_in_whichever_order_the_others_come_and_go(here, idle, turn):
    """Shows every part of the page, after one order or another."""
    parts = PARTS[turn :: len(ORDERS)]
    run(come_and_go(here, ORDERS[turn].split(), parts), PATIENCE)


# --- what is given back


def stands(page, room):
    """The text that stands in the place of a room; "made" if it is the room itself."""
    return html.unescape("".join(str(page.now(id, "text", "made")) for id in page.stands(room)))


async def come_back(here):
    page = await visitors.come(here.url)
    for _ in range(2):
        await page.head("room", "build-a-top")
        await page.until(lambda: stands(page, "build-a-top") == "made")
        await page.head("room", "lab")
        await page.until(lambda: stands(page, "build-a-top") != "made")
    await page.vanish()
    await asyncio.to_thread(here.wait_for_sessions, 0)


def test_a_room_that_was_left_long_ago_gives_its_parts_back_and_comes_again(here, idle, monkeypatch):
    monkeypatch.setattr("app.widgets.rooms.AWAY", 0.5)
    run(come_back(here), PATIENCE)


# --- what fails


def broken(*_, **__):
    raise RuntimeError("broken by the test")


async def fails(page, monkeypatch, part, act):
    """With this part of the server broken, act() gives the sentence that it could not be done."""
    [failure] = page.visitor.find("Failure")
    before = page.now(failure, "times", 0)
    with monkeypatch.context() as now:
        now.setattr(part, broken)
        await act()
        await page.until(lambda: page.now(failure, "times", 0) == before + 1)


async def saves(page, filename):
    """The button that saves the file of this name."""

    def found():
        return [each for each in page.visitor.find("Download") if page.now(each, "filename") == filename]

    await page.until(found)
    return found()[0]


async def ask_of_a_broken_server(here, monkeypatch):
    page = await visitors.come(here.url, "de")
    await fails(page, monkeypatch, "app.widgets.codes.segno.make", lambda: page.head("share"))
    await page.head("share")  # and can be requested again
    table = await saves(page, "tippe-top-motion.csv")
    await fails(page, monkeypatch, "app.share.export.columns", lambda: page.set(table, "clicks", 1))
    await page.set(table, "clicks", 2)
    await page.until(lambda: page.now(table, "file", [0])[0] == 1)
    before = page.now(table, "file")[1]
    await page.set(table, "clicks", 3)  # the same file again
    await page.until(lambda: page.now(table, "file")[:2] == [2, before])

    dial = page.visitor.group("K_J")
    await fails(
        page,
        monkeypatch,
        "app.model.explorer.Explorer._solve",
        lambda: page.set(dial, "request", [1, "K_J", 5.5, False]),
    )
    await page.set(dial, "request", [2, "K_J", 5.6, False])
    await page.until(
        lambda: (told := json.loads(page.now(dial, "state")))["answered"] == 2 and told["values"]["K_J"] == 5.6
    )

    await page.head("room", "families")
    says = say("family.map.start", "de")
    await page.until(lambda: any(page.now(each, "label") == says for each in page.visitor.find("Button", "label")))
    start = page.labelled("Button", says)
    await fails(page, monkeypatch, "app.tabs.families.compare.share_map", lambda: page.click(start))
    await page.click(start)
    await page.vanish()
    await asyncio.to_thread(here.wait_for_sessions, 0)


def test_what_fails_is_told_to_whom_it_failed_and_can_be_asked_for_again(here, idle, monkeypatch):
    run(ask_of_a_broken_server(here, monkeypatch), PATIENCE)


def once(monkeypatch, owner, name, where=lambda *arguments, **named: True):
    """The first call of a method with these arguments fails; gives a list that is empty once it has."""
    real, left = getattr(owner, name), [name]

    def fails(*arguments, **named):
        if left and where(*arguments, **named):
            left.clear()
            raise RuntimeError("broken by the test")
        return real(*arguments, **named)

    monkeypatch.setattr(owner, name, fails)
    return left


def is_map(part, *_, **__):
    return isinstance(part, Drawing)  # the only one of Families


def has_map(part, root=None, changed=None, *_, **__):
    """Whether the figure of the map is in a part of the page, or in what has changed of it."""
    return any(map(is_map, (changed or part).select()))


async def open_a_room_that_fails(here, monkeypatch):
    """Where it is made, where Panel's hooks see it, and where Panel makes its models; each time another room opens."""
    # a page keeps the methods that it finds when it comes
    failures = [once(monkeypatch, Session, "families"), once(monkeypatch, Viewable, "_preprocess", has_map),
                once(monkeypatch, Drawing, "_get_model")]  # fmt: skip
    page = await visitors.come(here.url + "?tab=lab")

    def sheets():
        return {page.now(id, "url") for id in page.visitor.find("ImportedStyleSheet")}

    before = sheets()
    for left in (2, 1, 0):
        await page.head("room", "families")
        await page.until(lambda left=left: sum(map(len, failures)) == left
                         and say("main.making.failed") in stands(page, "families"))  # fmt: skip
        await page.head("room", "build-a-top")  # another tab, after that
        await page.until(lambda: stands(page, "build-a-top") == "made")
    await page.head("room", "families")
    await page.until(lambda: stands(page, "families") == "made")
    assert any(page.now(each, "label") == say("family.map.start") for each in page.visitor.find("Button", "label"))
    assert before <= sheets() and not any("cdn" in url for url in sheets())
    await page.vanish()
    await asyncio.to_thread(here.wait_for_sessions, 0)


def test_a_room_that_cannot_be_made_says_so_costs_nothing_and_can_be_opened_again(here, idle, monkeypatch):
    run(open_a_room_that_fails(here, monkeypatch), PATIENCE)


# --- who floods


async def flood(here, monkeypatch):
    """One visitor requests 300 files, another one file: his is the next but one; none is created for a visitor who has
    left."""
    made, go = [], Queue()

    def draw(scene, name, kind):
        made.append((scene.constants.K_J, name))
        go.get(timeout=PATIENCE)
        return b"figure"

    def clicked(download, event):
        click(download, event)
        heard.append((download._requested[1][0].constants.K_J, event.new))

    click, heard = Download._clicked, []
    monkeypatch.setattr(Download, "_clicked", clicked)
    monkeypatch.setattr("app.share.panel.draw", draw)
    pages = {}
    for who, K_J in (("flood", 5.5), ("other", 6.5)):
        pages[who] = page = await visitors.come(f"{here.url}?KJ={K_J}")
        await page.head("share")
    flooder, other = pages["flood"], pages["other"]
    figures = [await saves(flooder, f"tippe-top-{name}.png") for name in ("plane", "surface", "phase")]
    for clicks in range(1, 101):
        for figure in figures:
            await flooder.visitor.set(figure, "clicks", clicks)
    await flooder.set(figures[0], "clicks", 101)
    wanted = await saves(other, "tippe-top-plane.png")
    await other.set(wanted, "clicks", 1)
    await other.set(wanted, "clicks", 2)
    await asyncio.to_thread(until, lambda: (6.5, 2) in heard)  # clicks are collected for a moment
    await other.until(lambda: other.now(wanted, "making"))
    go.put(None)
    go.put(None)
    await other.until(lambda: other.now(wanted, "file", [0])[0] == 1)
    await asyncio.to_thread(until, lambda: len(made) == 3)
    assert [K_J for K_J, _ in made] == [5.5, 6.5, 5.5]
    await flooder.vanish()
    await asyncio.to_thread(here.wait_for_sessions, 1)
    go.put(None)
    await other.set(wanted, "clicks", 3)
    go.put(None)
    await other.until(lambda: other.now(wanted, "file", [0])[0] == 2)
    assert [K_J for K_J, _ in made] == [5.5, 6.5, 5.5, 6.5]  # the third request of the flood is not started
    await other.vanish()
    await asyncio.to_thread(here.wait_for_sessions, 0)


def test_who_floods_is_one_of_those_who_wait_and_who_left_is_none(here, idle, monkeypatch):
    run(flood(here, monkeypatch), PATIENCE)


# --- globals


def globals_of_ours():
    """{where: identity} of every name of our modules and every attribute of their classes, with the length of lists,
    dicts and sets. Weak collections of documents are for sessions, and do not count."""
    found = {}
    for name, module in tuple(sys.modules.items()):
        if name.split(".")[0] in ("app", "tippe_core") and isinstance(module, types.ModuleType):
            classes = [each for each in vars(module).values() if isinstance(each, type) and each.__module__ == name]
            for owner in (module, *classes):
                for key, value in tuple(vars(owner).items()):
                    if key != "__builtins__" and not key.startswith("_param__") and not key.startswith("_abc"):
                        size = len(value) if isinstance(value, (list, dict, set)) else None
                        found[f"{name} {getattr(owner, '__name__', '')}.{key}"] = (id(value), size)
    return found


async def live(here):
    page = await visitors.come(here.url, "de")
    await page.head("share")
    await page.until(lambda: page.visitor.find("Photo"))
    await page.vanish()
    await asyncio.to_thread(here.wait_for_sessions, 0)


def test_no_session_writes_a_global(here, idle):
    run(live(here), PATIENCE)  # what is created at first use exists now
    before, handler = globals_of_ours(), pn.config.exception_handler
    run(live(here), PATIENCE)
    after = globals_of_ours()
    assert {where for where in {*before, *after} if before.get(where) != after.get(where)} == set()
    assert pn.config.exception_handler is handler
