"""How much a motion with friction depends on its start."""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..errors import TopError, checked, finite
from ..paper.constants import State
from ..paper.top import Top
from ..types import Number
from . import preparing
from .friction import Friction
from .records import Record
from .sliding import slide
from .trajectory import Trajectory


@checked
def sensitivity(
    top: Top, state: State, friction: Friction, times: ArrayLike, nudge: float = 1e-6, **how: Number
) -> float:
    """How much a small change of the initial theta grows: the largest change of theta divided by it.

    The result is large where the motion itself is sensitive, whatever the tolerance: near the limits of sticking and of
    lift-off, or near a threshold spin. If the nudge changes the events, only its effect on theta counts.

    Parameters
    ----------
    top, state, friction, times
        as in slide()
    nudge : float
        the change of theta in rad, not 0; it is towards theta = 1 rad
    **how
        the other arguments of slide()

    Returns
    -------
    float
        a factor, without a unit

    Raises
    ------
    TopError
        as slide(); for nudge = 0
    """
    nudge = checked_nudge(nudge)
    moved = slide(top, state, friction, times, **how)
    P = preparing.problem(top, friction, preparing.checked_edge(how.get("edge")), (0.0, 0.0), 1e-9)
    return growth(moved, slide(top, as_high(state, beside(state, nudge), P), friction, times, **how), nudge)


def checked_nudge(nudge: float) -> float:
    """nudge, or a TopError if it is out of range."""
    if finite("nudge", nudge) == 0:
        raise TopError("nudge", nudge, "nudge != 0")
    return float(nudge)


@checked
def beside(state: State, nudge: float) -> State:
    """The State with a larger theta, or a smaller one if theta is 1 rad or more.

    Parameters
    ----------
    state : State
        of one motion
    nudge : float
        the change of theta, rad

    Returns
    -------
    State
        with the other fields as they are
    """
    return replace(state, theta=state.theta + (nudge if state.theta < 1 else -nudge))


def as_high(state: State, near: State, P: Record) -> State:
    """near; if the State is in flight, as high above the table as that."""
    if state.z is None:
        return near
    return replace(near, z=state.z + preparing.height(P, near.theta) - preparing.height(P, state.theta))


@checked
def growth(moved: Trajectory, near: Trajectory, nudge: float) -> float:
    """The largest factor by which the difference between two motions grows, over the times that both have.

    Parameters
    ----------
    moved, near : Trajectory
        of a State, and of that beside() it
    nudge : float
        the difference between their starts, rad

    Returns
    -------
    float
        without a unit
    """
    both = min(len(moved.t), len(near.t))
    return float(np.abs(moved.theta[:both] - near.theta[:both]).max(initial=0.0) / abs(nudge))
