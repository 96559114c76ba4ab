"""The choices in the head of the page besides the tabs: the top, the language, and Share."""

from app.model.setup import TOYS
from app.state import asked
from app.text import LANGUAGES, listed, say

OWN = ""  # a body that has no name


def asks(**does):
    """What a HeadBar asks for. does: {"toy", "language": a function of a valid name, each; "share": a function
    of nothing}."""

    def one_of(known, act):
        def chosen(name):
            if name not in known:
                raise asked.Unasked(name)
            act(name)

        return chosen

    names = {"toy": TOYS, "language": LANGUAGES}
    known = {each: one_of(names[each], act) for each, act in does.items() if each in names}
    return known | {"share": lambda value: does["share"]()}


def tops(toy):
    """The arguments of HeadBar.tops if the page's top has this name."""
    names = listed("build.presets")
    known = [[name, names[name]["name"]] for name in TOYS]
    return (toy, known) if toy in TOYS else (OWN, [[OWN, say("main.own")], *known])
