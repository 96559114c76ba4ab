"""Motion with friction at the contact point: what turns a tippe top over.

Newton and Euler in space axes, r = z - a e from the contact point to G, e along axis 3, L about G, v of G:

    e' = w x e ,   L' = -r x F ,   v' = F - z ,   w = L/I1 + (1/I3 - 1/I1)(L . e) e ,
    slip  u = v - w x r ,   F = F_z (z - k u) ,   k(|u|) the friction law.

The top stays on the table, F_z = 1 - a e_z'', which is linear in F_z:

    F_z {1 + (a/I1) [a s^2 - r_z k (u . e)]} = 1 - a [L_z (L . e) - e_z L^2]/I1^2 .

No Euler angle: the orientation is that of a frame that has e as third axis and does not turn about it (quaternion p),
and the angle chi by which the body has turned in it, chi' = w3. Both are smooth through theta = 0 and pi.

Coulomb's friction has no direction at u = 0. So with it the unknowns are log|u| and the direction beta of u in place of
v, and the motion is followed in tau, where dt = dtau |u|/(|u| + SLOW): on the way to sticking and out of it |u| falls
or grows exponentially in tau and beta is smooth. That is a change of variables, not of the law. With the smooth laws
tau = t.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from math import cos, exp, isfinite, log, sin
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import LSODA
from scipy.optimize import brentq

from ..errors import TopError, finite, numbers
from ..paper.constants import State, versines
from ..paper.equations import f3_2
from ..paper.forces import contact_force
from ..paper.top import Top
from ..types import Array, Number, Rim, Vector
from .contacts import (
    EDGE,
    ENDS,
    LEAST,
    SLOW,
    SPHERE,
    SUPPORTS,
    TOUCH,
    Body,
    Dense,
    Modes,
    Progress,
    change,
    gap,
    pose,
    record,
    turning,
)
from .friction import Coulomb, Friction, SmoothedCoulomb, Viscous, holding
from .rolling import Rolling
from .smooth import first_below
from .trajectory import Trajectory, checked_times

# STILL: the last of the slip, which takes far less time than the 1e-9 to which events are located. SLACK (Mg): what
# rolling may need beyond mu_s F_z before it counts as slipping, above what so small a slip does to the forces.
STILL, SLACK, MOST_EVENTS = 1e-13, 1e-10, 1000
# MOST_CALLS of progress, about a millisecond apart: half a minute. LOG_FAST: a trial step faster than that is too long
# anyway, and its exponential may overflow.
MOST_CALLS, LOG_FAST = 25_000, 100.0

LOG_STILL = log(STILL)
Happened: TypeAlias = tuple[tuple[float, str], ...]  # times, and what


def slide(
    top: Top, state: State, friction: Friction, times: ArrayLike, rtol: float = 1e-9, landing: str = "stop",
    edge: ArrayLike | None = None, progress: Callable[[float], object] | None = None,
) -> Trajectory:  # fmt: skip
    """The motion with friction at the given times: Trajectory.

    state: State at times[0]; x, y, vx, vy left None mean G at the origin, at rest.
    friction: Coulomb(mu_k, mu_s), Viscous(gamma) or SmoothedCoulomb(mu, eps).
    times: (n,) in (R/g)^1/2, not falling. rtol: 1e-13 to 1e-3; over 300 (R/g)^1/2 of a turning top C_J drifts by some
    4 rtol of itself at rtol = 1e-9.

    landing: "stop", and the Trajectory ends where the top lifts off, at the last of the times before it; or "plastic":
    it flies, and lands without a bounce; friction acts in the impact by its own law, in proportion to the normal force
    and so to the normal impulse (contacts.py; that of Coulomb's law stops the slip if mu_s lets it, viscous friction
    takes some of it). It is the same where the stem touches, for either landing.
    edge: (radius, height above O along axis 3, rounding 0 if not given) in R of the edge of the stem's end, Shape.edge;
    or None, a whole sphere. A start tilted further than where it touches stands on the edge.
    progress: called now and then with the time reached; what it raises stops the run and passes through.

    events: (time, what), located to 1e-9: "sticks" and "slips" (Coulomb; "slips" also where the slip goes through 0
    without a halt and turns round), "lifts off" and "lands", or "lands on its
    stem"; "stem touches" or "ball touches" (the other carries on), "stem leaves", "stands on its stem" (the ball has
    left), "falls back on its ball". How many of ever smaller bounces between the two are listed depends on rtol. The
    Trajectory ends early, without a sample at the event, with
    "lifts off" where that stops it,
    "rim touches" where the sphere's surface ends before anything else touches (an edge on the sphere, as of a cut ball
    without a stem): what comes then is not computed,
    "stands upright" on its stem within 1e-3 rad of flat, without the energy to tip over the rim of the stem's end any
    more (standing.py); else the motion goes on over it: "rocks over" where the end comes down flat, an impact,
    "Painleve's limit" where no normal force balances the friction, or several do (contacts.py),
    "too many events" after 1000 of them: friction at its limit that chatters, or a top that hops on,
    "too many turns" after what takes about half a minute.
    A start that must leave the table is one sample in the air, or flies from the first; its first event is "lifts off".
    regime: "slip", or "roll" where Coulomb's friction holds the top; on the sphere that part is the exact one of
    rolling.py. heat: the work of friction and of impacts. supports: what carried the top, from when on.
    Raises TopError for bad input, and for friction so strong that no normal force balances it on the ball (Painleve).
    """
    if not isinstance(state, State):
        raise TopError("state", state, "a State")
    if not isinstance(friction, Coulomb | Viscous | SmoothedCoulomb):
        raise TopError("friction", friction, "Coulomb(mu_k, mu_s), Viscous(gamma) or SmoothedCoulomb(mu, eps)")
    t = checked_times(times)
    if np.any(np.diff(t) < 0):
        raise TopError("times", times, "times that do not fall", "Friction has no way back.")
    _check_balance(top, friction)
    rtol = finite("rtol", rtol)
    if not 1e-13 <= rtol <= 1e-3:
        raise TopError("rtol", rtol, "1e-13 <= rtol <= 1e-3")
    if landing not in ("stop", "plastic"):
        raise TopError("landing", landing, '"stop" or "plastic"')
    return _Run(top, friction, rtol / 10, _checked_edge(edge), landing == "plastic", _Limited(progress))(state, t)


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


class _Limited:
    """progress, or nothing; True once it was called too often."""

    def __init__(self, progress: Callable[[float], object] | None) -> None:
        self.progress, self.calls = progress, 0

    def __call__(self, t: float) -> bool:
        self.calls += 1
        if self.progress:
            self.progress(t)
        return self.calls > MOST_CALLS


def _checked_edge(edge: ArrayLike | None) -> Rim | None:
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


def _check_balance(top: Top, friction: Friction) -> None:
    """F_z must be positive for every direction of u: mu |a| r_z s < I1 + a^2 s^2 (Painleve)."""
    name, mu = next(((n, getattr(friction, n)) for n in ("mu_k", "mu") if hasattr(friction, n)), ("", 0.0))
    s, c = np.sin(theta := np.linspace(0, np.pi, 721)), np.cos(theta)
    arm = abs(top.a * (1 - top.a * c)) * s
    with np.errstate(divide="ignore"):
        most = np.min((top.I1 + (top.a * s) ** 2) / arm)
    if mu >= most:
        raise TopError(name, mu, f"{name} < {most:.6g} for this top",
                       "More friction than that no normal force balances (Painleve's paradox).")  # fmt: skip


class _Run:
    """One motion: stretches of slipping and of rolling, each a Trajectory of the times within it.

    y = (p_x, p_y, p_z, p_w, chi, L_x, L_y, L_z, v_x, v_y, x, y, t, heat), all in space axes; with Coulomb's friction
    the unknowns z are the same but for log|u|, beta in place of v_x, v_y.
    """

    def __init__(
        self, top: Top, friction: Friction, tolerance: float, edge: Rim | None, flies: bool, progress: Progress
    ) -> None:
        self.top, self.friction, self.tolerance, self.edge, self.progress = top, friction, tolerance, edge, progress
        # an edge on the sphere itself is where its surface ends: rim, cos(theta) there
        b, h, q = edge or (0.0, 0.0, 1.0)
        self.rim = -h / np.hypot(b, h) if edge and np.hypot(b, h) + q < 1 + 1e-6 else -2.0
        if self.rim > -2:
            self.edge = None
        self.flies, self.body = flies, Body(top, friction, tolerance, self.edge, progress)
        self.sticks, self.mu_s = isinstance(friction, Coulomb), holding(friction)
        self.mu_k = friction.mu_k if isinstance(friction, Coulomb) else 0.0

    def __call__(self, state: State, times: Array) -> Trajectory:
        y, modes = self._begin(state, times[0])
        stretches: list[Trajectory] = []
        events: list[tuple[float, str]] = []
        supports: list[tuple[float, str]] = []
        done = 0
        _support(supports, float(times[0]), {self._stands_on(state): None} if modes is None else modes)
        if modes == {}:
            events.append((float(times[0]), "lifts off"))
        while modes is not None and (modes or self.flies):
            _support(supports, float(y[12]), modes)
            stretch, y, event, now = self._stretch(y, times[done:], modes)
            stretches.append(stretch)
            done += len(stretch.t)
            if event is None:
                break
            events.append((float(y[12]), event))
            if event in ENDS.values() or event == "rim touches":
                break
            if len(events) >= MOST_EVENTS:
                events.append((float(y[12]), "too many events"))
                break
            modes = now
        if modes is None:
            events.append((float(y[12]), "Painleve's limit"))
        if not done:
            stretches.append(self.body.start_alone(y, times[:1], events[-1][1], self._stands_on(state)))
        return _joined(self.top, stretches, tuple(events), tuple(supports))

    def _begin(self, state: State, t: float) -> tuple[Array, Modes | None]:
        """y at a State, and the modes (see Body) in which it goes on: {} where it leaves the table at once, or None, as
        settle() has it."""
        y = self._start(state, t)
        if np.cos(state.theta) < self.rim:
            raise TopError("theta", state.theta, f"less than {np.arccos(self.rim):.6g} for this top",
                           "The sphere's surface ends there.")  # fmt: skip
        if self._stands_on(state) == EDGE:
            return self.body.settle(self.body.on_edge(y), ("starts", None))
        if self.sticks and np.hypot(*_slip(self.top, y)) < 1e-12 and self._holds(y):
            return y, {SPHERE: "stick"}
        presses, lifts = self._carries(self._unknowns(self._let_go(y) if self.sticks else y))
        if presses < 0:
            return self.body.on_sphere(y), {}
        return y, {SPHERE: "slip"} if lifts >= LEAST else None

    def _stands_on(self, state: State) -> int:
        """The contact that carries at a State."""
        return EDGE if self.edge and gap(self.edge, np.cos(state.theta), np.sin(state.theta)) < 0 else SPHERE

    def _stretch(self, y: Array, times: Array, modes: Modes) -> tuple[Trajectory, Array, str | None, Modes | None]:
        """A Trajectory of the times before the next event, the state then, its name and the modes (see Body) after it.

        At the end of the times the name is None.
        """
        if tuple(modes) != (SPHERE,):
            stretch, y, event = self.body.follow(y, times, modes) if modes else self.body.fly(y, times)
            if event is None:
                return stretch, y, None, modes
            if event[0] in ENDS:
                return stretch, y, ENDS[event[0]], modes
        else:
            y = y[:14]
            self._floor = min(self._room(y), 0.0) if self.edge else 0.0
            if modes[SPHERE] == "stick":
                stretch, y, event = self._roll(y, times)
            else:
                stretch, y, event = self._slip(self._let_go(y) if self.sticks else y, times)
            if event in ENDS.values():
                return stretch, y, event, modes
            if event in (None, "sticks", "slips"):
                return stretch, y, event, {SPHERE: "stick" if event == "sticks" else "slip"}
            y = self.body.on_sphere(y)
            if event in ("lifts off", "rim touches"):
                return stretch, y, event, {}
            event = "touches", EDGE
        y, now = self.body.settle(y, event)
        if now is None:
            left = {i: mode for i, mode in modes.items() if event != ("leaves", i)}
            return stretch, y, change(modes, left, event), None
        if event[0] == "rocks" and self.body.stays_flat(y, now):
            return stretch, y, ENDS["stands"], now
        if turning(self.top, y)[0][2] < self.rim:
            return stretch, y, "rim touches", {}
        return stretch, y, change(modes, now, event), now

    # ---- slipping ----

    def _rates(self, tau: float, z: Array) -> Sequence[float]:
        top, z = self.top, z.tolist()
        e, w, L3, carried = turning(top, z)
        (ex, ey, ez), (wx, wy, wz), (px, py, pz, pw) = e, w, z[:4]
        a, rz, w3 = top.a, 1 - top.a * ez, L3 / top.I3
        if self.sticks:
            speed, out_x, out_y = exp(min(z[8], LOG_FAST)), cos(z[9]), sin(z[9])
            vx, vy = speed * out_x + carried[0], speed * out_y + carried[1]
            push = self.mu_k * out_x, self.mu_k * out_y
        else:
            vx, vy = z[8:10]
            push = _push(self.friction, vx - carried[0], vy - carried[1])
        Fx, Fy, Fz = _force(top, z, e, L3, push)
        torque = a * ey * Fz + rz * Fy, -a * ex * Fz - rz * Fx, a * (ex * Fy - ey * Fx)  # -r x F
        ox, oy, oz = (wx - w3 * ex) / 2, (wy - w3 * ey) / 2, (wz - w3 * ez) / 2  # half the frame's angular velocity
        rates = (
            ox * pw + oy * pz - oz * py, oy * pw + oz * px - ox * pz,
            oz * pw + ox * py - oy * px, -ox * px - oy * py - oz * pz, w3,
            *torque, Fx, Fy, vx, vy, 1.0, (carried[0] - vx) * Fx + (carried[1] - vy) * Fy)  # fmt: skip
        if not self.sticks:
            return rates
        x_dot, y_dot = self._slip_rate(e, w, L3, torque, (Fx, Fy))
        g = 1 / (speed + SLOW)
        rates = [g * speed * rate for rate in rates]
        rates[8:10] = g * (x_dot * out_x + y_dot * out_y), g * (y_dot * out_x - x_dot * out_y)
        return rates

    def _slip_rate(
        self, e: Vector, w: Vector, L3: float, torque: Vector, F_h: tuple[float, float]
    ) -> tuple[float, float]:
        """u' = v' - w' x r - w x r', with r' = -a e'."""
        top = self.top
        a, more, (ex, ey, ez), (wx, wy, wz) = top.a, 1 / top.I3 - 1 / top.I1, e, w
        ex_, ey_, ez_ = wy * ez - wz * ey, wz * ex - wx * ez, wx * ey - wy * ex
        along, across = more * (torque[0] * ex + torque[1] * ey + torque[2] * ez), more * L3
        wx_ = torque[0] / top.I1 + along * ex + across * ex_  # L . e' = 0
        wy_ = torque[1] / top.I1 + along * ey + across * ey_
        wz_ = torque[2] / top.I1 + along * ez + across * ez_
        rz = 1 - a * ez
        return (F_h[0] - (wy_ * rz + a * wz_ * ey) + a * (wy * ez_ - wz * ey_),
                F_h[1] + (wx_ * rz + a * wz_ * ex) + a * (wz * ex_ - wx * ez_))  # fmt: skip

    def _unknowns(self, y: Array) -> Array:
        """z of y."""
        z = np.array(y)
        if self.sticks:
            ux, uy = _slip(self.top, y)
            z[8:10] = np.log(np.hypot(ux, uy)), np.arctan2(uy, ux)
        return z

    def _known(self, z: Array) -> Array:
        """y of z (14, ...)."""
        y = np.array(z)
        if self.sticks:
            speed = np.exp(z[8])
            carried = turning(self.top, z)[3]
            y[8], y[9] = speed * np.cos(z[9]) + carried[0], speed * np.sin(z[9]) + carried[1]
        return y

    def _carries(self, z: Sequence[Number] | Array) -> tuple[Number, Number]:
        """F_z times what is left of u_z' by it, and that: below 0 the top lifts off; below LEAST no F_z balances."""
        e, _, L3, carried = turning(self.top, z)
        if self.sticks:
            push = self.mu_k * np.cos(z[9]), self.mu_k * np.sin(z[9])
        else:
            push = _push(self.friction, z[8] - carried[0], z[9] - carried[1])
        return _presses(self.top, z, e, L3), _lifts(self.top, e, push)

    def _slip(self, y: Array, times: Array) -> tuple[Trajectory, Array, str | None]:
        """A Trajectory of the times before the next event, the state then, and the event (None: the times are over)."""
        end, z = times[-1], self._unknowns(y)
        atol = np.full(14, self.tolerance)
        atol[5:8] *= max(1.0, float(np.linalg.norm(z[5:8])))
        begin, bound = (0.0, np.inf) if self.sticks else (z[12], end)
        solver = LSODA(self._rates, begin, z, bound, rtol=1e-13, atol=atol)
        done, event = int(np.searchsorted(times, z[12], "right")), None
        path, rows = [z], [np.tile(z, (done, 1))]
        while z[12] < end and event is None:
            last = z
            if solver.step() or not isfinite(sum(carries := self._carries(solver.y.tolist()))):
                raise TopError("friction", self.friction, "weaker friction for this top",
                               f"The equations could not be followed past t = {last[12]:.6g}.")  # fmt: skip
            z, dense = solver.y, None
            if not self.sticks:
                z[12] = solver.t  # without the rounding of its integration
            ez = 1 - 2 * (z[0] * z[0] + z[1] * z[1])
            if min(carries) < 0.1 or ez < self.rim or (self.edge and self._room(z) < 0.1):
                dense = solver.dense_output()
                tau, event = self._leaves(dense)
                if event is not None:
                    z = dense(tau)
                    times = times[times <= z[12]]
            if len(path) % 64 == 0 and self.progress(float(z[12])) and event is None:
                event = ENDS["turns"]
            if event is None and self.sticks and z[8] < min(last[8], LOG_STILL):
                holds, gone = self._holds(z), z[8] < 2 * LOG_STILL  # near the limit of friction it may hold yet
                if not gone and holds:
                    left = exp(z[8]) * (z[12] - last[12]) / (exp(last[8]) - exp(z[8]))  # until u = 0
                    z = z + left * np.array(self._rates(0.0, z)) * (1 + SLOW / exp(z[8]))
                if gone or holds:
                    z[8], event = -np.inf, "sticks" if holds else "slips"
            count = int(np.searchsorted(times, z[12], "right"))
            if count > done:
                rows.append(self._at(times[done:count], dense or solver.dense_output()))
                done = count
            path.append(z)
        samples = np.concatenate(rows)
        samples[:, 12] = times[:done]
        return self._trajectory(self._known(samples.T), np.array(path).T), self._known(z), event

    def _at(self, times: Array, dense: Dense) -> Array:
        """z (n, 13) at times within the last step."""
        if not self.sticks:
            return dense(times).T
        tau, limit = np.full(len(times), dense.t), 2 * dense.t - dense.t_old
        for _ in range(20):  # Newton's steps
            z = dense(tau)
            missing = times - z[12]
            if np.all(np.abs(missing) < 1e-13 * (1 + np.abs(times))):
                break
            tau = np.clip(tau + missing * (1 + SLOW / np.exp(z[8])), dense.t_old, limit)
        return dense(tau).T

    def _room(self, z: Sequence[Number] | Array) -> Number:
        """Height of the stem's edge above the table."""
        px, py, pz, pw = z[:4]
        return gap(self.body.edge, 1 - 2 * (px * px + py * py), 2 * np.sqrt((px * px + py * py) * (pz * pz + pw * pw)))

    def _nears(self, z: Array) -> Number:
        """Falls below 0 where the edge is at the table and falls (e_z' < 0), even if it has just left it."""
        (ex, ey, _), (wx, wy, _), _, _ = turning(self.top, z)
        return np.maximum(self._room(z) - self._floor + TOUCH, wx * ey - wy * ex + SLACK)

    def _leaves(self, dense: Dense) -> tuple[float, str | None]:
        """The first tau of the last step at which the sphere no longer carries alone, and what happens there."""
        taus, found = np.linspace(dense.t_old, dense.t, 9), (np.inf, None)
        guards: dict[str, Callable[[Array], Number]]
        guards = {"lifts off": lambda z: self._carries(z)[0], ENDS["balances"]: lambda z: self._carries(z)[1] - LEAST,
                  "rim touches": lambda z: turning(self.top, z)[0][2] - self.rim}  # fmt: skip
        if self.edge:
            guards["stem touches"] = self._nears
        for event, guard in guards.items():
            below = np.flatnonzero(guard(dense(taus)) < 0)
            if below.size:
                i = below[0]
                if event == "stem touches" and i and self._room(dense(taus[i - 1])) > 0:
                    guard = self._room
                between = taus[i - 1 : i + 1]
                tau = brentq(lambda tau, g=guard: g(dense(tau)), *between, xtol=1e-15) if i else taus[0]
                found = min(found, (tau, event))
        return found

    # ---- sticking and letting go ----

    def _state(self, y: Array) -> State:
        """The State at y, with G's velocity unsaid."""
        theta, phi, psi, (w1, w2, w3) = (part.T[0] for part in pose(self.top, y[:, None], y[:, None]))
        if theta in (0.0, np.pi):
            pole = np.cos(theta)  # 1' along omega, as it is just after the pole
            lean = np.angle(pole * (w1 + 1j * pole * w2))
            w1, w2, phi, psi = pole * np.hypot(w1, w2), 0.0, phi + lean, psi - pole * lean
        return State(theta, w1, w2, w3, phi, psi, y[10], y[11])

    def _holds(self, y: Array) -> bool:
        """Whether rolling would need no more friction than mu_s F_z here."""
        return bool(_margin(rolling_force(self.top, self._state(y)), self.mu_s) >= 0)

    def _roll(self, y: Array, times: Array) -> tuple[Trajectory, Array, str | None]:
        """As _slip, without slipping: by the exact motion of rolling.py."""
        state = self._state(y)
        rolling = Rolling(self.top, None, state)

        def margin(t: Array) -> Array:
            return _margin(rolling(np.append(0.0, t)).force[1:].T, self.mu_s) + SLACK

        def tilt(t: Array) -> Array:
            return rolling.theta(np.append(0.0, t))[1:]

        def room(t: Array) -> Array:
            theta = tilt(t)
            return TOUCH - self._floor + gap(self.body.edge, np.cos(theta), np.sin(theta))

        self.progress(float(y[12]))
        ends, event = first_below(margin, rolling.period), "slips"
        if self.edge and (touches := first_below(room, rolling.period)) < ends:
            ends, event = touches, "stem touches"
        if self.rim > -2 and (touches := first_below(lambda t: np.cos(tilt(t)) - self.rim, rolling.period)) < ends:
            ends, event = touches, "rim touches"
        count = int(np.searchsorted(times, y[12] + ends)) if np.isfinite(ends) else len(times)
        # the first time is where the stretch starts
        stretch = _cut(rolling(np.array([y[12], *times[:count]])), slice(1, None), y[13])
        if count == len(times):
            return stretch, y, None
        last = _cut(rolling(np.array([0.0, ends])), slice(1, None), y[13])
        return stretch, self._from_trajectory(last, y[12] + ends), event

    def _let_go(self, y: Array) -> Array:
        """y with the least slip, if it has none, in the direction in which slipping starts: u' along u, outward."""
        if np.hypot(*_slip(self.top, y)) >= STILL:
            return y
        z = np.array(y)
        z[8] = LOG_STILL

        def start(beta: float) -> Sequence[float]:
            """u' at no slip, in the direction beta of u: (outward, across)."""
            z[9] = beta
            return self._rates(0.0, z)[8:10]

        grid = np.linspace(0, 2 * np.pi, 65)
        across = np.array([start(beta)[1] for beta in grid])
        found = [brentq(lambda beta: start(beta)[1], grid[i], grid[i + 1])
                 for i in np.flatnonzero(across[:-1] * across[1:] <= 0)]  # fmt: skip
        z[9] = max(found, key=lambda beta: start(beta)[0])
        return self._known(z)

    # ---- between y and what is said of it ----

    def _start(self, state: State, t: float) -> Array:
        """y at a State."""
        s, c = np.sin(state.theta / 2), np.cos(state.theta / 2)
        turn = np.exp(1j * state.phi)
        v = complex(state.vx or 0.0, state.vy or 0.0) * turn
        return self._y(state.theta, s, c, turn, state.phi + state.psi, (state.theta_dot, state.omega2, state.omega3),
                       v, complex(state.x or 0.0, state.y or 0.0), t, 0.0)  # fmt: skip

    def _from_trajectory(self, one: Trajectory, t: float) -> Array:
        """y at the only instant of a Trajectory."""
        theta, turn = one.theta[0], np.exp(1j * one.phi[0])
        v, m = versines(theta)
        w1, w2, w3 = one.omega[0]
        s, c = np.sin(theta), 1 - v
        vx = w2 * (c - self.top.a) - w3 * s
        vy = -w1 * (1 - self.top.a * c)
        return self._y(theta, (v / 2) ** 0.5, float(m / 2) ** 0.5, turn, one.phi[0] + one.psi[0], one.omega[0],
                       complex(vx, vy) * turn, complex(*one.com[0, :2]), t, one.heat[0])  # fmt: skip

    def _y(
        self, theta: float, sin_half: Number, cos_half: float, turn: complex, chi: float, omega: Vector | Array,
        v: complex, place: complex, t: float, heat: float,
    ) -> Array:  # fmt: skip
        # p = Rz(phi) Rx(theta) Rz(-phi)
        L1, L2, L3 = np.array([self.top.I1, self.top.I1, self.top.I3]) * omega
        s, c = np.sin(theta), np.cos(theta)
        p, L = sin_half * turn, complex(L1, c * L2 - s * L3) * turn
        return np.array([p.real, p.imag, 0.0, cos_half, chi, L.real, L.imag, s * L2 + c * L3,
                         v.real, v.imag, place.real, place.imag, t, heat])  # fmt: skip

    def _trajectory(self, y: Array, path: Array) -> Trajectory:
        """The Trajectory of slipping at y (14, n); path as in pose."""
        top = self.top
        e, _, L3, carried = turning(top, y)
        u = y[8] - carried[0], y[9] - carried[1]
        return record(top, y, path, u, _force(top, y, e, L3, _push(self.friction, *u)))


