"""The view-model: what a person set -> one frozen Scene. The one file of the app that computes; it draws nothing.

Angles in rad; lengths in R, masses in M, accelerations in g, so times in (R/g)^1/2, forces in Mg, energies in MgR.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from types import MappingProxyType

import numpy as np
import param

from app.text import say, told
from tippe_core import (
    SUNK,
    Constants,
    Rolling,
    Scales,
    Shape,
    State,
    Tielines,
    Top,
    TopError,
    Trajectory,
    TruncatedSphere,
    figures,
    omega2,
    omega3,
    pole_constants,
    turning_points,
)
from tippe_core.paper.curve import f1_squared, f2_squared, rounded_f
from tippe_core.paper.forces import forces_on_curve
from tippe_core.types import Array, Indices, Scalars

ROLLS, SLIPS, LIFTS = 0, 1, 2
WORDS = ("rolls", "would slip here", "would lift off here")

NUTATIONS = 20
FRAMES_A_NUTATION = 64
MOST_FRAMES = 2400
# The picture between two frames is a turn about one axis, so a frame must not turn the top far.
MOST_TURN = 0.3

LEAST_TIELINES = 48
MESH_COLUMNS = 48
HOVER_COLUMNS = 96

# At its limit a motion rolls still: rounding is not to say otherwise.
AT_LIMIT = 1e-9
SAMPLES_A_NUTATION = 128
LEVELS = (0.15, 0.4, 0.7, 1.0, 2.0)
LEVEL_COLUMNS = 32
POTENTIAL_COLUMNS = 160

# Half of the third digit: the paper rounds appendix A's top to three, and with those it is the same body still.
ROUNDED = 5e-4
OUTLINE_POINTS = 96

# Beyond these the squares of what follows leave a float's range, or its digits the motion, and solving takes seconds.
LARGEST, LEAST_INERTIA = 1e6, 1e-12

# A limit that is never reached still needs a place on the energy slider: this share of the energy above the last one.
UNLIMITED = 0.25


@dataclass(frozen=True, eq=False, kw_only=True)
class Plane:
    """What Figs. 5 and 6 show of one top at one K_R and mu_s: all tielines, whatever motion is selected.

    K_J (n,) ascending; lift and slip are tippe_core's tielines over it under the two limits (F_z >= 0 alone, and with
    F_h <= mu_s F_z as well). theta, height (n, m): Fig. 5's mesh of f1^2 theta_dot^2 on the tielines of `surface`, a
    row from its own inner to its own outer turning point. hover_theta (k,), hover_K_J (j,): where hover_E and
    hover_ratio (j, k) are given: on each tieline of the slip limit its own motion, beyond its ends the motion of
    least energy that gets there.
    """

    K_J: Array
    lift: Tielines
    slip: Tielines
    surface: Tielines
    theta: Array
    height: Array
    K_J_range: tuple[float, float]
    theta_range: tuple[float, float]
    limit: str
    pole: float
    pole_height: float
    hover_theta: Array
    hover_K_J: Array
    hover_E: Array
    hover_ratio: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Marks:
    """The energies that the energy control is marked with, E; inf where nothing limits, nan where even the steady
    precession breaks the limit. nodes: the (3,) finite energies at which the control stands at 0, 1 and 2."""

    steady: float
    slip: float
    lift: float
    theta_steady: float
    nodes: Array

    def energy(self, share: float) -> float:
        """0 the steady precession, 1 the limit of friction, 2 that of F_z; straight on beyond 2, and below 0."""
        slopes = np.diff(self.nodes)
        if share < 0:
            return self.nodes[0] + share * (slopes[0] or slopes[1])
        if share > 2:
            return self.nodes[2] + (share - 2) * (slopes[1] or slopes[0])
        return float(np.interp(share, (0, 1, 2), self.nodes))

    def share(self, energy: float) -> float:
        """The inverse of energy(share)."""
        start, middle, end = self.nodes
        if energy < start:
            return (energy - start) / ((middle - start) or (end - start))
        if energy > end:
            return 2 + (energy - end) / ((end - middle) or (end - start))
        if middle > start and energy <= middle:
            return (energy - start) / (middle - start)
        return 1 + (energy - middle) / (end - middle) if end > middle else 1.0


@dataclass(frozen=True, eq=False, kw_only=True)
class Scene:
    """All that the views show. Trajectory arrays have one row a frame; vectors are along the axes of space.

    ratio is F_h/F_z; regime one of ROLLS, SLIPS, LIFTS a frame; upright_spin omega_3 at theta = 0; profile (k, 2) the
    radius of the body drawn and its height above O along axis 3; shape the body, None where a, I1, I3 were set apart
    from it, and then scales are still its R and M. messages: a sentence for each control that was given what cannot be;
    the rest of the scene is then the last good one. notes: sentences about what is shown.
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
    messages: MappingProxyType[str, str] = field(default_factory=lambda: MappingProxyType({}))
    notes: tuple[str, ...] = ()

    # What not every picture shows is computed when the first one asks.

    @cached_property
    def nutation(self) -> Trajectory:
        """One nutation from t = 0, closed: the Trajectory at SAMPLES_A_NUTATION + 1 equally spaced times."""
        return self.rolling(np.linspace(0, self.rolling.period, SAMPLES_A_NUTATION + 1))

    @cached_property
    def levels(self) -> list[tuple[Array, Array]]:
        """Motions of the same K_J and K_R at other energies, and one at LEVELS[i] of the marks: [(theta, theta_dot)],
        each theta ascending, theta_dot >= 0."""
        curves = []
        for share in LEVELS:
            constants = replace(self.constants, E=self.marks.energy(share))
            wells = turning_points(self.top, constants)
            inner, outer = wells[int(np.argmin(np.abs(wells - self.marks.theta_steady).min(axis=1)))]
            theta = between(inner, outer, LEVEL_COLUMNS)
            theta_dot = np.sqrt(np.maximum(rounded_f(theta, self.top, constants), 0))
            theta_dot[[0, -1]] = 0
            curves.append((theta, theta_dot))
        return curves

    @cached_property
    def potential(self) -> tuple[Array, Array]:
        """theta (n,) and the least energy there, E (n,): a motion turns where its energy is that."""
        inner, outer = self.turning
        reach = 0.6 * (outer - inner) + 0.05
        theta = np.linspace(max(inner - reach, 1e-3), min(outer + reach, np.pi - 1e-3), POTENTIAL_COLUMNS)
        return theta, least_energy(theta, self.top, self.constants.K_J, self.constants.K_R)

    @cached_property
    def rosette(self) -> tuple[float, float, float, float] | None:
        """Centre x, y and the least and largest distance of the track from it; None where the track goes straight on.

        A nutation turns the motion by phi_advance and moves it: together a turn about one point of the table.
        """
        track = self.nutation.contact @ (1, 1j)
        turn = np.exp(1j * self.rolling.phi_advance)
        if abs(1 - turn) < AT_LIMIT:
            return None
        centre = (track[-1] - turn * track[0]) / (1 - turn)
        away = np.abs(track - centre)
        return centre.real, centre.imag, away.min(), away.max()


