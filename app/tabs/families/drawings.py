"""Figs. 5 and 6 of one top as SVG: text that a thread can write, whereas a Bokeh figure would be fifty models."""

import html

import numpy as np

from app.text import say, written
from app.widgets.plots import round_numbers

WIDTH = 480  # px: that of the column on a wide page; on a phone the letters are enlarged, as the figure shrinks
LETTERS = """svg { font-size: 12px } [font-style=italic] { font-family: Georgia, serif }
@media (max-width: 700px) { svg { font-size: 16px } }"""
LINE, PALE, RULE = "var(--ink)", "var(--control-line)", "var(--rule)"
SHEET = "color-mix(in srgb, #9a7434 26%, var(--card))"


def letters(letter, below=""):
    """A symbol in SVG; the subscript returns to the baseline."""
    down = f'<tspan dy=".25em" font-size=".75em">{below}</tspan><tspan dy="-.19em">&#8203;</tspan>' if below else ""
    return f'<tspan font-style="italic">{letter}</tspan>{down}'


K_J, F_Z, THETA = letters("K", "J"), letters("F", "z"), letters("θ")
HALO = f'paint-order="stroke" stroke="var(--card)" stroke-width="4" fill="{LINE}"'
ROOM = 1.1  # rad: room for a name
DASHED = 'stroke-dasharray="6 4"'
# Fig. 5 as a drawing: how far the K_J axis runs back and up, relative to width and height of the picture
BACK, UP, HIGH = 0.28, 0.45, 0.5


class Drawing:
    """A picture with the coordinate ranges x (from, to), left to right, and y (from, to), upwards.

    margins: px around it, left, right, top, bottom.
    """

    def __init__(self, label, height, x, y, margins=(0, 0, 24, 0)):
        self._x, self._y, self.height = x, y, height
        self._left, right, self._top, bottom = margins
        self._wide, self._high = WIDTH - self._left - right, height - self._top - bottom
        self._parts, self._label = [], html.escape(label)

    def px(self, x, y):
        """Pixels of coordinates, which are numbers or arrays."""
        (left, right), (low, high) = self._x, self._y
        across, up = (np.asarray(x) - left) / (right - left), (np.asarray(y) - low) / (high - low)
        return self._left + self._wide * across, self._top + self._high * (1 - up)

    def path(self, x, y, style, closed=False):
        """A line through points, with gaps at nan."""
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
        style = f'style="font-family: inherit; fill: {LINE}; overflow: hidden; width: 100%; max-width: {WIDTH}px"'
        return (f'<svg role="img" aria-label="{self._label}" viewBox="0 0 {WIDTH} {self.height}" {style}>'
                f'{"".join(self._parts)}</svg>')  # fmt: skip


def pen(colour, width=1.5, more=""):
    return f'fill="none" stroke="{colour}" stroke-width="{width}" {more}'


def waterfall(shown, end, most):
    """Fig. 5 of a family.Region as a drawing: a sheet of f1^2 theta_dot^2 stands on each tieline, K_J to the back.

    end: the end of the theta axis; most: the largest height, in K_R^2, for which there is room.
    """

    def place(theta, part, height=0.0):
        return theta + BACK * end * part, UP * part + HIGH * height / most

    drawing = Drawing(say("roll.figures.waterfall"), 236, (-0.06 * end, (1 + BACK) * end * 1.03),
                      (-0.14, UP + HIGH + 0.04), (0, 0, 8, 0))  # fmt: skip
    corners = np.array([(0, 0), (end, 0), (end, 1), (0, 1)]).T
    drawing.path(*place(*corners), pen(PALE, 1), closed=True)
    for theta, label in ((0, "0"), (np.pi / 2, "π/2"), (np.pi, "π")):
        if theta <= end:
            drawing.path(*place(np.full(2, theta), np.array([0, 1])), pen(PALE, 1, 'stroke-dasharray="2 4"'))
            drawing.text(theta, 0, label, 'text-anchor="middle"', shift=(0, 17))
    # closed along the tieline, from the back to the front
    for row in np.flatnonzero(np.isfinite(shown.height).all(axis=1))[::-1]:
        drawing.path(*place(shown.theta[row], shown.part[row], shown.height[row]),
                     f'fill="{SHEET}" fill-opacity="0.85" stroke="{LINE}" stroke-opacity="0.7" stroke-width="0.7"',
                     closed=True)  # fmt: skip
    drawing.path(*place(shown.lift.theta_steady, shown.part), pen(LINE, 1.5, DASHED))
    lifts = np.where(np.isfinite(shown.lift.E), shown.lift.theta_outer, np.nan)
    drawing.path(*place(lifts, shown.part), pen("var(--normal)"))
    drawing.text(*place(0, 0.5), K_J, 'text-anchor="end"', shift=(-8, 0))
    drawing.text(*place(end, 0), THETA, "", shift=(24, 17))
    return drawing.svg


