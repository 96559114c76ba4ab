"""The fit of a Model to Data: least squares from several starting points, the errors, and what the data do not
determine."""

import itertools
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import chi2 as chi_square
from scipy.stats import norm

from app.model.measured.data import Data, are_handed
from app.model.measured.known import RISE, Known, known
from app.model.measured.motion import BODY, BOUNDS, NO_MOTION, START, Model, Residuals, residuals_of, shifted
from app.model.measured.starts import around, scattered, starts
from app.model.runs import look
from tippe_core import Constants, TopError
from tippe_core.types import Array

STEP = 1e-4  # relative to a parameter, or to its typical size: the step of central differences
SIZES = {"tilt": 0.1, "tilt_rate": 0.3, "across": 0.3, "spin": 3.0, "rolling_resistance": 1e-3, "air_drag": 1e-3}
STARTS = 6  # points of the grid from which the fit starts
FOLLOWED = 10  # scattered starting points, if those do not lead to a good fit
ROUNDS = 3  # of starting points around the best, if no fit is good
AGREEING, SAME = 3, 1e-3  # this many fits that end within SAME of the same chi-square show that it is the minimum
ALSO = RISE  # other minima whose chi-square is at most this much larger are as good: two standard errors
MOST_BETTER = 3  # how often following a valley may lead to a better minimum
ALL = slice(None)
GROWING = (0.25, 0.5, 0.75)  # fractions of the time that are fitted one after the other
TOGETHER = 0.95  # correlation above which two parameters are said to be correlated
REFUSED = 1e-3  # significance level: a correct model is rejected this often
FAR = 6.0  # standard errors: a value that is farther off was hardly measured right
FEW = 0.1  # of the values: if more are far off, it is the model that is wrong
AT_END = 0.01  # of its value: a number so close to its bound was decided by it
CLEARLY = 6.0  # difference in AIC above which one model is said to be better
WRONG = 10.0  # times the number of values: of a larger chi-square, a rise by 4 means nothing
WORSE = 50.0  # times the chi-square of the other: a model that stays as bad from its first starts is given up

End = tuple[float, Array]
"""(chi-square, parameters) where a search ended."""


