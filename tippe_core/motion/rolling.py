"""Motion on the rough plane: exact, for any length of time, by Fourier series of one nutation (nutation.py).

Q, of which dt = Q^-1/2 dkappa, is the divided difference of s^2 f over c1, c2 and c. Written out by the product rule of
divided differences, nothing cancels however near c1 and c2 are to each other: a steady precession is no special case.
"""

from decimal import Decimal, localcontext
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..errors import TopError
from ..paper.constants import EXACT, Constants, Exact, State, f1_2, f2_2, f3_2, versines
from ..paper.curve import ExactCurve, Well, near_pole, omega2_at, wells
from ..paper.forces import contact_force
from ..paper.top import Top
from ..types import Array, Complex, Number
from .nutation import NODES_MOST, Nutation
from .series import evaluate, part_turn
from .trajectory import Trajectory, checked_times


def roll(
    top: Top, constants: Constants | None, times: ArrayLike, start: State | str = "inner", well: int = 0
) -> Trajectory:
    """The motion without slipping at the given times: Trajectory. Exact to rounding for times of any length.

    constants: K_J, K_R and E, numbers; or None where start is a State.
    times: (n,) in (R/g)^1/2, in any order; the motion starts at times[0].
    start: "inner" or "outer" turning point, or a State. phi = psi = 0 and the contact point at the origin at times[0]
    unless the State says otherwise. well: the row of turning_points in which to move, where there are several (a State
    is in one of them already).
    Raises TopError (NoMotionError where the energy is below every well).
    """
    return Rolling(top, constants, start, well)(times)


