"""The tab Maps: a map of runs, one of its runs, the dependence on spin alone, and the inputs."""

import time
from dataclasses import replace
from functools import partial
from itertools import zip_longest

import panel as pn

from app.model.maps.body import outline_of
from app.model.maps.choice import AT, MapChoice
from app.model.maps.kept import claimed, keep, recall
from app.model.maps.lines import disagreements, lines
from app.model.maps.maps import AT_FIRST, OWN, QUANTITIES, of_page
from app.model.maps.solving import run as one_run
from app.model.maps.solving import solve
from app.model.maps.throw import throw_of
from app.model.runs import MAPS, WORK, Run, Runs, Stopped
from app.state import asked as sent
from app.tabs.maps.asking import Settings, spans
from app.tabs.maps.export import KINDS, made, python
from app.tabs.maps.picture import CLOCK, MapFigure, RunFigure
from app.tabs.maps.steady import Steady
from app.tabs.maps.words import body_of, colours_say, of_reason, of_run, of_worst, title, with_unit
from app.text import listed, say, told
from app.widgets.cards import alert, areas, column, flow, note, progress, words
from app.widgets.copy import Copy
from app.widgets.download import Download
from app.widgets.failure import unless_stopped
from app.widgets.film_stage import FilmStage, put_motion
from app.widgets.form import joined
from app.widgets.forms import Button
from app.widgets.once import ONCE, OTHERS
from app.widgets.plots import pane
from tippe_core import TopError

PICTURE_EVERY = 0.3  # s
# On a narrow page the run is between the map and what is below it, so that a tap is answered in sight.
ROOM = """
:host { display: grid; gap: 16px 24px; padding: 12px 16px 16px; align-items: start;
  grid: auto-flow max-content / minmax(0, 1fr);
  min-height: max-content }
.above, .run, .below { min-width: 0 }
@media (min-width: 900px) {
  :host { padding: 12px 24px 24px; grid: max-content 1fr / minmax(0, 66fr) minmax(0, 34fr) }
  .run { grid-area: 1 / 2 / span 2 }
}
"""
ANSWER = "@media (max-width: 899px) { .answer { order: -1 } }"
CLOSER = 3  # how much smaller the range is then
WHY = 3  # reasons for each kind of disagreement that are shown


