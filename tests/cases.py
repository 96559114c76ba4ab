"""The motions that the tests share: ordinary ones and the places where something goes through zero."""

from dataclasses import dataclass
from functools import cache

from high_precision import Curve, mp, mpf
from references import kept

from tippe_core import Constants, Top, pole_constants

PAPER = Top.paper()
TWO_WELLS = Top(a=-1.891, I1=1.105, I3=0.196)
ORDINARY = Top(a=-10.0, I1=30.0, I3=10.0)
BALL = Top(a=0.0, I1=0.4, I3=0.4)
LOADED = Top(a=0.3, I1=131 / 350, I3=0.4)
TOPS = {"paper": PAPER, "two wells": TWO_WELLS, "ordinary": ORDINARY, "ball": BALL, "loaded": LOADED}


AT_A_POLE = -1


@dataclass(frozen=True)
class Case:
    """A motion: its top, K_J, K_R, and how far its energy lies above the bottom of its well (in MgR)."""

    top: Top
    K_J: float
    K_R: float
    rise: float
    well: int = 0  # by depth, for `rise`, or AT_A_POLE
    row: int = 0  # of turning_points, from theta = 0 on

    @property
    def curve(self):
        return _found(self)[0]

    @property
    def intervals(self):
        """[(inner, outer)] in fifty digits."""
        return _found(self)[1]

    @property
    def interval(self):
        return self.intervals[self.row]

    @property
    def constants(self):
        return Constants(self.K_J, self.K_R, float(self.curve.E))

    @property
    def period(self):
        """To some nine figures: it only says where to look."""
        return float(_found(self)[2][self.row])

    @property
    def steady(self):
        """Where U has its minima, to a float's digits."""
        return _found(self)[3]

    @property
    def exact_period(self):
        return _times(self)[0]

    @property
    def third(self):
        """(theta at a third of the way out, when the top is there) in fifty digits."""
        return _times(self)[1:]


def _text(x):
    return mp.nstr(x, 60)


@kept
def case_in_digits(top, K_J, K_R, rise, well):
    """(E; the turning points as text; the period of each two, roughly; the minima of U)."""
    curve = Curve(top, K_J, K_R)
    steady = curve.steady()
    # for trajectories through a pole, the minimum of U is at the pole itself, or at the grid point closest to it
    bottom = curve.U(steady[well]) if steady and well != AT_A_POLE else min(curve.U(x) for x in curve.grid())
    curve = curve.at(float(curve.energy_of(bottom) + mpf(rise)))
    rows = curve.turning_points()
    with mp.workdps(20):
        periods = [float(curve.period(*row)) for row in rows]
    return float(curve.E), [[_text(x) for x in row] for row in rows], periods, [float(x) for x in steady]


@kept
def times_in_digits(top, K_J, K_R, E, inner, outer):
    """(the period, a third of the way out, when the top is there) as text, from turning points as text."""
    curve, inner, outer = Curve(top, K_J, K_R, E), mpf(inner), mpf(outer)
    theta = inner + (outer - inner) / 3
    return tuple(_text(x) for x in (curve.period(inner, outer), theta, curve.time(inner, outer, theta)))


@cache
def _found(case):
    E, rows, periods, steady = case_in_digits(case.top, case.K_J, case.K_R, case.rise, case.well)
    return Curve(case.top, case.K_J, case.K_R, E), [tuple(mpf(str(x)) for x in row) for row in rows], periods, steady


@cache
def _times(case):
    curve, inner_and_outer = case.curve, map(_text, case.interval)
    found = times_in_digits(case.top, case.K_J, case.K_R, float(curve.E), *inner_and_outer)
    return tuple(mpf(str(x)) for x in found)


_P, _INVERTED = pole_constants(PAPER, 10.0)

CASES = {
    "K_J = 7": Case(PAPER, 7.0, 10.0, 0.5),
    "past the equator": Case(PAPER, 0.5, 10.0, 1.0),
    "K_J < 0": Case(PAPER, -3.0, 10.0, 0.5),
    "K_R < 0": Case(PAPER, 5.0, -10.0, 0.5),
    "both < 0": Case(PAPER, -6.0, -10.0, 0.8),
    "past P": Case(PAPER, 9.0, 10.0, 0.4),
    "large energy": Case(PAPER, 4.0, 10.0, 40.0),
    "nearly steady": Case(PAPER, 6.0, 10.0, 1e-6),
    "no Routh": Case(PAPER, 2.0, 0.0, 0.3),
    "no Jellett": Case(PAPER, 0.0, 10.0, 0.3),
    "deep well": Case(TWO_WELLS, 3.9525, 14.85, 0.5, well=0, row=0),
    "shallow well": Case(TWO_WELLS, 3.9525, 14.85, 0.5, well=1, row=0),
    "deep well beside the shallow": Case(TWO_WELLS, 3.9525, 14.85, 0.5, well=1, row=1),
    "merged wells": Case(TWO_WELLS, 3.9525, 14.85, 1.5, well=1),
    "just merged": Case(TWO_WELLS, 3.9525, 14.85, 1.43, well=1),
    "ordinary": Case(ORDINARY, 12.0, 25.0, 3.0),
    "ordinary, back": Case(ORDINARY, -8.0, 40.0, 8.0),
    "ball": Case(BALL, 2.0, 5.0, 0.7),
    "loaded": Case(LOADED, 3.0, 6.0, 0.4),
    "next to P": Case(PAPER, _P - 1e-3, 10.0, 4.0),
    "beyond P": Case(PAPER, _P + 1e-6, 10.0, 4.0),
    "a hair from P": Case(PAPER, _P - 1e-10, 10.0, 2.0),
    "next to the inverted pole": Case(PAPER, _INVERTED + 1e-5, 10.0, 2.0),
}

POLES = {
    "P": Case(PAPER, _P, 10.0, 1.0, AT_A_POLE),
    "P, K_R < 0": Case(PAPER, -_P, -10.0, 2.5, AT_A_POLE),
    "inverted pole": Case(PAPER, _INVERTED, 10.0, 1.5, AT_A_POLE),
    "P of the ordinary top": Case(ORDINARY, pole_constants(ORDINARY, 60.0)[0], 60.0, 2.0, AT_A_POLE),
    "inverted ordinary top": Case(ORDINARY, pole_constants(ORDINARY, 20.0)[1], 20.0, 0.5, AT_A_POLE),
    "P of the ball": Case(BALL, pole_constants(BALL, 4.0)[0], 4.0, 0.5, AT_A_POLE),
    "rocking through the pole": Case(PAPER, 0.0, 0.0, 0.025, AT_A_POLE),
    "tumbling through both poles": Case(PAPER, 0.0, 0.0, 0.3, AT_A_POLE),
}


def digits(x):
    """A fifty-digit number for a long double."""
    return mp.nstr(x, 25)
