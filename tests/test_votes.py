"""A vote of a class on running servers: people at several workers and hosts arrive, lose the connection, and return."""

import asyncio
import json
import os
import re
import shutil
import signal
from contextlib import ExitStack
from functools import partial

import pytest
from serving import redis_serving, until
from serving import served as serves
from test_operating import ends, workers_of
from visiting import free_port
from wire import Page, Visitor, get, run

from app.model.votes.ballots import Sqlite
from app.model.votes.classroom import Room
from app.text import say

pytestmark = pytest.mark.served

KEY = re.compile(r"room=([\w.-]+)")
# Nothing is made to wait so that others are not disturbed: test_classroom.py and test_desk.py have that.
SOON = """
from app.model.votes import classroom, desk
classroom.BETWEEN = desk.PHONES_EVERY = 0.0
desk.PAUSE, desk.LOOK_EVERY = 0.2, 0.05
"""
served = partial(serves, code=SOON)


def plain(value):
    """A value in a message as a Python value."""
    if isinstance(value, dict) and value.get("type") == "map":
        return {key: plain(each) for key, each in value.get("entries", [])}
    return [plain(each) for each in value] if isinstance(value, list) else value


def state(page):
    """The state of the lesson on a page; {} if it has none yet."""
    found = page.visitor.find("LessonView", "state")
    return plain(page.visitor.models[found[0]][1]["state"]) if found else {}


def room(page):
    return state(page).get("room") or {}


async def opened(url, language="en"):
    page = Page(await Visitor.enter(url, headers={"Accept-Language": language}))
    await page.visitor.ready()
    return page


async def wishes(page, name, value=""):
    """Sends a request as the screen or a phone does."""
    page.sent = getattr(page, "sent", 0) + 1
    await page.set(page.visitor.find("LessonView")[0], "request", [page.sent, name, value])


async def hears(page, words):
    await page.until(lambda: words in (state(page).get("wording"), room(page).get("wording")))


async def counted(page, count):
    await page.until(lambda: room(page).get("voted") == count)


async def teacher(url, key=""):
    """Opens the big screen, with the key of a room if there is one."""
    page = await opened(f"{url}?tab=learn" + (f"&room={key}" if key else ""))
    await page.until(lambda: page.visitor.find("LessonView", "state"))
    return page


def key_of(page):
    """The key of the room in the teacher's address."""
    found = [KEY.search(str(each.get("search", ""))) for _, each in page.visitor.models.values()]
    return next((each[1] for each in found if each), "")


async def opens(page):
    """(the room's code, the teacher's key)."""
    await wishes(page, "present")
    await page.until(lambda: room(page).get("code") and key_of(page))
    return room(page)["code"], key_of(page)


async def student(url, code, phone, language="en"):
    """A phone that opens the student's link; phone: a digit that identifies it. It sends that before its page is
    complete."""
    page = Page(await Visitor.enter(f"{url}?vote={code}", headers={"Accept-Language": language}))
    for mark in page.visitor.find("Phone", "tags"):
        await page.set(mark, "mark", phone * 32)
    await page.visitor.ready()
    return page


async def comes(page, step="flips"):
    await page.until(lambda: state(page).get("step") == step and room(page).get("question") == step)


async def votes(page, answer):
    """Votes, and waits until the vote is counted."""
    await page.until(lambda: room(page).get("code"))
    await wishes(page, "vote", answer)
    await page.until(lambda: room(page).get("mine") == answer)


def sessions(server):
    return json.loads(get(server.root + "/liveness")[2])["sessions"]


