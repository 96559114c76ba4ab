"""Cells of random maps against single runs of slide(), and against the tests' own body on contacts that yield.

A few in the suite; all in make proof. Cells next to a border, where a nudge of the start grows, are left out and
counted: there no run is certain.
"""

import numpy as np
import pytest
import stem_body
from references import kept

from app.model.maps.maps import LAWS, Map
from app.model.maps.solving import solve
from tippe_core import PRESETS, TopError, ending, slide

BODIES = [preset.name for preset in PRESETS if preset.shape.edge is not None and preset.top.a > 0]
SPANS = {"spin": (4, 40), "tilt": (2, 60), "mu": (0.05, 0.5), "second": (0.1, 1.0), "slip": (0.0, 1.5),
         "a": (0.05, 0.35), "ratio": (0.85, 1.3), "R": (8, 30), "stem": (14, 25), "rounding": (1, 6)}  # fmt: skip
FIXED = "spin", "tilt", "mu", "second", "slip"
NEAR = 100.0  # where a nudge grows more than this, a border is near
FEW, ALL, ALL_YIELDING = 30, 200, 60


def random_map(rng, laws=LAWS):
    """Any two of the ten quantities across and up, each over a part of what toys have."""
    body, law = str(rng.choice(BODIES)), str(rng.choice(laws))
    across, up = map(
        str, rng.choice([name for name in SPANS if name != "second" or law != "viscous"], 2, replace=False)
    )
    spans = [tuple(np.sort(rng.uniform(*SPANS[name], 2)).tolist()) for name in (across, up)]
    values = tuple((name, float(rng.uniform(*SPANS[name]))) for name in FIXED if name not in (across, up))
    return Map(body=body, law=law, across=across, up=up, across_range=spans[0], up_range=spans[1], values=values,
               cells=3, nudged=True, rtol=1e-9, seconds=float(rng.uniform(0.5, 4)))  # fmt: skip


def random_cell(rng, laws=LAWS):
    """(place, {column: its value}, end, Map) of one cell of such a map."""
    level = list(solve(random_map(rng, laws)))[-1]
    i, j = rng.integers(0, 3, 2)
    column = {name: float(values[i, j]) for name, values in level.columns.items()}
    return (float(level.x[j]), float(level.y[i])), column, str(level.end[i, j]), level.request


def single(cell, times):
    return slide(cell.top, cell.state, cell.friction, times, rtol=1e-9, edge=cell.edge)


def passes(cell, moved):
    """When theta first passes 90 degrees, in (R/g)^1/2, from a second run looked at closely there."""
    at = np.flatnonzero(np.diff(np.sign(moved.theta - np.pi / 2)))
    if not at.size:
        return np.nan
    close = np.linspace(*moved.t[at[0] : at[0] + 2], 2001)
    theta = single(cell, np.append(0.0, close)).theta[1:] - np.pi / 2
    k = np.flatnonzero(np.diff(np.sign(theta)))[0]
    return close[k] - theta[k] * (close[k + 1] - close[k]) / (theta[k + 1] - theta[k])


def refused(place, asked):
    """Whether slide() has no such run either."""
    try:
        cell = asked.at(*place)
        return ending(single(cell, np.linspace(0, cell.t_end, 6001))).end == "refused"
    except TopError:
        return True


@pytest.mark.slow
def test_random_cells_of_random_maps_are_single_runs(request):
    """The end equal; theta at the end, the times and the heat to 1e-6; energy never rises."""
    rng, left_out = np.random.default_rng(29), 0
    count = ALL if request.config.getoption("--remake") else FEW
    for _ in range(count):
        place, column, end, asked = random_cell(rng)
        if end == "refused":
            assert refused(place, asked)
            continue
        if not column["growth"] < NEAR:
            left_out += 1
            continue
        cell = asked.at(*place)
        moved, time = single(cell, np.linspace(0, cell.t_end, 6001)), cell.scales.time
        on_stem = [when for when, on in moved.supports if on in ("stem", "both")]
        assert end == ending(moved).end, asked
        assert column["time_90"] / time == pytest.approx(passes(cell, moved), abs=1e-6, nan_ok=True), asked
        if np.isnan(column["time_stem"]):
            assert not on_stem
        else:  # a knock that throws it up is only reported as lifting off
            assert min(abs(column["time_stem"] / time - when) for when, _ in moved.events) < 1e-6
            assert not on_stem or column["time_stem"] / time < on_stem[0] + 1e-6
        assert abs(column["energy_error"]) < 1e-6 and np.all(np.diff(moved.energy) < 1e-6)
        assert not abs(column["C_J_drift"]) > 1e-6  # nan where there is pivoting
        if not (moved.events and moved.events[-1][1] == "stands upright"):
            assert np.radians(column["theta_end"]) == pytest.approx(moved.theta[-1], abs=1e-6), asked
            assert column["heat"] == pytest.approx(moved.heat[-1], abs=1e-6), asked
    assert left_out <= count / 10


