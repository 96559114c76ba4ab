"""The inputs of the start on the three planes, of friction and of hops; and the progress of a run."""

import numpy as np
import panel as pn
import panel_material_ui as pmui

from app.model.planes.planes import PRESETS
from app.model.setup import TABLES
from app.tabs.planes.words import degrees, stem_words
from app.text import listed, say
from app.widgets.cards import BUTTON, alert, card, flow, note, on_click, progress, words
from app.widgets.choice import Choice
from app.widgets.controls import control, track
from app.widgets.numbers import Numbers
from app.widgets.typeset import typeset

NUMBERS = {"contact": ("mu", "patch"), "coulomb": ("mu", "mu_s"), "viscous": ("gamma",), "smoothed": ("mu", "eps")}
BY_HAND = ("spin", "tilt", "slip")
OF_FRICTION = ("mu", "mu_s", "gamma", "eps", "patch")
SWITCHES = ("by", "law", "landing")
SWITCHED = (*SWITCHES, "stem")
SLIDES = ("ordinary", "three")  # planes with friction, on which the top can also hop
NARROW = BUTTON | {"sx": BUTTON["sx"] | {"whiteSpace": "nowrap", "padding": "2px 8px", "minWidth": 0}}


class Wish:
    """A widget that requests a value of one input when it is used by hand; show() sets it to the present value."""

    def __init__(self, view, name, ask):
        self.view, self._shown, self._name, self._ask = view, view.value, name, ask
        view.param.watch(self._chosen, "value")

    def _chosen(self, event):
        if event.new != self._shown:
            self._shown = event.new
            self._ask(**{self._name: event.new})

    def show(self, value):
        self._shown = value
        self.view.value = value


