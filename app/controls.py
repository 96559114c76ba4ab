"""The controls beside the pictures: a slider a number to type, and the sentence when it cannot be."""

import html
import math

import panel as pn
import panel_material_ui as pmui

from app.explorer import Explorer
from app.pacing import at_once
from tippe_core import Top

STYLE = """
:host { font: 13px/1.35 system-ui, sans-serif; color: #22303c; }
.name { font-size: 14px } .name i, .name sub { font-family: Georgia, serif } .name i { font-size: 17px }
.name sub { font-size: 11px } .note { color: #5b6875 } .alert { color: #b3261e; font-weight: 500 }
"""

SYMBOLS = {
    "K_J": "<i>K</i><sub>J</sub>",
    "K_R": "<i>K</i><sub>R</sub>",
    "mu_s": "<i>μ</i><sub>s</sub>",
    "energy": "<i>E</i>",
    "a": "<i>a</i>",
    "I1": "<i>I</i><sub>1</sub>",
    "I3": "<i>I</i><sub>3</sub>",
    "spin": "<i>ω</i><sub>3</sub>",
    "tilt": "<i>θ</i>",
    "slip": "<i>u</i>",
    "seconds": "<i>t</i>",
    "mu_k": "<i>μ</i><sub>k</sub>",
    "mu": "<i>μ</i>",
    "eps": "<i>ε</i>",
    "gamma": "<i>γ</i>",
}
NAMES = {
    "K_J": "Jellett’s constant",
    "K_R": "Routh’s constant",
    "mu_s": "friction",
    "energy": "energy",
    "a": "eccentricity, in <i>R</i>",
    "I1": "inertia across the axis, in <i>MR</i><sup>2</sup>",
    "I3": "inertia about the axis, in <i>MR</i><sup>2</sup>",
    "spin": "spin, in rev/s",
    "tilt": "tilt, in degrees",
    "slip": "slip, of that with <i>G</i> at rest",
    "seconds": "time computed, in s",
    "mu_k": "sliding friction",
    "mu": "sliding friction",
    "eps": "its slip scale, in (<i>gR</i>)<sup>½</sup>",
    "gamma": "viscous friction, in (<i>gR</i>)<sup>−½</sup>",
}
# start, end and step of each slider; a typed number may lie outside.
RANGES = {
    "K_J": (0, 9, 0.01),
    "K_R": (-20, 20, 0.05),
    "mu_s": (0, 1.5, 0.005),
    "energy": (0, 2.2, 0.005),
    "a": (-2, 0.5, 0.005),
    "I1": (0.05, 2, 0.001),
    "I3": (0.05, 2, 0.001),
    "spin": (0, 40, 0.1),
    "tilt": (0, 180, 0.5),
    "slip": (0, 1, 0.01),
    "seconds": (0.5, 30, 0.5),
    "mu_k": (0.01, 1, 0.005),
    "mu": (0.01, 1, 0.005),
    "eps": (0.01, 1, 0.005),
    "gamma": (0, 2, 0.01),
}
FOLLOW_HAND = """
const text = String(Number(cb_obj.value.toPrecision(6))).replace("-", "−")
entry.data.setv({value_input: text}, {sync: false})
"""
PRINTED = ". The paper prints about 20; its equation (31) gives this."
ENERGY_MARKS = [{"value": 0, "label": "steady"}, {"value": 1, "label": "slips"}, {"value": 2, "label": "lifts off"}]


def number(value):
    return f"{value:.6g}".replace("-", "−")


