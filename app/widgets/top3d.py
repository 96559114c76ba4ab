"""The top in three dimensions: the browser plays poses that were computed here, without further messages."""

import numpy as np
import param

from app.bundle import Bundled, pack
from app.model.playing import Playing


def pack_frames(t, quaternion, contact, com, theta, force, omega, momentum, regime):
    """A trajectory as the bytes of `Top3D.frames`.

    All vectors along the space axes x, y, z (z up); units R, M, g.

    Parameters
    ----------
    t : (n,) times, ascending
    quaternion : (n, 4) x, y, z, w, body to space
    contact : (n, 2) the contact point
    com : (n, 3) G
    theta : (n,) the tilt
    force : (n, 3) the force of the table on the top, in Mg
    omega : (n, 3) angular velocity
    momentum : (n, 3) angular momentum about G
    regime : (n,) codes of app/model/regimes.py
    """
    return np.column_stack((t, quaternion, contact, com, theta, force, omega, momentum, regime)).astype("<f4").tobytes()


class Top3D(Bundled, Playing):
    """The top on its table, with its tracks and arrows, and the bar that plays it.

    While it plays, and when it is moved by hand, it dispatches `tippe:clock` on the browser's window with `{t, index,
    playing}`; it goes to the time of a `tippe:seek` with `{t}`. Tops with a `clock` play together, over the same
    interval of time, and their events are `tippe:clock:<clock>` and `tippe:seek:<clock>`. `tippe.time(clock)` on the
    window is the present time, and `tippe.photo(wide, clock)` a canvas with the picture, so many pixels wide; without a
    clock, that of the rolling top. All this also holds if the top is drawn flat, without WebGL.

    The browser writes `time` when a person moves it, not while it plays, and `camera`; it starts paused if the visitor
    prefers reduced motion. show_track, show_trace: the paths of the contact point on the table and on the ball;
    show_com_path: G and its path; show_cone: the friction cone; the others: the force, omega, and L about G.
    """

    SAYS = ("Stage",)
    REGIMES = "here"

    frames = param.Bytes(default=b"", doc="The motion, from `pack_frames`; empty if there is none.")
    profile = param.Bytes(
        default=b"", doc="The body's outline: float32 rows (radius, height above O along axis 3), in R."
    )
    mu_s = param.Number(
        default=0.5, bounds=(0, None), doc="Coefficient of static friction: the tangent of the cone's half angle."
    )
    seconds = param.Number(default=1.0, bounds=(0, None), doc="Seconds of the real top in one unit of time.")
    label = param.String(default="", doc="What it shows, for screen readers; empty: the rolling top.")
    clock = param.String(default="", constant=True, doc="The name of the clock that several tops share.")
    a = param.Number(
        default=None,
        doc="G's distance below O, in R, where O may leave its height of R: in flight, on a stem. None: it does not.",
    )
    bare = param.Boolean(default=False, constant=True, doc="Whether it has no bar that plays it.")
    speed = param.Number(default=1 / 16, doc="1 is the real top's own speed.")


def show_top(top, scene):
    motion = scene.trajectory
    if not top.is_new(motion):
        top.mu_s = scene.mu_s
        return
    top.tell(
        mu_s=scene.mu_s, profile=pack(scene.profile), seconds=scene.scales.time,
        frames=pack_frames(motion.t, motion.quaternion, motion.contact, motion.com, motion.theta, scene.force,
                           scene.omega, scene.momentum, scene.regime))  # fmt: skip
