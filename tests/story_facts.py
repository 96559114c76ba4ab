"""What happens in a run, found in its samples by the definitions of docs/phases.md: each function gives the times
(from, to) of one kind, whether or not an earlier kind fits too.

sure: True gives only what is of this kind however the definition is read, False all that may be. Where the two differ
the definition can be read in two ways.
"""

import numpy as np
from story_samples import AT_REST, LONG, ONSTEM, SHORT, lasting, legs, minus, spells

STANDING = 0.5, 1.0  # s on the stem (or upside down), upright


def flies(run, sure):
    """Nothing carries it."""
    return [(t0, t1) for t0, t1, what in run.carried if what == "none" and t1 - t0 > LONG + (1e-9 if sure else -1e-9)]


def lies(run, sure):
    """It is at rest from then to the end."""
    still = (run.kinetic < AT_REST) & (np.abs(run.tilt - run.tilt[-1]) <= 1)
    since = run.t[np.max(np.nonzero(~still)[0], initial=-1) + 1 :]
    if not len(since) or run.end - since[0] < 0.5 - (0 if sure else 1e-9):
        return []
    alone = run.support[-1] == "ball" and run.a != 0
    return [] if alone and run.fallen[-1] < 170 else [(float(since[0]), run.end)]


def _inverted(run, sure):
    """[(from, to, share of the samples on the stem)] above 170 degrees."""
    if len(run.t) == 1:
        return [(run.start, run.end, float(run.support[0] in ONSTEM))] if run.tilt[0] > 170 else []
    long = [(s, e) for s, e in lasting(run.t, run.tilt - 170) if e - s >= STANDING[0] - (0 if sure else 1e-9)]
    on_stem = np.isin(run.support, ONSTEM)
    return [(s, e, np.mean(on_stem[run.inside(s, e)])) for s, e in long]


def stands_on_stem(run, sure):
    """Above 170 degrees, mostly on the stem."""
    return [(s, e) for s, e, share in _inverted(run, sure) if (share > 0.5 if sure else share > 0.49)]


def stands_inverted(run, sure):
    """Above 170 degrees, mostly on the ball."""
    return [(s, e) for s, e, share in _inverted(run, sure) if (share < 0.49 if sure else share <= 0.5)]


def stands_upright(run, sure):
    """Below 5 degrees, on the ball alone, and spinning; moments without these do not count."""
    near = -run.step if sure else run.step  # by so much a moment may seem to be shorter or longer
    others = [(t0, t1) for t0, t1, what in run.carried if what != "ball"]
    others += spells(run.t, 0.5 - np.abs(run.spin)) if len(run.t) > 1 else []
    others = [(t0, t1) for t0, t1 in others if t1 - t0 >= SHORT + near]
    upright = minus(lasting(run.t, 5 - run.tilt), others)
    return [(s, e) for s, e in upright if e - s >= STANDING[1] - (0 if sure else 1e-9)]


def over(run, sure):
    """It passes from one side to the other."""
    t, tilt, found = run.t, run.tilt, []
    beyond = lasting(t, tilt - 120)
    for s, e in lasting(t, tilt - 90):
        inside = [(max(s, b0), min(e, b1)) for b0, b1 in beyond if b1 > s and b0 < e]
        if (
            max((b1 - b0 for b0, b1 in inside), default=0) < 0.5 - (0 if sure else 1e-9)
            or (s == run.start and tilt[0] > 120)
            or (e - s < 1 and e < run.end)
        ):
            continue
        grid, values = run.between(s, e)
        near = first(grid, values - (np.max(values) - 5), s)
        stands = [b for b, _ in stands_on_stem(run, False) + stands_inverted(run, False) if b > s]
        found.append((_begins(run, s), min([near, *stands])))
    return found


def _begins(run, s):
    """When it passed 90 degrees for the first time since it was at 80 or less, or in the run."""
    low = max((e for _, e in spells(run.t, 80 - run.tilt) if e <= s), default=run.start)
    return min([b for b, _ in spells(run.t, run.tilt - 90) if low <= b <= s], default=s)


def first(t, excess, since):
    """The first time from `since` on at which a quantity, straight between its samples, is not negative."""
    for i in np.nonzero((t >= since) & (excess >= 0))[0]:
        if i == 0 or t[i - 1] < since or excess[i - 1] >= 0:
            return float(t[i])
        return float(t[i - 1] + (t[i] - t[i - 1]) * excess[i - 1] / (excess[i - 1] - excess[i]))
    return float(t[-1])


