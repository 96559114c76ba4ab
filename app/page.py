"""The page, layout only."""

from functools import partial
from weakref import WeakKeyDictionary

import panel as pn
import panel_material_ui as pmui
import param
from panel.util import edit_readonly

from app import first, text
from app.model.builder import Builder
from app.model.planes import Planes
from app.model.playing import Playing
from app.model.runs import Runs, connected_to, to_session
from app.share.share import Share
from app.state.keep import explorer_of, kept, read
from app.state.names import LANGUAGE, TABS, VOTE
from app.tabs.build.build import Build
from app.tabs.build.rocking import RockingFields
from app.tabs.families.compare import Compare
from app.tabs.lab import opening
from app.tabs.lab.lab import lab_view
from app.tabs.learn.learn import Learn
from app.tabs.learn.student import student_page
from app.tabs.maps.maps import Maps
from app.tabs.measure.measure import Measure
from app.tabs.planes.three_planes import ThreePlanes
from app.tabs.roll.roll import Roll
from app.text import say
from app.widgets.cards import PLAIN, card, grid, section
from app.widgets.connection import Connection
from app.widgets.controls import Controls
from app.widgets.failure import attempt, failure
from app.widgets.guide import Guide
from app.widgets.look import Look, widgets
from app.widgets.pacing import Pacer
from app.widgets.tabs import tabs

STILL = {"@media (prefers-reduced-motion: reduce)": {"&, & *": {"transition": "none !important",
                                                                "animation": "none !important"}}}  # fmt: skip
THEME = {
    "components": {
        f"Mui{part}": {"styleOverrides": {"root": STILL}}
        for part in (
            "ButtonBase",
            "TouchRipple",
            "Switch",
            "Tabs",
            "Paper",
            "Backdrop",
            "Drawer",
            "Dialog",
            "OutlinedInput",
        )
    }
    | widgets()
    | {
        "MuiToggleButtonGroup": {
            "styleOverrides": {
                "root": {"flexWrap": "wrap", "& .MuiToggleButton-root": {"width": "auto", "flex": "1 1 auto"}}
            }
        },
        # as quiet as the ground: what is chosen, and the top, are the only things on the page that stand out
        "MuiAppBar": {
            "styleOverrides": {
                "root": {
                    "backgroundColor": "var(--mui-palette-background-default) !important",
                    "color": "var(--mui-palette-text-primary) !important",
                    "boxShadow": "none !important",
                    "borderBottom": "1px solid var(--mui-palette-divider)",
                }
            }
        },
        "MuiMenuItem": {"defaultProps": {"role": "option"}},  # all menus here are of a Select
        "MuiTabs": {"styleOverrides": {"indicator": {"backgroundColor": "var(--mui-palette-primary-main) !important"}}},
    }
}

STYLE = [
    ".MuiLinearProgress-root { display: none !important }",  # it stays there, and has no name
    ".MuiTooltip-popper { display: none !important }",  # in English; guide.js has ours
    "h3.title { color: var(--mui-palette-text-primary); font-size: 20px }",
    "@media (max-width: 600px) { h3.title { font-size: 18px } }",
    "main { background: var(--mui-palette-background-default) !important }",  # it would keep the first theme's
]


SPEAKS = WeakKeyDictionary()  # document -> its language
text.ask(lambda: SPEAKS.get(pn.state.curdoc, text.DEFAULT) if pn.state.curdoc else text.DEFAULT)


class Tongue(param.Parameterized):
    """Which language the page speaks; another one means another page, so it is loaded anew, with its state."""

    lang = param.Selector(default="", objects=["", *text.LANGUAGES], doc='"": the one the browser prefers')

    def choice(self, keep, reload):
        """The control. keep: a Keep; reload: what loads the page anew."""
        keep.add(self)
        select = pmui.RadioButtonGroup(label="", options={name: key for key, name in text.LANGUAGES.items()},
                                       value=text.spoken(), size="small", margin=(4, 16), sx=PLAIN)  # fmt: skip

        def chosen(event):
            self.lang = event.new
            reload()

        select.param.watch(chosen, "value")
        return select


def on_a_phone():
    """By what the browser says of itself: there the controls cover the pictures, and would have to close first."""
    return "mobi" in pn.state.headers.get("User-Agent", "").lower()