class Maps:
    """The content of the tab. runs: the page's Runs; scene: the page's, whose top slides; without it, the toy of the
    arrival. throw(toy, spin, tilt, mu, look) makes the run at the bead the start, when a person moves it; look: and
    shows the Lab. usual: the choices that a link need not mention."""

    def __init__(self, runs=None, scene=None, throw=None):
        self._runs, self._throw, self._run = runs or Runs(), throw, None
        self.choice, self.level, self._seen, self._outline = MapChoice(), None, None, None
        self.usual = {"asked": AT_FIRST, "colour": "end", "place": [*AT]}
        if scene is not None:
            self._seen, self._outline = of_page(scene), scene.profile
            self.choice.asked = self.usual["asked"] = replace(AT_FIRST, body=self._seen[0], own=self._seen[1])
        self.settings = Settings(self.choice.asked, "end", self.choice.place, self._set, self._typed_place)
        self.head, self.bar, self.said = words(), words(visible=False, margin=(4, 0)), words()
        self.worst, self.key = words(), words(margin=(6, 0))
        self.run_says = words(margin=(6, 0), css_classes=["answer"])
        self.disagree = column()  # what is said, and a button for each
        self.map, self.curve = MapFigure(self._by_hand), RunFigure()
        self.stage = FilmStage(clock=CLOCK, anew=True, label=say("maps.stage.label"), none=say("maps.stage.none"),
                               sizing_mode="stretch_width", height=260)  # fmt: skip
        self.steady = Steady(self._runs)
        self.stop = Button(say("maps.stop"), lambda: self._run and self._run.stop(), disabled=True)
        self.closer = Button(say("maps.closer"), lambda: self.settings.look_at(*self._around()))
        self.whole = Button(say("maps.whole"), lambda: self.settings.look_at(*self._usual_spans()))
        self.thrown = Button(say("maps.throw"), lambda: self._to_lab(self.choice.place, look=True), kind="primary",
                             visible=False)  # fmt: skip
        self.python = Copy(label=say("maps.python"), button=listed("share.copy"), rows=6, sizing_mode="stretch_width")
        self.files = [
            Download(self._runs, lambda: (self.level, self.choice.colour), partial(made, kind=kind), label=kind.upper(),
                     filename=f"tippe-top-map.{kind}", margin=0)
            for kind in KINDS
        ]  # fmt: skip
        self.choice.param.watch(lambda *events: self.draw(), ["asked", "colour"])
        self.choice.param.watch(lambda *events: self._show_place(), "place")
        self.asked = None
        self.draw()

    @property
    def view(self):
        """The map, the run at the bead with the inputs, and what is below; one below the other if there is little
        room."""
        above = [self.head, pane(self.map.figure),
                 flow(self.stop, self.closer, self.whole, self.bar, margin=(4, 0)), self.said,
                 words(note(say("maps.hint")))]  # fmt: skip
        below = [self.worst, *self.steady.view, words(f"<h2>{say('maps.export')}</h2>", margin=(8, 0)),
                 flow(*self.files), self.python]  # fmt: skip
        beside = [self.stage, self.run_says, pane(self.curve.figure),
                 words(f'<div class="axis">{say("maps.run.theta")}</div>'), self.settings.place_view, self.thrown,
                 self.key, self.disagree, *self.settings.view]  # fmt: skip
        return areas(ROOM, [ANSWER], above=above, run=beside, below=below)

    def open(self, all_of_it):
        """Shows, or hides, what is for the level Research."""
        for part in (self.settings.deep, self.steady.deep):
            part.visible = all_of_it

    def show(self, scene):
        """Uses the top of the page's new scene, if it has changed."""
        body, self._outline = of_page(scene), scene.profile
        if self._seen not in (None, body):
            self.choice.asked = replace(self.choice.asked, body=body[0], own=body[1])
        self._seen = body

    # ---- input by hand ----

    def _set(self):
        """Draws the map of the present settings."""
        try:
            asked = self.settings.asked()
        except ValueError as error:
            self._refuse(error)
            return
        self.settings.accept()
        colour = self.settings.choices["colour"].value
        if (asked, colour) == (self.choice.asked, self.choice.colour):
            self.said.object = ""
        self.choice.param.update(asked=asked, colour=colour)

    def _typed_place(self):
        try:
            self.go(*self.settings.place())
        except ValueError as error:
            self._refuse(error)
        else:
            self.settings.accept()

    def _refuse(self, error):
        why = told(error) if isinstance(error, TopError) else str(error)
        if not self.settings.refuse(why):
            self.said.object = alert(why)

    def _usual_spans(self):
        return [
            (QUANTITIES[name].low, QUANTITIES[name].high) for name in (self.choice.asked.across, self.choice.asked.up)
        ]

    def _around(self):
        """Smaller ranges around the bead, within the present ones."""
        found = []
        for x, (low, high) in zip(self.choice.place, spans(self.choice.asked), strict=True):
            wide = (high - low) / CLOSER
            begins = min(max(x - wide / 2, low), high - wide)
            found.append((begins, begins + wide))
        return found

    # ---- the map ----

    def draw(self):
        """Draws the map that is chosen; a run under way stops."""
        colour = self.choice.colour
        asked = replace(self.choice.asked, nudged=colour == "growth")
        if asked.body == OWN and asked.own is None:  # from a link, in which the page's top is given separately
            body, own = self._seen or (AT_FIRST.body, None)
            try:
                self.choice.asked = replace(self.choice.asked, body=body, own=own)  # draws it
            except TopError as error:
                self.choice.asked = self.usual["asked"]
                self.said.object = alert(told(error))
            return
        self.settings.show(self.choice.asked, colour, self.choice.place)
        self.said.object = ""
        count = say("maps.count", across=asked.cells, up=asked.cells, count=asked.cells**2)
        axes = f"↑ {with_unit(asked.up)} &emsp; → {with_unit(asked.across)}"
        says = note(": ".join(filter(None, (body_of(asked), count)))) + note(axes)
        self.head.object = f"<h2>{title(asked, colour)}</h2>{says}"
        if asked == self.asked and self.level is not None:
            self._show(self.level)
            return
        before, self.asked, self.level = self.asked, asked, None
        self.python.text = python(asked)
        self.map.begin(asked)
        for said in (self.key, self.worst):  # they belong to the previous map
            said.object = ""
        self.disagree.objects = []
        self._run = Run(partial(self._work, asked), partial(self._done, asked))
        known = recall(asked)
        self.stop.disabled, self.bar.visible, self.bar.object = known is not None, known is None, _bar(0)
        if known is not None:
            self._show(known)
        self._runs.begin(self._run, "maps", MAPS if known is None else WORK)
        self._go(self._within(asked, before))

    def _within(self, asked, before):
        """The position of the bead: unchanged if it is on the map, otherwise in the middle."""
        place = self.choice.place
        same = before is None or (asked.across, asked.up) == (before.across, before.up)
        inside = same and all(low <= x <= high for x, (low, high) in zip(place, spans(asked), strict=True))
        return place if inside else [(low + high) / 2 for low, high in spans(asked)]

    def _work(self, asked, run):
        while (level := recall(asked)) is None:
            with claimed(asked) as mine:
                if mine:
                    self._compute(asked, run)
                    continue
            run.wait(OTHERS)
        lines(asked)
        return level, ONCE.find(run, (disagreements, asked), partial(disagreements, level))

    def _compute(self, asked, run):
        shown = 0.0
        for level in solve(asked, run.look):
            # messages only now and then: on a slow line more would queue up
            if level.whole or time.monotonic() > shown + PICTURE_EVERY:
                shown = time.monotonic()
                self._runs.post(partial(self._show_part, run, level.copy(), run.reached))
        keep(level)

    def _show_part(self, run, level, share):
        if run is self._run and not run.stopped:
            with pn.io.hold():
                self.said.object = ""
                self.bar.object = _bar(100 * share)
                self._show(level)

    def _show(self, level):
        self.level = level
        self.map.show(level, self.choice.colour)
        self.key.object = colours_say(level, self.choice.colour)

    def _done(self, asked, result):
        self.stop.disabled, self.bar.visible = True, False
        if isinstance(result, Stopped):
            self.said.object = note(say("maps.stopped"))
            return
        if isinstance(result, Exception):
            self.said.object = alert(say("maps.failed"))
            raise result
        level, found = result
        told_of = [(each, k) for each in found for k in range(min(len(each.reasons), WHY))]
        self._ones = [each.reasons[k].one for each, k in told_of]
        with pn.io.hold():
            self._show(level)
            self.said.object = ""
            self.worst.object = note(of_worst(level))
            says = [words(of_reason(*each, asked)) for each in told_of] or [words(note(say("maps.agree")))]
            shows = [Button(say("maps.show_one"), partial(self.go, *one, cell=True), kind="link") for one in self._ones]
            self.disagree.objects = joined(
                [
                    *([words(f"<h2>{say('maps.disagree')}</h2>")] if told_of else []),
                    *(part for pair in zip_longest(says, shows) for part in pair if part is not None),
                ]
            )

    # ---- one run ----

    def _by_hand(self, data):
        """A place, or the corners of a box, sent by the browser; what no page sends is ignored."""
        try:
            xs, ys = ([sent.number(x) for x in data[name][:2]] for name in ("x", "y"))
            cell = bool(data["cell"][0])
            if not xs or len(xs) != len(ys):
                return
        except (sent.Unasked, KeyError, IndexError, TypeError):
            return
        if len(xs) == 2:
            self.settings.look_at(sorted(xs), sorted(ys))
        else:
            self.go(xs[0], ys[0], cell)

    def go(self, across, up, cell=False):
        """Moves the bead to a place; cell: to the centre of the cell that contains it."""
        if cell and self.level is not None:
            i, j = self.level.cell(across, up)
            across, up = float(self.level.x[j]), float(self.level.y[i])
        # only a place that a person chose sets the start; first, so that both are one step of undo
        self._to_lab((across, up), look=False)
        self._go([across, up])

    def _go(self, place):
        if place == self.choice.place:
            self._show_place()  # a run that failed before is tried again
        else:
            self.choice.place = place

    def _show_place(self):
        asked, (across, up) = self.asked, self.choice.place
        self.map.bead.data = {"x": [across], "y": [up]}
        self.settings.show_place((across, up))
        done = unless_stopped(partial(self._ran, asked, across, up),
                              lambda error: setattr(self.run_says, "object", alert(told(error))))  # fmt: skip
        self._runs.begin(Run(partial(self._run_of, asked, across, up), done), "maps-run")
        self.steady.show(asked, (across, up))
        self.thrown.visible = self._thrown((across, up)) is not None

    @staticmethod
    def _run_of(asked, across, up, run):
        return ONCE.find(run, (one_run, asked, across, up), lambda: one_run(asked, across, up, run.look))

    def _thrown(self, place):
        """The start of the run at a place in the Lab; None if it has none there."""
        return throw_of(self.asked, *place) if self._throw else None

    def _to_lab(self, place, look):
        if (start := self._thrown(place)) is not None:
            self._throw(*start, look)

    def _ran(self, asked, across, up, found):
        with pn.io.hold():
            self.run_says.object = of_run(asked, across, up, found)
            self.curve.show(found.t, found.theta, asked.seconds)
            put_motion(self.stage, found.t, found.film, outline_of(asked, asked.at(across, up), self._outline), 0.0)


def _bar(percent):
    return progress(percent, say("maps.progress"))
