"""One colour a quantity, the same in every picture: Okabe and Ito's colour-blind safe palette.

The energy's yellow is darkened, since the palette's own is too pale for a line on white. colours.json is the one list,
which frontend/src/colours.js reads too. Words and thin lines take ON_LIGHT on a light ground, the palette's darkened.
"""

import json
from pathlib import Path

_LIST = json.loads(Path(__file__).with_name("colours.json").read_text(encoding="utf-8"))
COLOURS: dict[str, str] = {name: colour for name, colour in _LIST.items() if isinstance(colour, str)}
ON_LIGHT: dict[str, str] = COLOURS | _LIST["on_light"]
INK, FAINT = COLOURS["ink"], COLOURS["faint"]
GREY = COLOURS["grey"]
"""Of what is no quantity, seen on a light and on a dark page."""
ACCENT = COLOURS["accent"]
"""Of what is selected in the Lab and on the maps, and of where one is."""
