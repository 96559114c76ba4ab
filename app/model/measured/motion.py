"""A rolling or sliding motion with parameters that can be fitted, as a film shows it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from app.model.measured.data import TRACKS, Data, Series
from tippe_core import (
    Contensou,
    Friction,
    Scales,
    Shape,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    Trajectory,
    Viscous,
    roll,
    slide,
)
from tippe_core.types import Array

BODY = ("a", "I1", "I3")
START = ("tilt", "tilt_rate", "across", "spin")
OF_LAW = {"rolling": (), "smoothed": ("mu", "eps"), "contensou": ("mu", "radius"), "viscous": ("gamma",)}
"""{model: the parameters of its friction law}."""
BOUNDS = {
    "tilt": (1e-3, np.pi - 1e-3), "tilt_rate": (-20.0, 20.0), "across": (-40.0, 40.0), "spin": (-200.0, 200.0),
    "mu": (1e-3, 2.0), "eps": (1e-3, 3.0), "radius": (1e-4, 0.5), "gamma": (1e-4, 5.0),
    "rolling_resistance": (0.0, 0.05), "air_drag": (0.0, 0.05), "a": (-20.0, 0.99), "I1": (1e-3, 400.0),
    "I3": (1e-3, 400.0),
}  # fmt: skip
"""{parameter: its bounds}, in units of R, M and g; across is omega_2'."""
RTOL = 1e-9
NO_MOTION = 1e4  # the residual for parameters that give no motion
MOST_SHIFTED = {"azimuth": 1, "x": 3, "tip_x": 3, "side": 2, "tip_side": 2, "line": 1, "axis_side": 2, "axis_x": 2}
"""{quantity: how many parameters of the camera are fitted to it}: the zero of the azimuth, the origin and direction of
a track, or, from the side, where it is in the picture and the direction from which it is seen; of two points on the
axis that direction and their distance."""
SIDEWAYS = {"side": ("x", "y"), "tip_side": ("tip_x", "tip_y")}
"""{place across a picture from the side: the track of which it is a projection}."""
DIRECTIONS = np.linspace(0, 2 * np.pi, 72, endpoint=False)


@dataclass(frozen=True, eq=False)
class Model:
    """name: a key of OF_LAW. values: those of all its parameters; free: the names of those that are fitted. edge, tip:
    of the stem, if it can touch; tip is its height above O in R."""

    name: str
    top: Top
    scales: Scales
    free: tuple[str, ...]
    values: MappingProxyType[str, float]
    edge: tuple[float, ...] | None = None
    tip: float = 1.0

    def with_values(self, values: dict[str, float]) -> "Model":
        """The Model with some values changed."""
        settled = MappingProxyType({**self.values, **values})
        return Model(self.name, self.top, self.scales, self.free, settled, self.edge, self.tip)

    def with_stem(self, edge: tuple[float, ...] | None, tip: float) -> "Model":
        """The Model with another edge of the stem's end, and the tip at this height above O."""
        return Model(self.name, self.top, self.scales, self.free, self.values, edge, tip)

    def moved(self, t: Array) -> Trajectory:
        """The Trajectory at the times t (s), of which the first is the start. Raises TopError."""
        v, times = self.values, (t - t[0]) / self.scales.time
        top = Top(v["a"], v["I1"], v["I3"])
        state = State(v["tilt"], v["tilt_rate"], v["across"], v["spin"])
        if self.name == "rolling":
            return roll(top, None, times, state)
        return slide(top, state, self._friction(), times, rtol=RTOL, edge=self.edge,
                     rolling_resistance=v["rolling_resistance"], air_drag=v["air_drag"])  # fmt: skip

    def _friction(self) -> Friction:
        v = self.values
        if self.name == "viscous":
            return Viscous(v["gamma"])
        return SmoothedCoulomb(v["mu"], v["eps"]) if self.name == "smoothed" else Contensou(v["mu"], v["radius"])

    def seen(self, t: Array) -> dict[str, Array]:
        """{quantity: what a film would show of it at t}, in rad, rad/s and m; a motion that ends early stays as it
        ended."""
        motion = self.moved(t)
        there = np.minimum(np.arange(len(t)), len(motion.t) - 1)
        theta, phi, omega = motion.theta[there], motion.phi[there], motion.omega[there]
        contact, R = motion.contact[there], self.scales.R
        s, c = np.sin(theta), np.cos(theta)
        tip = contact + self.tip * s[:, None] * np.column_stack([np.sin(phi), -np.cos(phi)])
        height = motion.com[there, 2]
        return {
            "tilt": theta,
            "azimuth": phi,
            "spin": omega[:, 2] * self.scales.angular_velocity,
            "precession": omega[:, 1] / np.maximum(s, 1e-9) * self.scales.angular_velocity,
            "height": R * height,
            "tip": R * (height + (motion.top.a + self.tip) * c),
            "x": R * contact[:, 0],
            "y": R * contact[:, 1],
            "tip_x": R * tip[:, 0],
            "tip_y": R * tip[:, 1],
            "axis_x": s * np.sin(phi),
            "axis_y": -s * np.cos(phi),
            "axis_up": c,
        }


