"""Fig. 6 with all that stands around it: what its lines are, K_R below, and roads out of it."""

import panel as pn

from app.model.colours import COLOURS, FAINT
from app.model.slipping import slipping
from app.text import say
from app.widgets.cards import swatch, words
from app.widgets.controls import SPIN, SYMBOLS, named
from app.widgets.plane_figure import PlaneFigure
from app.widgets.slip_lines import HIGH, SlipLines


class PlaneCard:
    """content: what goes into a card. motion: a Motion. show_selected() is for each scene of a hand, plane.show_plane
    of the pictures, show_path() for a hand at rest."""

    def __init__(self, motion):
        self.plane = PlaneFigure(motion)
        self.slips = SlipLines(self.plane)
        self._trajectory = None

    @property
    def content(self):
        return (
            words(f'<div class="key">{key()}</div>'),
            words(f"{named('K_J')} {SPIN}"),
            pn.pane.Bokeh(self.plane.figure, sizing_mode="stretch_both", margin=0),
            words(named("K_R")),
            pn.pane.Bokeh(self.slips.below, sizing_mode="stretch_width", height=HIGH, margin=0),
            words(f'<div class="axis">{named("angle")} (rad)</div>'),
        )

    def show_selected(self, scene):
        self.plane.show_selected(scene)
        if scene.rolling is not self._trajectory:
            self.slips.clear()

    def show_path(self, scene):
        self._trajectory = scene.rolling
        self.slips.show(slipping(scene), scene)


def key():
    """What each line is."""
    return "".join(
        (
            swatch(FAINT, say("roll.key.tielines")),
            swatch(COLOURS["friction"], say("roll.key.verge")),
            swatch(COLOURS["normal"], f"{SYMBOLS['normal']} = 0"),
            swatch("var(--ink, #22303c)", say("roll.key.steady"), "dashed"),
            swatch(f"color-mix(in srgb, {COLOURS['friction']} 16%, transparent)", say("roll.key.lost")),
            swatch(COLOURS["theta"], say("roll.key.motion")),
        )
    )