class Rolling(Nutation):
    """The motion without slipping, for any times: arguments as in roll(); it starts at the times[0] of each call.

    period (of the nutation, in (R/g)^1/2), phi_advance and psi_advance (rad in a period);
    theta(times) alone, or called with times for the whole Trajectory.
    """

    def __init__(self, top: Top, constants: Constants | None, start: State | str = "inner", well: int = 0) -> None:
        self.top = top
        with localcontext(EXACT):
            if isinstance(start, State):
                curve, (inner, outer), here = _from_state(top, constants, start)
            else:
                curve, (inner, outer) = _from_constants(top, constants, start, well)
                here = inner if start == "inner" else outer
            exact, self._exact = curve.exact, (curve, inner, outer)
            self.gaps = float(curve.gaps[0]), float(curve.gaps[1])
            self.v1, self.v2, self.m1, self.m2 = (float(x) for x in (1 - inner, 1 - outer, 1 + inner, 1 + outer))
            self.width = float(inner - outer)
            self._place = float(inner - here) ** 0.5, float(here - outer) ** 0.5  # as sin(kappa/2), cos(kappa/2)
            self.e, self.K_J, self.K_R = float(exact.e), float(exact.K_J), float(exact.K_R)
        self._given = isinstance(start, State)
        self.start = start if isinstance(start, State) else State(0.0, 0.0, 0.0, 0.0)
        self._inward = self.start.theta_dot < 0

    def _h(self, v: Array, m: Array) -> Array:
        """Q^-1/2."""
        top, c, c1, c2 = self.top, 1 - v, 1 - self.v1, 1 - self.v2
        gamma, a = top.I3 / top.I1, top.a
        # second divided differences over (c1, c2, c), first ones over (c1, c2) and (c2, c), of y = f3,
        places = (c1, self.v1 * self.m1), (c2, self.v2 * self.m2), (c, v * m)
        y1, y2, y = (np.sqrt(f3_2(x, s2, top)) for x, s2 in places)
        y_12 = ((gamma - 1) * (c1 + c2) - 2 * gamma * a) / (y1 + y2)
        y_2c = ((gamma - 1) * (c2 + c) - 2 * gamma * a) / (y2 + y)
        y_12c = (gamma - 1 - y_12 * y_2c) / (y1 + y)
        # of 1/f3,
        r_12, r_2c = -y_12 / (y1 * y2), -y_2c / (y2 * y)
        r_12c = -(y_12c / y1 + r_12 * y_2c) / y
        # of B = K_J - (I3/I1) K_R (c - a)/f3,
        k = -gamma * self.K_R
        B_12, B_2c, B_12c = k * ((c1 - a) * r_12 + 1 / y2), k * ((c2 - a) * r_2c + 1 / y), k * ((c1 - a) * r_12c + r_2c)
        (B1, B2), B = self._bracket_ends, self._bracket(v, m)
        # of f2^2 B^2, and of s^2 (2E' - 2a(1 - c))
        F1, F_12, F_12c = f2_2(c1, self.v1 * self.m1, top), (1 - 1 / gamma) * (c1 + c2) - 2 * a, 1 - 1 / gamma
        kinetic = F1 * (B1 * B_12c + B_12 * B_2c + B_12c * B) + F_12 * B_2c * (B2 + B) + F_12c * B * B
        potential = -(self.e - 2 * a) - 2 * a * (c1 + c2 + c)
        Q = (kinetic - potential) / f1_2(c, top)
        if self.width == 0 and not np.all(Q > 0):
            return np.ones_like(Q)  # at rest on an unstable steady precession: any rate of kappa will do
        with np.errstate(invalid="ignore", divide="ignore"):
            return 1 / np.sqrt(Q)

    def _h_exact(self, ch: Array, sh: Array) -> Array:
        """dt/dkappa with the digits of EXACT."""
        curve, inner, outer = self._exact
        with localcontext(EXACT):
            c = [inner - (inner - outer) * Decimal(down) if down < up else outer + (inner - outer) * Decimal(up)
                 for up, down in zip((ch**2).tolist(), (sh**2).tolist(), strict=True)]  # fmt: skip
            return np.array([float(((inner - x) * (x - outer) * f1_2(x, curve.top) / curve.D(x)[0]).sqrt()) for x in c])

    def _bracket(self, v: Array, m: Array) -> Array:
        d, x, C = near_pole(v, m, self.top, self.K_R, self.gaps)
        return d + x * C

    @cached_property
    def _bracket_ends(self) -> Array:
        return self._bracket(np.array([self.v1, self.v2]), np.array([self.m1, self.m2]))

    def _too_near(self) -> TopError:
        if self._given:
            return TopError("theta", self.start.theta, f"a start whose nutation {NODES_MOST} nodes resolve",
                            "It is too near to an unstable steady precession, or f1 or f3 nearly vanishes in the "
                            "well; change the start a little.")  # fmt: skip
        E = (self.e + self.K_R**2 - self.top.I1 / self.top.I3 * self.K_J**2) / 2
        return TopError("E", E, f"an energy whose nutation {NODES_MOST} nodes resolve",
                        "It is too near to that of an unstable steady precession, or f1 or f3 nearly vanishes in the "
                        "well; change E a little.")  # fmt: skip

    def _slopes(self, v: Array, m: Array) -> list[Array]:
        gap, nearer, C = near_pole(v, m, self.top, self.K_R, self.gaps)
        B = gap + nearer * C
        with np.errstate(invalid="ignore", divide="ignore"):
            return [np.where(near, C, (B - d) / x)
                    for near, x, d in zip((v <= m, m <= v), (v, m), self.gaps, strict=True)]  # fmt: skip

    def _w3(self, v: Array, m: Array) -> Array:
        return self.K_R / np.sqrt(f3_2(1 - v, v * m, self.top))

    def _omega(self, ch: Array, sh: Array, v: Array, m: Array, h: Array) -> tuple[Array, Array, Array]:
        w2 = omega2_at(v, m, self.top, self.K_R, self.gaps)
        return self._w1(ch, sh, v, m, h), w2, self._w3(v, m)

    def _carried(self, ch: Array, sh: Array, v: Array, m: Array, h: Array) -> Complex:
        """The velocity of the contact point, (w2 c - w3 s, -w1) in the turning axes."""
        A = self._pole_factor(ch, sh, 0) * self._pole_factor(ch, sh, 1)
        w1, w2, w3 = self._omega(ch, sh, v, m, h)
        s = np.sqrt(v * m)
        direction = np.where(s > 0, A / np.where(s > 0, s, 1), 1)
        return direction * (w2 * (1 - v) - w3 * s - 1j * w1)

    def _state(  # type: ignore[override]  # more is its own
        self, turns: Array, half: Array, rest: Array
    ) -> dict[str, Number]:
        """And the contact point counted from phase 0."""
        mean, minus, _, forward, backward, constant = self._orientation
        rate = mean.sum()
        k = np.arange(1, len(minus) + 1)
        resonant = -round(rate)
        x = rate + resonant  # the one term of the velocity that may hardly turn, taken by itself
        amplitude = constant if resonant == 0 else 0.0
        denominators = []
        for sign, p in ((1, forward), (-1, backward)):
            turning = sign * k + rate
            hit = sign * k == resonant
            amplitude = p[hit][0] if hit.any() else amplitude
            denominators.append(np.where(hit, 0, p / np.where(hit, 1, turning)))
        ahead, back = denominators
        still = 0.0 if resonant == 0 else constant / rate
        now = super()._state(turns, half, rest, ahead - back)
        tau, (Y_re,) = np.pi * half + rest, now["more"]
        Y_im = evaluate(half, rest, (ahead + back)[None], cosine=True)[0]
        scale = self.period / (2 * np.pi)
        Y, Y0 = Y_re - 1j * (Y_im + still), -1j * ((ahead + back).sum() + still)
        part = part_turn(turns, x)
        whole = np.exp(2j * np.pi * part)
        periods = 2 * np.exp(1j * np.pi * part) * np.sin(np.pi * part) / x if x else 2 * np.pi * turns
        along = periods + whole * tau * np.exp(0.5j * x * tau) * np.sinc(x * tau / (2 * np.pi))
        contact = scale * (whole * np.exp(1j * rate * tau) * Y - Y0 + amplitude * along)
        return now | {"contact": contact}

    def __call__(self, times: ArrayLike) -> Trajectory:
        """The Trajectory at the times (n,)."""
        top, start, t = self.top, self.start, checked_times(times)
        first, now, d_phi = self._posed(t)
        x, y = start.x, start.y
        lean = 1j * first["s_exp_phi"][0] * np.exp(1j * d_phi) * top.a  # from the contact point to G
        origin = complex(0 if x is None else x - lean.real, 0 if y is None else y - lean.imag)
        contact = (now["contact"] - first["contact"][0]) * np.exp(1j * d_phi) + origin
        v, m = now["v"], now["m"]
        w = np.array(now["omega"])
        G = contact + 1j * now["s_exp_phi"] * np.exp(1j * d_phi) * top.a
        force = contact_force(v, m, top, self.K_R, w[0], w[0] ** 2, w[1], w[2])
        return Trajectory(
            top=top, t=t, theta=now["theta"], phi=now["phi"], psi=now["psi"],
            quaternion=now["quaternion"],
            contact=np.stack([contact.real, contact.imag], axis=1),
            com=np.stack([G.real, G.imag, 1 - top.a + top.a * v], axis=1),
            omega=w.T.copy(), slip=np.zeros((len(t), 2)), force=np.stack(force, axis=1),
            regime=np.full(len(t), "roll"))  # fmt: skip


