"""The one judge of how a motion ended, from what happened in the last tenth of its time: for one motion
(endings.py) and for many (motion/many.py)."""

import numpy as np

LAST = 0.1  # the last fraction of the time, by which the end is judged
UPRIGHT, LEANS = 0.2, 0.05  # rad: closer than this to a pole; the tilt changes by less than this


def judged(refused: bool, on: str, least: float, most: float, rolls: bool) -> str:
    """The word for the end, in this order: "refused", "stem" (on its stem alone), "upright" (on its ball, theta < 0.2),
    "inverted" (on its ball, theta > pi - 0.2), "leaning" (theta constant within 0.05 rad), "rolling", "moving".

    on: the support throughout, "" if it changes. least, most: the range of theta, rad, least > most if it ended
    before. rolls: whether it never slips.
    """
    if refused:
        return "refused"
    if on == "stem":
        return "stem"
    if on == "ball" and most < UPRIGHT:
        return "upright"
    if on == "ball" and least > np.pi - UPRIGHT:
        return "inverted"
    if 0 <= most - least < LEANS:
        return "leaning"
    return "rolling" if rolls else "moving"
