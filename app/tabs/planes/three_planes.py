"""The tab of the three planes: why a tippe top turns over, and that it takes sliding friction."""

import numpy as np
import panel as pn
import panel_material_ui as pmui

from app.bundle import pack
from app.model.colours import COLOURS
from app.model.planes.picture import PLANES
from app.model.planes.planes import PATIENCE, PRESETS, preset
from app.model.playing import Playing, together
from app.model.regimes import COLOUR, NAMES
from app.tabs.planes.plots import CLOCK, IN_RIBBON, LEDGER, QUANTITIES, Figures, Map, Well, follow_clock
from app.tabs.planes.words import LOOKS, degrees, in_force, stem_words, table_words, verdict_words
from app.text import listed, say
from app.widgets.cards import BUTTON, PLAIN, alert, card, first, flow, note, on_click, progress, staged, swatch, words
from app.widgets.controls import Control, Wish
from app.widgets.top3d import Top3D, pack_frames

NUMBERS = {"contact": ("mu", "patch"), "coulomb": ("mu", "mu_s"), "viscous": ("gamma",), "smoothed": ("mu", "eps")}
NUMBERS_SET = ("spin", "tilt", "slip", "seconds", "mu", "mu_s", "gamma", "eps", "patch")
SWITCHES = ("by", "law", "landing")
SLOWEST, SHORTEST_SHOW = 1 / 64, 12  # a motion is to play for so many seconds at least
POLL = 200  # ms between looks at a run under way
NARROW = BUTTON | {"sx": BUTTON["sx"] | {"whiteSpace": "nowrap", "padding": "2px 8px", "minWidth": 0}}
# Three bars side by side have room for what matters only.
SMALL_BAR = [":host .bar .shows, :host .bar .view, :host .bar .back, :host .bar .forward { display: none }"]
TABLE = (
    f":host {{ --kept: {COLOURS['normal']} }}"
    + """
table { border-collapse: collapse; margin: 6px 0 0; font-size: inherit }
td, th { padding: 3px 12px 3px 0; text-align: left; font-weight: normal; vertical-align: top }
th { color: var(--faint, #5b6875) } .kept { font-weight: 600 } .kept::before { content: "● "; color: var(--kept) }
.line { margin: 2px 0 } .line .swatch { margin-left: 0 } .line b { font-weight: 600 } .says { margin: 6px 0 0 }
"""
)