def plane(shown, mu_s):
    """Fig. 6 of one top, a family.Region: K_J over all tilts, each curve with its name beside it."""
    end, pole = np.pi, shown.pole
    drawing = Drawing(say("roll.figures.plane"), 282, (0, end), (0, 1.06), (34, 8, 10, 40))
    drawing.text(0, 1.06, K_J, 'text-anchor="end"', shift=(-12, 8))
    for theta in (0, 1, 2, 3):
        drawing.text(theta, 0, written(theta, "g"), 'text-anchor="middle"', shift=(0, 18))
    drawing.text(end, 0, f"{THETA} (rad)", 'text-anchor="end"', shift=(0, 36))
    for value in round_numbers(*sorted((0, pole))):
        drawing.path([0, end], [value / pole] * 2, pen(RULE, 1))
        drawing.text(0, value / pole, written(value, "g"), 'text-anchor="end"', shift=(-5, 4))
    steady, lift, slip, part = shown.lift.theta_steady, shown.lift, shown.slip, shown.part
    # where even the steady precession violates a limit, the tieline is a point
    left, right, first, last = (np.where(np.isnan(theta), steady, theta) for theta in (
        lift.theta_inner, lift.theta_outer, slip.theta_inner, slip.theta_outer))  # fmt: skip
    for one, other in ((left, first), (last, right)):
        there = np.isfinite(one + other)
        around = np.r_[one[there], other[there][::-1]], np.r_[part[there], part[there][::-1]]
        drawing.path(*around, f'fill="{LINE}" fill-opacity="0.09"', closed=True)
    gap = np.full(len(part), np.nan)
    drawing.path(np.c_[first, last, gap].ravel(), np.repeat(part, 3), pen(LINE, 1, 'stroke-opacity="0.55"'))
    lifts = np.where(np.isfinite(lift.E), right, np.nan)
    drawing.path(lifts, part, pen("var(--normal)", 2))
    drawing.path(slip.theta_verge, part, pen(LINE))
    drawing.path(steady, part, pen(LINE, 1.5, DASHED))
    beyond = np.fmax(np.fmax(right, last), steady)
    for words, curve, at in ((say("family.key.lift", F_z=F_Z), lifts, 0.4),
                             (say("family.key.verge", mu_s=mu_s), slip.theta_verge, 0.2)):  # fmt: skip
        _name(drawing, words, curve, beyond, part, at)
    _name(drawing, say("family.key.steady"), steady, np.fmin(np.fmin(left, first), steady), part, 0.1, side=-1)
    return drawing.svg


def _name(drawing, words, curve, beyond, part, at, side=1):
    """The name of a curve at this height, to the right of all curves or, with side -1, to their left; on the other side
    if there is no room. A line leads to the curve."""
    row = int(np.argmin(np.abs(part - at)))
    if not np.isfinite(curve[row] + beyond[row]):
        return
    if (beyond[row] > np.pi - ROOM) if side > 0 else (beyond[row] < ROOM):
        beyond, side = curve, -side
    start, end = beyond[row], beyond[row] + side * 0.12
    drawing.path([curve[row], end], [part[row]] * 2, pen(PALE, 1))
    anchor = "start" if side > 0 else "end"
    drawing.text(end if beyond is not curve else start, part[row], words, f'text-anchor="{anchor}" {HALO}',
                 shift=(4 * side, 4))  # fmt: skip


def pair(shown, mu_s):
    """Figs. 6 and 5 of one Region, one above the other."""
    reach = np.nanmax(shown.lift.theta_outer, initial=0.0)
    most = np.nanmax(shown.height, initial=0.0) or 1.0
    end = min(np.pi, max(np.pi / 2, 1.03 * reach))
    return (f'<h2>{say("family.tops.rolls")}</h2>{plane(shown, mu_s)}'
            f'<h2>{say("family.tops.surface")}</h2>{waterfall(shown, end, most)}')  # fmt: skip
