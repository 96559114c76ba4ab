"""A top in 3-D that plays a motion once, with a clock of its own; the measured direction of its axis can be shown
beside it."""

import numpy as np
import param

from app.bundle import Bundled, pack
from app.widgets.top3d import pack_frames


class FilmStage(Bundled):
    """Plays a motion. Its clock, which figures over time can follow, is `tippe:clock:<clock>`, in s."""

    SAYS = ("Stage", "Top3D", "FilmStage")
    REGIMES = "here"

    clock = param.String(default="film", constant=True, doc="The name of its clock, different for each.")
    label = param.String(default="", constant=True, doc="What it shows, for screen readers")
    none = param.String(default="", constant=True, doc="The words while there is no motion")
    frames = param.Bytes(default=b"", doc="The motion, from pack_frames, with times in s; empty if there is none.")
    profile = param.Bytes(default=b"", doc="The body's outline, as of Top3D.")
    tilts = param.Bytes(default=b"", doc="float32: its tilt at each frame, in degrees")
    measured = param.Bytes(default=b"", doc="float32 rows (t, x, y, z): where the film saw the axis")
    measured_label = param.String(default="")
    a = param.Number(default=None, doc="G's distance below O, in R")
    start = param.Number(default=0.0, doc="s, the first time of the clock")
    anew = param.Boolean(False, constant=True, doc="Whether the time of a new motion is the start.")


def clear_motion(stage):
    """Shows none on a FilmStage."""
    stage.param.update(frames=b"", tilts=b"", measured=b"")


def put_motion(stage, t, motion, outline, start, **others):
    """Shows a Trajectory on a FilmStage. t: its times, s; outline: (k, 2), that of the body."""
    none, code = np.zeros((len(t), 3)), np.zeros(len(t))
    stage.param.update(
        profile=pack(outline),
        a=float(motion.top.a),
        tilts=pack(np.degrees(motion.theta)),
        start=float(start),
        frames=pack_frames(t, motion.quaternion, motion.contact, motion.com, motion.theta, none, none, none, code),
        **others,
    )
