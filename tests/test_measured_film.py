"""A film as a file and as a link: it opens as it was saved, and manipulated content is refused."""

import base64
import json
import zlib
from dataclasses import replace

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.model.measured import film, work
from app.model.measured.data import settled
from app.model.measured.examples import EXAMPLES, FOLDER
from app.model.measured.film import Film, opened, packed, unpacked, written
from app.model.measured.table import MeasuredError, read
from app.tabs.measure.measure import Measure
from tippe_core import Scales, Top, TruncatedSphere

FILM = Film("viscous", ("losses", "body"), (0.1, 0.7), Top(0.1, 0.4, 0.41), Scales(0.02, 0.03), TruncatedSphere.paper())


@pytest.fixture(params=EXAMPLES)
def data(request):
    return settled(read((FOLDER / f"made-{request.param}.csv").read_bytes()))


def test_a_saved_film_opens_as_it_was(data):
    """Its numbers to a part of their errors that no fit sees."""
    text = written(FILM, data)
    again, table = opened(text), settled(read(text))
    assert (again.law, again.loose, again.part) == (FILM.law, FILM.loose, FILM.part)
    assert (again.top, again.scales, again.shape) == (FILM.top, FILM.scales, FILM.shape)
    for name, series in data.series.items():
        assert table.series[name].error == pytest.approx(series.error, rel=1e-3)
        np.testing.assert_allclose(table.series[name].values, series.values, rtol=0, atol=series.error / 20)
        np.testing.assert_allclose(table.series[name].t, series.t, rtol=0, atol=1e-5)
    assert opened(text.encode()).top == FILM.top
    assert unpacked(packed(text)) == text


@pytest.mark.parametrize("begin", [1.0, 99.987654, 12_345.678901, 1.7e9])
def test_a_film_is_saved_to_the_frame_however_late_it_begins(begin):
    """At 960 frames a second, with two values at one time, both of which are data."""
    t = begin + np.floor(np.arange(30) - (np.arange(30) > 12)) / 960
    lines = (f"{at:.7f}\t{5 + i}\t{20 - i}" for i, at in enumerate(t))
    data = settled(read("\n".join(["t (s)\ttilt (deg) ± 1\tspin (rev/s) ± 0.1", *lines])))
    part = float(t[3]), float(t[-4])
    text = written(replace(FILM, part=part), data)
    again = settled(read(text))
    for name, series in data.series.items():
        np.testing.assert_allclose(again.series[name].t - begin, series.t - begin, rtol=0, atol=6e-7)
        np.testing.assert_allclose(again.series[name].values, series.values, rtol=0, atol=series.error / 20)
    cut = again.between(*opened(text).part)
    assert {len(series.t) for series in cut.series.values()} == {30 - 6}


def test_a_film_that_was_saved_without_correlations_is_to_be_fitted_anew():
    said = {"values": {}, "sides": {}, "unknown": [], "sure": True}
    again = opened(written(replace(FILM, fits=(said, said)), settled(read((FOLDER / "made-rolls.csv").read_bytes()))))
    assert again.law == FILM.law and again.fits == ()


def test_a_table_alone_says_nothing_of_a_fit():
    assert opened("t\ttilt\n0\t1\n") is None


def test_a_link_with_a_fit_shows_it_without_fitting_anew(monkeypatch):
    """As it was, and says where it is from; what it leaves over is computed from the link's own data."""
    one = Measure(Explorer().scene)
    one.take_example("slips")
    one.compute()
    one.home.in_link.value = ["link"]
    monkeypatch.setattr(work, "fit_both", lambda *_: pytest.fail("fitted anew"))
    other = Measure(Explorer().scene)
    other.filmed.film = one.filmed.film
    assert other.view is not None
    for before, after in zip(one._found.fits, other._found.fits, strict=True):
        assert after.model.values == pytest.approx(before.model.values, rel=1e-8)
        assert (after.unknown, after.sure, after.refused) == (before.unknown, before.sure, before.refused)
        assert after.chi2 == pytest.approx(before.chi2, rel=0.02)  # data are written to a twentieth of their errors
        for name, sides in before.sides.items():
            assert after.sides[name] == pytest.approx(sides, rel=1e-8)
        np.testing.assert_allclose(after.covariance, before.covariance, rtol=1e-8)
        assert [pair[:2] for pair in after.together] == [pair[:2] for pair in before.together]
    assert "was saved with the film" in other.found.object and "was saved with" not in one.found.object


