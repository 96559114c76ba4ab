"""The arguments of a motion with friction: checked, and converted to the form that kernels use."""

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from ..compiled import compiled
from ..errors import TopError, checked, finite, numbers, positive
from ..paper.constants import CLOSED, State
from ..paper.top import Top
from ..types import Array, Number, Rim, Vector
from . import at
from .contacts import known, settle
from .dynamics import arrange, turning
from .friction import Friction
from .kinds import NONE, STARTS, TOUCHES, Event
from .poses import sample_at
from .records import BALL, MOTION, NO_ONE, OPEN, PROBLEM, SAMPLE, SLIP, STEM, Record, new
from .standing import leaned

LOWEST = 1e-3  # R: how far the lowest point of a profile may be from -1
SHARE = 0.1  # the tolerance of one step, in units of rtol


def checked_rtol(rtol: float) -> float:
    """rtol as a float, or a TopError if it is out of range."""
    rtol = finite("rtol", rtol)
    if not 1e-13 <= rtol <= 1e-3:
        raise TopError("rtol", rtol, "1e-13 <= rtol <= 1e-3")
    return rtol


def checked_losses(rolling_resistance: float, air_drag: float) -> tuple[float, float]:
    """The coefficients of the losses as floats, or a TopError if one is negative."""
    return positive("rolling_resistance", rolling_resistance, zero=True), positive("air_drag", air_drag, zero=True)


def flies(landing: str) -> bool:
    """Whether a motion goes on after it has left the table; a TopError if that is not said."""
    if landing not in ("stop", "plastic"):
        raise TopError("landing", landing, '"stop" | "plastic"', code="wrong-kind")
    return landing == "plastic"


def checked_edge(edge: ArrayLike | None) -> Rim | None:
    """(radius, height, rounding), or None."""
    if edge is None:
        return None
    parts = numbers("edge", edge)
    if parts.shape not in ((2,), (3,)) or parts[0] < 0 or (parts[2:] < 0).any():
        raise TopError("edge", edge, "(radius >= 0, height, rounding >= 0) | None", code="wrong-kind")
    radius, height, rounding = edge = tuple(np.append(parts, 0.0)[:3].tolist())
    if np.hypot(radius, height) + rounding < 1 - 1e-6:
        raise TopError("edge", edge, "an edge not inside the sphere that rolls", code="inside-sphere")
    return edge


def checked_profile(profile: ArrayLike) -> Array:
    """(k, 2) as a float array, or a TopError."""
    rows = numbers("profile", profile)
    if rows.ndim != 2 or rows.shape[1] != 2 or not len(rows):
        raise TopError("profile", rows.shape, "Array(k, 2)", code="wrong-kind")
    if abs(rows[:, 1].min() + 1) > LOWEST:
        raise TopError("profile", float(rows[:, 1].min()), "min(profile[:, 1]) == -1",
                       "It is in R: Shape.profile(n) / Shape.R.", code="profile-in-r")  # fmt: skip
    return rows


@checked
@lru_cache(256)  # each motion of many is checked by it
def strongest_friction(top: Top) -> float:
    """The coefficient of sliding friction above which, at some tilt and direction of slip, no normal force balances the
    friction on the ball (Painleve's paradox): the minimum of (I1 + a^2 s^2)/(|a| (1 - a c) s).

    Parameters
    ----------
    top : Top
        the top

    Returns
    -------
    float
        inf for a = 0
    """
    a, I1, _ = top.numbers
    if a == 0:
        return np.inf
    # with p = q/a and J = I1 p^2, q = 1 or, so that nothing overflows, a: the minimum of
    # (J + q^2 s^2)/(|q| |p - q c| s), whose logarithmic derivative is 0 where, with x = c,
    # 2 q^2 x (p - q x)(1 - x^2) = (J + q^2 (1 - x^2)) [q (1 - x^2) + x (p - q x)]
    p, J, q = (1.0, I1, a) if abs(a) <= 1 else (1 / a, I1 / a / a, 1.0)
    x = np.poly1d([1.0, 0.0])
    s2, arm = 1 - x**2, p - q * x
    flat = ((J + q * q * s2) * (q * s2 + x * arm) - 2 * q * q * x * arm * s2).coefficients
    flat[abs(flat) < 1e-30 * abs(flat).max()] = 0.0  # of a minute a: their roots are far beyond 1
    c = np.array([root.real for root in np.roots(flat) if abs(root.imag) < 1e-9 and abs(root.real) < 1])
    s = np.sqrt(1 - c * c)
    thin = min(J**0.5 / abs(q), 1.0)  # s next to a pole, where c alone does not tell it from 1
    c, s = np.append(c, [(1 - thin**2) ** 0.5, -((1 - thin**2) ** 0.5)]), np.append(s, [thin, thin])
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        return float(np.nanmin((J + (q * s) ** 2) / (abs(q * (p - q * c)) * s)))


