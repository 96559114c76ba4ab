"""Visitors by websocket to a server that runs: they come together, move a slider, open the rooms, and leave one by one.

    python tests/visitors.py http://localhost:5006/app [VISITORS]

Exit 1 where one of them is turned away, is told an error, or is not answered. Needs only what the page itself needs:
for the Pythons of this machine (tests/pythons.py), and for a server that somebody has just set up.
"""

import asyncio
import sys

from visiting import of_roll
from wire import Page, Visitor, run

MOVES = 12  # of each visitor's slider
ROOMS = ("three-planes", "build-a-top", "families", "learn")  # beside Roll, where a visitor comes
A_ROOM = 20  # each brings so many models and more
PATIENCE = 300  # s


async def come(url, language="en"):
    """A Page whose document is there; an address without a query is Roll's here."""
    page = Page(await Visitor.enter(of_roll(url), headers={"Accept-Language": language}))
    await page.visitor.ready()
    return page


async def stay(page, K_J):
    """Does what a person does: moves the first slider, and looks at each room."""
    dial = page.visitor.find("Dial")[0]
    for i in range(MOVES):
        await page.set(dial, "asked", [i + 1, K_J + 0.05 * i, False])
    await open_rooms(page)


async def open_rooms(page):
    """Each room after the other, until it is there."""
    known = page.visitor.models
    for room in ROOMS:
        before = len(known)
        await page.head("room", room)
        await page.until(lambda before=before: len(known) > before + A_ROOM)


async def visit(url, count):
    """So many come at once, every other one in German; one leaves while the others stay, and one more comes last."""
    pages = await asyncio.gather(*(come(url, "de" if i % 2 else "en") for i in range(count)))
    first, *others = pages
    await stay(first, 5.0)
    await first.leave()
    await asyncio.gather(*(stay(page, 5 + 0.01 * i) for i, page in enumerate(others)))
    late = await come(url)
    await stay(late, 6.0)
    for page in (*others, late):
        await page.leave()


def main(url, count=8):
    """Prints what happened; returns the exit code."""
    try:
        run(visit(url, count), PATIENCE)
    except Exception as error:
        print(f"{type(error).__name__}: {error}")
        return 1
    print(f"{count + 1} visitors came, moved a slider {MOVES} times each, opened all {len(ROOMS) + 1} rooms, and left")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
