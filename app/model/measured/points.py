"""The points that were followed in a film, and what they show of the top: from the side and from above.

Of two points on the axis, the stem's end and the ball's middle a distance L apart, the film shows one vector. With the
axis at tilt theta leaning towards psi (horizontal), and the camera looking along psi_0 + pi/2:

    from the side   L (sin(theta) cos(psi - psi_0), cos(theta))     so tan(angle) = tan(theta) cos(psi - psi_0)
    from above      L (sin(theta) cos(psi - psi_0), sin(theta) sin(psi - psi_0))

L and psi_0 are fitted. Of one point with Tracker's position angle, counted from +x, only that angle is used.
"""

import re
from collections.abc import Sequence

import numpy as np

from app.model.measured.names import LENGTHS, understood, without_run, without_unit
from tippe_core.types import Array

Roles = dict[int, tuple[str, str]]
"""{column: (its quantity if the film is from the side, if it is from above)}."""
VIEWS = ("side", "above")
BETWEEN = " \u2212 "
STEM = re.compile(r"stem|tip|top|spitze|stiel|end|stift|espiga|punta", re.I)
BALL = re.compile(r"ball|mid|cent|mitte|kugel|zentrum|bola", re.I)
HIGHEST = 0.3
"""m: the stem's end of a top is not higher."""
_POINT = re.compile(r"(?:(.*?)[\s_.]+)?(x|y|θr|theta_?r)\s*", re.I)


def points_of(names: Sequence[str]) -> dict[str, dict[str, int]]:
    """{point: {"x", "y" or "r": its column}}; r is the position angle, the point "" that of a table of one point."""
    found: dict[str, dict[str, int]] = {}
    for i, name in enumerate(names):
        called, unit = without_unit(without_run(name)[0].partition("\u00b1")[0])
        match = _POINT.fullmatch(called.strip())
        if match and BETWEEN.strip() not in name and unit in ("", *LENGTHS, "deg", "°", "rad"):
            found.setdefault((match[1] or "").strip(), {}).setdefault(match[2].lower()[-1], i)
    return {point: axes for point, axes in found.items() if {"x", "y"} <= axes.keys() or "r" in axes}


def pair_of(names: Sequence[str], values: Array) -> tuple[dict[str, int], dict[str, int], str] | None:
    """(columns of the stem's end, of the ball's middle, what both are called), if two points on the axis were
    followed: those with such names, else both of two with any names, the higher one first."""
    points = {point: axes for point, axes in points_of(names).items() if {"x", "y"} <= axes.keys()}
    stem = next((point for point in points if STEM.search(point)), None)
    ball = next((point for point in points if BALL.search(point) and point != stem), None)
    if len(points) == 2 and "" not in points and (stem is None or ball is None):
        one, other = points
        if stem or ball:
            stem, ball = (stem, one if stem == other else other) if stem else (one if ball == other else other, ball)
        else:
            higher = np.nanmean((values[:, points[one]["y"]] - values[:, points[other]["y"]])[:5])
            stem, ball = (one, other) if not higher < 0 else (other, one)
    if stem is None or ball is None:
        return None
    return points[stem], points[ball], f"{stem}{BETWEEN}{ball}"


def with_axis(names: list[str], values: Array) -> tuple[list[str], Array]:
    """The names and values with two further columns, the vector between two points on the axis, if there are two."""
    pair = pair_of(names, values)
    if pair is None:
        return names, values
    stem, ball, called = pair
    steps = np.column_stack([values[:, stem[axis]] - values[:, ball[axis]] for axis in "xy"])
    if not np.nanmax(np.abs(steps), initial=0.0) > 0:
        return names, values
    steps[np.isnan(steps).any(axis=1)] = np.nan
    _, unit = without_unit(names[stem["x"]].partition("\u00b1")[0])
    more = [f"{called} {axis}" + (f" ({unit})" if unit else "") for axis in "xy"]
    one, other = (understood(names[at["x"]])[2] for at in (stem, ball))
    if one and other:
        more = [f"{name} ± {np.hypot(one, other):.3g}" for name in more]
    return [*names, *more], np.column_stack([values, steps])


def roles_of(names: Sequence[str]) -> Roles:
    """What the columns of points are; {} if the view does not matter."""
    points = points_of(names)
    unused = {i: ("", "") for axes in points.values() for i in axes.values()}
    derived = [i for i, name in enumerate(names) if BETWEEN.strip() in name]
    if derived:
        return unused | dict(zip(derived, (("axis_side", "axis_x"), ("axis_up", "axis_y")), strict=True))
    if len(points) != 1:
        return {}
    ((point, axes),) = points.items()
    above = ("tip_x", "tip_y") if STEM.search(point) or "r" in axes else ("x", "y")
    side = ("side", "") if BALL.search(point) else ("tip_side", "tip")
    if "r" in axes:
        side = "", ""
    seen = {axes[name]: (side[i], above[i]) for i, name in enumerate("xy") if name in axes}
    return unused | seen | ({axes["r"]: ("line", "" if seen else "azimuth")} if "r" in axes else {})


def guessed_view(names: Sequence[str], values: Array) -> str:
    """From where the film was most likely taken: from the side, the axis is long and upright at first, and falls to the
    left and to the right more often than it points down."""
    derived = [i for i, name in enumerate(names) if BETWEEN.strip() in name]
    points = points_of(names)
    if not derived and len(points) == 1:
        (axes,) = points.values()
        if "r" in axes:
            turn = values[:, axes["r"]]
            turn = turn[np.isfinite(turn)][:5]
            return "side" if turn.size and _is_upright(float(np.median(turn))) else "above"
        derived = [axes["x"], axes["y"]]
    if not derived:
        return ""
    x, y = values[np.isfinite(values[:, derived]).all(axis=1)][:, derived].T
    if not len(x):
        return "above"
    lengths = np.hypot(x, y)
    first = float(np.median(y[:5]))
    upright = first > 0.6 * float(lengths.max()) and float(np.median(np.abs(x[:5]))) < 0.6 * first
    if len(points) == 1 and (lengths.max() > HIGHEST or np.ptp(y) < 0.05 * first):
        return "above"  # no stem is so high, or so still
    turns = [np.count_nonzero(np.diff(np.sign(row[np.abs(row) > 0.1 * lengths.max()]))) for row in (x, y)]
    return "side" if upright and not (turns[1] > 1 and 2 * turns[1] >= turns[0]) else "above"


def _is_upright(angle: float) -> bool:
    """Whether an angle from +x, in degrees or in rad, is within 60 degrees of straight up."""
    turn = np.radians(angle) if abs(angle) > np.pi + 0.2 else angle
    return bool(abs(turn - np.pi / 2) < np.pi / 3)
