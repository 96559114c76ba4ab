"""One frozen Scene: everything that the views show of one top and one motion; and solve(), which computes it.

Angles in rad; lengths in R, masses in M, accelerations in g, so times in (R/g)^1/2, forces in Mg, energies in MgR.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np

from app.model.bodies import body, fits, outline
from app.model.frames import frame_times, in_space
from app.model.marks import LARGEST, Marks, energy_marks
from app.model.regimes import ROLLS, WOULD_LIFT, WOULD_SLIP
from app.model.region import MESH_COLUMNS, K_J_range, Plane, Upper, between, height, least_energy, plane
from app.text import say
from tippe_core import (
    Constants,
    Rolling,
    Scales,
    Shape,
    State,
    Top,
    TopError,
    Trajectory,
    TruncatedSphere,
    grip,
    omega3,
    turning_points,
)
from tippe_core.paper import rounded_f
from tippe_core.types import Array, Indices

STATE, TOP = ("theta", "theta_dot", "omega2", "omega3", "phi", "psi"), ("a", "I1", "I3")
# A motion at its limit still rolls: rounding must not change that.
AT_LIMIT = 1e-9
SAMPLES_A_NUTATION = 128
LEVELS = (0.15, 0.4, 0.7, 1.0, 2.0)
LEVEL_COLUMNS = 32
POTENTIAL_COLUMNS = 160

# For a, I1 and I3: below this the motion loses its digits, and solving takes seconds.
LEAST_INERTIA = 1e-12


@dataclass(frozen=True, eq=False, kw_only=True)
class Scene:
    """Everything that the views show. Trajectory arrays have one row for each frame; vectors are along axes fixed in
    space.

    ratio is F_h/F_z; regime, for each frame, a code of regimes.py; upright_spin, omega_3 at theta = 0; profile (k, 2),
    the radius of the body that is drawn and its height above O along axis 3; shape, the body, None if a, I1, I3 were
    set independently of it (scales are then still its R and M). lost: the energy that the grip of the rough table has
    taken. inputs: those of the Explorer, by name. messages: a sentence for each control whose value was refused;
    everything but the inputs is then that of the last valid Scene; nearest: {control: the nearest possible value}, if
    that is known. notes: sentences about what is shown.
    """

    top: Top
    scales: Scales
    mu_s: float
    constants: Constants
    share: float
    marks: Marks
    state: State
    rolling: Rolling
    plane: Plane
    turning: tuple[float, float]
    curve: Array
    trajectory: Trajectory
    force: Array
    omega: Array
    momentum: Array
    normal: Array
    ratio: Array
    regime: Indices
    K_J: Array
    K_R: Array
    E: Array
    upright_spin: float
    profile: Array
    shape: Shape | None
    lost: float
    inputs: MappingProxyType[str, Any]
    messages: MappingProxyType[str, str] = field(default_factory=lambda: MappingProxyType({}))
    nearest: MappingProxyType[str, float] = field(default_factory=lambda: MappingProxyType({}))
    notes: tuple[str, ...] = ()

    @property
    def turns(self) -> float:
        """The spin near theta = 0, in rev/s."""
        return float(self.upright_spin * self.scales.angular_velocity / (2 * np.pi))

    @property
    def drift(self) -> float:
        """The largest difference of K_J, K_R or E, each computed from the motion, between two frames; relative if the
        value is larger than 1."""
        return float(max(np.ptp(each) / max(1, np.abs(each).max()) for each in (self.K_J, self.K_R, self.E)))

    # Quantities that not every picture shows are computed when first needed.

    @cached_property
    def nutation(self) -> Trajectory:
        """One nutation from t = 0, closed: the Trajectory at SAMPLES_A_NUTATION + 1 equally spaced times."""
        return self.rolling(np.linspace(0, self.rolling.period, SAMPLES_A_NUTATION + 1))

    @property
    def well(self) -> int:
        """The index of the well in which it moves, counted from theta = 0 as in Rolling."""
        return int(np.abs(turning_points(self.top, self.constants) - self.turning).sum(axis=1).argmin())

    @cached_property
    def levels(self) -> list[tuple[Array, Array]]:
        """Motions of the same K_J and K_R at other energies, and one at LEVELS[i] of the marks: [(theta, theta_dot)],
        each theta ascending, theta_dot >= 0."""
        energies = [self.marks.energy(share) for share in LEVELS]
        ends = []
        for E in energies:
            wells = turning_points(self.top, replace(self.constants, E=E))
            ends.append(wells[int(np.argmin(np.abs(wells - self.marks.theta_steady).min(axis=1)))])
        inner, outer = np.transpose(ends)
        theta = between(inner, outer, LEVEL_COLUMNS)
        at_all = replace(self.constants, E=np.array(energies)[:, None])
        theta_dot = np.sqrt(np.maximum(rounded_f(theta, self.top, at_all), 0))
        theta_dot[:, [0, -1]] = 0
        return list(zip(theta, theta_dot, strict=True))

    @cached_property
    def potential(self) -> tuple[Array, Array]:
        """theta (n,) and the least energy E (n,) there: a motion turns back where its energy equals this."""
        inner, outer = self.turning
        reach = 0.6 * (outer - inner) + 0.05
        theta = np.linspace(max(inner - reach, 1e-3), min(outer + reach, np.pi - 1e-3), POTENTIAL_COLUMNS)
        return theta, least_energy(theta, self.top, self.constants.K_J, self.constants.K_R)

    @cached_property
    def rosette(self) -> tuple[float, float, float, float] | None:
        """The centre x, y and the least and largest distance of the track from it; None if the track runs straight on.

        One nutation rotates the motion by phi_advance and displaces it: together a rotation about a point of the table.
        """
        track = self.nutation.contact @ (1, 1j)
        turn = np.exp(1j * self.rolling.phi_advance)
        if abs(1 - turn) < AT_LIMIT:
            return None
        centre = (track[-1] - turn * track[0]) / (1 - turn)
        away = np.abs(track - centre)
        return centre.real, centre.imag, away.min(), away.max()


def solve(
    top: Top,
    K_J: float,
    K_R: float,
    mu_s: float,
    share: float,
    upper: Upper = True,
    limit: str = "lift-off",
    shape: Shape | None = None,
    *,
    E: float | None = None,
    state: State | None = None,
    let_go: State | None = None,
) -> Scene:
    """The Scene of one top and one motion; shape: the body, by default that of appendix A.

    E, if given, is the energy, instead of share; state, if given, the motion at t = 0, instead of the constants;
    let_go, if given, the State that the rough table grips at t = 0. Raises TopError, whose name is the input at fault.
    """
    shape, lost = shape or TruncatedSphere.paper(), 0.0
    if let_go is not None:
        state, lost = grip(top, let_go)
        state = replace(state, vx=None, vy=None)
    if state is not None:
        constants = Constants.from_state(top, state.theta, state.theta_dot, state.omega2, state.omega3)
        K_J, K_R, E = float(constants.K_J), float(constants.K_R), float(constants.E)
    _check_sizes(top, {"K_J": K_J, "K_R": K_R, "mu_s": mu_s, "E": share if E is None else E})
    marks = energy_marks(top, K_J, K_R, mu_s)
    if E is None:
        E = marks.energy(share)
    elif state is not None:
        share = max(marks.share(E), 0.0)  # rounding may leave a steady precession below itself
    else:
        share = marks.share(E)
    if share < 0 or not np.isfinite(share):
        raise TopError("E", E, "E >= {least:.10g} MgR at K_J = {K_J:g} and K_R = {K_R:g}",
                       "Below the steady precession there is no motion: move the energy up.", code="no-motion",
                       least=float(f"{marks.steady:.6g}"), K_J=K_J, K_R=K_R)  # fmt: skip
    constants = Constants(K_J, K_R, E)
    if state is not None:
        rolling = Rolling(top, None, start=state)
        turning = rolling.turning_points
    else:
        wells = turning_points(top, constants)
        well = int(np.argmin(np.abs(wells - marks.theta_steady).min(axis=1)))
        turning, rolling = wells[well], Rolling(top, constants, well=well)
    trajectory = rolling(frame_times(rolling.period, top, constants))
    if state is None:
        theta, (w1, w2, w3) = trajectory.theta[0], trajectory.omega[0]
        state = State(theta, w1, w2 if 0 < theta < np.pi else 0.0, w3)
    whole = plane(top, K_R, mu_s, upper, limit, *K_J_range(top, K_J, K_R, upper))
    turns = float(turning[0]), float(turning[1])
    request = {"mu_s": mu_s, "upper": upper, "limit": limit, "shape": shape}
    return _scene(request, lost, constants, share, marks, state, rolling, whole, turns, trajectory)


def _check_sizes(top: Top, numbers: dict[str, float]) -> None:
    for name, value in numbers.items():
        if not abs(value) <= LARGEST:
            raise TopError(name, value, "at most {most:g} in size", "No top is ever so fast, no table so rough.",
                           code="too-large", most=LARGEST)  # fmt: skip
    for name, least, unit in (("a", -LARGEST, "R"), ("I1", LEAST_INERTIA, "MR^2"), ("I3", LEAST_INERTIA, "MR^2")):
        if not least <= (value := getattr(top, name)) <= LARGEST:
            raise TopError(name, value, "{least:g} to {most:g} ({unit})", "No body is so thin, or so wide.",
                           code="no-such-body", least=least, most=LARGEST, unit=unit)  # fmt: skip


def _scene(
    request: dict[str, Any], lost: float, constants: Constants, share: float, marks: Marks, state: State,
    rolling: Rolling, whole: Plane, turning: tuple[float, float], trajectory: Trajectory,
) -> Scene:  # fmt: skip
    """The Scene of a solution, with everything that is shown."""
    top, shape, mu_s = rolling.top, request["shape"], request["mu_s"]
    drawn = shape if fits(shape, top) else None
    F_x, F_y, F_z = trajectory.force.T
    with np.errstate(divide="ignore"):
        ratio = np.hypot(F_x, F_y) / np.abs(F_z)
    force, omega, momentum = in_space(trajectory)
    theta = between(*turning, MESH_COLUMNS)
    inputs = request | {"K_J": constants.K_J, "K_R": constants.K_R, "energy": share, "E": constants.E}
    inputs |= {name: getattr(state, name) for name in STATE} | {name: getattr(top, name) for name in TOP}
    turns = float(state.omega3 * shape.scales.angular_velocity / (2 * np.pi))
    inputs |= {"spin": turns, "tilt": float(np.degrees(state.theta)), "slip": 1.0}
    return Scene(
        top=top, scales=shape.scales, mu_s=mu_s, constants=constants, lost=lost, share=share, marks=marks,
        state=state, rolling=rolling, plane=whole, turning=turning,
        curve=np.column_stack([theta, height(theta, top, constants)]), trajectory=trajectory,
        force=force, omega=omega, momentum=momentum, normal=F_z, ratio=ratio,
        regime=np.where(F_z < -AT_LIMIT, WOULD_LIFT, np.where(ratio > mu_s + AT_LIMIT, WOULD_SLIP, ROLLS)),
        K_J=trajectory.jellett / top.I1, K_R=trajectory.routh, E=trajectory.energy,
        upright_spin=float(omega3(0.0, top, constants)), profile=outline(top) if drawn is None else body(drawn),
        shape=drawn, inputs=MappingProxyType(inputs), notes=tuple(remarks(marks, drawn, turning[1], lost)),
    )  # fmt: skip


def remarks(marks: Marks, shape: Shape | None, theta_outer: float, lost: float) -> Iterator[str]:
    if lost > AT_LIMIT:
        yield say("controls.remarks.gripped", lost=lost)
    if shape is None:
        yield say("controls.remarks.stand_in")
    elif shape.touch_angle is not None and theta_outer > shape.touch_angle:
        yield say("controls.remarks.touches", angle=np.degrees(shape.touch_angle))
    if np.isnan(marks.lift):
        yield say("controls.remarks.lifts")
    elif np.isnan(marks.slip):
        yield say("controls.remarks.slips")
    elif np.isinf(marks.lift) and np.isinf(marks.slip):
        yield say("controls.remarks.unlimited")