class StartCard:
    """view: a card.

    inputs: those of a Planes; ask: called with new ones; choose: called with the name of a preset; stop: stops the
    present run.
    """

    def __init__(self, inputs, ask, choose, stop):
        self._ask, self._choose, self._law, self._plane = ask, choose, inputs["law"], inputs["plane"]
        self._by, self._refused = inputs["by"], set()  # refused: the controls whose values are
        self.starts = Numbers([control(name) for name in (*BY_HAND, "seconds")], self._set, margin=(0, 14, 8, 16))
        self.numbers = Numbers([control(name) for name in OF_FRICTION], self._set, margin=(0, 14, 8, 16))
        self._shown = ({name: inputs[name] for name in (*BY_HAND, "seconds", *OF_FRICTION)}, {}, {}, {})
        self.switches = {name: self._switch(name, inputs[name]) for name in SWITCHES}
        box = pmui.Checkbox(value=inputs["stem"], label=say("planes.stem.can"), description="", size="small",
                            margin=(0, 14, 0, 6))  # fmt: skip
        self.switches["stem"] = Wish(box, "stem", ask)
        self._said = {name: words(margin=(0, 14, 0, 16)) for name in ("law", "stem", "run", "by")}
        self._lands = words(say("planes.keys.lands"), margin=(6, 14, 0, 16))
        self._bar, end = words(margin=(10, 8)), pmui.Button(label=say("planes.run.stop"), **NARROW)
        on_click(end, lambda event: stop())
        # room is reserved for it, so that nothing below moves when it appears
        self.progress = pn.Row(self._bar, end, sizing_mode="stretch_width", margin=(0, 14, 0, 16))
        self.show_progress(None)
        self.view = card(
            say("planes.cards.start"), self._presets(), self.progress, self._said["run"], self.switches["by"].view,
            self._said["by"], self.starts.view, self.switches["law"].view, self._said["law"],
            self.numbers.view, self._lands, self.switches["landing"].view, self.switches["stem"].view,
            self._said["stem"], height="max-content",
        )  # fmt: skip
        self.look(self._plane)

    def _set(self, name, value, typed):
        self._ask(**{name: value})

    def _switch(self, name, value):
        options = {says: value for value, says in listed(f"planes.{name}").items()}
        return Wish(Choice(options, value, margin=(2, 14, 6, 16)), name, self._ask)

    def _presets(self):
        buttons = []
        for name in PRESETS:
            buttons.append(pmui.Button(label=listed("planes.presets")[name], **NARROW))
            on_click(buttons[-1], lambda event, name=name: self._choose(name))
        return flow(*buttons, margin=(6, 14, 8, 16))

    def show_progress(self, percent):
        """Shows how much of a run is done; None if there is no run."""
        self._bar.object = progress(percent or 0, say("planes.run.progress"))
        self.progress.styles = {"visibility": "hidden" if percent is None else "visible"}

    def look(self, plane):
        """Shows the inputs of friction and hops only on planes that have them, and one that is refused on all: the
        picture is of all three."""
        self._plane, slides = plane, plane in SLIDES
        for part in (self.switches["law"].view, self._said["law"], self._lands, self.switches["landing"].view):
            part.visible = slides or "law" in self._refused
        by = BY_HAND if self._by == "spin" else ()
        seen = {*by, "seconds", *(NUMBERS[self._law] if slides else ())} | self._refused - {*BY_HAND}
        values, notes, messages, nearest = self._shown
        for group, names in ((self.starts, (*BY_HAND, "seconds")), (self.numbers, OF_FRICTION)):
            kept = {name: float(values[name]) for name in names}
            group.show(kept, {name: track(name, kept[name]) for name in names},
                       notes={name: notes.get(name, "") for name in names}, messages=_of(messages, names),
                       refused=_of(values, {*names} & {*messages}), nearest=_of(nearest, {*names} & {*messages}),
                       hidden={*names} - seen)  # fmt: skip

    def show(self, picture, *, busy):
        """Shows the inputs of a Picture, unless newer ones have been requested, and those that were refused."""
        settings = picture.settings
        notes = {name: _note(name, picture) for name in self._shown[0]}
        self._tell(picture, notes | {"stem": stem_words(settings), "by": _start_words(picture)}, busy=busy)
        self.switches["stem"].view.visible = settings.shape is not None and settings.shape.touch_angle is not None

    def refuse(self, refusal):
        """Shows the inputs of a Refusal, and why there is no picture of them."""
        self._tell(refusal, {}, busy=False)

    def _tell(self, answer, notes, *, busy):
        """answer: a Picture or a Refusal. What belongs to no control is said at the head of the card."""
        inputs, messages = answer.inputs, answer.messages
        self._law, self._refused = inputs["law"], {*messages}
        self._by = inputs["by"]
        if not busy:
            at = {name: typeset(said) for name, said in messages.items() if name in self._shown[0]}
            self._shown = ({name: inputs[name] for name in self._shown[0]}, notes, at, answer.nearest)
            for name in SWITCHED:
                self.switches[name].show(inputs[name])
        others = [said for name, said in messages.items() if name not in {*self._shown[0], *self._said, *TABLES}]
        for name, said in self._said.items():
            why = " ".join([*others, messages.get(name, "")]) if name == "run" else messages.get(name, "")
            said.object = alert(why.strip()) or notes.get(name, "")
        self.look(self._plane)


def _of(values, names):
    return {name: values[name] for name in names if name in values}


def _start_words(picture):
    if picture.settings.rolling is None:
        return ""
    return note(say("planes.notes.start", tilt=degrees(picture.state.theta), spin=picture.turns))


def _note(name, picture):
    settings, limits = picture.settings, picture.outcome.thresholds
    if name == "spin":
        holds = {f"upright_{limits.upright.stable}": limits.upright.spin, "inverted_above": limits.launch}
        says = [say(f"planes.notes.{which}", spin=spin * settings.turns) for which, spin in holds.items()
                if np.isfinite(spin)]  # fmt: skip
        return say("planes.notes.spins", stable="; ".join(says)) if says else ""
    if name == "slip":
        return say("planes.notes.slip", speed=100 * picture.slip)
    if name == "eps":
        return say("planes.notes.eps", speed=100 * settings.scales.velocity * settings.eps)
    if name == "gamma":
        return say("planes.notes.gamma", gamma=settings.gamma / settings.scales.velocity)
    return ""
