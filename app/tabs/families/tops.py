"""Which tops can turn over: the map of all tops, and Figs. 5 and 6 of the selected one."""

from functools import partial

import numpy as np
import param

from app.bundle import Bundled
from app.model.arrival import MU, TILT
from app.model.build.dimensions import named as spoken_name
from app.model.families.known_tops import KnownTop, known_of, known_tops
from app.model.runs import Run, Runs, Stopped
from app.model.setup import PATCH
from app.state import asked
from app.tabs.families.drawings import LETTERS, pair
from app.text import listed, say
from app.widgets.cards import alert, flow, note, words
from app.widgets.forms import Button, hear, one_of

HIGH = 620  # px
POINTS = 80  # of an outline


class TopsMap(Bundled):
    """The map. Python sets what it shows, the browser what is requested."""

    state = param.Dict(default={}, doc="tops: name, label, a, ratio and outline of each; here: a, ratio and outline of "
                       "the page's own; chosen: the name of the one that is looked at.")  # fmt: skip
    picked = param.List(default=[], doc="[count, name] of a click.")
    moved = param.List(default=[], doc="[count, a, I1/I3] of the ring while it is dragged.")

    @classmethod
    def says(cls, language=None):
        return super().says(language) | listed("family.tops", language)


class Tops:
    """scene: the first one; show() sets others. ask: called with inputs of the Explorer; use(name), change(name): show
    a known top in the Lab, or in Build."""

    def __init__(self, scene, ask, use, change, runs=None):
        self._scene, self._ask, self._runs = scene, ask, runs or Runs()
        self.map = TopsMap(sizing_mode="stretch_width", height=HIGH, margin=0)
        hear(self.map, picked=self._picked, moved=self._moved)
        self.head, self.figures = words(margin=(0, 0, 6, 0)), words(style=LETTERS)
        self.use = Button(say("family.tops.use"), lambda: use(self._top.name), kind="primary")
        self.change = Button(say("family.tops.change"), lambda: change(self._top.name))
        self._top = None
        self._look(known_of(scene) or known_tops()[0])

    @property
    def map_view(self):
        return [words(note(say("family.tops.says")), margin=(0, 0, 6, 0)),
                words(f'<div class="note">{say("family.tops.up")}</div>'), self.map,
                words(note(say("family.tops.drag")), margin=(6, 0, 0, 0))]  # fmt: skip

    @property
    def beside_view(self):
        return [self.head, flow(self.use, self.change), self.figures]

    def show(self, scene):
        """Selects the known top that the page has changed to, if any; otherwise the selection stays."""
        before, known, self._scene = known_of(self._scene), known_of(scene), scene
        self._look(known) if known and known is not before else self._put()

    def _picked(self, event):
        known = {top.name: top for top in known_tops()}
        _, name = asked.parts(event.new, asked.number, one_of(known))
        self._look(known[name])

    def _moved(self, event):
        """Asks for a ball with these numbers and the I1 of the page's top."""
        _, a, ratio = asked.parts(event.new, asked.number, asked.number, asked.number)
        self._ask(a=a, I3=self._scene.top.I1 / ratio)

    def _look(self, top: KnownTop):
        self._top = top
        self._put()
        self.head.object = f"<h2>{spoken_name(top.name)}</h2><div>{sentence(top)}</div>"
        self.figures.object = f'<div role="status">{note(say("family.waits"))}</div>'
        self._runs.begin(Run(partial(self._made, top, self._scene.mu_s), self._drawn), "families")

    def _made(self, top, mu_s, run):
        return pair(top.shown(mu_s), mu_s)

    def _drawn(self, result):
        failed = isinstance(result, Exception)
        self.figures.object = alert(say("family.failed")) if failed else result
        if failed and not isinstance(result, Stopped):
            raise result

    def _put(self):
        scene, known = self._scene, known_of(self._scene)
        here = {"a": scene.top.a, "ratio": scene.top.I1 / scene.top.I3,
                "outline": None if known else outline(scene.profile)}  # fmt: skip
        self.map.state = {"tops": places(), "here": here, "chosen": self._top.name}


def places():
    """The known tops on the map."""
    return [{"name": top.name, "label": spoken_name(top.name), "a": top.top.a, "ratio": top.ratio,
             "outline": outline(top.outline)} for top in known_tops()]  # fmt: skip


def outline(profile):
    """[[radius, height]], coarse enough for a small picture."""
    every = np.unique(np.linspace(0, len(profile) - 1, POINTS).astype(int))
    return [[round(float(value), 3) for value in row] for row in profile[every]]


def sentence(top: KnownTop):
    """What a top does, as far as its a and I1/I3 determine it."""
    group = top.limits.group
    key = {"rises part of the way": "part", "can invert": "turns", "never rises": "never", "neutral": "ball",
           "can stand upright": "stands", "never stands upright": "falls"}[group]  # fmt: skip
    return say(f"family.tops.does.{key}", spin=top.bound, tilt=np.degrees(top.limits.rise), runs=top.stands_from,
               mu=MU, let_go=TILT, patch=PATCH)  # fmt: skip
