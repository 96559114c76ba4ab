"""The first tab: a top that rolls, as Figs. 5 and 6, over time, and in 3-D."""

from functools import partial

import numpy as np
import panel as pn
import panel_material_ui as pmui

from app.borrowed import at_once
from app.model.colours import COLOURS
from app.model.region import least_energy
from app.state import asked
from app.text import say
from app.widgets.cards import PLAIN, card, grid, section, swatch, words
from app.widgets.controls import SPIN, Controls, named, worst
from app.widgets.guide import Guide
from app.widgets.look import Look
from app.widgets.pacing import Pacer
from app.widgets.plane_figure import PlaneFigure
from app.widgets.plots import Motion, TimeFigures
from app.widgets.portraits import Curve, Force, Phase, Potential, Ring, Track
from app.widgets.surface3d import Surface3D, show_surface
from app.widgets.top3d import Top3D, show_top


def plane_symbols():
    return f"({named('K_J')}, {named('angle')})"


def plane_content(plane):
    key = "".join(
        (
            swatch("#8a96a3", say("roll.key.tielines")),
            swatch("#D55E00", say("roll.key.verge")),
            swatch("#009E73", f"{named('normal')} = 0"),
            swatch("var(--ink, #22303c)", say("roll.key.steady"), "dashed"),
            swatch("#fbe3d5", say("roll.key.lost")),
            swatch("#0072B2", say("roll.key.motion")),
        )
    )
    return (
        words(f'<div class="key">{key}</div>'),
        words(f"{named('K_J')} {SPIN}"),
        pn.pane.Bokeh(plane.figure, sizing_mode="stretch_both", margin=0),
        words(f'<div class="axis">{named("angle")} (rad)</div>'),
    )


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
    said = say("roll.says.unit", time=named("time"), milliseconds=scene.scales.time * 1e3)
    return f'<div class="axis">{said}</div>'


def kept_words(scene):
    """How well the constants, recomputed from the motion, stay what they are."""
    drift = max(np.ptp(values) / max(1, np.abs(values).max()) for values in (scene.K_J, scene.K_R, scene.E))
    return f'<div class="axis key">{say("roll.says.kept", drift=max(drift, 1e-16))}</div>'


def spoken(scene):
    """What the top does, for the ear."""
    inner, outer = np.degrees(scene.turning)
    turns = scene.upright_spin * scene.scales.angular_velocity / (2 * np.pi)
    slips = say("roll.says.slip", E=scene.marks.slip) if np.isfinite(scene.marks.slip) else ""
    motion = say("roll.says.motion", worst=worst(scene), inner=inner, outer=outer, turns=turns, E=scene.constants.E)
    return motion + slips


class Switch:
    """A card whose one picture at a time is chosen; a picture is made when it is first looked at."""

    def __init__(self, title, *kinds, soon):
        self._kinds, self._made, self._scene = kinds, {}, None
        self._places = [pn.Column(sizing_mode="stretch_both", margin=0, visible=False) for _ in kinds]
        self._says = words("", styles={"min-height": "2.8em"})
        self.view = card(title)
        self._switch = pmui.RadioButtonGroup(
            options={say(f"roll.portraits.{kind.name}.title"): i for i, kind in enumerate(kinds)},
            value=0,
            label="",
            size="small",
            margin=(6, 0, 2, 0),
            sx=PLAIN,
        )
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
        """Draws the picture that is looked at."""
        self._scene = scene
        chosen = self._switch.value
        if chosen not in self._made:
            return self._look(chosen)
        self._made[chosen].show(scene)
        self._says.object = self._made[chosen].words(scene)


