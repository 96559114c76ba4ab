"""What is drawn of the top of a run on a map; lengths in R."""

import numpy as np

from app.model.bodies import body, outline
from app.model.maps.maps import OWN, Cell, Map
from tippe_core import PRESETS, Shape
from tippe_core.types import Array


def outline_of(asked: Map, cell: Cell, own: Array | None) -> Array:
    """The outline of what slides, (k, 2); own: that of a body of one's own. A stem that a map makes longer is drawn
    longer; a top whose a or I1 it changes is none that is known, so the ball alone is."""
    axes = {asked.across, asked.up}
    if {"a", "ratio"} & axes or (asked.body == OWN and own is None):
        return outline(cell.top)
    drawn = own if own is not None and asked.body == OWN else body(_shape(asked.body))
    if cell.edge is None or not {"stem", "rounding"} & axes:
        return drawn
    radius, height, rounding = (*cell.edge, 0.0)[:3]
    r, h = drawn.T
    foot, old = float(np.sqrt(max(1 - (radius + rounding) ** 2, 0.0))), float(h.max())
    return np.column_stack([r, np.where(h > foot, foot + (h - foot) * (height + rounding - foot) / (old - foot), h)])


def _shape(name: str) -> Shape:
    return next(preset.shape for preset in PRESETS if preset.name == name)