class Explorer(param.Parameterized):
    """The controls. Several set in one `param.update` make one solve and one `scene` event.

    The motion has three faces, GIVEN: what was set last is what it is given by, and the inputs of the other two then
    follow to the last digit, so that each may be changed next. To put back what was: set `given` and its inputs.
    """

    K_J = param.Number(7.0, doc="Jellett's constant, in (g/R)^1/2")
    K_R = param.Number(10.0, doc="Routh's constant, in (MR^2)^1/2 (g/R)^1/2")
    energy = param.Number(0.9, doc="0 the steady precession, 1 the limit of friction, 2 the limit F_z = 0")
    E = param.Number(0.0, doc="the energy itself, in MgR")
    theta = param.Number(0.0, doc="the tilt at t = 0, in rad")
    theta_dot = param.Number(0.0, doc="its rate, in (g/R)^1/2")
    omega2 = param.Number(0.0, doc="the angular velocity about 2' at t = 0, in (g/R)^1/2")
    omega3 = param.Number(0.0, doc="the angular velocity about the axis of symmetry at t = 0, in (g/R)^1/2")
    phi = param.Number(0.0, doc="the azimuth of 1' at t = 0, in rad")
    psi = param.Number(0.0, doc="the turn about the axis of symmetry at t = 0, in rad")
    given: param.Selector[str] = param.Selector(
        default="share", objects=["share", "E", "state"], doc="which of GIVEN holds"
    )
    mu_s = param.Number(0.5, doc="coefficient of static friction")
    a = param.Number(0.070, doc="distance of G below the centre O of the sphere, in R")
    I1 = param.Number(0.399, doc="moment of inertia about an axis through G across the axis of symmetry, in MR^2")
    I3 = param.Number(0.408, doc="moment of inertia about the axis of symmetry, in MR^2")
    shape = param.ClassSelector(
        class_=Shape, default=TruncatedSphere.paper(), allow_None=False, doc="the body; a, I1, I3 are set with it"
    )
    upper = param.Boolean(True, doc="show the upper hemisphere, like the paper, or all of (0, pi)")
    limit: param.Selector[str] = param.Selector(
        default="lift-off", objects=["lift-off", "slip"], doc="which limit Fig. 5 is drawn at"
    )
    face: param.Selector[str] = param.Selector(
        default="constants", objects=["constants", "state"], doc="which face the controls show; it changes nothing else"
    )
    cursor = param.Number(0.0, doc="the time looked at, in (R/g)^1/2; moving it solves nothing")
    # __init__ makes the first one
    scene: param.ClassSelector[Scene] = param.ClassSelector(  # type: ignore[assignment]
        class_=Scene, constant=True, doc="the last solution"
    )

    GIVEN = MappingProxyType(
        {
            "share": ("K_J", "K_R", "energy"),
            "E": ("K_J", "K_R", "E"),
            "state": ("theta", "theta_dot", "omega2", "omega3", "phi", "psi"),
        }
    )
    INPUTS = ("K_J", "K_R", "mu_s", "energy", "a", "I1", "I3")

    def __init__(self, **inputs: object) -> None:
        super().__init__(**inputs)  # type: ignore[no-untyped-call]  # of param
        self._following = False
        motion = {name for names in self.GIVEN.values() for name in names}
        self.param.watch(self._on_inputs, [*motion, "given", "mu_s", "a", "I1", "I3", "shape", "upper", "limit"])
        self._solve()

    def _on_inputs(self, *events: param.parameterized.Event) -> None:
        if self._following:
            return
        changed = {event.name for event in events}
        if "given" not in changed:
            by = (("state", self.GIVEN["state"]), ("E", ("E",)), ("share", self.GIVEN["share"]))
            given = next((given for given, names in by if changed & set(names)), self.given)
            if given != self.given:
                self._follow(given=given)
        self._solve()

    def _follow(self, **values: object) -> None:
        self._following = True
        try:
            with param.edit_constant(self):
                self.param.update(**values)
        finally:
            self._following = False

    def _solve(self) -> None:
        try:
            state = {name: getattr(self, name) for name in self.GIVEN["state"]}
            scene = solve(
                Top(self.a, self.I1, self.I3),
                self.K_J,
                self.K_R,
                self.mu_s,
                self.energy,
                self.upper,
                self.limit,
                self.shape,
                E=self.E if self.given == "E" else None,
                state=State(**state) if self.given == "state" else None,
            )
        except TopError as error:
            if self.scene is None:
                raise
            control = {"E": "energy"}.get(error.name, error.name)
            self._follow(scene=replace(self.scene, messages=MappingProxyType({control: told(error)})))
            return
        found = {"energy": scene.share} | {name: getattr(scene.constants, name) for name in self.GIVEN["E"]}
        found |= {name: getattr(scene.state, name) for name in self.GIVEN["state"]}
        self._follow(
            scene=scene, **{name: value for name, value in found.items() if name not in self.GIVEN[self.given]}
        )