def fits_that_are_none():
    one = {"values": {"tilt": 0.1, "tilt_rate": 0.0, "across": 0.0, "spin": 8.0}, "unknown": [], "sure": True}
    one["sides"] = {name: [0.1, 0.1] for name in one["values"]}
    one["covariance"] = [0.01, 0, 0, 0, 0.01, 0, 0, 0.01, 0, 0.01]
    yield [one]
    yield 3
    for change in ({"values": {}}, {"values": one["values"] | {"tilt": 9}}, {"sides": {}}, {"unknown": ["mass"]},
                   {"sides": one["sides"] | {"spin": [-1, 1]}}, {"values": None}, {"covariance": 0.01},
                   {"covariance": [0.01] * 3}, {"covariance": [0.01, 0.02, *one["covariance"][2:]]},
                   {"covariance": [None] * 10}, {"covariance": [-0.01] * 10},
                   {"covariance": [float("inf")] * 10}):  # fmt: skip
        yield [one | change, one | change]


@pytest.mark.parametrize("fits", [*fits_that_are_none()])
def test_fits_that_cannot_be_are_refused(fits):
    text = written(FILM, settled(read((FOLDER / "made-rolls.csv").read_bytes())))
    head, _, table = text.partition("\n")
    said = json.loads(head.removeprefix(film.MARK)) | {"fits": fits}
    with pytest.raises(MeasuredError):
        opened(f"{film.MARK} {json.dumps(said)}\n{table}")


@pytest.mark.parametrize("change", [
    {"law": "rolling"}, {"law": 3}, {"loose": ["weight"]}, {"loose": None}, {"part": [0]}, {"part": ["a", 1]},
    {"top": [0.1, 0.4, 0.9, 0.02, 0.03, 9.8]}, {"top": [0.1, 0.4, 0.41, -1, 0.03, 9.8]}, {"body": {"kind": "bomb"}},
    {"top": [float("nan")] * 6}])  # fmt: skip
def test_what_a_film_cannot_be_is_refused_by_its_line(change):
    text = written(FILM, settled(read((FOLDER / "made-rolls.csv").read_bytes())))
    head, _, table = text.partition("\n")
    said = json.loads(head.removeprefix(film.MARK)) | change
    with pytest.raises(MeasuredError) as error:
        opened(f"# mine\n{film.MARK} {json.dumps(said)}\n{table}")
    assert (error.value.code, error.value.numbers) == ("film", {"line": 2})


def test_a_link_holds_no_more_than_a_table():
    bomb = base64.urlsafe_b64encode(zlib.compress(b"0" * 10_000_000)).decode()
    for letters in (bomb, packed("a film")[:-3], "!", "AAAA", "x" * 50):
        with pytest.raises(ValueError, match="film"):
            unpacked(letters)
    noise = "\n".join(map(str, np.random.default_rng(1).normal(size=4000)))
    assert packed(noise) == ""


def test_the_tab_opens_what_its_link_says():
    """With the law, what is free, the part and the top of the film, whatever the page's top is."""
    one = Measure(Explorer().scene)
    one.take(written(FILM, settled(read((FOLDER / "made-rolls.csv").read_bytes()))))
    assert (one.law.value, one.loose.value, one.part.value) == ("viscous", ["losses", "body"], [0.1, 0.7])
    assert one._body[0] == FILM.top and "saved film" in one.about.object
    other = Measure(Explorer().scene)
    other.filmed.film = packed(one._film())
    assert other.view is not None
    assert other._body[:3] == one._body[:3] and other.part.value == one.part.value
    other.take((FOLDER / "made-slips.csv").read_bytes())  # another table belongs to the page's top again
    assert other._body[0] == Explorer().scene.top
