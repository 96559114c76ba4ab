"""What a page has besides its views, and the creation of each view with the parts that it needs."""

from functools import partial

import panel as pn

from app.model.arrival import MU, SPIN, TILT
from app.model.build.builder import Builder
from app.model.lab.lab import Lab
from app.model.playing import Playing, together
from app.model.runs import Runs, connected_to, to_session
from app.model.setup import PATCH
from app.page.site import mailed
from app.share.letter import figures
from app.share.saved_runs import Shown
from app.state import opened as room
from app.state.names import LEVELS, ROOMS
from app.state.url_state import explorer_of, kept
from app.tabs.build.build import Build
from app.tabs.build.built import Built
from app.tabs.build.rocking import RockingFields
from app.tabs.families.compare import Compare
from app.tabs.families.tops import Tops
from app.tabs.lab.lab import lab_view
from app.tabs.lab.research import Research
from app.tabs.learn.learn import Learn
from app.tabs.maps.maps import Maps
from app.tabs.measure.measure import Measure
from app.text import say
from app.widgets.cards import card, column, flexible, later, stack, staged
from app.widgets.controls import Controls
from app.widgets.failure import attempt, full, waits
from app.widgets.scheduling import RenderScheduler

TABS = {"learn": ("learn",), "lab": (room.FIRST,), "build": ("build-a-top",), "maps": ("families", "maps"),
        "measure": ("measure",)}  # fmt: skip
"""{tab: names of its rooms in an address}, in the order of the head."""


BESIDE = """
:host { min-height: max-content }
@media (min-width: 1200px) {
  :host { display: grid; align-items: start; grid-template-columns: var(--columns); --stays: var(--beside) }
}
"""
# The Lab stays in sight while what is beside it scrolls.
STAYS = {"position": "var(--stays, static)", "top": "calc(var(--top, 48px) * var(--type, 1))"}
COLUMNS = {True: "minmax(0, 57fr) minmax(0, 43fr)", False: "minmax(0, 1fr)"}
WHY = {"section": "lesson", "step": "arms"}  # why rubbing lifts a top
WHY_NOT = {"section": "published"}  # why Coulomb's law alone does not


