"""Keyboard and screen readers, and the tour of the rolling top."""

import numpy as np
import param

from app.bundle import Bundled
from app.text import say
from app.widgets.controls import worst


class Guide(Bundled):
    """The tour and the list of keys, which the head opens; the keys themselves; and a description of the motion, read
    aloud."""

    tour = param.Boolean(default=True, doc="Whether the room of the tour is shown.")
    said = param.String(default="", doc="The present motion in plain words; for a hand at rest.")
    seconds = param.Number(default=1.0, doc="Seconds of the real top in one unit of time.")

    def show(self, scene):
        self.tell(said=spoken(scene), seconds=scene.scales.time)


def spoken(scene):
    """A description of the motion, for screen readers."""
    inner, outer = np.degrees(scene.turning)
    slips = say("roll.says.slip", E=scene.marks.slip) if np.isfinite(scene.marks.slip) else ""
    motion = say("roll.says.motion", worst=worst(scene), inner=inner, outer=outer, turns=scene.turns,
                 E=scene.constants.E)  # fmt: skip
    return motion + slips