def check_balance(top: Top, friction: Friction) -> None:
    """Raises TopError if the friction is too strong for that."""
    name, mu = next(((n, getattr(friction, n)) for n in ("mu_k", "mu") if hasattr(friction, n)), ("", 0.0))
    most = strongest_friction(top)
    if mu >= most:
        raise TopError(name, mu, f"{name} < {most:.6g}",
                       "More friction than that no normal force balances (Painleve's paradox).",
                       code="too-strong")  # fmt: skip


def problem(top: Top, friction: Friction, edge: Rim | None, losses: tuple[float, float], rtol: float) -> Record:
    """The record PROBLEM. An edge that lies on the sphere itself is the end of its surface."""
    (b, h, q), rim = edge or (0.0, 0.0, 0.0), -2.0
    if edge and np.hypot(b, h) + q < 1 + 1e-6:
        edge, rim = None, float(-h / np.hypot(b, h))
    P = new(PROBLEM)
    P.a, P.I1, P.I3 = top.numbers
    P.k = 1 / P.I3 - 1 / P.I1
    P.law, P.stem, P.b, P.h, P.q, P.rim = tuple(friction.law), edge is not None, b, h, q, rim
    P.delta, P.drag, P.tolerance = *losses, SHARE * rtol
    return P


def beginning(state: State, t: float, P: Record) -> tuple[Array, Array]:
    """y at a State, and the angles of poses.py."""
    if np.cos(state.theta) < P.rim:
        raise TopError("theta", state.theta, "less than {most:.6g} for this top",
                       "The sphere's surface ends there.", code="beyond-rim",
                       most=float(np.arccos(P.rim)))  # fmt: skip
    s, c, turn = np.sin(state.theta / 2), np.cos(state.theta / 2), np.exp(1j * state.phi)
    v = complex(state.vx or 0.0, state.vy or 0.0) * turn
    place = complex(state.x or 0.0, state.y or 0.0)
    return y_of(P, state.theta, s, c, turn, state.phi + state.psi, (state.theta_dot, state.omega2, state.omega3), v,
                place, t, 0.0), np.array([0.0, state.phi])  # fmt: skip


def y_of(
    P: Record, theta: float, sin_half: Number, cos_half: float, turn: complex, chi: float, omega: Vector | Array,
    v: complex, place: complex, t: float, heat: float,
) -> Array:  # fmt: skip
    """y, with p = Rz(phi) Rx(theta) Rz(-phi)."""
    L1, L2, L3 = P.I1 * omega[0], P.I1 * omega[1], P.I3 * omega[2]
    s, c = np.sin(theta), np.cos(theta)
    p, L = sin_half * turn, complex(L1, c * L2 - s * L3) * turn
    return np.array([p.real, p.imag, 0.0, cos_half, chi, L.real, L.imag, s * L2 + c * L3,
                     v.real, v.imag, place.real, place.imag, t, heat, 0.0, 0.0])  # fmt: skip


