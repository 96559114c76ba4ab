"""A crowd for load.py, in a process of its own: pages that open rooms together, or that send as fast as they can, with
a low priority. It writes a line when all have come, and acts on each line that it is given: the name of a room, which
all then open, or a way of being greedy. After a room it writes how long each page waited for it, s."""

import asyncio
import json
import os
import sys
import time
from itertools import count, cycle
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from visitors import ROOMS, Page, Visitor

NICE = 10
PING, EMPTY = 0x9, 0x0  # websocket's opcodes: a ping, and what goes on with a message


class Person(Page):
    """One page of the crowd."""

    async def open(self, room):
        """Opens a room; returns the s until it stands."""
        start = time.monotonic()
        await super().open(room)
        return time.monotonic() - start

    async def rooms(self):
        """Looks into one room after the other, and waits for none."""
        [head] = self.visitor.find("Head")
        for number, room in zip(count(1), cycle(ROOMS), strict=False):
            await self.visitor.set(head, "request", [number, "room", room])
            await asyncio.sleep(0)

    async def teacher(self):
        """The same, once in two seconds."""
        for room in cycle(ROOMS):
            await asyncio.gather(self.head("room", room), asyncio.sleep(2))

    async def page(self):
        """Asks for the whole page, again and again."""
        while True:
            await self.visitor.say("PULL-DOC-REQ", {})

    async def pings(self):
        """Sends websocket pings without payload."""
        await self._frames(PING, True)

    async def frames(self):
        """Begins a message, and goes on with it by empty frames."""
        await self.visitor.socket.protocol._write_frame(False, 0x1, b"{")
        await self._frames(EMPTY, False)

    async def _frames(self, opcode, final):
        frame = bytes([opcode | (0x80 if final else 0), 0x80, 1, 2, 3, 4])
        stream = self.visitor.socket.protocol.stream
        while True:
            await stream.write(500 * frame)


GREEDY = ("rooms", "page", "pings", "frames", "teacher")


async def main(url, people):
    async def come():
        async with gate:
            person = Person(await Visitor.enter(url))
            await person.visitor.ready()
            return person

    gate = asyncio.Semaphore(8)
    crowd = await asyncio.gather(*(come() for _ in range(people)))
    print("here", flush=True)
    while word := (await asyncio.to_thread(sys.stdin.readline)).strip():
        if word in GREEDY:
            os.nice(NICE)
            await asyncio.gather(*(getattr(each, word)() for each in crowd), return_exceptions=True)
            await asyncio.sleep(3600)
        print(json.dumps(await asyncio.gather(*(each.open(word) for each in crowd))), flush=True)


if __name__ == "__main__":
    asyncio.run(main(sys.argv[1], int(sys.argv[2])))
