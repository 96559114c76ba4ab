"""Errors have codes: each one is documented, and has words in every language that do not rely on the English ones."""

import ast
import inspect
import re
from dataclasses import replace
from pathlib import Path
from string import Formatter

import numpy as np
import pytest

import tippe_core
from app.model.build.dimensions import sentence
from app.text import CODES as OF_THE_PAGE
from app.text import DEFAULT, LANGUAGES, error_text, listed, speaking
from tippe_core import (
    Ball,
    BareSphere,
    Constants,
    Contensou,
    Coulomb,
    Lathe,
    LoadedSphere,
    NoMotionError,
    OrdinaryTop,
    Scales,
    State,
    Top,
    TopError,
    TruncatedSphere,
    Turned,
    a_from_rocking,
    ball,
    cylinder,
    dimension_from_rocking,
    f,
    frustum,
    load_top,
    rocking_period,
    save_top,
    slide,
    zone,
)
from tippe_core.errors import CODES

ROOT = Path(__file__).parent.parent
OTHERS = [language for language in LANGUAGES if language != DEFAULT]
PAPER = TruncatedSphere.paper()
# Parts of formulas in the allowed ranges that are not English: units, quantities, classes of the core.
NOTATION = {"rad", "kg", "mm", "mu", "mu_s", "mu_k", "eps", "gamma", "theta", "tilt", "seconds", "str", "bytes", "in",
            "high", "low", "rtol", "nudge", "pi", "well", "radius", "height", "rounding", "times"}  # fmt: skip


# ---- where they are raised ----


