"""The motions that the tests share: ordinary ones and the places where something goes through zero."""

from dataclasses import dataclass
from functools import cache

from high_precision import Curve, mp, mpf

from tippe_core import Constants, Top, pole_constants

PAPER = Top.paper()
TWO_WELLS = Top(a=-1.891, I1=1.105, I3=0.196)
ORDINARY = Top(a=-10.0, I1=30.0, I3=10.0)
BALL = Top(a=0.0, I1=0.4, I3=0.4)
LOADED = Top(a=0.3, I1=131 / 350, I3=0.4)
TOPS = {"paper": PAPER, "two wells": TWO_WELLS, "ordinary": ORDINARY, "ball": BALL, "loaded": LOADED}


@dataclass(frozen=True)
class Case:
    """A motion: its top, K_J, K_R, and how far its energy lies above the bottom of its well (in MgR)."""

    top: Top
    K_J: float
    K_R: float
    rise: float
    well: int = 0  # by depth, for `rise`
    row: int = 0  # of turning_points, from theta = 0 on

    @property
    def curve(self):
        return _curve(self)

    @property
    def interval(self):
        """(inner, outer) in fifty digits."""
        return _intervals(self)[self.row]

    @property
    def constants(self):
        return Constants(self.K_J, self.K_R, float(self.curve.E))

    @property
    def period(self):
        """To some nine figures: it only says where to look."""
        return _period(self)


@cache
def _curve(case):
    curve = Curve(case.top, case.K_J, case.K_R)
    steady = curve.steady()
    # for trajectories through a pole, the minimum of U is at the pole itself, or at the grid point closest to it
    bottom = curve.U(steady[case.well]) if steady else min(curve.U(x) for x in curve.grid())
    return curve.at(float(curve.energy_of(bottom) + mpf(case.rise)))


@cache
def _intervals(case):
    return case.curve.turning_points()


@cache
def _period(case):
    with mp.workdps(20):
        return float(case.curve.period(*case.interval))


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
    "P": (PAPER, _P, 10.0, 2.0),
    "P, K_R < 0": (PAPER, -_P, -10.0, 5.0),
    "inverted pole": (PAPER, _INVERTED, 10.0, 3.0),
    "P of the ordinary top": (ORDINARY, pole_constants(ORDINARY, 60.0)[0], 60.0, 4.0),
    "inverted ordinary top": (ORDINARY, pole_constants(ORDINARY, 20.0)[1], 20.0, 1.0),
    "P of the ball": (BALL, pole_constants(BALL, 4.0)[0], 4.0, 1.0),
    "rocking through the pole": (PAPER, 0.0, 0.0, 0.05),
    "tumbling through both poles": (PAPER, 0.0, 0.0, 0.6),
}


def digits(x):
    """A fifty-digit number for a long double."""
    return mp.nstr(x, 25)
