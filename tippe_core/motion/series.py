"""Fourier series of one nutation: coefficients from values at the midpoints of half a period, and their sums.

An even function of an angle eta with period 2 pi is c_0/2 + sum c_k cos(k eta). The midpoint rule at the n points
eta_j = (j + 1/2) pi/n gives its coefficients, to rounding error once they resolve it.
"""

import numpy as np

from ..compiled import compiled
from ..types import Array

AFRESH = 8  # harmonics after which cos(k tau), sin(k tau) are computed afresh, so that rounding errors do not add up
C2, C4, C6, C8, C10, C12, C14, C16, C18, C20 = (1 / (k * (k + 1)) for k in range(2, 22, 2))  # of the sine's series
BLOCK = 256  # instants whose sums fit into the processor's cache


# ---- coefficients ----


def transform(angle: Array, even: Array, odd: Array, count: int) -> Array:
    """(r, count): sum_j [even_j cos(k angle_j) + odd_j sin(k angle_j)] for k = 0 to count - 1.

    even (r, n), odd (r, n), or (0, n) for none, angle (n,).
    """
    found = np.empty((len(even), count))
    step_cos, step_sin = np.cos(angle), np.sin(angle)
    cos, sin = np.ones(len(angle)), np.zeros(len(angle))
    for k in range(count):
        if k % AFRESH == 0:
            cos, sin = np.cos(k * angle), np.sin(k * angle)
        found[:, k] = even @ cos
        if len(odd):
            found[:, k] += odd @ sin
        cos, sin = cos * step_cos - sin * step_sin, sin * step_cos + cos * step_sin
    return found


@compiled
def cosine_coefficients(values: Array) -> Array:
    """(r, n): c_k, k = 0 to n - 1, of r even functions, from their values (r, n) at the midpoints."""
    n = values.shape[1]
    return transform((np.arange(n) + 0.5) * (np.pi / n), 2 / n * values, values[:0], n)


