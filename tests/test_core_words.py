"""Every event, verdict and preset of tippe_core has words on the page, in every language. Errors: test_text.py."""

import inspect
import re

import numpy as np
import pytest
from doubles import builder_of

import tippe_core
from app.model.build.dimensions import FAMILIES, sentence
from app.model.explorer import Explorer
from app.model.lab.examples import EXAMPLES as STARTS
from app.model.run import THROWN
from app.tabs.lab.words import outcome_words
from app.text import LANGUAGES, listed, say
from tippe_core import PRESETS, Scales, State, Top, TopError, load_top, outcome, slide
from tippe_core.motion.events import EVENTS, change
from tippe_core.motion.kinds import HALTS, LEAVES, SLIPS, TOUCHES
from tippe_core.motion.records import OPEN, SLIP
from tippe_core.motion.trajectory import ANOTHER_TOUCHES


def quoted(function, start, end):
    """The quoted words in a part of a docstring."""
    text = inspect.getdoc(function)  # as one Python indents it and another does not
    part = text[text.index(start) : text.index(end)]
    return {" ".join(words.split()) for words in re.findall(r'"([^"]+)"', part)}


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_event_has_words(language):
    names = quoted(slide, "events are located", 'too many steps"') | {"too many steps"}
    contacts = [(ball, stem) for ball in (OPEN, SLIP) for stem in (OPEN, SLIP)]
    for before in contacts:
        for after in contacts:
            for event in [(kind, i) for kind in (HALTS, SLIPS, TOUCHES, LEAVES) for i in (0, 1)]:
                names.add(EVENTS[change(before, after, event)][0])
    assert len(names) >= 13
    assert {*listed("planes.events", language)} == names | {THROWN, ANOTHER_TOUCHES}


STARTS_OF_ALL_KINDS = [
    (Top(a, I1, I3), State(theta, 0.0, omega2, omega3))
    for a, I1, I3 in [(0.07, 0.399, 0.408), (0.3, 131 / 350, 0.4), (0.3, 0.25, 0.4), (0.3, 0.6, 0.4), (0.0, 0.4, 0.4),
                      (-1.2, 0.9, 0.5), (-1.2, 2.0, 0.5)]
    for theta in (0.1, 1.5, 3.0)
    for omega2, omega3 in ((0.0, 0.0), (0.0, 2.0), (1.0, -3.0), (0.0, 12.0))
]  # fmt: skip


def test_every_outcome_has_words_with_its_spin():
    scales, verdicts = Scales(R=0.02, M=0.02), set()
    for top, state in STARTS_OF_ALL_KINDS:
        goes = outcome(top, state)
        verdicts.add(goes.verdict)
        assert f"{abs(goes.launch) * scales.angular_velocity / (2 * np.pi):.3g} rev/s" in outcome_words(goes, scales)
    assert verdicts == quoted(tippe_core.Outcome, "verdict : ", "\nnudged ")
    for language in LANGUAGES:
        assert {*listed("planes.outcome.will", language)} == verdicts


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_body_and_start_has_a_name(language):
    bodies = listed("build.presets", language)
    assert [*bodies] == [preset.name for preset in PRESETS]
    assert [*listed("build.families", language)] == [name for name, _ in FAMILIES.values()]
    assert [*listed("planes.presets", language)] == [*STARTS]
    # choices are identified by their names, so these differ
    for names in ([body["name"] for body in bodies.values()], listed("planes.presets", language).values()):
        assert len({*names}) == len([*names])
    if language == "en":
        assert [(name, body["source"]) for name, body in bodies.items()] == [
            (preset.name, preset.source) for preset in PRESETS]  # fmt: skip
    for kind, dimensions in FAMILIES.values():
        assert all(say(f"build.dimensions.{each.key}", language) for each in dimensions), kind


def test_an_error_is_told_in_german_with_the_units_of_the_sliders(monkeypatch):
    monkeypatch.setattr("app.text._ask", [lambda: "de"])
    builder = builder_of(Explorer())
    builder.set("c", 0.5)
    said = builder.draft.messages["c"]
    assert said.startswith("c = 500 mm ist nicht möglich: erlaubt ist") and "(mm, der Schnitt geht" in said
    builder.load("no top at all")
    assert "JSON-Dokument" in builder.draft.messages["file"] and "Zeile 1" in builder.draft.messages["file"]
    with pytest.raises(TopError) as error:
        load_top('{"schema": 1}')
    assert "fehlt" in sentence(error.value)
    goes = outcome(Top.paper(), State(np.radians(10), 0.0, 0.0, 5.0))
    said = outcome_words(goes, Scales.paper())
    assert re.fullmatch(r"Wie bei einem aufrechten Start mit [\d,]+ U/s stellt er sich auf den Kopf: .*", said)
