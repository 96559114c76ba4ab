"""The map of the groups of tops, compared with the core's verdict on random tops."""

import numpy as np
from matplotlib.path import Path

from app.model.families.groups import areas
from tippe_core import Top, thresholds

PLACE = {"left": -0.6, "right": 0.8, "low": 0.45, "high": 1.75}


def test_a_top_lies_in_the_area_of_its_group_and_in_no_other():
    rng = np.random.default_rng(1)
    found = {group: Path(np.transpose(corners)) for group, corners in areas(**PLACE).items()}
    met = set()
    for a, ratio in zip(rng.uniform(-0.6, 0.8, 500), rng.uniform(0.5, 1.75, 500), strict=True):
        group = thresholds(Top(a, 0.4 * ratio, 0.4)).group
        assert [name for name, area in found.items() if area.contains_point((a, ratio))] == [group]
        met.add(group)
    assert met == found.keys()
