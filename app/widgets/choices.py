"""What is chosen in the page's head beside a tab: the top, the table, the language, and Share."""

from app.model.lab.run import TOYS
from app.model.start import TABLES
from app.state import asked
from app.state.start import PLANES, ROLLING, TOY
from app.text import LANGUAGES, listed, say

OWN = ""  # a body that is none of those with a name


class Choices:
    """does: what a HeadBar asks for. shown_in(head) tells a HeadBar which tops and tables there are, now and whenever
    that changes.

    rooms: the page's Rooms; house: its House; tongue: has lang; share: has open() and reload().
    """

    def __init__(self, rooms, house, tongue, share):
        self._rooms, self._house, self._tongue, self._share = rooms, house, tongue, share
        self.does = {"toy": self._toy, "table": self._table, "language": self._language,
                     "share": lambda value: self._open()}  # fmt: skip

    def _toy(self, name):
        if name not in TOYS:
            raise asked.Unasked(name)
        if self._rooms.room == TOY:
            self._house.lab_of.ask(toy=name)
            self._house.lab_of.rest()
        else:
            self._house.builder.choose(name)

    def _open(self):
        self._house.explorer.settle()
        self._share.open()

    def _table(self, name):
        if name not in TABLES:
            raise asked.Unasked(name)
        self._rooms.room = self._house.start.table(name)

    def _language(self, name):
        if name not in LANGUAGES:
            raise asked.Unasked(name)
        self._tongue.lang = name
        self._share.reload()

    def shown_in(self, head):
        """From now on."""
        start, builder = self._house.explorer, self._house.builder

        def tops(*events):
            names = listed("build.presets")
            toy = start.toy if self._rooms.room == TOY else builder.draft.name
            known = [[name, names[name]["name"]] for name in TOYS]
            own = toy not in TOYS
            head.tops(OWN if own else toy, [[OWN, say("main.own")], *known] if own else known)

        def tables(*events):
            room = self._rooms.room
            known = [[name, word, ROLLING if name == "rough" else PLANES]
                     for name, word in listed("main.tables").items()]  # fmt: skip
            head.tables("rough" if room == ROLLING else start.table, known if room in (ROLLING, PLANES) else [])

        self._rooms.param.watch(tops, "room")
        self._rooms.param.watch(tables, "room")
        start.param.watch(tops, ["shape", "a", "I1", "I3"])
        builder.param.watch(tops, "draft")
        start.param.watch(tables, "table")
        tops()
        tables()
