"""Everything that is computed from a film's data: both fits, the constants of the motion, and the better motion."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from app.model.measured.cells import MeasuredError
from app.model.measured.data import Data
from app.model.measured.fit import Fit, fit_both
from app.model.measured.kept import Kept, kept
from app.model.measured.motion import Model, model_of
from app.model.measured.remembered import remembered
from app.model.measured.shown import Shown, shown
from tippe_core import Scales, Shape, Top

LOOSE = {"body": ("a", "I1", "I3"), "push": ("tilt_rate", "across"), "losses": ("rolling_resistance", "air_drag")}
"""What can be fitted in addition to the start and the friction law."""
LONGEST = 60.0
"""s that are fitted at once: a run of this length takes a tenth of a second, and a fit needs thousands of runs."""


@dataclass(frozen=True, eq=False)
class Found:
    """rolling and sliding: fits to the same data. kept: whether the constants of the motion were conserved. motion:
    that of the better fit."""

    rolling: Fit
    sliding: Fit
    kept: dict[str, Kept]
    motion: Shown

    @property
    def fits(self) -> tuple[Fit, Fit]:
        """(rolling, sliding)."""
        return self.rolling, self.sliding

    @property
    def better(self) -> Fit:
        """The fit with the smaller AIC."""
        return min(self.fits, key=lambda each: each.aic)


def models(top: Top, scales: Scales, shape: Shape | None, law: str, loose: tuple[str, ...]) -> tuple[Model, Model]:
    """The rolling Model, and the sliding one with this friction law; loose: keys of LOOSE. Rolling has neither losses
    nor a push."""
    of_rolling = tuple(name for name in loose if name in LOOSE["body"])
    return model_of("rolling", top, scales, shape, of_rolling), model_of(law, top, scales, shape, loose)


def part_of(data: Data, start: float, end: float) -> Data:
    """The part of the data to be fitted. Raises MeasuredError if it is too short or too long."""
    try:
        if end - start <= LONGEST:
            return data.between(start, end)
    except MeasuredError:
        if np.ptp(data.t) <= LONGEST:
            raise
    raise MeasuredError("too-long", start=start, end=end, most=LONGEST)


def found(data: Data, both: tuple[Model, Model]) -> Found:
    """Fits both Models; takes seconds and can be stopped. Raises TopError."""
    return _of_both(data, *fit_both(both, data))


def found_again(data: Data, both: tuple[Model, Model], fits: tuple[dict[str, Any], ...]) -> Found:
    """The Found of a saved film, without fitting again. Raises TopError."""
    return _of_both(data, *(remembered(model, data, stored) for model, stored in zip(both, fits, strict=True)))


def _of_both(data: Data, rolling: Fit, sliding: Fit) -> Found:
    better = min((rolling, sliding), key=lambda each: each.aic)
    return Found(rolling, sliding, kept(data, better.model.top, better.model.scales), shown(better.model, data))
