"""The pictures of the rolling motion: Figs. 5 and 6, portraits."""

from functools import partial

import panel as pn

from app.borrowed import at_once
from app.model.hands import pulled
from app.state import validate
from app.text import say
from app.widgets.cards import column, words
from app.widgets.controls import named
from app.widgets.drawing import drawn
from app.widgets.forms import Choice
from app.widgets.plane_card import PlaneCard
from app.widgets.portraits import Curve, Force, Phase, Potential, Ring, Track
from app.widgets.surface3d import Surface3D, show_surface
from app.widgets.typeset import power

HIGH = "calc(var(--type, 1) * clamp(420px, 100vh - 400px, 700px))"  # of a panel
HALF = 330  # px: of two portraits


class Switch:
    """A choice of several portraits, one at a time; each is created when it is first shown. soon: that of a
    RenderScheduler."""

    def __init__(self, title, *kinds, soon):
        self._kinds, self._made, self._scene = kinds, {}, None
        self._places = [pn.Column(sizing_mode="stretch_both", margin=0, visible=False) for _ in kinds]
        self._says = words(styles={"min-height": "2.8em"})
        self._switch = Choice({say(f"roll.portraits.{kind.name}.title"): i for i, kind in enumerate(kinds)}, 0)
        self._switch.param.watch(lambda event: soon(partial(self._look, event.new)), "value")
        self.view = column(words(f"<h2>{title}</h2>"), self._switch, *self._places, self._says, height=HALF)

    def _look(self, chosen):
        if chosen not in self._made:
            kind = self._kinds[chosen]
            portrait = self._made[chosen] = drawn(kind)
            across, up = portrait.axes
            self._places[chosen].objects = [
                words(up),
                portrait.drawing,
                words(f'<div class="axis">{across}</div>'),
            ]
        self.show(self._scene)
        for i, place in enumerate(self._places):
            place.visible = i == chosen

    def show(self, scene):
        """Draws the chosen picture."""
        self._scene = scene
        chosen = self._switch.value
        if chosen not in self._made:
            return self._look(chosen)
        self._made[chosen].show(scene)
        self._says.object = self._made[chosen].words(scene)


class Rolling:
    """plane(), surface() and portraits() return the content of a panel, and {when: what draws a scene in it}, as of a
    RenderScheduler. scheduler: takes requests; runs: the page's Runs; slip: shows this motion on a table on which it
    slips."""

    def __init__(self, scheduler, runs, slip):
        self._pacer, self._runs, self._slip, self._scene = scheduler, runs, slip, None
        self.kept = words()

    def plane(self):
        card = PlaneCard(self._pacer.ask, self._slip, self._runs)
        card.plane.param.watch(validate.handler(partial(self._grabbed, limit="slip")), "hand")

        def select(scene):
            self._scene = scene
            card.plane.show_selected(scene)

        place = column(card.plane, styles={"height": HIGH})
        return [place], {"hand": select, "pictures": card.plane.show_plane, "still": card.show_path}

    def surface(self):
        surface = Surface3D(sizing_mode="stretch_both", stylesheets=[":host .tippe { min-height: 0 }"])
        at_once(surface, "hand")
        surface.param.watch(validate.handler(lambda event: self._grabbed(event, self._scene.plane.limit)), "hand")

        def draw(scene):
            self._scene = scene
            show_surface(surface, scene)

        plane = f"({named('K_J')}, {named('angle')})"
        title = words(f"<h2>{say('roll.cards.floor', height=named('height'), plane=plane)}</h2>")
        place = column(title, surface, styles={"height": HIGH})
        return [place], {"pictures": draw}

    def portraits(self):
        switches = [Switch(say(f"roll.cards.{name}"), *kinds, soon=self._pacer.soon)
                    for name, *kinds in (("tilt", Phase, Curve, Potential), ("table", Track, Ring, Force))]  # fmt: skip

        def draw(scene):
            for switch in switches:
                switch.show(scene)

        return [switch.view for switch in switches], {"pictures": draw}

    def say(self, scene):
        """Says what a unit of time is, and how well the constants of a rolling motion stay; nothing of None."""
        if scene is None:
            self.kept.object = ""
            return
        unit = say("roll.says.unit", time=named("time"), milliseconds=scene.scales.time * 1e3)
        kept = say("roll.says.kept", drift=power(scene.drift))
        self.kept.object = f'<div class="axis">{unit}</div><div class="axis key">{kept}</div>'

    # ---- requests by hand ----

    def _grabbed(self, event, limit):
        """A request from the (K_J, theta) plane; limit: that of the tielines in the picture."""
        grip, theta, K_J = validate.parts(event.new, validate.text, validate.number, validate.number)
        self._pacer.ask(**pulled(self._scene, grip, theta, K_J, limit))
