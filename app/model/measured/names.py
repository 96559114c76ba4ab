"""What the name of a column says: its quantity, its unit, the error of its values, and the run that it is of.

Capstone ends a name with its run ("Angle (rad) Run #1"), Logger Pro and Graphical Analysis begin it with one ("Latest:
Time (s)", "Data Set 2: ..."). A unit stands in brackets, behind a slash, a space or "in", or as in spin_rev_per_s.
"""

import math
import re

import numpy as np

from tippe_core.types import Array

USUAL = {"rev/s": 60.0, "rad/s": 600.0, "deg/s": math.inf}
"""{unit: the largest spin that is plausible in it}."""
STEPS = {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": math.inf}
"""{unit: the longest step from row to row that is plausible in it}."""

ANGLES = {"deg": math.pi / 180, "rad": 1.0}
RATES = {"rev/s": 2 * math.pi, "rad/s": 1.0, "deg/s": math.pi / 180, "rpm": math.pi / 30}
LENGTHS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
UNITS = {
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "frames": 1.0},
    **dict.fromkeys(("tilt", "azimuth"), ANGLES),
    **dict.fromkeys(("spin", "precession"), RATES),
    **dict.fromkeys(("height", "tip", "x", "y", "tip_x", "tip_y", "side", "tip_side"), LENGTHS),
    "line": ANGLES,
    **dict.fromkeys(("axis_side", "axis_up", "axis_x", "axis_y"), LENGTHS),
}
"""{quantity: {unit: its size in s, rad, rad/s or m}}; for frames the frame rate is needed as well."""

# The names of each quantity in tables, in lower case and reduced to letters and digits.
NAMES = {
    "time": "t time zeit seconds frame frames bild bilder timestamp secondselapsed elapsed elapsedtime zeitstempel "
    "datetime clock clocktime uhrzeit timesincestart relativetime tiempo segundos fotograma fotogramas imagen imágenes",
    "tilt": "tilt theta θ angle winkel neigung inclination nutation tiltangle neigungswinkel "
    "inclinación ángulo ángulodeinclinación",
    "line": "thetar θr positionangle",
    "azimuth": "azimuth azimut acimut phi φ ϕ",
    "spin": "spin omega3 omegaz ω3 ωz w3 ω omega rpm drehung drehzahl eigendrehung gyroscopez gyroskopz gyroz wz "
    "rotationratez angularvelocity angularvelocityz winkelgeschwindigkeit winkelgeschwindigkeitz "
    "giro velocidaddegiro velocidadangular velocidadangularz giroscopioz",
    "precession": "precession präzession phidot precessionrate präzessionsrate precesión velocidaddeprecesión",
    "height": "height höhe heightofg h zg altura alturadeg",
    "tip": "tip tipheight stemtip spitze stielende heightoftip alturadelaespiga alturadelapunta",
    "x": "x contactx trackx",
    "y": "y contacty tracky",
    "tip_x": "tipx xtip stemtipx spitzex puntax",
    "tip_y": "tipy ytip stemtipy spitzey puntay",
    "side": "side fromtheside contactfromtheside vonderseite auflagevonderseite",
    "tip_side": "tipside tipfromtheside stemtipfromtheside spitzevonderseite",
    "axis_side": "axisside",
    "axis_up": "axisup",
    "axis_x": "axisx",
    "axis_y": "axisy",
}
_QUANTITY = {name: quantity for quantity, names in NAMES.items() for name in names.split()}
_UNIT = {
    "s": "s", "sec": "s", "second": "s", "seconds": "s", "sekunden": "s", "ms": "ms", "us": "us", "µs": "us",
    "μs": "us", "ns": "ns", "frame": "frames", "frames": "frames", "bild": "frames", "bilder": "frames", "deg": "deg",
    "°": "deg", "degree": "deg", "degrees": "deg", "grad": "deg", "rad": "rad", "radian": "rad", "radians": "rad",
    "rev/s": "rev/s", "u/s": "rev/s", "1/s": "rev/s", "/s": "rev/s", "hz": "rev/s", "rps": "rev/s", "rad/s": "rad/s",
    "rad/sec": "rad/s", "deg/s": "deg/s", "°/s": "deg/s", "grad/s": "deg/s", "rpm": "rpm", "rev/min": "rpm",
    "segundo": "s", "segundos": "s", "fotogramas": "frames", "imágenes": "frames", "grado": "deg", "grados": "deg",
    "grados/s": "deg/s", "radianes": "rad", "vueltas/s": "rev/s", "u/min": "rpm", "1/min": "rpm", "/min": "rpm",
    "mm": "mm", "cm": "cm", "m": "m",
}  # fmt: skip
NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d{1,3})?", re.A)
_UNIT_LAST = re.compile(r"(?:\s+[ie]n\s+|[/_ ]\s*)([^/_\s]*(?:/[^/_\s]+)?)\s*$")
_PER = re.compile(
    r"(?:[\s_]+(?:per|pro|por)[\s_]+|(?<=(?:rad|deg|rev))_)(s|min)[a-z]*|"
    r"(?<!\b[ie]n)[\s·⋅*]*\b(s|min)(?:\^?[-\u2212]1|⁻¹)",
    re.I,
)
_RUN_LAST = re.compile(r"\s+((?:run|lauf|messung|durchgang|ejecución|serie|medición|toma)\s*#?\s*\d+)\s*$", re.I)
_RUN_FIRST = re.compile(r"\s*([^:()\[\]±]{1,40}?)\s*:\s*(?=\S)")
_OF_RADIANS = ("ω", "omega", "angular", "winkel", "velocidadangular")  # a rate of these in 1/s is in rad/s
_CHANNEL = re.compile(r",\s*(?:ch|kanal|canal)\.?\s*[\w&+]+", re.I)  # of Capstone's sensors


