"""The state in a URL, without a browser: it keeps every digit, bad input is refused in a sentence, and undo works."""

import base64
import zlib
from dataclasses import fields, replace
from urllib.parse import urlencode

import numpy as np
import param
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from app.model.explorer import Explorer
from app.model.maps.choice import MapChoice
from app.model.playing import Playing
from app.model.start import DEFAULTS, USUAL, arrives, of_toy
from app.share.parts import Clock
from app.state.codecs import Body, Number
from app.state.url_state import EXPLORER, LONGEST_QUERY, UrlState, explorer_of, read, usual
from app.text import say, speaking
from app.widgets.controls import Controls
from tippe_core import PRESETS, Lathe, LoadedSphere, TruncatedSphere, Turned, ball, cylinder

# What links of versions 2 and 3 left out at the level "Research": if that changes, they change their meaning.
VERSION_2 = {
    "body": TruncatedSphere(R=0.016, c=0.0082, l=0.0192, r=0.0032, M=0.0115), "a": 0.070, "I1": 0.399, "I3": 0.408,
    "mu": 0.5, "by": "share", "KJ": 7.0, "KR": 10.0, "e": 0.9, "E": 0.0, "th": 0.0, "thd": 0.0, "w2": 0.0, "w3": 0.0,
    "phi": 0.0, "psi": 0.0, "half": True, "limit": "lift-off", "face": "constants", "spin": 20.0, "tilt": 10.0,
    "slip": 1.0, "table": "ordinary", "mu_k": 0.3, "law": "smoothed", "gamma": 0.3, "eps": 0.1, "patch": 0.5,
    "land": "plastic", "stem": True, "push": ()}  # fmt: skip
BODIES = [
    *(preset.shape for preset in PRESETS),
    Lathe(R=0.003, points=((0.002, 0.001), (0.02, 0.006), (0.02, 0.01), (0.0, 0.03)), density=(7e3, 1e3, 7e2, 1 / 3)),
    Turned(R=0.016, solid=700.0 * ball(0.016) - 700.0 * cylinder(0.004, 0.001, 0.009)),
]


def first(**changes):
    """The Explorer of the arrival, with some changes."""
    explorer = Explorer(**arrives())
    explorer.set(**changes)
    return explorer


def kept(explorer, texts=None):
    url_state = UrlState(texts, allowed=lambda: not explorer.scene.messages)
    url_state.add(explorer, usual, opened=True, put=explorer.set, watch=["start"])
    return url_state


def opened(query):
    texts, sentence = read(query)
    explorer, more = explorer_of(texts)
    return explorer, sentence + more


def assert_same_picture(explorer, other):
    for name in ("curve", "force", "omega", "momentum", "normal", "ratio", "regime", "K_J", "K_R", "E", "profile"):
        assert np.array_equal(getattr(explorer.scene, name), getattr(other.scene, name))
    for name in ("t", "theta", "phi", "psi", "quaternion", "contact", "com"):
        assert np.array_equal(getattr(explorer.scene.trajectory, name), getattr(other.scene.trajectory, name))
    for name in ("K_J", "theta", "height", "hover_E", "hover_ratio"):
        assert np.array_equal(getattr(explorer.scene.plane, name), getattr(other.scene.plane, name), equal_nan=True)
    assert explorer.scene.plane.limit == other.scene.plane.limit


@pytest.mark.parametrize("query", ["?v=2&tab=three-planes", "?v=3&tab=three-planes", "?v=2", "?v=3&tab=roll"])
def test_what_older_links_left_out_is_what_it_was(query):
    explorer, sentence = opened(query)
    found = {field.key: getattr(explorer, name) for name, field in EXPLORER.items()}
    found["face"] = Controls.param["face"].default
    follows = set() if "roll" in query else {"E", "th", "thd", "w2", "w3", "phi", "psi"}  # of the motion by constants
    table = {} if "planes" in query else {"table": "rough"}
    hidden = follows | {
        field.key for name, field in EXPLORER.items() if name in USUAL and name not in ("K_J", "K_R", "energy")
    }
    assert {key: value for key, value in found.items() if key not in hidden} == {
        key: value for key, value in (VERSION_2 | table).items() if key not in hidden}  # fmt: skip
    assert sentence == "" and explorer.given == "share"
    assert_same_picture(explorer, Explorer())


def test_the_arrival_has_no_query():
    assert kept(first()).query == ""


