"""The sentences that are told of a run, held against its samples. Nothing of the app is imported.

A claim is a pattern of English and a test of what it says: of the phase that it stands in, or, in a caption and in what
is said of a whole table, of the run.
"""

import re

import numpy as np
from story_phases import facts
from story_said import differs, energy, joined, number
from story_samples import comings_back

N = r"((?<![\d.])[-−]?\d+(?:\.\d+)?)"
ROUND = "turns? a second"
STANDS = "stands-on-stem", "stands-inverted", "stands-upright"
CLAIMS = []
"""[(pattern, test)]."""


def claims(pattern):
    """Of a test: what is said, and the match of the pattern -> why it is false, or nothing."""
    return lambda test: CLAIMS.append((re.compile(pattern, re.IGNORECASE), test)) or test


def faults(said):
    """[(the pattern, the text, why it is false)]."""
    bad = []
    for pattern, test in CLAIMS:
        for match in pattern.finditer(said.text):
            if why := test(said, match):
                bad.append((f"words: {test.__name__}", f"{said.text!r} of {said.phase}: {why}"))
    return bad


MINUS_ZERO = r"(?<![\d.])[-−]0(?:\.0*)?(?!\.?\d)"


def minus_zero_in(text):
    """Is there a minus zero in a text?"""
    return re.search(MINUS_ZERO, text)


@claims(MINUS_ZERO)
def minus_zero(said, match):
    return "a minus zero"


@claims(r"\bfor ?ever\b")
def forever(said, match):
    run, phase = said.run, said.phase
    if run.ended or phase.t1 < run.end - run.slack:
        return f"it ended early or something else comes: {run.ended!r}"
    inside = run.inside(phase.t0, phase.t1)
    if np.all(run.support[inside] == "ball"):
        energy = run.kinetic[inside] - run.a * np.cos(np.radians(run.tilt[inside]))
        if np.ptp(energy) > 0.02 * max(np.max(run.kinetic[inside]), 1e-3):
            return f"its energy changes by {np.ptp(energy):.3g} of {np.max(run.kinetic[inside]):.3g} MgR in this time"
    return None


@claims(rf"between {N}° and {N}°(?! on (?:the rough|ice))")
def between(said, match):
    least, most = said.tilts(whole="forever" in said.text)
    return joined(differs(match[1], least), differs(match[2], most))


@claims(rf"goes from {N}° to {N}°, between {N}° and {N}°")
def from_to_between(said, match):
    first, last, least, most = (float(number.replace("\N{MINUS SIGN}", "-")) for number in match.groups())
    return None if least <= min(first, last) and max(first, last) <= most else "two numbers that contradict each other"


@claims(rf"between {N}° and {N}° on (?:the )?(rough|ice)")
def between_on(said, match):
    whole = said.of(match[3].lower())
    if whole is None:
        return None
    least, most = whole.tilts()
    return joined(differs(match[1], least), differs(match[2], most))


@claims(rf"tilt goes from {N}° to {N}°(?:.{{1,9}} {N}° at most)?")
def from_to(said, match):
    ends = (
        differs(match[1], said.at(said.run.tilt, said.phase.t0)),
        differs(match[2], said.at(said.run.tilt, said.phase.t1)),
    )
    return joined(*ends, match[3] and differs(match[3], said.tilts()[1]))


@claims(rf"(?:stays at|rolls round, tilted by|rests at|lies at) {N}°")
def stays_at(said, match):
    least, most = said.tilts(whole="forever" in said.text)
    return joined(differs(match[1], (least[1], least[1])), differs(match[1], (most[0], most[0])))


@claims(r"near the tilt at which it started")
def near_start(said, match):
    for name, run in said.others.items():
        if name != "ordinary" and (far := np.max(np.abs(run.tilt - run.tilt[0]))) > 15:
            return f"on {name} it comes {far:.0f} degrees away"
    return None


KINDS = {
    "turns over": ("over",), "stands": STANDS, "falls": ("falls",), "tips back": ("tips-back",),
    "begins to rise": ("rises",), "comes to lean": ("leans",), "begins to sink": ("sinks",),
    "begins to sway": ("swings",), "only nods": ("nods",), "comes to rest": ("lies",), "leaves the table": ("flies",),
}  # fmt: skip


@claims(rf"at {N} s (?:too little is left, and )?it ({'|'.join(KINDS)})(?! flat)")
def at_time(said, match):
    kinds = KINDS[match[2].lower()]
    starts = [one.t0 for one in said.run.phases if one.kind in kinds]
    if said.run.ended and match[2] == "leaves the table":
        starts.append(said.run.end)
    if any(not differs(match[1], (since - said.run.slack, since + said.run.slack)) for since in starts):
        return None
    return f"it does so at {starts or 'no time'}"


