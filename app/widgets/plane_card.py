"""Fig. 6 on the page: what its hand and its buttons ask for, and when it shows what."""

from functools import partial

from app.borrowed import at_once
from app.model.roll.slipping import slipping
from app.model.runs import LATER, Run, Runs
from app.model.start import DEFAULTS, GIVEN
from app.state import validate
from app.widgets.failure import unless_stopped
from app.widgets.forms import one_of
from app.widgets.hold import held
from app.widgets.plane_view import PlaneView
from tippe_core import Top, TruncatedSphere


class PlaneCard:
    """plane: the figure. ask: called with inputs of the Explorer; slip: shows this motion on a table on which it slips;
    runs: the page's Runs. show_path() is for the scene of a hand at rest."""

    def __init__(self, ask, slip, runs=None):
        self._runs, self._trajectory = runs or Runs(), None
        self._roads = {"slip": slip, "paper": lambda: ask(**papers())}
        self.plane = PlaneView(sizing_mode="stretch_both", margin=0)
        at_once(self.plane, "hand", "pressed")
        self.plane.param.watch(validate.handler(self._on_road), "pressed")

    def _on_road(self, event):
        _, road = validate.parts(event.new, validate.number, one_of(self._roads))
        with held():
            self._roads[road]()

    def show_path(self, scene):
        self._trajectory = scene.rolling
        # takes as long as ten moves, so not in the thread that answers everybody
        done = unless_stopped(partial(self._show_slipping, scene))
        self._runs.begin(Run(lambda run: slipping(scene), done), "slipping", LATER)

    def _show_slipping(self, scene, path):
        if scene.rolling is self._trajectory:
            with held():
                self.plane.show_slipping(path, scene)


def papers():
    """Inputs of the Explorer: the paper's top, as it is at first."""
    shape, top = TruncatedSphere.paper(), Top.paper()
    first = {name: DEFAULTS[name] for name in (*GIVEN["share"], "given", "mu_s")}
    return first | {"shape": shape, "a": top.a, "I1": top.I1, "I3": top.I3}
