"""The range of each input, the same in all views. Its name and unit are in controls.toml, under `inputs`."""

from dataclasses import dataclass
from math import inf, isfinite, pi
from types import MappingProxyType


@dataclass(frozen=True)
class Input:
    """One number that a person sets. low to high: its slider, in steps of `step`; digits: the decimals of its field, or
    None, six digits, as at the level Research; least to most: what a person may set it to."""

    low: float
    high: float
    step: float
    digits: int | None = None
    least: float = -inf
    most: float = inf

    def track(self, value: float, bounds: tuple[float, float] | None = None) -> tuple[float, float]:
        """(least, most) of its slider, of bounds or its own; where the value lies beyond, as far as it may be set."""
        low, high = bounds or (self.low, self.high)
        return (low if value >= low else self.least if isfinite(self.least) else value,
                high if value <= high else self.most if isfinite(self.most) else value)  # fmt: skip


INPUTS = MappingProxyType({
    # of a start by hand: rev/s, degrees, slip relative to that with G at rest
    "spin": Input(0, 50, 0.1, 1, -100, 100),
    "tilt": Input(0, 60, 0.1, 1, 0, 180),
    "slip": Input(0, 1.5, 0.05, 2, -10, 10),
    # of friction: R, M and g, but patch in mm
    "mu": Input(0.01, 1, 0.01, 2, 0.01, 1.5),
    "mu_s": Input(0.01, 1, 0.01, 2, 0.01, 1.5),
    "gamma": Input(0, 2, 0.01, 2, 0, 10),
    "eps": Input(0.01, 1, 0.01, 2, 0.01, 5),
    "patch": Input(0.05, 2, 0.05, 2, 0.01, 5),
    # of a rolling motion, and of the top: R, M and g; energy as a share of the marks
    "K_J": Input(0, 9, 0.01),
    "K_R": Input(-20, 20, 0.05),
    "energy": Input(0, 2.2, 0.005),
    "theta": Input(0, pi, 0.005),
    "theta_dot": Input(-8, 8, 0.02),
    "omega2": Input(-8, 8, 0.02),
    "omega3": Input(-16, 16, 0.05),
    "a": Input(-2, 0.5, 0.005),
    "I1": Input(0.05, 2, 0.001),
    "I3": Input(0.05, 2, 0.001),
})  # fmt: skip