def state_of(W: Record, P: Record) -> State:
    """The State at W.y, which beginning() takes; without z and vz. On the vertical axis 1' is along the horizontal part
    of omega, as it is just after the pole."""
    here = new(SAMPLE)
    sample_at(W, P, (OPEN, OPEN), here)
    theta, phi, psi, (w1, w2, w3), v = here.theta, here.phi, here.psi, here.omega, complex(*here.velocity[:2])
    if theta in (0.0, np.pi):
        pole = np.cos(theta)
        lean = np.angle(pole * (w1 + 1j * pole * w2))
        w1, w2, phi, psi, v = pole * np.hypot(w1, w2), 0.0, phi + lean, psi - pole * lean, v * np.exp(-1j * lean)
    x, y, _ = here.com
    return State(theta, w1, w2, w3, phi, psi, x, y, v.real, v.imag)


def motion(y: Array, angles: Array) -> Record:
    """The record of a motion that begins at y."""
    W = new(MOTION)
    W.y[:], W.angles[:], W.begins = y, angles, 1
    return W


def gap(P: Record, c: Number, s: Number) -> Number:
    """Height (R) of the stem's lowest point above the table while the ball touches the table."""
    return 1 + P.h * c - P.b * s - P.q


def height(P: Record, theta: float) -> float:
    """Height (R) of G above the table while the lower contact touches it."""
    c, s = np.cos(theta), np.sin(theta)
    return float(1 - P.a * c - (min(gap(P, c, s), 0.0) if P.stem else 0.0))


def lower(P: Record, theta: float) -> int:
    """The contact that is on the table if nothing else is said."""
    return STEM if P.stem and gap(P, np.cos(theta), np.sin(theta)) < 0 else BALL


@compiled
def on_table(W: Record, P: Record, i: int) -> None:
    """Sets v_z and z in W.y so that contact i is on the table."""
    arrange(W.y, NO_ONE, (SLIP, OPEN) if i == BALL else (OPEN, SLIP), P, W.contacts)
    known(W.y, W.contacts)


@compiled
def settled(W: Record, P: Record, event: Event) -> bool:
    """settle() of W. (Called with its arrays, it and all that it calls would be compiled twice: numba knows them apart
    from the same arrays within a record.)"""
    return settle(W.y, event, W.modes, P, W.step, W.contacts)


def start(W: Record, P: Record, state: State) -> tuple[Event, bool]:
    """place(), and the modes in which the motion continues; False beyond Painleve's limit."""
    event = place(W, P, state)
    return event, event[0] == NONE or bool(settled(W, P, event))


def place(W: Record, P: Record, state: State) -> Event:
    """Sets W.y on the contact that touches, or in flight. Returns what happens at the lower contact: STARTS, TOUCHES
    where it moves down, so that an impact is to follow, or NONE in flight.

    With z and vz a contact at the table that moves up is open; if the other one is at the table too and does not, that
    one carries.
    """
    i = lower(P, state.theta)
    if state.z is not None:
        C = W.contacts
        W.y[at.Z], W.y[at.VZ] = state.z, state.vz or 0.0
        arrange(W.y, NO_ONE, (OPEN, OPEN), P, C)
        if (above := float(C.height[i])) < -CLOSED:
            raise TopError("z", state.z, "z >= {least:.10g}", least=state.z - above)
        closed = [j for j in (i, 1 - i)[: 1 + P.stem] if C.height[j] <= CLOSED and C.u[j, 2] <= CLOSED]
        if not closed:
            return NONE, i
        i = closed[0]
        if min(C.u[j, 2] for j in closed) < -CLOSED:
            return TOUCHES, i
    on_contact(W, P, i)
    return STARTS, i


@compiled
def on_contact(W: Record, P: Record, i: int) -> None:
    """Sets W.y so that contact i is on the table."""
    y = W.y
    e, w, _ = turning(y, P)
    if i == STEM and P.b > 0.0:
        y[:] = leaned(y, e, w)
    on_table(W, P, i)
