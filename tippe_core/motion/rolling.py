"""Motion on the rough plane: exact, for any length of time, by the Fourier series of one nutation (nutation.py).

dt/dkappa = Q^-1/2, where s^2 theta_dot^2 = (c1 - c)(c - c2) Q. In the form of paper/differences.py nothing cancels in
Q, however close c1 and c2 are: a steady precession is no special case.
"""

from decimal import Decimal, localcontext
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..compiled import compiled
from ..errors import TopError, checked
from ..paper import differences
from ..paper import equations as eq
from ..paper.constants import EXACT, Constants, Exact, State, exact_place, require_contact
from ..paper.differences import Place
from ..paper.poles import Floats, bracket_near, pole_slope, seen_from
from ..paper.top import Top, TopNumbers
from ..paper.wells import ExactCurve, Well, wells
from ..types import Array, Complex
from .nutation import Nodes, Nutation
from .phase import Ends, Pose, nearer_pole, pole_factor, theta_dot, v_and_m
from .track import Path, Track, path
from .trajectory import Trajectory, checked_times


@checked
def roll(
    top: Top, constants: Constants | None, times: ArrayLike, start: State | str = "inner", well: int = 0
) -> Trajectory:
    """The motion without slipping at the given times. Exact to rounding error for any length of time.

    Parameters
    ----------
    top : Top
        the top
    constants : Constants or None
        K_J, K_R and E (numbers); None if start is a State
    times : array (n,)
        in (R/g)^1/2, in any order; the motion starts at times[0]
    start : "inner", "outer" or State
        a turning point, or a State. At times[0] phi = psi = 0 and the contact point is at the origin, unless the
        State says otherwise
    well : int
        the row of turning_points() to which the motion belongs, if there are several (a State determines it)

    Returns
    -------
    Trajectory
        at the times

    Raises
    ------
    NoMotionError
        if the energy is below every well
    TopError
        for other bad input
    """
    return Rolling(top, constants, start, well)(times)