@claims(rf"\b(?:at|until|after|up to) {N} s\b")
def time_of_run(said, match):
    return differs(match[1], (said.run.start, said.run.end + 0.02))


@claims(rf"at {N} s its tilt is {N}°")
def tilt_at(said, match):
    time, half = number(match[1])
    spans = [said.at(said.run.tilt, min(at, said.run.end)) for at in (time - half, time, time + half)]
    return differs(match[2], (min(low for low, _ in spans), max(high for _, high in spans)))


@claims(rf"computed only up to {N} s")
def up_to(said, match):
    return differs(match[1], (said.run.end - 0.05, said.run.end + 0.05))


@claims(rf"at {N} s it still spins, {N} {ROUND}")
def still_spins(said, match):
    return differs(match[2], said.spin(number(match[1])[0]))


@claims(rf"spin, from {N} to {N} {ROUND}")
def spin_from_to(said, match):
    return joined(differs(match[1], said.spin(said.phase.t0)), differs(match[2], said.spin(said.phase.t1)))


@claims(rf"Only {N} {ROUND} are left|too little is left")
def left(said, match):
    falls = [one.t0 for one in said.run.phases if one.kind == "falls" and one.t0 >= said.phase.t0]
    then = said.spin(min(falls, default=said.phase.t1))
    if np.abs(said.run.spin[0]) < 1.02 * then[0]:
        return f"it had no more at the start: {np.abs(said.run.spin[0]):.3g}"
    return differs(match[1], then) if match[1] else None


@claims(r"uses up (?:the|its) spin")
def uses_up(said, match):
    return None if said.spin(said.phase.t1)[0] < said.spin(said.phase.t0)[1] else "the spin grows"


@claims(rf"{N} {ROUND} holds? it(?: there)?(?:; it needs about {N})?")
def holds(said, match):
    run, phase = said.run, said.phase
    if phase.kind not in STANDS:
        return "it does not stand"
    if (run.a < 0) != (phase.kind == "stands-upright"):
        return "what stands with its weight low is not held by spin"
    if match[2] and number(match[2])[0] > number(match[1])[0]:
        return "it needs more"
    return differs(match[1], said.spins())


@claims(rf"low weight holds it upright(?:; above {N} {ROUND})?")
def low_weight(said, match):
    if said.run.a <= 0 or said.phase.kind != "stands-upright":
        return "its weight is not low, or it is not upright"
    return "it spins faster" if match[1] and number(match[1])[0] < said.spins()[1] - 0.5 else None


@claims(rf"stable only below {N} {ROUND}. It spins at {N}")
def stable_below(said, match):
    if said.run.a <= 0:
        return "spin holds it up"
    return joined(
        number(match[2])[0] < number(match[1])[0] and "it spins more slowly",
        differs(match[2], said.spins()),
    )


@claims(rf"With {N} {ROUND} it cannot stay (?:up|there)(?:[^.]*? need about {N})?")
def cannot_stay(said, match):
    spin = differs(match[1], said.spin(said.phase.t0))
    return joined(spin, match[2] and number(match[2])[0] < number(match[1])[0] and "it needs less")


@claims(r"(?:has none\b|no spin\b|without (?:a )?spin\b)")
def no_spin(said, match):
    return None if np.abs(said.run.spin[0]) < 1 or said.spin(said.phase.t0)[0] < 1 else "it spins"


@claims(r"Rubbing set it upright")
def set_upright(said, match):
    before = said.run.tilt[said.run.t <= said.phase.t0]
    return None if np.max(before, initial=0) > 5.5 else "it was upright from the start"


@claims(r"It started that way")
def started(said, match):
    return None if said.phase.t0 <= said.run.start + said.run.slack else "this begins later"


@claims(r"Rubbing against the table turned it over")
def turned(said, match):
    return None if any(since <= said.phase.t0 for since, _ in said.over()) else "it did not turn over before"


@claims(r"heavy side (goes up|comes down)")
def heavy_side(said, match):
    if said.run.a == 0:
        return "it has no heavy side"
    (before, _), (after, _) = (said.at(said.run.tilt, at) for at in (said.phase.t0, said.phase.t1))
    up = said.run.a * (after - before) > 0
    return None if up == (match[1].lower() == "goes up") else "it moves the other way"


@claims(r"heavy side")
def has_heavy_side(said, match):
    return "it has none" if said.run.a == 0 else None


@claims(r"\b(?:stem|rim)s?\b")
def has_stem(said, match):
    return "this body has none" if said.stemless else None


@claims(r"keeps its spin")
def keeps_spin(said, match):
    spin = said.run.spin
    return None if np.ptp(spin) <= 1e-3 * max(np.max(np.abs(spin)), 1) else f"it changes by {np.ptp(spin):.3g}"


