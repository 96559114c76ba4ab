"""One nutation as Fourier series: the motion between two turning points, exact for any length of time.

With c = cos(theta), c_dot^2 = s^2 f is analytic between its zeros c1 (inner) and c2 (outer). Substituting
c = (c1 + c2)/2 + (c1 - c2)/2 cos(kappa) gives kappa_dot^2 = Q, where s^2 f = (c1 - c)(c - c2) Q, so dt/dkappa = Q^-1/2
is smooth and periodic. If it has a sharp peak, an angle eta takes the place of kappa (crowding.py).

Integrals over eta by the midpoint rule converge geometrically, and so do the Fourier coefficients in the phase
tau = 2 pi t/T, for which kappa(tau) need not be inverted: the coefficient of sin(k tau) in kappa - tau is
2/(pi k) times the integral of cos(k tau(kappa)) from 0 to pi (Bessel's solution of Kepler's equation).

Near a pole phi and psi change abruptly by nearly pi, and at the pole they are undefined. With v = 1 - c, m = 1 + c,

    q_x + i q_y = sin(theta/2) exp i(phi - psi)/2 = (v1^1/2 cos(kappa/2) +- i v2^1/2 sin(kappa/2)) 2^-1/2 exp i sigma_-
    q_w + i q_z = cos(theta/2) exp i(phi + psi)/2 = (m1^1/2 cos(kappa/2) +- i m2^1/2 sin(kappa/2)) 2^-1/2 exp i sigma_+

(with the sign of the pole offset d) the first factor contains exactly that abrupt change, because f1 = f2 at the poles.
The rates of sigma_- and sigma_+ are smooth for every trajectory, also through a pole, and so is the velocity of the
contact point.
"""

from abc import ABC, abstractmethod
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..errors import TopError, numbers
from ..paper.constants import State
from ..paper.top import Top
from ..types import Array, Complex, Scalars
from .crowding import Crowding, crowded, crowding, eta_halves
from .phase import Ends, Pose, half_sigma_rate, pose, split_phase, tilts, v_and_m
from .series import cosine_coefficients, harmonics, integral, integral_to, of_time, resolved, sums
from .trajectory import PASSES_90, checked_times

NODES_LEAST, NODES_MOST = 32, 2**12  # enough for energies within 1e-9 of that at which two wells merge
MOST_NOTES, AT_ONCE = 10_000, 1e-12  # passages of 90 degrees that are listed; phase that counts as none
SHARP = 3.0  # dt/dkappa may have a peak if it varies by more than this factor
Phases: TypeAlias = tuple[Array, Array, Array]  # whole periods, half periods (0 or 1), remaining phase; (n,) each
NO_SERIES = np.zeros((0, 1))  # no series


class Nodes(NamedTuple):
    """Values at the midpoints of eta, (n,) each: cos(kappa/2), sin(kappa/2), v, m, and the three rates."""

    cos_half: Array
    sin_half: Array
    v: Array
    m: Array
    dt_dkappa: Array
    dt_deta: Array
    dkappa_deta: Array


class Time(NamedTuple):
    """The number of midpoints that resolve dt/deta, its cosine coefficients (n,), and the sine coefficients (1, K) in
    tau of kappa - tau, if that many midpoints resolve them."""

    n: int
    dt_deta: Array
    kappa: Array


class Orientation(NamedTuple):
    """As functions of the phase: the mean rates (2,) of sigma_- and sigma_+ and the sine coefficients (2, K) of their
    periodic parts. For the velocity of the contact point, in axes that rotate at the mean rate, the Fourier
    coefficients forward and backward (2, K) and the constant one; empty if the path is not needed."""

    mean: Array
    sigma: Array
    velocity: Array
    constant: float


