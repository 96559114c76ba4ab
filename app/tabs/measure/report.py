"""A report of a fit as one HTML file, to be read without this page, and printed."""

import html
import re

import numpy as np

from app.model.colours import COLOURS
from app.tabs.measure.figures import size_of
from app.text import say, spoken, written
from app.widgets.plots import round_numbers

WIDTH, HEIGHT, REST, LEFT = 720, 220, 60, 50
INK, GRID = "#1b2430", "#e4e7ea"
STYLE = """body { font: 15px/1.45 system-ui, sans-serif; max-width: 760px; margin: 24px auto; padding: 0 16px;
  color: #1b2430 }
table { border-collapse: collapse } td, th { padding: 3px 14px 3px 0; text-align: left; font-weight: normal }
pre { font-size: 11px; white-space: pre-wrap; overflow-wrap: anywhere } svg { max-width: 100%; height: auto }
@media print { svg, table { break-inside: avoid } }"""


def report(data, fits, found, program, kept):
    """The text of the file. found: the page's words about the fit, HTML. kept: the constants from the data."""
    better = min(fits, key=lambda each: each.aic)
    top, scales, count = better.model.top, better.model.scales, sum(len(each.t) for each in data.series.values())
    of = say("measure.report.of", R=1e3 * scales.R, a=top.a, I1=top.I1, I3=top.I3, count=count, start=data.t[0],
             end=data.t[-1])  # fmt: skip
    curves = "".join(_picture(name, data, better) for name in data.series)
    curves += "".join(_constant(name, constant) for name, constant in kept.items())
    return (f'<!doctype html><html lang="{spoken()}"><meta charset="utf-8"><title>{say("measure.report.title")}</title>'
            f"<style>{STYLE}</style><h1>{say('measure.report.title')}</h1><p>{of}</p>{found}"
            f"<p>{say('measure.report.key')}</p>{curves}"
            f"<h2>{say('measure.report.program')}</h2><pre>{html.escape(program)}</pre></html>")  # fmt: skip


class _Axes:
    """The positions of times and values in a figure, and its lines at round numbers."""

    def __init__(self, t, low, high):
        self._begin, self._long = t[0], np.ptp(t) or 1
        self._high, self._tall = high, high - low or 1
        self.lines = "".join(_line(self.y(value), written(value, "g")) for value in round_numbers(low, high))
        times = round_numbers(t[0], t[-1])
        self._times = [(self.x(each), written(each, "g") + " s" * (each == times[-1])) for each in times]

    def foot(self, y):
        return "".join(f'<text x="{x:.0f}" y="{y}" text-anchor="middle">{text}</text>' for x, text in self._times)

    def x(self, t):
        return LEFT + (WIDTH - LEFT - 16) * (t - self._begin) / self._long

    def y(self, values):
        return 10 + (HEIGHT - 20) * (self._high - values) / self._tall


def _line(y, text):
    return (f'<path d="M{LEFT} {y:.1f}H{WIDTH - 16}" stroke="{GRID}"/>'
            f'<text x="{LEFT - 6}" y="{y + 4:.0f}" text-anchor="end">{text}</text>')  # fmt: skip


def _drawn(title, high, parts):
    return (f'<h3>{title}</h3><svg viewBox="0 0 {WIDTH} {high}" font-size="12" role="img" '
            f'aria-label="{html.escape(re.sub("<[^>]*>", "", title))}">{parts}</svg>')  # fmt: skip


def _picture(name, data, fit):
    series, size = data.series[name], size_of(name)
    y, curve, error = series.values * size, fit.residuals.values[name] * size, series.error * size
    axes = _Axes(series.t, min(y.min(), curve.min()) - error, max(y.max(), curve.max()) + error)
    x, left = axes.x(series.t), fit.residuals.of[name]
    middle, one = HEIGHT + REST / 2, REST / 2 / max(3.5, np.abs(left).max())
    band = f'<rect x="{LEFT}" y="{middle - one:.1f}" width="{WIDTH - LEFT - 16}" height="{2 * one:.1f}" fill="{GRID}"/>'
    line = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, axes.y(curve), strict=True))
    dots = "".join(f'<path d="M{a:.1f} {low:.1f}V{high:.1f}" stroke="#8b949e"/>'
                   f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2.4" fill="#fff" stroke="{INK}"/>'
                   f'<circle cx="{a:.1f}" cy="{c:.1f}" r="1.4"/>'
                   for a, b, c, low, high in zip(x, axes.y(y), middle - left * one, axes.y(y - error),
                                                 axes.y(y + error), strict=True))  # fmt: skip
    colour = COLOURS["omega"] if name in ("spin", "precession") else INK
    curve = f'<polyline points="{line}" fill="none" stroke-width="2" stroke="{colour}"/>'
    foot = HEIGHT + REST + 14
    parts = axes.lines + band + _line(middle, "0") + curve + dots + axes.foot(foot)
    return _drawn(f"{say(f'measure.quantities.{name}')}, {say(f'measure.units.{name}')}", foot + 4, parts)


def _constant(name, constant):
    """The error band of a constant of the motion over time; dashed, its mean."""
    values, errors, t = constant.values, constant.errors, constant.t
    axes = _Axes(t, (values - errors).min(), (values + errors).max())
    x = axes.x(t)
    around = [*zip(x, axes.y(values - errors), strict=True), *zip(x[::-1], axes.y(values + errors)[::-1], strict=True)]
    band = " ".join(f"{a:.1f},{b:.1f}" for a, b in around)
    mean = f'<path d="M{LEFT} {axes.y(constant.mean[0]):.1f}H{WIDTH - 16}" stroke="{INK}" stroke-dasharray="6 4"/>'
    drawn = f'<polygon points="{band}" fill="{INK}" fill-opacity="0.35" stroke="{INK}" stroke-width="0.6"/>'
    return _drawn(say(f"measure.kept.{name}"), HEIGHT + 18, axes.lines + mean + drawn + axes.foot(HEIGHT + 14))
