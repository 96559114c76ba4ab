"""A link whose start is not possible: in every view there is soon either a picture or a sentence, never a wait without
an end."""

import json
from itertools import cycle

import pytest

from app.model.explorer import Explorer
from app.model.lab.allowed import LIMITS
from app.model.lab.lab import Lab
from app.state.names import ROWS, VERSION_NAME
from app.state.url_state import explorer_of, read, values
from app.tabs.lab.lab import LabTab
from app.text import LANGUAGES, speaking
from tippe_core import Top, strongest_friction

USUAL = {VERSION_NAME: "4", "by": "hand", "law": "contact", "spin": "20", "tilt": "10"}
TABLES = ("ordinary", "rough", "ice", "three")
HUGE = ("-1e300", "1e300")
MOST = HUGE[1:]  # where another value is below the limit
TEXTS = {
    "body": ("Ball_.02_.04", "BareSphere_.02_.0554745694_.271579_.573941_.578216"),
    "a": ("1", "0", "-1e3", *MOST), "I1": ("0", ".1", *HUGE), "I3": ("0", "2", *HUGE), "mu": ("0", "-1", *MOST),
    "KJ": ("0", "1e3", *HUGE), "KR": ("0", *HUGE), "e": ("-1", "0", "1e3"), "E": ("-1e5", "0", "1e300"),
    "th": ("-1", "0", "4", *MOST), "thd": ("0", "1e3", *HUGE), "w2": ("1", "1e3", *HUGE), "w3": ("0", "1e3", *HUGE),
    "phi": HUGE, "psi": MOST, "spin": ("0", "-100", "1e6", *HUGE), "tilt": ("0", "90", "180", "181", "-1", *MOST),
    "slip": ("0", "-5", *MOST), "mu_k": ("0", "-1", ".5", "1", "50", *MOST), "gamma": ("0", "-1"),
    "eps": ("0", "-1", "1e300"), "patch": ("0", "-1", "50", *MOST),
    "land": ("stop",), "stem": ("no",),
    "push": ("2_0_0_0_1_0_0", "2_0_0_900_0_0_1", "59_0_0_0_1_0_0", "2_0_0_0_1e5_0_0", ".1_0_0_5_0_0_3~5_0_0_5_.2_0_0"),
}  # fmt: skip
"""{name in an address: values at and beyond its limits}; of a name that several laws have, each with one of them."""
BY = {"KJ": "share", "KR": "share", "e": "share", "E": "E", "th": "state", "thd": "state", "w2": "state", "w3": "state",
      "phi": "state", "psi": "state"}  # fmt: skip
LAWS = {"mu_k": ("contact", "coulomb", "smoothed"), "mu": ("coulomb",), "gamma": ("viscous",), "eps": ("smoothed",)}
TOGETHER = [  # values that exclude each other
    {"law": "coulomb", "mu_k": "1", "mu": ".5"}, {"law": "coulomb", "mu_k": "1", "stem": "no"},
    {"by": "state", "th": "0", "w2": "1"}, {"by": "E", "KJ": "1e3", "E": "0"}, {"a": ".9", "I1": ".1", "I3": ".3"},
    {"tilt": "179", "spin": "0", "body": "TruncatedSphere_.016_.0082_.0192_.0032_.0115"},
    {"spin": "1e4"}, {"patch": "50", "mu_k": "1"},
]  # fmt: skip
SETS = [
    {name: text, "by": BY.get(name, "hand"), "law": law}
    for name, texts in TEXTS.items() for text, law in zip(texts, cycle(LAWS.get(name, ("contact",))), strict=False)
] + TOGETHER  # fmt: skip


def link(**texts):
    return "?" + "&".join(f"{name}={text}" for name, text in (USUAL | texts).items())


def of_link(texts):
    """(Explorer, what is said of the link)."""
    found, sentence = read(link(**texts))
    explorer, wrong = explorer_of(found)
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


OF_THE_LAB = {"body", "a", "I1", "I3", *BY, "spin", "tilt", "slip", "mu_k", "patch", "push"}


@pytest.mark.slow
@pytest.mark.parametrize("texts", [texts for texts in SETS if {*texts} & OF_THE_LAB],
                         ids=lambda texts: link(**texts).removeprefix(link()[:4]))  # fmt: skip
def test_the_lab_has_a_scene(texts):
    explorer, said = of_link(texts | {"table": "rough"})
    lab = Lab(explorer=explorer)
    lab.show()
    scene = lab.scene
    assert scene is not None
    if float(texts.get("patch", "1")) < 0:
        assert scene.messages
    assert said or scene.messages or scene.refused or scene.motions["rough"]
    assert set(scene.messages) <= {*LIMITS, "pushes"}  # controls that show them, and the stage


def test_a_top_that_no_body_has_is_shown():
    """An ordinary top, whose peg is a ball far below G."""
    explorer = Explorer(given="hand", a=-1.5)
    lab = Lab(explorer=explorer)
    lab.show()
    assert lab.scene.toy == Top(-1.5, 0.399, 0.408) and not lab.scene.messages and lab.scene.motions["ordinary"]
    tab = json.loads(LabTab(lab, lambda: None).view.state)
    assert not tab["dims"] and not tab["toy"]


# ---- the link of somebody who types MuJoCo's friction ----

MUJOCO = {"body": "BareSphere_.02_.0554745694_.271579_.573941_.578216", "spin": "31.831", "tilt": ".3", "mu_k": "1",
          "law": "coulomb", "mu": ".5", "stem": "no"}  # fmt: skip


@pytest.mark.parametrize("language", LANGUAGES)
def test_sliding_friction_above_static_friction_is_said_and_the_rest_of_the_link_is_shown(language):
    with speaking(language):
        explorer, said = of_link(MUJOCO | {"table": "ordinary"})
        lab = Lab(explorer=explorer)
        lab.show()
        assert not said and "mu_s" in lab.scene.messages and lab.nearest == {"mu_s": 1.0}
        start = lab.scene.start
        assert (start.friction.mu_s, start.friction.mu_k, start.spin) == (1.0, 1.0, 31.831)
        lab.ask(mu=1.3)  # later: back to what was
        assert lab.scene.start is start and lab.scene.messages and lab.nearest == {"mu_s": 1.3}
        lab.ask(mu=0.5)
        assert not lab.scene.messages and lab.scene.start.mu == 0.5


def test_the_nearest_friction_is_the_largest_that_is_possible():
    explorer, _ = of_link({"law": "smoothed", "mu_k": "50", "spin": "21"})
    lab = Lab(explorer=explorer)
    lab.show()
    assert 0 < strongest_friction(explorer.scene.top) - lab.nearest["mu"] < 0.01
    assert lab.scene.start.mu == lab.nearest["mu"] and lab.scene.start.spin == 21.0 and "mu" in lab.scene.messages


def test_the_lab_has_the_refused_values_of_a_link_and_the_nearest():
    explorer, _ = of_link({"mu_k": "-1", "patch": "-2"})
    lab = Lab(explorer=explorer)
    lab.show()
    assert lab.refused == {"mu": -1.0, "patch": -2.0} and lab.refused.keys() == lab.scene.messages.keys()
    lab.ask(**lab.nearest)
    assert not lab.refused and not lab.scene.messages and (explorer.mu, explorer.patch) == (0.01, 0.01)
