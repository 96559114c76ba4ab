"""The choices in the head of the page besides the tabs: the top, the table, the language, and Share."""

from app.model.setup import TOYS
from app.model.start import TABLES
from app.state import asked
from app.state.names import PLANES, ROLLING
from app.text import LANGUAGES, listed, say

OWN = ""  # a body that has no name


def asks(**does):
    """What a HeadBar asks for. does: {"toy", "table", "language": a function of a valid name, each; "share": a function
    of nothing}."""

    def one_of(known, act):
        def chosen(name):
            if name not in known:
                raise asked.Unasked(name)
            act(name)

        return chosen

    names = {"toy": TOYS, "table": TABLES, "language": LANGUAGES}
    known = {each: one_of(names[each], act) for each, act in does.items() if each in names}
    return known | {"share": lambda value: does["share"]()}


def tops(toy):
    """The arguments of HeadBar.tops if the page's top has this name."""
    names = listed("build.presets")
    known = [[name, names[name]["name"]] for name in TOYS]
    return (toy, known) if toy in TOYS else (OWN, [[OWN, say("main.own")], *known])


def tables(room, table):
    """The arguments of HeadBar.tables in this room, if the start is on this table."""
    view = listed("lab_view.view")  # as at the level "Explore"
    known = [[name, word, ROLLING if name == "rough" else PLANES, view["hints"][name]]
             for name, word in view["tables"].items()]  # fmt: skip
    return "rough" if room == ROLLING else table, known if room in (ROLLING, PLANES) else []