@compiled
def resolved(coefficients: Array) -> bool:
    """Whether n midpoints resolve the cosine series (r, n): the last coefficients are below 1e-15 of the largest, of
    the first row or of their own; or small and no longer decreasing, which is rounding."""
    rows, n = coefficients.shape
    size = np.abs(coefficients)
    for r in range(rows):
        tail, noise = size[r, n // 2 :].max(), size[r, 7 * n // 8 :].max()
        scale = max(size[r].max(), size[0].max())
        if not (tail < 1e-15 * scale or (tail < 1e-11 * scale and noise > tail / 8)):
            return False
    return True


@compiled
def integral(c: Array) -> Array:
    """(n,): at the midpoints, the integral from 0 of the even function with the cosine coefficients c (n,)."""
    n = len(c)
    half = np.floor(np.arange(n) / (n / 2))
    sines = (c[1:] / np.arange(1, n)).reshape(1, n - 1)
    midpoint = np.arange(n) + 0.5
    return c[0] / 2 * np.pi / n * midpoint + sums(half, np.pi / n * (midpoint - n * half), sines, sines[:0])[0]


@compiled
def integral_to(angle: float, c: Array) -> float:
    """The same integral from 0 to a given angle."""
    total = c[0] / 2 * angle
    for k in range(1, len(c)):
        total += c[k] / k * np.sin(k * angle)
    return total


@compiled
def harmonics(tau: Array, even: Array, odd: Array, rates: int) -> Array:
    """(r, K): sum_j [even_j cos(k tau_j) + odd_j sin(k tau_j)] for k = 1 to K, as in transform().

    The first `rates` rows belong to derivatives; divided by k they become those of the functions themselves. K is large
    enough for all rows to have converged; 0 if they do not within the harmonics that the midpoints resolve.
    """
    most, count = int(np.pi / (tau[1:] - tau[:-1]).max()), 8  # np.diff would be compiled besides
    while count < most:
        count = min(2 * count, most)
        found = transform(tau, even, odd, count + 1)[:, 1:]
        found[:rates] /= np.arange(1, count + 1)
        kept = length(found)
        if kept:
            return found[:, :kept].copy()
    return np.zeros((len(even), 0))


@compiled
def length(series: Array) -> int:
    """The number of harmonics of the series (r, K) above rounding; 0 if a row has not converged.

    A row has converged if its last quarter is rounding: below 1e-16 of the sum of its absolute values, or small and no
    longer decreasing.
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
def of_time(dt_deta: Array, dkappa_deta: Array) -> tuple[Array, Array]:
    """The cosine coefficients of dt/deta (1, n), and the sine coefficients in tau of kappa - tau (1, K).

    From dt/deta and dkappa/deta at the midpoints, (1, n) each. n or K is 0 if the midpoints do not resolve that series.
    """
    n = dt_deta.shape[1]
    c, none = cosine_coefficients(dt_deta), np.zeros((1, 0))
    if not resolved(c):
        return none, none
    return c, harmonics(integral(c[0]) * (2 / c[0, 0]), 2 / n * dkappa_deta, none[:0], 1)


# ---- sums ----


@compiled
def sine(x: float) -> float:
    """sin(x) for |x| <= pi/2: x - x^3/3! + ... + x^21/21!, exact to rounding.

    A polynomial, because it can be vectorized, unlike the library's sine.
    """
    y = x * x
    return x * (1 - y * C2 * (1 - y * C4 * (1 - y * C6 * (1 - y * C8 * (1 - y * C10 * (
        1 - y * C12 * (1 - y * C14 * (1 - y * C16 * (1 - y * C18 * (1 - y * C20))))))))))  # fmt: skip


@compiled
def sums(half: Array, rest: Array, sines: Array, cosines: Array) -> Array:
    """(r + q, n): sum_k sines[k - 1] sin(k tau), then sum_k cosines[k - 1] cos(k tau), at tau = pi half + rest (n,).

    sines (r, K), cosines (q, K).
    """
    r, n = len(sines), len(rest)
    found = np.zeros((r + len(cosines), n))
    for first in range(0, n, BLOCK):
        block = slice(first, min(first + BLOCK, n))
        step_cos, step_sin = cos_and_sin(half[block], rest[block])
        cos, sin = step_cos.copy(), step_sin.copy()
        for k in range(sines.shape[1]):
            if k:
                next_harmonic(cos, sin, step_cos, step_sin)
            for row in range(r):
                add_wave(found[row, block], sines[row, k], sin)
            for row in range(len(cosines)):
                add_wave(found[r + row, block], cosines[row, k], cos)
    return found


def cos_and_sin(half: Array, rest: Array) -> tuple[Array, Array]:
    """cos and sin of pi half + rest, (n,) each, with |rest| at most pi/2."""
    cos, sin = np.empty(len(rest)), np.empty(len(rest))
    for j in range(len(rest)):
        s, sign = sine(rest[j] / 2), 1 - 2 * half[j]
        cos[j], sin[j] = sign * (1 - 2 * s * s), sign * 2 * s * np.sqrt(1 - s * s)
    return cos, sin


def add_wave(total: Array, b: float, wave: Array) -> None:
    """total += b wave"""
    for j in range(len(total)):
        total[j] += b * wave[j]


def next_harmonic(cos: Array, sin: Array, step_cos: Array, step_sin: Array) -> None:
    """Replaces cos and sin (n,) of k tau by those of (k + 1) tau, from step_cos and step_sin of tau."""
    for j in range(len(cos)):
        cos[j], sin[j] = cos[j] * step_cos[j] - sin[j] * step_sin[j], sin[j] * step_cos[j] + cos[j] * step_sin[j]


def part_turn(turns: float, rate: float) -> float:
    """The fractional part of turns * rate, to the precision of rate: the product with its leading 24 bits is exact."""
    leading = np.float64(np.float32(rate))
    whole = turns * leading
    return np.fmod(whole, 1) + turns * (rate - leading) - (np.trunc(turns * rate) - np.trunc(whole))
