"""Divides a run into phases, each of one kind. docs/phases.md defines the kinds, in the same order.

Of a run it needs only what is in its table: times, tilts, what carries the top, whether it slips, spin and kinetic
energy.
"""

from collections.abc import Iterable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.model.spans import GAP, Span, changes, lasting, outside, passes, running_mean, within
from tippe_core import Trajectory
from tippe_core.types import Array, Bools

KINDS = ("flies", "lies", "stands-on-stem", "stands-upright", "stands-inverted", "over", "falls", "tips-back", "rises",
         "leans", "sinks", "swings", "nods", "rolls", "slides")  # fmt: skip
"""In the order in which they are tried: the first that fits is the kind of a phase."""
PASSAGES = ("over", "falls", "tips-back")
LEFT_OVER = KINDS[KINDS.index("rises") :]
HOP = 0.05  # s: a shorter flight is not a phase
SHORT = 0.3  # s: what is left over and shorter joins its neighbour
STANDS, UPRIGHT = (10.0, 0.5), (5.0, 1.0)  # degrees from 180 and from 0, and for how long, s
AT_REST, STILL = 1e-6, 1.0  # MgR of kinetic energy, and degrees, within which a top lies still
SPINS = 0.5  # rev/s: with less it is not called spinning
SIDE, BEYOND, LASTS, THERE = 90.0, 120.0, 0.5, 5.0  # degrees, degrees, s, degrees: of a passage over and back
STAYS = 1.0  # s: on the other side of SIDE, unless the run ends before
BELOW = 80.0  # degrees: a passage of SIDE counts from the first one since it was last so low
FALLS, FALLEN, FALL, AGAIN = 10.0, 30.0, 2.0, 1.0  # degrees from the high pole, degrees, s, s: of a fall
AROUND, TURN, LEG, NEAR = 1.0, 5.0, 10.0, (2.0, 5.0)  # s, degrees: of the running mean, and of a rise in it
GOES = 3.0  # degrees: by so much the mean of the second half of a rise is beyond that of the first
NODS = 10.0  # degrees: what changes by less within a second leans or nods, by more it swings


class Samples(NamedTuple):
    """A run as it is divided: t (n,) in s; tilt (n,) in degrees; carried (n,), "ball", "stem", "both" or "none";
    rolls (n,); spin (n,) in rev/s; kinetic (n,) in MgR; flights, as (from, to) in s; a of the top; cuts, the times (s)
    at which what is left over is divided: where its stem leaves the table, and where it begins to roll, each for good;
    repeats, since when (s) nothing is lost any more, so that its tilt repeats itself."""

    t: Array
    tilt: Array
    carried: NDArray[np.str_]
    rolls: Bools
    spin: Array
    kinetic: Array
    flights: tuple[tuple[float, float], ...]
    a: float
    cuts: tuple[float, ...] = ()
    repeats: float = np.inf

    @property
    def fallen(self) -> Array:
        """How far the axis is from where its centre of mass is highest, (n,) in degrees: 180, or 0 where a < 0."""
        return self.tilt if self.a < 0 else 180.0 - self.tilt


def samples(
    moved: Trajectory, unit: float, turns: float, cuts: tuple[float, ...] = (), repeats: float = np.inf
) -> Samples:
    """The Samples of a motion; unit: the seconds in its unit of time; turns: the rev/s in that of angular velocity."""
    since, on = zip(*moved.supports, strict=True)
    until = *since[1:], moved.t[-1]
    flights = tuple((unit * a, unit * b) for a, b, what in zip(since, until, on, strict=True) if what == "none")
    return Samples(unit * moved.t, np.degrees(moved.theta), carried(moved, moved.t), moved.regime == "roll",
                   turns * moved.omega[:, 2], moved.ledger.kinetic, flights, moved.top.a, cuts, repeats)  # fmt: skip


def carried(moved: Trajectory, t: Array) -> NDArray[np.str_]:
    """What the top stands on at the times t, in the motion's unit: "ball", "stem", "both" or "none"."""
    since, on = zip(*moved.supports, strict=True)
    return np.array(on)[np.searchsorted(since, t, side="right") - 1]


class Phase(NamedTuple):
    """From one time to another, s; kind: one of KINDS."""

    kind: str
    start: float
    end: float


