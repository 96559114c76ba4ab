"""A client that is not the page: each message is answered, or the connection is closed with a reason, and another
visitor notices nothing. `python tests/test_fuzz.py 10000` sends that many messages."""

import asyncio
import base64
import gzip
import json
import random
import re
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

import pytest
import visitors
from serving import megabytes, served
from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError
from visiting import of_roll
from wire import Closed, Visitor, run

import app.page.page  # noqa: F401  (all components)
from app.server.messages import CHANGES

pytestmark = pytest.mark.served

NUMBERS = (0, -1, 7, 1e308, -1e308, 5e-324, 10**400, 2**63, float("nan"), float("inf"), True)
STRINGS = ("", "7", "nan", "1e999", "−7", "<script>alert(1)</script>", "../../etc/passwd", "\x00", "\ud800", "9" * 5000)
SPECIAL = (
    {"type": "number", "value": "nan"},
    {"type": "bytes", "data": "!!"},
    {"type": "bytes", "data": base64.b64encode(gzip.compress(bytes(10**6))).decode()},
    {"type": "ndarray", "array": [1], "dtype": "float64", "order": "little", "shape": [10**9]},
    {"type": "ndarray", "array": [1], "dtype": "object", "order": "little", "shape": [1]},
    {"type": "slice", "start": 0, "stop": 10**12, "step": 1},
    {"type": "map", "entries": [[[], 1]]},
    {"type": "set", "entries": [{"type": "map"}]},
    {"type": "object", "name": "Slider", "id": "new", "attributes": {"value": 3}},
    {"type": "object", "name": "os.system", "id": "new2"},
    {"type": "typed_array", "array": {"type": "bytes", "data": "AAAA"}, "dtype": "float32", "order": "big"},
    {"id": "nobody"},
)
EVENTS = ("tap", "pan", "panstart", "panend", "button_click", "document_ready", "connection_lost", "lodend",
          "nonsense", "selectiongeometry", "rangesupdate", "value_submit", "dom_event", "esm_event")  # fmt: skip
HANDS = ("Dial", "TextInput", "Select", "RadioButtonGroup", "FileInput", "TopFile", "Head", "Painted", "Top3D",
         "Surface3D", "Range1d", "ColumnDataSource", "Location", "Button")  # fmt: skip


def value(draw):
    """A value that may or may not be valid here."""
    pick = draw.random()
    if pick < 0.35:
        return draw.choice(NUMBERS)
    if pick < 0.55:
        return draw.choice(STRINGS)
    if pick < 0.75:
        return draw.choice(SPECIAL)
    if pick < 0.85:
        return [value(draw) for _ in range(draw.randrange(4))]
    if pick < 0.95:
        return draw.choice((None, {}, [], {"value": 1}, [[[]]], [0.0] * 3000, "x" * 50_000))
    return draw.choice(([0] * 20_000, deep(40), "x" * 200_000))


def deep(levels):
    """Nested lists."""
    whole = []
    for _ in range(levels):
        whole = [whole]
    return whole


def event(draw, visitor):
    """One event; most events are for something that a person can set."""
    hand = [id for id, (name, _) in visitor.models.items() if name.startswith(HANDS)]
    model = draw.choice(hand if draw.random() < 0.8 else list(visitor.models))
    own = [*visitor.models[model][1], "value", "value_throttled", "value_input", "filename", "active", "painted"]
    if draw.random() < 0.15:
        some = [name for name in ("x", "y", "data") if draw.random() < 0.6]
        values = [["model", {"id": model}], *([name, value(draw)] for name in some)]
        return {"kind": "MessageSent", "msg_type": draw.choice(("bokeh_event", "bokeh_event", "other")), "msg_data": {
            "type": "event", "name": draw.choice(EVENTS), "values": {"type": "map", "entries": values}}}  # fmt: skip
    if draw.random() < 0.1:
        return draw.choice((
            {"kind": "RootRemoved", "model": {"id": model}}, {"kind": "TitleChanged", "title": "mine"}, {"kind": 7},
            {"kind": "ColumnsStreamed", "model": {"id": model}, "attr": "data", "data": {}, "rollover": 1},
            {"kind": "ModelChanged"}, {"kind": "ModelChanged", "model": {"id": "nobody"}, "attr": "value", "new": 1},
            None,
        ))  # fmt: skip
    return {"kind": "ModelChanged", "model": {"id": model}, "attr": draw.choice(own), "new": value(draw)}


