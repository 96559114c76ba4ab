"""What a browser may send: each part of the page accepts what it is made for, and nothing that costs the server more
than the sender. A client that is not the page is answered, or its connection is closed with a reason, and another
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
from types import SimpleNamespace

import pytest
import visitors
from bokeh.core.serialization import Serialized
from bokeh.model import DataModel
from serving import megabytes, served
from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError
from visiting import of_roll
from wire import Closed, Visitor, event, run

import app.page.page  # noqa: F401  (all components)
from app.model.build.builder import LARGEST_FILE
from app.server.messages import CHANGES, MOST, Refused, look_at
from tippe_core import LoadedSphere, save_top

pytestmark = pytest.mark.served

APP = Path(__file__).parent.parent / "app"
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
HANDS = ("NumberControls", "Field", "Menu", "Choice", "Checks", "Stretch", "TextFile", "Head", "Painted",
         "Top3D", "Surface3D", "PlaneView", "SectionView", "LabView", "EventList", "Drawing",
         "Location", "Button", "Form")  # fmt: skip


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


def some_event(draw, visitor):
    """One event; most events are for something that a person can set."""
    hand = [id for id, (name, _) in visitor.models.items() if name.startswith(HANDS)]
    model = draw.choice(hand if draw.random() < 0.8 else list(visitor.models))
    own = [*visitor.models[model][1], "value", "sent", "clicks", "pulled", "painted"]
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
        return "PATCH-DOC", {"events": [some_event(draw, visitor) for _ in range(draw.choice((1, 1, 1, 3)))]}
    return draw.choice((
        ("PUSH-DOC", {"doc": {}}), ("PULL-DOC-REQ", {}), ("SERVER-INFO-REQ", {}), ("NO-SUCH", {}), ("PATCH-DOC", {}),
        ("PATCH-DOC", {"events": []}), ("PATCH-DOC", {"events": [{}] * 500}), ("PATCH-DOC", []), ("PATCH-DOC", "no"),
        ("PATCH-DOC", "[" * 100_000), ("PATCH-DOC", json.dumps("x" * 300_000)), ("PATCH-DOC", "9" * 10_000),
        ("PATCH-DOC", '{"events": [{"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "value", "new": NaN}]}'),
    ))  # fmt: skip


DEEP = "PATCH-DOC", {"events": [{"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "value", "new": deep(40)}]}
NONE = "PATCH-DOC", "[" * 100_000


async def fuzz(url, messages, seed=1):
    """Sends this many messages; returns all sentences that came back."""
    page = await visitors.come(url)
    await visitors.open_panels(page)
    await page.leave()
    draw, said, visitor = random.Random(seed), set(), await Visitor.enter(url, page.visitor.token, pull=False)
    visitor.models = page.visitor.models
    for kind, body in (DEEP, NONE, *(content(draw, visitor) for _ in range(messages))):
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
    slider = innocent.group("K_J")
    said = await fuzz(url, messages)
    answered, _ = await innocent.answer(await innocent.set(slider, "request", [1, "K_J", 6.5, False]))
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


PATIENT = "from app.server import admission; admission.SAVED = float('inf')"  # else it reads so much more slowly


@pytest.fixture(scope="module")
def attacked(tmp_path_factory):
    with served(tmp_path_factory.mktemp("fuzz") / "log", code=PATIENT) as server:
        yield server


def test_messages_that_no_page_sends(attacked):
    said = run(among(attacked.url, 150), 600)
    check(said, attacked.log)
    assert any("deep" in text for text in said) and any("no message" in text for text in said)


async def moves(visitor):
    """Whether a slider of a rolling motion still moves."""
    answered, _ = await visitor.answer(await visitor.set(visitor.group("K_J"), "request", [1, "K_J", 6.5, False]))
    return answered == "OK"


async def no_messages(server):
    """Pieces that are no message, one of 100 MB, and a visitor who never reads: another one notices nothing."""
    innocent, deaf = [await Visitor.enter(of_roll(server.url)) for _ in range(2)]
    for piece in ("", "null", "[]", "7", '{"msgid": 1}', '{"msgtype": "PATCH-DOC", "num_buffers": 9}'):
        visitor = await Visitor.enter(server.url, pull=False)
        with suppress(WebSocketClosedError):
            for _ in range(4):
                await visitor.socket.write_message(piece)
        with pytest.raises(Closed, match="1007"):
            await visitor.receive()
    visitor, before = await Visitor.enter(server.url, pull=False), megabytes(server.process.pid)
    with suppress(WebSocketClosedError, StreamClosedError):
        await visitor.socket.write_message(b"x" * 100_000_000, binary=True)
    with pytest.raises(Closed):
        await visitor.receive()
    for i in range(200):
        await deaf.set(deaf.group("K_J"), "request", [i, "K_J", 6 + i / 1000, False])
    assert await moves(innocent)
    assert megabytes(server.process.pid) - before < 50
    deaf.leave(), innocent.leave()


def test_what_is_no_message_or_is_never_read_disturbs_nobody(attacked):
    said = attacked.log.count("a piece over 256 KiB")
    run(no_messages(attacked))
    assert attacked.log.count("a piece over 256 KiB") == said + 1
    check(set(), attacked.log)


# --- each attribute of each component

ELEVEN = (None, True, -1, 10**400, 1e308, float("nan"), "", "x" * 5000, [0] * 3000,
          {"type": "map", "entries": [["a", 1]]}, deep(4))  # fmt: skip
GOOD = {"request": [7, "K_J", 6.5, False], "hand": ["line", 0.5, 6.5], "playing": False,
        "gesture": 7, "dark": False}  # fmt: skip
GOOD_OF = {
    ("Head", "request"): [7, "table", "rough"],
    ("LabView", "request"): [7, "tilt", 5.0],
    ("SectionView", "hand"): ["R", 10.6, -10.6],
    ("LessonView", "request"): [7, "section", "theorists"],
}


def attributes_of(name):
    """All attributes of a component of this name, those that the browser may change first."""
    modules = [module for key, module in sys.modules.items() if key.startswith("app.")]
    kind = next((vars(module)[name] for module in modules if hasattr(vars(module).get(name), "param")), None)
    return [*CHANGES.get(name, {}), *(set(kind.param) - set(CHANGES.get(name, {})) if kind else ())]


async def each_attribute(url):
    """Sends eleven values to each attribute that the browser may change, and one to each of the others, which are
    refused by name; then valid ones, which are accepted. Returns how many were sent."""
    page, count = await visitors.come(url, "de"), 0
    await visitors.open_panels(page)
    await visitors.open_rooms(page)
    visitor = await Visitor.enter(url, page.visitor.token, pull=False)  # a second socket of the same session
    components = {}
    for id, name in page.visitor.kinds():
        if (isinstance(id, tuple) or re.fullmatch(r"[A-Z]\w*\d+", name)) and attributes_of(re.sub(r"\d+$", "", name)):
            components.setdefault(re.sub(r"\d+$", "", name), []).append(id)
    assert {"NumberControls", "Head", "Menu", "Field", "Top3D", "TextFile"} <= set(components)
    for name, ids in components.items():
        for i, attribute in enumerate(attributes_of(name)):
            known = attribute in CHANGES.get(name, {})
            for value in ELEVEN if known else ELEVEN[i % 11 :][:1]:
                for id in ids[:1]:
                    kind, reply = await visitor.answer(await visitor.set(id, attribute, value))
                    # the lesson creates its questions again, and messages to removed ones are ignored
                    assert known or kind == "ERROR", (name, attribute)
                    assert kind == "OK" or reply["traceback"] is None
                    count += 1
    for name, ids in components.items():
        for attribute in GOOD.keys() & CHANGES.get(name, {}).keys():
            good = GOOD_OF.get((name, attribute), GOOD[attribute])
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


# --- files

GIGABYTE = 1_000_000_000
TOP = save_top(LoadedSphere(R=0.02345, b=0.008, d=0.010, density=1190.0, core_density=7850.0))
NO_FILES = (["x" * (LARGEST_FILE + 1), 1, 7], ["x", -1, 7], ["x", 1, None], ["x", 1], ["x", 1, 7, 7], [7, 1, 7], "x",
            None, ["x", 10**400, 7], [{"type": "map"}, 1, 7], [{"type": "bytes", "data": "H4sI"}, 1, 7])  # fmt: skip


def most_megabytes(pid):
    """The greatest memory that a process has used."""
    return int(re.search(r"VmHWM:\s*(\d+)", Path(f"/proc/{pid}/status").read_text())[1]) / 1000


def bombs(file, head):
    """Changes that name a gigabyte, or a model."""
    for dtype in (f"S{GIGABYTE}", f"({GIGABYTE // 8},)f8"):
        array = {"type": "ndarray", "array": [1], "dtype": dtype, "order": "little", "shape": [1]}
        yield file, "sent", [array, 1, 7]
        yield head, "request", array
    yield head, "request", {"type": "object", "name": "ColumnDataSource", "id": "new", "attributes": {"data": {}}}


async def send_files(server):
    """Bombs, what is no file or too large, 150 that are no top (10 MB); then a good one."""
    visitor, pid = await Visitor.enter(f"{server.url}?tab=build-a-top"), server.process.pid
    await visitor.ready()
    while not visitor.find("TextFile"):
        visitor.note((await visitor.receive())[1])
    [file], before = visitor.find("TextFile"), most_megabytes(pid)
    for model, attribute, bomb in bombs(file, visitor.find("Head")[0]):
        kind, content = await visitor.answer(await visitor.set(model, attribute, bomb))
        assert kind == "ERROR" and content["traceback"] is None
    for sent in NO_FILES:
        kind, content = await visitor.answer(await visitor.set(file, "sent", sent))
        assert kind == "ERROR" and content["traceback"] is None, sent
    assert most_megabytes(pid) - before < 100
    grew = []  # once more if something else has begun beside
    for first in (0, 150, 300):
        before = megabytes(pid)
        for i in range(first, first + 150):
            kind, content = await visitor.answer(
                await visitor.set(file, "sent", [f"{i}".ljust(LARGEST_FILE), i, LARGEST_FILE])
            )
            assert kind == "OK", content
        grew.append(megabytes(pid) - before)
        if grew[-1] < 5:
            break
    assert grew[-1] < 5
    await visitor.set(file, "sent", [TOP, 451, len(TOP)])
    while "23.45" not in json.dumps((await visitor.receive())[1]):
        pass
    visitor.leave()


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="reads what Linux says of a process's memory")
def test_a_file_is_one_small_piece_and_what_is_none_costs_nothing(attacked):
    run(send_files(attacked), 600)


# --- what each part takes, without a server


class Models(dict):
    """The models of a document, as look_at() needs them."""

    get_by_id = dict.get
    seen = dict.__contains__


def look(*events, models, buffers=()):
    content = {"events": list(events)}
    message = SimpleNamespace(msgtype="PATCH-DOC", content=content, payload=Serialized(content, list(buffers)))
    look_at(message, SimpleNamespace(models=models))


@pytest.mark.parametrize("kind, attribute, takes, refuses", [
    ("NumberControls1", "request", [[1, "K_J", 6.5, False], [2, "K_J", "6,5", True]],
     [None, 7, [], [1, "K_J", 6.5], [1, "K_J", 6.5, 0], [True, "K_J", 6.5, False], [-1, "K_J", 6.5, False],
      [1, "K_J", 1e16, False], [1, "K_J", [], False], [1, "K_J", "9" * 301, True], [1, "x" * 301, 6.5, False],
      [1, 7, 6.5, False], [1, "K_J", float("nan"), False], [1, "K_J", 10**400, False], [1, "K_J", 6.5, False, 0]]),
    ("Head1", "request", [[1, "room", "lab"], [2, "dark", True]],
     [None, 7, [1, "room"], [-1, "room", "lab"], [1, "room", 7], [1, "x" * 301, ""], [1, "toy", None]]),
    ("Choice1", "value", ["a", 7], ["c", 1, 7.0, True, None, ["a"], {}]),
    ("Menu1", "value", ["a", 7], ["c", 1, ["a"], {}, None]),
    ("Field1", "value", ["", "x" * 60], ["x" * 61, 7, None]),
    ("Button1", "clicks", [0, 7], [-1, 0.5, True, "1", None, 10**400]),
    ("Stretch1", "pulled", [[1, 0, 0.5], [2, 0, 1]], [0.5, [1, 0.5], [1, 0, 1.1], [1, 0, "1"], [0, 0.5, 1, 1], None]),
    ("Checks1", "value", [[], ["a"], [7, "a"]], ["a", ["c"], [1], [["a"]], None]),
    ("TextFile1", "sent", [["", 1, 0], ["x" * LARGEST_FILE, 2, 1]],
     [["x" * (LARGEST_FILE + 1), 1, 1], ["", -1, 1], [""]]),
    ("Surface3D1", "hand", [["end", 0.5, 7], ["tieline", 0.5, 7]], [[], ["a", 0.5, 7], ["end", True, 7], [0.5, 7]]),
    ("TopsMap1", "state", [None, 7, "x", [1, [2]], {"type": "map", "entries": [["a", 1]]}],
     [[0] * (MOST + 1), [[[[[1]]]]], 1e16, float("inf"), {"type": "slice"}, {"id": "p1"}, {"a": 1}, "x" * 20_000]),
    ("Form1", "sent", [[1, 1, "value", "7"], [2, 2, "value", "b"], [3, 3, "clicks", 1]],
     [None, [1, 1, "value"], [1, 1, "value", "x" * 61], [1, 1, "label", "a"], [1, 1, 7, "a"], [1, 2, "value", "c"],
      [1, 3, "clicks", -1], [-1, 3, "clicks", 1], [1, 0, "visible", True], [1, 4, "value", "a"], [1, -1, "value", "a"],
      [1, True, "value", "a"], [1, "1", "value", "a"], [1, 4, "object", "a"]]),
    ("New1", "anything", [], [None, 7]),
    ("figure", "inner_width", [], [300, None]),
    ("LinearAxis", "axis_line_color", [], ["red", None]),
    ("Drawing1", "sent", [[1, "p7", {"type": "map", "entries": [["x", [0.5]], ["z", ["a"]]]}]],
     [None, [1, "p7", None], [1, "p7", {"type": "map", "entries": [["x", [0] * 11], ["z", []]]}], [1, 7, {}],
      [1, "p7", {"type": "map", "entries": [["x", [[0]]], ["z", []]]}]]),
    ("ColumnDataSource", "data", [], [{"type": "map", "entries": [["x", [0.5]]]}]),
])  # fmt: skip
def test_what_the_browser_may_change(kind, attribute, takes, refuses):
    has = {"objects": [1, 2, 3], "options": ["a", "b"], "max_length": 20, "start": 0, "end": 1,
           "data": {"x": [], "z": []}}  # fmt: skip
    if kind == "Form1":
        inside = [{"kind": name, "at": i + 1} for i, name in enumerate(("Field", "Menu", "Button", "words"))]
        options = {"options": {"one": "a", "two": "b"}}
        has |= {"parts": json.dumps({"tree": [{"kind": "column", "at": 0, "inside": inside}]}),
                "state": json.dumps({"of": [{}, {}, options, {}, {}]})}  # fmt: skip
    if kind in ("Choice1", "Menu1", "Checks1"):
        has["options"] = {"one": "a", "two": 7}
    known = type(f"Probe{kind}", (DataModel,) if kind.endswith("1") else (), {"__init__": lambda self: None})
    known.__name__ = kind  # only now: Bokeh registers the name at creation, and allows it only once in a process
    own = known()
    for name, value in has.items():
        object.__setattr__(own, name, value)
    models = Models(p1=own)

    def change(value):
        look({"kind": "ModelChanged", "model": {"id": "p1"}, "attr": attribute, "new": value}, models=models)

    for value in takes:
        change(value)
    for value in refuses:
        with pytest.raises(Refused):
            change(value)


@pytest.mark.parametrize("said, why", [
    (event("tap", "p1", sx=1, sy=1, x=0.5, y=0.5), "'tap'"), (event(["document_ready"], "p1"), "not for this page"),
    (event("nonsense", "p1"), "'nonsense'"), (event("document_ready", "p1"), "'model'"),
    (event("dom_event", "p2", node="click", data=None), "'dom_event'"),
    (event("data_event", "p2", data={"a": 1}), "'data_event'"),
    ({"kind": "MessageSent", "msg_type": "other", "msg_data": {}}, "an event"),
    ({"kind": "RootRemoved", "model": {"id": "p1"}}, "'RootRemoved'"), ({"kind": ["ModelChanged"]}, "kind"),
    ({"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "x", "new": 1, "hint": 1}, "names a model"),
    ({"kind": "ModelChanged", "model": {"id": ["p1"]}, "attr": "x", "new": 1}, "no part"),
])  # fmt: skip
def test_events_that_the_page_never_sends(said, why):
    button, figure = type("ReactComponent", (), {})(), type("figure", (), {})()
    with pytest.raises(Refused, match=why):
        look(said, models=Models(p1=figure, p2=button))


# --- the table, and the page


def test_the_table_has_what_our_scripts_change():
    """The assignments model.x = ... in a component's JavaScript."""
    scripts = [*(APP / "frontend/src").rglob("*.js"), *APP.rglob("*.py")]
    changed = {name for path in scripts
               for name in re.findall(r"\bmodel\.(\w+) (?:\+?=) ", path.read_text(encoding="utf-8"))}  # fmt: skip
    assert {"request", "painted", "page"} <= changed
    assert changed - {name for attributes in CHANGES.values() for name in attributes} == set()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder, served(Path(folder, "log")) as server:
        heard = run(among(server.url, int(sys.argv[1])), 7200)
        print(*sorted(heard), sep="\n")
        lines = server.log.splitlines()
        print(f"{sys.argv[1]} messages; {sum('refused' in line for line in lines)} lines of refusal in the log")
        check(heard, server.log)
