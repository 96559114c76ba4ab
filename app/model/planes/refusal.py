"""Why inputs give no run on the three planes: at which control that is said, and the nearest value that is possible."""

from dataclasses import dataclass, field
from math import ceil, copysign, floor, log10
from types import MappingProxyType
from typing import Any

from app.model.motion import for_reader
from app.model.setup import MOST_SECONDS, Setup
from app.text import told
from tippe_core import TopError, strongest_friction

CONTROL = MappingProxyType({"friction": "law", "mu_k": "mu", "radius": "patch", "width": "patch"})
"""{name of an input of the core: its control}, where they differ."""
LEAST = MappingProxyType({"mu": 0.01, "eps": 0.01, "gamma": 0.0, "patch": 0.0, "tilt": 0.0,
                          "seconds": 0.5})  # fmt: skip
"""{input: the smallest value to be taken instead of one that is too small}."""
MOST = MappingProxyType({"tilt": 180.0, "seconds": MOST_SECONDS})
DIGITS = 3


@dataclass(frozen=True, eq=False, kw_only=True)
class Refusal:
    """The answer to inputs that give no Picture. inputs: those of the Planes, by name; messages: {control, or "run": a
    sentence}; nearest: {control: the nearest possible value}, where there is one."""

    inputs: MappingProxyType[str, Any]
    messages: MappingProxyType[str, str]
    nearest: MappingProxyType[str, float] = field(default_factory=lambda: MappingProxyType({}))


def refused(error: TopError, settings: Setup) -> tuple[dict[str, str], dict[str, float]]:
    """(messages, nearest) of a Refusal for this error."""
    error = for_reader(error, settings.scales)
    name = CONTROL.get(error.name, error.name)
    if name == "patch":
        error = TopError("patch", settings.patch, ">= 0 mm")
    if settings.rolling is not None and name in ("spin", "tilt", "slip"):
        return {"by": told(error)}, {}
    near = _nearest(name, error, settings)
    return {name: told(error)}, {} if near is None else {name: near}


def _nearest(name: str, error: TopError, settings: Setup) -> float | None:
    value = error.value
    if name == "mu_s":
        return max(settings.mu, LEAST["mu"])  # the sliding one, which it may not be below
    if not isinstance(value, float):
        return None
    if error.code == "too-strong":
        return _below(strongest_friction(settings.top))
    if "most" in error.numbers:
        return copysign(_below(error.numbers["most"]), value)
    least, most = LEAST.get(name, value), MOST.get(name, value)
    near = least if value <= least else min(value, most)
    return None if near == value else near


def _below(most: float) -> float:
    """The largest number of DIGITS digits that is smaller."""
    unit = 10.0 ** (floor(log10(most)) - DIGITS + 1)
    return float(f"{(ceil(most / unit) - 1) * unit:.{DIGITS}g}")
