"""A visitor without a browser: Bokeh's protocol over a websocket, as a page speaks it, or as somebody who means ill."""

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
    except OSError as error:  # an answer that is no page is one too
        if not hasattr(error, "code"):
            raise
        return error.code, error.headers, error.read().decode(errors="replace")


def event(name, model, **values):
    """What a browser says where something happens to a model; values: as they are in a message, dicts as such."""
    packed = [[key, {"type": "map", "entries": [*map(list, value.items())]} if isinstance(value, dict) else value]
              for key, value in values.items()]  # fmt: skip
    values = {"type": "map", "entries": [["model", {"id": model}], *packed]}
    data = {"type": "event", "name": name, "values": values}
    return {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": data}


class Closed(Exception):
    """The server closed the connection: its code and its words."""


@dataclass
class Visitor:
    """One page's end of a session. models: {id: (type, attributes)} of the page as it is now."""

    socket: object
    token: str
    models: dict = field(default_factory=dict)
    bytes_in: int = 0
    count: int = 0
    turn: asyncio.Lock = field(default_factory=asyncio.Lock)  # the pieces of two messages must not mix

    @classmethod
    async def enter(cls, url, token=None, headers=None, pull=True):
        """Loads the page and opens its session; raises Closed where it is not let in."""
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
        visitor.socket.protocol.set_nodelay(True)  # as a browser does: a message is several writes
        kind, _, _ = await visitor.receive()
        assert kind == "ACK"
        if pull:
            _, content, _ = await visitor.ask("PULL-DOC-REQ", {})
            visitor.note(content["doc"])
        return visitor

    def note(self, part):
        """Remembers the models in what the server says."""
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
        """The ids of models that are named there and were not brought: a browser throws away the whole message."""
        if isinstance(part, list):
            return {id for each in part for id in self.unknown(each)}
        if not isinstance(part, dict) or part.get("type") == "bytes":  # whose id is a buffer's
            return set()
        if set(part) == {"id"} and re.fullmatch(r"p\d+", str(part["id"])):
            return {part["id"]} - set(self.models)
        return {id for each in part.values() for id in self.unknown(each)}

    def find(self, kind, *names):
        """The ids of the models of this type that have these attributes, in the order of the document."""
        return [id for id, (name, attributes) in self.models.items()
                if re.fullmatch(kind + r"\d*", name) and all(each in attributes for each in names)]  # fmt: skip

    def component(self, kind):
        """The id of the first component of Panel's whose data are a model of this type, None where there is none."""
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
        """As if the browser had changed a model; returns the message's id."""
        event = {"kind": "ModelChanged", "model": {"id": model}, "attr": attribute, "new": value}
        return await self.say("PATCH-DOC", {"events": [event]})

    async def ready(self):
        """Says what a browser says when the page is there: what is made after the page then comes."""
        event = {"type": "event", "name": "document_ready", "values": {"type": "map", "entries": []}}
        await self.say("PATCH-DOC", {"events": [
            {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}
        ]})  # fmt: skip

    async def click(self, label):
        """As if somebody had clicked the button that says so."""
        [data] = [id for id, (name, attributes) in self.models.items()
                  if name.startswith("Button") and attributes.get("label") == label]  # fmt: skip
        [button] = [id for id, (_, attributes) in self.models.items()
                    if isinstance(attributes.get("data"), dict) and attributes["data"].get("id") == data]  # fmt: skip
        values = [["model", {"id": button}], ["node", "click"], ["data", {"type": "map", "entries": []}]]
        event = {"type": "event", "name": "dom_event", "values": {"type": "map", "entries": values}}
        await self.say("PATCH-DOC", {"events": [
            {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}
        ]})  # fmt: skip

    @property
    def says(self):
        """All that stands on the page as HTML."""
        texts = (attributes.get("text") for _, attributes in self.models.values())
        return "\n".join(html.unescape(text) for text in texts if isinstance(text, str))

    async def _fragment(self):
        fragment = await self.socket.read_message()
        if fragment is None:
            raise Closed(self.socket.close_code, self.socket.close_reason)
        self.bytes_in += len(fragment)
        return fragment

    async def receive(self):
        """(kind, content, id of what it answers) of the next message."""
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
        """Sends a message and reads until its answer: (kind, content, s it took)."""
        start = time.monotonic()
        answered = await self.answer(await self.say(kind, content))
        return *answered, time.monotonic() - start

    def leave(self):
        """Closes the page."""
        self.socket.close(1001)  # as a browser does


class Page:
    """A Visitor who reads all the time and answers as a page does. lost: why he reads no more, else None."""

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
                        if event.get("attr") == "sent":
                            await self.visitor.set(self._painted, "painted", event["new"])
                async with self._heard:
                    self._replies[answered] = kind
                    self._heard.notify_all()
        except (Closed, RuntimeError) as error:
            self.lost = error
            async with self._heard:
                self._heard.notify_all()

    def heard(self, content):
        """Something new to show has come."""

    async def until(self, condition):
        """Waits until something that the server says makes it so; raises what ended the reading."""
        async with self._heard:
            await self._heard.wait_for(lambda: self.lost or condition())
        if self.lost:
            raise self.lost

    def labelled(self, kind, label):
        """The id of the model of this kind with this label."""
        [found] = [id for id in self.visitor.find(kind, "label") if self.visitor.models[id][1]["label"] == label]
        return found

    async def head(self, name, value=""):
        """As if something in the page's head had been clicked."""
        [head] = self.visitor.find("Head")
        self._clicks = getattr(self, "_clicks", 0) + 1
        await self.set(head, "asked", [self._clicks, name, value])

    def now(self, model, attribute, default=None):
        """What the server has said of it so far."""
        return self.visitor.models[model][1].get(attribute, default)

    async def set(self, model, attribute, value):
        """As if the browser had changed a model, and waits for the answer."""
        message = await self.visitor.set(model, attribute, value)
        await self.until(lambda: message in self._replies)

    async def click(self, button):
        """As if the browser had clicked one of Panel's, and waits for the answer."""
        [view] = [id for id, (_, attributes) in self.visitor.models.items()
                  if isinstance(attributes.get("data"), dict) and attributes["data"].get("id") == button]  # fmt: skip
        values = {"type": "map", "entries": [["model", {"id": view}], ["node", "click"], ["data", None]]}
        event = {"type": "event", "name": "dom_event", "values": values}
        message = await self.visitor.say("PATCH-DOC", {"events": [
            {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}
        ]})  # fmt: skip
        await self.until(lambda: message in self._replies)

    async def leave(self):
        """Closes the page."""
        self.reading.cancel()
        self.visitor.leave()

    async def vanish(self):
        """Is gone at once, without the words with which a connection ends."""
        self.reading.cancel()
        self.visitor.socket.protocol.stream.close()


def run(coroutine, seconds=120):
    """Runs it, for so long at most; in a thread of its own, for in the tests' own Playwright's loop is running."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, asyncio.wait_for(coroutine, seconds)).result()