class House:
    """What a page has besides its views, each made with its own part of it: the Explorer that solves, the Pacer that is
    asked and shows its scenes, the Builder of bodies, how the top is played, what is kept, and what runs beside."""

    def __init__(self, texts, sentence):
        self.explorer, wrong = explorer_of(texts)
        self.pacer = Pacer(self.explorer)
        self.builder = Builder(self.explorer.scene, self.pacer.ask)
        self.pacer.shows(self.builder.follow, "hand")
        self.playing = Playing()
        self.keep = kept(self.explorer, texts, " ".join(filter(None, (sentence, wrong))), shortest=opening.shortest)
        post = to_session(pn.state.curdoc)
        self.runs = Runs(lambda function: post(partial(attempt, function)), connected_to(pn.state.curdoc))
        pn.state.curdoc.on_session_destroyed(lambda context: self.runs.leave())
        pn.state.onload(self.pacer.begin)

    @property
    def scene(self):
        return self.explorer.scene

    # ---- the tabs, each made when it is first looked at ----

    def lab(self):
        return lab_view(self.keep, self.runs, self.pacer.ask, lambda: self.look_at("roll"))

    def roll(self):
        return Roll(self.pacer, self.playing).main

    def build(self):
        bench = Build(self.builder, self.pacer.soon)
        self.pacer.shows(bench.show, "rest")
        rocking = card(say("main.cards.measure"), *RockingFields(self.builder).view, height="max-content")
        rocking.styles = rocking.styles | {"grid-column": "1 / -1"}
        return grid(
            card(say("main.cards.section"), *bench.section_view, height="max-content"),
            card(say("main.cards.bench"), *bench.bench_view, height="max-content"),
            rocking,
        )

    def planes(self):
        planes = Planes(self.scene, self.runs)
        self.keep.add(planes)
        inputs = {name: getattr(planes, name) for name in ("plane", *Planes.INPUTS)}
        view = ThreePlanes(inputs, self.pacer.ask_of(planes), self.pacer.ask, self.builder.choose, planes)
        planes.param.watch(lambda event: view.show(event.new), "picture")
        planes.param.watch(lambda event: view.look(event.new), "plane")
        planes.param.watch(lambda event: view.wait(), "busy")
        if planes.picture is not None:
            view.show(planes.picture)
        view.wait()
        self.pacer.shows(planes.see, "hand")
        self.pacer.shows(planes.follow, "rest")
        return view.main

    def families(self):
        compare = Compare(self.scene, self.runs)
        self.pacer.shows(compare.show, "hand")
        compare.draw(compare.family.value)
        compare.compute()
        return grid(
            card(say("main.cards.compare"), *compare.figures_view, height="max-content"),
            card(say("main.cards.map"), *compare.map_view, height="max-content"),
            narrowest=1000,
        )

    def learn(self):
        learn = Learn(self.scene, self.runs)
        self.pacer.shows(learn.show, "rest")
        self.keep.add(learn)
        learn.param.watch(lambda event: self.keep.at_rest(), "room")  # at once: a reload would lose it
        return learn.view

    def maps(self):
        return Maps(self.runs).view

    def measure(self):
        measure = Measure(self.scene, self.runs)
        self.pacer.shows(measure.show, "hand")
        return measure.view

    @property
    def tabs(self):
        """{name in the address: maker}, in the order of the header."""
        made = (self.lab, self.roll, self.planes, self.build, self.families, self.learn, self.maps, self.measure)
        return dict(zip(TABS, made, strict=True))


def sidebar(controls, look, language):
    """What a person sets, beside every tab."""
    return [
        section(say("roll.sections.motion")),
        *controls.motion,
        section(say("roll.sections.table")),
        *controls.views("mu_s"),
        section(say("roll.sections.top")),
        *controls.views("a", "I1", "I3"),
        section(say("roll.sections.pictures")),
        *controls.pictures,
        section(say("roll.sections.page")),
        look.switches,
        language,
    ]


def page():
    search = pn.state.location.search
    asked = read(search)[0].get(LANGUAGE)
    accepted = text.preferred(pn.state.headers.get("Accept-Language", ""))
    SPEAKS[pn.state.curdoc] = asked if asked in text.LANGUAGES else accepted
    texts, sentence = read(search)  # what it says is in that language
    failed = failure()
    if VOTE in texts:  # a student's link
        return pmui.Page(title=say("main.title"), main=[student_page(texts[VOTE]), failed], theme_toggle=False,
                         busy_indicator=None, stylesheets=STYLE)  # fmt: skip
    house, look, guide = House(texts, sentence), Look(width=0, height=0, margin=0), Guide(margin=(0, 8))
    pacer, keep = house.pacer, house.keep
    controls = Controls(house.scene, pacer.ask, pacer.soon)
    keep.add(controls)
    share = Share(keep, house.playing, house.scene, house.runs)
    keep.add(look)
    language = Tongue().choice(keep, share.reload)
    for show, when in ((share.show, "hand"), (controls.follow, "hand"), (controls.show, "rest"), (guide.show, "rest")):
        pacer.shows(show, when)
    opened, phone = opening.opened(texts, search), on_a_phone()
    views = house.tabs
    header, *rooms = tabs(views, keep, pacer.soon, opened if opened in views else opening.USUAL, opening.AT_ONCE)
    house.look_at = lambda name: setattr(header, "active", list(views).index(name))
    pn.state.curdoc.template_variables.update(first.variables(first.top_of(rooms), search))

    made = pmui.Page(
        template=first.PAGE,
        title=say("main.title"),
        sidebar=sidebar(controls, look, language),
        sidebar_open=not phone,
        header=[*share.header, guide],
        # look and painted are not in the sidebar: what lies there is drawn anew each time that it opens on a phone
        main=[
            *share.main,
            look,
            pacer.painted,
            Connection(words=say("main.lost"), width=0, height=0, margin=0),
            failed,
            header,
            *rooms,
        ],
        sidebar_width=320,
        sidebar_resizable=False,
        theme_toggle=False,
        theme_config={"light": THEME, "dark": THEME},
        busy_indicator=None,
        stylesheets=STYLE,
    )

    def beside(*events):
        """What goes with the tab that is looked at. The controls in the sidebar are none of the Lab's."""
        now = list(views)[header.active]
        guide.tour = now == opening.USUAL
        if not phone and opening.FIRST in (now, *(list(views)[event.old] for event in events)):
            made.sidebar_open = now != opening.FIRST

    header.param.watch(beside, "active")
    beside()
    return made


def show():
    """Puts the page into the document that is being served."""
    pn.extension("katex", respect_explicit_sizing=True)
    shown = page()
    with edit_readonly(shown):
        # It would be told whether any page of this server is busy, which kept it and all it shares for ever.
        shown.busy = shown.param.theme_toggle
    shown.servable()
