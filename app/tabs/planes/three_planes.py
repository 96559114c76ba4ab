"""The room of the three planes: why a tippe top turns over, and that this needs sliding friction."""

import panel as pn
import panel_material_ui as pmui

from app.bundle import pack
from app.model.colours import COLOURS
from app.model.planes.moments import moments
from app.model.planes.planes import PATIENCE, preset
from app.model.playing import Playing, together
from app.model.regimes import COLOUR, NAMES
from app.model.setup import TABLES
from app.tabs.planes.plots import CLOCK, IN_RIBBON, LEDGER, QUANTITIES, Figures, Map, Well, follow_clock
from app.tabs.planes.start_card import StartCard
from app.tabs.planes.words import LOOKS, in_force, is_caught, table_words, verdict_words
from app.text import say, written
from app.widgets.cards import PLAIN, card, first, framed, later, note, on_click, staged, swatch, words
from app.widgets.moments import Moments
from app.widgets.top3d import Top3D, pack_frames

BELOW = 310  # px: the height of what is below the stage
BESIDE = """
:host { display: grid; gap: 12px } .scroll-button { display: none !important }
@media (min-width: 700px) { :host { grid-template-columns: minmax(0, 5fr) minmax(0, 3fr) } }
"""
SLOWEST, SHORTEST_SHOW = 1 / 64, 12  # the slowest playback, and the shortest time (s) for which a motion should play
POLL = 200  # ms between two checks of a run under way
# Three bars side by side have room only for the most important controls.
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
    """main: the content of the room, which show(picture), refuse(refusal), look(plane) and wait() update.

    inputs: the first inputs of a Planes, with its plane; ask: called with new ones; ask_top: called with inputs of the
    Explorer; choose: with the name of a body; work: the Planes' present run, with busy, elapsed, share and stop();
    playing: the Playing of the rolling top, which the motions here follow; explain: shows why Coulomb's law
    catches a top.
    """

    def __init__(self, inputs, ask, ask_top, choose, work, playing=None, explain=None):
        self._ask, self._ask_top, self._choose_body, self._work = ask, ask_top, choose, work
        self._poll, self._picture, self._plane = None, None, inputs["plane"]
        self._playing = playing or Playing()
        self._tops = {
            plane: Top3D(sizing_mode="stretch_both", min_width=250, clock=CLOCK, label=say(f"planes.tops.{plane}"),
                         show_momentum=False, show_cone=False)
            for plane in TABLES
        }  # fmt: skip
        for top in self._tops.values():
            together(self._playing, top, ("playing",))
            top.param.watch(self._on_speed, "speed")
        self._playing.param.watch(lambda event: self._set_speed(event.new), "speed")
        self._figures, self._well = Figures(), Well()
        self._map = Map(self.pick, choose)
        follow_clock(self._figures, self._well)
        self._start = StartCard(inputs, ask, self._choose, lambda: work.stop())
        self._verdict, self._table = words(note(say("planes.run.first")), style=TABLE), words(style=TABLE)
        self._why = pmui.Button(
            label=say("planes.caught"), variant="text", size="small", sx=PLAIN, visible=False, margin=0
        )
        on_click(self._why, lambda event: explain())
        self._force = words(styles={"min-height": "36px"})
        self._build()

    # ---- requests by hand ----

    def pick(self, a, ratio):
        """Asks for the top with this a and I1/I3, and the present I3."""
        self._ask_top(a=a, I1=ratio * self._picture.settings.top.I3)

    def _choose(self, name):
        body, inputs = preset(name)
        self._choose_body(body)
        self._ask(**inputs)

    def _on_speed(self, event):
        if event.new != self._speed:  # set by hand: also for the rolling top
            self._playing.speed = event.new

    def _set_speed(self, speed):
        self._speed = speed
        for top in self._tops.values():
            top.speed = speed

    # ---- the parts ----

    def _build(self):
        self._happened = Moments(clock=CLOCK, sizing_mode="stretch_width", margin=(4, 0, 0, 0))
        happened = card(say("planes.moments.title"), self._happened, height=f"{BELOW}px")
        well, tops = (
            card(
                say(f"planes.cards.{name}"),
                words(f'<div class="key">{say(f"planes.keys.{name}")}</div>'),
                pn.pane.Bokeh(shown.figure, sizing_mode="stretch_both", margin=0),
                height=height,
            )
            for name, shown, height in (("well", self._well, f"{BELOW}px"), ("map", self._map, "440px"))
        )
        for part in (happened, well):  # where the type is large
            part.styles = part.styles | {"overflow": "auto"}
        below = pn.Column(happened, well, sizing_mode="stretch_width", margin=0, stylesheets=[BESIDE])
        became = card(say("planes.cards.became"), self._verdict, self._why, self._table, height="max-content")
        self.main = staged([self._stage_card(), later(below, 1)], [became, self._start.view, later(
            self._times_card(), 1), later(tops, 1)])  # fmt: skip

    def _stage_card(self):
        self._row = pn.Column(
            sizing_mode="stretch_both", margin=0,
            styles={"display": "grid", "gap": "10px"},
            stylesheets=[".scroll-button { display: none !important }"],  # it would cover the first button
        )  # fmt: skip
        return first(framed(say("planes.cards.stage"), self._row, self._force), below=BELOW + 12)

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

    # ---- showing ----

    def wait(self):
        """Follows a run under way, and shows its progress if it takes long."""
        # without a session Panel would repeat it on any event loop that runs in this thread, and never end
        if self._work.busy and self._poll is None and getattr(pn.state.curdoc, "session_context", None):
            self._poll = pn.state.add_periodic_callback(self._look_at_run, period=POLL)
        elif not self._work.busy and self._poll is not None:
            self._poll.stop()
            self._poll = None
            self._start.show_progress(None)
            self._age("")

    def _look_at_run(self):
        if self._work.elapsed > PATIENCE or self._old:
            self._start.show_progress(100 * self._work.share)
            self._age("old")

    def _age(self, old):
        """Shows results of the previous run pale, with this sentence of planes.run; "" if they are those of the
        inputs."""
        if old == self._old:
            return
        self._old = old
        with pn.io.hold():
            for part in (self._row, self._verdict, self._table, self._happened):
                part.styles = part.styles | {"opacity": "0.4" if old else "1"}
            self._say_force()

    def _say_force(self):
        if self._picture is not None:
            said = say("planes.force.said", law=in_force(self._picture, self._plane))
            self._force.object = f"{note(say(f'planes.run.{self._old}'))}{said}" if self._old else said

    def show(self, picture):
        self._picture, settings = picture, picture.settings
        with pn.io.hold():
            self._start.show(picture, busy=self._work.busy)
            if not self._work.busy:
                self._age("last" if picture.is_old else "")
            self._verdict.object = verdict_words(picture)
            self._why.visible = is_caught(picture)
            if self._shown is not settings:
                self._figures.show(picture)
                self._map.show(settings.top)
                self._table.object = table_words(picture)
                self._tempo(settings)
                self._shown = settings
                self.look(self._plane)

    def refuse(self, refusal):
        """Says why there is no picture yet, unless there is one, or none is missing."""
        if refusal is None:
            return
        with pn.io.hold():
            self._start.refuse(refusal)
            self._verdict.object = note(say("planes.run.none"))

    _shown = _paced = _speed = None
    _old = ""

    def _tempo(self, settings):
        """The speed that was chosen by hand; else, for a motion of a new length, one at which it can be watched."""
        if self._playing.speed != Playing.param.speed.default:
            self._set_speed(self._playing.speed)
        elif self._paced != settings.seconds:
            self._paced, speed = settings.seconds, 1.0
            while settings.seconds / speed < SHORTEST_SHOW and speed > SLOWEST:
                speed /= 2
            self._set_speed(speed)

    def look(self, plane):
        """Shows one plane, or all of them to "three"."""
        picture, self._plane = self._picture, plane
        if picture is None:
            return
        compare = plane == "three"
        with pn.io.hold():
            self._spread(compare)
            self._start.look(plane)
            for name, top in self._tops.items():
                top.visible = plane in (name, "three")
                top.stylesheets = SMALL_BAR if compare else []
                if top.visible:
                    self._show_top(top, picture, name)
            # a picture in 3-D is created when it is first shown
            row = [top for top in self._tops.values() if top.visible or top in self._row.objects]
            if row != self._row.objects:
                self._row.objects = row
            self._say_force()
            self._table.visible = compare
            self._figures.look(picture, plane)
            self._well.show(picture, plane)
            which = "ordinary" if compare else plane
            self._happened.rows = [
                [t, f"{written(seconds, '.2f')} s", word, more]
                for t, seconds, word, more in moments(picture.motions[which])
            ]

    def _spread(self, compare):
        """Lays out the tops: three need the full width of the page, and the other cards then stand below, side by
        side."""
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