class Rolling(Nutation):
    """The motion without slipping as an object; arguments as in roll(), without the times.

    theta(t) gives theta alone, t since the start; calling the object with times gives the Trajectory, which starts at
    times[0].

    Parameters
    ----------
    top : Top
        the top
    constants : Constants or None
        as in roll()
    start : "inner", "outer" or State
        as in roll()
    well : int
        as in roll()

    Attributes
    ----------
    start : State
        at the start
    turning_points : array (2,)
        in rad
    period : float
        of the nutation, in (R/g)^1/2
    phi_advance, psi_advance : float
        rad in one period
    K_J, K_R, E : float
        the constants (30), (31) and (6)

    Raises
    ------
    TopError
        as roll()
    """

    @checked
    def __init__(self, top: Top, constants: Constants | None, start: State | str = "inner", well: int = 0) -> None:
        self.top = top
        with localcontext(EXACT):
            if isinstance(start, State):
                require_contact(top, start)
                curve, (inner, outer), here = _from_state(top, constants, start)
            else:
                curve, (inner, outer) = _from_constants(top, constants, start, well)
                here = inner if start == "inner" else outer
            exact, self._exact = curve.exact, (curve, inner, outer)
            self.ends = Ends(*map(float, (1 - inner, 1 - outer, 1 + inner, 1 + outer, inner - outer, *curve.offsets)))
            self._place = float(inner - here) ** 0.5, float(here - outer) ** 0.5
            self.e, self.K_J, self.K_R = float(exact.e), float(exact.K_J), float(exact.K_R)
            self.E = float(eq.E_of(exact.e, exact.K_J, exact.K_R, curve.top))
        self._curve = Floats(top.numbers, self.K_R, self.ends.upright, self.ends.inverted)
        self._given = start if isinstance(start, State) else None
        self._inward = isinstance(start, State) and start.theta_dot < 0

    @cached_property
    def start(self) -> State:  # type: ignore[override]
        """The State at the start: the one given, or that at the turning point with phi = psi = 0."""
        if self._given:
            return self._given
        at_inner = self._place[0] == 0
        cos_half, sin_half = (np.array([float(x)]) for x in (at_inner, not at_inner))
        v, m = v_and_m(cos_half, sin_half, self.ends)
        w1, w2, w3 = rolling_omega(cos_half, sin_half, v, m, self._dt_dkappa(cos_half, sin_half, v, m),
                                   self._curve, self.ends.width)[0]  # fmt: skip
        pole = v[0] * m[0] == 0
        return State(self.turning_points[0 if at_inner else 1], w1 if pole else 0.0, 0.0 if pole else w2, w3)

    def _dt_dkappa(self, cos_half: Array, sin_half: Array, v: Array, m: Array) -> Array:
        found = rolling_dt_dkappa(v, m, self._curve, self.e, self.ends)
        lost = np.isnan(found)  # next to an unstable pole rounding takes Q below 0
        if lost.any():
            found[lost] = self._exact_dt_dkappa(np.maximum(cos_half[lost], 1e-10), np.maximum(sin_half[lost], 1e-10))
        return found

    def _exact_dt_dkappa(self, cos_half: Array, sin_half: Array) -> Array:
        curve, inner, outer = self._exact
        with localcontext(EXACT):
            c = [inner - (inner - outer) * Decimal(down) if down < up else outer + (inner - outer) * Decimal(up)
                 for up, down in zip((cos_half**2).tolist(), (sin_half**2).tolist(), strict=True)]  # fmt: skip
            inverse_Q = [(inner - x) * (x - outer) * eq.f1_2(x, curve.top) / curve.D(x)[0] for x in c]
            return np.array([float(x.sqrt()) for x in inverse_Q])

    def _too_near(self) -> TopError:
        if self._given:
            return TopError("theta", self._given.theta, "a start further from an unstable steady precession",
                            "So near to it, or where f1 or f3 nearly vanishes in the well, the nutation takes almost "
                            "for ever; change the start a little.", code="start-not-resolved")  # fmt: skip
        return TopError("E", self.E, "an energy further from that of an unstable steady precession",
                        "So near to it, or where f1 or f3 nearly vanishes in the well, the nutation takes almost for "
                        "ever; change E a little.", code="energy-not-resolved")  # fmt: skip

    def _slopes(self, v: Array, m: Array) -> tuple[Array, Array]:
        return rolling_slopes(v, m, self._curve, self.ends)

    def _omega(self, place: Nodes | Pose) -> Array:
        cos_half, sin_half, v, m, *_ = place
        dt_dkappa = self._dt_dkappa(cos_half, sin_half, v, m)
        return rolling_omega(cos_half, sin_half, v, m, dt_dkappa, self._curve, self.ends.width)

    def _contact_velocity(self, nodes: Nodes) -> Complex:
        return contact_velocity(*nodes[:5], self._curve, self.ends)

    @cached_property
    def _track(self) -> Track:
        """The path of the contact point, by integrating its velocity term by term."""
        mean, _, (forward, backward), constant = self._orientation
        rate = float(mean.sum())
        k = np.arange(1, len(forward) + 1)
        resonant = -round(rate)
        amplitude = constant if resonant == 0 else 0.0
        shares = []
        for sign, coefficients in ((1, forward), (-1, backward)):
            hit = sign * k == resonant
            amplitude = float(coefficients[hit][0]) if hit.any() else amplitude
            shares.append(np.where(hit, 0, coefficients / np.where(hit, 1, sign * k + rate)))
        ahead, back = shares
        still = 0.0 if resonant == 0 else constant / rate
        return Track((ahead - back)[None], (ahead + back)[None],
                     Path(rate, rate + resonant, amplitude, still, self.period / (2 * np.pi)))  # fmt: skip

    def _more_series(self) -> tuple[Array, Array]:
        return self._track.sines, self._track.cosines

    @cached_property
    def _first(self) -> tuple[complex, complex]:
        """At the start: the contact point as computed by path(), and the vector from it to G."""
        phases, (d_phi, d_psi) = self._at_start, self._turn_of_start
        pose, (Y_re, Y_im) = self._pose(phases, d_phi, d_psi)
        return path(*phases, Y_re, Y_im, self._track.path, d_phi)[0], 1j * pose.s_exp_phi[0] * self.top.a

    def __call__(self, times: ArrayLike) -> Trajectory:
        """The Trajectory at the times (n,)."""
        top, start, t = self.top, self.start, checked_times(times)
        phases, (d_phi, d_psi), (first, lean) = self._phases(t), self._turn_of_start, self._first
        pose, (Y_re, Y_im) = self._pose(phases, d_phi, d_psi)
        origin = complex(0 if start.x is None else start.x - lean.real, 0 if start.y is None else start.y - lean.imag)
        contact = path(*phases, Y_re, Y_im, self._track.path, d_phi) + (origin - first)
        w = self._omega(pose)
        at, com, velocity, force = contact_and_force(pose.v, pose.m, w, contact, pose.s_exp_phi, top.numbers)
        return Trajectory(
            top=top, t=t, theta=pose.theta, phi=pose.phi, psi=pose.psi, quaternion=pose.quaternion,
            contact=at, com=com, velocity=velocity, omega=w, slip=np.zeros((len(t), 2)), force=force,
            regime=np.full(len(t), "roll"), notes=self._notes(t))  # fmt: skip


