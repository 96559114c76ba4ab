"""The Lab with each law of friction: the run, the words, the link and the way to the level "Research" and back."""

import json
from urllib.parse import parse_qs

import numpy as np
import pytest
from test_start import visitor

from app.model import tell
from app.model.explorer import Explorer
from app.model.lab.lab import Lab
from app.model.setup import LAWS, TOYS
from app.model.start import arrives
from app.state.opened import opened
from app.state.url_state import explorer_of, read
from app.tabs.lab.lab import LabTab
from tippe_core import Contensou, Coulomb, SmoothedCoulomb, State, Viscous, slide

TOY = TOYS["Leine and Glocker's toy"]
NUMBERS = {"contact": "mu_k=.3&patch=.4", "coulomb": "mu_k=.3", "viscous": "gamma=.5", "smoothed": "mu_k=.3&eps=.05"}
FRICTION = {"contact": Contensou(0.3, 0.4 / 15), "coulomb": Coulomb(0.3), "viscous": Viscous(0.5),
            "smoothed": SmoothedCoulomb(0.3, 0.05)}  # fmt: skip
"""The toy's R is 15 mm."""


def link(law, more="&tab=lab"):
    return f"?v=3&law={law}&{NUMBERS[law]}&spin=28.65&tilt=5.73{more}"


def start_of(query):
    texts, _ = read(query)
    return explorer_of(texts)[0]


@pytest.mark.parametrize("more", ["", "&tab=lab"])
@pytest.mark.parametrize("law", LAWS)
def test_a_link_with_a_law_opens_the_lab_with_it(law, more):
    assert opened(read(link(law, more))[0]) == "lab"
    lab = Lab(explorer=start_of(link(law, more)))
    lab.show()
    assert lab.scene.motions["ordinary"].start.friction == FRICTION[law] and not lab.scene.messages


@pytest.mark.parametrize("law", LAWS)
def test_what_is_told_is_of_that_law(law):
    """Against a run of the core alone, until the stem touches or 0.8 s have passed."""
    found, scales = tell(link(law))["tables"]["ordinary"], TOY.shape.scales
    samples = {name: np.array(values) for name, values in found["samples"].items()}
    early = (samples["t"] <= 0.8) & (samples["t"] > 0)
    start = State(np.radians(5.73), 0.0, 0.0, 28.65 * 2 * np.pi * scales.time)
    t = np.append(0.0, samples["t"][early]) / scales.time
    alone = slide(TOY.top, start, FRICTION[law], t, rtol=1e-10)
    assert early.sum() > 50 and (samples["support"][early] == "ball").all()
    assert np.degrees(alone.theta[1:]) == pytest.approx(samples["tilt"][early], abs=1e-3)


def test_only_the_patch_takes_the_spin_of_a_top_that_stands_on_its_stem():
    """A point has no torque of pivoting, so what has turned over stays so, where nothing else slows it."""
    kinds = {law: [phase["kind"] for phase in tell(link(law))["tables"]["ordinary"]["phases"]] for law in LAWS}
    assert "falls" in kinds["contact"] and kinds["contact"].index("stands-on-stem") < kinds["contact"].index("falls")
    for law in ("viscous", "smoothed"):
        assert kinds[law][-1] == "stands-on-stem" and "falls" not in kinds[law]
    assert kinds["coulomb"] == ["stands-upright"]  # it sticks at once, and rolls


def test_an_older_link_of_the_toy_has_the_contact_that_it_had():
    for query in ("?v=2&law=viscous&tab=lab", "?v=2&law=coulomb&tab=lab&level=research", "?v=1&law=viscous&tab=lab"):
        assert start_of(query).law == "contact"
    assert start_of("?v=2&law=viscous&tab=three-planes").law == "viscous"


# ---- one coefficient of friction until somebody sets the other ----


def test_static_friction_is_that_of_sliding_until_it_is_set():
    start = Explorer(**arrives() | {"law": "coulomb"})
    start.set(mu=0.21)
    assert start.setup.friction == Coulomb(0.21, 0.21)
    start.set(mu_s=0.4)
    start.set(mu=0.25)
    assert start.setup.friction == Coulomb(0.25, 0.4)


def test_what_rolls_has_the_friction_that_slides_until_another_is_set():
    explorer = start_of("?v=3&mu_k=.2")
    explorer.settle()
    assert explorer.scene.mu_s == 0.2
    explorer.set(mu=0.35)
    assert explorer.scene.mu_s == 0.35
    explorer.set(mu_s=0.6)
    scene = explorer.scene
    explorer.set(mu=0.4)
    assert explorer.scene is scene and scene.mu_s == 0.6


