"""A link whose start is not possible: in every view there is soon either a picture or a sentence, never a wait without
an end."""

import json
from itertools import product

import pytest

from app.model.explorer import Explorer
from app.model.lab.allowed import LIMITS
from app.model.lab.lab import Lab
from app.model.planes.planes import Planes
from app.model.runs import Full, Run, Runs, Stopped
from app.state.keep import explorer_of, read, values
from app.state.names import ROWS, VERSION_NAME
from app.tabs.planes.three_planes import ThreePlanes
from app.text import LANGUAGES, say, speaking
from tippe_core import strongest_friction

USUAL = {VERSION_NAME: "2", "by": "hand", "law": "contact", "spin": "20", "tilt": "10", "seconds": ".2"}
TABLES = ("ordinary", "rough", "ice", "three")
HUGE = ("-1e300", "1e300")
TEXTS = {
    "body": ("Ball_.02_.04", "BareSphere_.02_.0554745694_.271579_.573941_.578216"),
    "a": ("1", "0", "-1e3", *HUGE), "I1": ("0", ".1", *HUGE), "I3": ("0", "2", *HUGE), "mu": ("0", "-1", *HUGE),
    "KJ": ("0", "1e3", *HUGE), "KR": ("0", *HUGE), "e": ("-1", "0", "1e3"), "E": ("-1e5", "0", "1e300"),
    "th": ("-1", "0", "4", *HUGE), "thd": ("0", "1e3", *HUGE), "w2": ("1", "1e3", *HUGE), "w3": ("0", "1e3", *HUGE),
    "phi": HUGE, "psi": HUGE, "spin": ("0", "-100", "1e6", *HUGE), "tilt": ("0", "90", "180", "181", "-1", *HUGE),
    "slip": ("0", "-5", "1e5", *HUGE), "mu_k": ("0", "-1", ".5", "1", "50", *HUGE), "gamma": ("0", "-1"),
    "eps": ("0", "-1", "1e300"), "patch": ("0", "-1", "50", *HUGE), "seconds": ("0", "-1", ".001", "61", *HUGE),
    "land": ("stop",), "stem": ("no",),
}  # fmt: skip
"""{name in an address: values at and beyond its limits}."""
BY = {"KJ": "share", "KR": "share", "e": "share", "E": "E", "th": "state", "thd": "state", "w2": "state", "w3": "state",
      "phi": "state", "psi": "state"}  # fmt: skip
LAWS = {"mu_k": ("contact", "coulomb", "smoothed"), "mu": ("coulomb",), "gamma": ("viscous",), "eps": ("smoothed",)}
TOGETHER = [  # values that exclude each other
    {"law": "coulomb", "mu_k": "1", "mu": ".5"}, {"law": "coulomb", "mu_k": "1", "stem": "no"},
    {"by": "state", "th": "0", "w2": "1"}, {"by": "E", "KJ": "1e3", "E": "0"}, {"a": ".9", "I1": ".1", "I3": ".3"},
    {"tilt": "179", "spin": "0", "body": "TruncatedSphere_.016_.0082_.0192_.0032_.0115"},
    {"spin": "1e4", "seconds": "60"}, {"patch": "50", "mu_k": "1"},
]  # fmt: skip
SETS = [
    {name: text, "by": BY.get(name, "hand"), "law": law}
    for name, texts in TEXTS.items() for text, law in product(texts, LAWS.get(name, ("contact",)))
] + TOGETHER  # fmt: skip


def link(**texts):
    return "?" + "&".join(f"{name}={text}" for name, text in (USUAL | texts).items())


def of_link(texts, explores):
    """(Explorer, what is said of the link)."""
    found, sentence = read(link(**texts))
    explorer, wrong = explorer_of(found, explores)
    return explorer, sentence + wrong


def test_every_name_of_the_start_is_here():
    named = {row.key for row in ROWS if row.owner == "Explorer"}
    assert named - {*TEXTS} == {"by", "law", "table", "half", "limit"}  # of a few words


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.key)
def test_what_no_name_can_mean_is_said(row):
    if row.parameter == "film" or (row.owner == "Learn" and row.parameter == "room"):
        text = "?"
    else:
        text = "never"
    for language in LANGUAGES:
        with speaking(language):
            found, sentence = values({row.key: text}, {row.parameter: row})
            assert not found and sentence


@pytest.mark.parametrize("texts", SETS, ids=lambda texts: link(**texts).removeprefix(link()[:4]))
def test_the_planes_have_a_picture_or_say_at_a_control_why_not(texts):
    for table in TABLES[:1] if len(texts) == 3 else TABLES:
        explorer, _ = of_link(texts | {"table": table}, explores=False)
        planes = Planes(explorer)
        planes.show()
        if planes.picture is not None:
            assert planes.refusal is None
            continue
        shown = Room(planes)
        assert shown.says(planes.refusal.messages)
        for name, near in planes.refusal.nearest.items():  # and that is possible, or leads on to another sentence
            planes.ask(**{name: near})
            assert planes.picture is not None or name not in planes.refusal.messages
            assert planes.picture is None or shown.follows(planes)


