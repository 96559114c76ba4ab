"""How a run ends: colours of one hue, light to dark by tilt, always shown with a word; still rolling or changing is in
between.

ends.json is the one list, which frontend/src/ends.js reads too. `in_lab` is the name of an end in the Lab's strip,
which distinguishes fewer of them. The words for an end are under its name in maps.toml, and under its Lab name in
lab.toml.
"""

import json
from pathlib import Path

_LIST: list[dict[str, str]] = json.loads(Path(__file__).with_name("ends.json").read_text(encoding="utf-8"))

NAMES = tuple(end["name"] for end in _LIST)
"""The names that Ending and Many use."""
COLOUR = {end["name"]: end["colour"] for end in _LIST}
"""{name: colour on a light background}"""
WORDS_ON = {end["name"]: end["words"] for end in _LIST if "words" in end}
"""{name: colour of words on it, if not dark}"""
IN_LAB = tuple(end["in_lab"] for end in _LIST if "in_lab" in end)
"""The names that the Lab's strip uses."""
COLOUR_IN_LAB = {end["in_lab"]: end["colour"] for end in _LIST if "in_lab" in end}
"""{name in the Lab's strip: colour on a light background}"""
