"""The fixture with which a test gives evidence for a row of docs/validation.md."""

import numpy as np
import pytest
from claims import section


@pytest.fixture
def compare(request):
    """compare(row, got, expected, within, against, scale=1) asserts |got - expected|/scale <= within and records it."""

    def compare(row, got, expected, within, against, scale=1.0):
        section(row)  # fails if the page has no such row
        difference = np.abs(np.asarray(got, dtype=float) - np.asarray(expected, dtype=float)) / scale
        largest = float(np.max(difference))
        assert largest <= within, f"{row}: {largest:.3g} > {within:.3g}, against {against}"
        request.node.user_properties.append(("evidence", (row, largest, within, against)))

    return compare
