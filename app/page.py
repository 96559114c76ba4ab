"""The page, layout only."""

from functools import partial
from weakref import WeakKeyDictionary

import panel as pn
import panel_material_ui as pmui
import param

from app import first, text
from app.model.builder import Builder
from app.model.planes import Planes
from app.model.runs import Runs, connected_to, to_session
from app.share.share import Share
from app.state.keep import Field, OneOf, explorer_of, read
from app.tabs.families.compare import Compare
from app.tabs.film.film import Film
from app.tabs.learn.learn import Learn, kept
from app.tabs.learn.student import student_page
from app.tabs.planes.three_planes import KEPT, ThreePlanes
from app.tabs.roll.roll import Roll
from app.tabs.workshop.measure import Measure
from app.tabs.workshop.workshop import Workshop
from app.text import say
from app.widgets.cards import PLAIN, card, grid
from app.widgets.connection import Connection
from app.widgets.failure import attempt, failure
from app.widgets.look import widgets
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
        "MuiMenuItem": {"defaultProps": {"role": "option"}},  # all menus here are of a Select
        "MuiTabs": {"styleOverrides": {"indicator": {"backgroundColor": "var(--mui-palette-primary-main) !important"}}},
    }
}

STYLE = [
    ".MuiLinearProgress-root { display: none !important }",  # it stays there, and has no name
    ".MuiTooltip-popper { display: none !important }",  # in English; guide.js has ours
    "@media (max-width: 600px) { h3.title { font-size: 18px } }",
    "main { background: var(--mui-palette-background-default) !important }",  # it would keep the first theme's
]


SPEAKS = WeakKeyDictionary()  # document -> its language
text.ask(lambda: SPEAKS.get(pn.state.curdoc, text.DEFAULT) if pn.state.curdoc else text.DEFAULT)


class Tongue(param.Parameterized):
    """Which language the page speaks; another one means another page, so it is loaded anew, with its state."""

    lang = param.Selector(default="", objects=["", *text.LANGUAGES], doc='"": the one the browser prefers')
    KNOWN = {"lang": Field("lang", OneOf(**{name: name for name in text.LANGUAGES}), undoable=False)}  # noqa: RUF012

    def choice(self, share):
        """The control. share: the Share that keeps the state and the address."""
        share.keep.add(self, self.KNOWN)
        select = pmui.RadioButtonGroup(label="", options={name: key for key, name in text.LANGUAGES.items()},
                                       value=text.spoken(), size="small", margin=(4, 16), sx=PLAIN)  # fmt: skip

        def chosen(event):
            self.lang = event.new
            share.reload()

        select.param.watch(chosen, "value")
        return select


def on_a_phone():
    """By what the browser says of itself: there the controls cover the pictures, and would have to close first."""
    return "mobi" in pn.state.headers.get("User-Agent", "").lower()


def build_view(explorer, roll, builder):
    workshop = Workshop(builder, explorer, roll.pacer.soon)
    roll.followers.append(workshop.show_scene)
    workshop.show_scene(explorer.scene)
    measure = card(say("main.cards.measure"), *Measure(builder).view, height="max-content")
    measure.styles = measure.styles | {"grid-column": "1 / -1"}
    return grid(
        card(say("main.cards.section"), *workshop.section_view, height="max-content"),
        card(say("main.cards.bench"), *workshop.bench_view, height="max-content"),
        measure,
    )


def planes_view(explorer, roll, builder, keep, runs):
    planes = Planes(explorer, builder, runs)
    roll.followers.append(planes.follow)
    keep.add(planes, KEPT)
    return ThreePlanes(planes, builder, roll.pacer.request).main


def family_view(explorer, runs):
    compare = Compare(explorer, runs)
    compare.show(compare.family.value)
    compare.compute()
    return grid(
        card(say("main.cards.compare"), *compare.figures_view, height="max-content"),
        card(say("main.cards.map"), *compare.map_view, height="max-content"),
        narrowest=1000,
    )


def learn_view(explorer, roll, keep, runs):
    learn = Learn(explorer, roll, runs)
    keep.add(learn, kept())
    learn.param.watch(lambda event: keep.at_rest(), "room")  # at once: a reload would lose it
    return learn.view


def alone(page):
    """The page, no longer told whether any page of this server is busy, which kept it and all it shows for ever."""
    page.param._update_ref("busy", False)
    return page


def page():
    search = pn.state.location.search
    asked = read(search)[0].get("lang")
    accepted = text.preferred(pn.state.headers.get("Accept-Language", ""))
    SPEAKS[pn.state.curdoc] = asked if asked in text.LANGUAGES else accepted
    texts, sentence = read(search)  # what it says is in that language
    failed = failure()
    if "vote" in texts:  # a student's link
        return pmui.Page(title=say("main.title"), main=[student_page(texts["vote"]), failed], theme_toggle=False,
                         busy_indicator=None, stylesheets=STYLE)  # fmt: skip
    explorer, wrong = explorer_of(texts)
    roll = Roll(explorer)
    builder = Builder(explorer, roll.pacer.request)
    post = to_session(pn.state.curdoc)
    runs = Runs(lambda function: post(partial(attempt, function)), connected_to(pn.state.curdoc))
    pn.state.curdoc.on_session_destroyed(lambda context: runs.leave())
    share = Share(explorer, roll, texts, " ".join(filter(None, (sentence, wrong))), runs)
    share.keep.param.watch(lambda event: builder.follow(), "returned")
    pn.state.curdoc.template_variables.update(
        first.variables(None if "tab" in texts else roll.top, pn.state.location.search)
    )
    return pmui.Page(
        template=first.PAGE,
        title=say("main.title"),
        sidebar=[*roll.sidebar, Tongue().choice(share)],
        sidebar_open=not on_a_phone(),
        header=[*share.header, roll.guide],
        main=[
            *share.main,
            *roll.hidden,
            Connection(words=say("main.lost"), width=0, height=0, margin=0),
            failed,
            *tabs(
                {
                    "roll": lambda: roll.main,
                    "three-planes": lambda: planes_view(explorer, roll, builder, share.keep, runs),
                    "build-a-top": lambda: build_view(explorer, roll, builder),
                    "families": lambda: family_view(explorer, runs),
                    "learn": lambda: learn_view(explorer, roll, share.keep, runs),
                    "measure": lambda: Film(explorer, runs).view,
                },
                share.keep,
                roll.pacer.soon,
            ),
        ],
        sidebar_width=320,
        sidebar_resizable=False,
        theme_toggle=False,
        theme_config={"light": THEME, "dark": THEME},
        busy_indicator=None,
        stylesheets=STYLE,
    )