# ---- the loops over nodes and times ----


@compiled
def rolling_dt_dkappa(v: Array, m: Array, curve: Floats, e: float, ends: Ends) -> Array:
    """Q^-1/2 (n,) at v = 1 - c, m = 1 + c, (n,)."""
    inner, outer = place_at(ends.v1, ends.m1, curve), place_at(ends.v2, ends.m2, curve)
    found = np.empty(len(v))
    for i in range(len(v)):
        Q = differences.Q(inner, outer, place_at(v[i], m[i], curve), curve.K_R, e, curve.top)
        if Q > 0:
            found[i] = 1 / np.sqrt(Q)
        else:  # at rest in an unstable steady precession any rate of kappa will do
            found[i] = 1.0 if ends.width == 0 else np.nan
    return found


def place_at(v: float, m: float, curve: Floats) -> Place:
    """The Place in the form that differences.py uses."""
    c, s2 = 1 - v, v * m
    return Place(c, s2, np.sqrt(eq.f3_2(c, s2, curve.top)), bracket_at(v, m, curve)[0])


def bracket_at(v: float, m: float, curve: Floats) -> tuple[float, float]:
    """B of (36), which is s w2, without cancellation near the poles; and w3."""
    return bracket_near(1.0, v, curve) if v <= m else bracket_near(-1.0, m, curve)


@compiled
def rolling_omega(
    cos_half: Array, sin_half: Array, v: Array, m: Array, dt_dkappa: Array, curve: Floats, width: float
) -> Array:
    """(n, 3): omega about 1', 2', 3."""
    w = np.empty((len(v), 3))
    for i in range(len(v)):
        B, w[i, 2] = bracket_at(v[i], m[i], curve)
        s = np.sqrt(v[i] * m[i])
        w[i, 1] = B / s if s > 0 else 0.0
        w[i, 0] = theta_dot(cos_half[i], sin_half[i], v[i], m[i], dt_dkappa[i], width)
    return w


@compiled
def rolling_slopes(v: Array, m: Array, curve: Floats, ends: Ends) -> tuple[Array, Array]:
    """As half_sigma_rate() takes them, (n,) each."""
    minus, plus = np.empty(len(v)), np.empty(len(v))
    for i in range(len(v)):
        side, x, d = nearer_pole(v[i], m[i], ends)
        c, s2 = 1 - v[i], v[i] * m[i]
        w3 = eq.omega3(c, s2, curve.K_R, curve.top)
        C = pole_slope(x, np.sqrt(eq.f3_2(c, s2, curve.top)), side * w3, seen_from(side, curve.top))
        B = d + x * C
        minus[i] = (C if v[i] <= m[i] else (B - ends.upright) / v[i]) - w3  # (w2 s - d)/(1 - c) - w3
        plus[i] = (C if m[i] < v[i] else (B - ends.inverted) / m[i]) + w3
    return minus, plus