@dataclass(frozen=True, eq=False)
class Fit:
    """model: with the best parameters. sides: one standard error of each free parameter, downwards and upwards, inf if
    chi-square never rises enough; covariance: (k, k), from the curvature of chi-square. runs: {quantity: the deviation
    of the number of runs of one sign from its expectation, in standard errors}. unknown: free parameters that the data
    do not determine. sure: whether this is certainly the global minimum, because the fit is good or several starts
    ended here."""

    model: Model
    sides: dict[str, tuple[float, float]]
    covariance: Array
    residuals: Residuals
    hidden: int
    runs: dict[str, float]
    unknown: tuple[str, ...]
    sure: bool
    given_up: bool = False

    @property
    def errors(self) -> dict[str, float]:
        """The standard error of each free parameter, the larger of the two sides."""
        return {name: max(both) for name, both in self.sides.items()}

    @property
    def chi2(self) -> float:
        """Chi-square of all residuals."""
        return float(self.residuals.row @ self.residuals.row)

    @property
    def chi2_of(self) -> dict[str, tuple[float, int]]:
        """{quantity: (chi-square, number of values)}."""
        return {name: (float(row @ row), len(row)) for name, row in self.residuals.of.items()}

    @property
    def freedom(self) -> int:
        """The number of degrees of freedom."""
        return max(len(self.residuals.row) - len(self.model.free) - self.hidden, 1)

    @property
    def aic(self) -> float:
        """Akaike's information criterion; the smaller the better."""
        return self.chi2 + 2 * (len(self.model.free) + self.hidden)

    @property
    def refused(self) -> bool:
        """Whether the data reject the model, by chi-square or by residuals that change sign too rarely."""
        seldom = norm.ppf(REFUSED / (2 * len(self.runs)))
        return bool(chi_square.sf(self.chi2, self.freedom) < REFUSED or min(self.runs.values()) < seldom)

    @property
    def too_good(self) -> float:
        """How many times too large the errors of the values are, if chi-square is too small for chance, else 0."""
        small = chi_square.cdf(self.chi2, self.freedom) < REFUSED
        return float(np.sqrt(self.freedom / max(self.chi2, 1e-12))) if small else 0.0

    @property
    def far(self) -> dict[str, tuple[int, ...]]:
        """{quantity: which of its values are more than FAR errors off}, if they are few."""
        found = {name: tuple(map(int, np.flatnonzero(np.abs(row) > FAR))) for name, row in self.residuals.of.items()}
        few = 0 < sum(map(len, found.values())) <= FEW * len(self.residuals.row)
        return {name: at for name, at in found.items() if at} if few else {}

    @property
    def bounded(self) -> dict[str, float]:
        """{parameter: the bound that decided its value}."""
        found = {}
        for name in self.model.free:
            value = self.model.values[name]
            for bound in BOUNDS[name]:
                if abs(value - bound) <= AT_END * abs(bound) or (bound == 0 and value < 1e-6):
                    found[name] = bound
        return found

    @property
    def handed(self) -> bool:
        """Whether the data tell the motion from its mirror image; otherwise spin is positive."""
        return are_handed(self.residuals.of)

    @property
    def correlation(self) -> Array:
        """The correlation matrix (k, k), in the order of the free parameters."""
        size = np.sqrt(np.diag(self.covariance))
        return self.covariance / np.outer(size, size)

    @property
    def together(self) -> tuple[tuple[str, str, float], ...]:
        """(one, other, correlation) of strongly correlated parameters."""
        pairs = itertools.combinations(enumerate(self.model.free), 2)
        all_of = ((one, other, float(self.correlation[i, j])) for (i, one), (j, other) in pairs)
        return tuple(pair for pair in all_of if abs(pair[2]) > TOGETHER)

    @property
    def constants(self) -> dict[str, tuple[float, float]]:
        """{K_J, K_R, E: (value at the start, standard error)}."""
        slopes = []
        for name in self.model.free:
            step = STEP * max(abs(self.model.values[name]), SIZES.get(name, 0.0))
            high, low = (_constants(self.model.with_values({name: self.model.values[name] + way * step}))
                         for way in (1, -1))  # fmt: skip
            slopes.append((high - low) / (2 * step))
        errors = np.sqrt(np.diag(np.array(slopes).T @ self.covariance @ np.array(slopes)))
        found = zip(_constants(self.model).tolist(), errors.tolist(), strict=True)
        return dict(zip(("K_J", "K_R", "E"), found, strict=True))


def _constants(model: Model) -> Array:
    top = type(model.top)(*(model.values[name] for name in BODY))
    found = Constants.from_state(top, *(model.values[name] for name in START))
    return np.array([found.K_J, found.K_R, found.E], dtype=float)


def fit(model: Model, data: Data) -> Fit:
    """The best Fit of the model's free parameters. It can be stopped. Raises TopError if there is no motion for any of
    the starting points."""
    return _ended(*_begun(model, data))


def fit_both(models: tuple[Model, Model], data: Data) -> tuple[Fit, Fit]:
    """The best Fit of each; a model whose first starts all end WORSE times higher than the other's is given up."""
    first = _begun(models[0], data)
    second = _begun(models[1], data, _lowest(first[1]))
    if _lowest(first[1]) <= _lowest(second[1]):
        best = _ended(*first)
        return best, _ended(*second, best.chi2)
    best = _ended(*second)
    return _ended(*first, best.chi2), best


def _begun(model: Model, data: Data, rival: float = math.inf) -> tuple["Problem", list[End]]:
    """(the Problem, where its first starts end): AGREEING of them if they show that the model is to be given up."""
    problem = Problem(model, data)
    if (count := problem.count) <= len(model.free) + shifted(data):
        raise TopError("values", count, "more than {least} measured values", "Free fewer numbers, or measure more.",
                       code="too-few-values", least=len(model.free) + shifted(data))  # fmt: skip
    ends: list[End] = []
    for x in problem.best_of(starts(model, data), STARTS, problem.beginning(GROWING[0])):
        ends.append(problem.grown(x))
        if len(ends) >= AGREEING and problem.is_worse(_lowest(ends), rival):
            break
    return problem, ends


