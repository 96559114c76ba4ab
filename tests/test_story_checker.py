"""The checker of the story, on runs made by hand of which it is plain what happens."""

import dataclasses

import numpy as np
import pytest
import story_checker
import story_kept
import story_phases
import story_words
from story_said import Said
from story_samples import Phase, Run


def made(tilt, spans, a=0.2, supports=((0, "ball"),), spin=20.0, regime="slip", moves=np.inf, at=0.01):
    """A Run through (s, degrees), straight between them; spans: (kind, from, to); it moves until then."""
    times, tilts = np.transpose(tilt)
    t = np.linspace(0, times[-1], round(times[-1] / at) + 1)
    since = np.searchsorted([s for s, _ in supports], t + 1e-9, "right") - 1
    return Run(
        t=t, tilt=np.interp(t, times, tilts), spin=np.where(t < moves, spin, 0.0), a=a,
        support=np.array([what for _, what in supports])[since], regime=np.full(len(t), regime),
        kinetic=np.where(t < moves, 1.0, 0.0), supports=supports, phases=tuple(Phase(*span) for span in spans),
    )  # fmt: skip


def swinging(middle, by, period, seconds):
    """The knots of a tilt that swings."""
    t = np.linspace(0, seconds, int(seconds * 200) + 1)
    return np.c_[t, middle + by * np.sin(2 * np.pi * t / period)]


T5, T90, T170 = (2 + 4 * (tilt - 3) / 175 for tilt in (5, 90, 170))
LEFT = 2 + 3 / 68  # 5 degrees, of the top that falls
RUNS = {
    "turns over": made(
        [(0, 3), (2, 3), (6, 178), (9, 178)],
        [("stands-upright", 0, T5), ("rises", T5, T90), ("over", T90, T170), ("stands-on-stem", T170, 9)],
        supports=((0, "ball"), (4.8, "both"), (5.5, "stem")),
    ),
    "upside down on its ball": made([(0, 175), (4, 175)], [("stands-inverted", 0, 4)], a=0.0),
    "hops": made(
        [(0, 60), (3, 60)], [("leans", 0, 1), ("flies", 1, 1.1), ("leans", 1.1, 3)],
        supports=((0, "ball"), (1, "none"), (1.1, "ball"), (2, "none"), (2.03, "ball")),
    ),
    "comes to rest": made([(0, 8), (4, 8)], [("nods", 0, 2), ("lies", 2, 4)], regime="roll", moves=1.995),
    "falls": made(
        [(0, 2), (2, 2), (3, 70), (6, 70)], [("stands-upright", 0, LEFT), ("falls", LEFT, 3), ("leans", 3, 6)], a=-1.0
    ),
    "swings": made(swinging(40, 20, 1, 6), [("swings", 0, 6)], regime="roll"),
    "tips back": made(
        [(0, 150), (2, 150), (4, 30), (7, 30)],
        [("leans", 0, 5 / 3), ("sinks", 5 / 3, 2.5), ("tips-back", 2.5, 235 / 60), ("leans", 235 / 60, 7)],
        a=0.0,
    ),
    "once about": made([(0, 30), (1, 45), (2, 30)], [("slides", 0, 2)]),
    "once about, rolling": made([(0, 30), (1, 45), (2, 30)], [("rolls", 0, 2)], regime="roll"),
}  # fmt: skip
"""{what it does: a run whose phases are true}."""


def told(run, *phases):
    return dataclasses.replace(run, phases=tuple(phases), known={})


@pytest.mark.parametrize("name", RUNS)
def test_true_phases_pass(name):
    assert story_phases.faults(RUNS[name]) == []


@pytest.mark.parametrize("name", RUNS)
def test_another_kind_is_refused(name):
    """Whatever is told instead of any one phase."""
    run = RUNS[name]
    for i, phase in enumerate(run.phases):
        for kind in set(story_phases.ORDER) - {phase.kind}:
            false = dataclasses.replace(phase, kind=kind)
            assert story_phases.faults(told(run, *run.phases[:i], false, *run.phases[i + 1 :])), false