def falls(run, sure):
    """It leaves the high pole and does not come back."""
    if run.a == 0 or len(run.t) < 2:
        return []
    near = lasting(run.t, 10 - run.fallen)
    found = [_fall(run, e, 30, 10, near, sure) for s, e in near if s == run.start or e - s >= 0.3 - (not sure) * 1e-9]
    if not sure:
        found += [_fall(run, e, 30, 10, near, sure) for s, e in spells(run.t, 10 - run.fallen) if e - s > 0.1]
    at = run.fallen[0]
    if 10 < at < 30:
        found.append(_fall(run, run.start, at + 20, at if sure else 10, spells(run.t, at - 1 - run.fallen), sure))
    return [one for one in found if one]


def _fall(run, since, far, back, nearer, sure):
    """(from, to) if from `since` it falls to `far` within 2 s, and is not at `back` within 1 s."""
    until = first(run.t, run.fallen - far, since)
    if since >= run.end or until > since + 2 or np.interp(until, run.t, run.fallen) < far - 1e-9:
        return None
    if any(since + 1e-9 < b < until for b, _ in nearer) and sure:
        return None
    after = (run.t > until) & (run.t <= until + 1)
    if np.any(run.fallen[after] <= back):
        return None
    i = int(np.searchsorted(run.t, until))
    while i < len(run.t) - 1 and run.fallen[i + 1] > run.fallen[i]:
        i += 1
    return (since if sure else max(since - 0.3, run.start), float(run.t[i]))


def tips_back(run, sure):
    """The opposite of over."""
    t, tilt, found = run.t, run.tilt, []
    beyond = lasting(t, tilt - 120)
    for s, e in lasting(t, 90 - tilt):
        before = [(b0, b1) for b0, b1 in beyond if b1 <= s]
        if not before or (e - s < 1 and e < run.end) or before[-1][1] - before[-1][0] < 0.5 - (not sure) * 1e-9:
            continue
        left = max(b1 for _, b1 in spells(t, tilt - 120) if b1 <= s)
        if found and left <= found[-1][0]:
            continue
        grid, values = run.between(s, e)
        found.append((left, first(grid, np.min(values) + 5 - values, s)))
    return found


def rises(run, sure):
    """The running mean comes nearer to the high pole (before what the kinds above take), while something is lost."""
    found = [(s, min(e, run.loses)) for s, e in drifts(run, run.t, run.start, run.end, True, sure) if s < run.loses]
    if run.start < run.loses < run.end:  # is the mean that of the run, or of what comes before?
        t = run.t[run.t <= run.loses]
        before = drifts(run, t, run.start, run.loses, True, sure)
        return both(found, before) if sure else found + before
    return found


def both(some, others):
    """What some intervals have in common with others."""
    return [(max(s, b0), min(e, b1)) for s, e in some for b0, b1 in others if max(s, b0) < min(e, b1)]


def drifts(run, t, t0, t1, nearer, sure):
    """[(from, to)] where the running mean of a piece goes nearer to the high pole, or away from it, by 10 degrees."""
    if t1 - t0 <= 1 or len(t) < 2:
        return []
    mean, found = run.running(t, t0, t1), []
    way = np.abs(mean - run.high) * (-1 if nearer else 1)
    for i, k in legs(way, 5):
        far = way[k] - way[i]
        if far < (10 if sure else 9.9):
            continue
        last = np.max(np.nonzero(np.abs(way[i : k + 1] - way[i]) <= 2)[0]) + i
        begins = t[last] + 0.0
        if last < k and way[last + 1] != way[last]:
            begins += (t[last + 1] - t[last]) * min((way[i] + 2 - way[last]) / (way[last + 1] - way[last]), 1)
        ends = first(t[i : k + 1], way[i : k + 1] - (way[k] - 5), t[i])
        begins, ends = (t0 if begins - t0 <= 1 else begins), (t1 if t1 - t[k] <= 0.5 else ends)
        stays = [np.min(np.r_[way[(t >= e) & (t <= e + 1)], np.inf]) > way[k] - far / 2 for e in (ends, t[k])]
        if all(stays) if sure else any(stays):
            found.append((float(begins), float(ends)))
    return found


FACTS = {
    "flies": flies, "lies": lies, "stands-on-stem": stands_on_stem, "stands-upright": stands_upright,
    "stands-inverted": stands_inverted, "over": over, "falls": falls, "tips-back": tips_back, "rises": rises,
}  # fmt: skip
"""{kind: what finds it}, in the order of the definitions."""