def words_of(node):
    """The text of a literal or an f-string, or of both branches of a conditional; «» stands for inserted values."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value]
    if isinstance(node, ast.JoinedStr):
        return ["".join(part.value if isinstance(part, ast.Constant) else "«»" for part in node.values)]
    return words_of(node.body) + words_of(node.orelse) if isinstance(node, ast.IfExp) else []


def raised():
    """(place, codes, value, allowed, remedy, numbers) of every TopError raised in the code, with lists of possible
    texts."""
    for path in sorted([*(ROOT / "tippe_core").rglob("*.py"), *(ROOT / "app").rglob("*.py")]):
        text = path.read_text(encoding="utf-8")
        if not re.search(r"\b(TopError|NoMotionError|in_range)\(", text):
            continue
        for function in ast.walk(ast.parse(text)):
            if not isinstance(function, ast.FunctionDef) or function.name == "replaced":
                continue
            for call in ast.walk(function):
                name = getattr(getattr(call, "func", None), "id", "")
                if name not in ("TopError", "NoMotionError", "in_range") or function.name == "in_range":
                    continue
                given = {each.arg: each.value for each in call.keywords}
                codes = words_of(given["code"]) if "code" in given else ["out-of-range"]
                if not codes:  # a variable set before
                    codes = [x.value for x in ast.walk(function) if isinstance(x, ast.Constant) and x.value in CODES]
                if name == "in_range":
                    allowed, remedy, numbers = words_of(given.get("why")), given.get("remedy"), {"range", "unit"}
                else:
                    allowed, remedy = words_of(call.args[2]), call.args[3] if len(call.args) > 3 else None
                    numbers = {*given} - {"code"}
                value = words_of(call.args[1])
                yield f"{path.name}:{call.lineno}", codes, value, allowed, remedy is not None, numbers


SITES = list(raised())


def is_english(words):
    bare = re.sub(r"\w+\([^)]*\)|\{[^}]*\}|\^\w+|\"\w+\"", "", words)
    return bool(set(re.findall(r"\b[a-z]{2,}\b", bare)) - NOTATION or re.search(r"\ban? [A-Z]", bare))


def test_every_code_is_documented_and_raised():
    assert len(SITES) > 80
    codes = {code for _, codes, *_ in SITES for code in codes}
    assert codes == {*CODES, *OF_THE_PAGE}
    assert all(re.fullmatch(r"[a-z]+(-[a-z]+)*", code, re.I) and means for code, means in CODES.items())
    assert not {*CODES} & {*OF_THE_PAGE}


@pytest.mark.parametrize("language", OTHERS)
def test_every_code_has_words(language):
    """The words have all the numbers that are available where the error is raised, and replace all of its English
    text."""
    said = listed("errors.codes", language)
    assert {*said} == {*CODES, *OF_THE_PAGE}
    wrong = []
    for place, codes, value, allowed, remedy, numbers in SITES:
        for code in codes:
            words = said[code]
            assert {*words} <= {"sentence", "allowed", "remedy"}
            wanted = {field for part in words.values() for _, field, *_ in Formatter().parse(part) if field}
            whole = "sentence" in words and "{allowed}" not in words["sentence"]
            english = [
                (not whole and "allowed" not in words and any(map(is_english, allowed)), "what is allowed"),
                ("remedy" not in words and remedy and code != "not-json", "what to do"),
                ("sentence" not in words and any(map(is_english, value)), "the value"),
                (wanted - {"name", "value", "allowed"} - numbers, "no such number"),
            ]
            wrong += [(place, code, what) for left, what in english if left]
    assert wrong == []


# ---- what is said ----

BAD = [
    ("out-of-range", lambda: Contensou(-1, 0.1)),
    ("out-of-range", lambda: Scales(R=-1, M=1)),
    ("out-of-range", lambda: cylinder(0.01, 0.02, 0.01)),
    ("not-finite", lambda: Coulomb("rough")),
    ("not-finite", lambda: Contensou(0.3, np.nan)),
    ("wrong-kind", lambda: load_top(3)),
    ("wrong-kind", lambda: f(1.0, None, None)),
    ("wrong-kind", lambda: Contensou(0.3, 0.1, pivots="yes")),
    ("wrong-count", lambda: Lathe(R=0.005, points=(), density=700.0)),
    ("wrong-count", lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, 0.01)), density=(700.0,))),
    ("not-whole", lambda: PAPER.profile(4)),
    ("not-whole", lambda: PAPER.stl(1)),
    ("falling", lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, -0.001)), density=700.0)),
    ("below-sliding", lambda: Coulomb(0.3, 0.2)),
    ("too-dense", lambda: Ball(R=0.01, M=1e9)),
    ("cut-misses", lambda: TruncatedSphere(R=0.016, c=0.5, l=0.0192, r=0.0032, M=0.0115)),
    ("stem-too-wide", lambda: TruncatedSphere(R=0.016, c=0.0082, l=0.0192, r=0.015, M=0.0115)),
    ("half-a-stem", lambda: TruncatedSphere(R=0.016, c=0.0082, l=0.0, r=0.0032, M=0.0115)),
    ("half-a-hole", lambda: replace(PAPER, hole=0.009)),
    ("hole-too-deep", lambda: replace(PAPER, hole=0.009, depth=0.03)),
    ("hole-too-wide", lambda: replace(PAPER, hole=0.014, depth=0.008)),
    ("half-a-disc", lambda: replace(PAPER, disc=0.004, thickness=0.003)),
    ("disc-sticks-out", lambda: replace(PAPER, disc=0.009, thickness=0.003, height=0.002)),
    ("lighter-than-its-disc", lambda: replace(PAPER, M=0.001, disc=0.004, thickness=0.003, height=0.002)),
    ("core-sticks-out", lambda: LoadedSphere(R=0.02, b=0.008, d=0.02, density=700.0, core_density=7800.0)),
    ("hangs-on-a-point", lambda: OrdinaryTop(R=0.003, h=0.01, r1=0.0, r2=0.02, t=0.005, r=0.0, l=0.0, M=0.02)),
    ("does-not-fit", lambda: BareSphere(R=0.02, M=0.02, a=0.9, I1=0.37, I3=0.4)),
    ("several-bodies", lambda: PAPER + 700 * ball(0.002, 0.05)),
    ("meets-in-a-point", lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.0, 0.01), (0.01, 0.02)), density=1.0)),
    ("more-taken-away", lambda: Ball(R=0.02, M=0.04) - 9000 * ball(0.01)),
    ("outside-sphere", lambda: zone(0.01, -0.02, 0.0)),
    ("no-peg", lambda: Turned(R=0.01, solid=700 * cylinder(0.01, -0.01, 0.01))),
    ("inside-unknown", lambda: BareSphere(R=0.02, M=0.02, a=0.3, I1=0.37, I3=0.4).stl()),
    ("does-not-rock", lambda: rocking_period(Top(-0.1, 0.4, 0.4))),
    ("none-rocks", lambda: dimension_from_rocking(lambda x: Ball(R=x, M=0.1), T=1.0, low=0.01, high=0.02)),
    ("too-fast", lambda: a_from_rocking(T=0.01, R=0.02, I1=0.4)),
    ("not-reached", lambda: dimension_from_rocking(loaded, T=90.0, low=0.002, high=0.01)),
    ("file-too-large", lambda: load_top("x" * 100_000)),
    ("not-json", lambda: load_top("no top at all")),
    ("not-json", lambda: load_top(b"\xff")),
    ("not-ours", lambda: load_top('{"schema": 1, "version": 1, "kind": 1, "dimensions": 1}')),
    ("no-object", lambda: load_top("[]")),
    ("unknown-field", lambda: load_top('{"colour": 1}')),
    ("missing-field", lambda: load_top('{"schema": 1}')),
    ("repeated-field", lambda: load_top('{"schema": 1, "schema": 1}')),
]


def loaded(d):
    return LoadedSphere(R=0.02, b=0.008, d=d, density=700.0, core_density=7800.0)


@pytest.mark.parametrize(("code", "make"), BAD, ids=[code for code, _ in BAD])
def test_an_error_has_its_code_and_is_told_in_every_language(code, make):
    with pytest.raises(TopError) as caught:
        make()
    error = caught.value
    assert error.code == code and error.name and error.allowed and str(error).startswith(f"{error.name} = ")
    assert error_text(error, DEFAULT) == str(error)
    for language in OTHERS:
        said = error_text(error, language)
        assert said.endswith(".") and not re.search(r"[{}]|\b(is|the|not|allowed|at|of|be|must)\b", said), said


# An argument of each name that public functions take.
BODY, START, LAW = Top.paper(), State(0.3, 0.0, 0.0, 9.0), Coulomb(0.3)
GIVEN = {
    "C_J": 3.0, "E": 27.0, "I1": 0.399, "I3": 0.408, "K_J": 7.0, "K_R": 10.0, "R": 0.02, "T": 1.0, "a": 0.07,
    "at": (0, 0, 1.0), "constants": Constants(7.0, 10.0, 27.0), "family": lambda d: loaded(d), "friction": LAW,
    "high": 0.012, "impulse": (0, 0, 0.1), "low": 0.002, "mu_s": 0.5, "nudge": 1e-6, "profile": PAPER.profile(64),
    "r": 0.01, "r_high": 0.01, "r_low": 0.01, "shape": PAPER, "spin": 9.0, "state": START, "t_end": 1.0,
    "text": save_top(PAPER), "theta": np.array([1.0]), "times": [0.0, 1.0], "top": BODY,
    **dict.fromkeys(("moved", "near", "trajectory"), slide(BODY, START, LAW, [0.0, 1.0])),
}  # fmt: skip


def arguments():
    """(function, argument) for each required argument of each public function."""
    for name in filter(lambda name: inspect.isfunction(getattr(tippe_core, name)), tippe_core.__all__):
        function = getattr(tippe_core, name)
        yield from ((function, each.name) for each in inspect.signature(function).parameters.values()
                    if each.default is each.empty and each.kind is not each.VAR_KEYWORD)  # fmt: skip


@pytest.mark.parametrize(("function", "name"), list(arguments()), ids=lambda each: getattr(each, "__name__", each))
def test_an_argument_of_another_kind_is_named(function, name):
    taken = {each: GIVEN[each] for other, each in arguments() if other is function}
    for wrong in (None, object(), {}):
        if wrong is None and (function, name) == (tippe_core.roll, "constants"):  # a State says them
            continue
        with pytest.raises(TopError) as caught:
            function(**taken | {name: wrong})
        assert caught.value.name == name and caught.value.allowed


def test_words_are_chosen_by_code_alone():
    """No word of the English text matters."""
    error = TopError("mu_s", 0.2, "μ_s ≥ 0.3", "!", code="below-sliding")
    assert (
        error_text(error, "de")
        == "mu_s = 0,2 ist nicht möglich: erlaubt ist μ_s ≥ 0,3. Die Haftreibung ist die größere."
    )
    error = NoMotionError("E", 1.0, "?", "!", code="no-motion", least=2.5, K_J=7.0, K_R=10.0)
    assert error_text(error, "de").startswith("E = 1 ist nicht möglich: erlaubt ist E >= 2,5 bei K_J = 7 und K_R = 10.")


def test_a_replaced_error_says_the_same_of_other_numbers():
    error = TopError("M", 2.0, "at most {most:g} {unit}", "Take {most:g}.", code="too-dense", most=1.5, unit="kg")
    other = error.replaced("m", 2000.0, most=1500.0, unit="g")
    assert str(other) == "m = 2000 is not possible: allowed is at most 1500 g. Take 1500."
    assert (other.code, other.numbers) == ("too-dense", {"most": 1500.0, "unit": "g"})
    assert str(error) == "M = 2 is not possible: allowed is at most 1.5 kg. Take 1.5."


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: frustum(-0.01, 0.01, 0.0, 0.01), "r_low = -10 mm ist nicht möglich: erlaubt ist r_low >= 0 (mm)."),
        (lambda: cylinder(0.01, 0.02, 0.01), "high = 10 mm ist nicht möglich: erlaubt ist high > low = 20 (mm)."),
        (lambda: Ball(R=0.01, M=1e9), "M = 1e+12 g ist nicht möglich: erlaubt ist höchstens "),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, -0.001)), density=1.0),
         "Punkt [1], Höhe = -1 mm ist nicht möglich: erlaubt ist 0 <= points[1] height <= "),
    ],
)  # fmt: skip
def test_an_error_is_told_in_the_units_of_the_sliders(make, said):
    with pytest.raises(TopError) as caught:
        make()
    with speaking("de"):
        assert sentence(caught.value).startswith(said)