class ThreePlanes:
    """main: the tab. show(picture), look(plane) and wait() say what is to be seen.

    inputs: of a Planes, as they are at first, with its plane; ask: takes others; ask_top: takes inputs of the Explorer;
    choose: the name of a body; work: the Planes' run under way, with busy, elapsed, share and stop(); playing: the
    Playing of what rolls, which runs, stands and goes as fast as these.
    """

    def __init__(self, inputs, ask, ask_top, choose, work, playing=None):
        self._ask, self._ask_top, self._choose_body, self._work = ask, ask_top, choose, work
        self._poll, self._picture, self._plane = None, None, inputs["plane"]
        self._playing = playing or Playing()
        self._tops = {
            plane: Top3D(sizing_mode="stretch_both", min_width=250, clock=CLOCK, label=say(f"planes.tops.{plane}"),
                         show_momentum=False, show_cone=False)
            for plane in PLANES
        }  # fmt: skip
        for top in self._tops.values():
            together(self._playing, top, ("playing",))
            top.param.watch(self._on_speed, "speed")
        self._playing.param.watch(lambda event: self._set_speed(event.new), "speed")
        self._figures, self._well = Figures(), Well()
        self._map = Map(self.pick, choose)
        follow_clock(self._figures, self._well)
        self._controls = {name: Control(name, inputs[name], self._set) for name in NUMBERS_SET}
        self._switches = {name: self._switch(name, inputs[name]) for name in SWITCHES}
        box = pmui.Checkbox(value=inputs["stem"], label=say("planes.stem.can"), description="", size="small",
                            margin=(0, 14, 0, 6))  # fmt: skip
        self._switches["stem"] = Wish(box, "stem", ask)
        self._said = {name: words(margin=(0, 14, 0, 16)) for name in ("law", "stem", "run", "by")}
        self._verdict, self._table = words(note(say("planes.run.first")), style=TABLE), words(style=TABLE)
        self._force = words(styles={"min-height": "36px"})
        self._build()

    # ---- what a person asks ----

    def _set(self, name, value, typed=False):
        self._ask(**{name: value})

    def pick(self, a, ratio):
        """Asks for the top of this a and I1/I3, with I3 as it is."""
        self._ask_top(a=a, I1=ratio * self._picture.settings.top.I3)

    def _choose(self, name):
        body, inputs = preset(name)
        self._choose_body(body)
        self._ask(**inputs)

    def _on_speed(self, event):
        if event.new != self._speed:  # a hand's: that of what rolls, too
            self._playing.speed = event.new

    def _set_speed(self, speed):
        self._speed = speed
        for top in self._tops.values():
            top.speed = speed

    # ---- the parts ----

    def _switch(self, name, value):
        options = {says: value for value, says in listed(f"planes.{name}").items()}
        buttons = pmui.RadioButtonGroup(value=value, label="", size="small", sx=PLAIN, options=options,
                                        margin=(2, 14, 6, 16))  # fmt: skip
        return Wish(buttons, name, self._ask)

    def _build(self):
        well, tops = (
            card(
                say(f"planes.cards.{name}"),
                words(f'<div class="key">{say(f"planes.keys.{name}")}</div>'),
                pn.pane.Bokeh(shown.figure, sizing_mode="stretch_both", margin=0),
                height=height,
            )
            for name, shown, height in (("well", self._well, "370px"), ("map", self._map, "440px"))
        )
        became = card(say("planes.cards.became"), self._verdict, self._table, height="max-content")
        self.main = staged([self._stage_card()], [became, self._start_card(), self._times_card(), well, tops])

    def _presets(self):
        buttons = []
        for name in PRESETS:
            buttons.append(pmui.Button(label=listed("planes.presets")[name], **NARROW))
            on_click(buttons[-1], lambda event, name=name: self._choose(name))
        return flow(*buttons, margin=(6, 14, 8, 16))

    def _stage_card(self):
        self._row = pn.Column(
            sizing_mode="stretch_both", margin=(6, 0, 0, 0),
            styles={"display": "grid", "gap": "10px"},
            stylesheets=[".scroll-button { display: none !important }"],  # it would take the first place
        )  # fmt: skip
        return first(card(say("planes.cards.stage"), self._force, self._row))

    def _start_card(self):
        views = {name: control.view for name, control in self._controls.items()}
        self._starts = pn.Column(views["spin"], views["tilt"], views["slip"], sizing_mode="stretch_width", margin=0)
        own = NUMBERS[self._switches["law"].view.value]
        self._numbers = {name: pn.Column(views[name], sizing_mode="stretch_width", margin=0, visible=name in own)
                         for name in dict.fromkeys(name for names in NUMBERS.values() for name in names)}  # fmt: skip
        self._bar = words(margin=(10, 8))
        self._show_progress(0)
        stop = pmui.Button(label=say("planes.run.stop"), **NARROW)
        on_click(stop, lambda event: self._work.stop())
        self._progress = pn.Row(self._bar, stop, sizing_mode="stretch_width", margin=(0, 14, 0, 16), visible=False)
        return card(
            say("planes.cards.start"),
            self._presets(),
            self._progress,
            self._said["run"],
            self._switches["by"].view,
            self._said["by"],
            self._starts,
            views["seconds"],
            self._switches["law"].view,
            self._said["law"],
            *self._numbers.values(),
            words(say("planes.keys.lands"), margin=(6, 14, 0, 16)),
            self._switches["landing"].view,
            self._switches["stem"].view,
            self._said["stem"],
            height="max-content",
        )

    def _times_card(self):
        def row(label, figure, height):
            beside = {"width": 50, "sizing_mode": "stretch_height", "margin": (6, 0, 0, 0)}
            return pn.Row(
                words(f'<div class="quantity">{label}</div>', **beside),
                pn.pane.Bokeh(figure, sizing_mode="stretch_both", margin=0),
                sizing_mode="stretch_width",
                height=height,
                margin=0,
            )

        figures = self._figures.figures
        planes = "".join(swatch(colour, say(f"planes.looks.{plane}")) for plane, colour in LOOKS.items())
        ledger = "".join(swatch(colour, say(f"planes.ledger.{name}")) for name, colour in LEDGER.items())
        regimes = "".join(swatch(COLOUR[code], say(f"regimes.stretch.{NAMES[code]}")) for code in IN_RIBBON)
        return card(
            say("planes.cards.times"),
            words(f'<div class="key">{planes}</div>'),
            *(row(say(f"planes.quantities.{name}"), figures[name], 96) for name in QUANTITIES),
            words(f'<div class="key" style="margin-top: 6px">{say("planes.keys.ledger")}{ledger}</div>'),
            row(say("planes.keys.energy"), figures["ledger"], 190),
            words(f'<div class="key" style="margin-top: 6px">{regimes}</div>'),
            row("", figures["regime"], 56),
            words(f'<div class="axis">{say("planes.keys.time")}</div>'),
            height="max-content",
        )

    # ---- what is shown ----

    def wait(self):
        """A run under way is looked at now and then, and shown where it takes long."""
        if self._work.busy and self._poll is None:
            self._poll = pn.state.add_periodic_callback(self._look_at_run, period=POLL)
        elif not self._work.busy and self._poll is not None:
            self._poll.stop()
            self._poll = None
            self._progress.visible = False

    def _look_at_run(self):
        if self._work.elapsed > PATIENCE or self._progress.visible:
            self._show_progress(100 * self._work.share)
            self._progress.visible = True

    def _show_progress(self, percent):
        self._bar.object = progress(percent, say("planes.run.progress"))

    def show(self, picture):
        self._picture, inputs = picture, picture.inputs
        settings, messages = picture.settings, picture.messages
        with pn.io.hold():
            self._starts.visible = inputs["by"] == "spin"
            for name, number in self._numbers.items():
                number.visible = name in NUMBERS[inputs["law"]]
            if not self._work.busy:
                for name, control in self._controls.items():
                    control.show(inputs[name], inputs[name], self._note(name, picture), messages.get(name))
                for name in ("by", "law", "landing", "stem"):
                    self._switches[name].show(inputs[name])
            for name, said in self._said.items():
                said.object = alert(messages.get(name, "")) or {
                    "stem": stem_words(settings), "by": self._start_words(picture)}.get(name, "")  # fmt: skip
            self._switches["stem"].view.disabled = settings.shape is None or settings.shape.touch_angle is None
            self._verdict.object = verdict_words(picture)
            if self._shown is not settings:
                self._figures.show(picture)
                self._map.show(settings.top)
                self._table.object = table_words(picture)
                self._tempo(settings)
                self._shown = settings
                self.look(self._plane)

    _shown = _paced = _speed = None

    def _tempo(self, settings):
        """The speed that somebody chose; else one at which the motion can be watched, when its length is new."""
        if self._playing.speed != Playing.param.speed.default:
            self._set_speed(self._playing.speed)
        elif self._paced != settings.seconds:
            self._paced, speed = settings.seconds, 1.0
            while settings.seconds / speed < SHORTEST_SHOW and speed > SLOWEST:
                speed /= 2
            self._set_speed(speed)

    def look(self, plane):
        """At this plane, or at all that are to "compare"."""
        picture, self._plane = self._picture, plane
        if picture is None:
            return
        compare = plane == "compare"
        with pn.io.hold():
            self._spread(compare)
            for name, top in self._tops.items():
                top.visible = plane in (name, "compare")
                top.stylesheets = SMALL_BAR if compare else []
                if top.visible:
                    self._show_top(top, picture, name)
            # a picture in 3-D is made when it is first looked at
            row = [top for top in self._tops.values() if top.visible or top in self._row.objects]
            if row != self._row.objects:
                self._row.objects = row
            self._force.object = say("planes.force.said", law=in_force(picture, plane))
            self._table.visible = compare
            self._figures.look(picture, plane)
            self._well.show(picture, plane)

    def _spread(self, compare):
        """Three tops need the width of the page: what answers them then stands below, side by side."""
        left, right = self.main.objects
        columns = "repeat(auto-fit, minmax(min(100%, {}px), 1fr))"
        self._row.styles = self._row.styles | {"grid-template-columns": columns.format(280) if compare else "1fr"}
        self.main.styles = {"display": "flex"} if compare else {}
        left.styles = {"position": "static"} if compare else {}
        right.styles = {"display": "grid", "grid-template-columns": columns.format(480)} if compare else {}

    def _show_top(self, top, picture, plane):
        motion = picture.motions[plane]
        settings = picture.settings
        if not top.is_new(settings):
            return
        top.param.update(
            profile=pack(settings.drawn),
            seconds=settings.scales.time,
            a=settings.top.a,
            frames=pack_frames(*motion.frames) if motion else b"",
        )

    def _start_words(self, picture):
        if picture.settings.rolling is None:
            return ""
        return note(say("planes.notes.start", tilt=degrees(picture.state.theta), spin=picture.turns))

    @staticmethod
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
