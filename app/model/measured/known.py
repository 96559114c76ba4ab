"""How well a fit determines its parameters: how far each can move before chi-square rises too much, with all others
refitted.

Where chi-square is a parabola, its curvature gives the errors. Where its valley is curved, the valley is followed: one
parameter is held at a value beside the best and the others are refitted, until chi-square has risen by 4, that is, to
two standard errors (profile likelihood; D. J. Venzon and S. H. Moolgavkar, Appl. Statist. 37, 87 (1988)).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.optimize import least_squares

from app.model.runs import look
from tippe_core.types import Array

RISE = 4.0  # of chi-square at two standard errors
BENT = 0.1  # largest share of a parameter's variance from non-parabolic directions before its valley is followed
MOVES_WITH = 0.3  # correlation
ROUGHLY = 1.3  # factor by which the rise may differ from a parabola's
CLOSE, TRIES = 0.05, 9  # relative accuracy of two standard errors, and the number of steps to find it
STEPS = 1.6, 3.0  # the least and the largest factor by which a step is longer than the one before
BETTER = 0.05  # a minimum is a better one if its chi-square is smaller by this much
LONGEST = 30.0  # times the error from the curvature: the farthest to which a valley is followed
VAGUE = 0.5  # a positive parameter with a larger relative error is not determined


class Problem(Protocol):
    """Least squares for the free parameters of a model."""

    bounds: Array
    sizes: Array

    def residuals(self, x: Array) -> Array:
        """The residuals in units of their standard errors, (n,)."""

    def slopes(self, x: Array) -> Array:
        """Their Jacobian, (n, k)."""


@dataclass(frozen=True, eq=False)
class Known:
    """covariance: (k, k), from the curvature at the minimum. below, above: (k,), one standard error to either side, inf
    if chi-square never rises enough. followed: (k,), the parameters whose valley was followed. better: a point with a
    smaller chi-square that was found on the way, else None."""

    covariance: Array
    below: Array
    above: Array
    followed: Array
    better: Array | None = None

    @classmethod
    def of_curvature(cls, problem: Problem, x: Array) -> "Known":
        """The Known at x from the curvature alone."""
        covariance, _ = _curvature(problem, x)
        errors = np.sqrt(np.diag(covariance))
        return cls(covariance, errors, errors, np.zeros(len(x), bool))

    def tells(self, x: Array, bounds: Array) -> Array:
        """Which parameters the data determine: within their bounds and, if positive, to half of their value."""
        low, high = bounds
        error = np.maximum(self.below, self.above)
        most = np.where(low >= 0, VAGUE * np.abs(x), 0.1 * (high - low))
        return (error <= most) & (x + 2 * self.above < high)


def known(problem: Problem, x: Array) -> Known:
    """The Known at the minimum x."""
    covariance, axes = _curvature(problem, x)
    errors = np.sqrt(np.diag(covariance))
    bent = np.array([not _straight(problem.residuals, x, axis, problem.bounds) for axis in axes])
    followed = (axes[bent] ** 2).sum(axis=0) > BENT * errors**2
    # a parameter that is correlated with one of these has a curved valley too
    followed |= np.any(np.abs(covariance[followed] / np.outer(errors[followed], errors)) > MOVES_WITH, axis=0)
    below, above = errors.copy(), errors.copy()
    least = float(np.sum(problem.residuals(x) ** 2))
    ends: list[Array] = []  # of the valley of the least certain parameter: the others are also started there
    for i in sorted(np.flatnonzero(followed), key=lambda i: -errors[i] / max(abs(x[i]), 1e-12)):
        here = []
        for way, side in ((-1, below), (1, above)):
            side[i], end, better = _far(problem, x, least, int(i), way, covariance[:, i] / errors[i], ends)
            if better is not None:
                return Known(covariance, below, above, followed, better)
            here.append(end)
        ends = ends or here
    return Known(covariance, below, above, followed)


def _curvature(problem: Problem, x: Array) -> tuple[Array, Array]:
    """(the covariance, the axes of the error ellipsoid of 1 standard error, one in each row)."""
    J = problem.slopes(x)
    norms = np.linalg.norm(J, axis=0)
    norms[norms == 0] = 1e-300
    # Parameters that are degenerate to the last digits still have errors, very large ones.
    _, sizes, turned = np.linalg.svd(J / norms, full_matrices=False)
    axes = turned / np.maximum(sizes, 1e-9 * sizes[0])[:, None] / norms
    return axes.T @ axes, axes


def _straight(residuals: Callable[[Array], Array], x: Array, axis: Array, bounds: Array) -> bool:
    """Whether chi-square rises by about 4 at two standard errors to either side, as the curvature predicts."""
    least = float(np.sum(residuals(x) ** 2))
    rises = []
    for way in (-2, 2):
        there = x + way * axis
        if np.any((there < bounds[0]) | (there > bounds[1])):
            return False
        rises.append(float(np.sum(residuals(there) ** 2)) - least)
    return RISE / ROUGHLY < min(rises) and max(rises) < RISE * ROUGHLY


def _far(
    problem: Problem, x: Array, least: float, i: int, way: int, along: Array, ends: list[Array]
) -> tuple[float, Array, Array | None]:
    """(one standard error of parameter i to this side, the farthest point at which chi-square had not risen by 4, a
    point with a smaller chi-square if one was found). along: the change of all parameters per standard error of this
    one. ends: further points from which the refits start."""
    error, edge = abs(float(along[i])), float(problem.bounds[int(way > 0), i])
    room = min(abs(edge - float(x[i])), LONGEST * error)
    low, high = (0.0, 0.0), None  # (distance, square root of the rise there): the rise of 4 lies between them
    far, y, at = min(2 * error, room), x, 0.0
    for _ in range(TRIES):
        look()
        begun = [y + way * (far - at) / error * along, *ends]
        found = [_valley(problem, start, i, float(x[i]) + way * far) for start in begun]
        chi2, there = min(found, key=lambda each: each[0])
        if chi2 < least - BETTER:
            return error, y, there
        root = float(np.sqrt(max(chi2 - least, 0.0)))
        if abs(root - 2) < 2 * CLOSE:
            return far / root, there, None
        if root < 2:
            if far >= room:
                return np.inf, there, None
            low, y, at = (far, root), there, far
            far = min(far * float(np.clip(2 / max(root, 0.1), *STEPS)), room) if high is None else _between(low, high)
        else:
            high = far, root
            far = _between(low, high)
    return (far / 2 if high else float(np.inf)), y, None


def _between(low: tuple[float, float], high: tuple[float, float]) -> float:
    """The distance at which the root of the rise is 2, by linear interpolation, kept away from both ends."""
    share = (2 - low[1]) / (high[1] - low[1]) if np.isfinite(high[1]) else 0.5
    return low[0] + (high[0] - low[0]) * float(np.clip(share, 0.1, 0.9))


def _valley(problem: Problem, x: Array, i: int, value: float) -> tuple[float, Array]:
    """(chi-square, parameters) with parameter i held at value and the others refitted."""
    others = np.arange(len(x)) != i
    inside = np.clip(x, problem.bounds[0] + 1e-6, problem.bounds[1] - 1e-6)
    inside[i] = value
    if not others.any():
        return float(np.sum(problem.residuals(inside) ** 2)), inside

    def whole(part: Array) -> Array:
        full = inside.copy()
        full[others] = part
        return full

    found = least_squares(lambda part: problem.residuals(whole(part)), inside[others],
                          lambda part: problem.slopes(whole(part))[:, others], tuple(problem.bounds[:, others]),
                          x_scale=problem.sizes[others], max_nfev=15)  # fmt: skip
    return 2 * float(found.cost), whole(found.x)
