"""Fig. 6 with everything around it: its key, K_R below, and buttons that lead elsewhere."""

from functools import partial

import panel as pn
import panel_material_ui as pmui

from app.model.colours import COLOURS, FAINT
from app.model.explorer import Explorer
from app.model.regimes import WOULD_SLIP
from app.model.roll.slipping import slipping
from app.model.runs import LATER, Run, Runs, Stopped
from app.text import say
from app.widgets.cards import BUTTON, on_click, swatch, words
from app.widgets.controls import SPIN, SYMBOLS, named
from app.widgets.plane_figure import PlaneFigure
from app.widgets.plane_inset import PlaneInset
from app.widgets.slip_lines import HIGH, SlipLines
from tippe_core import Top, TruncatedSphere

# As high as with a button, so that nothing moves when one appears.
ROADS = {"display": "flex", "flex-direction": "row", "gap": "8px", "align-items": "center", "min-height": "36px"}


class PlaneCard:
    """content: the content of a card. motion: a Motion; ask: called with inputs of the Explorer; slip: shows this
    motion on a table on which it slips; runs: the page's Runs. show_selected() is for each scene of a hand,
    plane.show_plane for the pictures, show_path() for a hand at rest."""

    def __init__(self, motion, ask, slip, runs=None):
        self._runs = runs or Runs()
        self.plane = PlaneFigure(motion)
        self.slips, self.near = SlipLines(self.plane), PlaneInset(self.plane)
        self._trajectory = None
        self.slip, self.paper = (
            pmui.Button(label=say(f"roll.roads.{name}"), visible=False, **BUTTON) for name in ("slip", "paper")
        )
        on_click(self.slip, lambda event: slip())
        on_click(self.paper, lambda event: ask(**papers()))

    @property
    def content(self):
        figure = pn.pane.Bokeh(self.plane.figure, sizing_mode="stretch_both", margin=0)
        return (
            words(f'<div class="key">{key()}</div>'),
            pn.Column(
                words(f"{named('K_J')} {SPIN}", sizing_mode=None),
                self.slip,
                self.paper,
                margin=0,
                styles=ROADS,
                sizing_mode="stretch_width",
            ),
            pn.Column(figure, self.near.view, sizing_mode="stretch_both", margin=0, styles={"position": "relative"}),
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
        # takes as long as ten moves, so not in the thread that answers everybody
        self._runs.begin(Run(lambda run: slipping(scene), partial(self._show_slipping, scene)), "slipping", LATER)
        self.near.show(scene)
        self.slip.visible = bool(scene.regime.max() == WOULD_SLIP)
        self.paper.visible = self.near.view.visible and scene.top != Top.paper()

    def _show_slipping(self, scene, path):
        if isinstance(path, Exception):
            if not isinstance(path, Stopped):
                raise path
        elif scene.rolling is self._trajectory:
            with pn.io.hold():
                self.slips.show(path, scene)


def papers():
    """Inputs of the Explorer: the paper's top, as it is at first."""
    shape, top = TruncatedSphere.paper(), Top.paper()
    names = (*Explorer.GIVEN["share"], "given", "mu_s")
    first = {name: Explorer.param[name].default for name in names}
    return first | {"shape": shape, "a": top.a, "I1": top.I1, "I3": top.I3}


def key():
    """What each line means."""
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
