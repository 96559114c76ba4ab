"""A substitution kappa(eta) that puts more of the midpoints where dt/dkappa has a sharp peak.

If Q = (dt/dkappa)^-2 nearly vanishes in the well or at one end of it, two wells are about to merge or there is an
unstable steady precession nearby. Q then has zeros at a distance eps from a point cos(kappa) = y0. With

    cos(kappa) = y0 + eps sinh(alpha (cos(eta) - x0))

their distance in eta is of the order of 1/log(1/eps).
"""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..errors import read_only
from ..types import Array


class Crowding(NamedTuple):
    """The parameters of cos(kappa) = y0 + eps sinh(alpha (cos(eta) - x0))."""

    y0: float
    eps: float
    alpha: float
    x0: float


@lru_cache(16)
def midpoints(n: int) -> tuple[Array, Array, Array]:
    """cos(eta/2), sin(eta/2) and 1 at the midpoints of n equal parts of [0, pi]: (n,) each, read-only."""
    half = (np.arange(n) + 0.5) * (np.pi / (2 * n))
    found = np.cos(half), np.sin(half), np.ones(n)
    read_only(*found)
    return found


def crowding(Q: Callable[[Array], Array], n: int) -> Crowding | None:
    """The Crowding that resolves the minimum of Q(cos(kappa)), found from n midpoints and the ends; None if it is not
    sharp."""
    cos, sin, _ = midpoints(n)
    y = np.concatenate([[1], cos**2 - sin**2, [-1]])
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
    return Crowding(y0, eps, alpha, (ends[1] - ends[0]) / (2 * alpha))


def crowded(n: int, crowd: Crowding | None) -> tuple[Array, Array, Array]:
    """cos(kappa/2), sin(kappa/2) and dkappa/deta at n midpoints of eta, (n,) each; kappa = eta if crowd is None."""
    cos, sin, dkappa_deta = midpoints(n)
    if not crowd:
        return cos, sin, dkappa_deta
    _, eps, alpha, x0 = crowd
    up, down = cos**2, sin**2
    x = up - down
    cos_half, sin_half = (np.sqrt(eps * np.cosh(alpha * (middle - x0)) * np.sinh(alpha * part))
              for middle, part in (((x - 1) / 2, up), ((x + 1) / 2, down)))  # fmt: skip
    return cos_half, sin_half, eps * alpha * np.cosh(alpha * (x - x0)) * np.sqrt(up * down) / (sin_half * cos_half)


def eta_halves(sine: float, cosine: float, crowd: Crowding | None) -> tuple[float, float]:
    """Two numbers in the ratio sin(eta/2) : cos(eta/2), from two in the ratio sin(kappa/2) : cos(kappa/2)."""
    if not crowd:
        return sine, cosine
    y0, eps, _, _ = crowd
    whole = sine**2 + cosine**2

    def part(share: float, end: float) -> float:
        """alpha times the distance of cos(eta) from an end, where that of cos(kappa) is 2 share."""
        p = end / eps
        q = p - 2 * share / whole / eps
        if p * q > 0:
            return np.arcsinh((p - q) * (p + q) / (p * np.hypot(1, q) + q * np.hypot(1, p)))
        return np.arcsinh(p) - np.arcsinh(q)

    return np.sqrt(part(sine**2, 1 - y0)), np.sqrt(part(cosine**2, 1 + y0))
