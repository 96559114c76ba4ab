"""What the motion of a top on one table needs before and after tippe_core: room for its body, the units of the page."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from app.model.bodies import body
from app.model.setup import Setup
from tippe_core import SUNK, Scales, Sliding, State, TopError, Trajectory, lowest
from tippe_core.types import Array, Bools, Number

PUSHED = "pushed"  # the event of a push
NEAR_TOUCH = 0.02  # rad: a lift-off this near to the touch angle counts as caused by the touch
RTOL = 1e-9  # of Sliding

Progress: TypeAlias = Callable[[float], object]


def sliding_of(start: Setup, state: State, begins: float = 0.0) -> Sliding:
    """The motion of a Setup on the ordinary table, from a State."""
    return Sliding(start.top, state, start.friction, begins, rtol=RTOL, landing=start.landing, edge=start.edge,
                   profile=body(start.shape) if start.edge else None)  # fmt: skip


def check_room(settings: Setup, state: State) -> None:
    """Raises TopError if a part of the body other than the ball and the edge would be below the table at the start."""
    if settings.edge is None:
        return
    if _below(settings, np.array([state.theta]))[0]:
        theta = np.linspace(0, np.pi, 3601)
        below = np.append(_below(settings, theta), True)
        most = np.degrees(theta[max(int(np.argmax(below)) - 1, 0)])
        raise TopError("tilt", float(np.degrees(state.theta)), "at most {most:.4g} degrees for this body",
                       "Another part of it would be below the table.", code="body-below-table", most=most)  # fmt: skip


def _below(settings: Setup, theta: Array) -> Bools:
    """Whether a part of the body is below the table when it stands on its ball or edge at these tilts."""
    assert settings.edge is not None
    radius, height, rounding = settings.edge
    stands = np.maximum(1, rounding - height * np.cos(theta) + radius * np.sin(theta))
    return np.asarray(stands + lowest(body(settings.shape), theta) < -SUNK)


def clear(motion: Callable[[], Trajectory], settings: Setup, state: State) -> Trajectory:
    """A motion of the ball alone, motion(), as long as the stem is clear of the table; TopError if it never is."""
    angle = settings.touch_angle
    if state.theta >= angle:
        raise TopError("tilt", float(np.degrees(state.theta)),
                       "less than {most:.4g} degrees on this table",
                       "Its stem or rim would be below the table.", code="stem-below-table",
                       most=np.degrees(angle))  # fmt: skip
    trajectory = motion()
    theta, t = trajectory.theta, trajectory.t
    if theta.max() < angle:
        return trajectory
    first = max(int(np.argmax(theta >= angle)), 1)
    time = float(np.interp(angle, theta[first - 1 : first + 1], t[first - 1 : first + 1]))
    return trajectory.until(first, time, "stem touches")


def for_reader(error: TopError, scales: Scales) -> TopError:
    """A TopError of tippe_core in the units of the controls: degrees, rev/s, s."""
    names = {"theta": ("tilt", 180 / np.pi), "omega3": ("spin", scales.angular_velocity / (2 * np.pi)),
             "times": ("seconds", scales.time)}  # fmt: skip
    name, size = names.get(error.name, (error.name, 1.0))

    value = float(f"{size * error.value:.6g}") if name != error.name and isinstance(error.value, float) else error.value
    numbers: dict[str, Number] = {}
    if "most" in error.numbers:
        numbers["most"] = float(f"{size * error.numbers['most']:.4g}")
    if "t" in error.numbers:
        numbers |= {"t": float(f"{scales.time * error.numbers['t']:.4g}"), "unit": " s"}
    return error.replaced(name, value, **numbers)


def touches(trajectory: Trajectory, time: float, settings: Setup) -> bool:
    """Whether at that time, up to which it was on its sphere, the top is tilted so far that the stem touches."""
    before = max(int(np.searchsorted(trajectory.t, time)) - 1, 0)
    theta = trajectory.theta[before] + (time - trajectory.t[before]) * trajectory.omega[before, 0]
    return bool(abs(theta - settings.touch_angle) < NEAR_TOUCH)
