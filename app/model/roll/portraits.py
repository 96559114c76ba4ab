"""What the portraits of a Scene show, on the page and in print: the force in its disc, the track and its rosette."""

from dataclasses import dataclass

import numpy as np

from app.model.scene import Scene
from tippe_core.types import Array

POINTS_OF_A_CIRCLE = 145  # in print a line to the eye, still
# A circle so much larger than the track is a straight line to the eye.
STRAIGHT = 300
NO_TABLE = 1e-3  # Mg: of a push so small the direction says nothing


def square(scene: Scene) -> Array:
    """theta_dot^2 = f(theta) over a nutation, (n,)."""
    return scene.nutation.omega[:, 0] ** 2


def pushes(scene: Scene) -> tuple[Array, Array]:
    """F_x/F_z and F_y/F_z over a nutation, each (n,). Beyond lift-off there is no table to push: NaN."""
    F = scene.nutation.force
    F_x, F_y, F_z = np.where(F[:, 2:] > NO_TABLE, F, np.nan).T
    return F_x / F_z, F_y / F_z


def circle(radius: float, low: float = 0.0, high: float = 2 * np.pi) -> tuple[Array, Array]:
    """x and y of a circle about the origin, or an arc of it."""
    around = np.linspace(low, high, POINTS_OF_A_CIRCLE)
    return radius * np.cos(around), radius * np.sin(around)


@dataclass(frozen=True, eq=False, kw_only=True)
class Seen:
    """The track on the table from above at times t (n,): x and y, each (n,). rings: the parts that are drawn of the two
    circles that its rosette stays between, each x and y; none where it has no rosette.

    Unrolled, which shows a rosette too thin to be seen: along (n,) the way round in its middle, across (n,) from the
    inner circle outwards, width from it to the outer one.
    """

    t: Array
    x: Array
    y: Array
    rings: tuple[tuple[Array, Array], ...]
    along: Array
    across: Array
    width: float


def track(scene: Scene, points: int | None = None) -> Seen:
    """points: some so many, or all."""
    motion = scene.trajectory
    every = max(1, len(motion.t) // (points or len(motion.t)))
    t, (x, y) = motion.t[::every], motion.contact[::every].T
    if scene.rosette is None:
        return Seen(t=t, x=x, y=y, rings=(), along=np.hypot(x, y), across=np.zeros(len(t)), width=0.0)
    centre_x, centre_y, nearest, farthest = scene.rosette
    angle = np.unwrap(np.arctan2(y - centre_y, x - centre_x))
    rings = tuple(
        (centre_x + dx, centre_y + dy)
        for dx, dy in (circle(radius, *_arc(angle, farthest)) for radius in (nearest, farthest))
    )
    return Seen(
        t=t,
        x=x,
        y=y,
        rings=rings,
        along=(nearest + farthest) / 2 * np.abs(angle - angle[0]),
        across=np.hypot(x - centre_x, y - centre_y) - nearest,
        width=farthest - nearest,
    )


def _arc(angle: Array, radius: float) -> tuple[float, float]:
    """From where to where a circle is drawn beside a track that is seen from its centre at these angles."""
    low, high = float(angle.min()), float(angle.max())
    if radius >= STRAIGHT:
        return low, high
    if high - low > np.pi:
        return 0.0, 2 * np.pi
    margin = 0.06 * (high - low)
    return low - margin, high + margin