def content(draw, visitor):
    """(kind, content) of a message; the content may not be JSON."""
    pick = draw.random()
    if pick < 0.9:
        return "PATCH-DOC", {"events": [event(draw, visitor) for _ in range(draw.choice((1, 1, 1, 3)))]}
    return draw.choice((
        ("PUSH-DOC", {"doc": {}}), ("PULL-DOC-REQ", {}), ("SERVER-INFO-REQ", {}), ("NO-SUCH", {}), ("PATCH-DOC", {}),
        ("PATCH-DOC", {"events": []}), ("PATCH-DOC", {"events": [{}] * 500}), ("PATCH-DOC", []), ("PATCH-DOC", "no"),
        ("PATCH-DOC", "[" * 100_000), ("PATCH-DOC", json.dumps("x" * 300_000)), ("PATCH-DOC", "9" * 10_000),
        ("PATCH-DOC", '{"events": [{"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "value", "new": NaN}]}'),
    ))  # fmt: skip


async def fuzz(url, messages, seed=1):
    """Sends this many messages; returns all sentences that came back."""
    draw, said, visitor = random.Random(seed), set(), await Visitor.enter(of_roll(url))
    for _ in range(messages):
        kind, body = content(draw, visitor)
        try:
            sent = await visitor.say(kind, body)
            answered, reply = await asyncio.wait_for(visitor.answer(sent), 60)
            if answered == "ERROR":
                said.add(reply["text"])
                assert reply["traceback"] is None
        except Closed as closed:
            said.add(f"{closed.args[0]} {closed.args[1]}")
            models = visitor.models
            visitor = await Visitor.enter(url, visitor.token, pull=False)  # to the same session, which continues
            visitor.models = models
    visitor.leave()
    return said


async def among(url, messages):
    """Runs the fuzzer beside a visitor who moves one slider; returns the sentences for the fuzzer."""
    innocent = await Visitor.enter(of_roll(url))
    slider = innocent.find("Dial")[0]
    said = await fuzz(url, messages)
    answered, _ = await innocent.answer(await innocent.set(slider, "asked", [1, 6.5, False]))
    assert answered == "OK"
    innocent.leave()
    return said


def check(said, log):
    """The answers are only sentences, and no traceback is in the log."""
    for text in said:
        assert "Traceback" not in text and ".py" not in text and "site-packages" not in text, text
    at = max(log.find("a bug"), log.find("Traceback"))
    assert at < 0, log[at : at + 5000]
    assert "refused" in log


@pytest.fixture(scope="module")
def attacked(tmp_path_factory):
    with served(tmp_path_factory.mktemp("fuzz") / "log") as server:
        yield server


def test_messages_that_no_page_sends(attacked):
    said = run(among(attacked.url, 300), 600)
    check(said, attacked.log)
    assert any("deep" in text for text in said) and any("no message" in text for text in said)


@pytest.mark.parametrize("piece", ["", "null", "[]", "7", '{"msgid": 1}', '{"msgtype": "PATCH-DOC", "num_buffers": 9}'])
def test_pieces_that_are_no_message(piece, attacked):
    async def send(url):
        visitor = await Visitor.enter(url, pull=False)
        with suppress(WebSocketClosedError):
            for _ in range(4):
                await visitor.socket.write_message(piece)
        await visitor.receive()

    with pytest.raises(Closed, match="1007"):
        run(send(attacked.url))
    check(set(), attacked.log)


