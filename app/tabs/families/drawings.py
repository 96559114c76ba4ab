"""Figs. 5 and 6 of one top, small, as SVG: text that a thread can write, where a Bokeh figure would be fifty models."""

import html

import numpy as np

from app.model.colours import COLOURS, FAINT, INK
from app.text import say

WIDTH = 158  # px: two of them beside each other on a phone
LINE, PALE, RULE = f"var(--ink, {INK})", f"var(--faint, {FAINT})", "var(--rule, #e7ebef)"
SHEET = "#dcebf6"
DASHED = 'stroke-dasharray="6 4"'
# Fig. 5 as a drawing: K_J runs so far back and up, of the width and the height of the picture
BACK, UP, HIGH = 0.28, 0.45, 0.5


class Drawing:
    """A picture whose numbers lie in x (from, to), left to right, and y (from, to), upwards.

    margins: px around them, left, right, top, bottom.
    """

    def __init__(self, label, title, height, x, y, margins=(0, 0, 24, 0)):
        self._x, self._y, self.height = x, y, height
        self._left, right, self._top, bottom = margins
        self._wide, self._high = WIDTH - self._left - right, height - self._top - bottom
        self._parts = [f'<text x="{self._left + 2}" y="14">{html.escape(title)}</text>']
        self._label = html.escape(f"{label}: {title}")

    def px(self, x, y):
        """Of numbers or arrays."""
        (left, right), (low, high) = self._x, self._y
        across, up = (np.asarray(x) - left) / (right - left), (np.asarray(y) - low) / (high - low)
        return self._left + self._wide * across, self._top + self._high * (1 - up)

    def path(self, x, y, style, closed=False):
        """A line through points; where one is nan it has a gap."""
        pen, steps = "M", []
        for a, b in zip(*self.px(x, y), strict=True):
            if np.isfinite(a + b):
                steps.append(f"{pen}{a:.1f} {b:.1f}")
                pen = "L"
            else:
                pen = "M"
        self._parts.append(f'<path d="{"".join(steps)}{"z" if closed else ""}" {style}/>')

    def text(self, x, y, words, style, shift=(0, 0)):
        a, b = self.px(x, y)
        self._parts.append(f'<text x="{a + shift[0]:.1f}" y="{b + shift[1]:.1f}" {style}>{words}</text>')

    @property
    def svg(self):
        style = f'style="font: 12px system-ui, sans-serif; fill: {LINE}; overflow: hidden"'
        return (f'<svg role="img" aria-label="{self._label}" width="{WIDTH}" height="{self.height}" {style}>'
                f'{"".join(self._parts)}</svg>')  # fmt: skip


def pen(colour, width=1.5, more=""):
    return f'fill="none" stroke="{colour}" stroke-width="{width}" {more}'


def waterfall(shown, end, most):
    """Fig. 5 of a family.Region as a drawing: a sheet of f1^2 theta_dot^2 stands on every tieline, K_J to the back.

    end: where the theta axis ends; most: the height, in K_R^2, that all figures have room for.
    """

    def place(theta, part, height=0.0):
        return theta + BACK * end * part, UP * part + HIGH * height / most

    drawing = Drawing(say("roll.figures.waterfall"), shown.name, 190, (-0.06 * end, (1 + BACK) * end * 1.03),
                      (-0.14, UP + HIGH + 0.04))  # fmt: skip
    corners = np.array([(0, 0), (end, 0), (end, 1), (0, 1)]).T
    drawing.path(*place(*corners), pen(PALE, 1), closed=True)
    for theta, label in ((0, "0"), (np.pi / 2, "π/2"), (np.pi, "π")):
        if theta <= end:
            drawing.path(*place(np.full(2, theta), np.array([0, 1])), pen(PALE, 1, 'stroke-dasharray="2 4"'))
            drawing.text(theta, 0, label, 'text-anchor="middle" font-size="11"', shift=(0, 14))
    # closed along the tieline, from the back to the front
    for row in np.flatnonzero(np.isfinite(shown.height).all(axis=1))[::-1]:
        drawing.path(*place(shown.theta[row], shown.part[row], shown.height[row]),
                     f'fill="{SHEET}" fill-opacity="0.85" stroke="{INK}" stroke-opacity="0.7" stroke-width="0.7"',
                     closed=True)  # fmt: skip
    drawing.path(*place(shown.lift.theta_steady, shown.part), pen(LINE, 1.5, DASHED))
    lifts = np.where(np.isfinite(shown.lift.E), shown.lift.theta_outer, np.nan)
    drawing.path(*place(lifts, shown.part), pen(COLOURS["normal"]))
    return drawing.svg


def plane(shown, end):
    """Fig. 6 of one top, a family.Region, with K_J in units of its own K_J(P); end: as in waterfall."""
    title = f"Kⱼ(P) = {shown.pole:.3g}".replace("-", "−")
    drawing = Drawing(say("roll.figures.plane"), title, 200, (0, end), (0, 1.02), (26, 8, 24, 20))
    for theta in np.arange(0, end, 1.0 if end > 2 else 0.5):
        drawing.path([theta, theta], [0, 1.02], pen(RULE, 1))
        drawing.text(theta, 0, f"{theta:g}", 'text-anchor="middle"', shift=(0, 15))
    for part in (0, 0.5, 1):
        drawing.path([0, end], [part, part], pen(RULE, 1))
        drawing.text(0, part, f"{part:g}", 'text-anchor="end"', shift=(-4, 4))
    steady, lift, slip, part = shown.lift.theta_steady, shown.lift, shown.slip, shown.part
    # where even the steady precession breaks a limit, the tieline is a point there
    left, right, first, last = (np.where(np.isnan(theta), steady, theta) for theta in (
        lift.theta_inner, lift.theta_outer, slip.theta_inner, slip.theta_outer))  # fmt: skip
    for one, other in ((left, first), (last, right)):
        there = np.isfinite(one + other)
        around = np.r_[one[there], other[there][::-1]], np.r_[part[there], part[there][::-1]]
        drawing.path(*around, f'fill="{COLOURS["friction"]}" fill-opacity="0.16"', closed=True)
    gap = np.full(len(part), np.nan)
    drawing.path(np.c_[first, last, gap].ravel(), np.repeat(part, 3), pen(LINE, 1, 'stroke-opacity="0.55"'))
    drawing.path(np.where(np.isfinite(lift.E), right, np.nan), part, pen(COLOURS["normal"], 2))
    drawing.path(slip.theta_verge, part, pen(COLOURS["friction"], 2))
    drawing.path(steady, part, pen(LINE, 1.5, DASHED))
    return drawing.svg


def side_by_side(shown):
    """The Regions side by side, on common axes: Fig. 5 above, Fig. 6 below."""
    reach = max((np.nanmax(one.lift.theta_outer, initial=0.0) for one in shown), default=0.0)
    end = min(np.pi, max(np.pi / 2, 1.03 * reach))
    most = max((np.nanmax(one.height, initial=0.0) for one in shown), default=0.0) or 1.0
    pairs = (f"<div style='display: grid; width: {WIDTH}px'>{waterfall(one, end, most)}{plane(one, end)}</div>"
             for one in shown)  # fmt: skip
    return f"<div style='display: flex; flex-flow: row wrap; gap: 8px'>{''.join(pairs)}</div>"
