"""The path of the contact point of a rolling top, from the series of its velocity."""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from ..types import Array, Complex
from .phase import cis
from .series import part_turn


class Path(NamedTuple):
    """For the path of the contact point: the rotation rate, per unit of phase, of the axes in which its velocity is
    periodic; the slowest rate of its terms in space, and the amplitude of that term; the displacement by the constant
    term; and dt/dtau."""

    rate: float
    slow: float
    amplitude: float
    still: float
    scale: float


class Track(NamedTuple):
    """The series that a Path needs, (1, K) each: of the real part, and minus that of the imaginary part."""

    sines: Array
    cosines: Array
    path: Path


@compiled
def path(turns: Array, half: Array, rest: Array, Y_re: Array, Y_im: Array, of: Path, d_phi: float) -> Complex:
    """(n,): the contact point at the phases, from the sums of its series (n,), all rotated by d_phi."""
    contact = np.empty(len(rest), np.complex128)
    turned = of.scale * cis(d_phi)
    before, whole, periods = np.nan, turned, turned
    for i in range(len(rest)):
        tau = np.pi * half[i] + rest[i]
        if turns[i] != before:
            before = turns[i]
            part = np.pi * part_turn(turns[i], of.slow)
            whole = turned * cis(2 * part)
            # the one term of the velocity that may rotate very slowly, over whole periods
            periods = turned * (2 * cis(part) * np.sin(part) / of.slow if of.slow else 2 * np.pi * turns[i] + 0j)
        x = of.slow * tau / 2
        along = periods + whole * tau * cis(x) * (np.sin(x) / x if x else 1.0)
        contact[i] = whole * cis(of.rate * tau) * complex(Y_re[i], -(Y_im[i] + of.still)) + of.amplitude * along
    return contact
