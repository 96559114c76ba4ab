"""How a run ends: one hue, light to dark by tilt, always with its word; what still rolls or changes stands between.

ends.json is the one list, which frontend/src/ends.js reads too: `in_lab` is what the Lab's strip calls an end, which
tells fewer of them apart. What is said of an end stands under its name in maps.toml, and under the Lab's in lab.toml.
"""

import json
from pathlib import Path

_LIST: list[dict[str, str]] = json.loads(Path(__file__).with_name("ends.json").read_text(encoding="utf-8"))

NAMES = tuple(end["name"] for end in _LIST)
"""As an Ending and Many have them."""
COLOUR = {end["name"]: end["colour"] for end in _LIST}
"""{name: colour on a light ground}"""
WORDS_ON = {end["name"]: end["words"] for end in _LIST if "words" in end}
"""{name: colour of words on it, where they are not dark}"""
IN_LAB = tuple(end["in_lab"] for end in _LIST if "in_lab" in end)
"""As the Lab's strip has them."""
COLOUR_IN_LAB = {end["in_lab"]: end["colour"] for end in _LIST if "in_lab" in end}
"""{as the Lab's strip has it: colour on a light ground}"""
