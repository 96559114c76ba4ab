"""A push: an impulse at a point of the body, and what the table answers.

The impulse F acts at r from G, and is over before the top has moved:

    v += F ,   L += r x F .

A contact that it drives into the table is closed again by a plastic impact (impact.py), during which friction acts by
its law; one that it lifts off opens, and the top may fly.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..errors import TopError, checked, numbers
from ..paper.constants import CLOSED, State
from ..paper.top import Top
from ..types import Array
from . import at as of_y
from . import preparing
from .dynamics import turning
from .friction import Friction
from .kinds import TOUCHES
from .records import Record

STRONGEST = 1e3  # M (gR)^1/2: it moves G of a toy at 400 m/s
RTOL = 1e-9


@checked
def pushed(
    top: Top, state: State, impulse: ArrayLike, at: ArrayLike, friction: Friction, edge: ArrayLike | None = None
) -> State:
    """The State after an impulse at a point of the body, the table answering.

    Orientation and place stay. A contact does not move into the table, which answers with J_z >= 0 and with friction by
    its law; so the energy grows at most by the work of the push. On a table so rough that the top can only roll, grip()
    is to follow; ice is Viscous(0).

    Parameters
    ----------
    top : Top
        the top
    state : State
        on the table or, with z, in flight; vx, vy None mean that G is at rest, as for slide()
    impulse : array_like
        (3,) in M (gR)^1/2, along the axes x, y, z that turn with phi: x is 1', z is up
    at : array_like
        (3,) from the ball's centre O to the point that is pushed, in R, along the same axes
    friction : Coulomb, Viscous, SmoothedCoulomb or Contensou
        the law of the contacts
    edge : array_like or None
        (radius, height above O[, rounding]) of the edge of the stem's end, as for slide()

    Returns
    -------
    State
        with vx and vy; with z and vz where these do not follow from the contact with the table. On the vertical axis
        phi is chosen so that 1' is along the horizontal part of omega, and psi accordingly

    Raises
    ------
    TopError
        for bad input, an impulse of more than 1000 M (gR)^1/2, a point below the table, and friction so strong that no
        normal force balances it on the ball
    """
    push, point = _vector("impulse", impulse), _vector("at", at)
    if (size := float(np.linalg.norm(push))) > STRONGEST:
        raise TopError("impulse", size, "at most {most:g} in size", code="too-large", most=STRONGEST)
    preparing.check_balance(top, friction)
    P = preparing.problem(top, friction, preparing.checked_edge(edge), (0.0, 0.0), RTOL)
    W = preparing.motion(*preparing.beginning(state, 0.0, P))
    _, low = preparing.place(W, P, state)
    y, e = W.y, np.array(turning(W.y, P)[0])
    above = float(y[of_y.Z] + top.a * e[2] + point[2])  # O is at z_G + a cos(theta)
    if above < -CLOSED:
        raise TopError("at", float(point[2]), "z >= {least:.6g}", least=float(point[2]) - above)
    c, s = np.cos(state.phi), np.sin(state.phi)
    to_space = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    F, r = to_space @ push, top.a * e + to_space @ point
    y[[of_y.VX, of_y.VY, of_y.VZ]] += F
    y[[of_y.LX, of_y.LY, of_y.LZ]] += np.cross(r, F)
    preparing.settled(W, P, (TOUCHES, low))  # beyond Painleve's limit too: slide() says so
    return _after(state, W, P)


def _vector(name: str, given: ArrayLike) -> Array:
    found = numbers(name, given)
    if found.shape != (3,):
        raise TopError(name, found.shape, "Array(3,)", code="wrong-kind")
    return found


def _after(before: State, W: Record, P: Record) -> State:
    """The State of W.y, exactly at the tilt and place of the one before."""
    y, C, after = W.y, W.contacts, preparing.state_of(W, P)
    i = preparing.lower(P, before.theta)  # without z a State is on this contact
    free = abs(C.height[i]) > CLOSED or abs(C.u[i, 2]) > CLOSED
    return replace(after, theta=before.theta, x=before.x, y=before.y, z=float(y[of_y.Z]) if free else None,
                   vz=float(y[of_y.VZ]) if free else None)  # fmt: skip