class Nutation(ABC):
    """A motion whose c_dot^2 is analytic between two turning points, as a function of the time since its start."""

    top: Top
    start: State
    ends: Ends
    _inward: bool  # whether theta decreases at first
    _place: tuple[float, float]  # in the ratio sin(kappa/2) : cos(kappa/2) at the start

    @abstractmethod
    def _dt_dkappa(self, cos_half: Array, sin_half: Array, v: Array, m: Array) -> Array:
        """dt/dkappa (n,) at cos(kappa/2), sin(kappa/2), v = 1 - c, m = 1 + c, (n,)."""

    @abstractmethod
    def _exact_dt_dkappa(self, cos_half: Array, sin_half: Array) -> Array:
        """The same to full precision, at cos(kappa/2) and sin(kappa/2)."""

    @abstractmethod
    def _slopes(self, v: Array, m: Array) -> tuple[Scalars, Scalars]:
        """phi_dot (1 + c) - w3 - offset/v and phi_dot (1 - c) + w3 - offset/m at v, m, (n,)."""

    @abstractmethod
    def _omega(self, place: Nodes | Pose) -> Array:
        """(n, 3): omega about 1', 2', 3."""

    @abstractmethod
    def _too_near(self) -> TopError:
        """The error to raise if no number of nodes is enough."""

    def _contact_velocity(self, nodes: Nodes) -> Complex | None:
        """The velocity of the contact point divided by exp i(sigma_- + sigma_+), (n,) complex, if its path is found by
        integration."""
        return None

    @property
    def turning_points(self) -> Array:
        """theta at the inner and the outer turning point, (2,) in rad."""
        v1, v2, m1, m2, *_ = self.ends
        return 2 * np.arctan2(np.sqrt([v1, v2]), np.sqrt([m1, m2]))

    # ---- one nutation, on nodes ----

    @cached_property
    def _plain(self) -> Nodes:
        """The smallest set of midpoints in kappa itself."""
        cos_half, sin_half, dkappa_deta = crowded(NODES_LEAST, None)
        v, m = v_and_m(cos_half, sin_half, self.ends)
        dt_dkappa = self._dt_dkappa(cos_half, sin_half, v, m)
        return Nodes(cos_half, sin_half, v, m, dt_dkappa, dt_dkappa, dkappa_deta)

    @cached_property
    def _crowding(self) -> Crowding | None:
        dt_dkappa = self._plain.dt_dkappa
        if self.ends.width == 0 or dt_dkappa.max() < SHARP * dt_dkappa.min():
            return None

        def Q(y: Array) -> Array:
            up, down = np.maximum((1 + y) / 2, 1e-20), np.maximum((1 - y) / 2, 1e-20)
            return self._exact_dt_dkappa(np.sqrt(up), np.sqrt(down)) ** -2

        return crowding(Q, NODES_LEAST)

    @cached_property
    def _known_nodes(self) -> dict[int, Nodes]:
        return {}

    def _nodes(self, n: int) -> Nodes:
        """The Nodes at n midpoints of eta."""
        if n == NODES_LEAST and not self._crowding:
            return self._plain
        if n not in self._known_nodes:  # time, kappa and orientation use the same ones, and the exact ones are slow
            cos_half, sin_half, dkappa_deta = crowded(n, self._crowding)
            dt_dkappa = self._exact_dt_dkappa(cos_half, sin_half)  # the terms cancel if Q nearly vanishes
            self._known_nodes[n] = Nodes(
                cos_half,
                sin_half,
                *v_and_m(cos_half, sin_half, self.ends),
                dt_dkappa,
                dt_dkappa * dkappa_deta,
                dkappa_deta,
            )
        return self._known_nodes[n]

    @cached_property
    def _time(self) -> Time:
        n = NODES_LEAST
        while n <= NODES_MOST:
            nodes = self._nodes(n)
            if np.isfinite(nodes.dt_deta).all():
                dt_deta, kappa = of_time(nodes.dt_deta[None], nodes.dkappa_deta[None])
                if dt_deta.size:
                    return Time(n, dt_deta[0], kappa)
            n *= 2
        raise self._too_near()

    @property
    def period(self) -> float:
        """Period of the nutation in (R/g)^1/2."""
        return float(self._time.dt_deta[0] * np.pi)

    @cached_property
    def _kappa(self) -> Array:
        """Sine coefficients (1, K) in tau of kappa - tau."""
        n, _, kappa = self._time
        while not kappa.size:  # it needs more nodes than dt/deta
            n *= 2
            if n > NODES_MOST:
                raise self._too_near()
            _, kappa = of_time(self._nodes(n).dt_deta[None], self._nodes(n).dkappa_deta[None])
        return kappa

    def _sigma_rates(self, nodes: Nodes) -> Array:
        """(2, n): d sigma_-/dkappa and d sigma_+/dkappa."""
        _, _, v, m, rate, *_ = nodes
        (minus, plus), ends = self._slopes(v, m), self.ends
        return np.stack([half_sigma_rate(v, ends.v1, ends.v2, ends.upright, rate, minus),
                         half_sigma_rate(m, ends.m1, ends.m2, ends.inverted, rate, plus)])  # fmt: skip

    @cached_property
    def _orientation(self) -> Orientation:
        n = self._time.n
        while True:
            nodes = self._nodes(n)
            rates = self._sigma_rates(nodes) * nodes.dkappa_deta
            coefficients = cosine_coefficients(np.concatenate([nodes.dt_deta[None], rates]))
            if resolved(coefficients):
                dt_deta, minus, plus = coefficients
                tau = integral(dt_deta) * (2 / dt_deta[0])
                mean = np.array([minus[0], plus[0]]) / 2  # over eta, hence over tau
                even, odd = 2 / n * rates, np.zeros_like(rates)
                velocity = self._contact_velocity(nodes)
                if velocity is not None:
                    turn = integral(minus) + integral(plus) - mean.sum() * tau
                    velocity = velocity * np.exp(1j * turn) * (nodes.dt_deta * (2 / (dt_deta[0] * n)))
                    even = np.concatenate([even, [velocity.real, velocity.real]])
                    odd = np.concatenate([odd, [velocity.imag, -velocity.imag]])
                series = harmonics(tau, even, odd, 2)
                if series.size:
                    constant = 0.0 if velocity is None else velocity.real.sum()
                    return Orientation(mean, series[:2], series[2:], constant)
            if n >= NODES_MOST:
                raise self._too_near()
            n *= 2

    @property
    def phi_advance(self) -> float:
        """Advance of phi in one period, rad."""
        upright, inverted = np.copysign(1, self.ends.upright), np.copysign(1, self.ends.inverted)
        return 2 * np.pi * self._orientation.mean.sum() + np.pi * (upright + inverted)

    @property
    def psi_advance(self) -> float:
        """Advance of psi in one period, rad."""
        upright, inverted = np.copysign(1, self.ends.upright), np.copysign(1, self.ends.inverted)
        minus, plus = self._orientation.mean
        return 2 * np.pi * (plus - minus) + np.pi * (inverted - upright)

    # ---- at any time ----

    @cached_property
    def _start_phase(self) -> tuple[float, float]:
        """The half period and the remaining phase at the start, to full precision near either turning point."""
        if self.ends.width == 0:
            return 0.0, 0.0
        half, tau = self._phase_of(*self._place)
        return half, -tau if self._inward != bool(half) else tau

    def _phase_of(self, sine: float, cosine: float) -> tuple[float, float]:
        """The nearer turning point, as a half period, and the phase between it and the place where sin(kappa/2) :
        cos(kappa/2) has this ratio."""
        half = float(sine > cosine)
        s_eta, c_eta = eta_halves(sine, cosine, self._crowding)
        dt_deta = self._time.dt_deta
        if half:  # seen from the outer turning point every other coefficient changes sign
            s_eta, c_eta, dt_deta = c_eta, s_eta, dt_deta * (-1.0) ** np.arange(len(dt_deta))
        return half, integral_to(2 * np.arctan2(s_eta, c_eta), dt_deta) * (2 / dt_deta[0])

    def _notes(self, t: Array) -> tuple[tuple[float, str], ...]:
        """When theta passes 90 degrees, from t[0] to the last of the times t (n,); MOST_NOTES times at most."""
        inner, outer = 1 - self.ends.v1, 1 - self.ends.v2
        if not outer < 0 < inner:
            return ()
        (begins, begins_rest), (half, tau) = self._start_phase, self._phase_of(inner**0.5, (-outer) ** 0.5)
        outwards = np.pi * half + (-tau if half else tau)
        first = np.sort((np.array([outwards, -outwards]) - np.pi * begins - begins_rest) % (2 * np.pi))
        first[first > 2 * np.pi - AT_ONCE] = 0.0
        whole = min(float(np.max(t) - t[0]) / self.period, MOST_NOTES)
        turns = (np.arange(int(whole) + 1)[:, None] + np.sort(first) / (2 * np.pi)).ravel()
        return tuple((float(t[0] + turn * self.period), PASSES_90) for turn in turns[turns <= whole][:MOST_NOTES])

    def _phases(self, times: ArrayLike) -> Phases:
        """The Phases at the times; the motion starts at the first of them."""
        t = checked_times(times)
        return split_phase(t - t[0], self.period, *self._start_phase)

    def theta(self, t: ArrayLike) -> Scalars:
        """theta in rad at the times t since the start, in (R/g)^1/2: a number or an array."""
        times = numbers("times", t)
        found = np.arctan2(*tilts(times.ravel(), self.period, *self._start_phase, self._kappa, self.ends))
        return found.reshape(times.shape) if times.ndim else float(found[0])

    @cached_property
    def _series(self) -> tuple[Array, Array]:
        """The sine series of kappa, sigma_- and sigma_+ and whatever else poses need, (3 or more, K), and the cosine
        series (q, K)."""
        more, cosines = self._more_series()
        parts = self._kappa, self._orientation.sigma, more
        length = max(part.shape[1] for part in (*parts, cosines))

        def longer(rows: Array) -> Array:
            found = np.zeros((len(rows), length))
            found[:, : rows.shape[1]] = rows
            return found

        return np.concatenate([longer(part) for part in parts]), longer(cosines)

    def _more_series(self) -> tuple[Array, Array]:
        """Further sine and cosine series of a subclass."""
        return NO_SERIES, NO_SERIES

    def _pose(self, phases: Phases, *turn: float) -> tuple[Pose, Array]:
        """The Pose at the phases, with phi and psi increased by turn = (d_phi, d_psi), and the sums of further
        series."""
        _, half, rest = phases
        series = sums(half, rest, *self._series)
        return pose(*phases, series, self._orientation.mean, self.ends, *turn), series[3:]

    @cached_property
    def _at_start(self) -> Phases:
        half, rest = self._start_phase
        return np.zeros(1), np.array([half]), np.array([rest])

    @cached_property
    def _turn_of_start(self) -> tuple[float, float]:
        """The constants to add to phi and psi so that they have their initial values at the start."""
        first, _ = self._pose(self._at_start, 0.0, 0.0)
        d_phi, d_psi = self.start.phi - first.phi[0], self.start.psi - first.psi[0]
        if self.start.theta_dot * self._omega(first)[0, 0] < 0:  # at a pole, if the motion continues along -1'
            d_phi, d_psi = d_phi + np.pi, d_psi + (np.pi if first.m[0] < first.v[0] else -np.pi)
        return float(d_phi), float(d_psi)