class Control:
    """One input: its symbol and name, a slider, a number to type, and a line of words below."""

    def __init__(self, name, value, request):
        self.name, self._request, self._shown, self._follow = name, request, number(value), False
        start, end, step = RANGES[name]
        marked = name == "energy"
        self.slider = pmui.FloatSlider(
            value=value,
            start=start,
            end=end,
            step=step,
            label="",
            show_value=False,
            size="small",
            tooltips=False,
            marks=ENERGY_MARKS if marked else False,
            sizing_mode="stretch_width",
            margin=(-4, 10, 14 if marked else -4, 10),
            tags=[name],
            sx={"& .MuiSlider-markLabel": {"fontSize": 12, "top": 22}},
        )
        at_once(self.slider, "value", "value_throttled")
        self.entry = pmui.TextInput(
            value=number(value),
            label="",
            size="small",
            width=92,
            margin=0,
            tags=[name],
            sx={"& input": {"padding": "4px 8px", "fontSize": 14, "textAlign": "right"}},
        )
        self.words = pn.pane.HTML("", stylesheets=[STYLE], sizing_mode="stretch_width", margin=0)
        title = pn.pane.HTML(
            f'<div class="name">{SYMBOLS[name]}&ensp;{NAMES[name]}</div>',
            stylesheets=[STYLE],
            margin=(4, 0, 0, 0),
            sizing_mode="stretch_width",
        )
        self.view = pn.Column(
            pn.Row(title, self.entry, sizing_mode="stretch_width", margin=0),
            self.slider,
            self.words,
            sizing_mode="stretch_width",
            margin=(0, 14, 8, 16),
        )
        self._silent = False
        # The number goes with the hand: no need to ask the server for it.
        if not marked:
            self.slider.jscallback(value=FOLLOW_HAND, args={"entry": self.entry})
        self.slider.param.watch(self._slid, "value")
        self.entry.param.watch(self._typed, "value")

    def _slid(self, event):
        if not self._silent:
            self._request(self.name, event.new)

    def _typed(self, event):
        if self._silent:
            return
        try:
            value = float(event.new.replace("−", "-").replace(",", "."))
            if not math.isfinite(value):
                raise ValueError
        except ValueError:
            self._say(html.escape(f"“{event.new}” is not a number. Type one, such as {self._shown}."), "alert")
            return
        self._follow = True
        self._request(self.name, value, typed=True)

    def show(self, value, shown, note, message):
        """value: the input as it was solved; shown: the number for the field. A message stands in the note's place,
        and then the field keeps what was typed. The slider is moved only after typing: under a hand it is ahead."""
        if message:
            self._follow = False
            self._say(html.escape(message), "alert")
            return
        self._silent, self._shown = True, number(shown)
        if self._follow:
            self.slider.param.update(start=min(self.slider.start, value), end=max(self.slider.end, value), value=value)
            self._follow = False
        self.entry.value = self._shown
        self._silent = False
        self._say(note, "note")

    def _say(self, words, kind):
        self.entry.error_state = kind == "alert"
        text = f'<div class="{kind}" {"role=alert" if kind == "alert" else ""}>{words}</div>' if words else ""
        if self.words.object != text:
            self.words.object = text


class Controls:
    """All of them, wired to a Pacer's requests."""

    def __init__(self, explorer, pacer):
        self._explorer, self._pacer = explorer, pacer
        self._controls = {name: Control(name, getattr(explorer, name), self._request) for name in Explorer.INPUTS}

    def _request(self, name, value, typed=False):
        if name == "energy" and typed:
            value = self._explorer.scene.marks.share(value)
        self._pacer.request(**{name: value})

    def views(self, *names):
        return [self._controls[name].view for name in names]

    def pick(self, K_J):
        """As if K_J had been typed."""
        self._controls["K_J"].entry.value = number(round(K_J, 3))

    def show(self, scene):
        low, high = scene.plane.K_J_range
        K_J = scene.constants.K_J
        self._controls["K_J"].slider.param.update(start=min(low, K_J), end=max(high, K_J))
        notes = self._notes(scene)
        for name, control in self._controls.items():
            value = getattr(self._explorer, name)
            shown = scene.constants.E if name == "energy" else value
            control.show(value, shown, notes.get(name, ""), scene.messages.get(name))

    @staticmethod
    def _notes(scene):
        spin, marks = scene.upright_spin, scene.marks
        turns = spin * scene.scales.angular_velocity / (2 * math.pi)
        worst = ("rolls all along", "would slip on the way", "would lift off on the way")[int(scene.regime.max())]
        inner, outer = scene.turning
        said = "".join(f" {html.escape(note)}" for note in scene.notes)
        limits = " · ".join(
            f"{word} {number(round(E, 4))}"
            for word, E in (("steady", marks.steady), ("slips from", marks.slip), ("lifts off from", marks.lift))
            if math.isfinite(E)
        )
        return {
            "K_J": f"(<i>g</i>/<i>R</i>)<sup>½</sup>; the point P is at {number(round(scene.plane.pole, 4))}",
            "K_R": f"<i>ω</i><sub>3</sub> = {spin:.2f} (<i>g</i>/<i>R</i>)<sup>½</sup> = {turns:.1f} rev/s near "
            f"<i>θ</i> = 0, for <i>R</i> = {100 * scene.scales.R:.3g} cm"
            + PRINTED * (scene.constants.K_R == 10 and scene.top == Top.paper()),
            "energy": f"<b>{worst}.</b>{said}<br><i>θ</i> from {inner:.3f} to {outer:.3f} rad "
            f"({math.degrees(inner):.1f}° to {math.degrees(outer):.1f}°)<br>in <i>MgR</i>: {limits}",
        }
