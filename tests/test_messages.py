"""What a browser may send: each part of the page accepts what it is made for, and nothing that costs the server more
than the sender. All through the websocket, as anybody could."""

import json
import re
from pathlib import Path
from types import SimpleNamespace

import pytest
import visitors
from bokeh.core.serialization import Serialized
from bokeh.model import DataModel
from serving import megabytes, served
from visiting import Visit, go_to, of_roll
from wire import Visitor, event, run

from app.model.build.builder import LARGEST_FILE
from app.server.messages import CHANGES, MOST, Refused, look_at
from tippe_core import LoadedSphere, save_top

pytestmark = pytest.mark.served

APP = Path(__file__).parent.parent / "app"
GIGABYTE = 1_000_000_000
TOP = save_top(LoadedSphere(R=0.02345, b=0.008, d=0.010, density=1190.0, core_density=7850.0)).encode()


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with served(tmp_path_factory.mktemp("messages") / "log") as server:
        yield server
        assert "Traceback" not in server.log


def most_megabytes(pid):
    """The greatest memory that a process has used."""
    return int(re.search(r"VmHWM:\s*(\d+)", Path(f"/proc/{pid}/status").read_text())[1]) / 1000


def chunk(**more):
    """A file in one piece, as sent by the browser."""
    whole = {"status": "upload_event", "type": "status", "name": "top.json", "mime_type": "application/json",
             "chunk": 1, "total_chunks": 1, "data": {"type": "bytes", "data": {"id": "b0"}}}  # fmt: skip
    return whole | more


async def opened(url):
    """A Visitor with the builder's tab open, who reads only when asked to."""
    visitor = await Visitor.enter(of_roll(url))
    await visitor.ready()
    await visitor.set(visitor.find("Head")[0], "asked", [1, "room", "build-a-top"])
    while visitor.component("TopFile") is None:
        visitor.note((await visitor.receive())[1])
    return visitor


async def said(visitor, event, buffers=()):
    """(kind, content) of the answer to one event."""
    return await visitor.answer(await visitor.say("PATCH-DOC", {"events": [event]}, buffers=buffers))


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="reads what Linux says of a process's memory")
def test_a_message_that_names_a_gigabyte_reserves_none_and_the_next_good_file_is_taken(server):
    def bombs(visitor):
        file, [dial, *_] = visitor.component("TopFile"), visitor.find("Dial")
        for size in (500_000_000, 10**10):  # bytes(of a number)
            yield event("data_event", file, data=chunk(data=size))
        for dtype in (f"S{GIGABYTE}", f"({GIGABYTE // 8},)f8"):
            array = {"type": "ndarray", "array": [1], "dtype": dtype, "order": "little", "shape": [1]}
            yield event("data_event", file, data=chunk(data=array))
            yield {"kind": "ModelChanged", "model": {"id": dial}, "attr": "asked", "new": array}
        many = {"type": "object", "name": "ColumnDataSource", "id": "new", "attributes": {"data": {}}}
        yield {"kind": "ModelChanged", "model": {"id": dial}, "attr": "asked", "new": many}

    async def throw():
        visitor, innocent = await opened(server.url), await Visitor.enter(of_roll(server.url))
        before = most_megabytes(server.process.pid)
        for bomb in bombs(visitor):
            kind, content = await said(visitor, bomb)
            assert kind == "ERROR" and content["traceback"] is None
        assert most_megabytes(server.process.pid) - before < 100
        dial = innocent.find("Dial")[0]
        assert (await innocent.answer(await innocent.set(dial, "asked", [1, 6.5, False])))[0] == "OK"
        file = visitor.component("TopFile")
        assert (await said(visitor, event("data_event", file, data=chunk()), [TOP]))[0] == "OK"
        all_of_it = event("data_event", file, data={"status": "finished", "type": "status"})
        await visitor.say("PATCH-DOC", {"events": [all_of_it]})
        while "23.45" not in json.dumps((await visitor.receive())[1]):
            pass
        visitor.leave(), innocent.leave()

    run(throw())