def phases(run: Samples) -> tuple[Phase, ...]:
    """The phases of a run: contiguous, from its first sample to its last."""
    first, last = float(run.t[0]), float(run.t[-1])
    if len(run.t) < 2 or last <= first:
        stands = run.tilt[0] > 180.0 - STANDS[0] and run.carried[0] in ("stem", "both")
        return (Phase("stands-on-stem" if stands else "rolls" if run.rolls[0] else "slides", first, last),)
    found: list[Phase] = []
    for kind, spans in _spans(run):
        for span in spans:
            pieces = outside(span, [phase[1:] for phase in found])
            found += [Phase(kind, *piece) for piece in pieces if kind != "rises" or _goes(run, piece) >= GOES]
    for piece in outside((first, last), [phase[1:] for phase in found]):
        edges = [piece[0], *(cut for cut in sorted({*run.cuts}) if piece[0] < cut < piece[1]), piece[1]]
        for part in pairwise(edges):
            found += _rest(run, part)
    return _joined(sorted(found, key=lambda phase: phase.start), run)


def _spans(run: Samples) -> Iterable[tuple[str, list[Span]]]:
    """The spans of each kind that has one of its own, in the order of KINDS."""
    stands = _stands(run)
    poles = [*stands["stands-on-stem"], *stands["stands-inverted"]]
    over = _passages(run.t, run.tilt)
    yield "flies", [(start, end) for start, end in run.flights if end - start > HOP]
    yield "lies", _lies(run)
    yield from stands.items()
    yield "over", [_until(passage, poles) for passage in over]
    yield "falls", _falls(run, [end for spans in stands.values() for _, end in spans]) if run.a else []
    yield "tips-back", _back(run.t, run.tilt)
    yield "rises", _legs(run, up=True)


# ---- at rest, and standing ----


def _lies(run: Samples) -> list[Span]:
    moves = np.flatnonzero((run.kinetic >= AT_REST) | (np.abs(run.tilt - run.tilt[-1]) > STILL))
    since = moves[-1] + 1 if len(moves) else 0
    balances = run.a and run.carried[-1] == "ball" and run.fallen[-1] < 180.0 - STANDS[0]
    if balances or since == len(run.t) or run.t[-1] - run.t[since] < STANDS[1]:
        return []
    return [(float(run.t[since]), float(run.t[-1]))]


def _stands(run: Samples) -> dict[str, list[Span]]:
    off, long = STANDS
    found: dict[str, list[Span]] = {"stands-on-stem": [], "stands-upright": [], "stands-inverted": []}
    for start, end in lasting(run.t, run.tilt - (180.0 - off), long):
        inside = (run.t >= start) & (run.t <= end)
        stem = np.isin(run.carried[inside], ("stem", "both")).mean() > 0.5
        found["stands-on-stem" if stem else "stands-inverted"].append((start, end))
    near, while_ = UPRIGHT
    upright = np.where((run.carried == "ball") & (np.abs(run.spin) >= SPINS), near - run.tilt, -1.0)
    found["stands-upright"] = lasting(run.t, upright, while_)
    return found


# ---- passages ----


def _passages(t: Array, tilt: Array) -> list[Span]:
    """From SIDE before each lasting spell beyond BEYOND, to when it is THERE."""
    found, high = [], _beyond(t, tilt)
    for start, end in _stays(t, tilt - SIDE):
        spells = [spell for spell in high if start <= spell[0] and spell[1] <= end]
        if not spells or spells[0][0] == t[0]:
            continue  # it is only past its side, or was put down so
        low = np.flatnonzero((t <= start) & (tilt <= BELOW))
        since = int(low[-1]) if len(low) else 0
        over = since + int(np.argmax(tilt[since:] >= SIDE))
        begins = float(t[0]) if over == 0 else passes(t, tilt, SIDE, over - 1)
        inside = (t >= start) & (t <= end)
        found.append((begins, float(t[np.argmax(inside & (tilt >= tilt[inside].max() - THERE))])))
    return found


def _stays(t: Array, above: Array) -> list[Span]:
    """The spans in which it stays on one side, the last of them however short."""
    return [span for span in lasting(t, above, 0.0) if span[1] - span[0] >= STAYS or span[1] == t[-1]]


def _beyond(t: Array, tilt: Array) -> list[Span]:
    return lasting(t, tilt - BEYOND, LASTS)


