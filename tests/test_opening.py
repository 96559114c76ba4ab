"""What an address opens: those of earlier versions open what they opened before; an address without a query opens
the Lab."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.state.names import LEVELS, ROOMS
from app.state.opened import level, opened, shortest
from app.state.url_state import UrlState, read


@pytest.mark.parametrize(("query", "room", "shown"), [
    ("", "lab", "explore"), ("?", "lab", "explore"), ("?v=4", "lab", "explore"), ("?v=4&KJ=6.5", "lab", "explore"),
    ("?v=3", "lab", "explore"), ("?v=3&KJ=6.5", "lab", "explore"), ("?v=1", "lab", "research"),
    ("?v=2", "lab", "research"), ("?lang=de", "lab", "explore"), ("?dark=yes", "lab", "explore"),
    ("?lang=en&large=yes", "lab", "explore"), ("?v=1&lang=de", "lab", "research"), ("?v=2&dark=yes", "lab", "research"),
    ("?v=1&KJ=6.5", "lab", "research"), ("?tab=roll", "lab", "research"), ("?v=3&tab=three-planes", "lab", "research"),
    ("?v=1&tab=three-planes&plane=rough", "lab", "research"), ("?tab=lab&turns=30", "lab", "explore"),
    ("?v=1&tab=learn&step=free", "learn", "research"), ("?v=3&tab=learn", "learn", "research"),
    ("?v=3&tab=learn&level=explore", "learn", "explore"), ("?v=4&tab=learn", "learn", "explore"),
    ("?v=4&tab=nowhere&level=none", "lab", "explore"), ("?v=3&tab=roll&level=explore", "lab", "research"),
])  # fmt: skip
def test_an_address_opens(query, room, shown):
    texts, _ = read(query)
    assert (opened(texts), level(texts)) == (room, shown)


@pytest.mark.parametrize(("query", "table"), [
    ("?v=1", "rough"), ("?v=2&KJ=6.5", "rough"), ("?v=3&tab=roll&table=ice", "ice"),
    ("?v=3&tab=three-planes&table=ice", "ice"), ("?v=3&table=ice", "ice"),
])  # fmt: skip
def test_what_rolled_is_on_the_rough_table(query, table):
    assert read(query)[0]["table"] == table


TEXTS = st.dictionaries(st.sampled_from(["KJ", "turns", "lang"]), st.just("1"))


@given(TEXTS, st.sampled_from(ROOMS), st.sampled_from(LEVELS))
def test_what_goes_without_saying_opens_the_same(others, tab, shown):
    said = shortest(others | {"tab": tab, "level": shown})
    assert (opened(said), level(said)) == (tab, shown)
    assert {key: text for key, text in said.items() if key not in ("tab", "level")} == others


def test_a_page_as_it_comes_has_an_address_without_a_query():
    url_state = UrlState({"tab": "lab", "level": "explore"}, shortest=shortest)
    url_state.commit()
    assert url_state.query == ""
