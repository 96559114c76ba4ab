"""The errors that Measure states, compared with the scatter of many films that differ only in their noise; its
verdicts."""

from dataclasses import replace
from types import MappingProxyType, SimpleNamespace

import numpy as np
import pytest

from app.model.measured.data import Data, Series
from app.model.measured.fit import Fit, Problem, verdict
from app.model.measured.kept import Kept, kept
from app.model.measured.known import Known, _far, known
from app.model.measured.motion import Residuals, model_of
from app.model.measured.remembered import remembered
from app.model.measured.shown import shown
from app.tabs.measure.words import kept_words, models_table, numbers_table
from tippe_core import Constants, Scales, Top

TOP, SCALES = Top.paper(), Scales.paper()
START = {"tilt": 0.6, "tilt_rate": 0.2, "across": 0.5, "spin": 8.0}
TRUE = model_of("rolling", TOP, SCALES).with_values(START)
T = np.arange(60) / 120
NOISE = {"tilt": 0.02, "spin": 3.0, "azimuth": 0.02, "precession": 3.0}  # rad, rad/s
DRAWS = 60
CHANCE = 3 / np.sqrt(2 * DRAWS)  # of a standard deviation of so many


def filmed(quantities, rng=None, t=T, noise=NOISE):
    """What a film of the true motion sees; without rng exactly."""
    seen = TRUE.seen(t)
    return Data(MappingProxyType({
        name: Series(t, seen[name] + (rng.normal(0, noise[name], len(t)) if rng else 0), noise[name])
        for name in quantities}))  # fmt: skip


def fitted(data):
    """From the truth on, so that nothing but noise leads away."""
    problem = Problem(TRUE, data)
    _, x = problem.followed(np.array([TRUE.values[name] for name in TRUE.free]), 30, exactly=True)
    values = dict(zip(TRUE.free, map(float, x), strict=True))
    J = problem.slopes(x)
    said = {"values": values, "sides": dict.fromkeys(values, (1.0, 1.0)), "covariance": np.linalg.inv(J.T @ J),
            "unknown": (), "sure": True}  # fmt: skip
    return remembered(TRUE, data, said)


def test_the_errors_of_a_fit_and_of_its_constants_are_the_scatter_of_many():
    rng, off = np.random.default_rng(6), []
    truth = Constants.from_state(TOP, *START.values())
    for _ in range(DRAWS):
        found = fitted(filmed(("tilt", "spin"), rng))
        errors = dict(zip(TRUE.free, np.sqrt(np.diag(found.covariance)), strict=True))
        off.append([(found.model.values[name] - TRUE.values[name]) / errors[name] for name in TRUE.free]
                   + [(found.constants[name][0] - getattr(truth, name)) / found.constants[name][1]
                      for name in ("K_J", "K_R", "E")])  # fmt: skip
    spread = np.std(off, axis=0)
    assert np.all(abs(spread - 1) < CHANCE), spread
    scatter = np.corrcoef(np.array(off)[:, : len(TRUE.free)].T)
    assert np.abs(scatter - found.correlation).max() < 0.4


@pytest.mark.parametrize("way", [-1, 1])
@pytest.mark.parametrize("bend, close", [(0.0, 1e-9), (0.1, 0.05), (-0.1, 0.05)])
def test_a_valley_is_followed_to_where_chi_square_has_risen_by_4(way, bend, close):
    """Of one number x whose residual is x + bend x^2: to half of the x at which that is 2 or -2."""
    problem = SimpleNamespace(bounds=np.array([[-9.0], [9.0]]), residuals=lambda x: x + bend * x**2)
    found, _, better = _far(problem, np.zeros(1), 0.0, 0, way, np.ones(1), [])
    roots = np.roots([bend, 1.0, -2.0 * way])
    assert found == pytest.approx(np.abs(roots).min() / 2, rel=close) and better is None