@given(st.floats(allow_nan=False, allow_infinity=False))
@example(5e-324)
@example(1.7976931348623157e308)
@example(-0.0)
@example(0.1 + 0.2)
def test_a_number_comes_back_to_the_last_bit(value):
    text = Number.text(value)
    assert np.float64(Number.value(text)).tobytes() == np.float64(value).tobytes()
    assert set(text) <= set("0123456789.e-")


@pytest.mark.parametrize("shape", BODIES, ids=lambda shape: type(shape).__name__)
def test_a_body_comes_back(shape):
    assert Body.value(Body.text(shape)) == shape


@pytest.mark.parametrize("values", [
    {},
    {"K_J": 6.7, "mu_s": 0.3},
    {"K_J": 1 / 3, "K_R": np.pi * 3, "energy": 2 / 3, "upper": False, "limit": "slip"},
    {"E": 27.000000000000004, "given": "E"},
    {"theta": 0.3, "theta_dot": 0.7, "omega2": -1 / 7, "omega3": 9.1, "phi": 1.25, "given": "state"},
    {"a": -2.1, "I1": 1.1, "I3": 0.2, "K_J": 3.9, "K_R": 14.0},
])  # fmt: skip
def test_the_same_picture_to_the_last_digit(values):
    explorer = Explorer()
    explorer.set(**values)
    assert not explorer.scene.messages
    query = kept(explorer).query
    assert query.startswith("?v=4&")
    again, sentence = opened(query)
    assert sentence == "" and kept(again).query == query
    assert_same_picture(explorer, again)


@pytest.mark.parametrize("shape", BODIES, ids=lambda shape: type(shape).__name__)
def test_the_same_body_to_the_last_digit(shape):
    explorer, top = Explorer(), shape.top
    explorer.set(shape=shape, a=top.a, I1=top.I1, I3=top.I3)
    query = kept(explorer).query
    again, sentence = opened(query)
    assert sentence == ""
    assert (again.shape, again.a, again.I1, again.I3) == (shape, top.a, top.I1, top.I3)
    assert ("a=" in query) == (shape == first().shape and top.a != first().a)  # a body gives its own a, I1, I3
    assert_same_picture(explorer, again)


def test_a_link_is_short():
    explorer = first(**of_toy("The paper's tippe top"))
    assert kept(explorer).query == "?v=4&body=" + Body.text(TruncatedSphere.paper()) + "&a=.07&I1=.399&I3=.408"
    explorer = first(K_J=4.7, K_R=6.5, energy=0.5, mu_s=0.3, mu=0.3)
    assert kept(explorer).query == "?v=4&mu=.3&by=share&KJ=4.7&KR=6.5&e=.5"
    shape = LoadedSphere(R=0.02, b=0.008, d=0.01, density=1190.0, core_density=7850.0)
    # every number with all its digits
    explorer.set(shape=shape, a=1 / 7, I1=1 / 3, I3=2 / 5.1, mu_s=1 / 3, K_J=7 / 3, K_R=28 / 3, energy=1 / 7)
    assert len(kept(explorer).query) < 260


def test_the_longest_body_fits():
    rng = np.random.default_rng(5)
    heights = np.sort(rng.uniform(0, 0.05, 400))
    points = tuple((float(radius), float(z)) for radius, z in zip(rng.uniform(0.001, 0.02, 400), heights, strict=True))
    text = Body.text(Lathe(R=0.01, points=points, density=700.0))
    assert len(text) < LONGEST_QUERY - 500
    assert Body.value(text).points == points


@pytest.mark.parametrize("query", [
    "?KJ=nan", "?KJ=inf", "?KJ=1e999", "?KJ=1_0", "?KJ=0x10", "?KJ=٣", "?KJ=", "?KJ=[1]", "?KJ=true", "?KJ= 7",
    "?KJ=1" + 40 * "0", "?body=Ball", "?body=Ball_1", "?body=__import__", "?body=Ball_-1_1", "?body=z", "?body=zAAAA",
    "?half=maybe", "?limit=<script>alert(1)</script>", "?by=E", "?KR=1e308", "?a=-1e308", "?I3=1e-300", "?I3=2",
    "?a=1", "?e=-1", "?mu=-1", "?by=state&th=4", "?body=" + 13_000 * "z", "&".join(f"n{i}=1" for i in range(100)),
    "?body=z" + base64.urlsafe_b64encode(zlib.compress(b"[" * 60_000)).decode(),
    "?body=z" + base64.urlsafe_b64encode(zlib.compress(bytes(50_000_000))).decode()[:LONGEST_QUERY - 100],
    "?v=5", "?v=0&by=share&KJ=5",
])  # fmt: skip
def test_a_bad_link_gives_a_sentence_and_the_default(query):
    explorer, sentence = opened(query)
    assert sentence.endswith((".", "shown.")) and len(sentence) < 600
    if not sentence.startswith(say("share.link.unreadable", wrong="")) and "KJ=5" not in query:
        assert_same_picture(explorer, first())
    elif "body" in query:
        assert_same_picture(explorer, opened("?v=4&by=share&mu=.5")[0])
    else:
        assert_same_picture(explorer, opened("?v=4&by=share&KJ=5" if "KJ=5" in query else "?v=1")[0])


