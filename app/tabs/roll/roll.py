"""The room of a top that rolls: Figs. 5 and 6, the motion over time and in 3-D."""

from functools import partial

import panel as pn

from app.borrowed import at_once
from app.model.colours import COLOURS
from app.model.hands import held, pulled
from app.model.playing import together
from app.state import asked
from app.text import say
from app.widgets.cards import TALL, WIDE, card, first, framed, later, staged, words
from app.widgets.choice import Choice
from app.widgets.controls import named
from app.widgets.near import WhenNear
from app.widgets.plane_card import PlaneCard
from app.widgets.plots import Motion, TimeFigures
from app.widgets.portraits import Curve, Force, Phase, Potential, Ring, Track
from app.widgets.said import said
from app.widgets.surface3d import Surface3D, show_surface
from app.widgets.top3d import Top3D, show_top
from app.widgets.typeset import power

BELOW = 300  # px: Fig. 5 below the top


def plane_symbols():
    return f"({named('K_J')}, {named('angle')})"


def times_rows(times):
    labels = {
        "theta": f"{named('angle')}<br>rad",
        "normal": f"{named('normal')}<br><i>Mg</i>",
        "ratio": named("ratio"),
        "constants": "<br>".join(
            f'<span style="color: {COLOURS[colour]}">{named(name)}</span>'
            for name, colour in {"K_J": "jellett", "K_R": "omega", "energy": "energy"}.items()
        ),
    }
    return [
        pn.Row(
            words(
                f'<div class="quantity">{labels[name]}</div>',
                width=46,
                sizing_mode="stretch_height",
                margin=(6, 0, 0, 0),
            ),
            pn.pane.Bokeh(figure, sizing_mode="stretch_both", margin=0),
            sizing_mode="stretch_both",
            margin=0,
        )
        for name, figure in times.figures.items()
    ]


def unit_words(scene):
    unit = say("roll.says.unit", time=named("time"), milliseconds=scene.scales.time * 1e3)
    return f'<div class="axis">{unit}</div>'


def kept_words(scene):
    """How well the constants, recomputed from the motion, are conserved."""
    return f'<div class="axis key">{say("roll.says.kept", drift=power(scene.drift))}</div>'


