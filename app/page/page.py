"""The page: its layout only."""

from weakref import WeakKeyDictionary

import panel as pn
import param
from panel.theme.base import Design

from app import text
from app.page import first
from app.page.session import TABS, Session
from app.share.parts import Frame
from app.share.share import Share
from app.state import opened as room
from app.state.names import FRAME, LANGUAGE, LEVELS, VOTE
from app.state.url_state import read
from app.tabs.learn.student import student_page
from app.tabs.learn.worksheet import worksheet
from app.text import say
from app.widgets import choices
from app.widgets.cards import column
from app.widgets.connection import Connection
from app.widgets.failure import failure
from app.widgets.guide import Guide
from app.widgets.head import HeadBar
from app.widgets.look import Look
from app.widgets.rooms import Rooms
from app.widgets.symbols import Symbols

SPEAKS = WeakKeyDictionary()  # document -> its language
text.ask(lambda: SPEAKS.get(pn.state.curdoc, text.DEFAULT) if pn.state.curdoc else text.DEFAULT)
TOUR = room.FIRST, LEVELS[1]


class Plain(Design):
    """Panel's parts without the style sheets of a theme. A Column's button, which scrolls, takes a place of its own."""

    modifiers = {pn.Column: {"stylesheets": [".scroll-button { display: none }"]}}  # noqa: RUF012  (Panel's own)


class PageLanguage(param.Parameterized):
    """The language of the page; for another one the page is loaded again, with its state."""

    lang = param.Selector(default="", objects=["", *text.LANGUAGES], doc='"": the one the browser prefers')


def page():
    search = pn.state.location.search
    request = read(search)[0].get(LANGUAGE)
    accepted = text.preferred(pn.state.headers.get("Accept-Language", ""))
    SPEAKS[pn.state.curdoc] = request if request in text.LANGUAGES else accepted
    texts, sentence = read(search)  # in this language
    failed = failure()
    look = Look(width=0, height=0, margin=0)
    unseen = {"width": 0, "height": 0, "margin": 0}
    framed = [Frame(**unseen)] if texts.get(FRAME) == "1" else []
    if VOTE in texts:  # the link of a student
        return column(*framed, student_page(texts[VOTE]), look, failed)
    session = Session(texts, sentence, lambda **where: rooms.param.update(**where), room.level(texts))
    scheduler, url_state = session.scheduler, session.url_state
    guide, tongue = Guide(width=0, height=0, margin=0), PageLanguage()
    share = Share(url_state, session.playing, session.scene, session.runs, lambda: session.runs_shown(rooms.room),
                  lambda: session.busy(rooms.room), session.explorer.settle, lambda: session.explorer.shape,
                  worksheet, session.mail)  # fmt: skip
    session.told, session.rests = share.refresh, lambda: url_state.commit(share.address.gesture)
    for owner in (look, tongue):
        url_state.add(owner)
    for show in (share.show, guide.show):
        scheduler.shows(show, "rest")
    rooms = Rooms(session.makers, TABS, LEVELS, url_state, scheduler.now, room.AT_ONCE, room.opened(texts), room.FIRST,
                  session.level)  # fmt: skip
    rooms.param.watch(lambda event: setattr(session, "level", event.new), "level")
    rooms.param.watch(lambda event: session.moved(event.new), "room")
    session.moved(rooms.room)
    head = HeadBar(rooms, url_state, look, chosen(rooms, session, tongue, share), TOUR)
    share.param.watch(lambda event: head.opened(event.new), "is_open")
    tells(head, rooms, session)
    toured = lambda *events: setattr(guide, "tour", (rooms.room, rooms.level) == TOUR)  # noqa: E731
    rooms.param.watch(toured, ["room", "level"])
    toured()
    lost = Connection(words=say("main.lost"), slow=say("main.slow"), **unseen)
    around = [look, guide, scheduler.painted, lost, Symbols(**unseen), failed]
    return column(*(framed or [head.view]), *share.main, *around, *rooms.columns)


def chosen(rooms, session, tongue, share):
    """The functions that the head calls for what is chosen in it."""

    def language(name):
        tongue.lang = name
        share.reload()

    return choices.asks(toy=lambda name: session.take(name, rooms.room), language=language, share=share.toggle)


def tells(head, rooms, session):
    """Keeps the head informed of the present top."""

    def tell(*events):
        head.tops(*choices.tops(session.toy(rooms.room)))

    rooms.param.watch(tell, "room")
    session.explorer.when("body", tell)
    session.builder.param.watch(tell, "draft")
    tell()


def show():
    """Puts the page into the document that is being served."""
    pn.extension("katex", design=Plain, respect_explicit_sizing=True)
    page().servable(title=say("main.title"))
    document = pn.state.curdoc
    document.template = first.TEMPLATE
    document.template_variables.update(first.variables(text.spoken()))
