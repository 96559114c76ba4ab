"""The choices in the head of the page besides the tabs: the top, the language, and Share."""

from app.model.setup import TOYS
from app.text import LANGUAGES, listed, say
from app.widgets.forms import one_of

OWN = ""  # a body that has no name


def asks(toy, language, share):
    """What a HeadBar asks for. toy, language: functions of a valid name; share: a function of nothing."""
    return {"toy": lambda name: toy(one_of(TOYS)(name)), "language": lambda name: language(one_of(LANGUAGES)(name)),
            "share": lambda value: share()}  # fmt: skip


def tops(toy):
    """The arguments of HeadBar.tops if the page's top has this name."""
    names = listed("build.presets")
    known = [[name, names[name]["name"]] for name in TOYS]
    return (toy, known) if toy in TOYS else (OWN, [[OWN, say("main.own")], *known])
