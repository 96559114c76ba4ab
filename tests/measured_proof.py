"""What the page finds of 200 films of the tests' own rigid bodies, one film a line of data/measured.jsonl.

Each film is fitted as rolling and as slipping: with the law that moved it, and a film that rolls with the page's own,
a real contact. Every fourth is one as a class brings it (HARD of measured_bodies.py); from one with wrong values those
are left out that are far off, as the page offers. A model that was given up is searched to its end as well.

`python tests/measured_proof.py [how many]` may be stopped at any time, and goes on where it stopped; it begins anew
where the fit is another one. 200 films take two hours of one core.
"""

import datetime
import functools
import json
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
from fingerprint import fingerprint
from measured_bodies import HARD, film, hard_film, how, off_truth, other_value

from app.model.measured.data import Data, roughness
from app.model.measured.fit import Problem, fit, fit_both, verdict
from app.model.measured.made import LAW
from app.model.measured.motion import model_of, residuals_of

ALL = [1000 + 77 * i % 200 for i in range(200)]
"""The seeds, fixed before any was looked at, so that the first of them have films of all kinds."""
FILE = Path(__file__).parent / "data" / "measured.jsonl"


@functools.cache
def stamp():
    """The hash of the fit as it is, with all that it goes through."""
    return fingerprint(fit, fit_both, verdict, model_of, residuals_of, roughness, Data)


def kept():
    """The lines that are there, of whichever fit; a line that was cut short when it was stopped is none."""
    rows = {}
    for line in FILE.read_text(encoding="utf-8").splitlines() if FILE.exists() else ():
        try:
            row = json.loads(line)
        except ValueError:
            continue
        rows[row["seed"]] = row
    return rows


def asked(seed):
    """One film: off: {number: standard errors off the truth}, of what the true model says it knows; unknown: {number:
    another value that fits as well, None where there is none}, not of HARD ones; said: the verdict, and anyway: that
    without giving up; seconds: of the processor, for both fits."""
    (kind, top, scales, truth), data = hard_film(seed, how(seed))
    models = model_of("rolling", top, scales), model_of(LAW if kind == "rolling" else kind, top, scales)
    begun = time.process_time()
    fits = fit_both(models, data)
    far = min(fits, key=lambda each: each.aic).far
    if how(seed) == "outliers" and far:
        data = data.without((name, data.series[name].t[i]) for name, at in far.items() for i in at)
        fits = fit_both(models, data)
    seconds = time.process_time() - begun
    found = fits[kind != "rolling"]
    anyway = [fit(each.model, data) if each.given_up else each for each in fits]
    unknown = {} if how(seed) else {name: other_value(found, data, name, truth) for name in found.unknown}
    off = {name: round(float(z), 4) for name, z in off_truth(found, truth)}
    return {"seed": seed, "kind": kind, "how": how(seed), "fit": stamp(), "date": str(datetime.date.today()),
            "off": off, "unknown": unknown, "refused": bool(found.refused), "sure": bool(found.sure),
            "said": verdict(*fits), "anyway": verdict(*anyway), "given_up": [each.model.name for each in fits
            if each.given_up], "seconds": round(seconds, 1)}  # fmt: skip


def go_on(seeds=ALL):
    """Asks of each seed that was not asked of this fit, and returns all their lines."""
    rows = {seed: row for seed, row in kept().items() if row["fit"] == stamp()}
    if not rows:
        FILE.unlink(missing_ok=True)
    for seed in seeds:
        if seed not in rows:
            rows[seed] = asked(seed)
            with FILE.open("a", encoding="utf-8", newline="\n") as file:
                file.write(json.dumps(rows[seed]) + "\n")
    return [rows[seed] for seed in seeds]


def share_within_two(rows):
    """(how many of the numbers that are said to be known have the truth within two standard errors, how many known)."""
    off = [abs(z) for row in rows for z in row["off"].values()]
    return sum(z < 2 for z in off) / len(off), len(off)


