"""The page, layout only: `panel serve app` finds it here."""

import numpy as np
import panel as pn
import panel_material_ui as pmui

from app.builder import Builder
from app.compare import Compare
from app.controls import Controls
from app.explorer import Explorer
from app.pacing import Pacer
from app.plots import PlaneFigure, TimeFigures, follow_clock
from app.surface3d import Surface3D, pack
from app.top3d import Top3D, pack_frames
from app.workshop import Measure, Workshop

PLAIN = {"& button": {"textTransform": "none", "padding": "3px 8px", "whiteSpace": "nowrap"}}
INK = "#22303c"
# Two rows fill a screen; a phone, where the rows of buttons wrap, needs more.
HEIGHT_OF_A_CARD = "max(calc(50vh - 50px), clamp(390px, calc(390px + (700px - 100vw) / 4), 470px))"
HEIGHT = "<i>f</i><sub>1</sub><sup>2</sup>&hairsp;<i>θ̇</i>&hairsp;<sup>2</sup>"
TYPE = """
:host { font: 13px/1.4 system-ui, sans-serif; color: #22303c } h2 { font-size: 15px; margin: 0; font-weight: 600 }
i, sub { font-family: Georgia, serif } sub, sup { font-size: 0.7em; line-height: 0 } i { font-size: 1.1em }
.key { color: #5b6875 } .key span { white-space: nowrap }
.axis { text-align: center } .quantity { font-size: 14px; text-align: right } b { font-weight: 600 }
.swatch { display: inline-block; width: 18px; border-top: 3px solid; margin: 0 4px 0 10px; vertical-align: middle }
"""


def words(text, **options):
    return pn.pane.HTML(text, stylesheets=[TYPE], **({"sizing_mode": "stretch_width", "margin": 0} | options))


def swatch(colour, text, style="solid"):
    return f'<span><span class="swatch" style="border-color: {colour}; border-top-style: {style}"></span>{text}</span>'


def card(title, *content, height=HEIGHT_OF_A_CARD):
    return pn.Column(
        words(f"<h2>{title}</h2>"),
        *content,
        sizing_mode="stretch_width",
        margin=0,
        styles={
            "background": "white",
            "border-radius": "10px",
            "padding": "10px 14px",
            "height": height,
            "box-shadow": "0 1px 3px rgb(34 48 60 / 18%)",
            "box-sizing": "border-box",
            "overflow": "hidden",
        },
    )


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


def on_a_phone():
    """By what the browser says of itself: there the controls cover the pictures, and would have to close first."""
    return "mobi" in pn.state.headers.get("User-Agent", "").lower()


def section(title):
    return words(f"<h2>{title}</h2>", margin=(14, 16, 0, 16))


def page():
    explorer = Explorer()
    plane, times, top, surface = (
        PlaneFigure(),
        TimeFigures(),
        Top3D(sizing_mode="stretch_both"),
        Surface3D(sizing_mode="stretch_both"),
    )

    def show_planes(scene):
        plane.show_plane(scene)
        show_surface(surface, scene)
        show_top(top, scene)

    def show_words(scene):
        with pn.io.hold():
            controls.show(scene)
            kept.object, unit.object = kept_words(scene), unit_words(scene)
            workshop.show_scene(scene)

    kept, unit = words(""), words("")
    pictures = (show_planes, times.show)
    pacer = Pacer(explorer, plane.show_selected, pictures, show_words)
    controls = Controls(explorer, pacer)
    builder = Builder(explorer, pacer.request)
    followers = controls.views("K_J", "K_R", "a", "I1", "I3")
    workshop = Workshop(
        builder,
        explorer,
        {slider.tags[0]: slider for view in followers for slider in view.select(pmui.FloatSlider)},
    )
    measure, compare = Measure(builder), Compare(explorer)
    families = card("Compare tops: Fig. 6 of a family", *compare.figures_view, height="max-content")
    families.styles = families.styles | {"grid-column": "1 / -1"}
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
    sidebar = [
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
    main = pn.Column(
        card("The top", top),
        plane_card(plane),
        card(f"{HEIGHT} over the (<i>K</i><sub>J</sub>, <i>θ</i>) plane: the paper’s Fig. 5", surface),
        times_card(times, unit, kept),
        card("The body, cut along its axis; drag its handles", *workshop.section_view, height="max-content"),
        card("Build a top", *workshop.bench_view, height="max-content"),
        card("Measure your own", *measure.view, height="max-content"),
        card("What friction leaves, of many tops", *compare.map_view, height="max-content"),
        families,
        sizing_mode="stretch_width",
        margin=0,
        styles={
            "display": "grid",
            "grid-template-columns": "repeat(auto-fit, minmax(min(100%, 480px), 1fr))",
            "gap": "12px",
            "padding": "12px",
        },
    )
    page = pmui.Page(
        title="Tippe top explorer",
        sidebar=sidebar,
        sidebar_open=not on_a_phone(),
        main=[main],
        sidebar_width=320,
        theme_toggle=False,
        busy_indicator=None,
    )
    return page


pn.extension(respect_explicit_sizing=True)
page().servable()
