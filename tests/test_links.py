"""A link opens what it opened when it was made; links.py has them, and says what that is."""

import pytest
from links import known, opened

from app.page import Tongue
from app.share.parts import Clock
from app.share.share import PLAYING
from app.state.keep import EXPLORER
from app.tabs.learn import learn
from app.tabs.planes.three_planes import KEPT
from app.widgets.controls import Controls
from app.widgets.look import Look

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


# What the views keep, each by itself.
VIEWS = (EXPLORER, Controls.KNOWN, Clock.KNOWN, PLAYING, Look.KNOWN, Tongue.KNOWN, KEPT, learn.kept())


def test_no_two_settings_have_one_name():
    names = [field.key for known in VIEWS for field in known.values()]
    assert len(names) == len({*names})


def test_every_setting_is_in_a_link():
    usual = LINKS[""]["settings"] | LINKS["?v=1&tab=three-planes"]["settings"] | LINKS["?v=1&tab=learn"]["settings"]
    changed = {name for what in LINKS.values() for name, value in what["settings"].items() if value != usual[name]}
    assert {*usual} == {field.key for known in VIEWS for field in known.values()} | {"tab"}
    assert {*usual} - changed == {learn.SECRET}  # only a teacher who is there has one
