"""The groups of tops over a/R and I1/I3, which tell what friction can do to a top, as Thresholds of tippe_core."""

Corners = tuple[tuple[float, ...], tuple[float, ...]]


def areas(left: float, right: float, low: float, high: float) -> dict[str, Corners]:
    """{group: (a, I1/I3) of the corners of its area} in a picture with left <= a <= right, low <= I1/I3 <= high and
    left < 0 < right; a corner may lie below low.

    They meet where spinning upright, at I1/I3 = 1 - a, and inverted, at 1 + a, is stable at no spin or at any.
    """
    return {
        "never rises": ((0, 0, right, right), (low, 1, 1 - right, low)),
        "can invert": ((0, right, right), (1, 1 + right, 1 - right)),
        "rises part of the way": ((0, 0, right, right), (1, high, high, 1 + right)),
        "can stand upright": ((left, left, 0, 0), (low, 1 - left, 1, low)),
        "never stands upright": ((left, left, 0, 0), (1 - left, high, high, 1)),
    }
