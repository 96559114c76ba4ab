"""Each cause that a map names is tried: the same run without it does what the formula says."""

import numpy as np
import pytest

from app.model.maps.lines import TURNED, disagreements
from app.model.maps.maps import Map
from app.model.maps.solving import run, solve
from tippe_core import Contensou, ending, slide

TOPS = ("The paper's tippe top", "Top S", "Leine and Glocker's toy", "Hollow tippe top", "Cohen's top", "Free profile")
DID = {  # what the run itself must show
    "falls": lambda found: found.time_stem < found.t[-1] and found.end not in TURNED,
    "lifts": lambda found: found.hops > 1 and found.end not in TURNED,
    "leans": lambda found: found.end == "leaning",
    "sticks": lambda found: found.end == "rolling",
    "slow": lambda found: found.end == "upright",
    "stable": lambda found: found.end == "upright",
    "moving": lambda found: found.end == "moving",
    "high": lambda found: found.end in TURNED,
}


def without_pivoting(cell, rtol):
    """How the run ends if the patch slides and does not resist its spin."""
    law, times = cell.friction.law, np.linspace(0.0, cell.t_end, 200)
    slides = Contensou(law.mu, law.radius, pivots=False)
    return ending(slide(cell.top, cell.state, slides, times, rtol=rtol, edge=cell.edge)).end


@pytest.mark.long
@pytest.mark.slow
@pytest.mark.parametrize("name", TOPS)
def test_a_cause_that_a_map_names_is_the_cause(name):
    """12 x 12 runs; of each reason one run, in the middle of those that have it."""
    asked = Map(body=name, cells=12, seconds=6.0)
    *_, level = solve(asked)
    for found in disagreements(level):
        for reason in found.reasons:
            once = run(asked, *reason.one)
            if reason.why in DID:
                assert DID[reason.why](once), (found.kind, reason)
            else:
                assert (reason.why, once.end) == ("pivoting", "upright")  # the one cause that these maps name
                assert without_pivoting(asked.at(*reason.one), asked.rtol) != "upright", (found.kind, reason)
