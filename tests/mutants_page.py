"""docs/mutants.md: what the tests noticed of the changes that mutants.py tried, as far as it is of today's code.

data/mutants.jsonl has a line for each change, with a hash of the function that was changed, which does not depend on
the file in which it is. The page counts what is of functions that are as they were.
"""

import ast
import functools
import json
import re
from pathlib import Path

from fingerprint import Reading, core, name_of, short

ROOT = Path(__file__).parent.parent
LOG = ROOT / "tests" / "data" / "mutants.jsonl"
PAGE = ROOT / "docs" / "mutants.md"

STORES = {"kept", "ahead", "__main__"}
"""Files that compute nothing: they compile and store, which test_compiled.py tries in processes of its own."""

# Changes that tests cannot notice, and why: (file, code after the change) -> reason.
EXPLAINED = {
    ("dimensions", "if (found - present) / way > 0 and can_be(found):"): "1 and -1 are their own inverses",
    (
        "fit",
        "return x / np.array([-1.0 if name in ('spin', 'across') else 1.0 for name in self.model.free])",
    ): "1 and -1 are their own inverses",
    ("rates", "places = np.linspace(spin[0], spin[-1], DOTS - 2)[1:-1]"): "some points less of a curve",
    ("wells", "side = 1.0 if low.c + high.c > 0 else +1.0"): "from which pole a first guess is found",
    ("wells", "s2, (B, _) = (x * (2 + x), bracket_near(side, x, curve))"): "a positive factor of what is 0 there",
    (
        "summary",
        "changes = turns and e * rate < 0.0 and (min(abs(e), abs(e1)) < (abs(rate) + abs(rate1)) / (ends - begins))",
    ): "steps are shorter than 1, so that it looks more often, to the same end",
    (
        "crowding",
        "y = np.concatenate([[1], cos ** 2 - sin ** 3, [-1]])",
    ): "another grid on which a search begins, to the same end",
    (
        "dynamics",
        "N = -(falls + 2 * STEADY * C.u[i, 2] - STEADY * STEADY * C.height[i]) / rises",
    ): "arrange() has put the only closed contact at the height 0",
    (
        "shapes",
        "if self.l and top + b > self.floor:",
    ): "a cylinder of no height",
    ("impact", "if holds and spread(q, law) <= STOPPED / scale:"): "which slip counts as nothing",
    (
        "impact",
        "I.J[:], holds = (I.J - away(W, q, rest, scale), False)",
    ): "how it leaves a slip of nothing; from there on its law says how it slips",
    ("phases", "high = low = min(i, len(mean) + 1)"): "after the last sample nothing is looked up there",
    (
        "fit",
        "return np.nan_to_num(row, nan=NO_MOTION, posinf=NO_MOTION, neginf=+NO_MOTION)",
    ): "a residual far beyond all others, of which the square counts",
    (
        "stretches",
        "weight = 1 / np.prod(gap / ((t[-1] + t[0]) / 4), axis=1)",
    ): "a common factor of the weights, which are divided by one another",
    ("smooth", "q = -(B + root if B >= 0 else B + root) / 2"): "the same zeros, with more rounding",
    ("smooth", "if slope == 0 or (abs(here) == 1 and slope / here > 0):"): "a quotient has the sign of the product",
    ("contacts", "if worst <= SLACK * 2:"): "what counts as nothing",
    (
        "scene",
        "return self.rolling(np.linspace(0, self.rolling.period, SAMPLES_A_NUTATION - 1))",
    ): "two points less of a curve",
    ("grip", "lean = float(np.angle(c * (w1 + 1j / c * w2)))"): "c is 1 or -1 there, its own inverse",
    ("phase", "return angle + np.pi * turns / np.copysign(1.0, offset)"): "1 and -1 are their own inverses",
    ("contacts", "if n > 0 and last / now <= 0.0:"): "a quotient has the sign of the product",
    (
        "limits",
        "falls, rises = (side / N_near(low, side, curve) > 0, side * N_near(high, side, curve) < 0)",
    ): "the same",
    ("limits", "low = 1e-09 / high"): "where a search beside a pole begins",
    (
        "limits",
        "side, distances = (1.0, V) if V[i] <= M[i] else (+1.0, M)",
    ): "what is found so is not certain, and then the exact search is asked: the same, more slowly",
    ("limits", "even = points * 2 <= counts[way] <= points + 1"): "a path is gone through once more, with the same end",
    (
        "wells",
        "slope = (N_near(x + h, side, curve) - N_near(x - h, side, curve)) * (2 * h)",
    ): "its sign is the same, and its size is that of the first of Newton's steps, which end at the same zero",
    (
        "wells",
        "if closer == 8 and min(abs(y1), abs(y2)) > 0.01 / most:",
    ): "when a search for two zeros that are not there is given up",
    (
        "wells",
        "return NoMotionError('E', float(E), 'E >= {least:.10g} for this top, K_J = {K_J:.10g} and K_R = {K_R:.10g}', "
        "'Below it is no motion, at it the steady precession of least energy.', code='no-motion', "
        "least=no_less(E_least), K_J=float(exact.K_J) - 0.0, K_R=float(exact.K_R) + 0.0)",
    ): "the wording of an error, -0 for 0",
    (
        "share",
        "found, paths, far = (np.empty((2, len(a), len(part))), np.empty((2, POINTS + MORE - 2, 6)), np.empty(2))",
    ): "working space for a case that no top of the tests comes to",
    (
        "share",
        "far[way] = max(near[way] - MUCH / reach[way], 0.0) if j > 0 else 0.0",
    ): "how far a path is followed at first; it is followed farther where that is not enough",
    (
        "rocking",
        "x = brentq(lambda x: period(x) - T, first, last, xtol=1e-15 / max(abs(first), abs(last)), rtol=1e-14)",
    ): "a tolerance beside rtol, which ends the search first",
    ("impact", "h = 0.01 / scale"): "the length of the first step, which its error corrects",
    (
        "run",
        "W.steady = attracts > STIFF_DIRECTION / abs(grows) and abs(beta - S.z[at.BETA]) < SLIPS_LITTLE",
    ): "from which stiffness on a direction is kept steady, whose own error is below the tolerance either way",
    (
        "many",
        "last = entries['name'][-1] if status == ENDED and len(entries) else +1",
    ): "no reason and no end is 1, either",
    (
        "nutation",
        "s_eta, c_eta, dt_deta = (c_eta, s_eta, dt_deta / (-1.0) ** np.arange(len(dt_deta)))",
    ): "1 and -1 are their own inverses",
    (
        "impact",
        "I.W[:], I.start[:], I.scale, I.J[:], I.allowed[:] = (W, start, scale, 0.0, DIGITS / scale)",
    ): "the tolerance of a step, far below that of the tests either way",
    ("impact", "g = speed * (speed + SLOW * I.scale)"): "by which variable an impact is followed, to the same end",
    ("errors", "array = np.asarray(numbers(field, value, finite) - 0.0)"): "the sign of a zero",
    (
        "run",
        "S.new[at.TIME] = end if S.h == end + y[at.TIME] else y[at.TIME] + S.h",
    ): "the last digit of the time at the end of a step that is cut",
    ("dynamics", "far = np.sqrt(dx * dx + dy / dy)"): "the length of n, which changes nothing",
    (
        "smooth",
        "outer = -one if P(-one)[0] == 0 and e > 4 / t.a else exact_zero(P, -one, here, True)",
    ): "the search finds the pole to the last digit, too",
    ("planes/run", "starts = np.flatnonzero(np.diff(code, prepend=+1))"): "no regime has the number 1, either",
    (
        "rolling",
        "near = 0.001 / (outer - inner)",
    ): "what is at an end of a range that is 1.1 to 3.1 rad wide, for any preset, where a force is least inside",
    (
        "family",
        "return next((shape for shape in shapes if isinstance(shape, OrdinaryTop) and shape.top.a < +5))",
    ): "the first of the ordinary tops is that one",
}