def without_run(name: str) -> tuple[str, str]:
    """(the name without its run, the run; "" if there is none)."""
    found = _RUN_LAST.search(name) or _RUN_FIRST.match(name)
    return (name[: found.start()] + name[found.end() :], found[1]) if found else (name, "")


def understood(name: str) -> tuple[str, str, float | None]:
    """(quantity, unit, error) from a column's name; "" or None for what it does not say."""
    name, _, error = without_run(name)[0].partition("±")
    found = NUMBER.fullmatch(error.strip())
    called, raw = without_unit(name)
    bare = re.sub(r"[^a-zäöüßáéíóúñθφϕω0-9]", "", called.lower())
    known = "rad/s" if raw in ("1/s", "/s") and bare.startswith(_OF_RADIANS) else _UNIT.get(raw, "")
    known = known or _UNIT.get(bare.removesuffix("elapsed"), "")  # the name is the unit
    return _QUANTITY.get(bare, ""), known, float(error.strip().replace(",", ".")) if found else None


def without_unit(name: str) -> tuple[str, str]:
    """(the name without its unit, the unit as it stands there in lower case; "" if it says none)."""
    name = _PER.sub(lambda found: "/" + (found[1] or found[2]), _CHANNEL.sub("", name))
    parts = [*re.finditer(r"[(\[]([^)\]]*)[)\]]", name), *_UNIT_LAST.finditer(name)]
    unit = next((part for part in parts if part[1].strip().lower() in _UNIT), None)
    return (name[: unit.start()] + name[unit.end() :], unit[1].strip().lower()) if unit else (name, "")


def is_unit(text: str) -> bool:
    """Whether this is the name of a unit, perhaps in brackets."""
    return without_unit(f"({text.strip('()[] ')})")[1] != ""


def is_run(text: str) -> bool:
    """Whether this is the name of a run, and nothing else."""
    return _RUN_LAST.fullmatch(f" {text}") is not None


def is_from_x(name: str) -> bool:
    """Whether an angle is counted from the horizontal, +x, as Tracker's position angle θr is."""
    return understood(name)[0] == "line"


def likely(quantity: str, values: Array, name: str) -> str:
    """The most likely unit of a column that does not say it."""
    largest = float(np.nanmax(np.abs(values))) if np.isfinite(values).any() else 0.0
    if quantity == "time":
        if re.match("frame|bild|fotograma|im[aá]gen", name.lower()):
            return "frames"
        steps = np.diff(values[np.isfinite(values)])
        step = float(np.median(steps)) if steps.size else 0.0
        return next(unit for unit, most in STEPS.items() if step <= most)
    if UNITS[quantity] is ANGLES:
        return "rad" if largest <= math.pi + 0.2 else "deg"
    if UNITS[quantity] is RATES:
        return next(unit for unit, most in USUAL.items() if largest <= most)
    return "m" if largest < 2 else "mm"
