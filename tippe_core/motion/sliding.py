"""Motion with friction at the contact point, which is what turns a tippe top over.

The equations are in dynamics.py, their integration in stepper.py and following.py, and contacts, impacts and standing
in contacts.py, impact.py and standing.py. This file checks the arguments and builds the results.
"""

from collections.abc import Callable
from functools import partial
from typing import TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike

from ..errors import TopError, single
from ..paper.constants import State, versines
from ..paper.top import Top
from ..types import Array
from . import at, events, preparing
from .contacts import SLACK, TOUCH, tilt_guards
from .dynamics import carried
from .friction import LAWS, Friction
from .kinds import RIM, SLIPS, TOUCHES, Event
from .poses import REGIMES, ROLLING, sample_at
from .records import BALL, LOG, OPEN, SAMPLE, SLIP, STEM, Record, new
from .rolling import Rolling
from .run import HANDS_OVER, MORE, run
from .smooth import first_below, zeros
from .summary import begin
from .trajectory import ANOTHER_TOUCHES, Trajectory, checked_times, sunk

MOST_EVENTS = 10_000
MOST_STEPS = 4_000_000  # about half a minute
Progress: TypeAlias = Callable[[float], object] | None
STEPS_BETWEEN_CALLS = 32  # steps between two calls of progress


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
        in 900 (R/g)^1/2, C_J changes by about 4 rtol C_J. Creep (implicit.py): 5e-9 at least
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
        radius and height above O in R of the whole body, as from Shape.profile: the motion ends where a part of it
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
    single("top", top, Top)
    single("state", state, State)
    single("friction", friction, *LAWS)
    t = checked_times(times)
    if np.any(np.diff(t) < 0):
        raise TopError("times", times, "times[i] <= times[i + 1]", "Friction has no way back.", code="falling")
    preparing.check_balance(top, friction)
    losses = preparing.checked_losses(rolling_resistance, air_drag)
    P = preparing.problem(top, friction, preparing.checked_edge(edge), losses, preparing.checked_rtol(rtol))
    body = None if profile is None else preparing.checked_profile(profile)
    moved = _moved(top, state, friction, P, t, preparing.flies(landing), progress)
    first = len(moved) if body is None else sunk(moved, body)
    return moved if first == len(moved) else moved.until(max(first, 1), float(moved.t[first]), ANOTHER_TOUCHES)


def _moved(
    top: Top, state: State, friction: Friction, P: Record, times: Array, flies: bool, progress: Progress
) -> Trajectory:
    """slide() without a profile, after its arguments have been checked."""
    W = preparing.motion(*preparing.beginning(state, times[0], P))
    log, rows = np.zeros(2 * MOST_EVENTS, LOG), np.zeros(len(times), SAMPLE)
    stands_on, goes_on = preparing.start(W, P, state)
    begin(W, P, log, np.inf)
    first = carried(*W.modes) if goes_on else 1 + stands_on
    if not goes_on:
        events.logged(W, log, events.PAINLEVE, OPEN, OPEN)
    elif first == 0 and state.z is None:
        events.logged(W, log, events.LIFTS_OFF, OPEN, OPEN)
    if goes_on and (first or flies or state.z is not None):
        _fill_rows(top, W, P, log, times, rows, flies, progress)
    notes = [entry for entry in log[: W.logged] if events.EVENTS[entry.name][1] == events.NOTES]
    entries = [entry for entry in log[: W.logged] if events.EVENTS[entry.name][1] != events.NOTES]
    if not W.samples:
        _alone(W, P, stands_on, entries[0].name, rows[0])
    rows = rows[: max(W.samples, 1)]
    fields = rows.view(float).reshape(len(rows), -1)  # all of a row at once; a regime looks like a number close to 0
    followed = np.append(np.isfinite(fields).all(axis=1), np.isfinite(W.y).all())
    if not followed.all():
        raise TopError("friction", friction, "weaker friction for this top",
                       "The equations could not be followed past t = {t:.6g}{unit}.", code="not-followed",
                       t=float(times[max(int(followed.argmin()) - 1, 0)]), unit="")  # fmt: skip
    supports = [(float(times[0]), events.SUPPORTS[first])]
    for entry in entries:
        if entry.name != events.PAINLEVE:
            _support(supports, float(entry.t), events.SUPPORTS[entry.supports])
    parts = {name: rows[name].copy() for name in SAMPLE.names} | {"regime": REGIMES[rows["regime"]]}
    said, noted = (tuple((float(entry.t), events.EVENTS[entry.name][0]) for entry in some) for some in (entries, notes))
    return Trajectory(top=top, events=said, notes=noted, supports=tuple(supports), **parts)


def _fill_rows(
    top: Top, W: Record, P: Record, log: Array, times: Array, rows: Array, flies: bool, progress: Progress
) -> None:
    """Computes the rows at the times; progress is told which fraction of the time is done."""
    begins, ends, status = times[0], times[-1], MORE
    while status in (MORE, HANDS_OVER):
        status = run(
            W,
            P,
            log,
            times,
            rows,
            ends,
            flies,
            P.delta == P.drag == 0.0,
            STEPS_BETWEEN_CALLS if progress else MOST_STEPS,
        )
        if progress and status in (MORE, HANDS_OVER):
            progress(float(min(1.0, (W.y[at.TIME] - begins) / (ends - begins))) if ends > begins else 1.0)
        if status == HANDS_OVER and _roll(top, W, P, log, times, rows, flies):
            return
        if status == MORE and W.steps >= MOST_STEPS:
            events.logged(W, log, events.TOO_MANY_STEPS, *W.modes)
            return


