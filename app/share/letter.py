"""The paper's figures in a page to mail, which opens without a server or a network: Bokeh and its figures, and the
values of the bundle's own.
"""

import json
from pathlib import Path
from string import Template

from bokeh.embed import components
from bokeh.settings import settings

from app.bundle import values_of
from app.share.export import parameters
from app.text import say
from app.widgets.controls import SYMBOLS
from app.widgets.plane_view import PlaneView
from app.widgets.portraits import Curve, Force, Phase, Potential, Track
from app.widgets.surface3d import Surface3D, show_surface
from app.widgets.times import TimeFigures, label

FIGURES = Template(Path(__file__).with_name("letter.html").read_text(encoding="utf-8"))
SPIN = "(<i>g</i>/<i>R</i>)<sup>½</sup>"
PLANE = f"({SYMBOLS['K_J']}, {SYMBOLS['angle']})"
TYPESET = {
    "a": (SYMBOLS["a"], "<i>R</i>"),
    "I1": (SYMBOLS["I1"], "<i>MR</i><sup>2</sup>"),
    "I3": (SYMBOLS["I3"], "<i>MR</i><sup>2</sup>"),
    "mu_s": (SYMBOLS["mu_s"], ""),
    "K_J": (SYMBOLS["K_J"], SPIN),
    "K_R": (SYMBOLS["K_R"], f"(<i>MR</i><sup>2</sup>)<sup>½</sup> {SPIN}"),
    "E": (SYMBOLS["energy"], "<i>MgR</i>"),
    "theta_inner": ("", "rad"),
    "theta_outer": ("", "rad"),
    "R": ("<i>R</i>", "m"),
    "M": ("<i>M</i>", "kg"),
}


def figures(scene):
    """(HTML, {component: its values}) for the rolling motion of a Scene.

    It is in the language of text.spoken(); in a thread of its own, call it within text.speaking().
    """
    plane, times = PlaneView(), TimeFigures()
    plane.show_selected(scene)
    plane.show_plane(scene)
    plane.state = json.dumps(json.loads(plane.state) | {"roads": []})  # which lead to other motions
    times.show_motions({"rough": scene.trajectory}, "rough", scene.scales, mu=scene.mu_s)
    surface = Surface3D()
    show_surface(surface, scene)
    portraits = [kind() for kind in (Phase, Curve, Potential, Track, Force)]
    for portrait in portraits:
        portrait.show(scene)
    drawn = (*times.figures.values(), *(portrait.figure for portrait in portraits))
    script, divs = components(drawn, wrap_script=True)
    time_divs, portrait_divs = divs[: len(times.figures)], divs[len(times.figures) :]
    rows = "".join(
        f'<div class="row"><div>{label(name)}</div><div class="figure">{div}</div></div>'
        for name, div in zip(times.figures, time_divs, strict=True)
    )
    pictures = "".join(
        f"<section><h2>{say(f'roll.portraits.{portrait.name}.title')}</h2><div>{portrait.axes[1]}</div>"
        f'<div class="figure">{div}</div><div class="axis">{portrait.axes[0]}</div>'
        f'<p class="axis">{portrait.words(scene)}</p></section>'
        for portrait, div in zip(portraits, portrait_divs, strict=True)
    )
    page = FIGURES.substitute(
        card_plane=say("roll.cards.plane", plane=PLANE),
        card_floor=say("roll.cards.floor", height=SYMBOLS["height"], plane=PLANE),
        card_times=say("roll.cards.times"),
        times=rows,
        portraits=pictures,
        unit=say("planes.keys.time"),
        this=say("share.letter.motion"),
        parameters=f"{', '.join(_described(scene))}. {say('share.letter.bokeh')}",
        bokeh=f"<script>{(settings.bokehjs_path() / 'js' / 'bokeh.min.js').read_text(encoding='utf-8')}</script>",
        figures=script,
    )
    return page, {type(part).__name__: values_of(part) for part in (plane, surface)}


def _described(scene):
    known = parameters(scene)
    tilts = {"theta_inner": say("share.letter.least"), "theta_outer": say("share.letter.largest")}
    for name, (symbol, unit) in TYPESET.items():
        yield f"{tilts.get(name, symbol)} = {known[name][0]:.6g} {unit}".rstrip().replace("-", "−")