def test_what_is_not_known_is_passed_over_and_the_rest_obeyed():
    explorer, sentence = opened("?v=1&utm_source=mail&KJ=6.5&colour=blue")
    assert sentence == "" and explorer.K_J == 6.5
    explorer, sentence = opened("?v=7&by=share&KJ=6.5")
    assert sentence == say("share.link.newer") and explorer.K_J == 6.5
    explorer, sentence = opened("?KJ=6.5&mu=many")
    assert "mu" in sentence and (explorer.K_J, explorer.mu_s) == (6.5, None)


KEYS = st.sampled_from(["v", "tab", *(field.key for field in EXPLORER.values())])
HOSTILE = st.sampled_from([
    "nan", "-inf", "1e308", "-1e308", "1e-308", "5e-324", "9" * 400, "null", "{}", "[" * 500, "<script>", "%00",
    "../..", "__class__", "Ball_1e308_1e308", "Ball_1e-6_1e-300", "TruncatedSphere_.016_.0082_.0192_.0032_.0115",
    "zeJw", "state", "E", "share", "0", "-0", "1", "3.14159"])  # fmt: skip


@given(st.lists(st.tuples(KEYS, HOSTILE | st.text(max_size=30) | st.floats().map(repr)), max_size=8), st.booleans())
def test_no_link_raises(pairs, quoted):
    query = urlencode(pairs) if quoted else "&".join(f"{key}={text}" for key, text in pairs)
    explorer, sentence = opened("?" + query)
    assert isinstance(sentence, str) and not explorer.scene.messages
    assert np.isfinite(explorer.scene.trajectory.theta).all()


def test_back_and_forth():
    explorer = Explorer()
    url_state, before = kept(explorer), explorer.scene
    opens = url_state.query
    assert not url_state.can_undo and not url_state.can_redo
    for K_J in (6.9, 6.8, 6.7):  # values during a drag are not steps
        explorer.set(K_J=K_J)
    url_state.commit()
    explorer.set(theta=0.5, theta_dot=0.0, omega2=-1.0, omega3=8.0, given="state")
    url_state.commit()
    second = explorer.scene
    url_state.undo()
    assert (explorer.given, explorer.K_J) == ("share", 6.7) and url_state.can_undo and url_state.can_redo
    url_state.undo()
    assert np.array_equal(explorer.scene.trajectory.theta, before.trajectory.theta)
    assert url_state.query == opens and not url_state.can_undo
    url_state.undo()
    url_state.redo()
    url_state.redo()
    assert np.array_equal(explorer.scene.trajectory.quaternion, second.trajectory.quaternion)
    assert not url_state.can_redo
    url_state.undo()
    explorer.set(mu_s=0.2)
    url_state.commit()  # a new branch of the history
    assert not url_state.can_redo
    url_state.commit()
    url_state.undo()
    assert (explorer.mu_s, explorer.K_J) == (0.5, 6.7)


def test_the_steps_are_bounded(monkeypatch):
    monkeypatch.setattr("app.state.url_state.STEPS", 10)
    explorer = Explorer()
    url_state = kept(explorer)
    for i in range(15):
        explorer.set(upper=bool(i % 2), mu_s=0.1 + i / 1000)
        url_state.commit()
    steps = 0
    while url_state.can_undo:
        url_state.undo()
        steps += 1
    assert steps == 10


def test_what_cannot_be_is_neither_kept_nor_a_step():
    explorer = Explorer()
    url_state = kept(explorer)
    explorer.set(K_J=6.0)
    url_state.commit()
    query = url_state.query
    explorer.set(I3=0.9)
    url_state.commit()
    assert explorer.scene.messages and url_state.query == query
    url_state.undo()  # back from an impossible input
    assert not explorer.scene.messages and (explorer.I3, explorer.K_J) == (0.408, 6.0) and url_state.query == query


