"""Fourier series of the phase tau of a nutation: their coefficients from midpoints, and their sums."""

from collections.abc import Callable

import numpy as np
from scipy.fft import dst

from ..types import Array, Complex, Indices, Scalars

_FEW, _MANY = 64, 512  # harmonics: up to so many each by itself; at once


def part_turn(turns: Array, rate: float) -> Array:
    """turns * rate less its whole part, to the digits of rate: the product with its leading 24 bits is exact."""
    leading = float(np.float32(rate))
    whole = turns * leading
    return np.fmod(whole, 1) + turns * (rate - leading) - (np.trunc(turns * rate) - np.trunc(whole))


def integral(cosines: Array) -> Array:
    """At the midpoints, the integral from 0 of the even function with these cosine coefficients."""
    n = len(cosines)
    k = np.arange(1, n)
    sines = np.append(cosines[1:] / k, 0.0)
    return cosines[0] / 2 * (np.arange(n) + 0.5) * np.pi / n + dst(sines, type=3) / 2


def phase(h: Array) -> Array:
    """tau at the midpoints, from the cosine coefficients of h."""
    return integral(h) * 2 / h[0]


def most_harmonics(n: int, tau: Array) -> int:
    """The harmonics of tau that n midpoints of kappa resolve."""
    return int(n / (np.diff(tau).max() * n / np.pi))


def wave(k: Indices, tau: Array) -> Complex:
    """exp(-i k tau) for consecutive k, (len(k), len(tau)); where they are many, as products of few."""
    if len(k) <= _FEW:
        return np.exp(-1j * np.outer(k, tau))
    near, far = np.exp(-1j * np.outer(k[:_FEW] - k[0], tau)), np.exp(-1j * np.outer(k[::_FEW], tau))
    return (far[:, None] * near).reshape(-1, len(tau))[: len(k)]


def converged(coefficients: Callable[[Indices], Array], most: int) -> Array | None:
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


def half_angle(half: Scalars, rest: Scalars, series: Scalars) -> tuple[Array, Array]:
    """cos and sin of kappa/2 = (pi half + rest + series)/2."""
    s = np.sin((rest + series) / 2)  # within pi/4 or so of 0
    c = np.sqrt(1 - s * s)
    return np.where(half, -s, c), np.where(half, c, s)


def evaluate(half: Array, rest: Array, rows: Array, cosine: bool = False) -> Array:
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
