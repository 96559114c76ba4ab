"""Writes anew what docs/validation.md, docs/mutants.md and docs/basins.md say of their age: python tests/ages.py.

After a change of code, what was found by the code before is marked as such. Nothing is computed again.
"""

import basins
import mutants
import validation

BASINS = basins.DOCS / "basins.md"


def basins_text():
    """Only the line of the age is new: the figures of the page take a minute."""
    lines = BASINS.read_text(encoding="utf-8").split("\n")
    (at,) = (i for i, line in enumerate(lines) if line.startswith("Computed "))
    return "\n".join([*lines[:at], basins.age(basins.KEPT), *lines[at + 1 :]])


PAGES = {validation.PAGE: validation.text, mutants.PAGE: mutants.text, BASINS: basins_text}
"""Page -> a function that gives its text."""


if __name__ == "__main__":
    for page, text in PAGES.items():
        page.write_text(text(), encoding="utf-8")