def _ended(problem: "Problem", ends: list[End], rival: float = math.inf) -> Fit:
    """The best Fit, from where the first starts ended and, if need be, from more."""
    if problem.is_worse(_lowest(ends), rival):
        return _judged(problem, min(ends, key=lambda end: end[0])[1], False, [], given_up=True)
    if not _settled(ends, problem):
        # The beginning hardly depends on the friction law, so the fit of it may have gone astray: fit the whole motion.
        # A rolling motion has no law, and over the whole of it hardly a start leads to the right number of turns.
        search = problem.grown if problem.model.name == "rolling" else problem.followed
        for x in problem.best_of(scattered(problem.model, problem.data), FOLLOWED):
            ends.append(search(x))
            if _settled(ends, problem):
                break
    best, x = _least(ends, problem)
    for _ in range(ROUNDS):
        if problem.good(best) or _alike(ends) >= AGREEING:
            break
        # No fit is good, so there may be a better minimum: check whether starts around the best lead back to it.
        for y in problem.best_of(around(x, problem.sizes), FOLLOWED):
            ends.append(problem.followed(y, 60))
            if _alike(ends) >= AGREEING:
                break
        best, x = _least(ends, problem)
    sure = problem.good(best) or _alike(ends) >= AGREEING
    return _judged(problem, x, sure, [x for chi2, x in ends if chi2 < best + ALSO])


def _lowest(ends: list[End]) -> float:
    """The smallest chi-square."""
    return min(chi2 for chi2, _ in ends)


def _least(ends: list[End], problem: "Problem") -> End:
    """The best of the ends, refined to full accuracy."""
    at = min(range(len(ends)), key=lambda i: ends[i][0])
    ends[at] = problem.followed(ends[at][1], 60, exactly=True)
    return ends[at]


def _alike(ends: list[End]) -> int:
    """How many starts ended at the smallest chi-square."""
    least = _lowest(ends)
    return sum(chi2 < least + max(0.1, SAME * least) for chi2, _ in ends)


def _settled(ends: list[End], problem: "Problem") -> bool:
    """Whether the search can end: the fit is good, and more than one start ended there, since a good fit alone may be
    false."""
    return problem.good(_lowest(ends)) and _alike(ends) > 1


class Problem:
    """Least squares for the free parameters of a Model, in their order."""

    def __init__(self, model: Model, data: Data) -> None:
        self.model, self.data = model, data
        self.count = sum(len(series.t) for series in data.series.values())
        self.bounds = np.array([BOUNDS[name] for name in model.free]).T
        self.sizes = np.array([SIZES.get(name, 0.1 * max(abs(model.values[name]), 0.01)) for name in model.free])

    def residuals(self, x: Array) -> Array:
        """All residuals in units of their standard errors, (n,)."""
        look()
        values = dict(zip(self.model.free, map(float, x), strict=True))
        try:
            row = residuals_of(self.model.with_values(values), self.data).row
        except TopError:
            return np.full(self.count, NO_MOTION)
        return np.nan_to_num(row, nan=NO_MOTION, posinf=NO_MOTION, neginf=-NO_MOTION)

    def slopes(self, x: Array) -> Array:
        """The Jacobian of the residuals, (n, k)."""
        columns = []
        for i, size in enumerate(np.maximum(STEP * np.abs(x), STEP * self.sizes)):
            low, high = x.copy(), x.copy()
            low[i], high[i] = max(x[i] - size, self.bounds[0, i]), min(x[i] + size, self.bounds[1, i])
            columns.append((self.residuals(high) - self.residuals(low)) / (high[i] - low[i]))
        return np.array(columns).T

    def best_of(self, starts: list[Array], most: int, row: Array | slice = ALL) -> list[Array]:
        """The starting points with the smallest sums of squares, the best first."""
        inside = [np.clip(x, self.bounds[0] + 1e-6, self.bounds[1] - 1e-6) for x in starts]
        return sorted(inside, key=lambda x: float(np.sum(self.residuals(x)[row] ** 2)))[:most]

    def beginning(self, share: float) -> Array:
        """Which values belong to this share of the time."""
        t = np.concatenate([series.t for series in self.data.series.values()])
        return np.asarray(t <= t.min() + share * np.ptp(t))

    def grown(self, x: Array) -> End:
        """Where the fit of the whole motion ends if its beginning is fitted first: over a whole motion, with its many
        turns, there are many false minima."""
        for share in GROWING:
            x = self.followed(x, 12, self.beginning(share))[1]
        return self.followed(x)

    def followed(self, x: Array, steps: int = 25, row: Array | slice = ALL, exactly: bool = False) -> End:
        """(chi-square, parameters) at the end of a least-squares fit from x."""
        narrow = {"xtol": 1e-10, "ftol": 1e-10} if exactly else {}
        found = least_squares(lambda x: self.residuals(x)[row], x, lambda x: self.slopes(x)[row], self.bounds,
                              x_scale=self.sizes, max_nfev=steps, **narrow)  # fmt: skip
        return 2 * float(found.cost), self._righted(found.x)

    def _righted(self, x: Array) -> Array:
        """Where the data cannot tell a motion from its mirror image, the one of the two with a positive spin."""
        at = self.model.free.index("spin") if "spin" in self.model.free else None
        if at is None or x[at] >= 0 or self.data.handed:
            return x
        return x * np.array([-1.0 if name in ("spin", "across") else 1.0 for name in self.model.free])

    def good(self, chi2: float) -> bool:
        """Whether a chi-square is no larger than chance allows."""
        return chi2 < self.count + np.sqrt(2 * self.count)

    def is_worse(self, chi2: float, rival: float) -> bool:
        """Whether a chi-square is WORSE times that of another model and of a right one; not if no start is a motion."""
        return chi2 > WORSE * max(rival, self.count) and not math.isclose(chi2, self.count * NO_MOTION**2)


