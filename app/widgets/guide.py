"""Keyboard and screen readers, what is said of accessibility, and the tour of the rolling top."""

import html

import numpy as np
import param

from app.bundle import Bundled
from app.text import listed, say
from app.widgets.controls import worst

RESPONSIBLE = {"who": ""}
"""Who answers for this page, as its operator has set it."""


class Guide(Bundled):
    """The tour, the list of keys and the accessibility statement, which the head opens; the keys themselves; and a
    description of the motion, read aloud."""

    tour = param.Boolean(default=True, doc="Whether the room of the tour is shown.")
    wording = param.String(default="", doc="The present motion in plain words; for a hand at rest.")

    @classmethod
    def says(cls, language=None):
        return super().says(language) | {"statement": statement(language)}

    def show(self, scene):
        self.tell(wording=spoken(scene))


def statement(language=None):
    """Of the page's accessibility: [(heading, paragraphs)], the first its title."""
    told, who = listed("accessibility", language), RESPONSIBLE["who"]
    wording = say("accessibility.who", language, responsible=html.escape(who)) if who else told["nobody"]
    return [(told["title"], [told["about"]]), *((part["heading"], part["wording"]) for part in told["parts"]),
            (told["contact"], [wording, told["further"]])]  # fmt: skip


def spoken(scene):
    """A description of the motion, for screen readers."""
    inner, outer = np.degrees(scene.turning)
    slips = say("roll.says.slip", E=scene.marks.slip) if np.isfinite(scene.marks.slip) else ""
    motion = say("roll.says.motion", worst=worst(scene), inner=inner, outer=outer, turns=scene.turns,
                 E=scene.constants.E)  # fmt: skip
    return motion + slips
