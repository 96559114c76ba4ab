"""Motion on the smooth plane (appendix B): exact, for any length of time, by the Fourier series of nutation.py.

There is no horizontal force: the horizontal velocity of G, w3 and L_z = I3 w3 c + I1 w2 s are constant. With
e = 2E - I3 w3^2, where E does not include the horizontal motion of G, c_dot^2 = s^2 theta_dot^2 is a cubic divided by
I1 + a^2 s^2:

    (I1 + a^2 s^2) theta_dot^2 = e - 2a(1 - c) - (L_z - I3 w3 c)^2/(I1 s^2) ,
    (I1 + a^2 s^2) c_dot^2 = P = s^2 [e - 2a(1 - c)] - (L_z - I3 w3 c)^2/I1 = (c1 - c)(c - c2) Q ,
    Q = e + (I3 w3)^2/I1 - 2a(1 - c - c1 - c2) ,

so with the kappa of nutation.py dt = [(I1 + a^2 s^2)/Q]^1/2 dkappa. The orientation near a pole is regular in the same
way: w2 = B/s with B = (L_z - I3 w3 c)/I1 = d + v I3 w3/I1, and at a pole theta_dot and w2 have the same moment of
inertia. The normal force is

    F_z = 1 + d^2/dt^2 (-a c) = {I1 + a [I1 c (w1^2 + w2^2) - I3 w3 s w2]}/(I1 + a^2 s^2) .
"""

from collections.abc import Callable
from dataclasses import replace
from decimal import Decimal, localcontext
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..compiled import compiled
from ..errors import TopError, checked
from ..paper import equations as eq
from ..paper.constants import EXACT, State, exact_place, exact_top, require_contact
from ..paper.search import zero
from ..paper.top import Top, TopNumbers
from ..paper.wells import exact_zero
from ..types import Array
from .nutation import Nodes, Nutation
from .phase import Ends, Pose, nearer_pole, theta_dot, v_and_m
from .trajectory import Trajectory, checked_times


@checked
def glide(top: Top, state: State, times: ArrayLike) -> Trajectory:
    """The motion on a smooth table at the given times. Exact to rounding error for any length of time.

    If the top leaves the table the Trajectory ends, with the event (time, "lifts off"), because the flight is not
    computed.

    Parameters
    ----------
    top : Top
        the top
    state : State
        at times[0]; x, y, vx, vy None mean that G is at the origin, at rest
    times : array (n,)
        in (R/g)^1/2, not decreasing

    Returns
    -------
    Trajectory
        at the times, up to a lift-off

    Raises
    ------
    TopError
        for bad input, and very close to motions that take infinitely long to leave an unstable steady precession
    """
    t = checked_times(times, forward=True)
    gliding = Gliding(top, state)
    lifts = gliding.lift_off
    moved = gliding(t[t - t[0] <= lifts])
    return moved if lifts > t[-1] - t[0] else replace(moved, events=((float(t[0] + lifts), "lifts off"),))


