"""Which tab an address opens: today's addresses open what they opened before, an address without a query opens the
Lab."""

from urllib.parse import parse_qsl

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.state.keep import Keep, read
from app.state.names import LEVELS
from app.state.opened import level, opened, shortest


@pytest.mark.parametrize(("query", "tab"), {
    "": "lab", "?": "lab", "?v=1": "roll", "?v=2": "roll", "?v=3": "lab", "?v=3&KJ=6.5": "lab",
    "?lang=de": "lab", "?dark=yes": "lab", "?lang=en&large=yes": "lab", "?v=1&lang=de": "roll", "?v=2&dark=yes": "roll",
    "?v=1&KJ=6.5": "roll", "?tab=roll": "roll", "?v=1&tab=three-planes&plane=rough": "three-planes",
    "?tab=lab&turns=30": "lab", "?v=1&tab=learn&step=free": "learn",
}.items())  # fmt: skip
def test_an_address_opens(query, tab):
    texts, _ = read(query)
    assert opened(texts) == tab
    assert level(texts) == ("explore" if tab == "lab" else "research")  # as before there were levels
    assert level(texts | {"level": "explore"}) == "explore"


TEXTS = st.dictionaries(st.sampled_from(["KJ", "turns", "lang"]), st.just("1"))


@given(TEXTS, st.sampled_from(["lab", "roll", "learn", "families"]), st.sampled_from(LEVELS))
def test_what_goes_without_saying_opens_the_same(others, tab, shown):
    said = shortest(others | {"tab": tab, "level": shown})
    assert (opened(said), level(said)) == (tab, shown)
    assert {key: text for key, text in said.items() if key not in ("tab", "level")} == others


def test_a_page_as_it_comes_has_an_address_without_a_query():
    for tab, query in (("lab", {}), ("roll", {"v": "3", "tab": "roll"})):
        keep = Keep({"tab": tab}, shortest=shortest)
        keep.at_rest()
        assert dict(parse_qsl(keep.query[1:])) == query
