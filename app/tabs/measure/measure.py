"""The tab Measure: measurements of a filmed top beside fitted rolling and sliding motions."""

from dataclasses import replace
from functools import partial

from app.model.bodies import body, outline
from app.model.measured.cells import MeasuredError
from app.model.measured.data import settled
from app.model.measured.examples import EXAMPLES, FILMED
from app.model.measured.film import Film, opened, unpacked, written
from app.model.measured.kept import kept
from app.model.measured.made import LAW, found_of_example, is_stored, table_of_example
from app.model.measured.remembered import stored_fit
from app.model.measured.shown import placed
from app.model.measured.table import read
from app.model.measured.work import LONGEST, LOOSE, found, found_again, models, part_of
from app.model.once import ONCE
from app.model.runs import Run, Runs, Stopped
from app.tabs.measure.asks import Asks
from app.tabs.measure.columns import Columns
from app.tabs.measure.figures import Pictures, constants, part_of_time, show_film
from app.tabs.measure.file import Brought, Filmed
from app.tabs.measure.home import Home
from app.tabs.measure.places import PLACES, head
from app.tabs.measure.recipe import recipes
from app.tabs.measure.words import FOUND, in_file, kept_words, name_of, notes_words, result_words
from app.text import error_text, listed, say
from app.widgets.cards import alert, areas, column, flow, note, words
from app.widgets.failure import unless_stopped
from app.widgets.film_stage import FilmStage
from app.widgets.forms import Button, Checks, Choice
from app.widgets.hold import held
from tippe_core import Top, TopError

FIRST = EXAMPLES[0]


