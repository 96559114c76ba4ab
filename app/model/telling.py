"""What the page says of a start on each table, as data."""

from typing import Any

import numpy as np

from app.model.keeps import KINDS, keeps, while_it_turns
from app.model.lab.lab import LabScene
from app.model.run import TableMotion
from app.model.story import story
from app.text import listed, say, written

KEPT = {"energy": 0, "jellett": 2, "routh": 2, "spin": 1}
"""{quantity: decimals}, in the order of keeps()."""


def told(scene: LabScene) -> dict[str, Any]:
    """What the page says of a LabScene, in its language: "said", the headline and the explanation of all tables
    together, and "tables": {name: a table}.

    Of each table: "refused", why it has no run, else ""; "ended", the event that ended it early, else ""; "caption";
    "a"; "part", what touches besides the ball, "stem" or "rim", or "none"; "gripped", the share of its energy above
    the least that the rough table takes; "samples": lists of t (s), tilt (degrees), spin (rev/s), support, regime and
    kinetic (MgR); "supports": (from s, what carries it), exact; "phases": kind, from, to (s), headline and why;
    "events": (t, word); "kept": {quantity: kind, first, last, said}, from the start to the end.
    """
    tables = {name: _table(motion) for name, motion in scene.motions.items() if motion}
    none = {name: {"refused": why} | EMPTY for name, why in scene.refused.items()}
    return {"wording": list(scene.wording), "tables": none | tables}


MOST_DIGITS = 5
EMPTY = {"ended": "", "caption": "", "samples": {}, "supports": [], "phases": [], "events": [], "kept": {}}


def _table(motion: TableMotion) -> dict[str, Any]:
    moved, found, start = motion.trajectory, story(motion), motion.start
    samples = {"t": motion.seconds, "tilt": motion.tilt, "spin": moved.omega[:, 2] * start.turns,
               "support": motion.carried, "regime": moved.regime, "kinetic": moved.ledger.kinetic}  # fmt: skip
    energy = moved.energy[0] + motion.lost - min(0.0, 2 * moved.top.a)  # above where G is lowest
    return {
        "refused": "",
        "ended": motion.ended if motion.ended_at is not None else "",
        "caption": found.caption,
        "a": moved.top.a,
        "part": start.part if start.edge else "none",
        "gripped": motion.lost / energy if energy else 0.0,
        "samples": {name: np.asarray(values).tolist() for name, values in samples.items()},
        "supports": [(t * start.scales.time, on) for t, on in moved.supports],
        "phases": [
            {"kind": phase.kind, "from": phase.start, "to": phase.end, "headline": stage.headline, "why": stage.why}
            for phase in motion.phases
            for stage in found.stages
            if stage.t == phase.start
        ],
        "events": [(event.t, event.word) for event in found.events],
        "kept": _kept(motion),
    }


def _kept(motion: TableMotion) -> dict[str, Any]:
    words, found = listed("lab_view.view.keep"), {}
    for (name, digits), row in zip(KEPT.items(), keeps(motion)[-1, 1:].reshape(4, 3), strict=True):
        kind, first, last = KINDS[int(row[0])], float(row[1]), float(row[2])
        form = words["one" if kind == "kept" else "range" if kind == "swings" else "two"]
        while digits < MOST_DIGITS and kind != "kept" and f"{first:.{digits}f}" == f"{last:.{digits}f}":
            digits += 1
        numbers = {key: written(value, f".{digits}f") for key, value in (("first", first), ("last", last))}
        wording = f"{words[kind]}: {form.format(**numbers, unit=words['units'][list(KEPT).index(name)])}"
        found[name] = {"kind": kind, "first": first, "last": last, "wording": wording}
    if turning := while_it_turns(motion):
        time, before, then = turning
        found["jellett"]["turning"] = say("lab.kept.jellett", time=time, first=before, last=then)
    return found
