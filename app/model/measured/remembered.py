"""A fit restored from a saved film or a link, without fitting again. Its parameters, their errors and correlations are
taken from there; the residuals are computed from the data."""

from typing import Any

import numpy as np

from app.model.measured.data import Data
from app.model.measured.fit import Fit, runs
from app.model.measured.motion import BOUNDS, Model, residuals_of, shifted

DIGITS = 9


def stored_fit(fit: Fit) -> dict[str, Any]:
    """What is stored of a Fit. covariance: the upper triangle, row by row."""

    def short(x: float) -> float | None:
        return float(f"{x:.{DIGITS}g}") if np.isfinite(x) else None

    names = fit.model.free
    return {
        "values": {name: short(fit.model.values[name]) for name in names},
        "sides": {name: [short(side) for side in fit.sides[name]] for name in names},
        "covariance": [short(each) for each in fit.covariance[np.triu_indices(len(names))]],
        "unknown": list(fit.unknown),
        "sure": bool(fit.sure),
    } | ({"given_up": True} if fit.given_up else {})


def checked(stored: Any, model: Model) -> dict[str, Any]:
    """The result of stored_fit() for a Fit of this Model, checked. Raises ValueError, KeyError, TypeError."""
    values, sides = dict(stored["values"]), dict(stored["sides"])
    if {*values} != {*model.free} or {*sides} != {*model.free} or not {*stored["unknown"]} <= {*model.free}:
        raise ValueError("fits")
    for name, value in values.items():
        low, high = BOUNDS[name]
        below, above = (np.inf if side is None else float(side) for side in sides[name])
        if not low <= float(value) <= high or not (below > 0 and above > 0):
            raise ValueError(name)
        sides[name] = below, above
    size, triangle = len(model.free), np.array(stored["covariance"], dtype=float)
    covariance = np.zeros((size, size))
    if triangle.shape != (size * (size + 1) // 2,) or not np.isfinite(triangle).all():
        raise ValueError("covariance")
    covariance[np.triu_indices(size)] = triangle
    covariance += np.triu(covariance, 1).T
    variances = np.diag(covariance)
    if variances.min() <= 0 or (np.abs(covariance) > 1.001 * np.sqrt(np.outer(variances, variances))).any():
        raise ValueError("covariance")
    return {"values": values, "sides": sides, "covariance": covariance, "unknown": tuple(stored["unknown"]),
            "sure": stored["sure"] is True, "given_up": stored.get("given_up") is True}  # fmt: skip


def remembered(model: Model, data: Data, stored: dict[str, Any]) -> Fit:
    """The Fit for the result of checked(). Raises TopError if its parameters give no motion."""
    model = model.with_values({name: float(value) for name, value in stored["values"].items()})
    residuals = residuals_of(model, data)
    return Fit(model, stored["sides"], stored["covariance"], residuals, shifted(data),
               {name: runs(row) for name, row in residuals.of.items()}, stored["unknown"], stored["sure"],
               stored.get("given_up", False))  # fmt: skip