def _back(t: Array, tilt: Array) -> list[Span]:
    """From BEYOND before each lasting spell below SIDE, if a lasting spell beyond ends there, to when it is THERE."""
    found: list[Span] = []
    high = _beyond(t, tilt)
    for start, end in _stays(t, SIDE - tilt):
        last = t[(t <= start) & (tilt >= BEYOND)][-1:]
        leaves = [spell[1] for spell in high if len(last) and spell[0] <= last[0] <= spell[1]]
        if leaves and (not found or leaves[0] > found[-1][0]):
            inside = (t >= start) & (t <= end)
            there = inside & (tilt <= tilt[inside].min() + THERE)
            found.append((leaves[0], float(t[np.argmax(there)])))
    return found


def _falls(run: Samples, stood: list[float]) -> list[Span]:
    """From where it leaves the high pole until it turns, if it comes to FALLEN in time and not at once back."""
    t, fallen, first = run.t, run.fallen, float(run.fallen[0])
    near = [end for start, end in lasting(t, FALLS - fallen, 0.0) if start == t[0] or end - start >= SHORT]
    starts = [(end, FALLS, FALLEN) for end in near]
    if FALLS < first <= FALLEN:
        starts.insert(0, (float(t[0]), first, first + FALLEN - FALLS))
    found: list[Span] = []
    for start, least, most in starts:
        far = np.flatnonzero((t >= start) & (fallen >= most))
        if not len(far):
            continue
        j = int(far[0])
        there = passes(t, fallen, most, j - 1)
        if there - start > FALL or np.any((t > start) & (t < there) & (fallen < least - STILL)):
            continue
        again = np.flatnonzero(fallen[j:] <= least)
        if len(again) and t[j + again[0]] - there <= AGAIN:
            continue
        turns = np.flatnonzero(np.diff(fallen[j:]) <= 0)
        begins = min([start, *(end for end in (*stood, float(t[0])) if start - SHORT < end < start)])
        found.append((begins, float(t[j + turns[0]] if len(turns) else t[-1])))
    return found


# ---- the mean tilt ----


def _legs(run: Samples, *, up: bool) -> list[Span]:
    """The spans in which the running mean goes towards the high pole (up) or away from it, by at least LEG, without
    going back by TURN, and are not undone at once."""
    t, mean = run.t, running_mean(run.t, run.fallen, AROUND) * (1 if up else -1)
    found: list[Span] = []
    high = low = 0
    for i in range(1, len(mean) + 1):
        if i == len(mean) or mean[i] > mean[low] + TURN:
            back = mean[low:][t[low:] <= t[low] + AGAIN].max()
            if mean[high] - mean[low] >= LEG and back < (mean[high] + mean[low]) / 2:
                leg = mean[high : low + 1]
                begins = float(t[high + int(np.flatnonzero(leg >= mean[high] - NEAR[0])[-1])])
                ends = float(t[high + int(np.argmax(leg <= mean[low] + NEAR[1]))])
                begins = t[0] if begins < t[0] + AROUND else begins
                ends = float(t[-1]) if t[low] > t[-1] - AROUND / 2 else ends
                if begins < min(ends, run.repeats):
                    found.append((float(begins), min(ends, run.repeats)))
            high = low = min(i, len(mean) - 1)
        elif mean[i] < mean[low]:
            low = i
        elif mean[i] >= mean[high]:
            high = low = i
    return found


def _goes(run: Samples, span: Span) -> float:
    """By how much its mean tilt is nearer to the high pole in the second half of a span than in the first, degrees."""
    grid = np.linspace(*span, 401)
    first, second = np.array_split(np.interp(grid, run.t, run.fallen), 2)
    return float(first.mean() - second.mean())


# ---- what is left ----


def _rest(run: Samples, piece: Span) -> list[Phase]:
    """The phases of a piece of a run that is none of the above."""
    start, end = piece
    inside = _inside(run, piece)
    t, tilt = run.t[inside], run.tilt[inside]
    if len(t) < 2:
        return [Phase("slides", start, end)]
    swing, mean = changes(t, tilt, AROUND), running_mean(t, tilt, AROUND)
    sinks = within(t, _legs(run, up=False))
    kinds = np.where(swing > NODS, np.where(sinks, "sinks", "swings"),
                     np.where((mean < NODS) | (mean > 180.0 - NODS), "nods", "leans"))  # fmt: skip
    edges = [0, *(np.flatnonzero(kinds[1:] != kinds[:-1]) + 1).tolist(), len(t)]
    found = []
    for i, j in pairwise(edges):
        kind = str(kinds[i])
        span = start if i == 0 else float(t[i]), end if j == len(t) else float(t[j])
        if kind == "swings" or (kind == "sinks" and _goes(run, span) > -GOES):
            kind = _swings(run, span)
        found.append(Phase(kind, *span))
    return found


