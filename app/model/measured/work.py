"""What is found of a film's data: both models fitted, the constants of the motion, and the better motion."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from app.model.measured.data import Data, settled
from app.model.measured.examples import FILMED, FOLDER
from app.model.measured.fit import Fit, fit
from app.model.measured.kept import Kept, kept
from app.model.measured.motion import Model, model_of
from app.model.measured.remembered import remembered
from app.model.measured.shown import Shown, shown
from app.model.measured.table import MeasuredError, read
from tippe_core import Scales, Shape, Top

LOOSE = {"body": ("a", "I1", "I3"), "push": ("tilt_rate", "across"), "losses": ("rolling_resistance", "air_drag")}
"""What can be fitted besides the start and the law."""
LONGEST = 60.0
"""s that are fitted at once: a run of these takes a tenth of a second, and a fit is of thousands."""


@dataclass(frozen=True, eq=False)
class Found:
    """rolling and sliding: of the same data. kept: what the constants of the motion did. motion: the better one's."""

    rolling: Fit
    sliding: Fit
    kept: dict[str, Kept]
    motion: Shown

    @property
    def fits(self) -> tuple[Fit, Fit]:
        """Both."""
        return self.rolling, self.sliding

    @property
    def better(self) -> Fit:
        """The one of less AIC."""
        return min(self.fits, key=lambda each: each.aic)


def models(top: Top, scales: Scales, shape: Shape | None, law: str, loose: tuple[str, ...]) -> tuple[Model, Model]:
    """Rolling, and sliding by this law, with these numbers free as well: rolling has neither losses nor a push."""
    of_rolling = tuple(name for name in loose if name in LOOSE["body"])
    return model_of("rolling", top, scales, shape, of_rolling), model_of(law, top, scales, shape, loose)


def part_of(data: Data, start: float, end: float) -> Data:
    """What is fitted of the data. Raises MeasuredError where that is too little, or too long."""
    try:
        if end - start <= LONGEST:
            return data.between(start, end)
    except MeasuredError:
        if np.ptp(data.t) <= LONGEST:
            raise
    raise MeasuredError("too-long", start=start, end=end, most=LONGEST)


def found(data: Data, both: tuple[Model, Model]) -> Found:
    """Takes seconds, and looks whether it is to end. Raises TopError."""
    return _of_both(data, *(fit(model, data) for model in both))


def found_again(data: Data, both: tuple[Model, Model], fits: tuple[dict[str, Any], ...]) -> Found:
    """What a saved film has, without fitting anew. Raises TopError."""
    return _of_both(data, *(remembered(model, data, said) for model, said in zip(both, fits, strict=True)))


def _of_both(data: Data, rolling: Fit, sliding: Fit) -> Found:
    better = min((rolling, sliding), key=lambda each: each.aic)
    return Found(rolling, sliding, kept(data, better.model.top, better.model.scales), shown(better.model, data))


@lru_cache(maxsize=32)
def found_of_example(name: str, law: str, loose: tuple[str, ...]) -> Found:
    """Of a whole example, which every visitor may ask for."""
    data = settled(read((FOLDER / f"made-{name}.csv").read_bytes()))
    return found(data, models(Top.paper(), FILMED.scales, FILMED, law, loose))
