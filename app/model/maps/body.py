"""The outline of the top in the animation of a map's run; lengths in R."""

import numpy as np

from app.model.bodies import body, outline
from app.model.maps.maps import OWN, Cell, Map
from app.model.setup import TOYS
from tippe_core.types import Array


def outline_of(request: Map, cell: Cell, own: Array | None) -> Array:
    """The outline (k, 2) of the sliding body; own: that of the visitor's own body. A stem that the map lengthens is
    drawn longer. If the map changes a or I1, the shape is unknown, and only the ball is drawn."""
    axes = {request.across, request.up}
    if {"a", "ratio"} & axes or (request.body == OWN and own is None):
        return outline(cell.top)
    drawn = own if own is not None and request.body == OWN else body(TOYS[request.body].shape)
    if cell.edge is None or not {"stem", "rounding"} & axes:
        return drawn
    radius, height, rounding = (*cell.edge, 0.0)[:3]
    r, h = drawn.T
    foot, old = float(np.sqrt(max(1 - (radius + rounding) ** 2, 0.0))), float(h.max())
    return np.column_stack([r, np.where(h > foot, foot + (h - foot) * (height + rounding - foot) / (old - foot), h)])
