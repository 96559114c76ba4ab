"""The choices of a reader of Maps: the map, the meaning of its colours, and the position of the bead."""

from typing import Any, ClassVar

import param

from app.model.maps.maps import COLOURS_BY, Map

AT = (28.6, 5.7)
FIXED = ("spin", "tilt", "slip", "mu", "second")
"""The quantities that can be set as long as they are on no axis."""


class MapChoice(param.Parameterized):
    """request: the Map; colour: one of COLOURS_BY; place: the position of the bead, across and up."""

    INPUTS: ClassVar = ("request", "colour", "place")

    request = param.ClassSelector(class_=Map, default=Map(), doc="the map")
    colour: Any = param.Selector(default="end", objects=[*COLOURS_BY], doc="what its colours show")
    place = param.List(
        default=[*AT], item_type=float, bounds=(2, 2), doc="the position of the bead, in the units of the axes"
    )