# ---- the equations above, for floats or arrays ----


def _slip(top: Top, y: Sequence[Number] | Array) -> tuple[Number, Number]:
    """u = v - w x r"""
    carried = turning(top, y)[3]
    return y[8] - carried[0], y[9] - carried[1]


def _push(friction: Friction, ux: Number, uy: Number) -> tuple[Number, Number]:
    """k u"""
    k = friction.k(ux * ux + uy * uy)
    return k * ux, k * uy


def _presses(top: Top, y: Sequence[Number] | Array, e: Vector, L3: Number) -> Number:
    """1 - a [L_z (L . e) - e_z L^2]/I1^2"""
    Lx, Ly, Lz = y[5:8]
    return 1 - top.a * (Lz * L3 - e[2] * (Lx * Lx + Ly * Ly + Lz * Lz)) / (top.I1 * top.I1)


def _lifts(top: Top, e: Vector, push: tuple[Number, Number]) -> Number:
    """1 + (a/I1) [a s^2 - r_z k (u . e)]: what is left of u_z' by F_z"""
    a, (ex, ey, ez), (kx, ky) = top.a, e, push
    return 1 + a / top.I1 * (a * (ex * ex + ey * ey) - (1 - a * ez) * (kx * ex + ky * ey))


def _force(top: Top, y: Sequence[Number] | Array, e: Vector, L3: Number, push: tuple[Number, Number]) -> Vector:
    """F = F_z (z - k u)"""
    Fz = _presses(top, y, e, L3) / _lifts(top, e, push)
    return -push[0] * Fz, -push[1] * Fz, Fz


