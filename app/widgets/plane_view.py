"""Fig. 6 as the browser draws it: the tielines in the (K_J, theta) plane, the effect of friction, the selected motion
on the same axes as its K_R, and what becomes of both if it slips."""

import json

import numpy as np
import param

from app.bundle import Bundled, pack
from app.model.regimes import WOULD_SLIP
from app.text import listed
from app.widgets.controls import SPIN, SYMBOLS, named
from tippe_core import Top

LIMITED_BY = ("slip", "lift-off", "no motion", "nothing")
ROWS = 128  # of one nutation, for the bead
SHORT = 0.06  # of the theta axis: a shorter tieline is also shown enlarged

PLACE = [f"{SYMBOLS['K_J']} = {{K_J}} {SPIN}", f"{SYMBOLS['angle']} = {{theta}} rad = {{degrees}}°",
         f"{SYMBOLS['energy']} = {{E}} <i>MgR</i>", f"{SYMBOLS['ratio']} = {{ratio}}", "<b>{verdict}</b>"]  # fmt: skip
"""The readings at a point, as HTML; the browser fills in the numbers."""


class PlaneView(Bundled):
    """The figure, which is grabbed in the browser: the bead moves the clock, everything else is requested by `hand`.

    All bytes are float32, from `pack`, except `limits`: a place is decided by them alone, so they are as exact as here.
    """

    REGIMES = "why_html"

    state = param.String(
        default="{}",
        doc="JSON. Of the motion: K_J, K_R, inner, outer, steady (rad), period ((R/g)^1/2), worst (a code of regimes), "
        "roads (the buttons that are offered), near (whether it is also shown enlarged), old (the motion in words if a "
        "value was refused). Of the plane: mu_s, pole, K_J_range, theta_range, field (columns, and the range of K_J). "
        "Of the slipping: touches (its first row, or null), touch (rad, or null), rolls.",
    )
    motion = param.Bytes(default=b"", doc="(n, 2) t, theta of one nutation, evenly spaced.")
    limits = param.Bytes(
        default=b"",
        doc="(11, n) float64: K_J; theta of the lift-off limit's inner end, the slip limit's inner and outer, the "
        "lift-off limit's outer end, the verge of slipping, F_z = 0, the steady precession; E of the slip limit; and "
        "what limits each, an index in LIMITED_BY.",
    )
    field = param.Bytes(default=b"", doc="(2, rows, columns) E and F_h/F_z at any place, rows upwards.")
    path = param.Bytes(default=b"", doc="(n, 5) theta, low, high, K_J, K_R of a Slipping; empty if none is shown.")
    clock = param.String(default="lab", constant=True, doc="The name of the clock that moves the bead.")
    hand = param.List(
        default=[], doc="[grip, theta, K_J] of a hand, the browser writes it; grip: as of app.model.hands.pulled."
    )
    pressed = param.List(default=[], doc="[count, road] of a button, the browser writes it.")

    @classmethod
    def says(cls, language=None):
        words = listed("roll.plane", language) | {"slips": listed("roll.slips", language)}
        words |= {"ways": listed("regimes.way", language), "limited_by": LIMITED_BY, "place": "<br>".join(PLACE)}
        words |= {"roads": listed("roll.roads", language), "near": listed("roll.near", language)}
        return super().says(language) | words | {
            "figure": listed("roll.figures", language)["plane"],
            "up": f"{named('K_J')} {SPIN}", "down": named("K_R"), "across": f"{named('angle')} (rad)",
        }  # fmt: skip

    def __init__(self, **params):
        self._motion, self._plane, self._slipping, self._shown = {}, {}, {}, None
        super().__init__(**params)

    def show_selected(self, scene):
        """The motion, in one small message; the path of another motion goes."""
        constants, (inner, outer) = scene.constants, scene.turning
        worst = int(scene.regime.max())
        near = outer - inner < SHORT * scene.plane.theta_range[1]
        roads = {"slip": worst == WOULD_SLIP, "paper": near and scene.top != Top.paper()}
        self._motion = {
            "K_J": float(constants.K_J), "K_R": float(constants.K_R), "inner": inner, "outer": outer,
            "steady": float(scene.marks.theta_steady), "period": float(scene.rolling.period), "worst": worst,
            "roads": [name for name, is_there in roads.items() if is_there], "near": near,
            "old": f"{constants.K_J:.6g} {constants.K_R:.6g} {constants.E:.6g}".split() if scene.messages else None,
        }  # fmt: skip
        gone = self._shown is not None and scene.rolling is not self._shown
        if gone:
            self._slipping, self._shown = {}, None
        self._tell(motion=_nutation(scene), **({"path": b""} if gone else {}))

    def show_plane(self, scene):
        """What is the same for all motions of one top at one K_R and mu_s."""
        plane = scene.plane
        if not self.is_new(plane):
            return
        lift, slip = plane.lift, plane.slip
        limits = np.array([
            plane.K_J, lift.theta_inner, slip.theta_inner, slip.theta_outer, lift.theta_outer, slip.theta_verge,
            lift.theta_verge, lift.theta_steady, slip.E, _codes(slip), _codes(lift),
        ])  # fmt: skip
        half = (plane.hover_K_J[1] - plane.hover_K_J[0]) / 2
        self._plane = {
            "mu_s": float(scene.mu_s), "pole": plane.pole, "K_J_range": plane.K_J_range,
            "theta_range": plane.theta_range,
            "field": [len(plane.hover_theta), float(plane.hover_K_J[0] - half), float(plane.hover_K_J[-1] + half)],
        }  # fmt: skip
        self._tell(limits=limits.astype("<f8").tobytes(), field=pack([plane.hover_E, plane.hover_ratio]))

    def show_slipping(self, path, scene):
        """path: the Slipping of the Scene; None if there is none."""
        self._shown = scene.rolling
        touch = scene.shape.touch_angle if scene.shape else None
        self._slipping = {"touches": path.touches, "touch": touch, "rolls": path.rolls} if path else {}
        rows = [path.theta, path.low, path.high, path.K_J, path.K_R] if path else []
        self._tell(path=pack(np.column_stack(rows)) if path else b"")

    def _tell(self, **values):
        self.tell(state=json.dumps(self._motion | self._plane | self._slipping), **values)


def _codes(tielines):
    return [LIMITED_BY.index(limit) for limit in tielines.limited_by]


def _nutation(scene):
    """The bytes of `motion`: enough frames of the trajectory to draw one nutation."""
    t, theta = scene.trajectory.t, scene.trajectory.theta
    count = min(int(np.ceil(scene.rolling.period / (t[1] - t[0]))) + 1, len(t))
    every = -(-count // ROWS)
    return pack(np.column_stack([t[:count:every], theta[:count:every]]))
