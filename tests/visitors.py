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
ROOMS = ("three-planes", "build-a-top", "families", "learn", "lab", "maps", "measure")
"""Beside Roll, where a visitor comes, as an address names them."""
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
    """Each room after the other, until it stands where it was said that it is being made."""

    def stands(place):
        """The ids of what does: of the room alone, or of a sentence."""
        return [child["id"] for child in page.now(place, "children")]

    for room in ROOMS:
        [place] = [id for id in page.visitor.find("panel.models.layout.Column", "name")
                   if page.now(id, "name") == f"place of {room}"]  # fmt: skip
        [waits] = stands(place)
        await page.head("room", room)
        await page.until(lambda place=place, waits=waits: len(stands(place)) == 1 and stands(place) != [waits])


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