@pytest.mark.parametrize("name", [name for name, run in RUNS.items() if len(run.phases) > 1])
def test_a_phase_left_out_or_moved_is_refused(name):
    run = RUNS[name]
    for i, (one, other) in enumerate(zip(run.phases[:-1], run.phases[1:], strict=True)):
        before, after = run.phases[:i], run.phases[i + 2 :]
        assert story_phases.faults(told(run, *before, one, *after)), f"without {other}"
        joined = dataclasses.replace(one, t1=other.t1)
        assert story_phases.faults(told(run, *before, joined, *after)), f"{other} is {one.kind}"
        for at in (one.t1 - 0.45 * min(1, one.t1 - one.t0), other.t0 + 0.45 * min(1, other.t1 - other.t0)):
            moved = dataclasses.replace(one, t1=at), dataclasses.replace(other, t0=at)
            assert story_phases.faults(told(run, *before, *moved, *after)), f"{one.kind} to {at:.2f} s"


SAYINGS = [  # the run, the phase, what is true of it, what is not
    ("turns over", 1, f"At {T90:.1f} s it turns over.", "At 4.9 s it turns over."),
    ("turns over", 1, "Its tilt goes from 5° to 90°.", "Its tilt goes from 3° to 90°."),
    ("turns over", 0, "It started that way. Its low weight holds it upright.", "20 turns a second hold it there."),
    ("turns over", 0, "It stands upright and spins.", "It stands on its stem and spins on."),
    ("turns over", 0, "At 9 s it still spins, 20 turns a second.", "At 9 s it still spins, 21 turns a second."),
    ("turns over", 2, "It turns over.", "Rolling, it does not turn over."),
    ("turns over", 2, "Its heavy side goes up.", "Its heavy side comes down again."),
    ("turns over", 3, "Rubbing against the table turned it over.", "It started that way."),
    ("turns over", 3, "It stands on its stem and spins on.", "Here it goes on like this forever, from -0.0 rev/s."),
    ("upside down on its ball", 0, "Its tilt stays at 175°.", "Its heavy side goes up."),
    ("hops", 1, "For 0.10 s nothing carries it.", "For 0.12 s nothing carries it."),
    ("comes to rest", 1, "It lies still. Its motion is used up; it rests at 8°.", "It rests at 9°."),
    ("falls", 0, "20 turns a second hold it there; it needs about 15.",
     "20 turns a second hold it there; it needs about 25."),
    ("falls", 0, "At 2.0 s it falls.", "Its low weight holds it upright."),
    ("falls", 1, "It falls. Its tilt goes from 5° to 70°.", "Only 20 turns a second are left: too few to hold it up."),
    ("falls", 1, "With 20 turns a second it cannot stay up: it would need about 30.",
     "With 20 turns a second it cannot stay up: it would need about 10."),
    ("swings", 0, "It sways between 20° and 60°.", "It sways between 22° and 60°."),
    ("swings", 0, "Nothing slides on so rough a table.", "It never turns over: it stays at 40°."),
    ("tips back", 2, "Its tilt goes from 120° to 35°.", "Its heavy side comes down again."),
    ("once about", 0, "Its tilt goes from 30° to 30°, and is 45° at most.",
     "It swings back and forth between 30° and 45°."),
    ("once about", 0, "At 2 s its tilt is 30°.", "Nothing rubs any more."),
]  # fmt: skip


@pytest.mark.parametrize(("name", "i", "true", "false"), SAYINGS)
def test_sentences(name, i, true, false):
    run = RUNS[name]

    def faults(text):
        return story_words.faults(Said(text, run, run.phases[i], {}))

    assert faults(true) == []
    assert faults(false)


def test_both_keep_the_energy_counts_the_grip():
    """The rough table has taken a tenth before its first sample."""
    start, rough = RUNS["comes to rest"], RUNS["swings"]
    run = dataclasses.replace(start, kinetic=np.full(len(start.t), 3.0))
    others = {"ordinary": run, "rough": dataclasses.replace(rough, kinetic=rough.kinetic + 5, tilt=0 * rough.tilt)}
    said = Said("Both keep the energy.", run, run.phases[0], others, whole=True)
    assert [kind for kind, _ in story_words.faults(said)] == ["words: both_keep"]
    near = "Without rubbing it stays near the tilt at which it started: between 0° and 0° on the rough table."
    assert not story_words.faults(dataclasses.replace(said, text=near))
    assert story_words.faults(dataclasses.replace(said, text=near.replace("0°", "2°")))
    alone = {"rough": others["rough"]}
    assert not story_words.faults(dataclasses.replace(said, others=alone))


