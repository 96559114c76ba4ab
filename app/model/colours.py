"""One colour for each quantity, the same in every picture. colours.json is the one list, which frontend/src/colours.js
reads too; it also has the variants for a dark page, which the browser chooses.
"""

import json
from pathlib import Path

_LIST = json.loads(Path(__file__).with_name("colours.json").read_text(encoding="utf-8"))
COLOURS: dict[str, str] = {name: colour for name, colour in _LIST.items() if isinstance(colour, str)}
INK, FAINT = COLOURS["ink"], COLOURS["faint"]
GREY = COLOURS["grey"]
"""For everything that is not a quantity, on a light and on a dark page."""
ACCENT = COLOURS["accent"]
"""For the selection in the Lab and on the maps, and for the present position."""
