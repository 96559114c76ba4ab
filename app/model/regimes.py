"""What a top does at a moment, or would do if the table were no rougher. The frames of a motion contain the codes.

regimes.json is the only list, which frontend/src/regimes.js reads too: a code is an index in it, a colour a name in
colours.json. The words for a regime are under its name in regimes.toml.
"""

import json
from pathlib import Path

from app.model.colours import COLOURS

_LIST: list[dict[str, str]] = json.loads(Path(__file__).with_name("regimes.json").read_text(encoding="utf-8"))

ROLLS, WOULD_SLIP, WOULD_LIFT, SLIPS, FLIES, ENDS, GLIDES = range(len(_LIST))
NAMES = tuple(regime["name"] for regime in _LIST)
"""By their codes."""
COLOUR = tuple(COLOURS[regime["colour"]] for regime in _LIST)
"""By their codes, the same in every picture."""
OF_CORE = {regime["in_core"]: code for code, regime in enumerate(_LIST) if "in_core" in regime}
"""{name in a Trajectory: code}"""
