"""Computes the Picture of Settings: the same top on the three planes, and a second, slightly disturbed sliding run.

It runs in a thread, which has no page, so it is told in which language to say why there is no motion.
"""

from collections.abc import Callable
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from app.model.bodies import body
from app.model.frames import in_space
from app.model.planes.picture import (
    KEPT,
    NEAR_TOUCH,
    RTOL,
    TABLES,
    Motion,
    Picture,
    Settings,
    Setup,
)
from app.model.regimes import ENDS, GLIDES, OF_CORE, SLIPS, WOULD_LIFT
from app.text import say, told
from tippe_core import (
    SUNK,
    Scales,
    State,
    TopError,
    Trajectory,
    beside,
    ending,
    glide,
    grip,
    growth,
    lowest,
    outcome,
    roll,
    slide,
)
from tippe_core.types import Array, Bools, Number

THROWN = "stem throws it up"
NUDGE, BESIDE = 1e-6, 3.0  # rad, s: the additional tilt of the disturbed run, and how long it continues after a touch

Progress: TypeAlias = Callable[[float], object]


def solve(settings: Settings, progress: Progress | None = None) -> Picture:
    """The Picture. progress: called with the fraction done; what it raises stops the run. Raises TopError, whose name
    is the input at fault."""
    top, state, times = settings.top, settings.state, settings.times
    check_room(settings, state)
    runs = {
        "rough": lambda: clear(lambda: roll(top, None, times, grip(top, state)[0]), settings, state),
        "ice": lambda: clear(lambda: glide(top, state, times), settings, state),
        "ordinary": lambda: slid(settings, state, times, progress),
    }
    motions: dict[str, Motion | None] = {}
    messages: dict[str, str] = {}
    for plane in TABLES:
        try:
            motions[plane] = motion_of(runs[plane](), settings, times, plane)
        except TopError as error:
            if plane == "ordinary":
                raise
            motions[plane], messages[plane] = None, told(for_reader(error, settings.scales))
        # the solver's error for numbers whose squares or reciprocals overflow
        except (ValueError, ArithmeticError):
            if plane == "ordinary":
                raise
            motions[plane], messages[plane] = None, say("planes.run.extreme")
    return Picture(
        settings=settings, state=state, friction=settings.friction, motions=MappingProxyType(motions),
        outcome=outcome(top, state, settings.scales), inputs=settings.inputs, messages=MappingProxyType(messages),
    )  # fmt: skip


def slid(settings: Setup, state: State, times: Array, progress: Progress | None) -> Trajectory:
    return slide(settings.top, state, settings.friction, times, rtol=RTOL, landing=settings.landing,
                 edge=settings.edge, progress=progress,
                 profile=body(settings.shape) if settings.edge else None)  # fmt: skip


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


def nudged(picture: Picture, progress: Progress | None = None) -> float:
    """The largest factor by which NUDGE, added to the initial tilt, grows in theta on the sliding plane; BESIDE after
    the first touch is long enough to tell."""
    settings, state, motion = picture.settings, picture.state, picture.motions["ordinary"]
    assert motion is not None and motion.ending is not None  # something touched there
    moved, until = motion.trajectory, motion.ending.stretches[0].end + BESIDE / settings.scales.time
    near = slid(settings, beside(state, NUDGE), moved.t[moved.t <= until], progress)
    return growth(moved, near, NUDGE)


def clear(motion: Callable[[], Trajectory], settings: Setup, state: State) -> Trajectory:
    """A motion of the ball alone, motion(), as long as the stem is clear of the table; TopError if it never is."""
    angle = settings.touch_angle
    if state.theta >= angle:
        raise TopError("tilt", float(np.degrees(state.theta)),
                       "less than {most:.4g} degrees on this plane",
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


def motion_of(trajectory: Trajectory, settings: Setup, times: Array, plane: str) -> Motion:
    n = len(trajectory.t)
    code = np.array([OF_CORE[word] for word in trajectory.regime])
    if plane == "rough":
        code[trajectory.force[:, 2] < 0] = WOULD_LIFT
    elif plane == "ice":
        code[code == SLIPS] = GLIDES  # without friction
    frames = [trajectory.t, trajectory.quaternion, trajectory.contact, trajectory.com, trajectory.theta,
              *in_space(trajectory), code]  # fmt: skip
    ended = n < len(times)
    if ended:
        frames = [np.concatenate([rows, rows[-1:]]) for rows in frames]
        frames[0][-1], frames[-1][-2:] = times[-1], ENDS
    t, code = frames[0], frames[-1]
    starts = np.flatnonzero(np.diff(code, prepend=-1))
    stretches = zip(t[starts], np.append(t[starts[1:]], t[-1]), code[starts], strict=True)
    first = next((event for event in trajectory.events if event[1] not in ("sticks", "slips")), (t[-1], ""))
    until, event = first
    if event == "lifts off" and plane == "ordinary" and settings.edge and touches(trajectory, until, settings):
        event = THROWN
    last = trajectory.events[-1] if ended and trajectory.events else (t[-1], "")
    return Motion(
        trajectory=trajectory,
        ending=ending(trajectory) if plane == "ordinary" else None,
        ended=event if last == first else last[1],
        t=t,
        frames=tuple(frames),
        stretches=tuple((float(start), float(end), int(which)) for start, end, which in stretches),
        drift=MappingProxyType({name: _drift(getattr(trajectory, field)) for name, field in KEPT.items()}),
        alone=(until, event, _drift(trajectory.jellett[trajectory.t <= until])),
    )


def touches(trajectory: Trajectory, time: float, settings: Setup) -> bool:
    """Whether at that time, up to which it was on its sphere, the top is tilted so far that the stem touches."""
    before = max(int(np.searchsorted(trajectory.t, time)) - 1, 0)
    theta = trajectory.theta[before] + (time - trajectory.t[before]) * trajectory.omega[before, 0]
    return bool(abs(theta - settings.touch_angle) < NEAR_TOUCH)


def _drift(values: Array) -> float:
    most = np.abs(values).max()
    return float(np.ptp(values) / most) if most else 0.0


def hits(picture: Picture) -> bool:
    """Whether anything but its ball touched; that makes a motion sensitive to its start."""
    motion = picture.motions["ordinary"]
    return motion is not None and motion.ending is not None and len(motion.ending.stretches) > 1