@compiled
def contact_velocity(
    cos_half: Array, sin_half: Array, v: Array, m: Array, dt_dkappa: Array, curve: Floats, ends: Ends
) -> Complex:
    """(n,): the velocity of the contact point, (w2 c - w3 s, -w1) in the rotating axes, over exp i(sigma_- +
    sigma_+)."""
    velocity = np.empty(len(v), np.complex128)
    w = rolling_omega(cos_half, sin_half, v, m, dt_dkappa, curve, ends.width)
    for i in range(len(v)):
        s = np.sqrt(v[i] * m[i])
        upright = pole_factor(cos_half[i], sin_half[i], ends.v1, ends.v2, ends.upright)
        inverted = pole_factor(cos_half[i], sin_half[i], ends.m1, ends.m2, ends.inverted)
        direction = upright * inverted / s if s > 0 else 1.0 + 0.0j
        velocity[i] = direction * complex(w[i, 1] * (1 - v[i]) - w[i, 2] * s, -w[i, 0])
    return velocity


@compiled
def contact_and_force(
    v: Array, m: Array, w: Array, contact: Complex, s_exp_phi: Complex, top: TopNumbers
) -> tuple[Array, Array, Array, Array]:
    """The contact point (n, 2), G and its velocity (n, 3), and the force (n, 3) in the rotating axes."""
    n = len(v)
    at, com, velocity, force = np.empty((n, 2)), np.empty((n, 3)), np.empty((n, 3)), np.empty((n, 3))
    for i in range(n):
        at[i, 0], at[i, 1] = contact[i].real, contact[i].imag
        # from the contact point to G
        com[i, 0], com[i, 1] = at[i, 0] - s_exp_phi[i].imag * top.a, at[i, 1] + s_exp_phi[i].real * top.a
        com[i, 2] = 1 - top.a + top.a * v[i]
        c, s, w1, w2, w3 = 1 - v[i], np.sqrt(v[i] * m[i]), w[i, 0], w[i, 1], w[i, 2]
        velocity[i, 0], velocity[i, 1] = eq.rolling_velocity(c, s, w1, w2, w3, top)
        velocity[i, 2] = top.a * s * w1
        force[i, 0], force[i, 1], force[i, 2] = eq.force(c, s, w1, w1 * w1, w2, w3, top)
    return at, com, velocity, force


# ---- the start of the motion ----


def _from_constants(top: Top, constants: Constants | None, start: str, well: int) -> tuple[ExactCurve, Well]:
    if start not in ("inner", "outer"):
        raise TopError("start", start, '"inner" | "outer" | State', code="wrong-kind")
    if constants is None:
        raise TopError("constants", constants, "Constants", code="wrong-kind")
    curve = ExactCurve(top, Exact.of(constants, top))
    found = wells(curve)
    if well not in range(len(found)):
        raise TopError("well", well, f"0 <= well <= {len(found) - 1}")
    return curve, found[well]


def _from_state(top: Top, constants: Constants | None, state: State) -> tuple[ExactCurve, Well, Decimal]:
    exact = Exact.of_state(state, top)
    _, here, _ = exact_place(state.theta)
    spins = state.theta_dot, state.omega2, state.omega3
    rolling = eq.rolling_velocity(float(here), np.sin(state.theta), *spins, top)
    for name, value in zip(("vx", "vy"), rolling, strict=True):
        given = getattr(state, name)
        if given is not None and abs(given - value) > 1e-9 * max(1, abs(value)):
            raise TopError(name, given, f"{value:.10g}", "Leave it out: it follows from rolling.", code="contradiction")
    if constants is not None:
        own = Exact.of(constants, top)
        for name, one, other in (("K_J", own.K_J, exact.K_J), ("K_R", own.K_R, exact.K_R), ("2E'", own.e, exact.e)):
            if abs(one - other) > Decimal("1e-9") * max(Decimal(1), abs(other)):
                raise TopError(name, float(one), f"{float(other):.10g}", "Give None: it follows from the State.",
                               code="contradiction")  # fmt: skip
    curve = ExactCurve(top, exact, rounded=False)
    if state.theta_dot == 0 and abs(curve.N(here)) < Decimal("1e-50") * max(Decimal(1), exact.K_J**2, exact.K_R**2):
        return curve, Well(here, here), here
    inner, outer = min(wells(curve), key=lambda w: max(here - w.inner, w.outer - here))
    return curve, Well(inner, outer), min(max(here, outer), inner)
