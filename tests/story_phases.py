"""The phases that are told of a run, held against its samples; both ways: what is told must be so, and what is so must
be told. Written from docs/phases.md alone; nothing of the app is imported."""

import numpy as np
from story_facts import FACTS, drifts
from story_samples import Phase, comings_back, minus, sampled, spells

LATER = "leans", "sinks", "swings", "nods", "rolls", "slides"
"""The kinds that divide what the others leave, with `rises`."""
WHILE = 0.2  # s: a stem that is on the table for less does not leave it
PIECE = 0.3  # s: a shorter piece belongs to its neighbour
ORDER = (*FACTS, *LATER)
SHARE = 0.1  # s: a shorter piece belongs to its neighbour whatever that is
NEAR = 0.5  # degrees: by how much a limit may be missed in a test of what is left to rounding


def faults(run):
    """[(which test, why it fails)] of the phases of a run, [] if all are true."""
    bad = list(_contiguous(run))
    if any(one.kind not in ORDER for one in run.phases):
        return bad
    for kind in FACTS:
        bad += _told(run, kind) + _untold(run, kind)
    for piece in left(run):
        bad += [fault for phase in _within(run, piece) for fault in LATER_TESTS[phase.kind](run, phase, piece)]
    return bad + list(_divided(run))


def _contiguous(run):
    """The phases cover the run without a gap."""
    if not run.phases:
        yield "no phases", f"none is told of a run of {run.end - run.start:g} s"
        return
    for phase in run.phases:
        if phase.kind not in ORDER:
            yield "unknown kind", phase.kind
        if phase.t1 < phase.t0 or (phase.t1 == phase.t0 and len(run.phases) > 1):
            yield "empty phase", _text(phase)
    ends = [run.start, *(one.t1 for one in run.phases)], [*(one.t0 for one in run.phases), run.end]
    for to, since in zip(*ends, strict=True):
        if abs(to - since) > 1e-3:
            yield "gap", f"nothing is told from {to:.4f} to {since:.4f} s"


def _text(phase):
    return f"{phase.kind} {phase.t0:.3f} to {phase.t1:.3f} s"


def _size(intervals):
    return sum(e - s for s, e in intervals)


def facts(run, kind, sure):
    """[(from, to)] of a kind, of `rises` only what counts beside the phases told before it."""
    key = kind, sure
    if key not in run.known:
        found = FACTS[kind](run, sure)
        if kind == "rises":
            taken = [(one.t0, one.t1) for one in run.phases if one.kind in tuple(FACTS)[:-1]]
            parts = [part for one in found for part in minus([one], taken)]
            found = [part for part in parts if _nearer(run, *part) >= 3 + (NEAR if sure else -NEAR)]
        run.known[key] = found
    return run.known[key]


def _nearer(run, t0, t1):
    """By how much nearer to the high pole the mean tilt of the second half is."""
    middle = (t0 + t1) / 2
    return abs(run.mean(t0, middle) - run.high) - abs(run.mean(middle, t1) - run.high)


def _told(run, kind):
    """What is told must be so; it may have taken a piece beside it that is too short."""
    more = run.slack + (PIECE if kind in ("over", "falls", "tips-back") else SHARE)
    bad, may = [], [(s - more, e + more) for s, e in facts(run, kind, False)]
    for phase in run.phases:
        wrong = [] if phase.kind != kind else minus([(phase.t0, phase.t1)], may)
        if kind == "rises" and wrong:
            wrong = [part for part in wrong if not _rising_piece(run, phase, part)]
        if max((e - s for s, e in wrong), default=0) > PIECE or _size(wrong) > 0.5 * (phase.t1 - phase.t0):
            bad.append((f"false {kind}", f"{_text(phase)}; by the samples {_list(may, more)}"))
        elif wrong and kind != "rises":
            bad.append((f"ends of {kind}", f"{_text(phase)}; by the samples {_list(may, more)}"))
    return bad


def _list(intervals, slack):
    return ", ".join(f"{s + slack:.3f} to {e - slack:.3f}" for s, e in intervals) or "never"


def _rising_piece(run, phase, part):
    """Is this part of a phase a piece that swings and rises, or one too short to count?"""
    if part[1] - part[0] < PIECE + run.slack:
        return True
    for t0, t1 in (part, (phase.t0, phase.t1)):
        _, tilt = run.between(t0, t1)
        away = np.abs(tilt - run.high)
        if comings_back(tilt)[0] < 2 and away[0] - away[-1] >= 10 - NEAR and np.ptp(tilt) > 10:
            return True
    return False