class Switch:
    """A card with a choice of several pictures, one at a time; each picture is created when it is first shown."""

    def __init__(self, title, *kinds, soon):
        self._kinds, self._made, self._scene = kinds, {}, None
        self._places = [pn.Column(sizing_mode="stretch_both", margin=0, visible=False) for _ in kinds]
        self._says = said(styles={"min-height": "2.8em"})
        self.view = card(title)
        titles = {say(f"roll.portraits.{kind.name}.title"): i for i, kind in enumerate(kinds)}
        self._switch = Choice(titles, 0, margin=(6, 0, 2, 0))
        self._switch.param.watch(lambda event: soon(partial(self._look, event.new)), "value")

    def make(self):
        self.view.extend([self._switch, *self._places, self._says])

    def _look(self, chosen):
        if chosen not in self._made:
            kind = self._kinds[chosen]
            portrait = self._made[chosen] = kind()
            across, up = portrait.axes
            self._places[chosen].objects = [
                words(up),
                pn.pane.Bokeh(portrait.figure, sizing_mode="stretch_both", margin=0),
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
        self._says.text = self._made[chosen].words(scene)


class Roll:
    """main: the pictures and the controls. pacer: a Pacer, which shows scenes and takes requests; playing: the playback
    of the top; controls: the card with the inputs of the motion; slip: shows this motion on a table on which it slips;
    runs: the page's Runs."""

    def __init__(self, pacer, playing, controls, slip=lambda: None, runs=None):
        self._pacer, self._scene = pacer, None
        self._grasp, self._held = None, {}
        self._motion, self._top = Motion(), Top3D(sizing_mode="stretch_both", tiltable=True)
        self._card = PlaneCard(self._motion, pacer.ask, slip, runs)
        self._plane = self._card.plane
        self._says = said()
        # The functions for each round of pictures; more are added as cards are created.
        self._planes = [self._motion.show, self._plane.show_plane, partial(show_top, self._top)]
        self._times, self._portraits = [], []
        together(playing, self._top)
        self._plane.hand.on_change("data", self._on_plane)
        at_once(self._top, "tilted", "time")
        self._top.param.watch(asked.heard(self._on_axis), "tilted")
        soon = pacer.soon
        self._tilt = Switch(say("roll.cards.tilt"), Phase, Curve, Potential, soon=soon)
        self._table = Switch(say("roll.cards.table"), Track, Ring, Force, soon=soon)
        self._floor = card(say("roll.cards.floor", height=named("height"), plane=plane_symbols()))
        self._floor.stylesheets = [f"{WIDE} {{ :host {{ height: {BELOW}px !important }} }}"]
        self._over_time = card(say("roll.cards.times"))
        plane = card(say("roll.cards.plane", plane=plane_symbols()), *self._card.content, height=f"calc({TALL} - 28px)")
        stage = first(framed(say("roll.cards.top"), self._top), below=BELOW + 12)
        self.main = staged(
            [stage, later(self._floor, 1)],
            [plane, controls, *(later(each, 2) for each in (
                self._over_time, self._tilt.view, self._table.view))],
        )  # fmt: skip
        pacer.shows(self._show_hand, "hand")
        for shows in (self._planes, self._times, self._portraits):
            pacer.shows(partial(self._draw, shows), "pictures")
        pacer.shows(self._card.show_path, "still")
        pacer.shows(self._show_words, "rest")
        for make in (self._make_times, self._make_surface, *(partial(self._make_portraits, switch)
                                                             for switch in (self._tilt, self._table))):  # fmt: skip
            pacer.later(make)

    # ---- created later ----

    def _make_times(self):
        figures = TimeFigures()
        self._add(self._times, self._over_time, figures.show)
        self._over_time.extend([*times_rows(figures), self._says])

    def _make_surface(self):
        surface = Surface3D(sizing_mode="stretch_both", stylesheets=[":host .tippe { min-height: 0 }"])
        at_once(surface, "hand")
        surface.param.watch(asked.heard(self._on_surface), ["hand", "picked"])
        self._add(self._planes, self._floor, partial(show_surface, surface))
        self._floor.append(surface)

    def _make_portraits(self, switch):
        self._add(self._portraits, switch.view, switch.show)
        switch.make()

    def _add(self, shows, card, show):
        """From now on shows scenes in a card while it is near the screen."""
        shown = WhenNear(card, self._pacer.soon, show)
        shown.show(self._scene)
        shows.append(shown.show)

    # ---- requests by hand ----

    def _grabbed(self, grip, theta, K_J, limit):
        """A request from the (K_J, theta) plane; limit: that of the tielines in the picture."""
        self._pacer.ask(**pulled(self._scene, grip, theta, K_J, limit))

    def _on_plane(self, attr, old, new):
        match new:  # a client other than the page may send anything
            case {"grip": [str() as grip], "theta": [int() | float() as theta], "K_J": [int() | float() as K_J]}:
                self._grabbed(grip, theta, K_J, "slip")

    def _on_surface(self, event):
        if event.name == "hand":
            grip, theta, K_J = asked.parts(event.new, asked.text, asked.number, asked.number)
        else:
            grip, (K_J, theta) = "tieline", asked.parts(event.new, asked.number, asked.number)
        self._grabbed(grip, theta, K_J, self._scene.plane.limit)

    def _on_axis(self, event):
        theta, t, grasp = asked.parts(event.new, asked.number, asked.number, asked.number)
        if grasp != self._grasp:  # from then on the hand changes only theta
            self._grasp, self._held = grasp, held(self._scene, t)
        self._pacer.ask(theta=theta, **self._held, given="state")

    # ---- showing a scene ----

    def _show_hand(self, scene):
        self._scene = scene
        self._card.show_selected(scene)

    def _show_words(self, scene):
        self._says.text = unit_words(scene) + kept_words(scene)

    @staticmethod
    def _draw(shows, scene):
        for show in shows:
            show(scene)