def solve(
    top: Top,
    K_J: float,
    K_R: float,
    mu_s: float,
    share: float,
    upper: bool = True,
    limit: str = "lift-off",
    shape: Shape | None = None,
    *,
    E: float | None = None,
    state: State | None = None,
) -> Scene:
    """The Scene of one top and one motion; shape: the body, appendix A's where none is given.

    E, where given, is the energy, whatever the share; state, where given, the motion at t = 0, whatever the constants.
    Raises TopError, whose name is the input at fault.
    """
    shape = shape or TruncatedSphere.paper()
    drawn = shape if fits(shape, top) else None
    if state is not None:
        constants = Constants.from_state(top, state.theta, state.theta_dot, state.omega2, state.omega3)
        K_J, K_R, E = float(constants.K_J), float(constants.K_R), float(constants.E)
    for name, value in {"K_J": K_J, "K_R": K_R, "mu_s": mu_s, "E": share if E is None else E}.items():
        if not abs(value) <= LARGEST:
            raise TopError(name, value, "at most {most:g} either way", "No top is ever so fast, no table so rough.",
                           code="too-large", most=LARGEST)  # fmt: skip
    for name, least, unit in (("a", -LARGEST, "R"), ("I1", LEAST_INERTIA, "MR^2"), ("I3", LEAST_INERTIA, "MR^2")):
        if not least <= (value := getattr(top, name)) <= LARGEST:
            raise TopError(name, value, "{least:g} to {most:g} ({unit})", "No body is so thin, or so wide.",
                           code="no-such-body", least=least, most=LARGEST, unit=unit)  # fmt: skip
    marks = energy_marks(top, K_J, K_R, mu_s)
    if E is None:
        E = marks.energy(share)
    elif state is not None:
        share = max(marks.share(E), 0.0)  # rounding may leave a steady precession below itself
    else:
        share = marks.share(E)
    if share < 0 or not np.isfinite(share):
        raise TopError(
            "E",
            E,
            "E >= {least:.10g} MgR at K_J = {K_J:g} and K_R = {K_R:g}",
            "Below the steady precession there is no motion: move the energy up.",
            code="no-motion",
            least=float(f"{marks.steady:.6g}"),
            K_J=K_J,
            K_R=K_R,
        )
    constants = Constants(K_J, K_R, E)
    if state is not None:
        rolling = Rolling(top, None, start=state)
        inner, outer = rolling.turning_points
    else:
        wells = turning_points(top, constants)
        well = int(np.argmin(np.abs(wells - marks.theta_steady).min(axis=1)))
        inner, outer = wells[well]
        rolling = Rolling(top, constants, well=well)
    trajectory = rolling(frame_times(rolling.period, top, constants))

    F_x, F_y, F_z = trajectory.force.T
    with np.errstate(divide="ignore"):
        ratio = np.hypot(F_x, F_y) / np.abs(F_z)
    if state is None:
        theta, (w1, w2, w3) = trajectory.theta[0], trajectory.omega[0]
        state = State(theta, w1, w2 if 0 < theta < np.pi else 0.0, w3)
    nodal, across, axis, towards = axes(trajectory.theta, trajectory.phi)
    w1, w2, w3 = (component[:, None] for component in trajectory.omega.T)
    theta = between(inner, outer, MESH_COLUMNS)
    return Scene(
        top=top,
        scales=shape.scales,
        mu_s=mu_s,
        constants=constants,
        share=share,
        marks=marks,
        state=state,
        rolling=rolling,
        plane=plane(top, K_R, mu_s, upper, limit, *K_J_range(top, K_J, K_R, upper)),
        turning=(float(inner), float(outer)),
        curve=np.column_stack([theta, height(theta, top, constants)]),
        trajectory=trajectory,
        force=F_x[:, None] * nodal + F_y[:, None] * across + F_z[:, None] * (0, 0, 1),
        omega=w1 * nodal + w2 * towards + w3 * axis,
        momentum=top.I1 * (w1 * nodal + w2 * towards) + top.I3 * w3 * axis,
        normal=F_z,
        ratio=ratio,
        regime=np.where(F_z < -AT_LIMIT, LIFTS, np.where(ratio > mu_s + AT_LIMIT, SLIPS, ROLLS)),
        K_J=trajectory.jellett / top.I1,
        K_R=trajectory.routh,
        E=trajectory.energy,
        upright_spin=float(omega3(0.0, top, constants)),
        profile=outline(top) if drawn is None else body(drawn),
        shape=drawn,
        notes=tuple(remarks(marks, drawn, float(outer))),
    )