class Gliding(Nutation):
    """The motion on a smooth table as an object; arguments as in glide(), without the times.

    theta(t) as in Rolling. Calling the object with times gives the Trajectory beyond lift_off too, as if the table
    could pull.

    Parameters
    ----------
    top : Top
        the top
    state : State
        as in glide()

    Attributes
    ----------
    period, turning_points, phi_advance, psi_advance
        as in Rolling
    lift_off : float
        the time from the start to F_z = 0, in (R/g)^1/2; inf if that never happens
    L_z, L_3, E : float
        the constants: the components of the angular momentum about G along z and axis 3, M (gR^3)^1/2; the energy
        without the horizontal motion of G, MgR

    Raises
    ------
    TopError
        as glide()
    """

    @checked
    def __init__(self, top: Top, state: State) -> None:
        require_contact(top, state)
        self.top, self.start = top, state
        self._inward = state.theta_dot < 0
        with localcontext(EXACT):
            t, w1, w2, w3 = exact_top(top), *(Decimal(w) for w in (state.theta_dot, state.omega2, state.omega3))
            v, here, s2 = exact_place(state.theta)
            L3 = t.I3 * w3
            L_z, e = eq.L_z(here, s2.sqrt(), w2, w3, t), eq.two_E_smooth(s2, w1, w2, v, t)
            inner, outer = turning_cosines(t, e, L_z, L3, here, still=state.theta_dot == 0)
            offsets = (L_z - L3) / t.I1, (L_z + L3) / t.I1
            self.ends = Ends(*map(float, (1 - inner, 1 - outer, 1 + inner, 1 + outer, inner - outer, *offsets)))
            self._place = float(max(inner - here, Decimal(0))) ** 0.5, float(max(here - outer, Decimal(0))) ** 0.5
            self._Q_outer = float(e + L3 * L3 / t.I1 - 2 * t.a * (1 - inner - 2 * outer))
            self._B_slope = float(L3 / t.I1)
            self.E, self.L_z, self.L_3 = float(e + L3 * w3) / 2, float(L_z), float(L3)

    def _dt_dkappa(self, cos_half: Array, sin_half: Array, v: Array, m: Array) -> Array:
        return gliding_dt_dkappa(v, m, self.top.numbers, self._Q_outer, self.ends)

    def _exact_dt_dkappa(self, cos_half: Array, sin_half: Array) -> Array:
        return self._dt_dkappa(cos_half, sin_half, *v_and_m(cos_half, sin_half, self.ends))  # nothing cancels in Q

    def _too_near(self) -> TopError:
        return TopError("theta", self.start.theta, "a start further from an unstable steady precession",
                        "So near to it the nutation takes almost for ever; change the start a little.",
                        code="start-not-resolved")  # fmt: skip

    def _slopes(self, v: Array, m: Array) -> tuple[float, float]:
        slope = self._B_slope - self.start.omega3
        return slope, -slope

    def _omega(self, place: Nodes | Pose) -> Array:
        cos_half, sin_half, v, m, *_ = place
        dt_dkappa = self._dt_dkappa(cos_half, sin_half, v, m)
        return gliding_omega(cos_half, sin_half, v, m, dt_dkappa, self._B_slope, self.start.omega3, self.ends)

    @cached_property
    def lift_off(self) -> float:
        """The time from the start to F_z = 0, in (R/g)^1/2; inf if that never happens."""

        def F_z(t: Array) -> Array:
            moved, _ = self._pose(self._phases(np.append(0.0, t)), 0.0, 0.0)
            return gliding_normal_force(moved.v, moved.m, self._omega(moved), self.top.numbers)[1:]

        return first_below(F_z, self.period)

    def __call__(self, times: ArrayLike) -> Trajectory:
        """The Trajectory at the times (n,)."""
        top, start, t = self.top, self.start, checked_times(times)
        moved, _ = self._pose(self._phases(t), *self._turn_of_start)
        omega, drift = self._omega(moved), complex(start.vx or 0.0, start.vy or 0.0) * np.exp(1j * start.phi)
        G = complex(start.x or 0.0, start.y or 0.0) + drift * (t - t[0])
        contact = G - 1j * moved.s_exp_phi * top.a
        v, m, (w1, w2, w3) = moved.v, moved.m, omega.T
        s, c, velocity = np.sqrt(v * m), 1 - v, drift * np.exp(-1j * moved.phi)
        x, y = eq.rolling_velocity(c, s, w1, w2, w3, top)
        slip = velocity.real - x, velocity.imag - y
        none = np.zeros(len(t))
        return Trajectory(
            top=top, t=t, theta=moved.theta, phi=moved.phi, psi=moved.psi, quaternion=moved.quaternion,
            contact=np.stack([contact.real, contact.imag], axis=1),
            com=np.stack([G.real, G.imag, 1 - top.a + top.a * v], axis=1), omega=omega, slip=np.stack(slip, axis=1),
            force=np.stack([none, none, gliding_normal_force(v, m, omega, top.numbers)], axis=1),
            regime=np.full(len(t), "slip"), notes=self._notes(t))  # fmt: skip


# ---- the loops over nodes and times ----


@compiled
def gliding_dt_dkappa(v: Array, m: Array, top: TopNumbers, Q_outer: float, ends: Ends) -> Array:
    """[(I1 + a^2 s^2)/Q]^1/2 (n,) at v = 1 - c, m = 1 + c, (n,), from Q at the outer turning point."""
    found = np.empty(len(v))
    for i in range(len(v)):
        Q = Q_outer + 2 * top.a * (ends.v2 - v[i])
        if Q > 0:
            found[i] = np.sqrt((top.I1 + top.a**2 * v[i] * m[i]) / Q)
        else:  # at rest in an unstable steady precession any rate of kappa will do
            found[i] = 1.0 if ends.width == 0 else np.nan
    return found