@dataclass(frozen=True, eq=False)
class Residuals:
    """The residuals of a Model, in standard errors, and the model's values at the times of the data, fitted to the
    position of the camera; {quantity: (n,)} each."""

    of: dict[str, Array] = field(default_factory=dict)
    values: dict[str, Array] = field(default_factory=dict)

    @property
    def row(self) -> Array:
        """All residuals, (n,)."""
        return np.concatenate(list(self.of.values()))


def residuals_of(model: Model, data: Data) -> Residuals:
    """The residuals of a model; raises TopError if it gives no motion."""
    times = data.t
    seen, residuals = model.seen(times), Residuals()
    at = {name: np.searchsorted(times, series.t) for name, series in data.series.items()}
    shown = {name: seen[name][at[name]] for name in data.series if name in seen}
    if "azimuth" in shown:
        shown["azimuth"] = shown["azimuth"] + np.mean(data.series["azimuth"].values - shown["azimuth"])
    for x, y in TRACKS:
        if x in shown and len(at[x]) == len(at[y]):
            shown[x], shown[y] = _turned(shown[x], shown[y], data.series[x].values, data.series[y].values)
    for name in SIDEWAYS.keys() & data.series.keys():
        x, y = (seen[each][at[name]] for each in SIDEWAYS[name])
        shown[name] = _from_the_side(x, y, data.series[name].values)
    for name in {"axis_x", "axis_side", "line"} & data.series.keys():
        there = at[name]
        lean, up = seen["axis_x"][there] + 1j * seen["axis_y"][there], seen["axis_up"][there]
        shown |= _axis_seen(name, lean, up, data.series)
    for name, series in data.series.items():
        residuals.values[name] = shown[name]
        residuals.of[name] = (series.values - shown[name]) / series.error
    return residuals


def _turned(x: Array, y: Array, x_seen: Array, y_seen: Array) -> tuple[Array, Array]:
    """A track rotated and shifted to fit the one that was seen: least squares over an angle and a displacement."""
    own, seen = x + 1j * y, x_seen + 1j * y_seen
    own = own - own.mean()
    turn = np.angle(np.vdot(own, seen - seen.mean()))
    track = own * np.exp(1j * turn) + seen.mean()
    return track.real, track.imag


def _from_the_side(x: Array, y: Array, seen: Array) -> Array:
    """The projection of a track that fits the one that was seen: least squares over the direction and a displacement.

    The sum of squares over all directions has up to two minima, so the search begins at the best of many."""
    own = x + 1j * y
    own = own - own.mean()
    square, with_seen = np.sum(own**2), own @ (seen - seen.mean())
    sums = np.real(square * np.exp(-2j * DIRECTIONS)) / 2 - 2 * np.real(with_seen * np.exp(-1j * DIRECTIONS))
    turn = DIRECTIONS[np.argmin(sums)]
    for _ in range(6):  # Newton
        twice, once = square * np.exp(-2j * turn), with_seen * np.exp(-1j * turn)
        bend = 2 * (once.real - twice.real)
        turn -= (twice.imag - 2 * once.imag) / bend if bend > 0 else 0.0
    return np.real(own * np.exp(-1j * turn)) + seen.mean()