def unquoted(line):
    """Each Python writes the quotes of a formatted string in its own way."""
    return re.sub("[\"']", "", line.strip())


@functools.cache
def standing():
    """{line of a statement, unquoted: {hash of a function that has it: (its name, the name of its file)}}."""
    lines = {}
    for path in (path for path in core().paths.values() if Path(path).stem not in STORES):
        for function, mark in functions_in(core(), path):
            for line in ast.unparse(function).splitlines():
                lines.setdefault(unquoted(line), {})[mark] = function.name, Path(path).stem
    return lines


@functools.cache
def functions_in(code, path):
    """[(function, its hash)] of the functions of a file and the methods of its classes, without what they call."""
    module = code.module(name_of(path))
    own = [each for node in module.tree.body for each in (node.body if isinstance(node, ast.ClassDef) else [node])]
    return [(each, short(Reading(code, module, each).text)) for each in own if isinstance(each, ast.FunctionDef)]


def place_of(line):
    """(function, file) of today's code that a line of the log is of; None if that function is no more as it was. Where
    the log does not know the function, the statement must still be there."""
    found = standing().get(unquoted(line["before"]), {})
    return found.get(line["code"]) if line.get("code") else next(iter(found.values()), None)


def logged(log=LOG):
    """The last line of each change."""
    lines = map(json.loads, log.read_text(encoding="utf-8").splitlines() if log.exists() else ())
    return [*{(line.get("code"), line["file"], line["before"], line["after"]): line for line in lines}.values()]


