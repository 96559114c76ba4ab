"""A visitor without a browser: Bokeh's protocol over a websocket, as a page uses it, or as an attacker might."""

import asyncio
import html
import json
import re
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from urllib.parse import urlsplit
from urllib.request import Request, urlopen

from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import websocket_connect

TOKEN = re.compile(r'"token":"([^"]+)"')


def get(url, **headers):
    """(status, headers, text) of a page."""
    try:
        with urlopen(Request(url, headers=headers), timeout=60) as answer:
            return answer.status, answer.headers, answer.read().decode(errors="replace")
    except OSError as error:  # an error status is an answer too
        if not hasattr(error, "code"):
            raise
        return error.code, error.headers, error.read().decode(errors="replace")


def event(name, model, **values):
    """The message that a browser sends for an event of a model. values: as in a message, but dicts may be plain."""
    packed = [[key, {"type": "map", "entries": [*map(list, value.items())]} if isinstance(value, dict) else value]
              for key, value in values.items()]  # fmt: skip
    values = {"type": "map", "entries": [["model", {"id": model}], *packed]}
    data = {"type": "event", "name": name, "values": values}
    return {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": data}


class Closed(Exception):
    """The server closed the connection, with this code and reason."""


OPEN = []  # the Visitors of the coroutine that runs


@dataclass
class Visitor:
    """The browser's side of a session. models: {id: (type, attributes)}, the present models of the page."""

    socket: object
    token: str
    models: dict = field(default_factory=dict)
    bytes_in: int = 0
    count: int = 0
    turn: asyncio.Lock = field(default_factory=asyncio.Lock)  # the fragments of two messages must not interleave

    @classmethod
    async def enter(cls, url, token=None, headers=None, pull=True):
        """Loads the page and opens its session; raises Closed if the server refuses."""
        if token is None:
            page = await AsyncHTTPClient().fetch(HTTPRequest(url, headers=headers or {}, request_timeout=300))
            token = TOKEN.search(page.body.decode()).group(1)
            cookies = page.headers.get_list("Set-Cookie")
            if cookies:
                headers = {**(headers or {}), "Cookie": "; ".join(cookie.split(";")[0] for cookie in cookies)}
        parts = urlsplit(url)
        headers = {"Origin": f"http://{parts.netloc}", **(headers or {})}
        request = HTTPRequest(f"ws://{parts.netloc}{parts.path}/ws?{parts.query}", headers=headers,
                              request_timeout=300, connect_timeout=300)  # fmt: skip
        socket = await websocket_connect(request, subprotocols=["bokeh", token], max_message_size=2**27)
        visitor = cls(socket, token)
        OPEN.append(visitor)
        visitor.socket.protocol.set_nodelay(True)  # as browsers do, because a message consists of several writes
        kind, _, _ = await visitor.receive()
        assert kind == "ACK"
        if pull:
            _, content, _ = await visitor.ask("PULL-DOC-REQ", {})
            visitor.note(content["doc"])
        return visitor

    def note(self, part):
        """Stores the models in what the server sends."""
        if isinstance(part, list):
            for each in part:
                self.note(each)
        elif isinstance(part, dict):
            if part.get("type") == "object" and "id" in part:
                self.models[part["id"]] = (part["name"], part.get("attributes", {}))
            elif part.get("kind") == "ModelChanged" and part["model"]["id"] in self.models:
                self.models[part["model"]["id"]][1][part["attr"]] = part["new"]
            for each in part.values():
                self.note(each)

    def unknown(self, part):
        """The ids of models that are referenced but were never sent: a browser discards such a message."""
        if isinstance(part, list):
            return {id for each in part for id in self.unknown(each)}
        if not isinstance(part, dict) or part.get("type") == "bytes":  # its id is that of a buffer
            return set()
        if set(part) == {"id"} and re.fullmatch(r"p\d+", str(part["id"])):
            return {part["id"]} - set(self.models)
        return {id for each in part.values() for id in self.unknown(each)}

    def find(self, kind, *names):
        """The ids of the models of this type with these attributes, in document order, and (id, number) of each such
        part of a Form."""
        return [id for id, name in self.kinds()
                if re.fullmatch(kind + r"\d*", name) and all(each in self.shown(id) for each in names)]  # fmt: skip

    def kinds(self):
        """(id, type) of all models, and ((id, number), kind) of all parts of Forms."""
        for id, (name, attributes) in self.models.items():
            yield id, name
            if re.fullmatch(r"Form\d+", name):
                tree = json.loads(attributes["parts"])["tree"]
                while tree:
                    if tree[0]["kind"] != "other":  # a model
                        yield (id, tree[0]["at"]), tree[0]["kind"]
                    tree = tree[0].get("inside", []) + tree[1:]

    def shown(self, id):
        """{attribute: value} of a model, or of a part of a Form, as far as the server has sent it."""
        if not isinstance(id, tuple):
            return self.models[id][1]
        form, at = id
        of, file = json.loads(self.shown(form)["state"])["of"], self.shown(form).get("file") or [None]
        return of[at] | ({"file": file[1:]} if file[0] == at else {})

    def group(self, name):
        """The id of the group of inputs that has this one."""
        [found] = [id for id in self.find("NumberControls", "parts")
                   if re.search(f'"name": "{name}"', self.models[id][1]["parts"])]  # fmt: skip
        return found

    def choice(self, value):
        """The id of the choice by buttons that has this value."""
        [found] = [id for id in self.find("Choice", "options") if f'"{value}"' in json.dumps(self.shown(id)["options"])]
        return found

    def component(self, kind):
        """The id of the first Panel component whose data model has this type, or None."""
        data = self.find(kind)
        for id, (_, attributes) in self.models.items():
            if isinstance(attributes.get("data"), dict) and attributes["data"].get("id") in data:
                return id
        return None

    async def say(self, kind, content, message=None, buffers=()):
        """Sends a message; returns its id."""
        self.count += 1
        message = message or f"m{self.count}"
        header = {"msgid": message, "msgtype": kind} | ({"num_buffers": len(buffers)} if buffers else {})
        async with self.turn:
            for text in (json.dumps(header), "{}", content if isinstance(content, str) else json.dumps(content)):
                await self.socket.write_message(text)
            for i, buffer in enumerate(buffers):
                await self.socket.write_message(json.dumps({"id": f"b{i}"}))
                await self.socket.write_message(buffer, binary=True)
        return message

    async def set(self, model, attribute, value):
        """Changes a model, or a part of a Form, as a browser does; returns the id of the message."""
        if isinstance(model, tuple):
            model, attribute, value = model[0], "sent", [self.count, model[1], attribute, value]
        event = {"kind": "ModelChanged", "model": {"id": model}, "attr": attribute, "new": value}
        return await self.say("PATCH-DOC", {"events": [event]})

    async def ready(self):
        """Reports that the page is complete, as a browser does; then the server sends what it creates afterwards."""
        event = {"type": "event", "name": "document_ready", "values": {"type": "map", "entries": []}}
        await self.say("PATCH-DOC", {"events": [
            {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}
        ]})  # fmt: skip

    @property
    def says(self):
        """All text of the page that is HTML."""
        texts = (self.shown(id).get("object" if kind == "words" else "text") for id, kind in self.kinds())
        return "\n".join(html.unescape(text) for text in texts if isinstance(text, str))

    async def _fragment(self):
        fragment = await self.socket.read_message()
        if fragment is None:
            raise Closed(self.socket.close_code, self.socket.close_reason)
        self.bytes_in += len(fragment)
        return fragment

    async def receive(self):
        """The next message: (kind, content, id of the message that it answers)."""
        header, _, content = json.loads(await self._fragment()), await self._fragment(), await self._fragment()
        for _ in range(2 * header.get("num_buffers", 0)):
            await self._fragment()
        return header["msgtype"], json.loads(content), header.get("reqid")

    async def answer(self, message):
        """Reads until the answer to a message: (kind, content)."""
        while True:
            kind, content, answered = await self.receive()
            if answered == message:
                return kind, content

    async def ask(self, kind, content):
        """Sends a message and reads until its answer: (kind, content, seconds)."""
        start = time.monotonic()
        answered = await self.answer(await self.say(kind, content))
        return *answered, time.monotonic() - start

    def leave(self):
        """Closes the page."""
        self.socket.close(1001)  # as a browser does


class Page:
    """A Visitor that reads continuously and answers as a page does. lost: why it has stopped reading, or None."""

    def __init__(self, visitor):
        self.visitor, self.lost = visitor, None
        [self._painted] = visitor.find("Painted") or [None]
        self._replies, self._heard = {}, asyncio.Condition()
        self.reading = asyncio.create_task(self._read())

    async def _read(self):
        try:
            while True:
                kind, content, answered = await self.visitor.receive()
                if kind == "ERROR":
                    raise RuntimeError(content["text"])
                if kind == "PATCH-DOC":
                    self.heard(content)
                    self.visitor.note(content)
                    if unknown := self.visitor.unknown(content):
                        raise RuntimeError(f"references {sorted(unknown)} are not known")
                    for event in content["events"]:
                        if event["kind"] == "ModelChanged" and event["model"]["id"] in self.visitor.models:
                            self.visitor.models[event["model"]["id"]][1][event["attr"]] = event["new"]
                        if event.get("attr") == "sent" and event["model"]["id"] == self._painted:
                            await self.visitor.set(self._painted, "painted", event["new"])
                async with self._heard:
                    self._replies[answered] = kind
                    self._heard.notify_all()
        except (Closed, RuntimeError) as error:
            self.lost = error
            async with self._heard:
                self._heard.notify_all()

    def heard(self, content):
        """Called with each change that the server sends."""

    async def until(self, condition):
        """Waits until messages of the server make the condition true; raises the error if reading ended."""
        async with self._heard:
            await self._heard.wait_for(lambda: self.lost or condition())
        if self.lost:
            raise self.lost

    def labelled(self, kind, label):
        """The id of the model of this kind with this label."""
        [found] = [id for id in self.visitor.find(kind, "label") if self.now(id, "label") == label]
        return found

    def stands(self, room):
        """The ids of what stands in the place of a room: the room itself, or the sentence that announces it."""
        [place] = [id for id in self.visitor.find("panel.models.layout.Column", "name")
                   if self.now(id, "name") == f"place-of-{room}"]  # fmt: skip
        return [child["id"] for child in self.now(place, "children")]

    async def open(self, room):
        """Opens a room, and waits until it has replaced the sentence that announces it."""
        [waits] = self.stands(room)
        await self.head("room", room)
        await self.until(lambda: len(self.stands(room)) == 1 and self.stands(room) != [waits])

    async def head(self, name, value=""):
        """Clicks something in the head of the page."""
        [head] = self.visitor.find("Head")
        self._clicks = getattr(self, "_clicks", 0) + 1
        await self.set(head, "request", [self._clicks, name, value])

    def now(self, model, attribute, default=None):
        """The present value of an attribute, as far as the server has sent it."""
        return self.visitor.shown(model).get(attribute, default)

    async def set(self, model, attribute, value):
        """Changes a model as a browser does, and waits for the answer."""
        message = await self.visitor.set(model, attribute, value)
        await self.until(lambda: message in self._replies)

    async def click(self, button):
        """Clicks a button, and waits for the answer."""
        await self.set(button, "clicks", self.now(button, "clicks", 0) + 1)

    async def leave(self):
        """Closes the page."""
        self.reading.cancel()
        self.visitor.leave()

    async def vanish(self):
        """Drops the connection without closing it properly."""
        self.reading.cancel()
        self.visitor.socket.protocol.stream.close()


async def left_if_it_fails(coroutine, seconds):
    """A coroutine with a time limit; if it fails, its visitors leave, so that the next test finds the server empty."""
    OPEN.clear()
    try:
        return await asyncio.wait_for(coroutine, seconds)
    except BaseException:
        for visitor in OPEN:
            if visitor.socket.protocol:  # it has not left
                visitor.socket.protocol.stream.close()
        raise


def run(coroutine, seconds=120):
    """Runs a coroutine with a time limit, in its own thread, because Playwright's loop runs in that of the tests."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, left_if_it_fails(coroutine, seconds)).result()
