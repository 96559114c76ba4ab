"""One colour for each quantity, the same in every picture: the colour-blind safe palette of Okabe and Ito.

The yellow of the energy is darkened, because the original is too pale for a line on white. colours.json is the one
list, which frontend/src/colours.js reads too. Words and thin lines on a light background use ON_LIGHT, the darkened
palette.
"""

import json
from pathlib import Path

_LIST = json.loads(Path(__file__).with_name("colours.json").read_text(encoding="utf-8"))
COLOURS: dict[str, str] = {name: colour for name, colour in _LIST.items() if isinstance(colour, str)}
ON_LIGHT: dict[str, str] = COLOURS | _LIST["on_light"]
INK, FAINT = COLOURS["ink"], COLOURS["faint"]
GREY = COLOURS["grey"]
"""For everything that is not a quantity, on a light and on a dark page."""
ACCENT = COLOURS["accent"]
"""For the selection in the Lab and on the maps, and for the present position."""