def _untold(run, kind):
    """What is so must be told: by this kind, or by one that comes before it."""
    before = ORDER[: ORDER.index(kind) + 1]
    told = [(one.t0 - run.slack, one.t1 + run.slack) for one in run.phases if one.kind in before]
    bad = []
    for s, e in facts(run, kind, True):
        missing = minus([(s, e)], told)
        if kind == "rises":
            missing = [part for part in missing if part[1] - part[0] > PIECE + run.slack]
        if _size(missing) > 0.5 * (e - s):
            bad.append((f"untold {kind}", f"{s:.3f} to {e:.3f} s; told is {_at(run, s, e)}"))
        elif missing and kind != "rises":
            bad.append((f"ends of {kind}", f"by the samples {s:.3f} to {e:.3f} s; told is {_at(run, s, e)}"))
    return bad


def _at(run, s, e):
    return ", ".join(_text(one) for one in run.phases if one.t1 > s and one.t0 < e) or "nothing"


def left(run):
    """The pieces that the kinds before `leans` leave, cut at the divisions."""
    taken = [(one.t0, one.t1) for one in run.phases if one.kind in FACTS and not _only_swings(run, one)]
    cuts = [(at, at) for at in divisions(run)]
    return [piece for piece in minus([(run.start, run.end)], taken + cuts) if piece[1] - piece[0] > run.slack]


def _only_swings(run, phase):
    """Does it rise only as a part of a piece whose tilt swings?"""
    some = minus([(phase.t0, phase.t1)], facts(run, "rises", False))
    return phase.kind == "rises" and _size(some) > 0.5 * (phase.t1 - phase.t0)


def _within(run, piece):
    """The phases of the later kinds in a piece, unless they are too short to have a kind of their own."""
    return [
        one for one in run.phases
        if one.kind in LATER and one.t0 < piece[1] - run.slack and one.t1 > piece[0] + run.slack
        and one.t1 - one.t0 > PIECE
    ]  # fmt: skip


def divisions(run):
    """[when its stem leaves the table for good, when it begins to roll for good], of those that happen."""
    stem = [(since, to) for since, to, what in run.carried if what in ("stem", "both")]
    leaves = stem and run.carried[-1][2] == "ball" and stem[-1][1] - stem[0][0] > WHILE
    on_stem = [stem[-1][1]] if leaves else []
    spells = sampled(run.t, run.regime == "roll")
    rolling = [max(s, run.carried[-1][0]) for s, e in spells if e == run.end and s > run.start]
    return [at for at in [*on_stem[-1:], *rolling] if run.start < at < run.end]


def _wrong(run, phase, excess):
    """The longest spell in a phase in which something is wrong: where excess (a function of times) is positive."""
    t = np.unique(np.r_[phase.t0, run.t[run.inside(phase.t0, phase.t1)], phase.t1])
    return max((e - s for s, e in spells(t, excess(t))), default=0) if len(t) > 1 else 0


def _leans(run, phase, piece, least=10.0, most=170.0, nods=False):
    """The swing is at most 10 degrees; the mean is between, or for nods outside of, two tilts."""

    def swings(t):
        return np.minimum(run.swing(t, *piece), run.swing(t, *piece, clipped=False)) - 10 - NEAR

    def outside(t):
        means = [run.running(t, *piece, clipped=clipped) for clipped in (False, True)]
        inside = [np.minimum(mean - least, most - mean) for mean in means]
        return np.min(inside, axis=0) - NEAR if nods else -np.max(inside, axis=0) - NEAR

    for test, why in ((swings, "it swings by more than 10 degrees"), (outside, "the mean tilt is of another kind")):
        if (time := _wrong(run, phase, test)) > PIECE + run.slack:
            yield f"false {phase.kind}", f"{_text(phase)}: for {time:.2f} s {why}"


def _nods(run, phase, piece):
    yield from _leans(run, phase, piece, nods=True)


def _large(run, phase, piece):
    """It swings by more than 10 degrees at every instant."""

    def steady(t):
        return 10 - NEAR - np.maximum(run.swing(t, *piece), run.swing(t, *piece, clipped=False))

    if (time := _wrong(run, phase, steady)) > PIECE + run.slack:
        yield f"false {phase.kind}", f"{_text(phase)}: for {time:.2f} s it swings by less than 10 degrees"


