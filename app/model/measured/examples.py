"""The examples of the tab Measure, computed by tippe_core with noise.

All are for the paper's top. None of them was filmed, and their names say so. `python -m app.model.measured.made` writes
them with their fits.
"""

from pathlib import Path

import numpy as np

from app.model.measured.motion import Model, model_of
from tippe_core import Scales, Top, TruncatedSphere

FOLDER = Path(__file__).parents[2] / "data" / "measured"
FILMED = TruncatedSphere.paper()  # the shape; the paper gives its a, I1 and I3 rounded
RATES = {"slips": 120.0, "rolls": 240.0, "air": 120.0}  # frames per second
TILT, SPIN, TURN = np.radians(1.0), 2 * np.pi * 0.3, np.radians(1.5)  # standard errors of one value
EXAMPLES = ("slips", "rolls", "air")


def example_model(name: str) -> tuple[Model, int]:
    """(the Model, the number of frames)."""
    shape, top = TruncatedSphere.paper(), Top.paper()
    scales = Scales(shape.R, shape.M)
    if name == "rolls":
        start = {"tilt": 0.6, "tilt_rate": 0.1, "across": 1.4, "spin": 7.0}
        return model_of("rolling", top, scales, shape).with_values(start), 180
    if name == "slips":
        start = {"tilt": 0.2, "spin": 8.0, "mu": 0.35, "radius": 0.02}
        return model_of("contensou", top, scales, shape).with_values(start), 216
    start = {"tilt": 0.2, "spin": 6.2, "mu": 0.28, "radius": 0.03, "air_drag": 0.004, "rolling_resistance": 0.01}
    return model_of("contensou", top, scales, shape).with_values(start), 132


def example(name: str) -> str:
    """The text of an example, as Tracker, phyphox or a spreadsheet would write it."""
    model, count = example_model(name)
    t = np.arange(count) / RATES[name]
    seen, rng = model.seen(t), np.random.default_rng(EXAMPLES.index(name))
    tilt, spin, turn = (seen[key] + error * rng.normal(size=count)
                        for key, error in (("tilt", TILT), ("spin", SPIN), ("azimuth", TURN)))  # fmt: skip
    between, comma = {"slips": ("\t", True), "rolls": (",", False), "air": (";", True)}[name]
    heads = ["t (s)", "tilt (deg) ± 1", "spin (rev/s) ± 0.3"]
    columns = [t, np.degrees(tilt), spin / (2 * np.pi)]
    if name == "rolls":
        heads.append("azimuth (deg) ± 1.5")
        columns.append(np.degrees(turn))
    rows = [between.join(f"{x:.{2 if i else 4}f}" for i, x in enumerate(row)) for row in zip(*columns, strict=True)]
    made = "# Nobody filmed this: made by tippe_core with noise, of the paper's top."
    return "\n".join([made, between.join(heads), *(row.replace(".", ",") if comma else row for row in rows)]) + "\n"
