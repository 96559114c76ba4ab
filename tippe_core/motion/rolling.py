"""Motion on the rough plane: exact, for any length of time, by Fourier series of one nutation.

With c = cos(theta), c_dot^2 = s^2 f is analytic between its zeros c1 (inner) and c2 (outer). On c = (c1 + c2)/2 +
(c1 - c2)/2 cos(kappa) it becomes kappa_dot^2 = Q, where s^2 f = (c1 - c)(c - c2) Q, so dt = h dkappa with h = Q^-1/2
smooth and periodic. Q is the divided difference of s^2 f over c1, c2 and c. Written out by the product rule of divided
differences, nothing cancels however near c1 and c2 are to each other: a steady precession is no special case.

Where Q nearly vanishes, wells are about to merge or an unstable steady precession is near; then the nodes are crowded
there by a change of variable from kappa to eta, otherwise the same.

Integrals over eta by the midpoint rule converge geometrically, and so do the Fourier coefficients in the phase
tau = 2 pi t/T, for which kappa need not be inverted: the coefficient of sin(k tau) in kappa - tau is
2/(pi k) times the integral of cos(k tau(kappa)) from 0 to pi (Bessel's solution of Kepler's equation).

Near a pole phi and psi turn by nearly pi at once, and at the pole they mean nothing. With v = 1 - c, m = 1 + c,

    q_x + i q_y = sin(theta/2) exp i(phi - psi)/2 = (v1^1/2 cos(kappa/2) +- i v2^1/2 sin(kappa/2)) 2^-1/2 exp i sigma_-
    q_w + i q_z = cos(theta/2) exp i(phi + psi)/2 = (m1^1/2 cos(kappa/2) +- i m2^1/2 sin(kappa/2)) 2^-1/2 exp i sigma_+

(the sign that of d, see curve.py) take all of that turn into the first factor, exactly, because f1 = f2 at the poles;
the rates of sigma_- and sigma_+ are smooth for every trajectory, also through a pole. So is the velocity of the contact
point.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from decimal import Decimal, localcontext
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike
from scipy.fft import dct, dst

from ..errors import TopError
from ..paper.constants import EXACT, Constants, Exact, State, versines
from ..paper.equations import f1_2, f2_2, f3_2
from ..paper.forces import contact_force
from ..paper.poles import near_pole, omega2_at
from ..paper.top import Top
from ..paper.wells import ExactCurve, Well, wells
from ..types import Array, Complex, Indices, Number, Scalars
from .trajectory import Trajectory, checked_times

_NODES_LEAST, _NODES_MOST = 32, 2**12  # enough for energies within 1e-9 of that of a merging
_FEW, _MANY = 64, 512  # harmonics: up to so many each by itself; at once
# cos(kappa/2), sin(kappa/2), v, m, h, dkappa/deta; and of sigma: its turn by whole periods, the rest, what was left out
Nodes: TypeAlias = tuple[Array, Array, Array, Array, Array, Array]
Sigma: TypeAlias = tuple[Array, Array, Array]


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


class Nutation(ABC):
    """A motion whose c_dot^2 is analytic between two turning points, as a function of time since its start."""

    top: Top
    start: State
    v1: float  # of the turning points
    v2: float
    m1: float
    m2: float
    width: float
    gaps: tuple[float, float]  # d at both poles
    _inward: bool  # whether theta falls at first
    _place: tuple[float, float]  # as sin(kappa/2), cos(kappa/2) at the start

    @abstractmethod
    def _h(self, v: Array, m: Array) -> Array:
        """dt/dkappa at v = 1 - c, m = 1 + c."""

    @abstractmethod
    def _h_exact(self, ch: Array, sh: Array) -> Array:
        """dt/dkappa with all figures, at cos(kappa/2) and sin(kappa/2)."""

    @abstractmethod
    def _slopes(self, v: Array, m: Array) -> Sequence[Scalars]:
        """(w2 s - d)/(1 -+ c) at the poles."""

    @abstractmethod
    def _w3(self, v: Array, m: Array) -> Scalars:
        """omega_3."""

    @abstractmethod
    def _omega(self, ch: Array, sh: Array, v: Array, m: Array, h: Array) -> tuple[Array, Array, Array]:
        """omega about 1', 2', 3."""

    @abstractmethod
    def _too_near(self) -> TopError:
        """The error to raise."""

    # ---- one nutation, on nodes in kappa ----

    @cached_property
    def _map(self) -> tuple[float, float, float, float] | None:
        """y0, eps, alpha, x0 of cos(kappa) = y0 + eps sinh(alpha (cos(eta) - x0)), or None where kappa = eta will do.

        Where Q nearly vanishes in the well or at an end of it, wells are about to merge or a steady precession is
        unstable nearby. Seen from cos(kappa) = y0 its zeros are then eps away; in eta they are 1/log(1/eps) away.
        """
        ch, sh, _, _, h, _ = self._plain
        if self.width == 0 or h.max() < 3 * h.min():
            return None

        def Q(y: Array) -> Array:
            up, down = np.maximum((1 + y) / 2, 1e-20), np.maximum((1 - y) / 2, 1e-20)
            return 1 / self._h_exact(np.sqrt(up), np.sqrt(down)) ** 2

        y = np.concatenate([[1], ch**2 - sh**2, [-1]])
        values = Q(y)
        i = int(values.argmin())
        y0 = y[i]
        if i in (0, len(y) - 1):
            low, near = Q(np.array([y0, y0 * (1 - 1e-4)]))
            eps = 1e-4 * low / (near - low)
        else:
            for step in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6):
                left, low, right = Q(np.clip(y0 + step * np.array([-1, 0, 1]), -1, 1))
                curvature = (left - 2 * low + right) / step**2
                y0 += np.clip((left - right) / (2 * step * curvature), -10 * step, 10 * step)
            eps = np.sqrt(2 * low / curvature) if curvature > 0 else 1
        if not 0 < eps < 0.2:
            return None
        ends = np.arcsinh((1 - y0) / eps), np.arcsinh((1 + y0) / eps)
        alpha = sum(ends) / 2
        return y0, eps, alpha, (ends[1] - ends[0]) / (2 * alpha)

    def _nodes(self, n: int) -> Nodes:
        """n midpoints of eta in (0, pi): (cos(kappa/2), sin(kappa/2)), v, m, h, dkappa/deta."""
        if n == _NODES_LEAST and not self._map:
            return self._plain
        if n not in self._crowded:  # time, kappa and orientation ask for the same ones, and exact ones are slow
            self._crowded[n] = self._exact_nodes(n)
        return self._crowded[n]

    @cached_property
    def _crowded(self) -> dict[int, Nodes]:
        return {}

    def _exact_nodes(self, n: int) -> Nodes:
        half = (np.arange(n) + 0.5) * (np.pi / (2 * n))
        ch, sh, stretch = np.cos(half), np.sin(half), np.ones(n)
        if self._map:
            _, eps, alpha, x0 = self._map
            x, up, down = np.cos(2 * half), ch**2, sh**2
            ch, sh = (np.sqrt(eps * np.cosh(alpha * (middle - x0)) * np.sinh(alpha * part))
                      for middle, part in (((x - 1) / 2, up), ((x + 1) / 2, down)))  # fmt: skip
            stretch = eps * alpha * np.cosh(alpha * (x - x0)) * np.sqrt(up * down) / (sh * ch)
        # where Q nearly vanishes its terms cancel after all
        return ch, sh, *self._versines(ch, sh), self._h_exact(ch, sh), stretch

    @cached_property
    def _plain(self) -> Nodes:
        """The least nodes, with kappa = eta."""
        half = (np.arange(_NODES_LEAST) + 0.5) * (np.pi / (2 * _NODES_LEAST))
        ch, sh = np.cos(half), np.sin(half)
        v, m = self._versines(ch, sh)
        return ch, sh, v, m, self._h(v, m), np.ones(_NODES_LEAST)

    def _eta(self, sine: float, cosine: float) -> tuple[float, float]:
        """What sin(eta/2) and cos(eta/2) are as, where sin(kappa/2) and cos(kappa/2) are as sine and cosine."""
        if not self._map:
            return sine, cosine
        y0, eps, _, _ = self._map
        whole = sine**2 + cosine**2

        def part(
            share: float, end: float
        ) -> float:  # alpha times the distance of cos(eta) to an end, from that of cos(kappa), 2 share
            p = end / eps
            q = p - 2 * share / whole / eps
            if p * q > 0:
                return np.arcsinh((p - q) * (p + q) / (p * np.hypot(1, q) + q * np.hypot(1, p)))
            return np.arcsinh(p) - np.arcsinh(q)

        return np.sqrt(part(sine**2, 1 - y0)), np.sqrt(part(cosine**2, 1 + y0))

    def _resolved(self, n: int, *rates: Array) -> tuple[bool, Array]:
        """Whether n midpoints resolve even periodic functions of kappa; and their cosine coefficients."""
        coefficients = dct(np.array(rates), type=2, axis=1) / n
        size = np.abs(coefficients)
        tail, noise = size[:, n // 2 :].max(axis=1), size[:, 7 * n // 8 :].max(axis=1)
        scale = np.maximum(size.max(axis=1), size[0].max())
        flat = (noise > tail / 8) & (tail < 1e-11 * scale)
        return bool(np.all((tail < 1e-15 * scale) | flat)), coefficients

    @cached_property
    def _time(self) -> tuple[int, float, Array, Array, Array]:
        """Number of nodes enough for h, period, tau and dkappa/deta at the nodes, cosine coefficients of dt/deta."""
        n = _NODES_LEAST
        while n <= _NODES_MOST:
            *_, h, stretch = self._nodes(n)
            if np.all(np.isfinite(h)):
                good, (h_k,) = self._resolved(n, h * stretch)
                if good:
                    return n, h_k[0] * np.pi, _phase(h_k), stretch, h_k
            n *= 2
        raise self._too_near()

    @property
    def period(self) -> float:
        """Period of the nutation in (R/g)^1/2."""
        return self._time[1]

    @cached_property
    def _kappa(self) -> Array:
        """Sine coefficients in tau of kappa - tau."""
        n, _, tau, stretch, _ = self._time
        while True:

            def coefficients(k: Indices, n: int = n, tau: Array = tau, stretch: Array = stretch) -> Array:
                return (2 / (n * k) * (_wave(k, tau).real @ stretch))[None]

            series = _converged(coefficients, _most(n, tau))
            if series is not None:
                return series[0]
            if n >= _NODES_MOST:
                raise self._too_near()
            n *= 2
            *_, h, stretch = self._nodes(n)
            tau = _phase(dct(h * stretch, type=2) / n)

    @cached_property
    def _orientation(self) -> tuple[Number, ...]:
        """Mean rates in tau, sine coefficients of sigma_- and sigma_+, and of a velocity carried along its own.

        Those are the Fourier coefficients forward and backward and the constant, in axes that turn at the mean rate.
        """
        n = self._time[0]
        while True:
            ch, sh, v, m, h, stretch = self._nodes(n)
            rates = self._sigma_rates(v, m, h) * stretch
            good, (h_k, minus, plus) = self._resolved(n, h * stretch, *rates)
            tau = _phase(h_k)
            mean = np.array([minus[0], plus[0]]) / 2  # over eta, and so over tau
            velocity = self._carried(ch, sh, v, m, h)
            if velocity is not None:
                turn = _integral(minus) + _integral(plus) - mean.sum() * tau
                velocity = velocity * np.exp(1j * turn) * (h * stretch * 2 / (h_k[0] * n))

            waves = rates if velocity is None else np.array([*rates, velocity, velocity.conj()])

            def coefficients(k: Indices, n: int = n, tau: Array = tau, waves: Array | Complex = waves) -> Array:
                sums = (_wave(k, tau) @ waves.T).real.T
                sums[:2] *= 2 / n / k
                return sums

            series = _converged(coefficients, _most(n, tau)) if good else None
            if series is not None:
                return mean, *series, None if velocity is None else velocity.sum().real
            if n >= _NODES_MOST:
                raise self._too_near()
            n *= 2

    def _carried(self, ch: Array, sh: Array, v: Array, m: Array, h: Array) -> Complex | None:
        """Of a point carried along, velocity over exp(i sigma_- + i sigma_+) (n,) complex; None: there is none."""
        return None

    def _sigma_rates(self, v: Array, m: Array, h: Array) -> Array:
        """d sigma_-+/dkappa: half of phi_dot (1 + c) - w3 and of phi_dot (1 - c) + w3, less the turn at the pole."""
        w3, rates = self._w3(v, m), []
        poles = (v, self.v1, self.v2, -1), (m, self.m1, self.m2, 1)
        for (x, x1, x2, sign), d, slope in zip(poles, self.gaps, self._slopes(v, m), strict=True):
            with np.errstate(invalid="ignore", divide="ignore"):
                peak = np.where(x > 0, (h * d - np.copysign(np.sqrt(x1 * x2), d)) / np.where(x > 0, x, 1), 0)
            rates.append((peak + h * (slope + sign * w3)) / 2)
        return np.array(rates)

    def _w1(self, ch: Array, sh: Array, v: Array, m: Array, h: Array) -> Array:
        """theta_dot; where it turns its sign, at a pole, as just after it."""
        with np.errstate(invalid="ignore", divide="ignore"):
            w1 = np.where(self.width > 0, self.width * sh * ch / (h * np.sqrt(v * m)), 0.0)
        at_pole = (v == 0) | (m == 0)
        if np.any(at_pole):
            w1 = np.where(at_pole, np.where(v == 0, 1, -1) * self.width**0.5 / (h * 2**0.5), w1)
        return w1

    def _pole_factor(self, ch: Array, sh: Array, pole: int) -> Complex:
        x1, x2 = ((self.v1, self.v2), (self.m1, self.m2))[pole]
        return x1**0.5 * ch + 1j * np.copysign(x2**0.5, self.gaps[pole]) * sh

    # ---- at any time ----

    def _clock(self, times: ArrayLike) -> tuple[Array, Array, Array]:
        """Whole periods, half periods (0 or 1) and the rest of the phase, -pi/2 to pi/2, at the times: (n,) each."""
        t, T = checked_times(times), self.period
        half, rest = self._start_phase
        # whole periods exactly: the phase is then as smooth in t after 10,000 periods as in the first
        passed, leading = t - t[0], float(np.float32(T))
        whole = np.floor(passed / T)
        angle = ((passed - whole * leading) - whole * (T - leading)) * (2 * np.pi / T)
        halves = np.round((angle + rest) / np.pi)
        rest, halves = (angle - halves * np.pi) + rest, half + halves
        turns = np.floor(halves / 2)
        return turns + whole, halves - 2 * turns, rest

    @cached_property
    def _start_phase(self) -> tuple[float, float]:
        """Half period and the rest of the phase at the start, to full precision next to either turning point."""
        sine, cosine = self._place
        if self.width == 0:
            return 0.0, 0.0
        half, h = float(sine > cosine), self._time[4]
        s_eta, c_eta = self._eta(sine, cosine)
        eta = 2 * (np.arctan2(c_eta, s_eta) if half else np.arctan2(s_eta, c_eta))
        k = np.arange(1, len(h))
        sign = (-1.0) ** k if half else 1.0
        tau = eta + 2 / h[0] * (sign * h[1:] / k) @ np.sin(k * eta)
        return half, -tau if self._inward != bool(half) else tau

    def theta(self, times: ArrayLike) -> Array:
        """theta (n,) in rad at the times (n,)."""
        _, half, rest = self._clock(times)
        ch, sh = _half_angle(half, rest, _evaluate(half, rest, self._kappa[None])[0])
        v, m = self._versines(ch, sh)
        return 2 * np.arctan2(np.sqrt(v), np.sqrt(m))

    def _versines(self, ch: Array, sh: Array) -> tuple[Array, Array]:
        return self.v1 + self.width * sh**2, self.m2 + self.width * ch**2

    @cached_property
    def phi_advance(self) -> float:
        """Advance of phi in a period, rad."""
        return 2 * np.pi * self._orientation[0].sum() + np.pi * sum(np.copysign(1, d) for d in self.gaps)

    @cached_property
    def psi_advance(self) -> float:
        """Advance of psi in a period, rad."""
        north, south = (np.copysign(1, d) for d in self.gaps)
        return 2 * np.pi * (self._orientation[0] @ (-1, 1)) + np.pi * (south - north)

    def _motion(
        self, turns: Array, half: Array, rest: Array, *more: Array
    ) -> tuple[Array, Array, Sigma, Sigma, list[Array]]:
        """cos and sin of kappa/2, the parts of sigma_- and sigma_+, and the sums of more sine series."""
        mean, *series = self._orientation[:3]
        series = self._kappa, *series, *more
        sines = np.zeros((len(series), max(map(len, series))))
        for row, values in zip(sines, series, strict=True):
            row[: len(values)] = values
        tau = np.pi * half + rest
        kappa, minus, plus, *more = _evaluate(half, rest, sines)
        # whole turns apart: rounded with them, the angles of late periods would not be smooth in time
        sigma = [(2 * np.pi * _part_turn(turns, mu), mu * tau + series, 2 * np.pi * np.trunc(turns * mu))
                 for mu, series in zip(mean, (minus, plus), strict=True)]  # fmt: skip
        ch, sh = _half_angle(half, rest, kappa)
        return ch, sh, sigma[0], sigma[1], more

    def _posed(self, times: ArrayLike) -> tuple[dict[str, Number], dict[str, Number], float]:
        """_state at the start and at the times, the latter turned to the start's phi and psi, and the turn of phi."""
        start = self.start
        first = self._state(np.zeros(1), *(np.array([x]) for x in self._start_phase))
        now = self._state(*self._clock(times))
        d_phi, d_psi = start.phi - first["phi"][0], start.psi - first["psi"][0]
        if start.theta_dot * first["omega"][0][0] < 0:  # at a pole, where the motion goes on along -1'
            d_phi, d_psi = d_phi + np.pi, d_psi + (np.pi if self.m1 < self.v1 else -np.pi)
        now["phi"], now["psi"] = now["phi"] + d_phi, now["psi"] + d_psi
        xy, zw = now["xy"] * np.exp(0.5j * (d_phi - d_psi)), now["zw"] * np.exp(0.5j * (d_phi + d_psi))
        now["quaternion"] = np.stack([xy.real, xy.imag, zw.imag, zw.real], axis=1)
        return first, now, d_phi

    def _state(self, turns: Array, half: Array, rest: Array, *more: Array) -> dict[str, Number]:
        ch, sh, minus, plus, more = self._motion(turns, half, rest, *more)
        v, m = self._versines(ch, sh)
        parity = np.where(np.remainder(turns, 2) == 1, -1.0, 1.0)
        north, south = self._pole_factor(ch, sh, 0), self._pole_factor(ch, sh, 1)
        # at a pole itself phi is the one just after it
        angles = [np.where(z == 0, np.copysign(after, d), np.angle(z)) + np.pi * turns * np.copysign(1, d)
                  for z, d, after in zip((north, south), self.gaps, (np.pi / 2, np.pi), strict=True)]  # fmt: skip
        minus_exp, plus_exp = (np.exp(1j * whole) * np.exp(1j * part) for whole, part, _ in (minus, plus))
        minus, plus = sum(minus), sum(plus)
        return {
            "theta": 2 * np.arctan2(np.sqrt(v), np.sqrt(m)), "v": v, "m": m,
            "phi": plus + minus + angles[0] + angles[1], "psi": plus - minus + angles[1] - angles[0],
            "xy": parity * north * minus_exp * 0.5**0.5, "zw": parity * south * plus_exp * 0.5**0.5,
            "s_exp_phi": north * south * minus_exp * plus_exp, "more": more,
            "omega": self._omega(ch, sh, v, m, self._h(v, m))}  # fmt: skip


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
            self.gaps = float(curve.offsets[0]), float(curve.offsets[1])
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
            return TopError("theta", self.start.theta, f"a start whose nutation {_NODES_MOST} nodes resolve",
                            "It is too near to an unstable steady precession, or f1 or f3 nearly vanishes in the "
                            "well; change the start a little.")  # fmt: skip
        E = (self.e + self.K_R**2 - self.top.I1 / self.top.I3 * self.K_J**2) / 2
        return TopError("E", E, f"an energy whose nutation {_NODES_MOST} nodes resolve",
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
        Y_im = _evaluate(half, rest, (ahead + back)[None], cosine=True)[0]
        scale = self.period / (2 * np.pi)
        Y, Y0 = Y_re - 1j * (Y_im + still), -1j * ((ahead + back).sum() + still)
        part = _part_turn(turns, x)
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


# ---- series ----


def _part_turn(turns: Array, rate: float) -> Array:
    """turns * rate less its whole part, to the digits of rate: the product with its leading 24 bits is exact."""
    leading = float(np.float32(rate))
    whole = turns * leading
    return np.fmod(whole, 1) + turns * (rate - leading) - (np.trunc(turns * rate) - np.trunc(whole))


def _integral(cosines: Array) -> Array:
    """At the midpoints, the integral from 0 of the even function with these cosine coefficients."""
    n = len(cosines)
    k = np.arange(1, n)
    sines = np.append(cosines[1:] / k, 0.0)
    return cosines[0] / 2 * (np.arange(n) + 0.5) * np.pi / n + dst(sines, type=3) / 2


def _phase(h: Array) -> Array:
    """tau at the midpoints, from the cosine coefficients of h."""
    return _integral(h) * 2 / h[0]


def _most(n: int, tau: Array) -> int:
    """The harmonics of tau that n midpoints of kappa resolve."""
    return int(n / (np.diff(tau).max() * n / np.pi))


def _wave(k: Indices, tau: Array) -> Complex:
    """exp(-i k tau) for consecutive k, (len(k), len(tau)); where they are many, as products of few."""
    if len(k) <= _FEW:
        return np.exp(-1j * np.outer(k, tau))
    near, far = np.exp(-1j * np.outer(k[:_FEW] - k[0], tau)), np.exp(-1j * np.outer(k[::_FEW], tau))
    return (far[:, None] * near).reshape(-1, len(tau))[: len(k)]


def _converged(coefficients: Callable[[Indices], Array], most: int) -> Array | None:
    """coefficients(k) (rows, len(k)) for k = 1, 2, ..., doubled until all rows have ended; None if that takes over
    `most`.

    A row has ended where its last quarter is rounding: below 1e-16 of the sum of its sizes, or small and not falling.
    """
    done: list[Array] = []
    count = 8
    while count < most:
        first, count = sum(part.shape[1] for part in done), min(2 * count, most)
        done += [coefficients(np.arange(k, min(k + _MANY, count + 1))) for k in range(first + 1, count + 1, _MANY)]
        size = np.abs(rows := np.hstack(done))
        scale = np.maximum(1, size.sum(axis=1))
        last, before = (part.max(axis=1) for part in (size[:, 3 * count // 4 :], size[:, count // 2 : 3 * count // 4]))
        if np.all((last < 1e-16 * scale) | ((last < 1e-12 * scale) & (last > before / 4))):
            kept = np.flatnonzero((size > np.maximum(1e-17 * scale, 2 * last)[:, None]).any(axis=0))
            return rows[:, : kept[-1] + 1 if kept.size else 1]
    return None


def _half_angle(half: Scalars, rest: Scalars, series: Scalars) -> tuple[Array, Array]:
    """cos and sin of kappa/2 = (pi half + rest + series)/2."""
    s = np.sin((rest + series) / 2)  # within pi/4 or so of 0
    c = np.sqrt(1 - s * s)
    return np.where(half, -s, c), np.where(half, c, s)


def _evaluate(half: Array, rest: Array, rows: Array, cosine: bool = False) -> Array:
    """(rows, n): the sums over k >= 1 of rows[:, k - 1] sin(k tau), or cos(k tau), at tau = pi half + rest."""
    count = rows.shape[1]
    out = np.empty((len(rows), len(rest)))
    step = max(1, 2**18 // count)
    for i in range(0, len(rest), step):
        s, sign = np.sin(rest[i : i + step] / 2), 1 - 2 * half[i : i + step]
        wave = np.empty((count, len(s)), complex)
        wave[0].real, wave[0].imag = sign * (1 - 2 * s * s), sign * 2 * s * np.sqrt(1 - s * s)
        done = 1
        while done < count:
            more = min(done, count - done)
            np.multiply(wave[:more], wave[done - 1], out=wave[done : done + more])
            done += more
        out[:, i : i + step] = rows @ np.ascontiguousarray(wave.real if cosine else wave.imag)
    return out