@pytest.mark.parametrize(("value", "error", "bounds", "tells"), [
    (1.0, 0.45, (0, 9), True), (1.0, 0.55, (0, 9), False), (1.0, 0.7, (-9, 9), True), (1.0, 2.0, (-9, 9), False),
    (1.8, 0.09, (0, 2), True), (1.8, 0.11, (0, 2), False),
])  # fmt: skip
def test_a_number_is_known_to_half_of_it_and_where_95_of_100_lie_within_its_bounds(value, error, bounds, tells):
    """Of one that may be of either sign, to a tenth of its range; two standard errors hold 95 of 100."""
    one = np.array([error])
    found = Known(one[:, None] ** 2, one, one, np.array([False]))
    assert found.tells(np.array([value]), np.array(bounds, float)[:, None]).tolist() == [tells]


def test_what_is_known_is_the_same_where_chi_square_is_a_parabola():
    data = filmed(("tilt", "spin"), np.random.default_rng(11))
    found = fitted(data)
    x = np.array([found.model.values[name] for name in TRUE.free])
    said, errors = known(Problem(TRUE, data), x), np.sqrt(np.diag(found.covariance))
    np.testing.assert_allclose(np.sqrt(np.diag(said.covariance)), errors, rtol=1e-3)
    for side in (said.below, said.above):
        np.testing.assert_allclose(side, errors, rtol=0.15)


@pytest.mark.parametrize("noisy", ["tilt", "spin", "precession", "azimuth"])
def test_the_errors_of_the_constants_from_the_data_are_their_scatter(noisy):
    """Of each measured quantity alone: the others are exact, but for a billionth."""
    rng, turn = np.random.default_rng(7), "precession" if noisy == "precession" else "azimuth"
    noise = {name: size if name == noisy else 1e-9 for name, size in NOISE.items()}
    draws = [kept(filmed(("tilt", "spin", turn), rng, noise=noise), TOP, SCALES) for _ in range(DRAWS)]
    for name in draws[0]:
        values, errors = (np.array([getattr(found[name], what) for found in draws]) for what in ("values", "errors"))
        scatter, said = values.std(axis=0).mean(), errors.mean()
        if name == "K_J" and turn == "azimuth":  # nutation between two frames is an error too
            assert scatter < 1.2 * said, (name, scatter / said)
        elif noisy in ("tilt", "spin") or name == "K_J":
            assert scatter == pytest.approx(said, rel=0.15), name


@pytest.mark.parametrize("noisy", ["tilt", "spin", "azimuth"])
def test_without_nutation_the_error_of_K_J_by_an_azimuth_is_its_scatter(noisy):
    """Of a top that precesses steadily, s w2 = s^2 phi_dot."""
    rng, unit = np.random.default_rng(12), SCALES.angular_velocity
    theta, spin, turn = 0.9, 8.0, 2.5  # in (g/R)^1/2
    exact = {"tilt": theta + 0 * T, "spin": spin * unit + 0 * T, "azimuth": turn * unit * T}
    found = []
    for _ in range(2 * DRAWS):
        sizes = {name: NOISE[name] * (0.01 if name == noisy else 1e-9) for name in exact}
        rows = {name: Series(T, row + rng.normal(0, sizes[name], len(T)), sizes[name]) for name, row in exact.items()}
        found.append(kept(Data(MappingProxyType(rows)), TOP, SCALES)["K_J"])
    values, errors = (np.array([getattr(one, what) for one in found]) for what in ("values", "errors"))
    true = np.sin(theta) ** 2 * turn + TOP.I3 / TOP.I1 * (np.cos(theta) - TOP.a) * spin
    assert values.mean() == pytest.approx(true, rel=1e-4)
    assert values.std(axis=0).mean() == pytest.approx(errors.mean(), rel=0.15)


@pytest.mark.parametrize("fps", [60, 120])
def test_what_nutates_between_two_frames_is_an_error_of_K_J_by_an_azimuth(fps):
    rng, t = np.random.default_rng(3), np.arange(150) / fps
    noise = {name: 1e-3 * size for name, size in NOISE.items()}
    found = kept(filmed(("tilt", "spin", "azimuth"), rng, t=t, noise=noise), TOP, SCALES)["K_J"]
    off = (found.values - Constants.from_state(TOP, *START.values()).K_J) / found.errors
    assert np.sqrt(np.mean(off**2)) < 2


