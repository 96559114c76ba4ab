"""What is chosen in the page's head beside a tab: the top, the language, and Share."""

from app.model.lab_run import TOYS
from app.state import asked
from app.text import LANGUAGES, listed, say

FIRST = "lab"
OWN = ""  # a body that is none of those with a name


class Choices:
    """does: what a HeadBar asks for. shown_in(head) tells a HeadBar which tops there are, now and whenever it changes.

    rooms: the page's Rooms; lab: its Lab; builder: its Builder; tongue: has lang; share: has open() and reload().
    """

    def __init__(self, rooms, lab, builder, tongue, share):
        self._rooms, self._lab, self._builder, self._tongue, self._share = rooms, lab, builder, tongue, share
        self.does = {"toy": self._toy, "language": self._language, "share": lambda value: share.open()}

    def _toy(self, name):
        if name not in TOYS:
            raise asked.Unasked(name)
        if self._rooms.room == FIRST:
            self._lab.ask(toy=name)
            self._lab.rest()
        else:
            self._builder.choose(name)

    def _language(self, name):
        if name not in LANGUAGES:
            raise asked.Unasked(name)
        self._tongue.lang = name
        self._share.reload()

    def shown_in(self, head):
        """From now on."""

        def show(*events):
            names = listed("build.presets")
            toy = self._lab.toy if self._rooms.room == FIRST else self._builder.draft.name
            known = [[name, names[name]["name"]] for name in TOYS]
            head.tops(toy or OWN, known if toy else [[OWN, say("main.own")], *known])

        self._rooms.param.watch(show, "room")
        self._lab.param.watch(show, "toy")
        self._builder.param.watch(show, "draft")
        show()