@claims(r"[Bb]oth keep (?:the|its) energy|after that both keep it")
def both_keep(said, match):
    after = match[0].startswith("after")
    given = energy(said.others["ordinary"])[:1] if "ordinary" in said.others and not after else []
    for name in said.others.keys() & {"rough", "ice"}:
        values = np.r_[given, energy(said.others[name])]
        if len(values) and np.ptp(values) > 5e-3 * np.max(np.abs(values)):
            return f"on {name} it changes by {np.ptp(values):.3g} of {np.max(np.abs(values)):.3g} MgR"
    return None


@claims(r"(?:does not turn|never turns|(?<!Only )nothing can turn it|cannot turn) ?over")
def never_over(said, match):
    return f"it turns over: {said.over(True)}" if said.over(True) else None


@claims(r"Only rubbing turns it over")
def only_rubbing(said, match):
    if "ordinary" in said.others and not facts(said.others["ordinary"], "over", False):
        return "it does not turn over on the ordinary table"
    also = [name for name in ("rough", "ice") if name in said.others and facts(said.others[name], "over", True)]
    return f"it turns over on {also}" if also else None


@claims(r"(?:^|(?<=\. ))It (turns over|stands on its|lies still|falls|tips back|stands upright|leaves the table)\b")
def headline(said, match):
    kinds = {"stands on its": ("stands-on-stem",), "stands upright": ("stands-upright",), "lies still": ("lies",)}
    right = kinds.get(match[1].lower()) or KINDS[match[1].lower()]
    kind = said.phase.kind
    return None if kind in right or not kind else f"the phase is {kind}"


@claims(r"turned over|given time|will turn over")
def turned_over(said, match):
    return None if said.over() else "it does not turn over"


@claims(r"back and forth|to and fro|\bsways?\b")
def sways(said, match):
    if "begins to sway" in said.text:
        return None
    tilt = said.run.between(said.phase.t0, said.run.end if "forever" in said.text else said.phase.t1)[1]
    least = min(5.0, 0.3 * np.ptp(tilt))
    return None if comings_back(tilt, max(least, 1e-3))[1] >= 2 else "it does not come back twice"


@claims(r"Nothing (?:rubs|slides)")
def rolls(said, match):
    if said.whole and said.others:  # of the rough table
        said = said.of("rough")
        if said is None:
            return None
    inside = said.run.inside(said.phase.t0 + said.run.slack, said.phase.t1 - said.run.slack)
    return None if np.all(said.run.regime[inside] == "roll") else "it does not roll all the time"


@claims(rf"For {N} s nothing carries it")
def carried(said, match):
    return differs(match[1], (said.phase.t1 - said.phase.t0,) * 2)


@claims(r"motion is used up|is at rest\b")
def used_up(said, match):
    rest = facts(said.run, "lies", False)
    return None if rest and rest[0][0] <= said.phase.t1 else "it still moves later"


@claims(r"spins on\b|and spins\b")
def spins_on(said, match):
    return None if said.spins()[1] > 0.1 else "it does not spin"


@claims(rf"was {N} mm above the table and comes to {N} mm")
def rises_by(said, match):
    before, after = (number(match[i])[0] for i in (1, 2))
    return None if after > before else "it does not rise"


@claims(rf"Of its energy at the start, {N} mm of height, {N} mm are left")
def energy_left(said, match):
    run = said.run
    inside = run.inside(run.start, said.phase.t1)
    if not np.all(run.support[inside] == "ball"):
        return None
    first, last = (run.kinetic + 1 - run.a * np.cos(np.radians(run.tilt)))[inside][[0, -1]]
    (start, half), (rest, _) = number(match[1]), number(match[2])
    wrong = abs(rest - start * last / first) > half * 2 + 0.01 * start
    return f"it is {last / first:.3f} of it" if wrong else None


@claims(rf"within {N}° on (?:the )?(rough|ice)")
def stays_within(said, match):
    tilt = said.others[match[2]].tilt
    least, half = number(match[1])
    most = np.abs(tilt - tilt[0]).max()
    return f"it goes {most:.3g}° away" if most > least + half else None


@claims(rf"(?<!by )(?<!within ){N}°")
def in_range(said, match):
    low, high = np.min(said.run.tilt), np.max(said.run.tilt)
    for run in said.others.values():
        low, high = min(low, np.min(run.tilt)), max(high, np.max(run.tilt))
    return differs(match[1], (low, high))


@claims(rf"(?<!above )(?<!below )(?<!about )(?<!least ){N} {ROUND}")
def spin_in_range(said, match):
    return differs(match[1], (np.min(np.abs(said.run.spin)), np.max(np.abs(said.run.spin))))
