"""What Measure says of units, of a missed turn, of a drift, and of the files that it saves."""

from dataclasses import replace
from types import MappingProxyType

import numpy as np
import pytest
from test_measured_errors import SCALES, TOP, TRUE, T, alike, filmed, fitted

from app.model.measured import fit as fits
from app.model.measured.data import Data, Series, settled
from app.model.measured.film import Film, opened, written
from app.model.measured.kept import Kept, kept
from app.model.measured.motion import START, model_of, residuals_of, shifted
from app.model.measured.report import program, residuals_table
from app.model.measured.shown import shown
from app.model.measured.table import MeasuredError, read
from app.model.measured.work import models
from tippe_core import TruncatedSphere


def table(head, *columns):
    rows = zip((i / 60 for i in range(len(columns[0]))), *columns, strict=True)
    return "\n".join([f"t (s);{head}", *(";".join(f"{x:.4f}" for x in row) for row in rows)])


@pytest.mark.parametrize(
    ("head", "one"),
    {"spin (rpm)": 2 * np.pi / 60, "spin (rev/s)": 2 * np.pi, "spin (deg/s)": np.pi / 180, "spin (rad/s)": 1.0,
     "tilt (deg)": np.pi / 180, "tip height (cm)": 0.01, "height (mm)": 1e-3}.items(),
)  # fmt: skip
def test_a_unit_has_its_size(head, one):
    values = 20.0 + np.arange(12)
    (series,) = settled(read(table(head, values))).series.values()
    np.testing.assert_allclose(series.values, one * values, rtol=1e-12)


def test_an_azimuth_that_begins_anew_goes_on():
    turning = 20.0 * np.arange(40)
    seen = settled(read(table("azimuth (deg)", turning % 360))).series["azimuth"].values
    np.testing.assert_allclose(np.degrees(seen), turning, atol=1e-3)


def test_half_a_track_is_said():
    with pytest.raises(MeasuredError, match="half-a-track"):
        settled(read(table("x (mm)", np.arange(12.0))))
    assert set(settled(read(table("x (mm);y (mm)", np.arange(12.0), np.arange(12.0)))).series) == {"x", "y"}


def test_where_an_azimuth_may_have_missed_a_turn_there_is_no_constant():
    """The same motion, every frame of which is seen, and every sixth: between two it turns by more than 1 rad."""
    rng, t = np.random.default_rng(4), np.arange(240) / 480
    often = filmed(("tilt", "spin", "azimuth"), rng, t=t)
    phi = often.series["azimuth"].values
    assert "K_J" in kept(often, TOP, SCALES)
    seldom = {name: Series(each.t, each.values, each.error) for name, each in often.series.items()}
    seldom["azimuth"] = replace(seldom["azimuth"], values=phi * 1.5 / np.abs(np.diff(phi)).min())
    assert "K_J" not in kept(Data(MappingProxyType(seldom)), TOP, SCALES)


def test_a_slow_drift_is_none_that_stays():
    """Each value alone agrees with their mean; the means of the first and of the last fifth do not agree."""
    noise = np.random.default_rng(5).normal(size=200)
    steady = noise * np.sqrt(0.9 / np.mean(noise**2))
    still, drifts = (
        Kept(np.arange(200.0), steady + drift, np.ones(200)) for drift in (0.0, np.linspace(-0.7, 0.7, 200))
    )
    assert still.stayed and not drifts.stayed
    left = drifts.values - drifts.mean[0]
    assert left @ left < 200 + 2 * np.sqrt(400)


def test_residuals_that_keep_their_sign_for_too_long_refuse_a_model():
    good = alike(0.7)
    assert (
        not good.refused
        and replace(good, runs={"tilt": -6.0}).refused
        and not replace(good, runs={"tilt": 6.0}).refused
    )


def test_where_a_film_looks_from_costs_numbers():
    """An azimuth one, where it is counted from; a track three: its place and its direction; from the side two."""
    for names, count in (("tilt", 0), ("azimuth", 1), ("x y", 3), ("azimuth tip_x tip_y", 4), ("tip tip_side", 2)):
        data = Data(MappingProxyType({name: Series(T, T, 0.1) for name in names.split()}))
        assert shifted(data) == count


def test_rolling_takes_of_what_is_loose_the_body_alone():
    rolling, sliding = models(TOP, SCALES, None, "viscous", ("a", "I1", "air_drag", "tilt_rate"))
    assert rolling.free == ("tilt", "tilt_rate", "across", "spin", "a", "I1")
    assert sliding.free == ("tilt", "spin", "gamma", "a", "I1", "air_drag", "tilt_rate")


def test_a_measured_axis_leans_where_the_film_saw_it():
    """However the azimuth is counted there: beside the motion's own."""
    data = filmed(("tilt", "azimuth"))
    turned = dict(data.series)
    turned["azimuth"] = replace(turned["azimuth"], values=turned["azimuth"].values + 2.0)
    found = shown(TRUE, Data(MappingProxyType(turned)))
    seen = TRUE.seen(T)
    s, phi = np.sin(seen["tilt"]), seen["azimuth"]
    np.testing.assert_allclose(found.axis[:, 1:3], np.column_stack([s * np.sin(phi), -s * np.cos(phi)]), atol=5e-3)


# ---- taken home ----


def test_the_program_taken_home_asks_for_the_same_fit(monkeypatch):
    """Of the same top with its stem, the same numbers and the same part of the film."""
    asked, shape = [], TruncatedSphere.paper()
    loose = ("air_drag", "a")
    model = model_of("smoothed", TOP, SCALES, shape, loose)
    data = filmed(("tilt", "spin"), np.random.default_rng(2))
    start, end = float(T[13]), float(T[37])  # no round numbers
    part = data.between(start, end)

    def stopped(both, data):
        asked.append((both, data))
        return alike(0.7), alike(0.7)

    monkeypatch.setattr(fits, "fit_both", stopped)
    exec(program(data, (replace(alike(0.7), model=model),), loose, start, end), {})
    (((rolling, again), seen),) = asked
    assert (rolling.name, rolling.free) == ("rolling", (*START, "a"))  # air drag is none of rolling's
    assert (again.name, again.free, again.top) == (model.name, model.free, model.top)
    assert (again.edge, again.tip) == (model.edge, model.tip) and again.edge is not None
    assert again.scales == SCALES
    for name, series in part.series.items():
        np.testing.assert_allclose(seen.series[name].t, series.t, atol=1e-5)
        np.testing.assert_allclose(seen.series[name].values, series.values, rtol=0, atol=series.error / 20)


def test_residuals_are_what_was_measured_less_what_was_fitted():
    data = filmed(("tilt", "spin"), np.random.default_rng(3))
    found = fitted(data)
    head, *rows = residuals_table(data, found).splitlines()
    assert head == "t_s,quantity,measured,fitted,residual_in_errors" and len(rows) == 2 * len(T)
    for row, t, value in zip(rows, T, data.series["tilt"].values, strict=False):
        time, name, measured, fitted_, rest = row.split(",")
        assert name == "tilt" and float(time) == pytest.approx(t, abs=1e-5)
        assert float(measured) == pytest.approx(value, rel=1e-6)
        assert float(rest) == pytest.approx((value - float(fitted_)) / data.series["tilt"].error, abs=1e-3)
    assert np.abs(residuals_of(found.model, data).row).max() < 6


def test_a_saved_film_says_its_part_to_the_frame():
    data = filmed(("tilt", "spin"), np.random.default_rng(3))
    film = Film("viscous", (), (0.12345, 0.41667), TOP, SCALES, None)
    assert opened(written(film, data)).part == film.part