@compiled
def gliding_omega(
    cos_half: Array, sin_half: Array, v: Array, m: Array, dt_dkappa: Array, B_slope: float, w3: float, ends: Ends
) -> Array:
    """(n, 3): omega about 1', 2', 3. B = d + v I3 w3/I1 = d - m I3 w3/I1, each with the d of its own pole."""
    w = np.empty((len(v), 3))
    for i in range(len(v)):
        side, x, d = nearer_pole(v[i], m[i], ends)
        w[i, 0] = theta_dot(cos_half[i], sin_half[i], v[i], m[i], dt_dkappa[i], ends.width)
        B, s = d + x * side * B_slope, np.sqrt(v[i] * m[i])
        w[i, 1] = B / s if s > 0 else 0.0
        w[i, 2] = w3
    return w


@compiled
def gliding_normal_force(v: Array, m: Array, omega: Array, top: TopNumbers) -> Array:
    """F_z (n,) = {I1 + a [I1 c (w1^2 + w2^2) - I3 w3 s w2]}/(I1 + a^2 s^2)"""
    a, I1, I3 = top.a, top.I1, top.I3
    F_z = np.empty(len(v))
    for i in range(len(v)):
        w1, w2, w3 = omega[i, 0], omega[i, 1], omega[i, 2]
        s, c = np.sqrt(v[i] * m[i]), 1 - v[i]
        F_z[i] = (I1 + a * (I1 * c * (w1 * w1 + w2 * w2) - I3 * w3 * s * w2)) / (I1 + a * a * s * s)
    return F_z


def turning_cosines(
    t: TopNumbers, e: Decimal, L_z: Decimal, L3: Decimal, here: Decimal, still: bool
) -> tuple[Decimal, Decimal]:
    """cos(theta) at the turning points, as Decimals: the zeros of P on both sides of here."""

    def P(c: Decimal) -> tuple[Decimal, Decimal]:
        B, rest = L_z - L3 * c, e - 2 * t.a * (1 - c)
        return ((1 - c * c) * rest - B * B / t.I1,
                -2 * c * rest + 2 * t.a * (1 - c * c) + 2 * L3 * B / t.I1)  # fmt: skip

    one = Decimal(1)
    if not still:
        inner = one if P(one)[0] == 0 and e > 0 else exact_zero(P, here, one, False)
        outer = -one if P(-one)[0] == 0 and e > 4 * t.a else exact_zero(P, -one, here, True)
        return inner, outer
    slope = P(here)[1]
    if slope == 0 or (abs(here) == 1 and slope * here > 0):
        return here, here
    # P = (c - here)(A c^2 + B c + C)
    A, square = -2 * t.a, -(e - 2 * t.a) - L3 * L3 / t.I1
    B = square + A * here
    C = 2 * t.a + 2 * L_z * L3 / t.I1 + B * here
    root = max(B * B - 4 * A * C, Decimal(0)).sqrt()
    q = -(B + root if B >= 0 else B - root) / 2
    zeros = [x for x in ([q / A] if A else []) + ([C / q] if q else []) if (x > here) == (slope > 0)]
    if not zeros:  # here is a double zero, and slope is its rounding
        return here, here
    other = min(zeros, key=lambda x: abs(x - here))
    return (max(min(other, one), here), here) if slope > 0 else (here, min(max(other, -one), here))


def zeros(function: Callable[[Array], Array], end: float) -> list[float]:
    """The times from 0 to end at which function(t (n,)) -> (n,) changes its sign, if not twice in end/512."""
    t = np.linspace(0, end, 513)
    changes = np.flatnonzero(np.diff(function(t) > 0))
    return [zero(lambda x: function(np.array([x]))[0], t[i], t[i + 1], ()) for i in changes]


def first_below(function: Callable[[Array], Array], period: float) -> float:
    """The first t >= 0 at which function(t (n,)) -> (n,), with the given period, falls below 0; inf if it never
    does."""
    t = np.linspace(0, period, 513)
    values = function(t)

    def crossing(times: Array, values: Array) -> float:
        i = int(np.argmax(values < 0))
        return 0.0 if i == 0 else zero(lambda x: function(np.array([x]))[0], times[i - 1], times[i], ())

    dips = np.flatnonzero((values[1:-1] < values[:-2]) & (values[1:-1] <= values[2:])) + 1
    first = int(np.argmax(values < 0)) if np.any(values < 0) else len(t)
    for i in dips[dips < first]:
        finer = np.linspace(t[i - 1], t[i + 1], 65)
        between = function(finer)
        if np.any(between < 0):
            return crossing(finer, between)
    return crossing(t, values) if first < len(t) else np.inf