SOFT = 1e-4  # (gR)^1/2: the slip below which the body's dry friction is soft
ALIKE = NEAR * SOFT  # rad: what softness may have grown to where a nudge grows by less than NEAR
EARLY = (
    1e-3  # of a time: what ALIKE is where the tilt has come to 90 degrees or to the stem, at some 10 rad a unit of 1
)
OPENS = 2e-3  # (R/g)^1/2: the period 2 pi/k^1/2 in which the table gives way
CLEAR = ALIKE / 10  # rad: nearer to the limit of a word the body may say the one or the other
BRIEF, LONG = 0.002, 0.02  # shares of the last tenth: contacts that yield chatter for less; a hop takes more


@kept
def of_body(top, state, friction, t_end, edge):
    """Of the tests' own body on contacts that yield: theta at the end; when it first passes 90 degrees, and when its
    stem first touches; and of the last tenth the least and the largest theta, and the shares on ball, stem, neither."""
    times = np.linspace(0, t_end, 4001)
    moved = stem_body.integrate(top, state, friction, times, edge, k=1e7, damping=20.0, eps=SOFT)
    theta, since = moved.theta, 0.9 * t_end
    at = np.flatnonzero(np.diff(np.sign(theta - np.pi / 2)))[:1]
    share = (np.pi / 2 - theta[at]) / (theta[at + 1] - theta[at])
    time_90 = float((times[at] + share * (times[1] - times[0]))[0]) if at.size else np.nan
    time_stem = next((time for time, bits in moved.touching if bits & stem_body.STEM), np.nan)
    last = theta[times >= since]
    air, ball, stem, both = (moved.spent(bits, since) for bits in range(4))
    return theta[-1], time_90, time_stem, last.min(), last.max(), ball + both, stem + both, air


def word(least, most, ball, stem, air):
    """The end, as Many.end says it is judged; "" where the body cannot tell: at the limit of a word, or where a contact
    opens or closes for so short a time that it may be the table that gives way. Its friction never quite holds, so that
    what rolls moves."""
    shares = np.array([ball, stem, air])
    if ((BRIEF < shares) & (shares < LONG)).any():
        return ""
    on_ball, on_stem, flies = shares >= LONG
    if on_stem and not on_ball and not flies:
        return "stem"
    room = {"upright": 0.2 - most, "inverted": least - (np.pi - 0.2)} if on_ball and not (on_stem or flies) else {}
    for end, inside in (room | {"leaning": 0.05 - (most - least)}).items():
        if abs(inside) < CLEAR:
            return ""
        if inside > 0:
            return end
    return "moving"


def told(column, end, cell):
    """The word of the body, once its tilt and times are those of a cell, and its word the cell's if it has one."""
    theta, time_90, time_stem, *last = of_body(cell.top, cell.state, cell.friction, cell.t_end, cell.edge)
    assert np.radians(column["theta_end"]) == pytest.approx(theta, abs=ALIKE), cell
    assert column["time_90"] / cell.scales.time == pytest.approx(time_90, rel=EARLY, nan_ok=True), cell
    assert column["time_stem"] / cell.scales.time == pytest.approx(time_stem, rel=EARLY, abs=OPENS, nan_ok=True), cell
    says = word(*last)
    assert says in ("", "moving" if end == "rolling" else end), cell
    return says


@pytest.mark.slow
def test_random_cells_are_those_of_a_body_on_contacts_that_yield(request):
    """The end, where the body can tell; the tilt and the times to what its soft friction allows. That its contacts give
    way by 1e-7 is less."""
    rng, left_out, done, words = np.random.default_rng(30), 0, 0, []
    count = ALL_YIELDING if request.config.getoption("--remake") else FEW
    while done < count:
        place, column, end, asked = random_cell(rng, ("coulomb", "viscous", "smoothed"))
        if end == "refused" or asked.at(*place).friction.law.mu_s > asked.at(*place).friction.law.mu:
            continue  # the body has only one coefficient of dry friction
        done += 1
        if column["growth"] < NEAR:
            words.append(told(column, end, asked.at(*place)))
        else:
            left_out += 1
    assert left_out <= count / 10 and words.count("") <= count / 10
    assert {"upright", "leaning", "moving"} <= {*words}


TOY = {"across_range": (35.0, 50.0), "up_range": (5.0, 40.0), "seconds": 3.0}
TOP_S = {"body": "Top S", "across_range": (12.0, 18.0), "up_range": (5.0, 20.0), "seconds": 8.0}


@pytest.mark.slow
@pytest.mark.parametrize("end, law, how", [("stem", "smoothed", TOY), ("inverted", "viscous", TOP_S)])
def test_ends_that_few_random_cells_have_are_those_of_the_body_too(end, law, how):
    level = list(solve(Map(law=law, cells=3, nudged=True, rtol=1e-9, **how)))[-1]
    i, j = np.argwhere(level.columns["growth"] < 1)[0]
    cell = level.request.at(level.x[j], level.y[i])
    assert told({name: values[i, j] for name, values in level.columns.items()}, level.end[i, j], cell) == end
