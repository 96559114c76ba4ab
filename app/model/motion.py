"""The motion of a top on one table, and what it needs before and after tippe_core: room for its body, the form for
pictures."""

from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from app.model.bodies import body
from app.model.frames import in_space
from app.model.regimes import ENDS, GLIDES, OF_CORE, SLIPS, WOULD_LIFT
from app.model.setup import Setup
from tippe_core import SUNK, Ending, Scales, Sliding, State, TopError, Trajectory, ending, lowest
from tippe_core.types import Array, Bools, Indices, Number

KEPT = {"J": "jellett", "Routh": "routh", "E": "energy", "L_3": "L_3", "L_z": "L_z"}
THROWN = "stem throws it up"
PUSHED = "pushed"  # the event of a push
NEAR_TOUCH = 0.02  # rad: a lift-off this near to the touch angle counts as caused by the touch
RTOL = 1e-9  # of Sliding

Progress: TypeAlias = Callable[[float], object]


@dataclass(frozen=True, eq=False, kw_only=True)
class Motion:
    """One top on one plane. trajectory: as far as it goes; ended: the event at which it stopped, or "".

    t (n,) extends to the requested end: if the trajectory ends earlier, its last row is repeated there. frames: the
    arguments of top3d.pack_frames. stretches: (start, end, one of regimes.py), in order. drift: for each of KEPT, the
    largest difference between two instants relative to the largest value; alone: the time up to which only the sphere
    touches, what ends that ("" if nothing), and the drift of J up to then, which only a single contact conserves; both
    since the last push.
    Events have tippe_core's names, except THROWN if the stem's first touch lifts the top off. ending: on the sliding
    plane, how the motion ends.
    """

    trajectory: Trajectory
    ending: Ending | None
    ended: str
    t: Array
    frames: tuple[Array | Indices, ...]
    stretches: tuple[tuple[float, float, int], ...]
    drift: MappingProxyType[str, float]
    alone: tuple[float, str, float]

    @property
    def slip(self) -> Array:
        """The slip speed, (n,)."""
        return np.hypot(*self.trajectory.slip.T)

    @property
    def ledger(self) -> dict[str, Array]:
        """Energies in MgR whose sum is the energy at the start, {name: (n,)}; the height is that above G's lowest
        position."""
        entries, a = self.trajectory.ledger, self.trajectory.top.a
        return {
            "spin": entries.spin,
            "precession and nutation": entries.precession + entries.nutation,
            "motion of G": entries.translation,
            "height": entries.height - min(0.0, 2 * a),
            "heat": entries.heat,
        }

    @property
    def crossings(self) -> Array:
        """The times at which theta passes a right angle, (k,)."""
        theta, t = self._from_right_angle
        at = np.flatnonzero((theta[:-1] < 0) != (theta[1:] < 0))
        return t[at] + (t[at + 1] - t[at]) * theta[at] / (theta[at] - theta[at + 1])

    @property
    def _from_right_angle(self) -> tuple[Array, Array]:
        """theta minus a right angle, and the time, where that is not 0."""
        theta = self.trajectory.theta - np.pi / 2
        off = np.abs(theta) > 1e-12
        return theta[off], self.trajectory.t[off]

    @property
    def starts_below(self) -> bool:
        """Whether it starts below a right angle, or moves below it from there."""
        return bool(np.all(self._from_right_angle[0][:1] < 0))


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
    since = max((at for at, event in trajectory.events if event == PUSHED), default=0.0)
    later, last_part = [event for event in trajectory.events if event[0] > since], trajectory.t >= since
    first = next((event for event in later if event[1] not in ("sticks", "slips")), (t[-1], ""))
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
        drift=MappingProxyType({name: _drift(getattr(trajectory, field)[last_part]) for name, field in KEPT.items()}),
        alone=(until, event, _drift(trajectory.jellett[last_part & (trajectory.t <= until)])),
    )


def touches(trajectory: Trajectory, time: float, settings: Setup) -> bool:
    """Whether at that time, up to which it was on its sphere, the top is tilted so far that the stem touches."""
    before = max(int(np.searchsorted(trajectory.t, time)) - 1, 0)
    theta = trajectory.theta[before] + (time - trajectory.t[before]) * trajectory.omega[before, 0]
    return bool(abs(theta - settings.touch_angle) < NEAR_TOUCH)


def _drift(values: Array) -> float:
    most = np.abs(values).max()
    return float(np.ptp(values) / most) if most else 0.0