NO_FILES = (
    ({}, LARGEST_FILE + 1), ({"total_chunks": 9}, 10), ({"chunk": 2, "total_chunks": 2}, 10), ({"chunk": True}, 10),
    ({"chunk": 10**400}, 10), ({"name": "n" * 301}, 10), ({"name": {"type": "map"}}, 10), ({"mime_type": None}, 10),
    ({"data": {"type": "bytes", "data": "H4sI"}}, 10), ({"data": []}, 10), ({"more": 1}, 10), ({"status": "done"}, 10),
)  # fmt: skip


def test_a_file_is_one_piece_of_at_most_64_KiB(server):
    async def send():
        visitor = await opened(server.url)
        for more, size in NO_FILES:
            sent = event("data_event", visitor.component("TopFile"), data=chunk(**more))
            kind, content = await said(visitor, sent, [b" " * size])
            assert kind == "ERROR" and content["traceback"] is None, more
        visitor.leave()

    run(send())


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="reads what Linux says of a process's memory")
def test_files_that_are_sent_and_never_finished_do_not_pile_up(server):
    """300 files of 64 KiB, each with another name: 20 MB."""

    async def send():
        visitor = await opened(server.url)
        file, before = visitor.component("TopFile"), megabytes(server.process.pid)
        for i in range(300):
            answered = await said(visitor, event("data_event", file, data=chunk(name=f"{i}")), [b" " * LARGEST_FILE])
            assert answered[0] == "OK"
        more = megabytes(server.process.pid) - before
        visitor.leave()
        return more

    assert run(send()) < 10


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
    ("Dial1", "asked", [[1, 6.5, False], [2, "6,5", True]],
     [None, 7, [], [1, 6.5], [1, 6.5, 0], [True, 6.5, False], [-1, 6.5, False], [1, 1e16, False], [1, [], False],
      [1, "9" * 301, True], [1, float("nan"), False], [1, 10**400, False], [1, 6.5, False, 0]]),
    ("Head1", "asked", [[1, "room", "lab"], [2, "dark", True]],
     [None, 7, [1, "room"], [-1, "room", "lab"], [1, "room", 7], [1, "x" * 301, ""], [1, "toy", None]]),
    ("Select1", "value", ["a", None], ["c", 1, ["a"], {}]),
    ("TextInput1", "value", ["", "x" * 20], ["x" * 21, 7, None]),
    ("FloatSlider1", "value", [0, 0.5, 1], [1.1, -1, True, "0.5", None, float("nan"), 10**400]),
    ("RangeSlider1", "value", [[0, 0.5], [0, 1]], [0.5, [0.5], [0, 1.1], [0, "1"], [0, 0.5, 1], None]),
    ("CheckBoxGroup1", "value", [[], ["a"], ["b", "a"]], ["a", ["c"], [1], [["a"]], None]),
    ("Top3D1", "tilted", [[], [1.5, 0.1, 3]], [[1.5], [9, 0, 0], [1.5, "0", 0], [1.5, 0, -1], {}]),
    ("Surface3D1", "hand", [[], ["end", 0.5, 7]], [["a", 0.5, 7], ["end", True, 7], [0.5, 7]]),
    ("New1", "anything", [None, 7, "x", [1, [2]], {"type": "map", "entries": [["a", 1]]}],
     [[0] * (MOST + 1), [[[[[1]]]]], 1e16, float("inf"), {"type": "slice"}, {"id": "p1"}, {"a": 1}, "x" * 20_000]),
    ("figure", "inner_width", [300], [None, "300", float("inf")]),
    ("figure", "renderers", [], [[], None]),
    ("LinearAxis", "axis_line_color", ["red", None], [["red"], "x" * 301, {"type": "value", "value": 1}]),
    ("ColumnDataSource", "data", [{"type": "map", "entries": [["x", [0.5]], ["z", ["a"]]]}],
     [None, {"type": "map", "entries": [["x", [0.5]]]}, {"type": "map", "entries": [["x", [0] * 11], ["z", []]]},
      {"type": "map", "entries": [["x", [[0]]], ["z", []]]}]),
])  # fmt: skip
def test_what_the_browser_may_change(kind, attribute, takes, refuses):
    has = {"objects": [1, 2, 3], "options": ["a", "b"], "max_length": 20, "start": 0, "end": 1,
           "data": {"x": [], "z": []}}  # fmt: skip
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


POINT = {"sx": 1, "sy": 1, "x": 0.5, "y": 0.5, "modifiers": {"type": "map", "entries": []}}


