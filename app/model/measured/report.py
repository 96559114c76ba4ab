"""What can be downloaded of a fit: the residuals as a table, and a Python program that repeats it."""

from app.model.measured.data import Data
from app.model.measured.film import MICRO, table_of, time_text
from app.model.measured.fit import Fit


def residuals_table(data: Data, fit: Fit) -> str:
    """One row for each value: its time, its quantity, the measured and the fitted value in s, rad, m, and the residual
    in standard errors."""
    rows = ["t_s,quantity,measured,fitted,residual_in_errors"]
    for name, series in data.series.items():
        parts = zip(series.t, series.values, fit.residuals.values[name], fit.residuals.of[name], strict=True)
        rows += [f"{time_text(t)},{name},{seen:.8g},{fitted:.8g},{rest:.5g}" for t, seen, fitted, rest in parts]
    return "\n".join(rows) + "\n"


def program(data: Data, fits: tuple[Fit, ...], loose: tuple[str, ...], start: float, end: float) -> str:
    """A Python program that reads the same data and fits the same models."""
    model = fits[0].model
    top, scales = model.top, model.scales
    edge = "" if model.edge is None else f".with_stem({model.edge!r}, {model.tip!r})"
    start, end = round(start, MICRO), round(end, MICRO)
    return f'''"""Repeats a fit of the tippe top explorer; run it in the explorer's folder.

It prints angles in rad, and all other numbers in units of R, M and g.
"""

from app.model.measured.data import settled
from app.model.measured.fit import fit_both
from app.model.measured.table import read
from app.model.measured.work import models
from tippe_core import Scales, Top

TABLE = """{table_of(data)}"""

data = settled(read(TABLE)).between({start!r}, {end!r})
top, scales = Top({top.a!r}, {top.I1!r}, {top.I3!r}), Scales({scales.R!r}, {scales.M!r}, {scales.g!r})
rolling, sliding = models(top, scales, None, {fits[-1].model.name!r}, {loose!r})
for found in fit_both((rolling{edge}, sliding{edge}), data):
    print(found.model.name, f"chi-square {{found.chi2:.1f}} for {{found.freedom}} degrees of freedom")
    for number, error in found.errors.items():
        print(f"  {{number}} = {{found.model.values[number]:.6g}} +- {{error:.2g}}")
'''
