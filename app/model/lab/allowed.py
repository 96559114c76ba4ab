"""The values that the Lab accepts: the range of each input, the sentence about another value, and the nearest accepted
one."""

import math
from types import MappingProxyType
from typing import TypeAlias

from app.model.inputs import INPUTS
from app.model.run import why_not
from app.model.setup import LAWS, TABLES, TOYS
from app.text import say
from tippe_core import Shape, Top, TopError

LIMITS = MappingProxyType({name: (INPUTS[name].least, INPUTS[name].most)
                           for name in ("spin", "tilt", "slip", "mu", "mu_s", "gamma", "eps", "patch")})  # fmt: skip
"""{input: the range in which the Lab lets it be set}."""
POSSIBLE = MappingProxyType({"spin": (-1e6, 1e6), "tilt": (0.0, 180.0), "slip": (-1e6, 1e6)} | {
    name: (0.0, 1e3) for name in ("mu", "mu_s", "gamma", "eps", "patch")
})  # fmt: skip
"""The same for a start that comes from elsewhere, for example from a link: within it the start is kept and shown."""
CHOICES = MappingProxyType({
    "table": (*TABLES, "three"), "toy": tuple(TOYS), "law": LAWS, "landing": ("plastic", "stop"), "stem": (True, False),
})  # fmt: skip
Limits: TypeAlias = MappingProxyType[str, tuple[float, float]]
DIGITS = 3
SHOWN = 30  # characters of an input that is not a number, as quoted in a sentence


def fault(name: str, value: object, limits: Limits = LIMITS) -> str:
    """Why an input cannot have this value, in a sentence; "" if it can."""
    if name == "pushes" or (name == "toy" and isinstance(value, Shape | Top)):
        return ""
    if name in CHOICES:
        return "" if value in CHOICES[name] else say("lab.inputs.unknown", value=str(value)[:SHOWN])
    least, most = limits[name]
    number = _number(value)
    if number is None:
        typed = str(value).strip()[:SHOWN] or say("lab.inputs.nothing")
        return say("lab.inputs.number", value=typed, least=least, most=most)
    if least <= number <= most:
        return ""
    key = name if name in ("spin", "tilt", "mu", "patch") else "range"
    wording = say(f"lab.inputs.{key}", value=number, least=least, most=most)
    return f"{wording} {say('lab.inputs.same', value=number, same=_folded(number))}" if name == "tilt" else wording


def refusal(error: TopError) -> str:
    """Why a start, or a push, is impossible."""
    if error.code in ("stem-below-table", "body-below-table"):
        return say(f"lab.refused.{error.code}", tilt=error.value, most=error.numbers["most"])
    if error.name not in ("push", "at"):
        return why_not(error)
    of_point = "off-body" if error.code == "too-large" else "below"
    return say(f"lab.pushed.{error.code if error.name == 'push' else of_point}", value=error.value, **error.numbers)


def nearest(name: str, value: object) -> float | None:
    """The accepted value that is nearest to this one; for a tilt, the equivalent one; None if it is not a number."""
    number = _number(value)
    if name not in LIMITS or number is None:
        return None
    least, most = LIMITS[name]
    return _folded(number) if name == "tilt" else min(max(number, least), most)


def below(most: float) -> float:
    """The largest number of DIGITS digits that is smaller."""
    unit = 10.0 ** (math.floor(math.log10(most)) - DIGITS + 1)
    return float(f"{(math.ceil(most / unit) - 1) * unit:.{DIGITS}g}")


def _number(value: object) -> float | None:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        return None
    return float(value)


def _folded(tilt: float) -> float:
    """The equivalent tilt from 0 to 180 degrees."""
    return abs((tilt + 180) % 360 - 180)
