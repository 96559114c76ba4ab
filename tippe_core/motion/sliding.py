"""Motion with friction at the contact point: what turns a tippe top over.

The equations are in dynamics.py, how they are followed in stepper.py and following.py, what touches, sticks and stands
in contacts.py, impact.py and standing.py. Here: what is asked for, and what is given back.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..errors import TopError, finite, numbers
from ..paper.constants import State, versines
from ..paper.top import Top
from ..types import Array, Number, Rim
from . import following
from .contacts import SLACK, SLIPS, STARTS, TOUCH, TOUCHES, settle
from .dynamics import BALL, NO_ONE, OPEN, SLIP, STEM, arrange, turning
from .following import (
    LIFTS_OFF,
    MORE,
    NAMES,
    PAINLEVE,
    ROLLS,
    STANDS_UPRIGHT,
    SUPPORTS,
    TOO_MANY_TURNS,
    happens,
    noted,
    run,
)
from .friction import CONTENSOU, COULOMB, Contensou, Coulomb, Friction, Law, SmoothedCoulomb, Viscous
from .poses import COLUMNS, REGIMES, ROLLING, WIDTH, record
from .records import MOTION, PROBLEM, Record, new
from .rolling import Rolling
from .smooth import first_below
from .standing import leaned
from .trajectory import Trajectory, checked_times

MOST_EVENTS = 10_000
MOST_STEPS = 4_000_000  # about half a minute
EACH = 32  # steps between two calls of progress
SHARE = 0.1  # of rtol, for a step


def slide(
    top: Top, state: State, friction: Friction, times: ArrayLike, rtol: float = 1e-9, landing: str = "stop",
    edge: ArrayLike | None = None, rolling_resistance: float = 0.0, air_drag: float = 0.0,
    progress: Callable[[float], object] | None = None,
) -> Trajectory:  # fmt: skip
    """The motion with friction at the given times: Trajectory.

    state: State at times[0]; x, y, vx, vy left None mean G at the origin, at rest.
    friction: Coulomb(mu_k, mu_s), Viscous(gamma), SmoothedCoulomb(mu, eps) or Contensou(mu, radius).
    times: (n,) in (R/g)^1/2, not falling.
    rtol: 1e-13 to 1e-3, the error of a step over 1 rad, |L|, |v|, R and the energy; over 900 (R/g)^1/2 of a turning top
    C_J drifts by some 4 rtol of itself.

    landing: "stop", and the Trajectory ends where the top lifts off, at the last of the times before it; or "plastic":
    it flies, and lands without a bounce; friction acts in the impact by its own law, in proportion to the normal force
    and so to the normal impulse (impact.py; that of a law that holds stops the slip if mu_s lets it, viscous friction
    takes some of it). It is the same where the stem touches, for either landing.
    edge: (radius, height above O along axis 3, rounding 0 if not given) in R of the edge of the stem's end, Shape.edge;
    or None, a whole sphere. A start tilted further than where it touches stands on the edge.
    rolling_resistance: delta in R, a moment -delta F_z omega_h/|omega_h| against the horizontal part of omega, 1e-4 to
    1e-3 for wood (smooth below 1e-3 (g/R)^1/2). air_drag: k in MR^2 (g/R)^1/2, a moment -k omega. Both enter the heat.
    progress: called now and then with the time reached; what it raises stops the run and passes through.

    events: (time, what), located to 1e-9: "sticks" and "slips" (laws that hold; "slips" also where the slip goes through
    0 without a halt and turns round), "lifts off" and "lands", or "lands on its
    stem"; "stem touches" or "ball touches" (the other carries on), "stem leaves", "stands on its stem" (the ball has
    left), "falls back on its ball". How many of ever smaller bounces between the two are listed depends on rtol. The
    Trajectory ends early, without a sample at the event, with
    "lifts off" where that stops it,
    "rim touches" where the sphere's surface ends before anything else touches (an edge on the sphere, as of a cut ball
    without a stem): what comes then is not computed,
    "stands upright" on its stem within 1e-3 rad of flat, without the energy to tip over the rim of the stem's end any
    more (standing.py); else the motion goes on over it: "rocks over" where the end comes down flat, an impact,
    "Painleve's limit" where no normal force balances the friction, or several do (contacts.py),
    "too many events" after 10,000 of them: friction at its limit that chatters, or a top that hops on,
    "too many turns" after what takes about half a minute.
    A start that must leave the table is one sample in the air, or flies from the first; its first event is "lifts off".
    regime: "slip", or "roll" where friction holds the top; with Coulomb's law and no losses that part on the sphere is
    the exact one of rolling.py. heat: the work of friction, of the losses and of impacts. supports: what carried the
    top, from when on.
    Raises TopError for bad input, and for friction so strong that no normal force balances it on the ball (Painleve).
    """
    if not isinstance(state, State):
        raise TopError("state", state, "a State")
    if not isinstance(friction, Coulomb | Viscous | SmoothedCoulomb | Contensou):
        raise TopError("friction", friction,
                       "Coulomb(mu_k, mu_s), Viscous(gamma), SmoothedCoulomb(mu, eps) or Contensou(mu, radius)")  # fmt: skip
    t = checked_times(times)
    if np.any(np.diff(t) < 0):
        raise TopError("times", times, "times that do not fall", "Friction has no way back.")
    check_balance(top, friction)
    rtol = checked_rtol(rtol)
    if landing not in ("stop", "plastic"):
        raise TopError("landing", landing, '"stop" or "plastic"')
    losses = checked_loss("rolling_resistance", rolling_resistance), checked_loss("air_drag", air_drag)
    P = problem(top, friction, checked_edge(edge), losses, rtol)
    return _Run(top, P, landing == "plastic", progress)(state, t)


def sensitivity(
    top: Top, state: State, friction: Friction, times: ArrayLike, nudge: float = 1e-6, **how: Number
) -> float:
    """How many times a nudge of the start's theta (rad) grows: the largest change of theta by it, over the nudge.

    Arguments as of slide(). Large where the physics is sensitive, whatever the tolerance: a top near the limit of
    sticking, of lift-off or of a threshold. A nudge that makes other events happen counts by what it does to theta.
    """
    moved, near = (slide(top, start, friction, times, **how) for start in (state, beside(state, nudge)))
    return growth(moved, near, nudge)


def beside(state: State, nudge: float) -> State:
    """A State whose theta is a nudge (rad) larger, from 1 rad on smaller."""
    return replace(state, theta=state.theta + (nudge if state.theta < 1 else -nudge))


def growth(moved: Trajectory, near: Trajectory, nudge: float) -> float:
    """How many times the nudge (rad) between the starts of two Trajectories grows at most, where both have samples."""
    both = min(len(moved.t), len(near.t))
    return float(np.abs(moved.theta[:both] - near.theta[:both]).max(initial=0.0) / nudge)


def checked_rtol(rtol: float) -> float:
    """rtol as a float in its range."""
    rtol = finite("rtol", rtol)
    if not 1e-13 <= rtol <= 1e-3:
        raise TopError("rtol", rtol, "1e-13 <= rtol <= 1e-3")
    return rtol


def checked_loss(name: str, loss: float) -> float:
    """A loss as a float, not negative."""
    loss = finite(name, loss)
    if loss < 0:
        raise TopError(name, loss, f"{name} >= 0")
    return loss


def checked_edge(edge: ArrayLike | None) -> Rim | None:
    """(radius, height, rounding), or None."""
    if edge is None:
        return None
    parts = numbers("edge", edge)
    if parts.shape not in ((2,), (3,)) or parts[0] < 0 or (parts[2:] < 0).any():
        raise TopError("edge", edge, "(radius >= 0, height above O, rounding >= 0) in R, or None")
    radius, height, rounding = edge = tuple(np.append(parts, 0.0)[:3].tolist())
    if np.hypot(radius, height) + rounding < 1 - 1e-6:
        raise TopError("edge", edge, "an edge not inside the sphere that rolls")
    return edge


def check_balance(top: Top, friction: Friction) -> None:
    """F_z must be positive for every direction of u: mu |a| r_z s < I1 + a^2 s^2 (Painleve)."""
    name, mu = next(((n, getattr(friction, n)) for n in ("mu_k", "mu") if hasattr(friction, n)), ("", 0.0))
    s, c = np.sin(theta := np.linspace(0, np.pi, 721)), np.cos(theta)
    arm = abs(top.a * (1 - top.a * c)) * s
    with np.errstate(divide="ignore"):
        most = np.min((top.I1 + (top.a * s) ** 2) / arm)
    if mu >= most:
        raise TopError(name, mu, f"{name} < {most:.6g} for this top",
                       "More friction than that no normal force balances (Painleve's paradox).")  # fmt: skip


def problem(top: Top, friction: Friction, edge: Rim | None, losses: tuple[float, float], rtol: float) -> Record:
    """The Problem. An edge on the sphere itself is where its surface ends."""
    (b, h, q), rim, law = edge or (0.0, 0.0, 0.0), -2.0, friction.law
    if edge and np.hypot(b, h) + q < 1 + 1e-6:
        edge, rim = None, float(-h / np.hypot(b, h))
    if law.kind == CONTENSOU and law.width == 0.0:
        law = Law(COULOMB, law.mu, law.mu_s, 0.0)
    P = new(PROBLEM)
    P.a, P.I1, P.I3 = top.numbers
    P.law, P.stem, P.b, P.h, P.q, P.rim = tuple(law), edge is not None, b, h, q, rim
    P.delta, P.drag, P.tolerance = *losses, SHARE * rtol
    return P


def beginning(state: State, t: float, P: Record) -> tuple[Array, Array]:
    """y at a State, on the ball or the stem, and the angles of poses.py."""
    s, c, turn = np.sin(state.theta / 2), np.cos(state.theta / 2), np.exp(1j * state.phi)
    v = complex(state.vx or 0.0, state.vy or 0.0) * turn
    place = complex(state.x or 0.0, state.y or 0.0)
    return y_of(P, state.theta, s, c, turn, state.phi + state.psi, (state.theta_dot, state.omega2, state.omega3), v,
                place, t, 0.0), np.array([0.0, state.phi])  # fmt: skip


def y_of(
    P: Record, theta: float, sin_half: float, cos_half: float, turn: complex, chi: float, omega: ArrayLike, v: complex,
    place: complex, t: float, heat: float,
) -> Array:  # fmt: skip
    """y, with p = Rz(phi) Rx(theta) Rz(-phi)."""
    L1, L2, L3 = np.array([P.I1, P.I1, P.I3]) * omega
    s, c = np.sin(theta), np.cos(theta)
    p, L = sin_half * turn, complex(L1, c * L2 - s * L3) * turn
    return np.array([p.real, p.imag, 0.0, cos_half, chi, L.real, L.imag, s * L2 + c * L3,
                     v.real, v.imag, place.real, place.imag, t, heat, 0.0, 0.0])  # fmt: skip


def motion(y: Array, angles: Array) -> Record:
    """Room for a motion that begins at y."""
    W = new(MOTION)
    W.y[:], W.angles[:], W.begins = y, angles, 1
    return W


class _Run:
    """One motion."""

    def __init__(self, top: Top, P: Record, flies: bool, progress: Callable[[float], object] | None) -> None:
        self.top, self.P, self.flies, self.progress = top, P, flies, progress

    def __call__(self, state: State, times: Array) -> Trajectory:
        P = self.P
        if np.cos(state.theta) < P.rim:
            raise TopError("theta", state.theta, f"less than {np.arccos(P.rim):.6g} for this top",
                           "The sphere's surface ends there.")  # fmt: skip
        y, angles = beginning(state, times[0], P)
        W = self.motion = motion(y, angles)
        self.log = np.zeros((MOST_EVENTS + 2, 3))
        self.times, self.rows = times, np.zeros((len(times), WIDTH))
        stands_on, goes_on = start(W, P, state.theta)
        first = W.modes if goes_on else [OPEN, OPEN]
        supports = [
            (float(times[0]), SUPPORTS[(first[0] > 0) + 2 * (first[1] > 0)] if goes_on else SUPPORTS[1 + stands_on])
        ]
        if not goes_on:
            noted(W, self.log, PAINLEVE, 0, 0)
        else:
            if not any(W.modes):
                noted(W, self.log, LIFTS_OFF, 0, 0)
            if any(W.modes) or self.flies:
                self._follow()
        count = int(W.samples)
        if not count:
            self._alone(stands_on, int(self.log[0, 1]))
            count = 1
        if not np.all(np.isfinite(self.rows[:count])):
            raise TopError("friction", P.law, "weaker friction for this top", "The equations could not be followed.")
        log = self.log[: W.events]
        events = tuple((float(t), NAMES[int(name)]) for t, name, _ in log)
        for t, name, carries in log:
            if name == PAINLEVE:
                continue
            _support(supports, float(t), SUPPORTS[int(carries)])
        parts = {name: np.ascontiguousarray(self.rows[:count, column]) for name, column in COLUMNS.items()}
        for name in ("t", "theta", "phi", "psi", "heat"):
            parts[name] = parts[name][:, 0]
        regime = REGIMES[parts.pop("regime")[:, 0].astype(int)]
        return Trajectory(top=self.top, events=events, supports=tuple(supports), regime=regime, **parts)

    def _follow(self) -> None:
        W, P, times = self.motion, self.P, self.times
        exact = P.delta == P.drag == 0.0
        each = EACH if self.progress else MOST_STEPS
        while True:
            status = run(W, P, self.log, times, self.rows, times[-1], self.flies, exact, each)
            if status == ROLLS:
                if self.progress:
                    self.progress(float(W.y[12]))
                if self._roll():
                    return
                continue
            if status != MORE:
                return
            if self.progress:
                self.progress(float(W.y[12]))
            if W.steps >= MOST_STEPS:
                noted(W, self.log, TOO_MANY_TURNS, *W.modes)
                return

    def _state(self, y: Array) -> State:
        """The State at y, with G's velocity unsaid."""
        W, P = self.motion, self.P
        row = np.zeros(WIDTH)
        record(y, y[12], arrange(y, NO_ONE, OPEN, OPEN, P, W.contacts), W.angles, OPEN, OPEN, P, W.contacts, row)
        theta, phi, psi, w1, w2, w3 = *row[1:4], *row[13:16]
        if theta in (0.0, np.pi):
            pole = np.cos(theta)  # 1' along omega, as it is just after the pole
            lean = np.angle(pole * (w1 + 1j * pole * w2))
            w1, w2, phi, psi = pole * np.hypot(w1, w2), 0.0, phi + lean, psi - pole * lean
        return State(theta, w1, w2, w3, phi, psi, y[10], y[11])

    def _roll(self) -> bool:
        """Rolling on the ball, by the exact motion of rolling.py, until an event; whether the motion ends with it."""
        W, P, y, times, top = self.motion, self.P, self.motion.y, self.times, self.top
        rolling, b, h, q = Rolling(top, None, self._state(y)), P.b, P.h, P.q
        floor = min(gap(P, np.cos(self._state(y).theta), np.sin(self._state(y).theta)), 0.0)

        def margin(t: Array) -> Array:
            F = rolling(np.append(0.0, t)).force[1:].T
            return P.law.mu_s * F[2] - np.hypot(F[0], F[1]) + SLACK

        def tilt(t: Array) -> Array:
            return rolling.theta(np.append(0.0, t))[1:]

        def room_left(t: Array) -> Array:
            theta = tilt(t)
            return TOUCH - floor + gap(P, np.cos(theta), np.sin(theta))

        found = [(first_below(margin, rolling.period), SLIPS)]
        if P.stem:
            found.append((first_below(room_left, rolling.period), TOUCHES + STEM))
        if P.rim > -2:
            found.append((first_below(lambda t: np.cos(tilt(t)) - P.rim, rolling.period), following.RIM))
        ends, event = min(found)
        done = int(W.samples)
        last = y[12] + ends
        count = len(times) if not np.isfinite(ends) else max(int(np.searchsorted(times, last)), done)
        moved = rolling(np.array([y[12], *times[done:count]]))
        self.rows[done:count] = _rows(moved, y[13])[1:]
        W.samples = count
        if count == len(times):
            return True
        one = rolling(np.array([0.0, ends]))
        theta, turn = one.theta[1], np.exp(1j * one.phi[1])
        v, m = versines(theta)
        w1, w2, w3 = one.omega[1]
        u = complex(w2 * (1 - v - top.a) - w3 * np.sin(theta), -w1 * (1 - top.a * (1 - v))) * turn
        y[:] = y_of(P, theta, (v / 2) ** 0.5, float(m / 2) ** 0.5, turn, one.phi[1] + one.psi[1], one.omega[1], u,
                    complex(*one.com[1, :2]), last, y[13])  # fmt: skip
        W.angles[:] = 0.0, one.phi[1]
        on_table(y, BALL, P, W)
        return bool(happens(W, P, self.log, event, self.flies))

    def _alone(self, stands_on: int, event: int) -> None:
        """The row of one instant, where an event ends the motion at once."""
        W, P, y = self.motion, self.P, self.motion.y
        modes = [OPEN, OPEN]
        if event != LIFTS_OFF:
            modes[stands_on] = SLIP
        turn = arrange(y, NO_ONE, modes[0], modes[1], P, W.contacts)
        W.contacts.F[:] = 0.0
        W.contacts.F[stands_on, 2] = float(event == STANDS_UPRIGHT)
        record(y, self.times[0], turn, W.angles, modes[0], modes[1], P, W.contacts, self.rows[0])
        self.rows[0, 16:18] = 0.0


