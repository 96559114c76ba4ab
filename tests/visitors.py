"""Visits a running server by websocket: visitors arrive together, move a slider, open all panels and rooms, and leave
one by one.

    python tests/visitors.py http://localhost:5006/app [VISITORS]

Exits with 1 if one of them is refused, or gets an error or no answer. It needs only the libraries of the page itself,
so that tests/pythons.py can run it on each Python, and anybody can check a new server with it.
"""

import asyncio
import sys

from visiting import of_roll
from wire import Page, Visitor, run

MOVES = 12  # of each visitor's slider
ROOMS = ("build-a-top", "families", "learn", "maps", "measure")
"""All rooms except the Lab, where a visitor arrives, by their names in an address."""
PANELS = ("surface", "time", "values", "ends", "portraits")
"""All that the Lab shows beside its stage, except what an arrival shows."""
PATIENCE = 300  # s


async def come(url, language="en"):
    """A Page that has loaded; an address without a query opens the paper's rolling top."""
    page = Page(await Visitor.enter(of_roll(url), headers={"Accept-Language": language}))
    await page.visitor.ready()
    return page


async def stay(page, K_J):
    """Moves a slider, and opens each panel and room."""
    dial = page.visitor.group("K_J")
    for i in range(MOVES):
        await page.set(dial, "request", [i + 1, "K_J", K_J + 0.05 * i, False])
    await open_panels(page)
    await open_rooms(page)


async def open_panels(page):
    """Opens one panel after the other, and waits until each has its content."""
    switch = page.visitor.choice(PANELS[0])
    for panel in PANELS:
        if page.now(switch, "value") == panel:  # it is open
            continue
        known = len(page.visitor.models)
        await page.set(switch, "value", panel)
        await page.until(lambda known=known: len(page.visitor.models) > known)


async def open_rooms(page):
    """Opens one room after the other, and waits until each stands."""
    for room in ROOMS:
        await page.open(room)


async def visit(url, count):
    """`count` visitors arrive at once, every other one in German; the first leaves early, and one more arrives."""
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
    print(
        f"{count + 1} visitors came, moved a slider {MOVES} times each, "
        f"opened all {len(PANELS) + 1} panels and {len(ROOMS) + 1} rooms, and left"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