def test_a_message_of_100_MB_is_not_read(attacked):
    async def send(url):
        visitor, innocent = await Visitor.enter(url, pull=False), await Visitor.enter(of_roll(url))
        before = megabytes(attacked.process.pid)
        with suppress(WebSocketClosedError, StreamClosedError):
            await visitor.socket.write_message(b"x" * 100_000_000, binary=True)
        with pytest.raises(Closed):
            await visitor.receive()
        answered, _ = await innocent.answer(await innocent.set(innocent.find("Dial")[0], "asked", [1, 6.5, False]))
        innocent.leave()
        return answered, megabytes(attacked.process.pid) - before

    said = attacked.log.count("a piece over 256 KiB")
    answered, more = run(send(attacked.url))
    assert answered == "OK" and more < 50
    assert attacked.log.count("a piece over 256 KiB") == said + 1


# --- each attribute of each component

ELEVEN = (None, True, -1, 10**400, 1e308, float("nan"), "", "x" * 5000, [0] * 3000,
          {"type": "map", "entries": [["a", 1]]}, deep(4))  # fmt: skip
GOOD = {"asked": [7, 6.5, False], "active": 1, "value_input": "7", "hand": [], "tilted": [], "playing": False,
        "gesture": 7, "dark": False}  # fmt: skip
GOOD_OF = {
    ("Head", "asked"): [7, "table", "rough"],
    ("LabView", "asked"): [7, "tilt", 5.0],
    ("LessonView", "asked"): [7, "section", "theorists"],
}


def attributes_of(name):
    """All attributes of a component of this name, ours or a library's, those that the browser may change first."""
    modules = [module for key, module in sys.modules.items() if key.startswith(("app.", "panel_material_ui"))]
    kind = next((vars(module)[name] for module in modules if hasattr(vars(module).get(name), "param")), None)
    return [*CHANGES.get(name, {}), *(set(kind.param) - set(CHANGES.get(name, {})) if kind else ())]


async def each_attribute(url):
    """Sends eleven values to each attribute that the browser may change, and one to each of the others, which are
    refused by name; then valid ones, which are accepted. Returns how many were sent."""
    page, count = await visitors.come(url), 0
    await visitors.open_rooms(page)
    await page.until(lambda: page.visitor.find("Surface3D"))  # Roll makes it when the page has come
    visitor = await Visitor.enter(url, page.visitor.token, pull=False)  # a second socket of the same session
    components = {}
    for id, (name, _) in page.visitor.models.items():
        if re.fullmatch(r"[A-Z]\w*\d+", name) and attributes_of(re.sub(r"\d+$", "", name)):
            components.setdefault(re.sub(r"\d+$", "", name), []).append(id)
    assert {"Dial", "Head", "Select", "TextInput", "Top3D", "Surface3D", "TopFile"} <= set(components)
    for name, ids in components.items():
        for i, attribute in enumerate(attributes_of(name)):
            known = attribute in CHANGES.get(name, {})
            for value in ELEVEN if known else ELEVEN[i % 11 :][:1]:
                for id in ids if known else ids[:1]:
                    kind, reply = await visitor.answer(await visitor.set(id, attribute, value))
                    # the lesson creates its questions again, and messages to removed ones are ignored
                    assert known or kind == "ERROR" or name == "RadioBoxGroup", (name, attribute)
                    assert kind == "OK" or reply["traceback"] is None
                    count += 1
    for name, ids in components.items():
        for attribute in GOOD.keys() & CHANGES.get(name, {}).keys():
            good = GOOD_OF.get((name, attribute), GOOD[attribute])
            if name not in ("RadioButtonGroup", "RadioBoxGroup"):
                kind, reply = await visitor.answer(await visitor.set(ids[0], attribute, good))
                assert kind == "OK", (name, attribute, reply)
    assert page.lost is None
    visitor.leave()
    await page.leave()
    return count


def test_values_that_belong_nowhere_for_each_attribute_of_each_component(attacked):
    before = len(attacked.log)
    assert run(each_attribute(attacked.url), 600) > 1000
    log = attacked.log[before:]
    at = max(log.find("a bug"), log.find("Traceback"))
    assert at < 0, log[at : at + 5000]


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder, served(Path(folder, "log")) as server:
        heard = run(among(server.url, int(sys.argv[1])), 7200)
        print(*sorted(heard), sep="\n")
        lines = server.log.splitlines()
        print(f"{sys.argv[1]} messages; {sum('refused' in line for line in lines)} lines of refusal in the log")
        check(heard, server.log)