def by_slopes(seed):
    """{number: standard errors off the truth} by the slopes at the truth alone: where no fit can go wrong, so that what
    is seen is the noise that was drawn."""
    (kind, top, scales, truth), data = film(seed)
    problem = Problem(model_of(kind, top, scales).with_values(truth), data)
    x = np.array([truth[name] for name in problem.model.free])
    J, rest = problem.slopes(x), problem.residuals(x)
    inverse = np.linalg.inv(J.T @ J)
    return dict(zip(problem.model.free, -inverse @ J.T @ rest / np.sqrt(np.diag(inverse)), strict=True))


def age(rows):
    """How many rows are of today's fit, for the head of docs/validation.md."""
    old = sum(row["fit"] != stamp() for row in rows)
    return (f"**{old} of the {len(rows)} films were asked of a fit that has changed since.**" if old else
            f"All {len(rows)} films were asked of today’s fit.")  # fmt: skip


def lines(rows):
    """For docs/validation.md."""
    share, known = share_within_two(rows)
    plain = [row for row in rows if not row["how"]]
    slopes = {row["seed"]: by_slopes(row["seed"]) for row in plain}
    same = np.array([abs(slopes[row["seed"]][name]) for row in plain for name in row["off"]])
    unknown = [value for row in rows for value in row["unknown"].values()]
    others = sum(value is not None for value in unknown)
    yield (f"{len(rows)} of the {len(ALL)} films, whose seeds were fixed beforehand. Of {known} fitted numbers that "
           f"the fits call determined, {share:.1%} are within two standard errors of the true value (95.4 % are "
           f"expected, 92 to 98 % accepted); of {len(unknown)} that they call undetermined, {others} have another "
           "value that fits as well.")  # fmt: skip
    yield ""
    yield ("A linear estimate at the true values, without a fit, is within two of its errors for "
           f"{np.mean(same < 2):.1%} of the same numbers of the plain films. As far as the two shares agree, the "
           "difference from 95.4 % comes from the noise of these seeds, not from wrong errors.")  # fmt: skip
    yield ""
    yield "| film | films | known | within 2 errors | false verdicts | cannot tell | truth refused | s of one core |"
    yield "|---|---|---|---|---|---|---|---|"
    for name in ("", *HARD):
        if some := [row for row in rows if row["how"] == name]:
            yield f"| {name or 'plain'} | {' | '.join(_cells(some))} |"
    gave_up = [row for row in rows if row["given_up"]]
    unsure = sum(row["anyway"] == "unsure" != row["said"] for row in gave_up)
    yield ""
    yield (f"A model was given up of {len(gave_up)} films. A search to its end says something else of "
           f"{len(changed(rows))} of them, and of {unsure} only that it may not have found the best fit.")  # fmt: skip


def _cells(rows):
    share, known = share_within_two(rows)
    said = Counter("right" if row["said"] == right(row) else row["said"] for row in rows)
    seconds = [row["seconds"] for row in rows]
    cells = len(rows), known, f"{share:.1%}", len(false(rows)), said["either"] + said["unsure"]
    return [str(cell) for cell in (*cells, sum(row["refused"] for row in rows),
            f"{np.median(seconds):.0f} (at most {max(seconds):.0f})")]  # fmt: skip


def right(row):
    """The verdict that is true of it."""
    return "rolled" if row["kind"] == "rolling" else "slipped"


def changed(rows):
    """The films of which a search to the end says something else, and not only that it is unsure."""
    return [row["seed"] for row in rows if row["anyway"] not in (row["said"], "unsure")]


def false(rows):
    """The films that are said to roll and slipped, or the other way round."""
    return [row["seed"] for row in rows if row["said"] in {"rolled", "slipped"} - {right(row)}]


if __name__ == "__main__":
    print(*lines(go_on(ALL[: int(sys.argv[1]) if sys.argv[1:] else None])), sep="\n")
