"""A link opens what it opened when it was made; links.py has the links and what they opened."""

from urllib.parse import parse_qs

import pytest
from links import in_effect, known, met_links, opened
from met import OF_LAW, SHOWN, opens

from app.model.maps.maps import COLOURS_BY, LAWS, QUANTITIES
from app.model.start import GIVEN, TABLES
from app.state.names import LEVEL, LEVELS, NAMES, ROOMS, SECRET, SECTIONS, STEPS, VERSION_NAME, VOTE
from app.text import LANGUAGES
from tippe_core.bodies.shapes import KINDS

LINKS = known()
MET = met_links()


@pytest.mark.slow
@pytest.mark.parametrize("link", LINKS)
def test_a_link_opens_what_it_opened(link):
    assert compared(opened(link)) == approximately(compared(LINKS[link]))


@pytest.mark.slow
@pytest.mark.parametrize("link", MET)
def test_a_link_opens_what_was_met_there(link):
    assert compared(opens(link)) == approximately(compared(MET[link]))


def compared(what):
    """What is compared: of a link whose start or body is impossible, all but the default start in their place, which
    is now that of the arrival on every page; of one in an unknown language, all but the list of known ones."""
    said = what.get("said", "")
    if "lang must be one of" in said:
        return what | {"said": said.partition("one of")[0]}
    if "not possible" in said or "body " in said or "this link has" in said.lower():
        return {name: what[name] for name in ("language", "said", "room", "level") if name in what}
    return what


def approximately(found, rel=1e-9, least=1e-12):
    """To nine digits, which leaves room for another machine's sine; the numbers of a motion to six, which leaves room
    for other steps of an integration of this accuracy, see met.RTOL, but not for another law or start."""
    if isinstance(found, dict):
        return {name: approximately(value, *((1e-6, 1e-6) if name == "motion" else (rel, least)))
                for name, value in found.items()}  # fmt: skip
    if isinstance(found, list):
        return [approximately(value, rel, least) for value in found]
    return pytest.approx(found, rel=rel, abs=least) if type(found) is float else found


NEWER = {"map", "mapby", "mapat", "table", "panel", "push", "trace", LEVEL}  # than the links that are kept


def test_every_setting_is_in_a_link():
    found = [what["settings"] for what in LINKS.values()]
    usual = {}
    for link in ("", "?v=1&tab=three-planes", "?v=1&tab=learn", "?v=1&tab=measure"):
        usual |= LINKS[link]["settings"]
    usual |= in_effect({"law": "coulomb", "start": "constants", "mu_k": 0.3, "mu_stick": 0.4})
    changed = {name for settings in found for name, value in settings.items() if value != usual[name]}
    assert {*usual} - {"mu_stick", "mu_smooth", "start", "plane"} == {*NAMES} - NEWER
    assert {*usual} - changed == {SECRET}  # only a teacher's open page has one


def test_every_name_that_can_be_written_is_in_a_link_of_this_version():
    found = {name for link in MET for name in parse_qs(link.removeprefix("?"))}
    assert found - {"seconds"} == {*NAMES, VERSION_NAME, VOTE}


def every(*path):
    """The values at this path of all that was met; where there are lists, all that they contain."""
    found = MET.values()
    for name in path:
        found = [each[name] for each in found if name in each]
    return {each for value in found for each in (value if isinstance(value, list) else [value])}


def test_every_choice_was_met():
    """And a name that is new, or that a link lost, is missed here."""
    learn, maps = ("open", "Learn"), ("open", "MapChoice")
    assert every("room") == {*ROOMS, "vote"} and every("level") == {*LEVELS} and every("table") == {*TABLES}
    assert every("language") == {*LANGUAGES} and every("body", "kind") == {*KINDS}
    assert every("start", "given") == {*GIVEN} and every("friction", "law") == {*OF_LAW}
    assert every("run", "landing") == {"stop", "plastic"} and every("run", "stem") == {True, False}
    assert every("figures", "part") == {"True", "False", "paper"} and every("figures", "limit") == {"lift-off", "slip"}
    assert every("look", "dark") == every("look", "large") == {True, False}
    assert every(*learn, "step") == {*STEPS} and every(*learn, "section") == {*SECTIONS}
    assert every(*maps, "colours") == {*COLOURS_BY} and every(*maps, "law") == {*LAWS}
    assert {*QUANTITIES} <= every(*maps, "across") | every(*maps, "up")
    shows = [{*what["playing"]["shows"]} for what in MET.values() if "playing" in what]
    assert all(any(name not in each for each in shows) for name in SHOWN)


@pytest.mark.parametrize(("table", "says"), [("ordinary", "heat"), ("rough", "between"), ("ice", "tilt")])
def test_a_motion_was_met_on_each_table(table, says):
    assert any(what["motion"].get(table, {}).get(says) for what in MET.values() if "motion" in what)
