"""Motion with friction at the contact point, which is what turns a tippe top over.

The equations are in dynamics.py, their integration in stepper.py, implicit.py and run.py, and contacts, impacts and
standing in contacts.py, impact.py and standing.py. This file checks the arguments and builds the results.
"""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..errors import TopError, checked, finite
from ..paper.constants import State
from ..paper.top import Top
from ..types import Array
from . import at, events, preparing
from .dynamics import carried
from .friction import Friction
from .kinds import NONE, STARTS, TOUCHES
from .poses import REGIMES, sample_at
from .records import BALL, LOG, OPEN, SAMPLE, SLIP, STEM, modes_of
from .rolling_part import RollingPart
from .run import ENDED, HANDS_OVER, MORE, run
from .summary import begin
from .trajectory import ANOTHER_TOUCHES, Trajectory, checked_times, sunk

MOST_EVENTS = 10_000
MOST_STEPS = 4_000_000  # about half a minute
Progress: TypeAlias = Callable[[float], object] | None
STEPS_BETWEEN_CALLS = 32  # steps between two calls of progress


@checked
def slide(
    top: Top, state: State, friction: Friction, times: ArrayLike, rtol: float = 1e-9, landing: str = "plastic",
    edge: ArrayLike | None = None, rolling_resistance: float = 0.0, air_drag: float = 0.0,
    progress: Callable[[float], object] | None = None, profile: ArrayLike | None = None,
) -> Trajectory:  # fmt: skip
    """The motion with friction at the given times.

    Parameters
    ----------
    top : Top
        the top
    state : State
        at times[0]; x, y, vx, vy None mean that G is at the origin, at rest
    friction : Friction
        Coulomb(mu_k, mu_s), Viscous(gamma), SmoothedCoulomb(mu, eps) or Contensou(mu, radius)
    times : array (n,)
        in (R/g)^1/2, not decreasing
    rtol : float
        1e-13 to 1e-3, the error of one step relative to 1 rad, |L|, |v|, R and the energy. While a top turns over,
        in 900 (R/g)^1/2, C_J changes by about 4 rtol C_J. Creep (implicit.py): 5e-9 at least; the slip's
        direction has 1e-4, so that energy and heat together change by about 1e-6 of the heat. With a patch below
        2e-4 R that creeps they change by more, at rtol above 1e-9 by up to half of it: compare a second rtol
    landing : str
        "plastic": a top that leaves the table flies and lands without a bounce. "stop": the motion ends when it
        lifts off
    edge : array or None
        (radius, height above O along axis 3, rounding or 0) in R of the edge of the stem's end, as in Shape.edge;
        None for a whole sphere. If theta at the start is beyond the angle at which the edge touches, the top starts
        on the edge
    rolling_resistance : float
        delta in R, a torque -delta F_z omega_h/|omega_h| against the horizontal part of omega (smoothed below 1e-3
        (g/R)^1/2)
    air_drag : float
        k in MR^2 (g/R)^1/2, a torque -k omega. Both add to heat
    progress : callable or None
        called now and then with the fraction of the time that is done; an exception that it raises stops the run
        and is passed on
    profile : array (k, 2) or None
        radius and height above O in R of the whole body, Shape.profile(n) / Shape.R: the motion ends where a part of it
        other than the ball and the edge is below the table at one of the times

    Returns
    -------
    Trajectory
        regime "slip", or "roll" while friction makes the top roll; with Coulomb's law, and without rolling
        resistance or air drag, the parts that roll on the sphere are the exact motion of rolling.py

    Raises
    ------
    TopError
        for bad input, and if the friction is so strong that no normal force balances it on the ball (Painleve's
        paradox)

    Notes
    -----
    In an impact friction follows its own law, with the normal impulse in place of the normal force (impact.py): a law
    with static friction stops the slip if mu_s is large enough, viscous friction reduces it.

    events are located to 1e-9. "sticks" and "slips" (laws with static friction; "slips" also when the slip passes
    through 0 and reverses without a halt); "lifts off" and "lands", or "lands on its stem"; "stem touches" or "ball
    touches" (while the other carries), "stem leaves", "stands on its stem" (the ball has left the table), "falls back
    on its ball"; "rocks over" when the flat end of the stem comes down, which is an impact. If there is a series of
    ever smaller bounces between the two, rtol determines how many are listed. A top that leaves the table at once gives
    a single sample in the air, or flies from the start; its first event is "lifts off".

    These events end the Trajectory early, without a sample at the event: "lifts off" if landing is to stop it; "another
    part touches" if there is a profile, and at one of the times a point of it is more than 1e-3 R below the table; "rim
    touches" if the sphere's surface ends before anything else touches (an edge on the sphere, as of a cut ball without
    a stem), because what follows is not computed; "stands upright" if it is on its stem within 1e-3 rad of flat,
    without enough energy to tip over the rim of the stem's end (standing.py); "Painleve's limit" if no normal force
    balances the friction, or several do (contacts.py); "too many events" after 10,000 of them, for example if friction
    chatters at its limit or the top keeps hopping; "too many steps" after as many as take about half a minute.
    """
    t = checked_times(times)
    sliding = Sliding(top, state, friction, float(t[0]), rtol, landing, edge, rolling_resistance, air_drag, profile)
    return sliding.until(t, progress)