def energy_marks(top: Top, K_J: float, K_R: float, mu_s: float) -> Marks:
    lift, slip = figures(top, [K_J], K_R, mu_s)
    steady, E_slip, E_lift = float(lift.E_steady[0]), float(slip.E[0]), float(lift.E[0])
    nodes = [steady]
    for E in (E_slip, E_lift):
        if np.isnan(E):
            E = nodes[-1]
        elif not E < steady + LARGEST * (1 + abs(steady)):  # no limit, or one that no top ever reaches
            E = nodes[-1] + UNLIMITED * (1 + abs(steady))
        nodes.append(max(E, nodes[-1]))  # rounding may put a limit below what it is a limit of
    if nodes[2] == nodes[0]:
        nodes[2] += UNLIMITED * (1 + abs(steady))
    return Marks(
        steady=steady, slip=E_slip, lift=E_lift, theta_steady=float(lift.theta_steady[0]), nodes=np.array(nodes)
    )


def frame_times(period: float, top: Top, constants: Constants) -> Array:
    """Some nutations in frames of equal length, short enough that the top turns little between two; (n,)."""
    # (33) bounds the spin: no component is larger than this.
    fastest = float(np.sqrt((2 * abs(float(constants.E)) + 4 * abs(top.a)) / min(top.I1, top.I3)))
    step = min(period / FRAMES_A_NUTATION, MOST_TURN / fastest)
    frames = min(round(NUTATIONS * period / step), MOST_FRAMES)
    return step * np.arange(frames + 1.0)


