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
from collections.abc import Sequence
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike
from scipy.fft import dct

from ..errors import TopError
from ..paper.constants import State
from ..paper.top import Top
from ..types import Array, Complex, Indices, Number, Scalars
from .series import converged, evaluate, half_angle, integral, most_harmonics, part_turn, phase, wave
from .trajectory import checked_times

NODES_LEAST, NODES_MOST = 32, 2**12  # enough for energies within 1e-9 of that of a merging
# cos(kappa/2), sin(kappa/2), v, m, h, dkappa/deta; and of sigma: its turn by whole periods, the rest, what was left out
Nodes: TypeAlias = tuple[Array, Array, Array, Array, Array, Array]
Sigma: TypeAlias = tuple[Array, Array, Array]


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
        if n == NODES_LEAST and not self._map:
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
        half = (np.arange(NODES_LEAST) + 0.5) * (np.pi / (2 * NODES_LEAST))
        ch, sh = np.cos(half), np.sin(half)
        v, m = self._versines(ch, sh)
        return ch, sh, v, m, self._h(v, m), np.ones(NODES_LEAST)

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
        n = NODES_LEAST
        while n <= NODES_MOST:
            *_, h, stretch = self._nodes(n)
            if np.all(np.isfinite(h)):
                good, (h_k,) = self._resolved(n, h * stretch)
                if good:
                    return n, h_k[0] * np.pi, phase(h_k), stretch, h_k
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
                return (2 / (n * k) * (wave(k, tau).real @ stretch))[None]

            series = converged(coefficients, most_harmonics(n, tau))
            if series is not None:
                return series[0]
            if n >= NODES_MOST:
                raise self._too_near()
            n *= 2
            *_, h, stretch = self._nodes(n)
            tau = phase(dct(h * stretch, type=2) / n)

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
            tau = phase(h_k)
            mean = np.array([minus[0], plus[0]]) / 2  # over eta, and so over tau
            velocity = self._carried(ch, sh, v, m, h)
            if velocity is not None:
                turn = integral(minus) + integral(plus) - mean.sum() * tau
                velocity = velocity * np.exp(1j * turn) * (h * stretch * 2 / (h_k[0] * n))

            waves = rates if velocity is None else np.array([*rates, velocity, velocity.conj()])

            def coefficients(k: Indices, n: int = n, tau: Array = tau, waves: Array | Complex = waves) -> Array:
                sums = (wave(k, tau) @ waves.T).real.T
                sums[:2] *= 2 / n / k
                return sums

            series = converged(coefficients, most_harmonics(n, tau)) if good else None
            if series is not None:
                return mean, *series, None if velocity is None else velocity.sum().real
            if n >= NODES_MOST:
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
        ch, sh = half_angle(half, rest, evaluate(half, rest, self._kappa[None])[0])
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
        kappa, minus, plus, *more = evaluate(half, rest, sines)
        # whole turns apart: rounded with them, the angles of late periods would not be smooth in time
        sigma = [(2 * np.pi * part_turn(turns, mu), mu * tau + series, 2 * np.pi * np.trunc(turns * mu))
                 for mu, series in zip(mean, (minus, plus), strict=True)]  # fmt: skip
        ch, sh = half_angle(half, rest, kappa)
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