def _axis_seen(name: str, lean: Array, up: Array, series: Mapping[str, Series]) -> dict[str, Array]:
    """The axis (lean + up) in a picture, fitted over the camera's direction psi_0 and, of two points, their distance L:

    from above  L lean exp(-i psi_0);  from the side  L (h, up), h = Re lean exp(-i psi_0);  its angle  arctan(h/up)"""
    if name == "axis_x":
        seen = series["axis_x"].values + 1j * series["axis_y"].values
        seen = lean * np.vdot(lean, seen) / max(float(np.vdot(lean, lean).real), 1e-12)
        return {"axis_x": seen.real, "axis_y": seen.imag}
    if name == "line":
        seen = series["line"].values
        turn = DIRECTIONS[np.argmin([np.sum(_between(seen, lean, up, turn)[0] ** 2) for turn in DIRECTIONS])]
        for _ in range(12):  # Gauss and Newton
            left, slope = _between(seen, lean, up, turn)
            turn += float(left @ slope) / max(float(slope @ slope), 1e-12)
        return {"line": seen - _between(seen, lean, up, turn)[0]}
    across, high = series["axis_side"].values, series["axis_up"].values
    a, b, d = across @ lean, np.sum(lean**2), high @ up
    fixed = float(np.vdot(lean, lean).real) / 2 + up @ up

    def parts(turn: Array | float) -> tuple[Array, Array]:
        return np.real(a * np.exp(-1j * turn)) + d, fixed + np.real(b * np.exp(-2j * turn)) / 2

    top, under = parts(DIRECTIONS)  # L = top/under, and the sum of squares falls by top^2/under
    turn = DIRECTIONS[np.argmax(top * np.abs(top) / under)]
    for _ in range(12):  # Newton, for the logarithm of that
        top, under = parts(turn)
        of_top, of_under = np.imag(a * np.exp(-1j * turn)) / top, np.imag(b * np.exp(-2j * turn)) / under
        bend = 2 * (d / top - 1 - of_top**2) + 4 * (1 - fixed / under) + of_under**2
        turn -= (2 * of_top - of_under) / bend if bend < 0 else 0.0
    top, under = parts(turn)
    length = top / under
    return {"axis_side": length * np.real(lean * np.exp(-1j * turn)), "axis_up": length * up}


def _between(seen: Array, lean: Array, up: Array, turn: float) -> tuple[Array, Array]:
    """(the angle from the model's line to the one that was seen, the derivative of the model's by turn)."""
    turned = lean * np.exp(-1j * turn)
    h, left = turned.real, seen - np.arctan2(turned.real, up)
    return (left + np.pi) % (2 * np.pi) - np.pi, up * turned.imag / np.maximum(h**2 + up**2, 1e-12)


def tilt_by_tip(model: Model, heights: Array) -> Array:
    """The tilt at which the stem's tip is at a height (m), on the ball: R + tip cos(theta)."""
    return np.arccos(np.clip((heights / model.scales.R - 1) / model.tip, -1, 1))


def shifted(data: Data) -> int:
    """The number of parameters of the camera that are fitted in addition to those of a Model."""
    return sum(MOST_SHIFTED.get(name, 0) for name in data.series)


def model_of(
    name: str, top: Top, scales: Scales, shape: Shape | None = None, loose: tuple[str, ...] = (), **held: float
) -> Model:
    """The Model in which the start, the friction law and the parameters `loose` are free; held: parameters with fixed
    values. A rolling top may start with any velocities; a sliding one was spun about its axis and released, unless
    tilt_rate and across are loose."""
    if unknown := [each for each in (*loose, *held) if each not in BOUNDS]:
        raise TopError("loose", unknown[0], " | ".join(BOUNDS), code="wrong-kind")
    first = START if name == "rolling" else ("tilt", "spin", *OF_LAW[name])
    free = tuple(dict.fromkeys(each for each in (*first, *loose) if each not in held))
    values = {"tilt": 0.1, "tilt_rate": 0.0, "across": 0.0, "spin": 8.0, "mu": 0.3, "eps": 0.1, "radius": 0.03,
              "gamma": 0.3, "rolling_resistance": 0.0, "air_drag": 0.0, "a": top.a, "I1": top.I1,
              "I3": top.I3}  # fmt: skip
    tip = float(shape.profile()[:, 1].max() / shape.R) if shape else 1.0
    return Model(name, top, scales, free, MappingProxyType(values | held), shape.edge if shape else None, tip)
