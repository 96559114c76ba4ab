"""The map of all tops: a/R and I1/I3 decide which of them can turn over."""

import numpy as np
import param

from app.bundle import Bundled
from app.model.build.dimensions import named
from app.model.families.known_tops import known_of, known_tops
from app.state import validate
from app.text import listed
from app.widgets.forms import hear, one_of

POINTS = 80  # of an outline


class TopsMap(Bundled):
    """look: called with a KnownTop that is clicked; ask: called with inputs of the Explorer, when the ring
    of the page's top is dragged. Python sets what it shows, the browser what is requested."""

    state = param.Dict(default={}, doc="tops: name, label, a, ratio and outline of each; here: a, ratio and outline of "
                       "the page's own; chosen: the name of the one that is looked at.")  # fmt: skip
    picked = param.List(default=[], doc="[count, name] of a click.")
    moved = param.List(default=[], doc="[count, a, I1/I3] of the ring while it is dragged.")

    def __init__(self, look, ask, **params):
        super().__init__(sizing_mode="stretch_width", margin=0, **params)
        self._look, self._ask, self._scene = look, ask, None
        hear(self, picked=self._picked, moved=self._moved)

    @classmethod
    def says(cls, language=None):
        return super().says(language) | listed("family.tops", language)

    def show(self, scene, chosen=""):
        """The page's top, and the name of the known one that is looked at."""
        self._scene, known = scene, known_of(scene)
        here = {"a": scene.top.a, "ratio": scene.top.I1 / scene.top.I3,
                "outline": None if known else outline(scene.profile)}  # fmt: skip
        self.state = {"tops": places(), "here": here, "chosen": chosen}

    def _picked(self, event):
        known = {top.name: top for top in known_tops()}
        _, name = validate.parts(event.new, validate.number, one_of(known))
        self._look(known[name])

    def _moved(self, event):
        """Asks for a ball with these numbers and the I1 of the page's top."""
        _, a, ratio = validate.parts(event.new, validate.number, validate.number, validate.number)
        self._ask(a=a, I3=self._scene.top.I1 / ratio)


def places():
    """The known tops on the map."""
    return [{"name": top.name, "label": named(top.name), "a": top.top.a, "ratio": top.ratio,
             "outline": outline(top.outline)} for top in known_tops()]  # fmt: skip


def outline(profile):
    """[[radius, height]], coarse enough for a small picture."""
    every = np.unique(np.linspace(0, len(profile) - 1, POINTS).astype(int))
    return [[round(float(value), 3) for value in row] for row in profile[every]]
