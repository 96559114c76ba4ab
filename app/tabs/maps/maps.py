"""The tab Maps: a map of runs, one of its runs, the dependence on spin alone, and the inputs."""

import time
from dataclasses import replace
from functools import partial
from itertools import zip_longest

from app.model.maps.body import outline_of
from app.model.maps.choice import AT, MapChoice
from app.model.maps.kept import keep, recall
from app.model.maps.lines import disagreements, lines
from app.model.maps.maps import AT_FIRST, OWN, QUANTITIES, of_page
from app.model.maps.solving import run as one_run
from app.model.maps.solving import solve
from app.model.maps.throw import throw_of
from app.model.once import ONCE
from app.model.runs import MAPS, WORK, Run, Runs, Stopped
from app.state import validate as sent
from app.tabs.maps.asking import Settings, spans
from app.tabs.maps.export import KINDS, made, python
from app.tabs.maps.picture import CLOCK, MapFigure, RunFigure
from app.tabs.maps.steady import Steady
from app.tabs.maps.words import body_of, colours_say, of_reason, of_run, of_worst, title, with_unit
from app.text import error_text, listed, say
from app.widgets.cards import alert, areas, column, flow, note, progress, words
from app.widgets.copy import Copy
from app.widgets.download import Download
from app.widgets.drawing import drawn
from app.widgets.failure import unless_stopped
from app.widgets.film_stage import FilmStage, put_motion
from app.widgets.form import Form
from app.widgets.forms import Button
from app.widgets.hold import held
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
        self.usual = {"request": AT_FIRST, "colour": "end", "place": [*AT]}
        if scene is not None:
            self._seen, self._outline = of_page(scene), scene.profile
            self.choice.request = self.usual["request"] = replace(AT_FIRST, body=self._seen[0], own=self._seen[1])
        self.settings = Settings(self.choice.request, "end", self.choice.place, self._set, self._typed_place)
        self.head, self.bar, self.wording = words(), words(visible=False, margin=(4, 0)), words()
        self.worst, self.key = words(), words(margin=(6, 0))
        self.run_says = words(margin=(6, 0), css_classes=["answer"])
        self.disagree = column()  # what is said, and a button for each
        self.map, self.curve = drawn(MapFigure), drawn(RunFigure)
        self.map.hand.on_change("data", lambda attr, old, new: self._by_hand(new))
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
        self.choice.param.watch(lambda *events: self.draw(), ["request", "colour"])
        self.choice.param.watch(lambda *events: self._show_place(), "place")
        self.request = None
        self.draw()

    @property
    def view(self):
        """The map, the run at the bead with the inputs, and what is below; one below the other if there is little
        room."""
        above = [self.head, self.map.drawing,
                 flow(self.stop, self.closer, self.whole, self.bar, margin=(4, 0)), self.wording,
                 words(note(say("maps.hint")))]  # fmt: skip
        below = [self.worst, *self.steady.view, words(f"<h2>{say('maps.export')}</h2>", margin=(8, 0)),
                 flow(*self.files), self.python]  # fmt: skip
        beside = [self.stage, self.run_says, self.curve.drawing,
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
            self.choice.request = replace(self.choice.request, body=body[0], own=body[1])
        self._seen = body

    # ---- input by hand ----

    def _set(self):
        """Draws the map of the present settings."""
        try:
            request = self.settings.request()
        except ValueError as error:
            self._refuse(error)
            return
        self.settings.accept()
        colour = self.settings.choices["colour"].value
        if (request, colour) == (self.choice.request, self.choice.colour):
            self.wording.object = ""
        self.choice.param.update(request=request, colour=colour)

    def _typed_place(self):
        try:
            self.go(*self.settings.place())
        except ValueError as error:
            self._refuse(error)
        else:
            self.settings.accept()

    def _refuse(self, error):
        why = error_text(error) if isinstance(error, TopError) else str(error)
        if not self.settings.refuse(why):
            self.wording.object = alert(why)

    def _usual_spans(self):
        return [
            (QUANTITIES[name].low, QUANTITIES[name].high)
            for name in (self.choice.request.across, self.choice.request.up)
        ]

    def _around(self):
        """Smaller ranges around the bead, within the present ones."""
        found = []
        for x, (low, high) in zip(self.choice.place, spans(self.choice.request), strict=True):
            wide = (high - low) / CLOSER
            begins = min(max(x - wide / 2, low), high - wide)
            found.append((begins, begins + wide))
        return found

    # ---- the map ----

    def draw(self):
        """Draws the map that is chosen; a run under way stops."""
        colour = self.choice.colour
        request = replace(self.choice.request, nudged=colour == "growth")
        if request.body == OWN and request.own is None:  # from a link, in which the page's top is given separately
            body, own = self._seen or (AT_FIRST.body, None)
            try:
                self.choice.request = replace(self.choice.request, body=body, own=own)  # draws it
            except TopError as error:
                self.choice.request = self.usual["request"]
                self.wording.object = alert(error_text(error))
            return
        self.settings.show(self.choice.request, colour, self.choice.place)
        self.wording.object = ""
        count = say("maps.count", across=request.cells, up=request.cells, count=request.cells**2)
        axes = f"↑ {with_unit(request.up)} &emsp; → {with_unit(request.across)}"
        says = note(": ".join(filter(None, (body_of(request), count)))) + note(axes)
        self.head.object = f"<h2>{title(request, colour)}</h2>{says}"
        if request == self.request and self.level is not None:
            self._show(self.level)
            return
        before, self.request, self.level = self.request, request, None
        self.python.text = python(request)
        self.map.begin(request)
        for wording in (self.key, self.worst):  # they belong to the previous map
            wording.object = ""
        self.disagree.objects = []
        self._run = Run(partial(self._work, request), partial(self._done, request))
        known = recall(request)
        self.stop.disabled, self.bar.visible, self.bar.object = known is not None, known is None, _bar(0)
        if known is not None:
            self._show(known)
        self._runs.begin(self._run, "maps", MAPS if known is None else WORK)
        self._go(self._within(request, before))

    def _within(self, request, before):
        """The position of the bead: unchanged if it is on the map, otherwise in the middle."""
        place = self.choice.place
        same = before is None or (request.across, request.up) == (before.across, before.up)
        inside = same and all(low <= x <= high for x, (low, high) in zip(place, spans(request), strict=True))
        return place if inside else [(low + high) / 2 for low, high in spans(request)]

    def _work(self, request, run):
        level = ONCE.find(run.wait, request, partial(self._compute, request, run), recall)
        lines(request)
        return level, ONCE.find(run.wait, (disagreements, request), partial(disagreements, level))

    def _compute(self, request, run):
        shown = 0.0
        for level in solve(request, run.look):
            # messages only now and then: on a slow line more would queue up
            if level.whole or time.monotonic() > shown + PICTURE_EVERY:
                shown = time.monotonic()
                self._runs.post(partial(self._show_part, run, level.copy(), run.reached))
        keep(level)
        return level

    def _show_part(self, run, level, share):
        if run is self._run and not run.stopped:
            with held():
                self.wording.object = ""
                self.bar.object = _bar(100 * share)
                self._show(level)

    def _show(self, level):
        self.level = level
        self.map.show(level, self.choice.colour)
        self.key.object = colours_say(level, self.choice.colour)

    def _done(self, request, result):
        self.stop.disabled, self.bar.visible = True, False
        if isinstance(result, Stopped):
            self.wording.object = note(say("maps.stopped"))
            return
        if isinstance(result, Exception):
            self.wording.object = alert(say("maps.failed"))
            raise result
        level, found = result
        told_of = [(each, k) for each in found for k in range(min(len(each.reasons), WHY))]
        self._ones = [each.reasons[k].one for each, k in told_of]
        with held():
            self._show(level)
            self.wording.object = ""
            self.worst.object = note(of_worst(level))
            says = [words(of_reason(*each, request)) for each in told_of] or [words(note(say("maps.agree")))]
            shows = [Button(say("maps.show_one"), partial(self.go, *one, cell=True), kind="link") for one in self._ones]
            title = [words(f"<h2>{say('maps.disagree')}</h2>")] if told_of else []
            pairs = [part for pair in zip_longest(says, shows) for part in pair if part is not None]
            self.disagree.objects = [Form(*title, *pairs)]

    # ---- one run ----

    def _by_hand(self, data):
        """A place, or the corners of a box, sent by the browser; what no page sends is ignored."""
        try:
            xs, ys = ([sent.number(x) for x in data[name][:2]] for name in ("x", "y"))
            cell = bool(data["cell"][0])
            if not xs or len(xs) != len(ys):
                return
        except (sent.InvalidMessage, KeyError, IndexError, TypeError):
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
        request, (across, up) = self.request, self.choice.place
        self.map.bead.data = {"x": [across], "y": [up]}
        self.settings.show_place((across, up))
        done = unless_stopped(partial(self._ran, request, across, up),
                              lambda error: setattr(self.run_says, "object", alert(error_text(error))))  # fmt: skip
        self._runs.begin(Run(partial(self._run_of, request, across, up), done), "maps-run")
        self.steady.show(request, (across, up))
        self.thrown.visible = self._thrown((across, up)) is not None

    @staticmethod
    def _run_of(request, across, up, run):
        return ONCE.find(run.wait, (one_run, request, across, up), lambda: one_run(request, across, up, run.look))

    def _thrown(self, place):
        """The start of the run at a place in the Lab; None if it has none there."""
        return throw_of(self.request, *place) if self._throw else None

    def _to_lab(self, place, look):
        if (start := self._thrown(place)) is not None:
            self._throw(*start, look)

    def _ran(self, request, across, up, found):
        with held():
            self.run_says.object = of_run(request, across, up, found)
            self.curve.show(found.t, found.theta, request.seconds)
            put_motion(self.stage, found.t, found.film, outline_of(request, request.at(across, up), self._outline), 0.0)


def _bar(percent):
    return progress(percent, say("maps.progress"))
