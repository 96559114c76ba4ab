"""One HTML file of a fit, to be read without this page, and printed."""

import html

import numpy as np

from app.model.colours import ON_LIGHT
from app.tabs.measure.figures import size_of
from app.text import say, spoken

WIDTH, HEIGHT, REST = 720, 220, 60
STYLE = """body { font: 15px/1.45 system-ui, sans-serif; max-width: 760px; margin: 24px auto; padding: 0 16px;
  color: #1b2430 }
table { border-collapse: collapse } td, th { padding: 3px 14px 3px 0; text-align: left; font-weight: normal }
pre { font-size: 11px; white-space: pre-wrap; overflow-wrap: anywhere } svg { max-width: 100%; height: auto }
@media print { svg, table { break-inside: avoid } }"""


def report(data, fits, found, program, kept):
    """The text of the file. found: what the page says of the fit, HTML. kept: the constants from the data."""
    better = min(fits, key=lambda each: each.aic)
    curves = "".join(_picture(name, data, better) for name in data.series)
    curves += "".join(_constant(name, constant) for name, constant in kept.items())
    return (f'<!doctype html><html lang="{spoken()}"><meta charset="utf-8"><title>{say("measure.report.title")}</title>'
            f"<style>{STYLE}</style><h1>{say('measure.report.title')}</h1>{found}{curves}"
            f"<h2>{say('measure.report.program')}</h2><pre>{html.escape(program)}</pre></html>")  # fmt: skip


def _picture(name, data, fit):
    series, size = data.series[name], size_of(name)
    y, curve, error = series.values * size, fit.left.values[name] * size, series.error * size
    low, high = min(y.min(), curve.min()) - error, max(y.max(), curve.max()) + error
    x = 50 + (WIDTH - 60) * (series.t - series.t[0]) / (np.ptp(series.t) or 1)

    def place(values):
        return 10 + (HEIGHT - 20) * (high - values) / (high - low or 1)

    rest = HEIGHT + REST / 2 - fit.left.residuals[name] * REST / 2 / max(3.5, np.abs(fit.left.residuals[name]).max())
    line = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, place(curve), strict=True))
    dots = "".join(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2.4" fill="none" stroke="#1b2430"/>'
                   f'<circle cx="{a:.1f}" cy="{c:.1f}" r="1.4"/>'
                   for a, b, c in zip(x, place(y), rest, strict=True))  # fmt: skip
    marks = "".join(f'<text x="46" y="{place(value) + 4:.0f}" text-anchor="end">{value:.3g}</text>'
                    for value in (low + 0.1 * (high - low), high - 0.1 * (high - low)))  # fmt: skip
    foot = HEIGHT + REST + 14
    ends = (f'<text x="50" y="{foot}">{series.t[0]:.2f} s</text>'
            f'<text x="{WIDTH - 10}" y="{foot}" text-anchor="end">{series.t[-1]:.2f} s</text>')  # fmt: skip
    title = f"{say(f'measure.quantities.{name}')} {say(f'measure.units.{name}')}"
    return (f'<h3>{title}</h3><svg viewBox="0 0 {WIDTH} {HEIGHT + REST + 18}" font-size="12" role="img" '
            f'aria-label="{title}"><polyline points="{line}" fill="none" stroke-width="2" '
            f'stroke="{ON_LIGHT["omega"]}"/>'
            f"{dots}{marks}{ends}</svg>")  # fmt: skip


def _constant(name, constant):
    """A band of one standard error about a constant of the motion, over time."""
    values, errors, t = constant.values, constant.errors, constant.t
    low, high = (values - errors).min(), (values + errors).max()
    x = 50 + (WIDTH - 60) * (t - t[0]) / (np.ptp(t) or 1)
    edges = [(HEIGHT - 20) * (high - each) / (high - low or 1) + 10 for each in (values - errors, values + errors)]
    around = [*zip(x, edges[0], strict=True), *zip(x[::-1], edges[1][::-1], strict=True)]
    band = " ".join(f"{a:.1f},{b:.1f}" for a, b in around)
    marks = "".join(f'<text x="46" y="{y}" text-anchor="end">{value:.3g}</text>'
                    for y, value in ((HEIGHT - 8, low), (16, high)))  # fmt: skip
    title = say(f"measure.kept.{name}")
    return (f'<h3>{title}</h3><svg viewBox="0 0 {WIDTH} {HEIGHT}" font-size="12" role="img">'
            f'<polygon points="{band}" fill="#1b2430" fill-opacity="0.35"/>{marks}</svg>')  # fmt: skip
