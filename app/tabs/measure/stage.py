"""The fitted top in 3-D beside what was measured of it."""

import numpy as np
import param

from app.bundle import Bundled, pack
from app.text import say
from app.widgets.top3d import pack_frames


class MeasuredStage(Bundled):
    """Plays a motion on the film's clock, which the pictures over time follow: `tippe:clock:film`, in s of the film."""

    SAYS = ("Stage", "Top3D")
    REGIMES = "here"

    frames = param.Bytes(default=b"", doc="The motion, from pack_frames, its times in s; empty where there is none.")
    profile = param.Bytes(default=b"", doc="The body's outline, as of Top3D.")
    tilts = param.Bytes(default=b"", doc="float32: its tilt at each frame, in degrees")
    measured = param.Bytes(default=b"", doc="float32 rows (t, x, y, z): where the film saw the axis")
    measured_label = param.String(default="")
    a = param.Number(default=None, doc="G's distance below O, in R")
    start = param.Number(default=0.0, doc="s, where the clock stands first")


def show_film(stage, shown, outline):
    """Puts a Shown onto the stage. outline: (k, 2), of the body."""
    motion, none = shown.motion, np.zeros((len(shown.t), 3))
    stage.param.update(
        profile=pack(outline),
        a=float(motion.top.a),
        tilts=pack(np.degrees(shown.tilt)),
        measured=pack(shown.axis),
        measured_label=say("measure.axis" if shown.azimuths else "measure.axis_tilt"),
        start=float(shown.t[0] + 0.6 * (shown.t[-1] - shown.t[0])),
        frames=pack_frames(shown.t, motion.quaternion, motion.contact, motion.com, none, none, none,
                           np.zeros(len(shown.t))),
    )  # fmt: skip
