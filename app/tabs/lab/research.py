"""What the Lab shows beside its stage at the level "Research": the paper's figures and inputs of the start, and more of
the run on the stage."""

from functools import partial

import numpy as np
import param

from app.model.lab.event_list import events_of
from app.model.lab.nudged import hits, nudged
from app.model.runs import LATER, Run
from app.state import validate
from app.state.names import PANELS
from app.tabs.lab.figures import LEDGER, Times, Well
from app.tabs.lab.rolling import Rolling
from app.tabs.lab.words import ball_words, run_words, scatter_words, table_words
from app.text import say, written
from app.widgets.cards import TABLE, TYPE, column, note, swatch, words
from app.widgets.drawing import drawn
from app.widgets.event_list import EventList
from app.widgets.failure import unless_stopped
from app.widgets.forms import Choice
from app.widgets.hold import held
from app.widgets.times import key, label
from app.widgets.tops_map import TopsMap

ROLLING = ("which", "surface", "portraits")  # panels of the motion on a rough table
AUTO, WHOLE = "auto", {"height": "max-content", "max-height": "none"}
AROUND = ":host { padding: 12px 24px 12px var(--edge, 0) } @media (max-width: 1199px) { :host { padding: 12px 16px } }"
KEPT = (
    TABLE
    + """
.kept { font-weight: 600 } .kept::before { content: "● "; color: var(--normal) } .says { margin: 6px 0 0 }
"""
)


TIMES = """
.one { display: grid; grid-template: minmax(0, 84px) / 60px minmax(0, 1fr) } .head { display: contents }
.one:last-child { grid-template-rows: auto 130px } .key { grid-column: 1 / 3; margin-top: 6px }
.quantity { margin-top: 6px }
"""


