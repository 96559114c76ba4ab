"""A class's vote on servers that run: people at several workers and hosts, who come, are cut off, and return."""

import asyncio
import json
import os
import re
import signal
from contextlib import ExitStack

import pytest
from test_server import workers_of
from visiting import free_port
from wire import Page, Visitor, get, redis_serving, run, served, until

from app.model.ballots import Sqlite
from app.model.classroom import Room
from app.text import say

pytestmark = pytest.mark.served

KEY = re.compile(r"tab=learn&learn=teach&room=([\w.-]+)")
CODE = re.compile(r"\?vote=(\w+)")


def plain(words):
    return words.split("{")[0]


def votes_counted(count):
    return say("teach.vote.count", votes=count, most=400)


async def opened(url, language="en"):
    page = Page(await Visitor.enter(url, headers={"Accept-Language": language}))
    await page.visitor.ready()
    return page


async def hears(page, words):
    await page.until(lambda: words in page.visitor.says)


async def shows(page, label):
    """Waits for a button."""
    await page.until(lambda: any(attributes.get("label") == label for _, attributes in page.visitor.models.values()))


async def teacher(url, key=""):
    """At the teacher's page; by the link of a room, if there is one."""
    page = await opened(f"{url}?tab=learn&learn=teach" + (f"&room={key}" if key else ""))
    await shows(page, say("teach.vote.open"))
    return page


async def opens(page):
    """(the room's code, the teacher's key)."""
    await page.visitor.click(say("teach.vote.open"))
    await page.until(lambda: KEY.search(page.visitor.says))
    return CODE.search(page.visitor.says)[1], KEY.search(page.visitor.says)[1]


async def student(url, code, phone, language="en"):
    """A phone at the student's link; phone: a digit, by which it is known. It says so before its page is all there."""
    page = Page(await Visitor.enter(f"{url}?vote={code}", headers={"Accept-Language": language}))
    for mark in page.visitor.find("Phone", "tags"):
        await page.set(mark, "mark", phone * 32)
    await page.visitor.ready()
    return page


async def chooses(page, answer, language="en"):
    await page.until(lambda: page.visitor.find("RadioBoxGroup", "options"))
    await page.set(page.visitor.find("RadioBoxGroup", "options")[0], "value", say(f"learn.options.{answer}", language))


async def votes(page, answer, language="en"):
    """Until it is counted; a phone votes once a second."""
    await chooses(page, answer, language)
    said = [say(f"teach.{key}", language) for key in ("student.sent", "student.fast", "vote.wait")]
    while True:
        await page.visitor.click(say("teach.student.send", language))
        await hears(page, said[2])
        await page.until(lambda: said[2] not in page.visitor.says)
        if said[0] in page.visitor.says:
            return
        assert said[1] in page.visitor.says


def sessions(server):
    return json.loads(get(server.root + "/liveness")[2])["sessions"]


def test_students_at_another_worker_are_counted_and_the_room_outlives_all_workers(tmp_path, monkeypatch):
    """Without any setting; the two workers share what one host has."""
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
        await hears(page, votes_counted(len(students)))

        before = workers_of(server.process.pid)
        for worker in before:
            os.kill(int(worker), signal.SIGKILL)
        await asyncio.to_thread(until, lambda: server.log.count("serving") == 4, 60)
        page = await teacher(server.url, key)
        await hears(page, votes_counted(len(students)))
        await votes(await student(server.url, code, "f"), "upright")
        await hears(page, votes_counted(len(students) + 1))

    with served(tmp_path / "log", workers=2, votes="") as server:
        run(lesson(server), 240)
        assert "Traceback" not in server.log
    assert (tmp_path / "state" / "tippe-top-explorer" / "votes.sqlite").exists()


