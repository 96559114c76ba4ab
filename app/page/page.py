"""The page: its layout only."""

from weakref import WeakKeyDictionary

import panel as pn
import param
from panel.theme.base import Design

from app import text
from app.page import first
from app.page.house import TABS, House
from app.share.parts import Frame
from app.share.share import Share
from app.state import opened as room
from app.state.keep import read
from app.state.names import FRAME, LANGUAGE, LEVELS, VOTE
from app.tabs.learn.student import student_page
from app.tabs.learn.worksheet import worksheet
from app.text import say
from app.widgets import choices
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


class PageLanguage(param.Parameterized):
    """The language of the page; for another one the page is loaded again, with its state."""

    lang = param.Selector(default="", objects=["", *text.LANGUAGES], doc='"": the one the browser prefers')


def page():
    search = pn.state.location.search
    asked = read(search)[0].get(LANGUAGE)
    accepted = text.preferred(pn.state.headers.get("Accept-Language", ""))
    SPEAKS[pn.state.curdoc] = asked if asked in text.LANGUAGES else accepted
    texts, sentence = read(search)  # in this language
    failed = failure()
    look = Look(width=0, height=0, margin=0)
    if VOTE in texts:  # the link of a student
        return whole(student_page(texts[VOTE]), look, failed)
    house = House(texts, sentence, lambda **where: rooms.param.update(**where), room.level(texts))
    pacer, keep = house.pacer, house.keep
    guide, tongue = Guide(width=0, height=0, margin=0), PageLanguage()
    share = Share(keep, house.playing, house.scene, house.runs, lambda: house.runs_shown(rooms.room),
                  lambda: house.busy(rooms.room), house.explorer.settle, lambda: house.explorer.shape,
                  worksheet, house.mail)  # fmt: skip
    house.told, house.rests = share.refresh, lambda: keep.at_rest(share.address.gesture)
    for owner in (look, tongue):
        keep.add(owner)
    for show in (share.show, guide.show):
        pacer.shows(show, "rest")
    rooms = Rooms(house.makers, TABS, LEVELS, keep, pacer.now, room.AT_ONCE, room.opened(texts), room.FIRST,
                  house.level)  # fmt: skip
    rooms.param.watch(lambda event: setattr(house, "level", event.new), "level")
    rooms.param.watch(lambda event: house.moved(event.new), "room")
    house.moved(rooms.room)
    head = HeadBar(rooms, keep, look, chosen(rooms, house, tongue, share), TOUR)
    share.param.watch(lambda event: head.opened(event.new), "is_open")
    tells(head, rooms, house)
    toured = lambda *events: setattr(guide, "tour", (rooms.room, rooms.level) == TOUR)  # noqa: E731
    rooms.param.watch(toured, ["room", "level"])
    toured()
    unseen = {"width": 0, "height": 0, "margin": 0}
    lost = Connection(words=say("main.lost"), slow=say("main.slow"), **unseen)
    around = [look, guide, pacer.painted, lost, Symbols(**unseen), failed]
    above = Frame(**unseen) if texts.get(FRAME) == "1" else head.view
    return whole(above, *share.main, *around, *rooms.columns)


def whole(*parts):
    return pn.Column(*parts, sizing_mode="stretch_width", margin=0)


def chosen(rooms, house, tongue, share):
    """The functions that the head calls for what is chosen in it."""

    def language(name):
        tongue.lang = name
        share.reload()

    return choices.asks(toy=lambda name: house.take(name, rooms.room), language=language, share=share.toggle)


def tells(head, rooms, house):
    """Keeps the head informed of the present top."""

    def tell(*events):
        head.tops(*choices.tops(house.toy(rooms.room)))

    rooms.param.watch(tell, "room")
    house.explorer.param.watch(tell, ["shape", "a", "I1", "I3"])
    house.builder.param.watch(tell, "draft")
    tell()


def show():
    """Puts the page into the document that is being served."""
    pn.extension(design=Design, respect_explicit_sizing=True)  # without any style sheet of a theme
    page().servable(title=say("main.title"))
    document = pn.state.curdoc
    document.template = first.TEMPLATE
    document.template_variables.update(first.variables(text.spoken()))