class Session:
    """What the page of one visitor has, and its views share: the Explorer, which solves; the RenderScheduler, which
    takes requests and shows scenes; the Builder of bodies; the Lab; the playback; the UrlState; and the Runs.

    look_at(room=name, level=name) shows a room at a level; level is the present one. The page sets both, and
    `told`, which is called when runs_shown() may have changed, and `rests`, when a hand does, which may still be down.
    """

    def __init__(self, texts, sentence, look_at, level):
        self._level, self._shows_level = level, []
        self.explorer, wrong = explorer_of(texts)
        self.scheduler = RenderScheduler(self.explorer)
        self.builder = Builder(self.explorer.scene, self.scheduler.ask)
        self.scheduler.shows(self.builder.follow, "hand")
        self.playing, self._look_at = Playing(), look_at
        self._learn, self._place = None, {}
        self.url_state = kept(self.explorer, texts, " ".join(filter(None, (sentence, wrong))), shortest=room.shortest)
        post = to_session(pn.state.curdoc)
        self.runs = Runs(lambda function: post(partial(attempt, function)), connected_to(pn.state.curdoc), waits, full)
        self.told, self.rests = lambda: None, self.url_state.commit
        self.lab_of = Lab(self.runs, self.explorer)
        self.lab_of.param.watch(lambda *events: self.told(), ["scene", "busy"])
        pn.state.curdoc.on_session_destroyed(lambda context: self.runs.leave())
        pn.state.onload(self.scheduler.begin)

    @property
    def level(self):
        return self._level

    @level.setter
    def level(self, level):
        self._level = level
        for show in self._shows_level:
            show(self._explores())

    def _at_levels(self, show):
        """Calls show(whether the level is "Explore") now and whenever the level changes."""
        self._shows_level.append(show)
        show(self._explores())

    def take(self, name, looked_at):
        """Sets the page's top to the one with this name, from the room that is shown."""
        if looked_at == room.FIRST:
            self.lab_of.ask(toy=name)
            self.lab_of.rest()
        else:
            self.builder.choose(name)

    def toy(self, looked_at):
        """The name of the top in this room; "" or another unknown name if it has none."""
        return self.explorer.toy if looked_at == room.FIRST else self.builder.draft.name

    def _explores(self):
        return self.level == LEVELS[0]

    @property
    def scene(self):
        return self.explorer.scene

    # ---- the rooms, each created when it is first shown ----

    def lab(self):
        """The stage and all about it, and beside it, once it is opened, the research."""
        tab = lab_view(self.lab_of, lambda: self.rests(), research=lambda: self._look_at(level=LEVELS[1]),
                       why=lambda: self._explain(**WHY), why_not=lambda: self._explain(**WHY_NOT))  # fmt: skip
        together(self.playing, tab.view)
        tab.view.styles = STAYS
        view = column(tab.view, stylesheets=[BESIDE])
        research = []

        def show(*events):
            if not self._explores() and not research:
                research.append(self._research(tab.follow))
            tab.view.level = self._level
            for each in research:
                each.view.visible = not self._explores()
                each.open = not self._explores()
            parts = [tab.view, *(each.view for each in research)]
            if list(view) != parts:  # only now, because a group of inputs is drawn with its values
                view.objects = parts
            is_beside = not self._explores() and self.explorer.table != "three"
            view.styles = {"--columns": COLUMNS[is_beside], "--beside": "sticky" if is_beside else "static",
                           "--edge": "0" if is_beside else "24px"}  # fmt: skip

        self._at_levels(lambda explores: show())
        self.explorer.when("table", show)
        return view

    def _research(self, follow):
        controls = Controls(self.scene, self.scheduler.ask, lambda: self.explorer.back)
        self.url_state.add(controls)
        for show_scene, when in ((controls.follow, "hand"), (controls.show, "rest")):
            self.scheduler.shows(show_scene, when)
        found = Research(self.scheduler, self.lab_of, self.runs, controls.card(), self.builder.choose, follow)
        self.url_state.add(found)
        found.param.watch(lambda event: self.url_state.commit(), "panel")
        return found

    def _explain(self, **place):
        """Shows this place of Learn."""
        self._place = place
        if self._learn is not None:
            self._learn.param.update(**place)
        self._look_at(room="learn")

    def mail(self, scene, link):
        """The page to mail: the stage as it is shown, and what Research has beside it."""
        look = self.playing.chosen
        if self._explores():
            return mailed(link, look)
        below, letter = figures(scene)
        return mailed(link, look, below, letter=letter)

    def build(self):
        bench, built, own = (Build(self.builder, self.runs), Built(self.runs, self._spin), RockingFields(self.builder))
        for show in (bench.show, built.show):
            self.scheduler.shows(show, "rest")
        self._at_levels(lambda explores: bench.numbers.param.update(visible=not explores))
        self._at_levels(lambda explores: own.formula.param.update(visible=not explores))
        parts = {"section": bench.section_view, "bench": bench.bench_view, "measure": own.view}
        section, measures, rocking = (card(say(f"main.cards.{name}"), *shown) for name, shown in parts.items())
        stage = stack(*built.view)
        return staged([later(stage, -1), later(rocking, 2)], [section, later(measures, 1)])

    def _spin(self):
        """Shows the run of the verdict."""
        self.lab_of.ask(table="ordinary", spin=SPIN, tilt=TILT, mu=MU, law="contact", patch=PATCH)
        self._look_at(room=room.FIRST)

    def families(self):
        tops, compare = (
            Tops(self.scene, self.scheduler.ask, self._use, self._change, self.runs),
            Compare(self.scene, self.runs),
        )
        self.scheduler.shows(tops.show, "rest")
        self.scheduler.shows(compare.show, "hand")
        compare.compute()
        cards = (
            (card(say("family.tops.title"), *tops.map_view), "3 1 560px"),
            (card("", *tops.beside_view), "2 1 360px"),
            (card(say("main.cards.map"), *compare.map_view), "1 1 100%"),
        )
        return flexible(*cards)

    def _use(self, name):
        """Shows a known top in the Lab, and so everywhere."""
        self.lab_of.ask(toy=name)
        self._look_at(room="lab")

    def _change(self, name):
        self.builder.choose(name)
        self._look_at(room="build-a-top")

    def learn(self):
        self._learn = learn = Learn(self.scene, self.runs, lambda: self._look_at(room=room.FIRST))
        self.scheduler.shows(learn.show, "rest")
        self.url_state.add(learn)
        learn.param.update(**self._place)
        learn.param.watch(lambda event: self.url_state.commit(), "room")  # at once: a reload would lose it
        return learn.view

    def maps(self):
        maps = Maps(self.runs, self.scene, self._throw)
        self.url_state.add(maps.choice, usual=lambda choice: maps.usual)
        maps.choice.param.watch(lambda *events: self.url_state.commit(), [*maps.choice.INPUTS])
        self.scheduler.shows(maps.show, "rest")
        self._at_levels(lambda explores: maps.open(not explores))
        return maps.view

    def _throw(self, toy, spin, tilt, mu, look):
        table = {"table": "ordinary"} if look else {}  # that of the map
        self.lab_of.ask(toy=toy, spin=spin, tilt=tilt, mu=mu, law="contact", patch=PATCH, **table)  # as of the map
        if look:
            self._look_at(room="lab")

    def measure(self):
        measure = Measure(self.scene, self.runs)
        self.url_state.add(measure.filmed)
        self._at_levels(lambda explores: measure.found.param.update(css_classes=["brief"] if explores else []))
        self.scheduler.shows(measure.show, "hand")
        return measure.view

    def moved(self, looked_at):
        """To be called when the page shows a room."""
        self.explorer.settle()
        if self.lab_of.begun:
            (self.lab_of.show if looked_at == room.FIRST else self.lab_of.hide)()

    def busy(self, looked_at):
        """Whether this room is about to show other runs."""
        return looked_at == room.FIRST and self.lab_of.busy

    def runs_shown(self, looked_at):
        """The runs on the tables that this room shows, as saved_runs.Shown."""
        scene = self.lab_of.scene if looked_at == room.FIRST else None
        is_rolling = not self._explores() and self.explorer.table == "rough"  # then the paper's motion is saved
        motions = scene.motions if scene and not is_rolling else {}
        return [Shown(table, motion.trajectory, motion.start) for table, motion in motions.items() if motion]

    @property
    def makers(self):
        """{name of a room in the address: the function that creates it}."""
        made = (self.lab, self.build, self.families, self.learn, self.maps, self.measure)
        return dict(zip(ROOMS, made, strict=True))