def _inside(run: Samples, span: Span) -> Bools:
    """Its samples; one at its end is of what comes next, unless the run ends there."""
    last = run.t[-1]
    return np.asarray((run.t >= span[0]) & ((run.t < span[1]) | ((run.t == last) & (span[1] == last))))


def _swings(run: Samples, span: Span) -> str:
    """The kind of a span in which the tilt changes by more than NODS: it comes back twice, or goes one way."""
    inside = _inside(run, span)
    if comes_back(run.tilt[inside]) >= 2:
        return "swings"
    nearer, (first, last) = _goes(run, span), np.interp(span, run.t, run.tilt)  # it may end between two samples
    if abs(nearer) >= GOES and abs(last - first) >= LEG:
        return "rises" if nearer > 0 else "sinks"
    return "rolls" if run.rolls[inside].all() else "slides"


def comes_back(tilt: Array) -> int:
    """How often the tilt turns and goes TURN the other way, after it went as far this way."""
    turns, low, high, sign = 0, tilt[0], tilt[0], 0
    for value in tilt:
        low, high = min(low, value), max(high, value)
        if sign <= 0 and value - low >= TURN:
            turns, sign, high = turns + bool(sign), 1, value
        elif sign >= 0 and high - value >= TURN:
            turns, sign, low = turns + bool(sign), -1, value
    return turns


def _until(span: Span, others: list[Span]) -> Span:
    """A span up to the first of the others that begins in it."""
    return span[0], min([span[1], *(start for start, _ in others if start > span[0])])


def _joined(found: list[Phase], run: Samples) -> tuple[Phase, ...]:
    """The phases, without what is left over and SHORT: beginning with the shortest, it joins the longer of its
    neighbours that are left over too; if none is, the phase before it (or after it), if it is shorter than GAP or
    that is a passage. With what joins it, it is judged anew. Like joins like except at a cut."""
    kept, tried = _alike(found, run), set[Phase]()
    while short := [phase for phase in kept if phase.kind in LEFT_OVER and _long(phase) < SHORT and phase not in tried]:
        phase = min(short, key=_long)
        tried.add(phase)
        i = kept.index(phase)
        beside = [j for j in (i - 1, i + 1) if 0 <= j < len(kept) and max(phase.start, kept[j].start) not in run.cuts]
        left_over = [j for j in beside if kept[j].kind in LEFT_OVER]
        passing = i > 0 and kept[i - 1].kind in PASSAGES
        if left_over or (beside and _long(phase) < (SHORT if passing else GAP)):
            j = max(left_over, key=lambda j: _long(kept[j])) if left_over else beside[0]
            first, last = min(i, j), max(i, j)
            joins = _judged(run, Phase(kept[j].kind, kept[first].start, kept[last].end))
            kept = _alike([*kept[:first], joins, *kept[last + 1 :]], run)
    return tuple(kept)


def _judged(run: Samples, phase: Phase) -> Phase:
    """The phase; what rolls, slides, sinks or rises by its ends alone may be of another kind as a whole."""
    by_ends = phase.kind == "rises" and not any(
        start < phase.end and phase.start < end for start, end in _legs(run, up=True)
    )
    if by_ends or phase.kind in ("rolls", "slides") or (phase.kind == "sinks" and _goes(run, phase[1:]) > -GOES):
        return phase._replace(kind=_swings(run, phase[1:]))
    return phase


def _alike(found: list[Phase], run: Samples) -> list[Phase]:
    """The phases; neighbours of the same kind are one."""
    joined: list[Phase] = []
    for phase in found:
        if joined and joined[-1].kind == phase.kind and phase.start not in run.cuts:
            joined[-1] = _judged(run, joined[-1]._replace(end=phase.end))
        else:
            joined.append(phase)
    return joined


def _long(phase: Phase) -> float:
    return phase.end - phase.start