class Research(param.Parameterized):
    """view: the panels, one of which is shown, and the inputs. Each is created when it is first shown, and draws only
    while it is.

    scheduler: the page's RenderScheduler; lab: its Lab; runs: its Runs; controls: the view of the inputs of a rolling
    motion; choose: called with the name of a body; follow: with each rolling Scene, at once. open: whether the page
    shows it.
    """

    panel = param.Selector(default=AUTO, objects=[AUTO, *PANELS], doc='the panel; "auto": as fits the table')

    def __init__(self, scheduler, lab, runs, controls, choose, follow):
        super().__init__()
        self._pacer, self._lab, self._runs, self._choose, self._follow = scheduler, lab, runs, choose, follow
        self._made, self._drawn, self._open = {}, {}, False
        self._switch = Choice({say(f"research.panels.{name}"): name for name in PANELS}, PANELS[0], margin=(0, 0, 4, 0))
        self._switch.param.watch(self._chosen, "value")
        self._places = {name: column(visible=False, styles=WHOLE) for name in PANELS}
        self.rolling = Rolling(scheduler, runs, lambda: lab.ask(table="ordinary"))
        self._note = words(note(say("research.rolling")), visible=False, margin=(4, 0))
        parts = self._switch, self._note, *self._places.values(), controls
        self.view = column(*parts, stylesheets=[AROUND])
        self._makers = {
            "which": self.rolling.plane, "surface": self.rolling.surface, "portraits": self.rolling.portraits,
            "time": self._make_times, "values": self._make_values, "ends": self._make_ends,
        }  # fmt: skip
        for when in ("hand", "pictures", "rest", "still"):
            scheduler.shows(partial(self._on_scene, when), when)
        lab.param.watch(lambda event: self._on_run(), "scene")
        self.param.watch(lambda event: self._look(), "panel")
        lab.explorer.when("table", self._look)

    @property
    def shown(self):
        """The panel that is shown."""
        usual = "which" if self._lab.explorer.table == "rough" else "time"
        return usual if self.panel == AUTO else self.panel

    @property
    def open(self):
        return self._open

    @open.setter
    def open(self, is_open):
        self._open = is_open
        if is_open:
            self._lab.explorer.settle()
            self._look()

    def _chosen(self, event):
        if event.new not in PANELS:
            raise validate.InvalidMessage(event.new)
        if event.new != self.shown:
            self.panel = event.new

    def _look(self):
        """Shows the panel, with all that has happened since it was last shown."""
        if not self._open:
            return
        name = self.shown
        with held():
            self._switch.value = name
            self._note.visible = name in ROLLING and self._lab.explorer.table != "rough"
            if name not in self._made:
                content, draws = self._makers[name]()
                self._made[name] = draws
                self._places[name].objects = content
            for each, place in self._places.items():
                place.visible = each == name
            for when in self._made[name]:
                if when == "still":
                    self._pacer.later(partial(self._draw, when))
                else:
                    self._draw(when)

    def _on_scene(self, when, scene):
        if when == "hand":
            self._follow(scene)
        self._draw(when)

    def _on_run(self):
        if self._open:
            self._lab.explorer.settle()  # how it would roll is seen here
            self._draw("lab")

    def _draw(self, when):
        """Draws what the panel shows at this occasion, unless it is drawn."""
        draw = self._made.get(self.shown, {}).get(when) if self._open else None
        scene = self._lab.scene if when == "lab" else self._lab.explorer.scene
        if draw is None or scene is None or self._drawn.get(draw) is scene:
            return
        self._drawn[draw] = scene
        draw(scene)

    # ---- panels of the run: their content, and what draws it ----

    def _make_times(self):
        figures = drawn(Times, stylesheets=[TYPE + TIMES], sizing_mode="stretch_width")
        energies = "".join(swatch(colour, say(f"planes.ledger.{name}")) for name, colour in LEDGER.items())
        tables = words(f'<div class="key">{key()}</div>', visible=False)

        def show(scene):
            tables.visible = scene.table == "three"
            rolling = self._lab.explorer.scene  # some nods at first, if that is all that it does
            figures.show(scene, rolling.trajectory.t[-1] * rolling.scales.time if scene.table == "rough" else np.inf)

        of_ledger = f'<div class="key">{say("planes.keys.ledger")}{energies}</div>'
        figures.drawing.heads = [
            (of_ledger if name == "ledger" else "") + f'<div class="quantity">{label(name)}</div>'
            for name in figures.figures
        ]
        return [tables, figures.drawing, words(f'<div class="axis">{say("planes.keys.time")}</div>')], {"lab": show}

    def _make_values(self):
        happened = EventList(clock="lab", sizing_mode="stretch_width", margin=(4, 0, 0, 0))
        kept, scatters, of_run = words(style=KEPT), words(style=KEPT), words()

        def show(scene):
            table = scene.watched
            happened.rows = [[t, f"{written(seconds, '.2f')} s", word, more]
                             for t, seconds, word, more in events_of(scene.motions[table])]  # fmt: skip
            kept.object = table_words(scene)
            of_run.object = f'<div class="key">{run_words(scene.start, table)}</div>'
            self.rolling.say(self._lab.explorer.scene if scene.table == "rough" else None)
            scatters.object = ""
            motion = scene.motions["ordinary"]
            if hits(motion):
                done = unless_stopped(partial(scattered, motion))
                self._runs.begin(Run(lambda run: nudged(motion, run.look), done), "nudged", LATER)

        def scattered(motion, growth):
            if self._lab.scene.motions["ordinary"] is motion:
                scatters.object = f'<div class="says">{scatter_words(growth)}</div>'

        title = words(f"<h2>{say('planes.event_list.title')}</h2>")
        return [title, happened, scatters, kept, of_run, self.rolling.kept], {"lab": show}

    def _make_ends(self):
        well, says = drawn(Well), words()
        tops = TopsMap(lambda top: self._choose(top.name), self._pacer.ask, height=420)

        def show(scene):
            well.show(scene)
            tops.show(self._lab.explorer.scene)
            says.object = ball_words(scene)

        def head(name):
            return words(f'<h2>{say(f"planes.cards.{name}")}</h2><div class="key">{say(f"planes.keys.{name}")}</div>')

        content = [head("well"), column(well.drawing, height=240), says, head("map"), tops]
        return content, {"lab": show}