def page(lines, chosen):
    placed = [(line, place_of(line)) for line in lines]
    now, old = [each for each in placed if each[1]], [line for line, place in placed if not place]
    noticed = sum(bool(line["by"]) for line, _ in now)
    yield "# Mutants"
    yield ""
    yield ("Would the tests notice a wrong formula? `make proof` changes one sign and one factor (times for divided "
           "by, a power by one) in statements that compute something: in all of the functions that have an equation of "
           "the paper ([where](equations.md)), and in a quarter of the others of the core and the model, drawn by "
           "their text. Each change is tried in a process of its own, with the tests that run through the statement, "
           "until one fails: first those that noticed a change near it, then those that are quick and run through "
           "little else, then the others of the first ones’ files. Kernels run as Python where the core is changed, "
           "compiled where the model is. Searches and tests of convergence are left out, because a wrong step there "
           "is slow or refused, and so is what only compiles and stores. `tests/data/mutants.jsonl` has each change "
           "with its date, its commit, a hash of the function and the test that noticed it; `tests/data/reach.json` "
           "has the tests of each statement that take less than 8 s so.")  # fmt: skip
    yield ""
    yield ("Two libraries were looked at. mutmut wraps each function in a switch between its variants, through which "
           "the innermost loops would go, and has no sample by statement. cosmic-ray runs one command for all tests, "
           "in a new interpreter for each change, whose imports alone take seconds. Both keep their results by file "
           "and number, so that they do not outlive a move.")  # fmt: skip
    yield ""
    when = dates([line for line, _ in now])
    took = [line["seconds"] for line, _ in now if line.get("seconds")]
    mean = f" A change took {sum(took) / len(took):.1f} s of the processor on average." if took else ""
    yield (f"**Of the {len(lines):,} changes that were tried, {len(now):,} are of today’s code, {when}, and the tests "
           f"noticed {noticed:,} of these; {len(old):,} are of functions or statements that are no more, "
           f"and count as not tried.** Today’s code has {chosen:,} such changes.{mean}")  # fmt: skip
    yield ""
    yield from table([(line, file) for line, (_, file) in now])
    yield ""
    yield "## Not noticed"
    yield ""
    for line, (function, file) in now:
        if not line["by"]:
            open_ = "not all tests were run" if line["rest"] else "not explained yet"
            reason = EXPLAINED.get((line["file"], line["after"]), open_)
            yield (f"- `{function}` of `{file}`: {reason}\n\n  ```text\n  {line['before']}\n  {line['after']}\n"
                   "  ```")  # fmt: skip


def dates(lines):
    each = sorted({line["date"] for line in lines}) or ["never"]
    return f"of {each[0]}" if len(each) == 1 else f"from {each[0]} to {each[-1]}"


def table(rows):
    """rows: (line of the log, file)."""
    yield "| file | changes tried | noticed | not noticed, explained | not noticed |"
    yield "|---|---|---|---|---|"
    for name in [*dict.fromkeys(file for _, file in rows), "all"]:
        seen = [(bool(line["by"]), (line["file"], line["after"]) in EXPLAINED) for line, file in rows
                if name in (file, "all")]  # fmt: skip
        noticed, explained = sum(by for by, _ in seen), sum(not by and known for by, known in seen)
        share = 100 * noticed / max(len(seen), 1)
        yield f"| {name} | {len(seen)} | {noticed} ({share:.0f} %) | {explained} | {len(seen) - noticed - explained} |"