@pytest.mark.parametrize("kind", ["a file", "a Redis"])
def test_two_servers_are_one_class(kind, tmp_path, request):
    place = request.getfixturevalue("redis") if kind == "a Redis" else tmp_path / "votes"

    async def lesson(one, other, end_of_one):
        page = await teacher(one.url)
        code, key = await opens(page)
        first = await student(other.url, code, "1", "de")
        await hears(first, plain(say("learn.free.question", "de", spin=34.7, tilt=5.7)[:20]))
        await votes(first, "over", "de")
        await hears(page, votes_counted(1))

        # the teacher's connection is cut, and his server gone: his link opens the room at another
        page.visitor.leave()
        end_of_one()
        page = await teacher(other.url, key)
        await hears(page, votes_counted(1))
        second = await student(other.url, code, "2")
        await votes(second, "upright")
        await hears(page, votes_counted(2))
        await page.visitor.click(say("teach.vote.answer"))
        await hears(page, say("teach.vote.said", answer=say("learn.options.over")))

        # whoever has another key has another room
        stranger = await teacher(other.url, f"{code}.{'x' * 22}")
        await hears(stranger, say("teach.vote.over"))

        await page.visitor.click(say("teach.vote.close"))
        await hears(page, say("teach.vote.shut"))
        await hears(first, say("teach.student.closed", "de"))
        await hears(second, say("teach.student.closed"))
        await second.visitor.click(say("teach.student.send"))
        await hears(second, say("teach.student.gone"))
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
        for hidden in ("close", "answer", "again"):
            await page.visitor.click(say(f"teach.vote.{hidden}"))
        code, _ = await opens(page)
        nowhere = await student(server.url, "rooms", "1")
        await hears(nowhere, say("teach.student.gone"))
        await nowhere.visitor.click(say("teach.student.send"))
        phone = await student(server.url, code, "1")
        await votes(phone, "over")
        for answer in ("upright", "over", "between"):
            await phone.leave()
            phone = await student(server.url, code, "1")
            await hears(phone, say("teach.student.sent"))  # it is told that it has voted, and may vote otherwise
            await votes(phone, answer)
        await votes(await student(server.url, code, "2"), "between")
        await hears(page, votes_counted(2))
        third = await student(server.url, code, "3")
        await third.until(lambda: third.visitor.find("RadioBoxGroup", "options"))
        await third.visitor.click(say("teach.student.send"))
        await hears(third, say("teach.student.waiting"))
        await chooses(third, "over")
        await third.visitor.click(say("teach.student.send"))
        await hears(third, say("teach.student.crowded"))
        assert "a bug" not in server.log
        kept = Sqlite(tmp_path / "votes")
        assert Room.of(code, kept.read([code])[code]).votes == ("between", "between")

    with served(tmp_path / "log", votes=tmp_path / "votes", votes_per_address=2) as server:
        run(lesson(server), 120)


def test_a_redis_that_goes_is_a_sentence_for_all_and_after_it_has_come_back_all_goes_on(tmp_path):
    port = free_port()

    async def lesson(server):
        page = await teacher(server.url)
        await page.visitor.click(say("teach.vote.open"))
        await hears(page, say("teach.vote.away"))
        first = await student(server.url, "ABCDEF", "1", "de")
        await hears(first, say("teach.student.away", "de"))
        with redis_serving(port):
            while True:  # the server asks one that was away no oftener than every few seconds
                await page.visitor.click(say("teach.vote.open"))
                await hears(page, say("teach.vote.wait"))
                await page.until(lambda: say("teach.vote.wait") not in page.visitor.says)
                if KEY.search(page.visitor.says):
                    break
            code, key = CODE.search(page.visitor.says)[1], KEY.search(page.visitor.says)[1]
            await first.visitor.click(say("teach.vote.again", "de"))
            await hears(first, say("teach.student.gone", "de"))
            second = await student(server.url, code, "2")
            await second.until(lambda: second.visitor.find("RadioBoxGroup", "options"))
        await hears(page, say("teach.vote.away"))
        await chooses(second, "over")
        await second.visitor.click(say("teach.student.send"))
        await hears(second, say("teach.student.away"))
        other = await teacher(server.url, key)
        await hears(other, say("teach.vote.away"))
        await shows(other, say("teach.vote.again"))

    with served(tmp_path / "log", votes=f"redis://127.0.0.1:{port}/0") as server:
        run(lesson(server), 120)
        assert "Traceback" not in server.log and "votes are away" in server.log


@pytest.fixture(autouse=True)
def needs(request):
    if "goes" in request.node.name:
        request.getfixturevalue("redis")  # skips where there is none
