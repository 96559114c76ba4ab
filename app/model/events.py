"""What happens in a motion, and when: the beginnings of its phases, and the events of its contacts."""

from app.model.run import TableMotion

TOLD = ("over", "stands-on-stem", "stands-upright", "stands-inverted", "falls", "tips-back", "lies")
"""The phases whose beginnings are events."""
LEANS, AT_ONCE = 1.0, 0.05  # s: so long a lean is an event too; what is so near is one event


def happened(motion: TableMotion) -> tuple[tuple[float, str], ...]:
    """(t, code) of the events of a motion, in order: the beginnings of its phases, and those of its contacts."""
    pushes = [push.t for push, *_ in motion.pushes]
    cuts = {*motion.cuts.values(), *pushes}
    goes = {} if motion.start.top.a > 0 else {"over": "goes"}  # without a heavy side below, nothing turns over
    found = [(phase.start, goes.get(phase.kind, phase.kind)) for phase in motion.phases if phase.kind in TOLD]
    found += [(phase.start, "leans") for phase in motion.phases
              if phase.kind == "leans" and phase.end - phase.start > LEANS and phase.start not in cuts]  # fmt: skip
    found += [(phase.start, "flies") for phase in motion.phases if phase.kind == "flies"][:1]
    found += [(t, code) for code, t in motion.cuts.items()] + [(t, "push") for t in pushes]
    touch = motion.touches
    if touch is not None and all(abs(t - touch) > AT_ONCE for t, code in found if code == "stands-on-stem"):
        found.append((touch, "stem"))
    if motion.ended_at is not None:
        found.append((motion.ended_at, "flat" if motion.ended == "stands upright" else "ends"))
    return tuple(sorted(found))


def first_times(motion: TableMotion) -> dict[str, float]:
    """{code: the time (s) at which it first happened}."""
    found: dict[str, float] = {}
    for t, code in happened(motion):
        found.setdefault(code, t)
    return found