def test_a_view_made_later_gets_its_part_of_the_link():
    texts, _ = read("?v=4&mapby=heat&mapat=3_4&by=share&KJ=6&x=%26a%3Db")
    explorer, _ = explorer_of(texts)
    url_state, other = kept(explorer, texts), MapChoice()
    assert opened(url_state.query)[0].K_J == 6
    assert read(url_state.query)[0] == texts  # the state of views that do not exist yet stays in the link
    url_state.add(other)
    assert url_state.sentence == "" and (other.colour, other.place) == ("heat", [3.0, 4.0])
    assert not url_state.can_undo
    other.place = [5.0, 4.0]
    url_state.commit()
    assert read(url_state.query)[0]["mapat"] == "5_4"
    url_state.undo()
    assert other.place == [3.0, 4.0]
    explorer = Explorer()
    url_state, other = kept(explorer, {"mapby": "much"}), MapChoice()
    url_state.add(other)
    url_state.commit()
    assert "mapby" in url_state.sentence
    other.place = [2.0, 2.0]
    url_state.commit()
    assert url_state.sentence == ""


def test_what_was_open_is_opened_again_and_nothing_else_changes():
    class Rooms(param.Parameterized):
        room, level = param.String("lab"), param.String("explore")

    class Learn(param.Parameterized):
        step, section, room = param.String("flips"), param.String("lesson"), param.String("")

    rooms, learn, (explorer, _) = Rooms(), Learn(), explorer_of({"by": "share"})
    url_state = kept(explorer)
    url_state.add(rooms, lambda rooms: {"room": None, "level": None})
    lab = url_state.where
    explorer.set(K_J=6.0)
    url_state.commit()
    assert url_state.where == lab
    rooms.room = "learn"
    url_state.commit()
    before, learn.step = url_state.where, "way"
    url_state.add(learn)
    url_state.commit()
    assert len({lab, before, url_state.where}) == 3
    url_state.visit(before)
    assert (rooms.room, learn.step, url_state.where) == ("learn", "flips", before)
    rooms.level = "research"
    url_state.visit(before)
    assert rooms.level == "explore"
    url_state.visit("?v=4&tab=nowhere&level=explore&step=way&KJ=3")
    assert (rooms.room, rooms.level, learn.step, explorer.K_J) == ("learn", "explore", "way", 6.0)


def test_every_input_of_the_explorer_is_kept():
    assert {*DEFAULTS} - {"motion"} == {*EXPLORER}
    assert all(field.key == field.key.strip("_") for field in EXPLORER.values())
    assert len({field.key for field in EXPLORER.values()}) == len(EXPLORER)
    assert all(fields(shape) for shape in BODIES)


def test_what_was_paused_plays_on_when_it_is_played():
    top = Playing()
    url_state, clock = UrlState(), Clock(top)
    url_state.add(clock)
    for playing in (False, True, False, True):
        top.playing = playing
        url_state.commit()
        assert top.playing is playing and ("t=" in url_state.query) is not playing


def test_the_words_that_a_link_may_have_are_written_as_in_the_link():
    """Not as numbers, because each language writes decimal points and signs in its own way."""
    for language in ("en", "de"):
        with speaking(language):
            _, sentence = explorer_of({"limit": "sideways"})
        assert "lift, slip" in sentence


def test_a_rounded_stem_is_said_in_a_link_and_a_sharp_one_goes_without_saying():
    sharp = TruncatedSphere.paper()
    rounded = replace(sharp, rounding=0.002)
    assert Body.text(sharp) == "TruncatedSphere_.016_.0082_.0192_.0032_.0115"
    assert Body.text(rounded) == Body.text(sharp) + "_.002" and Body.value(Body.text(rounded)) == rounded
    bored = replace(sharp, hole=0.009, depth=0.008)  # whose rounding is no longer the default
    assert Body.text(bored) == Body.text(sharp) + "_0_.009_.008" and Body.value(Body.text(bored)) == bored
    filled = replace(rounded, disc=0.004, thickness=0.003, height=0.002)
    assert Body.text(filled) == Body.text(rounded) + "_0_0_.004_.003_.002" and Body.value(Body.text(filled)) == filled
