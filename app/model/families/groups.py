"""The groups of tops over a/R and I1/I3, as in Thresholds of tippe_core: what friction can do to a top."""

Corners = tuple[tuple[float, ...], tuple[float, ...]]


def areas(left: float, right: float, low: float, high: float) -> dict[str, Corners]:
    """{group: (a, I1/I3) of the corners of its area} in a picture with left <= a <= right, low <= I1/I3 <= high and
    left < 0 < right; a corner may lie below low.

    The borders are where upright spinning (I1/I3 = 1 - a) and inverted spinning (1 + a) become stable at all spins or
    at none.
    """
    return {
        "never rises": ((0, 0, right, right), (low, 1, 1 - right, low)),
        "can invert": ((0, right, right), (1, 1 + right, 1 - right)),
        "rises part of the way": ((0, 0, right, right), (1, high, high, 1 + right)),
        "can stand upright": ((left, left, 0, 0), (low, 1 - left, 1, low)),
        "never stands upright": ((left, left, 0, 0), (1 - left, high, high, 1)),
    }
