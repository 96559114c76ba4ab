"""A link opens what it opened when it was made; links.py has the links and what they opened."""

import pytest
from links import in_effect, known, opened

from app.state.names import LEVEL, NAMES, SECRET

LINKS = known()


@pytest.mark.slow
@pytest.mark.parametrize("link", LINKS)
def test_a_link_opens_what_it_opened(link):
    assert opened(link) == approximately(LINKS[link])


def approximately(found):
    """To nine digits, which leaves room for another machine's sine."""
    if isinstance(found, dict):
        return {name: approximately(value) for name, value in found.items()}
    if isinstance(found, list):
        return [approximately(value) for value in found]
    return pytest.approx(found, rel=1e-9, abs=1e-12) if type(found) is float else found


NEWER = {"map", "mapby", "mapat", "table", LEVEL}  # than the links that are kept


def test_every_setting_is_in_a_link():
    found = [what["settings"] for what in LINKS.values()]
    usual = {}
    for link in ("", "?v=1&tab=three-planes", "?v=1&tab=learn", "?v=1&tab=measure"):
        usual |= LINKS[link]["settings"]
    usual |= in_effect({"law": "coulomb", "start": "constants", "mu_k": 0.3, "mu_stick": 0.4})
    changed = {name for settings in found for name, value in settings.items() if value != usual[name]}
    assert {*usual} - {"mu_stick", "mu_smooth", "start", "plane"} == {*NAMES} - NEWER
    assert {*usual} - changed == {SECRET}  # only a teacher's open page has one