class Roll:
    """sidebar: the controls; main: the pictures; hidden: parts that show nothing. pacer and controls serve the other
    tabs too; followers: functions of a scene, called when a hand rests."""

    def __init__(self, explorer):
        motion, top = Motion(), Top3D(sizing_mode="stretch_both", tiltable=True)
        plane = PlaneFigure(motion)
        self.top, self.followers = top, []
        self.guide = Guide(margin=(0, 8))
        self._grasp, self._held = None, {}
        self._on_picture = False  # whether the hand is on a picture, and the controls are to go with it
        # What each round of pictures draws; it grows as the cards are made.
        planes, times, portraits = [motion.show, plane.show_plane, partial(show_top, top)], [], []

        def show_hand(scene):
            plane.show_selected(scene)
            if self._on_picture:
                controls.follow(scene)

        def show_words(scene):
            self._on_picture = False
            with pn.io.hold():
                controls.show(scene)
                kept.object, unit.object = kept_words(scene), unit_words(scene)
                self.guide.param.update(said=spoken(scene), seconds=scene.scales.time)
                for follow in self.followers:
                    follow(scene)

        def draw(shows, scene):
            for show in shows:
                show(scene)

        kept, unit = words(""), words("")
        pictures = [partial(draw, shows) for shows in (planes, times, portraits)]
        self.pacer = pacer = Pacer(explorer, show_hand, pictures, show_words)
        tilt = Switch(say("roll.cards.tilt"), Phase, Curve, Potential, soon=pacer.soon)
        table = Switch(say("roll.cards.table"), Track, Ring, Force, soon=pacer.soon)
        self.controls = controls = Controls(explorer, pacer)

        def grabbed(grip, theta, K_J, limit):
            """A hand on the (K_J, theta) plane; limit: the share of energy that the picture's tielines have."""
            self._on_picture = True
            if grip == "tieline":
                pacer.request(K_J=K_J, energy=limit, given="share")
            elif grip == "line":
                pacer.request(K_J=K_J, given="share")
            else:
                scene = explorer.scene
                K_J = scene.constants.K_J if grip == "end" else K_J
                theta = min(max(theta, 0.0), np.pi)
                pacer.request(K_J=K_J, E=float(least_energy(theta, scene.top, K_J, explorer.K_R)), given="E")

        def on_surface(event):
            if event.name == "hand":
                grip, theta, K_J = asked.parts(event.new, asked.text, asked.number, asked.number)
            else:
                grip, (K_J, theta) = "tieline", asked.parts(event.new, asked.number, asked.number)
            grabbed(grip, theta, K_J, {"lift-off": 2.0, "slip": 1.0}[explorer.limit])

        def tilted(event):
            theta, t, grasp = asked.parts(event.new, asked.number, asked.number, asked.number)
            if grasp != self._grasp:  # from then on the hand moves theta alone
                self._grasp = grasp
                motion = explorer.scene.rolling([0.0, t])
                w1, w2, w3 = motion.omega[1]
                self._held = {"theta_dot": w1, "omega2": w2, "omega3": w3, "phi": motion.phi[1], "psi": motion.psi[1]}
            pacer.request(theta=theta, **self._held, given="state")

        def on_plane(attr, old, new):
            match new:  # whoever speaks past the page may send anything
                case {"grip": [str() as grip], "theta": [int() | float() as theta], "K_J": [int() | float() as K_J]}:
                    grabbed(grip, theta, K_J, 1.0)

        plane.hand.on_change("data", on_plane)
        at_once(top, "tilted", "time")
        top.param.watch(asked.heard(tilted), "tilted")
        for show in (show_hand, *pictures, show_words):
            show(explorer.scene)

        floor = card(say("roll.cards.floor", height=named("height"), plane=plane_symbols()))
        over_time = card(say("roll.cards.times"))

        def add(shows, show):
            show(explorer.scene)
            shows.append(show)

        def make_surface():
            surface = Surface3D(sizing_mode="stretch_both")
            at_once(surface, "hand")
            surface.param.watch(asked.heard(on_surface), ["hand", "picked"])
            add(planes, partial(show_surface, surface))
            floor.append(surface)

        def make_times():
            figures = TimeFigures(motion)
            add(times, figures.show)
            over_time.extend([*times_rows(figures), unit, kept])

        def make_portraits(switch):
            add(portraits, switch.show)
            switch.make()

        pacer.later = [make_times, make_surface, partial(make_portraits, tilt), partial(make_portraits, table)]
        pn.state.onload(pacer.begin)

        hemisphere = pmui.RadioButtonGroup.from_param(
            explorer.param.upper,
            label="",
            options={say("roll.switches.upper"): True, say("roll.switches.all"): False},
            size="small",
            sx=PLAIN,
        )
        limit = pmui.RadioButtonGroup.from_param(
            explorer.param.limit,
            label="",
            options={say("roll.switches.lift"): "lift-off", say("roll.switches.slip"): "slip"},
            size="small",
            sx=PLAIN,
        )
        look = self.look = Look(width=0, height=0, margin=0)
        dark = pmui.Switch.from_param(
            look.param.dark, label=say("roll.switches.dark"), description="", size="small", margin=(4, 0, 0, 16)
        )
        large = pmui.Switch.from_param(
            look.param.large, label=say("roll.switches.large"), description="", size="small", margin=(4, 0, 0, 16)
        )
        self.sidebar = [
            section(say("roll.sections.motion")),
            *controls.motion,
            section(say("roll.sections.table")),
            *controls.views("mu_s"),
            section(say("roll.sections.top")),
            *controls.views("a", "I1", "I3"),
            section(say("roll.sections.pictures")),
            hemisphere,
            limit,
            section(say("roll.sections.page")),
            pn.Row(dark, large, margin=0, sizing_mode="stretch_width", styles={"flex-wrap": "wrap"}),
        ]
        # Not in the sidebar: what lies there is drawn anew each time that it opens on a phone, and first then.
        self.hidden = [look, pacer.painted]
        self.main = grid(
            card(say("roll.cards.top"), top),
            card(say("roll.cards.plane", plane=plane_symbols()), *plane_content(plane)),
            floor,
            over_time,
            tilt.view,
            table.view,
        )