@pytest.mark.parametrize("said, why", [
    (event("tap", "p1", **POINT | {"x": "far"}), "'x'"), (event("tap", "p1", **POINT | {"x": None}), "'x'"),
    (event("tap", "p1", sx=1, sy=1, x=0), "missing"), (event("tap", "p1", **POINT | {"more": 0}), "'more'"),
    (event("tap", "nobody", **POINT), "no part"), (event("pan", "p1", **POINT), "hears"),
    (event("nonsense", "p1"), "'nonsense'"), (event("document_ready", "p1"), "'model'"),
    (event("dom_event", "p2", node="msg", data=None), "'node'"),
    (event("data_event", "p2", data={"a": 1}), "no message"),
    ({"kind": "MessageSent", "msg_type": "other", "msg_data": {}}, "an event"),
    ({"kind": "RootRemoved", "model": {"id": "p1"}}, "'RootRemoved'"), ({"kind": ["ModelChanged"]}, "kind"),
    ({"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "x", "new": 1, "hint": 1}, "names a model"),
    ({"kind": "ModelChanged", "model": {"id": ["p1"]}, "attr": "x", "new": 1}, "no part"),
])  # fmt: skip
def test_events_that_the_page_never_sends(said, why):
    button = type("ReactComponent", (), {})()
    button.data, button.subscribed_events = type("Button1", (), {})(), ["dom_event", "data_event"]
    figure = type("figure", (), {"subscribed_events": ["tap"]})()
    look(event("tap", "p1", **POINT), models=Models(p1=figure))
    with pytest.raises(Refused, match=why):
        look(said, models=Models(p1=figure, p2=button))


# --- the table, and the page


def test_every_component_of_the_page_is_in_the_table(server):
    """A component that is not listed accepts plain values only; whoever adds a component lists what the browser changes
    of it."""

    async def all_models():
        page = await visitors.come(server.url)
        await visitors.open_rooms(page)
        names = {name for name, _ in page.visitor.models.values()}
        await page.leave()
        return names

    data = {re.sub(r"\d+$", "", name) for name in run(all_models()) if re.search(r"[a-z3]D?\d+$", name)}
    unnamed = data - set(CHANGES) - {"Range1d", "DataRange1d"}
    assert unnamed == set()


def test_the_table_has_what_our_scripts_change():
    """The assignments model.x = ... in a component's JavaScript."""
    scripts = [*(APP / "frontend/src").rglob("*.js"), *APP.rglob("*.py")]
    changed = {name for path in scripts
               for name in re.findall(r"\bmodel\.(\w+) (?:\+?=) ", path.read_text(encoding="utf-8"))}  # fmt: skip
    assert {"asked", "painted", "tilted", "page"} <= changed
    assert changed - {name for attributes in CHANGES.values() for name in attributes} == set()


def test_nothing_that_the_page_itself_sends_is_refused(chromium, server):
    """In a browser: sliders, the body in the builder, a top on the map, and a file."""
    page = chromium.new_page(viewport={"width": 1400, "height": 900})
    visit, before = Visit(page, server.url), server.log.count("refused")
    visit.pause()
    for box in page.locator("input[type=checkbox][name]:visible").all():
        box.click(force=True)
    assert page.evaluate("""() => [...Bokeh.documents[0]._all_models.values()]
        .filter((model) => model.attributes.show_track === false && model.attributes.follow === false).length""")
    go_to(page, "Build a top")
    page.locator("input[type=file]").set_input_files(
        {"name": "top.json", "mimeType": "application/json", "buffer": TOP})  # fmt: skip
    page.wait_for_function("""() => [...Bokeh.documents[0]._all_models.values()]
        .some((model) => model.attributes.told?.[1] == 23.45)""")
    visit.drag(visit.pixel("section", 0, 5), visit.pixel("section", 2, 9))
    page.mouse.up()
    go_to(page, "Families")
    page.get_by_role("button", name="Top S", exact=True).click()
    for tab in ("Three planes", "Measure", "Learn", "Lab"):
        go_to(page, tab)
        page.locator("input[type=range]:visible").first.press("ArrowRight")
        page.wait_for_function("Bokeh.documents[0].is_idle", timeout=180_000)  # Measure fits its example
    page.close()
    assert server.log.count("refused") == before, server.log[-3000:]
