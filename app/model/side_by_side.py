"""What the page says of one start on several tables together."""

from collections.abc import Mapping
from math import ceil

import numpy as np

from app.model.events import first_times
from app.model.phases import SIDE
from app.model.pushes import size_words
from app.model.run import TableMotion
from app.text import say
from tippe_core.types import Number

SMALL, NEAR = 0.005, 10.0  # the share of its energy that is not worth a word; degrees


def of_all(motions: Mapping[str, TableMotion]) -> tuple[str, str]:
    """The headline and the explanation of one start on several tables, {table: its motion}."""
    quiet = {name: motion for name, motion in motions.items() if name != "ordinary"}
    over = "ordinary" in motions and "over" in first_times(motions["ordinary"])
    pushes = [push for motion in motions.values() for push, *_ in motion.pushes]
    turned = over and not pushes and len(quiet) == 2 and all(motion.tilt.max() < SIDE for motion in quiet.values())
    wording = [say("lab.three.why")]
    if pushes:
        wording.append(say("lab.three.pushed", time=pushes[-1].t, size=size_words(pushes[-1])))
    elif "rough" in quiet:
        first = quiet["rough"].curves[0]
        lost, start = float(first[4]), float(first[3] + first[4])
        wording.append(say(f"lab.three.{'grip' if lost > SMALL * start else 'keep'}", lost=lost, start=start))
    if len(quiet) == 2:
        ends: dict[str, Number] = {f"{name}_{end}": float(getattr(motion.tilt, of)()) for name, motion in quiet.items()
                for end, of in (("low", "min"), ("high", "max"))}  # fmt: skip
        near = all(np.ptp(motion.tilt) < NEAR for motion in quiet.values())
        ends |= {f"{name}_by": ceil(10 * float(np.abs(motion.tilt - motion.tilt[0]).max()) or 1) / 10
                 for name, motion in quiet.items()}  # fmt: skip
        wording.append(say(f"lab.three.{'near' if near else 'far'}", **ends))
    return say(f"lab.three.{'turned' if turned else 'headline'}"), " ".join(wording)