def _alone(W: Record, P: Record, stands_on: int, event: int, row: Record) -> None:
    """The row of a single instant, for an event that ends the motion at once."""
    modes = [OPEN, OPEN]
    if event != events.LIFTS_OFF:
        modes[stands_on] = SLIP
    W.contacts.F[:] = 0.0
    W.contacts.F[stands_on, 2] = float(event == events.STANDS_UPRIGHT)
    sample_at(W, P, modes[0], modes[1], row)
    row.slip = 0.0


# ---- rolling on the ball ----


def _roll(top: Top, W: Record, P: Record, log: Array, times: Array, rows: Array, flies: bool) -> bool:
    """Rolls on the ball, by the exact motion of rolling.py, until an event; returns whether the motion ends with it."""
    y, done = W.y, int(W.samples)
    rolling = Rolling(top, None, _state(W, P))
    ends, event = _ends(rolling, P)
    last = y[at.TIME] + ends
    for t, name in _noted(rolling, min(last, times[-1]) - y[at.TIME]):
        events.noted(W, log, name, y[at.TIME] + t)
    count = len(times) if not np.isfinite(ends) else max(int(np.searchsorted(times, last)), done)
    moved = rolling(np.array([y[at.TIME], *times[done:count]]))
    for name in SAMPLE.names:
        rows[name][done:count] = {"heat": y[at.HEAT], "regime": ROLLING}.get(name, getattr(moved, name)[1:])
    W.samples = count
    if count == len(times):
        return True
    one = rolling(np.array([0.0, ends]))
    theta, turn = one.theta[1], np.exp(1j * one.phi[1])
    v, m = versines(theta)
    u = complex(one.velocity[1, 0], one.velocity[1, 1]) * turn
    y[:] = preparing.y_of(P, theta, (v / 2) ** 0.5, float(m / 2) ** 0.5, turn, one.phi[1] + one.psi[1], one.omega[1], u,
                          complex(*one.com[1, :2]), last, y[at.HEAT])  # fmt: skip
    W.angles[:] = 0.0, one.phi[1]
    preparing.on_table(W, P, BALL)
    return bool(events.happens(W, P, log, event, flies))


def _state(W: Record, P: Record) -> State:
    """The State at W.y, without the velocity of G."""
    here = new(SAMPLE)
    sample_at(W, P, OPEN, OPEN, here)
    theta, phi, psi, (w1, w2, w3) = here.theta, here.phi, here.psi, here.omega
    if theta in (0.0, np.pi):
        pole = np.cos(theta)  # 1' along omega, as it is just after the pole
        lean = np.angle(pole * (w1 + 1j * pole * w2))
        w1, w2, phi, psi = pole * np.hypot(w1, w2), 0.0, phi + lean, psi - pole * lean
    return State(theta, w1, w2, w3, phi, psi, *here.com[:2])


def _ends(rolling: Rolling, P: Record) -> tuple[float, Event]:
    """When the ball ceases to roll alone, inf if never, and by which event."""
    theta = rolling.start.theta
    floor = min(preparing.gap(P, np.cos(theta), np.sin(theta)), 0.0)

    def margin(t: Array) -> Array:
        F = rolling(np.append(0.0, t)).force[1:].T
        return P.law.mu_s * F[2] - np.hypot(F[0], F[1]) + SLACK

    def room_left(t: Array) -> Array:
        theta = rolling.theta(t)
        return TOUCH - floor + preparing.gap(P, np.cos(theta), np.sin(theta))

    found: list[tuple[float, Event]] = [(first_below(margin, rolling.period), (SLIPS, BALL))]
    if P.stem:
        found.append((first_below(room_left, rolling.period), (TOUCHES, STEM)))
    for n, least in enumerate(tilt_guards(np.cos(rolling.turning_points), P)):
        if min(least) < 0:
            tilts = partial(lambda t, n: tilt_guards(np.cos(rolling.theta(t)), P)[n], n=n)
            found.append((first_below(tilts, rolling.period), (RIM + n, BALL)))
    return min(found)


def _noted(rolling: Rolling, ends: float) -> list[tuple[float, int]]:
    """The times, up to `ends`, and the names of what is noted while it rolls."""

    def value(t: Array, n: int) -> Array:
        moved = rolling(np.append(0.0, t))
        up, up_rate = np.cos(moved.theta), -np.sin(moved.theta) * moved.omega[:, 0]
        return cast(Array, events.noted_values(up[1:], up_rate[1:])[n])

    found, each = [], rolling.period
    for n, name in enumerate(events.NOTED):
        for first in zeros(partial(value, n=n), min(each, ends)):
            found += [(float(t), int(name)) for t in np.arange(first, ends, each)[:MOST_EVENTS]]
    return sorted(found)


def _support(supports: list[tuple[float, str]], t: float, what: str) -> None:
    """Adds (t, support), and drops a support that lasted for no time."""
    if supports and supports[-1][0] == t:
        supports.pop()
    if not supports or supports[-1][1] != what:
        supports.append((t, what))