def axes(theta: Array, phi: Array) -> tuple[Array, Array, Array, Array]:
    """The axes 1', y, 3 and 2' in space, each (n, 3)."""
    zero, s, c = np.zeros_like(theta), np.sin(theta)[:, None], np.cos(theta)[:, None]
    nodal = np.column_stack([np.cos(phi), np.sin(phi), zero])
    across = np.column_stack([-np.sin(phi), np.cos(phi), zero])
    up = np.array([0.0, 0.0, 1.0])
    return nodal, across, c * up - s * across, s * up + c * across


def fits(shape: Shape, top: Top) -> bool:
    """Whether a, I1 and I3 are the shape's, to the three digits of appendix A."""
    own = shape.top
    return max(abs(own.a - top.a), abs(own.I1 - top.I1), abs(own.I3 - top.I3)) < ROUNDED


@lru_cache(maxsize=8)
def body(shape: Shape) -> Array:
    """The shape's outline, (radius, height above O along axis 3) in R, (k, 2)."""
    return shape.profile(max(OUTLINE_POINTS, len(shape.solid.outline) + 1)) / shape.R


def second_part(shape: Shape | None) -> str:
    """What of a body touches beside the ball: "stem" where that is the end of a stem, or nothing, else "rim"."""
    if shape is None or shape.edge is None:
        return "stem"
    radius, height, rounding = shape.edge
    ends = height + rounding > body(shape)[:, 1].max() - SUNK
    return "stem" if ends and radius + rounding < 1 else "rim"


def outline(top: Top) -> Array:
    """A stand-in for the body of a top of which only a, I1 and I3 are known, like body(shape).

    Only the sphere that rolls is certain, so a tippe top is drawn as a whole ball, and a top with G above O as
    a disc on a round peg.
    """
    angle = np.linspace(0, np.pi, 60)
    ball = np.column_stack([np.sin(angle), -np.cos(angle)])
    if top.a >= -0.3:
        return ball
    disc = -top.a + np.array([-0.15, -0.15, 0.15, 0.15])
    wide = max(1.2, 1.5 * top.I3**0.5)
    return np.vstack(
        [
            ball[:50],
            [
                [0.2, disc[0]],
                [wide, disc[1]],
                [wide, disc[2]],
                [0.15, disc[3]],
                [0.15, disc[3] + 0.6],
                [0, disc[3] + 0.6],
            ],
        ]
    )


def between(inner: Scalars, outer: Scalars, columns: int) -> Array:
    """Angles from inner to outer, closer together towards the ends; (..., columns)."""
    share = (1 - np.cos(np.linspace(0, np.pi, columns))) / 2
    inner, outer = np.asarray(inner)[..., None], np.asarray(outer)[..., None]
    return inner + (outer - inner) * share


def height(theta: Array, top: Top, constants: Constants) -> Array:
    """f1^2 theta_dot^2 of (36), and 0 at the ends of the last axis where they are turning points in (0, pi)."""
    value = f1_squared(theta, top) * rounded_f(theta, top, constants)
    return np.maximum(value, 0)