def rolling_force(top: Top, state: State) -> Vector:
    """(F_x, F_y, F_z) by (37) to (39) that a top needs at a State in order to roll on without slipping."""
    v, m = versines(state.theta)
    K_R = np.sqrt(f3_2(1 - v, v * m, top)) * state.omega3
    w1, w2 = state.theta_dot, state.omega2
    return contact_force(v, m, top, K_R, w1, w1 * w1, w2, state.omega3)


def _margin(force: Vector | Array, mu_s: float) -> Number:
    """mu_s F_z - F_h"""
    return mu_s * force[2] - np.hypot(force[0], force[1])


_PARTS = ("t", "theta", "phi", "psi", "quaternion", "contact", "com", "omega", "slip", "force", "regime", "velocity",
          "heat")  # fmt: skip


def _cut(trajectory: Trajectory, part: slice, heat: float) -> Trajectory:
    parts = {name: getattr(trajectory, name)[part] for name in _PARTS}
    return Trajectory(top=trajectory.top, **parts | {"heat": np.full(len(parts["t"]), heat)})


def _support(supports: list[tuple[float, str]], t: float, modes: Iterable[int]) -> None:
    """Adds (t, what carries); what carried for no time goes."""
    what = SUPPORTS[tuple(sorted(modes))]
    if supports and supports[-1][0] == t:
        supports.pop()
    if not supports or supports[-1][1] != what:
        supports.append((t, what))


def _joined(top: Top, stretches: list[Trajectory], events: Happened, supports: Happened) -> Trajectory:
    return Trajectory(top=top, events=events, supports=supports,
                      **{name: np.concatenate([getattr(s, name) for s in stretches]) for name in _PARTS})  # fmt: skip
