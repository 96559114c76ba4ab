"""A fit restored from a saved film or a link, without fitting again. Its parameters and their errors are taken from
there; the residuals and correlations are computed from the data again."""

import itertools
from typing import Any

import numpy as np

from app.model.measured.data import Data
from app.model.measured.fit import TOGETHER, Fit, Problem, runs
from app.model.measured.motion import BOUNDS, Model, residuals_of, shifted

DIGITS = 9


def said_of(fit: Fit) -> dict[str, Any]:
    """What is stored of a Fit."""

    def short(x: float) -> float | None:
        return float(f"{x:.{DIGITS}g}") if np.isfinite(x) else None

    names = fit.model.free
    return {
        "values": {name: short(fit.model.values[name]) for name in names},
        "sides": {name: [short(side) for side in fit.sides[name]] for name in names},
        "unknown": list(fit.unknown),
        "sure": bool(fit.sure),
    }


def checked(said: Any, model: Model) -> dict[str, Any]:
    """The result of said_of() for a Fit of this Model, checked. Raises ValueError, KeyError, TypeError."""
    values, sides = dict(said["values"]), dict(said["sides"])
    if {*values} != {*model.free} or {*sides} != {*model.free} or not {*said["unknown"]} <= {*model.free}:
        raise ValueError("fits")
    for name, value in values.items():
        low, high = BOUNDS[name]
        below, above = (np.inf if side is None else float(side) for side in sides[name])
        if not low <= float(value) <= high or not (below > 0 and above > 0):
            raise ValueError(name)
        sides[name] = below, above
    return {"values": values, "sides": sides, "unknown": tuple(said["unknown"]), "sure": said["sure"] is True}


def remembered(model: Model, data: Data, said: dict[str, Any]) -> Fit:
    """The Fit for the result of checked(). Raises TopError if its parameters give no motion."""
    model = model.with_values({name: float(value) for name, value in said["values"].items()})
    residuals, names = residuals_of(model, data), model.free
    J = Problem(model, data).slopes(np.array([model.values[name] for name in names]))
    norms = np.maximum(np.linalg.norm(J, axis=0), 1e-300)
    covariance = np.linalg.pinv((J / norms).T @ (J / norms)) / np.outer(norms, norms)
    size = np.sqrt(np.diag(covariance))
    pairs = (
        (i, j, float(covariance[i, j] / (size[i] * size[j]))) for i, j in itertools.combinations(range(len(names)), 2)
    )
    together = tuple((names[i], names[j], how) for i, j, how in pairs if abs(how) > TOGETHER)
    return Fit(model, said["sides"], covariance, residuals, shifted(data),
               {name: runs(row) for name, row in residuals.of.items()}, said["unknown"], together,
               said["sure"])  # fmt: skip