class Measure:
    """filmed: what a link stores of it. view: the tab. scene: the first one, whose top is the one that was filmed;
    show() sets others. runs: the page's Runs."""

    def __init__(self, scene, runs=None):
        self._scene, self._runs, self._run = scene, runs or Runs(), None
        self._guess = None  # the Run of the motion that begins with the first values
        self._table, self._data, self._part, self._example, self._name = None, None, (0.0, 0.0), "", ""
        self._read, self._of_file, self.filmed = None, None, Filmed()
        self._found, self._kept, self._thinned, self._notes = None, {}, 1, ""
        self._saved = ()  # the fits of a film that is being opened
        self.wording, self.about = words(), words()
        self.file = Brought(self._runs, self.take, self._not_taken, self.wording).file
        self.asks = Asks(self._answered)
        self.stage = FilmStage(clock="film", label=say("measure.stage.label"), none=say("measure.stage.none"),
                               sizing_mode="stretch_width", height=300)  # fmt: skip
        self.pictures = Pictures(self._pulled)
        self.columns = Columns(self._by_hand, self._wrong)
        self.constants, self.over, self.below = (column() for _ in range(3))
        self._make_controls()
        self.found = words(note(say("measure.nothing_yet")), style=FOUND)
        self.home = Home(self._runs, self.filmed)

    def _make_controls(self):
        self.part = part_of_time(self._draw)
        self.law = Choice({says: law for law, says in listed("measure.laws").items()}, LAW)
        self.law.on("value", lambda event: self._draw())
        self.loose = Checks(say("measure.loose_label"), margin=(4, 0),
                            options={says: name for name, says in listed("measure.loose").items()})  # fmt: skip
        self.loose.on("value", lambda event: self._draw())
        self.start = Button(say("measure.fit"), self.compute, disabled=True)
        self.cancel = Button(say("measure.cancel"), lambda: self._run and self._run.stop(), disabled=True)
        self.leave = Button(say("measure.leave"), self._leave, visible=False)
        self.take_home = Button(say("measure.take_home"), disabled=True)
        self.take_home.on_click(lambda: self.home.view.param.update(visible=not self.home.view.visible))
        self.recipes = recipes(self._runs)

    @property
    def view(self):
        """The figures and the interpreted table; beside them the top, the results, and the controls."""
        examples = [Button(says, partial(self.take_example, name), kind="link")
                    for name, says in zip(EXAMPLES, listed("measure.examples").values(), strict=True)]  # fmt: skip
        if self.filmed.film:
            self.home.in_link.value = ["link"]
            self.take(unpacked(self.filmed.film), link=self.filmed.film)
        if self._table is None:
            wrong = self.wording.object
            self.take_example(FIRST)
            self.wording.object = wrong or self.wording.object
        found = [self.stage, self.found, self.file, flow(self.start, self.cancel, self.leave, self.take_home),
                 self.home.view, flow(*examples), words(note(say("measure.private"))), flow(*self.recipes),
                 self.about, flow(self.law), self.loose]  # fmt: skip
        over = [self.wording, self.over, self.asks.view, self.pictures.view, self.part]
        return areas(PLACES, over=over, found=found, table=[self.below, head("constants"), self.constants])

    def show(self, scene):
        """From now on films are of this scene's top; a fit that was made stays."""
        self._scene = scene
        if not self._example:
            self._say_top()

    # ---- the top, and the free parameters ----

    @property
    def _body(self):
        """(top, scales, shape, outline) of the filmed top: that of an example, else the page's."""
        if self._example:
            return Top.paper(), FILMED.scales, FILMED, body(FILMED)
        film = self._of_file
        if film:
            return film.top, film.scales, film.shape, body(film.shape) if film.shape else outline(film.top)
        scene = self._scene
        return scene.top, scene.scales, scene.shape, scene.profile

    @property
    def _called(self):
        return name_of(self._name, self._example, self._of_file)

    def _say_top(self):
        top, scales, *_ = self._body
        numbers = {"a": top.a, "I1": top.I1, "I3": top.I3, "R": 1e3 * scales.R}
        whose = "example" if self._example else "film" if self._of_file else "this_top"
        self.about.object = note(say(f"measure.of_{whose}", **numbers))

    @property
    def _loose(self):
        return tuple(name for key in self.loose.value for name in LOOSE[key])

    def _models(self):
        """The rolling and the sliding Model to be fitted."""
        return models(*self._body[:3], self.law.value, self._loose)

    def _choose(self, law, loose):
        """Chooses what is to be fitted before its data are there."""
        self.law.put(value=law)
        self.loose.put(value=list(loose))

    # ---- input of data ----

    def _wrong(self, sentence):
        self.wording.object = alert(sentence)

    def _answered(self, table):
        self.columns.show(table)
        self._place_columns(self.below if self._corrected(table) else self.over)

    def _by_hand(self, table):
        self.asks.remember(table)
        self._corrected(table)

    def take_example(self, name):
        """Loads one of EXAMPLES, with default settings."""
        self._choose(LAW, ())
        self._open(None, table_of_example(name), example=name)

    def take(self, text, each=1, name="", link=""):
        """Loads a table, bytes or text, in place of all that came of the one before. If it cannot be read, that one
        stays, and it is said that it does. name: of its file; link: what the page's link has of it already."""
        try:
            film, table = opened(text), read(text, name)
        except MeasuredError as error:
            self._not_taken(error, each)
            return
        if film:
            self._choose(film.law, film.loose)
        elif self._of_file:
            self._choose(LAW, ())  # these were the former film's
        self._open(film, table, each, name=name, link=link)

    def _open(self, film, table, each=1, example="", name="", link=""):
        """Shows a Table, and the Film that it is of or None, in place of all that came of the one before."""
        self._clear()
        self._thinned, self._example, self._read, self._of_file, self._name = each, example, table, film, name
        self._say_top()
        self.filmed.film = link
        table = self.asks.show(table, anew=bool(film or example))
        self.columns.show(table)
        self._saved = film.fits if film else ()
        is_ready = self._corrected(table, film and film.part)
        self._place_columns(self.below if is_ready else self.over)
        if is_ready and film and (film.fits or self._runs.beside):
            self.compute()
        self._saved = ()

    def _place_columns(self, place):
        """Shows the columns there: where they are asked for, at the top, as long as this table is there."""
        self.over.objects = self.below.objects = []
        place.objects = [self.columns.view] if place is self.over else [head("columns"), self.columns.view]

    def _not_taken(self, error, each=1):
        self._refused(error, each)
        if self._table is not None:
            self.wording.object += note(say("measure.still", name=self._called))

    def _clear(self):
        """Takes away what was computed of the data, and what is being computed."""
        for run in (self._guess, self._run):
            if run:
                run.forget()
        self._found, self._kept, self.leave.visible = None, {}, False
        with held():
            self.found.object, self.constants.objects = "", []
            self.home.clear()
            self.pictures.show(None)
            show_film(self.stage, None, None)

    def _cannot(self, error, each=1):
        """Nothing can be fitted, because of this error."""
        self._clear()
        self.start.disabled = self.cancel.disabled = self.take_home.disabled = True
        self._refused(error, each)

    def _refused(self, error, each=1):
        """each: the table contains every each-th row of the file."""
        self._wrong(say(f"measure.wrong.{error.code}", **in_file(error.numbers, each)))

    def _corrected(self, table, part=None):
        """Uses the data of a corrected table; returns whether there is something to fit."""
        self._table = table
        try:
            self._data = data = settled(table, self.columns.frames_a_second)
        except MeasuredError as error:
            self._data, self.part.visible = None, False
            self.pictures.clear()
            self._cannot(error, self._thinned)
            return False
        self.columns.show_errors(data)
        thinned = note(say("measure.thinned", each=self._thinned)) if self._thinned > 1 else ""
        first, last = float(data.t[0]), float(data.t[-1])
        longer = note(say("measure.longer", long=last - first, most=LONGEST)) if last - first > LONGEST else ""
        self._notes = note(notes_words(table.notes, self._thinned)) + thinned + longer
        start, end = part or (first, min(last, first + LONGEST))
        self.part.param.update(visible=True, start=first, end=last, value=[max(start, first), min(end, last)],
                               step=min(last - first, LONGEST) / 400 or 0.01)  # fmt: skip
        self._begin()
        return not self.start.disabled

    def _begin(self):
        self.pictures.begin(self._data, self.part.value[0], self._called)
        self._draw()

    def _pulled(self, start):
        """The start of the motion was dragged there."""
        if self._data is None:
            return
        start = min(max(start, self.part.start), self.part.end)
        self.part.value = [start, max(self.part.value[1], start)]
        self._begin()

    # ---- the data without a fit ----

    def _draw(self):
        """Discards the previous fit, and shows the data with a motion that begins with the first values."""
        if self._data is None:
            return
        self._found, self._kept, self._part = None, {}, tuple(map(float, self.part.value))
        self.leave.visible = False
        self.home.clear()
        self.take_home.disabled = not (self._is_at_hand and self._runs.beside)
        try:
            data = part_of(self._data, *self._part)
        except MeasuredError as error:
            self._cannot(error)
            return
        self.wording.object = self._notes
        self.start.disabled, self.found.object = False, note(say("measure.ready"))
        top, scales, *_ = self._body
        model, work = self._models()[1], lambda: (placed(model, data), kept(data, top, scales))
        self._guess = Run(self._shared(placed, work), unless_stopped(self._drawn))
        self._runs.begin(self._guess, "guess")
        if self._run:
            self._run.forget()
            self.cancel.disabled = True
        if self._is_whole_example and self._runs.beside:
            self.compute()

    @property
    def _is_whole_example(self):
        return bool(self._example) and self._table is self._read and self._part == (self.part.start, self.part.end)

    def _shared(self, kind, work):
        """The work of a Run, which is done once for all pages if it is about an example as it is."""
        request = kind, self._example, self.law.value, self._loose
        shared = self._is_whole_example
        return lambda run: ONCE.find(run.wait, request, work) if shared else work()

    @property
    def _is_at_hand(self):
        """Whether the fit is stored. Then no button changes until it is there: a button that changes twice at once may
        stay in the browser as it was in between."""
        return bool(self._saved) or (self._is_whole_example and is_stored(self.law.value, self._loose))

    def _drawn(self, result):
        first, self._kept = result
        if self._found is None:  # else the fit was faster
            self.pictures.show(first)
            show_film(self.stage, first, self._body[3])
            if self.cancel.disabled:
                self.found.object = note(say("measure.ready")) + kept_words(self._kept)
        missing = [] if "K_J" in self._kept else [words(note(say("measure.no_constants")))]
        self.constants.objects = [*constants(self._kept), *missing]

    # ---- the fit ----

    def compute(self):
        """Computes both fits in a thread, or takes those of a saved film."""
        if self._data is None:
            return
        data, both, fits = self._data.between(*self._part), self._models(), self._saved
        if self._is_whole_example:
            work = self._shared(found_of_example, partial(found_of_example, self._example, self.law.value, self._loose))
        else:
            work = lambda run: found_again(data, both, fits) if fits else found(data, both)  # noqa: E731
        self._again = bool(fits)
        if not self._is_at_hand:
            self.start.disabled, self.cancel.disabled = True, False
        self.found.object = f'<div role="status">{note(say("measure.waits"))}</div>' + kept_words(self._kept)
        self._run = Run(work, self._done)
        self._runs.begin(self._run, "fit")

    def _done(self, result):
        self.start.disabled, self.cancel.disabled = False, True
        if isinstance(result, Exception):
            self.take_home.disabled = True
            wording = error_text(result) if isinstance(result, TopError) else say("measure.failed")
            self.found.object = note(say("measure.cancelled")) if isinstance(result, Stopped) else alert(wording)
            if not isinstance(result, (Stopped, TopError)):
                raise result
            return
        self._found = result
        self.found.object, self.leave.visible = result_words(result, self._again), bool(result.better.far)
        self.pictures.show(result.motion, result.better)
        show_film(self.stage, result.motion, self._body[3])
        self.take_home.disabled = False
        says = f"<p>{self._called}.</p>{self.found.object}"
        data = self._data.between(*self._part)
        self.home.show(self._film(), data, result.fits, self._loose, self._part, says, result.kept)

    def _leave(self):
        """Leaves out the values that are far off the fit, and fits the others."""
        if self._found:
            data, far = self._found.motion.data, self._found.better.far
            self._data = self._data.without((name, data.series[name].t[i]) for name, at in far.items() for i in at)
            self._table = replace(self._table)  # no longer a whole example
            self._begin()
            self.compute()

    def _film(self):
        """The text of the film with the present fit."""
        top, scales, shape, _ = self._body
        film = Film(self.law.value, tuple(self.loose.value), self._part, top, scales, shape,
                    tuple(stored_fit(each) for each in self._found.fits) if self._found else ())  # fmt: skip
        return written(film, self._data)