@pytest.mark.parametrize(("query", "static", "sliding"), [
    ("", 0.3, 0.3), ("?v=3&mu_k=.2", 0.2, 0.2), ("?v=3&mu=.4", 0.4, 0.3), ("?v=2&tab=lab&mu_k=.2", 0.5, 0.2),
    ("?v=2&tab=lab&mu=.4", 0.4, 0.3), ("?v=1&tab=lab&rub=.2", 0.5, 0.2), ("?v=2&mu_k=.2", 0.5, 0.2),
    ("?v=3&tab=three-planes&mu=same&mu_k=.2", 0.2, 0.2), ("?v=3&tab=roll", 0.5, 0.3),
])  # fmt: skip
def test_a_link_opens_with_both(query, static, sliding):
    start = start_of(query)
    assert (start.static, start.mu) == (static, sliding)


# ---- the page ----


@pytest.mark.parametrize("law", LAWS)
def test_explore_research_and_back_is_the_same_start(law):
    with visitor("") as (session, seen):
        session.explorer.set(law=law, gamma=0.5)
        session.url_state.commit()
        before, scene = session.explorer.setup, session.lab_of.scene
        seen.level = "research"
        session.url_state.commit()
        texts = parse_qs(session.url_state.query[1:])
        assert texts["law"] == [law] if law != "contact" else "law" not in texts
        assert "mu" not in texts and session.lab_of.scene is scene
        with visitor(session.url_state.query) as (other, _):
            assert other.explorer.setup == before
        seen.level = "explore"
        session.url_state.commit()
        assert session.explorer.setup == before and session.lab_of.scene is scene
        with visitor(session.url_state.query) as (other, _):
            assert other.explorer.setup == before
            assert other.lab_of.scene.motions["ordinary"].start.friction == before.friction


def test_a_law_is_undone():
    with visitor("") as (session, _):
        session.explorer.set(law="viscous")
        session.url_state.commit()
        assert "law=viscous" in session.url_state.query
        session.url_state.undo()
        assert session.explorer.law == "contact" and not session.url_state.query
        assert session.lab_of.scene.start.law == "contact"


def test_a_place_on_a_map_is_watched_with_the_contact_of_the_map():
    with visitor("?v=3&law=viscous&gamma=.7&patch=2") as (session, _):
        session._throw("Top S", 20.0, 10.0, 0.25, False)
        assert session.explorer.setup.friction == Contensou(0.25, 0.5 / 20)


@pytest.mark.parametrize(("law", "inputs"), [
    ("contact", ["patch"]), ("coulomb", ["mu_s"]), ("viscous", ["gamma"]), ("smoothed", ["eps"]),
])  # fmt: skip
def test_the_page_says_which_law_it_is_and_has_its_inputs_only(law, inputs):
    lab = Lab(explorer=start_of(link(law)))
    lab.show()
    tab = LabTab(lab, lambda: None)
    state, told = json.loads(tab.view.state), json.loads(tab.view.told)
    assert [name for name, *_ in told["rubs"]] == inputs
    assert bool(state["law"]) == (law != "contact") == told["wording"][1].endswith("level Research.")
    assert {*told["of"]} >= {"law", "spin", "tilt", *inputs} and ("mu" in told["of"]) == (law != "viscous")
    for name in inputs:
        low, high, *_ = state["sliders"][name]
        assert low <= state["values"][name] <= high
        lab.ask(**{name: high})
        assert getattr(lab.scene.start, name) == high and not lab.scene.messages
        lab.ask(**{name: -1.0})
        assert "-1" in lab.scene.messages[name].replace("\N{MINUS SIGN}", "-")


def test_a_law_is_gone_back_from():
    """Before.js asks for the law of the run before."""
    lab = Lab()
    lab.show()
    lab.explorer.set(law="coulomb")
    assert lab.scene.start.law == "coulomb"
    lab.ask(law="contact")
    assert lab.scene.start == Lab().inputs[1] and not lab.scene.messages
    lab.ask(law="glue")
    assert "glue" in lab.scene.messages["law"]


def test_static_friction_below_the_sliding_one_is_refused_and_all_goes_back():
    lab = Lab(explorer=start_of(link("coulomb")))
    lab.show()
    scene = lab.scene
    lab.ask(mu_s=0.1)
    assert "mu_s" in lab.scene.messages and lab.scene.motions is scene.motions and lab.explorer.static == 0.3
    assert lab.nearest == {"mu_s": 0.3}
