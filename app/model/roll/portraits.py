"""The curves in the portraits of a Scene, on the page and in print: the force in its disc, the track and its
rosette."""

from dataclasses import dataclass

import numpy as np

from app.model.scene import Scene
from tippe_core.types import Array

POINTS_OF_A_CIRCLE = 145  # so that in print it still looks smooth
# A circle this much larger than the track looks like a straight line.
STRAIGHT = 300
NO_TABLE = 1e-3  # Mg: below this, F_z is too small for the ratio to mean anything


def square(scene: Scene) -> Array:
    """theta_dot^2 = f(theta) over one nutation, (n,)."""
    return scene.nutation.omega[:, 0] ** 2


def pushes(scene: Scene) -> tuple[Array, Array]:
    """F_x/F_z and F_y/F_z over one nutation, each (n,). nan beyond lift-off, where there is no contact."""
    F = scene.nutation.force
    F_x, F_y, F_z = np.where(F[:, 2:] > NO_TABLE, F, np.nan).T
    return F_x / F_z, F_y / F_z


def circle(radius: float, low: float = 0.0, high: float = 2 * np.pi) -> tuple[Array, Array]:
    """x and y of a circle about the origin, or of an arc of it."""
    around = np.linspace(low, high, POINTS_OF_A_CIRCLE)
    return radius * np.cos(around), radius * np.sin(around)


@dataclass(frozen=True, eq=False, kw_only=True)
class Seen:
    """The track on the table, seen from above, at times t (n,): x and y, each (n,). rings: the visible parts of the two
    circles between which its rosette stays, x and y of each; empty if there is no rosette.

    Unrolled, so that a thin rosette becomes visible: along (n,), the way along its middle circle; across (n,), the
    distance from the inner circle; width, the distance between the two circles.
    """

    t: Array
    x: Array
    y: Array
    rings: tuple[tuple[Array, Array], ...]
    along: Array
    across: Array
    width: float


def track(scene: Scene, points: int | None = None) -> Seen:
    """The track of a Scene. points: about so many of its points, or all."""
    motion = scene.trajectory
    every = max(1, len(motion.t) // (points or len(motion.t)))
    t, (x, y) = motion.t[::every], motion.contact[::every].T
    if scene.rosette is None:
        return Seen(t=t, x=x, y=y, rings=(), along=np.hypot(x, y), across=np.zeros(len(t)), width=0.0)
    centre_x, centre_y, nearest, farthest = scene.rosette
    angle = np.unwrap(np.arctan2(y - centre_y, x - centre_x))
    arcs = (circle(radius, *_arc(angle, farthest)) for radius in (nearest, farthest))
    rings = tuple((centre_x + dx, centre_y + dy) for dx, dy in arcs)
    return Seen(t=t, x=x, y=y, rings=rings, along=(nearest + farthest) / 2 * np.abs(angle - angle[0]),
                across=np.hypot(x - centre_x, y - centre_y) - nearest, width=farthest - nearest)  # fmt: skip


def _arc(angle: Array, radius: float) -> tuple[float, float]:
    """The range of angles over which a circle is drawn beside a track that covers these angles."""
    low, high = float(angle.min()), float(angle.max())
    if radius >= STRAIGHT:
        return low, high
    if high - low > np.pi:
        return 0.0, 2 * np.pi
    margin = 0.06 * (high - low)
    return low - margin, high + margin