def _from_constants(top: Top, constants: Constants | None, start: str, well: int) -> tuple[ExactCurve, Well]:
    if not isinstance(start, str) or start not in ("inner", "outer"):
        raise TopError("start", start, '"inner", "outer" or a State')
    if not isinstance(constants, Constants):
        raise TopError("constants", constants, "Constants(K_J, K_R, E)", "Only a State can stand in for them.")
    curve = ExactCurve(top, Exact.of(constants, top))
    found = wells(curve)
    if isinstance(well, bool) or not isinstance(well, (int, np.integer)) or well not in range(len(found)):
        raise TopError("well", well, f"0 to {len(found) - 1}, a row of turning_points")
    return curve, found[well]


def _from_state(top: Top, constants: Constants | None, state: State) -> tuple[ExactCurve, Well, Decimal]:
    exact = Exact.of_state(state, top)
    v, m = (float(x) for x in versines(state.theta))
    here = 1 - Decimal(v) if v <= m else Decimal(m) - 1
    rolling = {"vx": state.omega2 * (float(here) - top.a) - state.omega3 * np.sin(state.theta),
               "vy": -state.theta_dot * (1 - top.a * float(here))}  # fmt: skip
    for name, value in rolling.items():
        given = getattr(state, name)
        if given is not None and abs(given - value) > 1e-9 * max(1, abs(value)):
            raise TopError(name, given, f"{value:.10g}, G's velocity when the top rolls",
                           "Leave it out for a rolling top.")  # fmt: skip
    if constants is not None:
        if not isinstance(constants, Constants):
            raise TopError("constants", constants, "Constants(K_J, K_R, E), or None beside a State")
        own = Exact.of(constants, top)
        for name, one, other in (("K_J", own.K_J, exact.K_J), ("K_R", own.K_R, exact.K_R), ("2E'", own.e, exact.e)):
            if abs(one - other) > Decimal("1e-9") * max(Decimal(1), abs(other)):
                raise TopError(name, float(one), f"{float(other):.10g}, that of the State",
                               "Give None for the constants.")  # fmt: skip
    curve = ExactCurve(top, exact, rounded=False)
    if state.theta_dot == 0 and abs(curve.N(here)) < Decimal("1e-50") * max(Decimal(1), exact.K_J**2, exact.K_R**2):
        return curve, Well(here, here), here
    inner, outer = min(wells(curve), key=lambda w: max(here - w.inner, w.outer - here))
    return curve, Well(inner, outer), min(max(here, outer), inner)