def test_the_mean_of_a_constant_has_the_error_of_a_mean():
    rng, noise = np.random.default_rng(8), NOISE | {"tilt": 1e-9}
    found = [kept(filmed(("tilt", "spin"), rng, noise=noise), TOP, SCALES)["K_R"] for _ in range(DRAWS)]
    off = np.array([one.mean for one in found])
    assert off[:, 0].std() == pytest.approx(off[:, 1].mean(), rel=CHANCE)


# ---- what follows from them ----


def alike(quality, others=()):
    """A Fit of the true model whose residuals are noise, of which so much is left; others: free numbers more."""
    data = filmed(("tilt", "spin"))
    row = np.random.default_rng(9).normal(0, 1, len(T)) * np.sqrt(quality)
    model = replace(TRUE, free=(*TRUE.free, *others))
    size = len(model.free)
    residuals = Residuals({"tilt": row}, dict(data.series))
    return Fit(model, dict.fromkeys(model.free, (0.1, 0.1)), np.eye(size), residuals, 0,
               {"tilt": 0.0}, (), True)  # fmt: skip


def test_of_two_that_fit_the_better_is_said_where_it_is_clearly_better():
    good, worse = alike(0.7), alike(0.95)
    assert not good.refused and not worse.refused and worse.chi2 - good.chi2 > 6
    assert (verdict(good, worse), verdict(worse, good)) == ("rolled", "slipped")
    assert verdict(good, good) == "either"
    # one more fitted number must reduce chi-square by 2 (Akaike)
    assert alike(0.7, ("mu",)).aic - good.aic == pytest.approx(2) and alike(0.7, ("mu",)).freedom == good.freedom - 1
    # and so must a number of the camera's position
    assert replace(good, hidden=1).aic - good.aic == pytest.approx(2)
    assert replace(good, hidden=1).freedom == good.freedom - 1


@pytest.mark.parametrize(("r", "says"), [(0.99, "larger if the other is,"), (-0.99, "larger if the other is smaller")])
def test_numbers_that_move_together_are_said_to_go_the_same_way_or_the_other(r, says):
    covariance = np.diag([1.0, 1.0, 1.0, 4.0])
    covariance[0, 3] = covariance[3, 0] = 2 * r
    found = replace(alike(0.7), covariance=covariance, unknown=("spin",))
    assert found.together == (("tilt", "spin", pytest.approx(r)),)
    assert says in numbers_table(found)


def test_the_numbers_of_a_model_that_does_not_fit_are_said_to_be_worth_nothing():
    assert "say nothing of the top" in numbers_table(alike(3.0)) and alike(3.0).refused
    assert "say nothing of the top" not in numbers_table(alike(0.9))


def test_a_search_that_ended_at_different_places_is_said_of_a_fit_that_fits():
    found = replace(alike(0.95), sure=False)
    assert "there may be a better fit" in numbers_table(found)
    assert "perhaps not the best fit" in models_table(found, alike(0.7))
    assert "there may be a better fit" not in numbers_table(alike(0.95))


@pytest.mark.parametrize("shares", [("K_R",), ("K_R", "K_J")])
def test_constants_that_went_do_not_say_that_the_top_slipped(shares):
    """A top that rolls in air loses both, too."""
    t = np.arange(100.0)
    went = {name: Kept(t, 5 - t / 20, np.full(100, 0.1)) for name in shares}
    assert "air drag" in kept_words(went) and "So it slipped" not in kept_words(went)


def test_curves_are_where_the_film_saw_them_and_the_axis_where_its_tip_was():
    """An azimuth counted from elsewhere; the height of the tip on the ball is R + tip cos theta."""
    data = filmed(("tilt", "azimuth"))
    turned = dict(data.series)
    turned["azimuth"] = replace(turned["azimuth"], values=turned["azimuth"].values + 2.0)
    found = shown(TRUE, Data(MappingProxyType(turned)))
    t, curve = found.curves["azimuth"]
    np.testing.assert_allclose(np.interp(T, t, curve), turned["azimuth"].values, atol=1e-6)
    model = TRUE.with_stem(None, 1.8)
    heights = SCALES.R * (1 + 1.8 * np.cos(TRUE.seen(T)["tilt"]))
    found = shown(model, Data(MappingProxyType({"tip": Series(T, heights, 1e-4)})))
    np.testing.assert_allclose(found.axis[:, 3], np.cos(np.interp(T, found.t, found.motion.theta)), atol=2e-3)