def _judged(problem: "Problem", x: Array, sure: bool, others: list[Array], given_up: bool = False) -> Fit:
    model, data, names = problem.model, problem.data, problem.model.free
    far_off = given_up or np.sum(problem.residuals(x) ** 2) > WRONG * problem.count
    found = Known.of_curvature(problem, x) if far_off else known(problem, x)
    for _ in range(MOST_BETTER):
        if found.better is None:
            break
        _, x = problem.followed(found.better, 60, exactly=True)
        found = known(problem, x)
    model = model.with_values(dict(zip(names, map(float, x), strict=True)))
    residuals = residuals_of(model, data)
    tells = found.tells(x, problem.bounds)
    for other in others:  # equally good minima outside the valley around the best one
        tells = np.all([tells, other > x - 2 * found.below, other < x + 2 * found.above], axis=0)
    sides = {name: (float(below), float(above))
             for name, below, above in zip(names, found.below, found.above, strict=True)}  # fmt: skip
    return Fit(model, sides, found.covariance, residuals, shifted(data),
               {name: runs(row) for name, row in residuals.of.items()},
               tuple(name for name, so in zip(names, tells, strict=True) if not so), sure, given_up)  # fmt: skip


def runs(row: Array) -> float:
    """The deviation of the number of runs of one sign from its expectation, in standard errors (Wald and Wolfowitz);
    negative if there are too few, that is, if the residuals have a trend."""
    above = row > 0
    n, m = int(above.sum()), int((~above).sum())
    count = 1 + int(np.count_nonzero(above[1:] != above[:-1]))
    if min(n, m) == 0:
        return 0.0 if len(row) < 8 else -float(np.sqrt(len(row)))
    mean = 2 * n * m / (n + m) + 1
    spread = (mean - 1) * (mean - 2) / (n + m - 1)
    return float((count - mean) / np.sqrt(spread)) if spread > 0 else 0.0


def verdict(rolling: Fit, sliding: Fit) -> str:
    """A key of [found] in measure.toml: "rolled", "slipped", "neither", "either" if the data cannot decide, or "unsure"
    if a rejected fit may not be the best one."""
    if any(fit.refused and not (fit.sure or fit.given_up) for fit in (rolling, sliding)):
        return "unsure"
    if rolling.refused and sliding.refused:
        return "neither"
    if rolling.refused or sliding.refused:
        return "slipped" if rolling.refused else "rolled"
    difference = rolling.aic - sliding.aic
    if abs(difference) < CLEARLY:
        return "either"
    return "slipped" if difference > 0 else "rolled"
