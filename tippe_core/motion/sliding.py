"""Motion with friction at the contact point, which is what turns a tippe top over.

The equations are in dynamics.py, their integration in stepper.py and following.py, and contacts, impacts and standing
in contacts.py, impact.py and standing.py. This file checks the arguments and builds the results.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from ..errors import TopError, finite, single
from ..paper.constants import State, versines
from ..paper.top import Top
from ..types import Array, Number
from .contacts import RIM, SLACK, SLIPS, TOUCH, TOUCHES, Event
from .dynamics import BALL, OPEN, SLIP, STEM, carried
from .events import (
    EVENTS,
    LIFTS_OFF,
    NOTED,
    NOTES,
    PAINLEVE,
    PASSES_90,
    STANDS_UPRIGHT,
    SUPPORTS,
    TOO_MANY_TURNS,
    happens,
    logged,
    noted,
    noted_values,
)
from .friction import LAWS, Friction
from .poses import REGIMES, ROLLING, sample_at
from .preparing import (
    beginning,
    check_balance,
    checked_edge,
    checked_loss,
    checked_profile,
    checked_rtol,
    flies,
    gap,
    motion,
    on_table,
    problem,
    start,
    y_of,
)
from .records import HEAT, LOG, SAMPLE, TIME, Record, X, Y, new
from .rolling import Rolling
from .run import MORE, ROLLS, run
from .sinking import ANOTHER_TOUCHES, sunk
from .smooth import first_below, zeros
from .summary import begin
from .trajectory import Trajectory, checked_times

MOST_EVENTS = 10_000
MOST_STEPS = 4_000_000  # about half a minute
EACH = 32  # steps between two calls of progress


def slide(
    top: Top, state: State, friction: Friction, times: ArrayLike, rtol: float = 1e-9, landing: str = "plastic",
    edge: ArrayLike | None = None, rolling_resistance: float = 0.0, air_drag: float = 0.0,
    progress: Callable[[float], object] | None = None, profile: ArrayLike | None = None,
) -> Trajectory:  # fmt: skip
    """The Trajectory of the motion with friction at the given times.

    state: the State at times[0]; x, y, vx, vy None mean that G is at the origin, at rest.
    friction: Coulomb(mu_k, mu_s), Viscous(gamma), SmoothedCoulomb(mu, eps) or Contensou(mu, radius).
    times: (n,) in (R/g)^1/2, not decreasing.
    rtol: 1e-13 to 1e-3, the error of one step relative to 1 rad, |L|, |v|, R and the energy.
    While a top turns over, in 900 (R/g)^1/2, C_J changes by about 4 rtol C_J. Creep (implicit.py): 5e-9 at least.

    landing: with "plastic" a top that leaves the table flies and lands without a bounce. With "stop" the Trajectory
    ends when it lifts off, at the last of the times before. In the impact friction follows its own law, with the normal
    impulse in place of the normal force (impact.py): a law with static friction stops the slip if mu_s is large enough,
    viscous friction reduces it. The same holds for impacts of the stem, with either landing. edge: (radius, height
    above O along axis 3, rounding or 0) in R of the edge of the stem's end, as in Shape.edge; None for a whole sphere.
    If theta at the start is beyond the angle at which the edge touches, the top starts on the edge. rolling_resistance:
    delta in R, a torque -delta F_z omega_h/|omega_h| against the horizontal part of omega (smoothed below 1e-3
    (g/R)^1/2). air_drag: k in MR^2 (g/R)^1/2, a torque -k omega. Both add to heat. progress: is called now and then
    with the fraction of the time that is done; an exception that it raises stops the run and is passed on. profile:
    (k, 2), radius and height above O in R of the whole body, as from Shape.profile: the motion ends where a part of it
    other than the ball and the edge is below the table at one of the times.

    events: (time, name), located to 1e-9. "sticks" and "slips" (laws with static friction; "slips" also when the slip
    passes through 0 and reverses without a halt); "lifts off" and "lands", or "lands on its
    stem"; "stem touches" or "ball touches" (while the other carries), "stem leaves", "stands on its stem" (the ball has
    left the table), "falls back on its ball". If there is a series of ever smaller bounces between the two, rtol
    determines how many are listed. These events end the Trajectory early, without a sample at the event:
    "lifts off" if landing is to stop it;
    "another part touches" if there is a profile, and at one of the times a point of it is more than 1e-3 R below the
    table;
    "rim touches" if the sphere's surface ends before anything else touches (an edge on the sphere, as of a cut ball
    without a stem), because what follows is not computed;
    "stands upright" if it is on its stem within 1e-3 rad of flat, without enough energy to tip over the rim of the
    stem's end (standing.py); otherwise the motion continues over the rim, with "rocks over" when the end comes down
    flat, which is an impact; "Painleve's limit" if no normal force balances the friction, or several do (contacts.py);
    "too many events" after 10,000 of them, for example if friction chatters at its limit or the top keeps hopping; "too
    many turns" after as many steps as take about half a minute. A top that leaves the table at once gives a single
    sample in the air, or flies from the start; its first event is "lifts off". regime: "slip", or "roll" while friction
    makes the top roll; with Coulomb's law, and without rolling resistance or air drag, the parts that roll on the
    sphere are the exact motion of rolling.py. heat: the energy lost by friction, rolling resistance, air drag and
    impacts. supports: what carries the top, and from when on. Raises TopError for bad input, and if the friction is so
    strong that no normal force balances it on the ball (Painleve's paradox).
    """
    single("top", top, Top)
    single("state", state, State)
    single("friction", friction, *LAWS)
    t = checked_times(times)
    if np.any(np.diff(t) < 0):
        raise TopError("times", times, "times[i] <= times[i + 1]", "Friction has no way back.", code="falling")
    check_balance(top, friction)
    rtol = checked_rtol(rtol)
    losses = checked_loss("rolling_resistance", rolling_resistance), checked_loss("air_drag", air_drag)
    P = problem(top, friction, checked_edge(edge), losses, rtol)
    body = None if profile is None else checked_profile(profile)
    moved = _Run(top, friction, P, flies(landing), progress)(state, t)
    first = len(moved) if body is None else sunk(moved, body)
    return moved if first == len(moved) else moved.until(max(first, 1), float(moved.t[first]), ANOTHER_TOUCHES)


def sensitivity(
    top: Top, state: State, friction: Friction, times: ArrayLike, nudge: float = 1e-6, **how: Number
) -> float:
    """How much a small change of the initial theta (nudge, rad) grows: the largest change of theta divided by nudge.

    The other arguments are those of slide(). The result is large where the motion itself is sensitive, whatever the
    tolerance: near the limits of sticking and of lift-off, or near a threshold spin. If the nudge changes the events,
    only its effect on theta counts.
    """
    nudge = checked_nudge(nudge)
    moved, near = (slide(top, start, friction, times, **how) for start in (state, beside(state, nudge)))
    return growth(moved, near, nudge)


def checked_nudge(nudge: float) -> float:
    """nudge, or a TopError if it is out of range."""
    if finite("nudge", nudge) == 0:
        raise TopError("nudge", nudge, "nudge != 0")
    return float(nudge)


def beside(state: State, nudge: float) -> State:
    """The State with theta larger by nudge (rad), or smaller if theta is 1 rad or more."""
    return replace(state, theta=state.theta + (nudge if state.theta < 1 else -nudge))


def growth(moved: Trajectory, near: Trajectory, nudge: float) -> float:
    """The largest factor by which the difference nudge (rad) between the starts of two Trajectories grows, over the
    times that both have."""
    both = min(len(moved.t), len(near.t))
    return float(np.abs(moved.theta[:both] - near.theta[:both]).max(initial=0.0) / abs(nudge))


class _Run:
    """One motion of slide()."""

    def __init__(
        self, top: Top, friction: Friction, P: Record, flies: bool, progress: Callable[[float], object] | None
    ) -> None:
        self.top, self.friction, self.P, self.flies, self.progress = top, friction, P, flies, progress

    def __call__(self, state: State, times: Array) -> Trajectory:
        P = self.P
        y, angles = beginning(state, times[0], P)
        W = self.motion = motion(y, angles)
        self.log = np.zeros(2 * MOST_EVENTS, LOG)
        self.times, self.rows = times, np.zeros(len(times), SAMPLE)
        stands_on, goes_on = start(W, P, state.theta)
        begin(W, P, self.log, np.inf)
        first = carried(*W.modes) if goes_on else 1 + stands_on
        supports = [(float(times[0]), SUPPORTS[first])]
        if not goes_on:
            logged(W, self.log, PAINLEVE, OPEN, OPEN)
        elif first == 0:
            logged(W, self.log, LIFTS_OFF, OPEN, OPEN)
        if goes_on and (first or self.flies):
            self._follow()
        count = int(W.samples)
        if not count:
            self._alone(stands_on)
            count = 1
        rows = self.rows[:count]
        finite = [np.isfinite(rows[name]).reshape(count, -1).all(axis=1) for name in SAMPLE.names]
        followed = np.append(np.all(finite, axis=0), np.isfinite(W.y).all())
        if not followed.all():
            raise TopError("friction", self.friction, "weaker friction for this top",
                           "The equations could not be followed past t = {t:.6g}{unit}.", code="not-followed",
                           t=float(times[max(int(followed.argmin()) - 1, 0)]), unit="")  # fmt: skip
        log = [(float(entry.t), entry.name, SUPPORTS[entry.supports]) for entry in self.log[: W.logged]]
        events = tuple((t, EVENTS[name][0]) for t, name, _ in log if EVENTS[name][1] != NOTES)
        for t, name, what in log:
            if name != PAINLEVE and EVENTS[name][1] != NOTES:
                _support(supports, t, what)
        parts = {name: rows[name].copy() for name in SAMPLE.names} | {"regime": REGIMES[rows["regime"]]}
        time_90 = next((t for t, name, _ in log if name == PASSES_90), np.nan)
        return Trajectory(top=self.top, events=events, supports=tuple(supports), time_90=time_90, **parts)

    def _follow(self) -> None:
        W, P, times = self.motion, self.P, self.times
        exact = P.delta == P.drag == 0.0
        each = EACH if self.progress else MOST_STEPS
        while True:
            status = run(W, P, self.log, times, self.rows, times[-1], self.flies, exact, each)
            if status == ROLLS:
                self._tell()
                if self._roll():
                    return
                continue
            if status != MORE:
                return
            self._tell()
            if W.steps >= MOST_STEPS:
                logged(W, self.log, TOO_MANY_TURNS, *W.modes)
                return

    def _tell(self) -> None:
        """Tells progress which fraction of the time is done."""
        if self.progress:
            begins, ends = self.times[0], self.times[-1]
            self.progress(float(min(1.0, (self.motion.y[TIME] - begins) / (ends - begins))) if ends > begins else 1.0)

    def _state(self, y: Array) -> State:
        """The State at y, without the velocity of G."""
        W, P = self.motion, self.P
        here = new(SAMPLE)
        sample_at(W, P, OPEN, OPEN, here)
        theta, phi, psi, (w1, w2, w3) = here.theta, here.phi, here.psi, here.omega
        if theta in (0.0, np.pi):
            pole = np.cos(theta)  # 1' along omega, as it is just after the pole
            lean = np.angle(pole * (w1 + 1j * pole * w2))
            w1, w2, phi, psi = pole * np.hypot(w1, w2), 0.0, phi + lean, psi - pole * lean
        return State(theta, w1, w2, w3, phi, psi, y[X], y[Y])

    def _roll(self) -> bool:
        """Rolls on the ball, by the exact motion of rolling.py, until an event; returns whether the motion ends with
        it."""
        W, P, y, times, top = self.motion, self.P, self.motion.y, self.times, self.top
        state = self._state(y)
        rolling, floor = Rolling(top, None, state), min(gap(P, np.cos(state.theta), np.sin(state.theta)), 0.0)

        def margin(t: Array) -> Array:
            F = rolling(np.append(0.0, t)).force[1:].T
            return P.law.mu_s * F[2] - np.hypot(F[0], F[1]) + SLACK

        def room_left(t: Array) -> Array:
            theta = rolling.theta(t)
            return TOUCH - floor + gap(P, np.cos(theta), np.sin(theta))

        found: list[tuple[float, Event]] = [(first_below(margin, rolling.period), (SLIPS, BALL))]
        if P.stem:
            found.append((first_below(room_left, rolling.period), (TOUCHES, STEM)))
        if P.rim > -2:
            found.append((first_below(lambda t: np.cos(rolling.theta(t)) - P.rim, rolling.period), (RIM, BALL)))
        ends, event = min(found)
        done = int(W.samples)
        last = y[TIME] + ends
        for t, name in _noted(rolling, min(last, times[-1]) - y[TIME]):
            noted(W, self.log, name, y[TIME] + t)
        count = len(times) if not np.isfinite(ends) else max(int(np.searchsorted(times, last)), done)
        moved = rolling(np.array([y[TIME], *times[done:count]]))
        for name in SAMPLE.names:
            self.rows[name][done:count] = {"heat": y[HEAT], "regime": ROLLING}.get(name, getattr(moved, name)[1:])
        W.samples = count
        if count == len(times):
            return True
        one = rolling(np.array([0.0, ends]))
        theta, turn = one.theta[1], np.exp(1j * one.phi[1])
        v, m = versines(theta)
        u = complex(one.velocity[1, 0], one.velocity[1, 1]) * turn
        y[:] = y_of(P, theta, (v / 2) ** 0.5, float(m / 2) ** 0.5, turn, one.phi[1] + one.psi[1], one.omega[1], u,
                    complex(*one.com[1, :2]), last, y[HEAT])  # fmt: skip
        W.angles[:] = 0.0, one.phi[1]
        on_table(W, P, BALL)
        return bool(happens(W, P, self.log, event, self.flies))

    def _alone(self, stands_on: int) -> None:
        """The row of a single instant, for an event that ends the motion at once."""
        W, P = self.motion, self.P
        event, modes = next(entry.name for entry in self.log if EVENTS[entry.name][1] != NOTES), [OPEN, OPEN]
        if event != LIFTS_OFF:
            modes[stands_on] = SLIP
        W.contacts.F[:] = 0.0
        W.contacts.F[stands_on, 2] = float(event == STANDS_UPRIGHT)
        sample_at(W, P, modes[0], modes[1], self.rows[0])
        self.rows[0].slip = 0.0


def _noted(rolling: Rolling, ends: float) -> list[tuple[float, int]]:
    """The times, up to `ends`, and the names of what is noted while it rolls."""

    def value(t: Array, n: int) -> Array:
        moved = rolling(np.append(0.0, t))
        up, up_rate = np.cos(moved.theta), -np.sin(moved.theta) * moved.omega[:, 0]
        return cast(Array, noted_values(up[1:], up_rate[1:])[n])

    found, each = [], rolling.period
    for n, name in enumerate(NOTED):
        for first in zeros(partial(value, n=n), min(each, ends)):
            found += [(float(t), int(name)) for t in np.arange(first, ends, each)[:MOST_EVENTS]]
    return sorted(found)


def _support(supports: list[tuple[float, str]], t: float, what: str) -> None:
    """Adds (t, support), and drops a support that lasted for no time."""
    if supports and supports[-1][0] == t:
        supports.pop()
    if not supports or supports[-1][1] != what:
        supports.append((t, what))
