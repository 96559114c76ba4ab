"""Which tops can turn over: the map of all tops, and Figs. 5 and 6 of the selected one."""

from functools import partial

import numpy as np

from app.model.arrival import MU, TILT
from app.model.build.dimensions import named as spoken_name
from app.model.families.known_tops import KnownTop, known_of, known_tops
from app.model.once import ONCE
from app.model.runs import Run, Runs, Stopped
from app.model.setup import PATCH
from app.tabs.families.drawings import LETTERS, pair
from app.text import say, spoken
from app.widgets.cards import alert, flow, note, words
from app.widgets.forms import Button
from app.widgets.tops_map import TopsMap

HIGH = 620  # px


class Tops:
    """scene: the first one; show() sets others. ask: called with inputs of the Explorer; use(name), change(name): show
    a known top in the Lab, or in Build."""

    def __init__(self, scene, ask, use, change, runs=None):
        self._scene, self._runs = scene, runs or Runs()
        self.map = TopsMap(self._look, ask, height=HIGH)
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
        if known and known is not before:
            self._look(known)
        else:
            self.map.show(scene, self._top.name)

    def _look(self, top: KnownTop):
        self._top = top
        self.map.show(self._scene, top.name)
        self.head.object = f"<h2>{spoken_name(top.name)}</h2><div>{sentence(top)}</div>"
        self.figures.object = f'<div role="status">{note(say("family.waits"))}</div>'
        self._runs.begin(Run(partial(self._made, top, self._scene.mu_s), self._drawn), "families")

    def _made(self, top, mu_s, run):
        return ONCE.find(run.wait, (pair, top.name, mu_s, spoken()), lambda: pair(top.shown(mu_s), mu_s))

    def _drawn(self, result):
        failed = isinstance(result, Exception)
        self.figures.object = alert(say("family.failed")) if failed else result
        if failed and not isinstance(result, Stopped):
            raise result


def sentence(top: KnownTop):
    """What a top does, as far as its a and I1/I3 determine it."""
    group = top.limits.group
    key = {"rises part of the way": "part", "can invert": "turns", "never rises": "never", "neutral": "ball",
           "can stand upright": "stands", "never stands upright": "falls"}[group]  # fmt: skip
    return say(f"family.tops.does.{key}", spin=top.bound, tilt=np.degrees(top.limits.rise), runs=top.stands_from,
               mu=MU, let_go=TILT, patch=PATCH)  # fmt: skip