def gap(P: Record, c: Number, s: Number) -> Number:
    """Height of the stem's lowest point above the table while the ball stands on it."""
    return 1 + P.h * c - P.b * s - P.q


def on_table(y: Array, i: int, P: Record, W: Record) -> None:
    """v_z and z into y with contact i on the table."""
    arrange(y, NO_ONE, SLIP if i == BALL else OPEN, SLIP if i == STEM else OPEN, P, W.contacts)
    y[14], y[15] = W.contacts.G[2], W.contacts.G[3]


def start(W: Record, P: Record, theta: float) -> tuple[int, bool]:
    """The contact on which y begins, with y there and the modes in which it goes on; False beyond Painleve's limit."""
    y = W.y
    e, w, _ = turning(y, P)
    i = STEM if P.stem and gap(P, np.cos(theta), np.sin(theta)) < 0 else BALL
    if i == STEM and P.b > 0:
        y[:] = leaned(y, e, w)
    on_table(y, i, P, W)
    return i, bool(settle(y, STARTS + i, W.floor, W.modes, P, W.step, W.contacts))


def _rows(moved: Trajectory, heat: float) -> Array:
    """Rows of COLUMNS of a Trajectory that rolls."""
    rows = np.empty((len(moved.t), WIDTH))
    for name, column in COLUMNS.items():
        if name not in ("heat", "regime"):
            part = getattr(moved, name)
            rows[:, column] = part if part.ndim == 2 else part[:, None]
    rows[:, COLUMNS["heat"]], rows[:, COLUMNS["regime"]] = heat, ROLLING
    return rows


def _support(supports: list[tuple[float, str]], t: float, what: str) -> None:
    """Adds (t, what carries); what carried for no time goes."""
    if supports and supports[-1][0] == t:
        supports.pop()
    if not supports or supports[-1][1] != what:
        supports.append((t, what))
