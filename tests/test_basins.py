"""The computation of the basins continues where it was stopped, and finds the known exponent of a known boundary."""

import basins
import numpy as np
import pytest


@pytest.mark.parametrize("alpha", [0.3, 1.0])
def test_the_power_of_a_known_border_is_found(alpha):
    """Random starts near boundaries, for which the fraction closer than e scales as e^alpha."""
    rng = np.random.default_rng(1)
    distance = 3 * rng.random((4000, 1)) ** (1 / alpha)
    other = distance < basins.DISTANCES
    found, error = basins.exponent(other, basins.DISTANCES >= 0.01, rng)
    assert found == pytest.approx(alpha, abs=4 * error) and error < 0.05


def test_the_fastest_border_is_below_each_tilt():
    end = np.full((28, 45), basins.WORDS.index("stem"))
    end[2, 24], end[25, 34] = 0, 0  # at 4.5 degrees and 39.5 rev/s; at 27.5 and 49.5
    assert basins.last_borders(end) == {10: 40.5, 20: 40.5, 30: 50.5}


def test_what_was_run_is_not_run_again(monkeypatch, tmp_path):
    """Stopped after the second of three pieces; the rows of the map are in the right places."""
    asked = []

    def ended(spins, tilts, rtol=1e-6):
        if len(asked) == 2:
            raise KeyboardInterrupt
        asked.append(spins)
        return np.where(spins > 40, "stem", "upright"), np.round(tilts).astype(int)

    monkeypatch.setattr(basins, "ended", ended)
    monkeypatch.setattr(basins, "PIECE", 14)
    with pytest.raises(KeyboardInterrupt):
        basins.mapped(tmp_path, 6)
    assert (basins.mapped(tmp_path, 6, wait=True)[0] == basins.NONE).sum() == 8
    asked.append(None)
    end, hops = basins.mapped(tmp_path, 6)
    assert [len(each) for each in asked if each is not None] == [14, 14, 8]
    spins, tilts = (low + (high - low) * (np.arange(6) + 0.5) / 6 for low, high in (basins.SPINS, basins.TILTS))
    assert (end == np.where(spins > 40, *map(basins.WORDS.index, ("stem", "upright")))[None]).all()
    assert (hops == np.round(tilts)[:, None]).all()


def test_what_other_code_ran_is_shown_as_such_and_run_again(monkeypatch, tmp_path):
    monkeypatch.setattr(basins, "ended", lambda spins, tilts, rtol: (["stem"] * len(spins), spins * 0))
    monkeypatch.setattr(basins, "code", lambda: "before")
    basins.mapped(tmp_path, 4)
    assert basins.age(tmp_path).endswith("with today’s code.")
    monkeypatch.setattr(basins, "code", lambda: "now")
    monkeypatch.setattr(basins, "ended", lambda spins, tilts, rtol: (["upright"] * len(spins), spins * 0))
    assert "**1 of the 1 parts are not of today’s code**" in basins.age(tmp_path)
    assert {*basins.mapped(tmp_path, 4, wait=True)[0].flat} == {basins.WORDS.index("stem")}
    assert {*basins.mapped(tmp_path, 4)[0].flat} == {basins.WORDS.index("upright")}
    assert basins.age(tmp_path).endswith("with today’s code.")


@pytest.mark.slow
def test_the_page_says_what_was_run():
    end, found, other = basins.computed(basins.CELLS, basins.KEPT, wait=True)
    assert not (end == basins.NONE).any()
    lines = basins.page(basins.CELLS, basins.STARTS, found, basins.last_borders(end), basins.age(basins.KEPT), other)
    assert (basins.DOCS / "basins.md").read_text(encoding="utf-8") == "\n".join(lines) + "\n"


@pytest.mark.slow
def test_what_is_kept_is_what_runs_give():
    """At twelve random cells whose neighbours all end alike: near a border the last digits of a machine decide."""
    end, _ = basins.mapped(basins.KEPT, basins.CELLS, wait=True)
    shifted = [np.roll(end, (up, across), (0, 1)) for up in (-1, 0, 1) for across in (-1, 0, 1)]
    calm = np.all([each == end for each in shifted], axis=0)[1:-1, 1:-1]
    rows, columns = np.random.default_rng(7).permutation(np.argwhere(calm))[:12].T + 1
    spins, tilts = (low + (high - low) * (at + 0.5) / basins.CELLS
                    for at, (low, high) in ((columns, basins.SPINS), (rows, basins.TILTS)))  # fmt: skip
    words, _ = basins.ended(spins, tilts)
    assert [basins.WORDS.index(word) for word in words] == end[rows, columns].tolist()