def K_J_range(top: Top, K_J: float, K_R: float, upper: bool) -> tuple[float, float]:
    """From 0 to P for the upper hemisphere, like the paper; else past both poles; in any case as far as K_J."""
    poles = pole_constants(top, K_R)
    beyond = 0.25 * max(map(abs, poles))
    low, high = sorted((0.0, poles[0])) if upper else (min(poles) - beyond, max(poles) + beyond)
    if high - low < 1e-9:
        low, high = -1.0, 1.0
    # In whole steps, so that a K_J that moves outside does not change the picture each time.
    if K_J < low:
        low = float(np.floor(K_J - 0.5))
    if K_J > high:
        high = float(np.ceil(K_J + 0.5))
    return float(low), float(high)


@lru_cache(maxsize=8)
def plane(top: Top, K_R: float, mu_s: float, upper: bool, limit: str, low: float, high: float) -> Plane:
    """The Plane. The same arguments give the same object, so a view can tell by identity that nothing changed."""
    poles = pole_constants(top, K_R)
    step = 2.0 ** np.floor(np.log2((high - low) / LEAST_TIELINES))
    even = step * np.arange(np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9) + 1)
    K_J = np.union1d(even, [pole for pole in poles if low <= pole <= high])
    lift, slip = figures(top, K_J, K_R, mu_s)
    surface = lift if limit == "lift-off" else slip

    limited = np.isfinite(surface.E)
    theta = between(surface.theta_inner, surface.theta_outer, MESH_COLUMNS)
    rows = Constants(K_J[:, None], K_R, np.where(limited, surface.E, surface.E_steady)[:, None])
    heights = np.where(limited[:, None], height(theta, top, rows), np.nan)

    theta_end = max(np.pi / 2, np.nanmax(lift.theta_outer, initial=0.0)) * 1.03 if upper else np.pi
    hover_theta = theta_end * (np.arange(HOVER_COLUMNS) + 0.5) / HOVER_COLUMNS
    own = np.isin(K_J, even)
    hover_E, hover_ratio = everywhere(top, hover_theta, K_J[own], K_R, slip.E[own])
    pole = poles[0]
    at_pole = np.flatnonzero(K_J == pole)
    return Plane(
        K_J=K_J,
        lift=lift,
        slip=slip,
        surface=surface,
        theta=theta,
        height=heights,
        K_J_range=(low, high),
        theta_range=(0.0, float(theta_end)),
        limit=limit,
        pole=float(pole),
        pole_height=float(heights[at_pole].max(initial=0.0)) if at_pole.size else 0.0,
        hover_theta=hover_theta,
        hover_K_J=even,
        hover_E=hover_E,
        hover_ratio=hover_ratio,
    )


def least_energy(theta: Array, top: Top, K_J: Scalars, K_R: Scalars) -> Array:
    """E of the motion that turns at theta: (33) with theta_dot = 0, 2E' = 2a(1 - c) + f2^2 w2^2."""
    w2 = omega2(theta, top, Constants(K_J, K_R, 0.0))
    two_E_prime = 2 * top.a * (1 - np.cos(theta)) + f2_squared(theta, top) * w2**2
    return (two_E_prime + K_R**2 - top.I1 / top.I3 * K_J**2) / 2


def everywhere(top: Top, theta: Array, K_J: Array, K_R: float, E_limit: Array) -> tuple[Array, Array]:
    """E and F_h/F_z at (K_J, theta), each (len(K_J), len(theta)); F_h/F_z is inf where F_z <= 0."""
    theta, K_J = theta[None, :], K_J[:, None]
    E = np.fmax(least_energy(theta, top, K_J, K_R), np.where(np.isfinite(E_limit), E_limit, np.nan)[:, None])
    constants = Constants(K_J, K_R, E)
    # At the turning point itself rounding may leave f just below 0, where there is no theta_dot.
    w1_squared = np.maximum(rounded_f(theta, top, constants), 0)
    F_x, F_y, F_z = forces_on_curve(theta, top, constants, w1_squared)
    with np.errstate(divide="ignore", invalid="ignore"):
        return E, np.where(F_z > 0, np.hypot(F_x, F_y) / F_z, np.inf)


def remarks(marks: Marks, shape: Shape | None, theta_outer: float) -> Iterator[str]:
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