def _swings(run, phase, piece):
    yield from _large(run, phase, piece)
    widened = max(piece[0], phase.t0 - PIECE), min(piece[1], phase.t1 + PIECE)
    if comings_back(run.between(*widened)[1])[0] < 2:
        yield "false swings", f"{_text(phase)}: it comes back less than twice"
    if _surely(run, phase, piece, False):
        yield "false swings", f"{_text(phase)}: it sinks"


def _drifts(run, phase, nearer, sure):
    """Does it go nearer to the high pole in a phase, or away from it, as `sinks` says?"""
    far = (1 if nearer else -1) * _nearer(run, phase.t0, phase.t1)
    if far < 3 + (NEAR if sure else -NEAR):
        return False
    _, tilt = run.between(phase.t0, phase.t1)
    away = (np.abs(tilt - run.high) - np.abs(tilt[0] - run.high))[-1] * (-1 if nearer else 1)
    back = comings_back(tilt)[1 if sure else 0]
    if back < 2 and away >= 10 + (NEAR if sure else -NEAR):
        return True
    found, size = [], 0.8 if sure else 0.0
    for t0, t1 in ((phase.t0, phase.t1), (run.start, run.end)):  # of the run: what comes next may undo it at once
        grid = run.t[run.inside(t0, t1)]
        inside = [(max(s, phase.t0), min(e, phase.t1)) for s, e in drifts(run, grid, t0, t1, nearer, sure)]
        found.append(_size([(s, e) for s, e in inside if e > s]) > size * (phase.t1 - phase.t0))
    return all(found) if sure else any(found)


def _surely(run, phase, piece, nearer):
    """The same of all of a phase and of its part that swings, without what was too short for a phase of its own."""
    t = run.t[run.inside(phase.t0, phase.t1)]
    if len(t) < 2 or not _drifts(run, phase, nearer, True):
        return False
    part = max(spells(t, run.swing(t, *piece) - 10), key=lambda one: one[1] - one[0], default=(phase.t0, phase.t1))
    return part[1] > part[0] and _drifts(run, Phase(phase.kind, *part), nearer, True)


def _sinks(run, phase, piece):
    yield from _large(run, phase, piece)
    if not _drifts(run, phase, False, False):
        yield "false sinks", f"{_text(phase)}: it does not go away from the high pole by 10 degrees"


def _slides(run, phase, piece):
    yield from _large(run, phase, piece)
    most = 0.0 if phase.kind == "slides" else run.slack  # one sample that slips is enough
    rolls = np.all(run.regime[run.inside(phase.t0 + most, phase.t1 - most)] == "roll")
    if rolls != (phase.kind == "rolls"):
        yield f"false {phase.kind}", f"{_text(phase)}: it {'rolls' if rolls else 'does not roll'} in every sample"
    if comings_back(run.between(phase.t0, phase.t1)[1])[0] >= 2:
        yield f"false {phase.kind}", f"{_text(phase)}: it swings"
    for nearer, kind in ((True, "rises"), (False, "sinks")):
        if _surely(run, phase, piece, nearer):
            yield f"false {phase.kind}", f"{_text(phase)}: it {kind}"


LATER_TESTS = {
    "leans": _leans, "sinks": _sinks, "swings": _swings, "nods": _nods, "rolls": _slides, "slides": _slides,
}  # fmt: skip


def _divided(run):
    """No later phase crosses a division, no two neighbours are of one kind, none is too short beside another."""
    at = divisions(run)
    for phase in run.phases:
        for one in at:
            if phase.kind in LATER and phase.t0 + SHARE < one - run.slack and one + run.slack < phase.t1 - SHARE:
                yield "not divided", f"{_text(phase)}, though its stem leaves or it begins to roll at {one:.3f} s"
    for one, other in zip(run.phases[:-1], run.phases[1:], strict=True):
        between = any(abs(one.t1 - division) < SHARE + run.slack for division in at)
        if one.kind == other.kind and not between:
            yield "not joined", f"{_text(one)} and {_text(other)}"
        later = one.kind in LATER and other.kind in LATER
        if later and not between and min(one.t1 - one.t0, other.t1 - other.t0) < PIECE - run.slack:
            yield "too short", f"{_text(one)} and {_text(other)}"
