"""Fourier series of one nutation: coefficients from the midpoints of half a period, and sums.

An even function of an angle eta, of period 2 pi, is c_0/2 + sum c_k cos(k eta); n midpoints eta_j = (j + 1/2) pi/n give
its coefficients by the midpoint rule, to rounding once they resolve it.
"""

import numpy as np
from scipy.fft import dct, dst

from ..compiled import compiled
from ..types import Array

AFRESH = 16  # harmonics after which cos(k tau), sin(k tau) are computed anew, so that rounding does not add up

BLOCK = 256  # instants whose sums the processor keeps at hand


def cosine_coefficients(values: Array) -> Array:
    """(r, n): c_k, k = 0 to n - 1, of r even functions, from their values (r, n) at the midpoints."""
    return dct(values, type=2, axis=1) / values.shape[1]


@compiled
def resolved(coefficients: Array) -> bool:
    """Whether the cosine series (r, n) have ended within what n midpoints resolve: below 1e-15 of the first row's, or
    of their own, largest; or small and not falling, which is rounding."""
    rows, n = coefficients.shape
    size = np.abs(coefficients)
    for r in range(rows):
        tail, noise = size[r, n // 2 :].max(), size[r, 7 * n // 8 :].max()
        scale = max(size[r].max(), size[0].max())
        if not (tail < 1e-15 * scale or (tail < 1e-11 * scale and noise > tail / 8)):
            return False
    return True


def integral(c: Array) -> Array:
    """(n,): at the midpoints, the integral from 0 of the even function with the cosine coefficients c (n,)."""
    n = len(c)
    k, sines = np.arange(n), np.zeros(n)
    sines[:-1] = c[1:] / k[1:]
    return c[0] * np.pi / (2 * n) * (k + 0.5) + dst(sines, type=3) / 2


@compiled
def integral_to(angle: float, c: Array) -> float:
    """The same integral from 0 to any angle."""
    total = c[0] / 2 * angle
    for k in range(1, len(c)):
        total += c[k] / k * np.sin(k * angle)
    return total


def phase(dt_deta: Array) -> Array:
    """(n,): tau at the midpoints, from the cosine coefficients of dt/deta."""
    return integral(dt_deta) * (2 / dt_deta[0])


@compiled
def harmonics(tau: Array, even: Array, odd: Array, rates: int) -> Array:
    """(r, K): sum_j [even_j cos(k tau_j) + odd_j sin(k tau_j)] for k = 1 to K, from even, odd (r, n) and tau (n,).

    The first `rates` rows are of a function's rate, and become those of the function: divided by k. K is such that all
    rows have ended; 0 where they do not within the harmonics that the midpoints resolve.
    """
    rows, n = even.shape
    most = int(np.pi / np.diff(tau).max())
    found = np.zeros((rows, most))
    step_cos, step_sin = np.cos(tau), np.sin(tau)
    cos, sin = np.ones(n), np.zeros(n)
    done, count = 0, 8
    while count < most:
        count = min(2 * count, most)
        for k in range(done + 1, count + 1):
            if k % AFRESH:
                cos, sin = cos * step_cos - sin * step_sin, sin * step_cos + cos * step_sin
            else:
                cos, sin = np.cos(k * tau), np.sin(k * tau)
            found[:, k - 1] = even @ cos + odd @ sin
            found[:rates, k - 1] /= k
        done = count
        kept = length(found[:, :count])
        if kept:
            return found[:, :kept].copy()
    return np.zeros((rows, 0))


@compiled
def length(series: Array) -> int:
    """How many harmonics of the series (r, K) are more than rounding; 0 where a row has not ended.

    A row has ended where its last quarter is rounding: below 1e-16 of the sum of its sizes, or small and not falling.
    """
    rows, count = series.shape
    kept = 1
    for r in range(rows):
        size = np.abs(series[r])
        scale = max(1.0, size.sum())
        before, last = size[count // 2 : 3 * count // 4].max(), size[3 * count // 4 :].max()
        if not (last < 1e-16 * scale or (last < 1e-12 * scale and last > before / 4)):
            return 0
        k = count
        while k > kept and size[k - 1] <= max(1e-17 * scale, 2 * last):
            k -= 1
        kept = max(kept, k)
    return kept


@compiled
def sums(half: Array, rest: Array, sines: Array, cosines: Array) -> Array:
    """(r + q, n): sum_k sines[k - 1] sin(k tau), then sum_k cosines[k - 1] cos(k tau), at tau = pi half + rest (n,).

    sines (r, K), cosines (q, K).
    """
    r, n = len(sines), len(rest)
    found = np.zeros((r + len(cosines), n))
    step_cos, step_sin, cos, sin = np.zeros(BLOCK), np.zeros(BLOCK), np.zeros(BLOCK), np.zeros(BLOCK)
    for first in range(0, n, BLOCK):
        size = min(BLOCK, n - first)
        for j in range(size):
            sign = 1 - 2 * half[first + j]
            cos[j], sin[j] = sign * np.cos(rest[first + j]), sign * np.sin(rest[first + j])
            step_cos[j], step_sin[j] = cos[j], sin[j]
        for k in range(sines.shape[1]):
            for row in range(len(found)):
                wave, b = (sin, sines[row, k]) if row < r else (cos, cosines[row - r, k])
                add(found[row, first : first + size], b, wave)
            next_harmonic(cos, sin, step_cos, step_sin)
    return found


@compiled
def add(total: Array, b: float, wave: Array) -> None:
    """total += b wave"""
    for j in range(len(total)):
        total[j] += b * wave[j]


@compiled
def next_harmonic(cos: Array, sin: Array, step_cos: Array, step_sin: Array) -> None:
    """cos and sin (n,) of k tau become those of (k + 1) tau, by the angle's own, step_cos and step_sin."""
    for j in range(len(cos)):
        cos[j], sin[j] = cos[j] * step_cos[j] - sin[j] * step_sin[j], sin[j] * step_cos[j] + cos[j] * step_sin[j]


@compiled
def part_turn(turns: float, rate: float) -> float:
    """turns * rate less its whole part, to the digits of rate: the product with its leading 24 bits is exact."""
    leading = np.float64(np.float32(rate))
    whole = turns * leading
    return np.fmod(whole, 1) + turns * (rate - leading) - (np.trunc(turns * rate) - np.trunc(whole))