def test_students_at_another_worker_are_counted_and_the_room_outlives_all_workers(tmp_path, monkeypatch):
    """Without any setting: the two workers share the store of the host."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))

    async def lesson(server):
        page = await teacher(server.url)
        code, key = await opens(page)
        students = []
        while len(students) < 3 or not any(0 < sessions(server) <= len(students) for _ in range(8)):
            students.append(await student(server.url, code, f"{len(students):x}"))
            assert len(students) < 16
        for each in students:
            await votes(each, "over")
        await counted(page, len(students))

        before = workers_of(server.process.pid)
        for worker in before:
            os.kill(int(worker), signal.SIGKILL)
        await asyncio.to_thread(until, lambda: server.log.count("serving") == 4, 60)
        page = await teacher(server.url, key)
        await counted(page, len(students))
        await votes(last := await student(server.url, code, "f"), "upright")
        await counted(page, len(students) + 1)
        for each in (page, last):
            await each.leave()  # so that nobody has to be sent elsewhere

    with served(tmp_path / "log", workers=2, votes="") as server:
        run(lesson(server), 240)
        assert "Traceback" not in server.log
        ends(server, signal.SIGTERM)
        assert server.process.returncode == 0 and "stopping" in server.log
    assert (tmp_path / "state" / "tippe-top-explorer" / "votes.sqlite").exists()


async def walks(page, first, second):
    """Goes on to another question, and back to the first, which still has its votes; then another class starts."""
    await wishes(page, "step", "way")
    for phone in (first, second):
        await comes(phone, "way")
        assert room(phone)["mine"] is None
    await votes(second, "other")
    await counted(page, 1)
    await wishes(page, "step", "flips")
    await comes(first)
    await counted(page, 2)
    assert room(first)["mine"] == "over"

    # another class starts
    await wishes(page, "reset")
    await counted(page, 0)
    await first.until(lambda: room(first).get("mine") is None)


async def closes(page, first, second):
    """The teacher closes the class, and both phones, the first of them in German, are told."""
    await wishes(page, "section", "teach")
    label = say("teach.vote.close")
    await page.until(lambda: any(page.now(each, "label") == label for each in page.visitor.find("Button", "label")))
    await page.click(page.labelled("Button", label))
    await hears(first, say("teach.student.closed", "de"))
    await hears(second, say("teach.student.closed"))


def test_two_servers_are_one_class(tmp_path, request):
    """Phones at one worker, the teacher at the other: phones follow from question to question, see no answer before it
    is shown, and no vote but their own. The class continues with the teacher's address, and ends when it is closed. The
    votes are in a Redis, or in a file where there is none."""
    place = request.getfixturevalue("redis") if shutil.which("redis-server") else tmp_path / "votes"

    async def lesson(one, other, end_of_one):
        page = await teacher(one.url)
        code, key = await opens(page)
        first = await student(other.url, code, "1", "de")
        await comes(first)
        await votes(first, "over")
        await counted(page, 1)
        assert room(page)["counts"] == [] and "counts" not in room(first)

        # the teacher loses the connection and the server: his link opens the room at another one
        page.visitor.leave()
        end_of_one()
        page = await teacher(other.url, key)
        await counted(page, 1)
        second = await student(other.url, code, "2")
        await comes(second)
        await votes(second, "upright")
        await counted(page, 2)
        await wishes(page, "reveal")
        await page.until(lambda: dict(room(page)["counts"]) == {"over": 1, "upright": 1, "falls": 0, "unsure": 0})
        for phone in (first, second):
            await phone.until(lambda phone=phone: room(phone).get("shown"))
        await wishes(second, "vote", "falls")
        await hears(second, say("teach.student.shown"))

        await walks(page, first, second)

        # another key belongs to another room
        stranger = await teacher(other.url, f"{code}.{'x' * 22}")
        await hears(stranger, say("teach.vote.over"))

        await closes(page, first, second)
        late = await student(other.url, code, "3")
        await hears(late, say("teach.student.gone"))
        again = await teacher(other.url, key)
        await hears(again, say("teach.vote.over"))

    with ExitStack() as first, served(tmp_path / "other", votes=place) as other:
        one = first.enter_context(served(tmp_path / "one", votes=place))
        run(lesson(one, other, first.close), 240)
        assert "Traceback" not in one.log + other.log


def test_a_phone_votes_once_however_often_it_loads_the_page_and_an_address_is_bounded(tmp_path):
    async def lesson(server):
        page = await teacher(server.url)
        for name in ("reveal", "reset"):  # there is no class yet
            await wishes(page, name)
        code, _ = await opens(page)
        phone = await student(server.url, code, "1")
        await votes(phone, "over")
        for answer in ("upright", "falls"):
            before = room(phone)["mine"]
            await phone.leave()
            phone = await student(server.url, code, "1")
            await phone.until(lambda before=before, phone=phone: room(phone).get("mine") == before)
            await votes(phone, answer)
        await votes(await student(server.url, code, "2"), "falls")
        await counted(page, 2)
        third = await student(server.url, code, "3")
        await comes(third)
        for strange in ("<script>", 3.0):
            await wishes(third, "vote", strange)
            await hears(third, say("teach.student.wrong"))
        await wishes(third, "vote", "over")
        await hears(third, say("teach.student.crowded"))
        assert "a bug" not in server.log
        kept = Sqlite(tmp_path / "votes")
        assert Room.of(code, kept.read([code])[code]).votes == ("falls", "falls")

    with served(tmp_path / "log", votes=tmp_path / "votes", votes_per_address=2) as server:
        run(lesson(server), 120)


def test_a_redis_that_goes_is_a_sentence_for_all_and_after_it_has_come_back_all_goes_on(tmp_path):
    port = free_port()

    async def lesson(server):
        page = await teacher(server.url)
        await wishes(page, "present")
        await hears(page, say("teach.vote.away"))
        first = await student(server.url, "ABCDEF", "1", "de")
        await hears(first, say("teach.student.away", "de"))
        with redis_serving(port):
            while not room(page).get("code"):  # a store that was away is asked only every few seconds
                await wishes(page, "present")
                await asyncio.sleep(0.3)
            code = room(page)["code"]
            await wishes(first, "again")
            await hears(first, say("teach.student.gone", "de"))
            second = await student(server.url, code, "2")
            await comes(second)
            await page.until(lambda: key_of(page))
        await hears(page, say("teach.vote.away"))
        await wishes(second, "vote", "over")
        await hears(second, say("teach.student.away"))
        other = await teacher(server.url, key_of(page))
        await hears(other, say("teach.vote.away"))

    with served(tmp_path / "log", votes=f"redis://127.0.0.1:{port}/0") as server:
        run(lesson(server), 120)
        assert "Traceback" not in server.log and "votes are away" in server.log


@pytest.fixture(autouse=True)
def needs(request):
    if "goes" in request.node.name:
        request.getfixturevalue("redis")  # skips where there is none
