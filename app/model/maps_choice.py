"""What a reader of Maps has set: the map, what its colours say, and the place of the bead."""

from typing import Any, ClassVar

import param

from app.model.maps import COLOURS_BY, QUANTITIES, Map
from tippe_core import PRESETS, TopError

AT = (28.6, 5.7)
FIXED = ("spin", "tilt", "slip", "mu", "second")
"""What can be set where it is on no axis."""


class MapChoice(param.Parameterized):  # type: ignore[misc]  # param has no types
    """asked: the Map; colour: one of COLOURS_BY; place: across and up of the bead."""

    INPUTS: ClassVar = ("asked", "colour", "place")

    asked = param.ClassSelector(class_=Map, default=Map(), doc="the map")
    colour = param.Selector(default="end", objects=[*COLOURS_BY], doc="what its colours say")
    place = param.List(default=[*AT], bounds=(2, 2), doc="across and up of the bead, in units of the axes")


class MapText:
    """A Map in an address: across_from_to_up_from_to_law_body_seconds_cells, then name_value of what is fixed."""

    def __init__(self, number: Any) -> None:
        self._number = number

    def text(self, asked: Map) -> str:
        """Of any Map; the page's own top is in other words of the address, and here 0."""
        numbers = (asked.seconds, float(asked.cells))
        names = [preset.name for preset in PRESETS]
        body = names.index(asked.body) + 1 if asked.body in names else 0
        parts = [asked.across, *map(self._number.text, asked.across_range),
                 asked.up, *map(self._number.text, asked.up_range), asked.law, str(body),
                 *map(self._number.text, numbers)]  # fmt: skip
        for name, value in asked.values:
            parts += [name, self._number.text(value)]
        return "_".join(parts)

    def value(self, text: str) -> Map:
        """Of what text() wrote; else a ValueError, which may be the TopError of what no map can be."""
        parts = text.split("_")
        if not 10 <= len(parts) <= 10 + 2 * len(QUANTITIES) or len(parts) % 2:
            raise TopError("map", text, "across_from_to_up_from_to_law_body_seconds_cells")
        across, left, right, up, bottom, top, law, body, seconds, cells, *fixed = parts
        number = self._number.value
        which = int(number(body))
        own = {} if not 1 <= which <= len(PRESETS) else {"body": PRESETS[which - 1].name}
        values = tuple((name, number(value)) for name, value in zip(fixed[::2], fixed[1::2], strict=True))
        for name, _ in values:
            if name not in FIXED:
                raise TopError("map", name, ", ".join(FIXED))
        return Map(across=across, up=up, across_range=(number(left), number(right)), law=law,
                   up_range=(number(bottom), number(top)), seconds=number(seconds), cells=int(number(cells)),
                   values=values, **own)  # fmt: skip
