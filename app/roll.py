"""The first tab: a top that rolls, as Figs. 5 and 6, over time, and in 3-D."""

import numpy as np
import panel as pn
import panel_material_ui as pmui

from app.cards import INK, PLAIN, card, grid, section, swatch, words
from app.controls import Controls
from app.pacing import Pacer
from app.plots import PlaneFigure, TimeFigures, follow_clock
from app.surface3d import Surface3D, pack
from app.top3d import Top3D, pack_frames

HEIGHT = "<i>f</i><sub>1</sub><sup>2</sup>&hairsp;<i>θ̇</i>&hairsp;<sup>2</sup>"


def plane_card(plane):
    key = "".join(
        (
            swatch("#8a96a3", "tielines under both limits"),
            swatch("#D55E00", "verge of slipping"),
            swatch("#009E73", "<i>F</i><sub>z</sub> = 0"),
            swatch(INK, "steady precession", "dashed"),
            swatch("#fbe3d5", "lost to slipping"),
            swatch("#0072B2", "this motion"),
        )
    )
    return card(
        "Which motions roll: the (<i>K</i><sub>J</sub>, <i>θ</i>) plane, the paper’s Fig. 6",
        words(f'<div class="key">{key}</div>'),
        words("<i>K</i><sub>J</sub>"),
        pn.pane.Bokeh(plane.figure, sizing_mode="stretch_both", margin=0),
        words('<div class="axis"><i>θ</i> (rad)</div>'),
    )


def times_card(times, unit, kept):
    labels = {
        "theta": "<i>θ</i><br>rad",
        "normal": "<i>F</i><sub>z</sub><br><i>Mg</i>",
        "ratio": "<i>F</i><sub>h</sub>/<i>F</i><sub>z</sub>",
        "constants": '<span style="color:#56B4E9"><i>K</i><sub>J</sub></span><br>'
        '<span style="color:#CC79A7"><i>K</i><sub>R</sub></span><br><span style="color:#8C6D00"><i>E</i></span>',
    }
    rows = [
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
    return card(
        "The motion over time; click to look at an instant",
        *rows,
        unit,
        kept,
    )


def unit_words(scene):
    return (
        '<div class="axis"><i>t</i> in (<i>R</i>/<i>g</i>)<sup>½</sup>, '
        f"{scene.scales.time * 1e3:.1f} ms of the real top</div>"
    )


def kept_words(scene):
    """How well the constants, recomputed from the motion, stay what they are."""
    drift = max(np.ptp(values) / max(1, np.abs(values).max()) for values in (scene.K_J, scene.K_R, scene.E))
    return (
        '<div class="axis key">the three constants, recomputed from the motion, vary by less than '
        f"{max(drift, 1e-16):.0e}"
        "</div>"
    )


def show_top(top, scene):
    motion = scene.trajectory
    if top.tags == [id(motion)]:
        top.mu_s = scene.mu_s
        return
    top.tags = [id(motion)]
    top.param.update(
        mu_s=scene.mu_s,
        profile=pack(scene.profile),
        seconds=scene.scales.time,
        frames=pack_frames(
            motion.t,
            motion.quaternion,
            motion.contact,
            motion.com,
            scene.force,
            scene.omega,
            scene.momentum,
            scene.regime,
        ),
    )


def show_surface(surface, scene):
    plane, motion = scene.plane, scene.constants
    if surface.tags != [id(plane)]:
        surface.tags = [id(plane)]
        surface.param.update(
            K_J=pack(plane.K_J),
            theta=pack(plane.theta),
            heights=pack(plane.height),
            energy=pack(plane.surface.E),
            verge=pack(np.column_stack([plane.surface.theta_verge, plane.K_J])),
            steady=pack(np.column_stack([plane.lift.theta_steady, plane.K_J])),
            P=pack([0, plane.pole, plane.pole_height]),
            theta_max=plane.theta_range[1],
            limit=plane.limit,
        )
    surface.param.update(selected=pack([motion.K_J, *scene.turning]), selected_curve=pack(scene.curve))


class Roll:
    """sidebar: the controls; main: the pictures. pacer and controls serve the other tabs too; followers: functions
    of a scene, called when a hand rests."""

    def __init__(self, explorer):
        plane, times, top, surface = (
            PlaneFigure(),
            TimeFigures(),
            Top3D(sizing_mode="stretch_both"),
            Surface3D(sizing_mode="stretch_both"),
        )
        self.followers = []

        def show_planes(scene):
            plane.show_plane(scene)
            show_surface(surface, scene)
            show_top(top, scene)

        def show_words(scene):
            with pn.io.hold():
                controls.show(scene)
                kept.object, unit.object = kept_words(scene), unit_words(scene)
                for follow in self.followers:
                    follow(scene)

        kept, unit = words(""), words("")
        pictures = (show_planes, times.show)
        self.pacer = pacer = Pacer(explorer, plane.show_selected, pictures, show_words)
        self.controls = controls = Controls(explorer, pacer)
        surface.param.watch(lambda event: event.new and controls.pick(event.new[0]), "picked")
        plane.figure.on_event("tap", lambda event: controls.pick(event.y))
        for show in (plane.show_selected, *pictures, show_words):
            show(explorer.scene)
        follow_clock(plane, times)

        hemisphere = pmui.RadioButtonGroup.from_param(
            explorer.param.upper,
            label="",
            options={"upper hemisphere": True, "all of (0, π)": False},
            size="small",
            sx=PLAIN,
        )
        limit = pmui.RadioButtonGroup.from_param(
            explorer.param.limit,
            label="",
            options={"Fig. 5 at lift-off": "lift-off", "at slipping": "slip"},
            size="small",
            sx=PLAIN,
        )
        self.sidebar = [
            section("The motion"),
            *controls.views("K_J", "K_R", "energy"),
            section("The table"),
            *controls.views("mu_s"),
            section("The top"),
            *controls.views("a", "I1", "I3"),
            section("The pictures"),
            hemisphere,
            limit,
            pacer.painted,
        ]
        self.main = grid(
            card("The top", top),
            plane_card(plane),
            card(f"{HEIGHT} over the (<i>K</i><sub>J</sub>, <i>θ</i>) plane: the paper’s Fig. 5", surface),
            times_card(times, unit, kept),
        )