ROWS = [  # quantity, what the samples of the spin or of the energy are, the true text, a false one
    ("spin", [20, 20, 20], "kept: 20.0 rev/s", "kept: 20.1 rev/s"),
    ("spin", [20, 19, 18], "nearly kept: 20 → 18 rev/s", "kept: 20 rev/s"),
    ("spin", [20, 15, 4], "lost: 20 → 4 rev/s", "nearly kept: 20 → 4 rev/s"),
    ("spin", [20, 5, -4], "through zero: 20 → −4 rev/s", "swings a little: −4 – 20 rev/s"),
    ("spin", [20, 21, 20], "swings a little: 20 – 21 rev/s", "swings a little: 19 – 21 rev/s"),
    ("spin", [-4, 0, 5], "through zero: −4 → 5 rev/s", "lost: −4 → 5 rev/s"),
    ("energy", [20, 10, 10], "lost: 200 → 100 mm", "lost: 200 → 110 mm"),
]


@pytest.mark.parametrize(("quantity", "values", "true", "false"), ROWS)
def test_the_table_of_what_is_kept(quantity, values, true, false):
    samples = {"spin": np.array(values, float), "energy": np.array(values, float) - 1}  # G is 1 R above the table
    name = {"spin": "spin", "energy": "kinetic"}[quantity]
    run = dataclasses.replace(made([(0, 90), (0.02, 90)], [("nods", 0, 0.02)]), **{name: samples[quantity]})
    assert story_kept.faults(run, {quantity: true}, run) == []
    assert story_kept.faults(run, {quantity: false}, run)


def test_what_the_grip_took_is_counted():
    run = dataclasses.replace(made([(0, 90), (0.02, 90)], [("nods", 0, 0.02)]), spin=np.full(3, 20.0))
    rough = dataclasses.replace(run, spin=np.full(3, 15.0))
    assert story_kept.faults(rough, {"spin": "lost when gripped, then kept: 20 → 15 rev/s"}, run) == []
    assert story_kept.faults(rough, {"spin": "kept: 15 rev/s"}, run)


def test_a_story_that_is_told_as_data():
    """In the form of app.model.tell; a table that is refused has nothing to be held against."""
    run, says = RUNS["turns over"], {"rises": "It turns over."}
    phases = [
        {"kind": one.kind, "from": one.t0, "to": one.t1, "headline": says.get(one.kind, ""), "why": ""}
        for one in run.phases
    ]
    samples = {name: getattr(run, name).tolist() for name in ("t", "tilt", "spin", "support", "regime", "kinetic")}
    table = {
        "refused": "", "ended": "", "caption": "", "a": run.a, "phases": phases, "kept": [["spin", "0.2 → −0.0"]],
        "supports": [list(one) for one in run.supports], "samples": samples,
    }  # fmt: skip
    refused = {"refused": "below the table", "samples": {}, "phases": []}
    bad = story_checker.faults({"tables": {"ordinary": table, "ice": refused}})
    assert [kind for kind, _, _ in bad] == ["words: headline", "kept: minus zero"]


def test_the_arrival_must_be_told_in_words_that_say_something():
    run = RUNS["once about"]
    samples = {name: getattr(run, name).tolist() for name in ("t", "tilt", "spin", "support", "regime", "kinetic")}
    phase = {"kind": "slides", "from": 0, "to": 2, "headline": "It slides on.", "why": ""}
    told = {"tables": {"ordinary": {"refused": "", "ended": "", "a": 0.2, "phases": [phase], "samples": samples}}}
    said = [text for _, _, text in story_checker.arrival_faults(told)]
    assert said == ["slides and nods cover 2.00 of 2.00 s", "slides has no headline or no reason"]


def test_the_random_starts_are_those_of_the_seed():
    drawn = list(story_checker.starts(40, 3))
    assert drawn == list(story_checker.starts(40, 3)) != list(story_checker.starts(40, 4))
    assert len({name for name, _ in drawn}) > 6