class Sliding:
    """The motion with friction as an object that goes on from where it was; arguments as in slide(), without the times.

    Parameters
    ----------
    top, state, friction
        as in slide()
    begins : float
        the time of the state, (R/g)^1/2
    rtol, landing, edge, rolling_resistance, air_drag, profile
        as in slide()

    Attributes
    ----------
    ended : bool
        whether an event has ended the motion, so that it does not go on
    trajectory : Trajectory
        the motion so far

    Raises
    ------
    TopError
        as slide()

    Notes
    -----
    Its steps do not depend on the times, so what it gives after it has gone on is equal, to the last bit, to what
    slide() gives for all of the times at once.
    """

    @checked
    def __init__(
        self, top: Top, state: State, friction: Friction, begins: float = 0.0, rtol: float = 1e-9,
        landing: str = "plastic", edge: ArrayLike | None = None, rolling_resistance: float = 0.0, air_drag: float = 0.0,
        profile: ArrayLike | None = None,
    ) -> None:  # fmt: skip
        self.top, self.friction = top, friction
        preparing.check_balance(top, friction)
        losses = preparing.checked_losses(rolling_resistance, air_drag)
        self._body = None if profile is None else preparing.checked_profile(profile)
        self._flies = preparing.flies(landing)
        P = self._P = preparing.problem(
            top, friction, preparing.checked_edge(edge), losses, preparing.checked_rtol(rtol)
        )
        W = self._W = preparing.motion(*preparing.beginning(state, finite("begins", begins), P))
        self._log: Any = np.zeros(2 * MOST_EVENTS, LOG)
        self._rows: Any = np.zeros(0, SAMPLE)
        self._last = self._begins = float(begins)
        self._part: RollingPart | None = None
        self._sinks: tuple[int, float] | None = None  # the row, and the time, at which another part touches
        (kind, self._stands_on), goes_on = preparing.start(W, P, state)
        begin(W, P, self._log, np.inf)
        self._first = carried(modes_of(W)) if goes_on else 1 + self._stands_on
        if not goes_on:
            events.logged(W, self._log, events.PAINLEVE, (OPEN, OPEN))
        elif kind == TOUCHES:
            events.lands(W, self._log, (kind, self._stands_on))
        elif self._first == 0 and kind == STARTS:
            events.logged(W, self._log, events.LIFTS_OFF, (OPEN, OPEN))
        self.ended = not (goes_on and (self._first or self._flies or kind == NONE))

    def until(self, times: ArrayLike, progress: Progress = None) -> Trajectory:
        """Goes on, at these times.

        Parameters
        ----------
        times : array (n,)
            in (R/g)^1/2, not decreasing, and none before those of an earlier call
        progress : callable or None
            as in slide(), with the fraction of the time since the last of the earlier times. If it raises an exception,
            the motion goes on from there at the next call

        Returns
        -------
        Trajectory
            at these times and all earlier ones, as from slide()

        Raises
        ------
        TopError
            for times that decrease, and where the equations cannot be followed
        """
        t = checked_times(times, forward=True)
        if t[0] < self._last:
            raise TopError("times", times, "{first:.10g} to {last:.10g}", code="outside-times", first=self._last,
                           last=np.inf)  # fmt: skip
        rows = np.zeros(len(t), SAMPLE)
        if not self.ended:
            self._W.samples = 0
            try:
                self._fill(t, rows, progress)
            finally:
                self._add(t, rows[: self._W.samples])
            if progress and not self.ended:
                progress(1.0)
        return self.trajectory

    @property
    def trajectory(self) -> Trajectory:
        """The motion so far, at all of the times."""
        rows, noted, entries = self._rows, list[tuple[float, str]](), list[tuple[float, str]]()
        if not len(rows):
            rows = self._alone()
        supports = [(self._begins, events.SUPPORTS[self._first])]
        for entry in self._log[: self._W.logged]:
            t, (name, what) = float(entry.t), events.EVENTS[entry.name]
            if what == events.NOTES:
                noted += [(t, name)] * (t <= self._last)
                continue
            entries.append((t, name))
            if entry.name != events.PAINLEVE:
                _support(supports, t, events.SUPPORTS[entry.supports])
        parts = {name: rows[name].copy() for name in SAMPLE.names} | {"regime": REGIMES[rows["regime"]]}
        moved = Trajectory(top=self.top, events=tuple(entries), notes=tuple(noted), supports=tuple(supports), **parts)
        return moved if self._sinks is None else moved.until(*self._sinks, ANOTHER_TOUCHES)

    def _fill(self, times: Array, rows: Array, progress: Progress) -> None:
        """Computes the rows at the times, and whether the motion ends; progress is told which fraction is done."""
        W, P, log, begins, ends, status = self._W, self._P, self._log, self._last, times[-1], MORE
        exact, steps = P.delta == P.drag == 0.0, STEPS_BETWEEN_CALLS if progress else MOST_STEPS
        while status in (MORE, HANDS_OVER):
            status = HANDS_OVER if self._part else run(W, P, log, times, rows, np.inf, self._flies, exact, steps)
            self.ended = status == ENDED
            if progress and status in (MORE, HANDS_OVER) and ends > begins:
                progress(float(min(1.0, (W.y[at.TIME] - begins) / (ends - begins))))
            if status == HANDS_OVER and self._rolls(times, rows):
                return
            if status == MORE and W.steps >= MOST_STEPS:
                events.logged(W, log, events.TOO_MANY_STEPS, modes_of(W))
                self.ended = True
                return

    def _add(self, times: Array, rows: Any) -> None:
        """Adds the rows at the first of the times. Raises TopError unless they, and y, are finite."""
        fields = rows.view(float).reshape(len(rows), SAMPLE.itemsize // 8)  # a regime looks like 0
        followed = np.append(np.isfinite(fields).all(axis=1), np.isfinite(self._W.y).all())
        if not followed.all():
            raise TopError("friction", self.friction, "weaker friction for this top",
                           "The equations could not be followed past t = {t:.6g}{unit}.", code="not-followed",
                           t=float(times[max(int(followed.argmin()) - 1, 0)]), unit="")  # fmt: skip
        before, self._rows = len(self._rows), np.concatenate([self._rows, rows])
        self._last = float(times[-1] if self.ended else rows["t"][-1] if len(rows) else self._last)
        if self._body is not None and len(rows):
            first = before + sunk(self.trajectory[before:], self._body)
            if first < len(self._rows):
                self._sinks, self.ended = (max(first, 1), float(self._rows["t"][first])), True

    def _alone(self) -> Any:
        """The row of a single instant, where an event ends the motion at once."""
        W, modes, rows = self._W, [OPEN, OPEN], np.zeros(1, SAMPLE)
        event = next((each.name for each in self._log[: W.logged] if events.EVENTS[each.name][1] != events.NOTES), None)
        if event != events.LIFTS_OFF:
            modes[self._stands_on] = SLIP
        W.contacts.F[:] = 0.0
        W.contacts.F[self._stands_on, 2] = float(event == events.STANDS_UPRIGHT)
        sample_at(W, self._P, (modes[BALL], modes[STEM]), rows[0])
        rows["slip"] = 0.0
        return rows

    def _rolls(self, times: Array, rows: Array) -> bool:
        """Rolls on the ball until an event; returns whether that, or the last of the times, is the end."""
        W, P, log, done = self._W, self._P, self._log, int(self._W.samples)
        if self._part is None:
            self._part = RollingPart.of(self.top, W, P)
        part, ends = self._part, self._part.ends
        for t, name in sorted(part.noted(self._last, min(ends, times[-1]))):
            events.noted(W, log, name, t)
        W.samples = len(times) if not np.isfinite(ends) else max(int(np.searchsorted(times, ends)), done)
        part.fill(times[done : W.samples], rows[done : W.samples])
        if W.samples == len(times):
            return True
        self._part = None
        part.end(W, P)
        self.ended = bool(events.happens(W, P, log, part.event, self._flies))
        return self.ended


def _support(supports: list[tuple[float, str]], t: float, what: str) -> None:
    """Adds (t, support), and drops a support that lasted for no time."""
    if supports and supports[-1][0] == t:
        supports.pop()
    if not supports or supports[-1][1] != what:
        supports.append((t, what))