def wrong(card):
    """{input: what is said} at the visible controls of a StartCard."""
    found = {}
    for group in (card.starts, card.numbers):
        state = json.loads(group.view.state)
        found |= {name: said for name, said in state["messages"].items() if name not in state["hidden"]}
    return found


class Room:
    """The room of the three planes that shows these Planes."""

    def __init__(self, planes):
        self.view = ThreePlanes({"plane": planes.plane} | planes.inputs, planes.ask, planes.ask, None, planes)
        self.view.look(planes.plane)
        self.view.refuse(planes.refusal)

    def says(self, messages):
        """Whether each sentence stands at a visible control, and nothing waits."""
        card = self.view._start
        assert say("planes.run.first") not in self.view._verdict.object
        said = [words.object for words in card._said.values() if words.visible]
        assert len(wrong(card)) + sum('role="alert"' in words for words in said) == len(messages) > 0
        return True

    def follows(self, planes):
        """Whether it shows the picture, and says nothing more."""
        self.view.show(planes.picture)
        assert not wrong(self.view._start)
        return True


OF_THE_LAB = {"body", "a", "I1", "I3", *BY, "spin", "tilt", "slip", "mu_k", "patch"}


@pytest.mark.slow
@pytest.mark.parametrize("texts", [texts for texts in SETS if {*texts} & OF_THE_LAB],
                         ids=lambda texts: link(**texts).removeprefix(link()[:4]))  # fmt: skip
def test_the_lab_has_a_scene(texts):
    explorer, said = of_link(texts | {"table": "rough"}, explores=True)
    lab = Lab(start=explorer)
    lab.show()
    scene = lab.scene
    assert scene is not None
    if float(texts.get("patch", "1")) < 0:
        assert scene.messages
    assert said or scene.messages or scene.refused or scene.motions["rough"]
    assert set(scene.messages) <= {*LIMITS}  # controls that show them


def test_a_start_that_explore_cannot_show_is_said_there():
    """For example of a slider at the level Research."""
    explorer = Explorer(given="hand", a=-1.5)
    lab = Lab(start=explorer)
    lab.show()
    assert "a = -1.5 is not possible" in lab.scene.messages["tilt"]


# ---- the link of somebody who types MuJoCo's friction ----

MUJOCO = {"body": "BareSphere_.02_.0554745694_.271579_.573941_.578216", "spin": "31.831", "tilt": ".3", "mu_k": "1",
          "law": "coulomb", "stem": "no"}  # fmt: skip


@pytest.mark.parametrize("table", TABLES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_sliding_friction_above_static_friction_is_said_and_can_be_mended(table, language):
    with speaking(language):
        explorer, said = of_link(MUJOCO | {"table": table}, explores=False)
        planes = Planes(explorer)
        planes.show()
        room = Room(planes)
        group = room.view._start.numbers.view
        assert not said and planes.picture is None and room.says(planes.refusal.messages)
        assert "0" in wrong(room.view._start)["mu_s"] and json.loads(group.state)["nearest"] == {"mu_s": 1.0}
        planes.param.watch(lambda event: room.view.show(event.new), "picture")
        group.asked = [1, "mu_s", 1.0, True]  # a press of the button
        assert planes.picture.friction.mu_s == planes.picture.friction.mu_k == 1.0
        assert not wrong(room.view._start) and not json.loads(group.state)["nearest"] and planes.refusal is None
        planes.ask(mu=2.0)  # later, there is a picture; it is named as old
        assert planes.picture.messages and planes.picture.nearest == {"mu_s": 2.0}
        assert say("planes.run.last") in room.view._force.object
        planes.ask(mu=0.5)
        assert say("planes.run.last") not in room.view._force.object


def test_the_nearest_friction_is_the_largest_that_is_possible():
    explorer, _ = of_link({"law": "smoothed", "mu_k": "50"}, explores=False)
    planes = Planes(explorer)
    planes.show()
    assert 0 < strongest_friction(explorer.scene.top) - planes.refusal.nearest["mu"] < 0.01


# ---- other reasons why there is no first picture ----


@pytest.mark.parametrize(
    "result", [Full(7), OverflowError("a bug"), Stopped()], ids=lambda result: type(result).__name__
)
def test_whatever_ends_the_first_run_ends_the_wait(result):
    planes = Planes(Explorer(given="hand"), Runs(lambda act: act()))
    planes._shown = True
    planes._running = planes._start.setup
    planes._told_to_stop = isinstance(result, Stopped) and not isinstance(result, Full)
    planes._run = Run(lambda run: None, planes._done)
    try:
        planes._done(result)
    except OverflowError:
        assert isinstance(result, OverflowError)  # which the page's own notice and the log have
    assert not planes.busy and Room(planes).says(planes.refusal.messages)


def test_the_lab_has_the_refused_values_of_a_link_and_the_nearest():
    explorer, _ = of_link({"mu_k": "-1", "patch": "-2"}, explores=True)
    lab = Lab(start=explorer)
    lab.show()
    assert lab.refused == {"mu": -1.0, "patch": -2.0} and lab.refused.keys() == lab.scene.messages.keys()
    lab.ask(**lab.nearest)
    assert not lab.refused and not lab.scene.messages and (explorer.mu, explorer.patch) == (0.01, 0.01)
