"""The top in the air, on the edge of its stem's end, on both at once; and what happens when something touches.

Newton and Euler about G for contacts at rho_i from G, w = L/I1 + k (L . e) e, k = 1/I3 - 1/I1:

    v' = sum F_i - z ,   L' = sum rho_i x F_i ,   w' = L'/I1 + k [(L' . e) e + (L . e) e'] ,   u_i = v + w x rho_i ,
    u_i' = v' + w' x rho_i + w x rho_i' ,

    sphere   rho = a e - z ,
    edge     rho = (a + h) e - b n - q z ,   n = (z - e_z e)/s ,

the edge being a circle of radius b about axis 3 at the height h above O, rounded by a ball of radius q. A contact that
slips pushes with N (z - k(u) u), one that sticks with any F: as many unknowns as there are conditions u_z' = 0 or
u' = 0. Two contacts that stick leave the friction along the line between them open: the least will do.

Impact. Friction is in proportion to N, so while N is as good as infinite for an instant, the same law with
the normal impulse P in place of time says what happens (Routh; Keller, J. Appl. Mech. 53, 1, 1986):

    d(impulse)/dP = z - k(u) u   until u_z = 0 (plastic) ,

and Coulomb's friction may stop u_h on the way, if mu_s lets it.

Painleve's limit. N must make u_z' rise: alone, and where two contacts press, both (all principal minors of u_z' by the
N are positive). Where friction is too strong for that no N balances it, or several do, and what comes then is not in
these equations. Where nothing presses (without forces u_z' > 0) the contact parts instead.

Flight. L stays, e turns round it at |L|/I1, and G falls along a parabola.
"""

from collections.abc import Callable, Iterable, Sequence
from itertools import product
from math import sqrt
from typing import TypeAlias

import numpy as np
from scipy.integrate import LSODA, solve_ivp
from scipy.optimize import brentq

from ..errors import TopError
from ..paper.top import Top
from ..types import Array, Number, Rim, Vector
from .friction import Coulomb, Friction, holding
from .standing import FLAT, STANDS, crossed, energy_above_rest, leaned, leaning, lies, tipping_energy
from .trajectory import Trajectory

# SLOW: see sliding.py. REST ((gR)^1/2): slip below which Coulomb's friction may hold.
# SLACK (Mg), TOUCH (R): less than that is nothing. LEAST: what is left of u_z' by N, of 1 without friction.
SLOW, REST, SLACK, TOUCH, LEAST = 0.01, 1e-11, 1e-10, 1e-11, 1e-6
HOP = np.append(0.0, np.geomspace(1e-6, 0.99, 48))  # where in a step of the flight it may be above the table
SINKS = 1e-6  # (g): a contact that is let go and sinks faster would have to carry
STEADY = 10.0  # ((g/R)^1/2): rate at which what rounding and tolerance do to closed contacts is undone
UP = np.array([0.0, 0.0, 1.0])
SPHERE, EDGE = 0, 1
SUPPORTS: dict[tuple[int, ...], str]
SUPPORTS = {(): "none", (SPHERE,): "ball", (EDGE,): "stem", (SPHERE, EDGE): "both"}
ENDS = {"stands": "stands upright", "balances": "Painleve's limit", "turns": "too many turns"}
Modes: TypeAlias = dict[int, str]  # see Body
Event: TypeAlias = tuple[str, int | None]  # what happens, at which contact
Force: TypeAlias = tuple[list[float], Vector, Vector]  # F, rho, u
Progress: TypeAlias = Callable[[float], bool]  # called with the time reached; True where that was too often
Dense: TypeAlias = Number  # scipy's dense output


# ---- y = (p_x, p_y, p_z, p_w, chi, L_x, L_y, L_z, v_x, v_y, x, y, t, heat[, v_z, z]), see sliding.py ----


def turning(top: Top, y: Sequence[Number] | Array) -> tuple[Vector, Vector, Number, tuple[Number, Number]]:
    """e, w, L . e and the horizontal part of w x r for the sphere's r = z - a e, of floats or arrays."""
    px, py, pz, pw, _, Lx, Ly, Lz = y[:8]
    a, I1 = top.a, top.I1
    ex, ey, ez = 2 * (px * pz + pw * py), 2 * (py * pz - pw * px), 1 - 2 * (px * px + py * py)
    L3 = Lx * ex + Ly * ey + Lz * ez
    along = (1 / top.I3 - 1 / I1) * L3
    wx, wy, wz = Lx / I1 + along * ex, Ly / I1 + along * ey, Lz / I1 + along * ez
    rz = 1 - a * ez
    return (ex, ey, ez), (wx, wy, wz), L3, (wy * rz + a * wz * ey, -wx * rz - a * wz * ex)


def pose(top: Top, y: Array, path: Array) -> tuple[Array, Array, Array, Array]:
    """theta, phi, psi (n,) and omega (3, n) about 1', 2', 3 at y (14 or 16, n).

    path: y, or what has the same rows but for the velocity, at all steps of the integration, to follow the angles.
    """
    # p_w + i p_z = cos(theta/2) exp i(phi + psi - chi)/2,  p_x + i p_y = sin(theta/2) exp i(phi - psi + chi)/2
    together = np.concatenate([path, y], axis=1)
    order = np.argsort(together[12], kind="stable")
    angles = np.arctan2(together[[2, 1]], together[[3, 0]])
    angles[:, order] = np.unwrap(angles[:, order])
    plus, minus = angles[:, path.shape[1] :]
    phi, psi = plus + minus, plus - minus + y[4]
    theta = 2 * np.arctan2(np.hypot(y[0], y[1]), np.hypot(y[2], y[3]))
    _, w, _, _ = turning(top, y)
    c, s, across = np.cos(theta), np.sin(theta), (w[0] + 1j * w[1]) * np.exp(-1j * phi)
    return theta, phi, psi, np.array([across.real, c * across.imag + s * w[2], c * w[2] - s * across.imag])


def record(
    top: Top, y: Array, path: Array, u: Sequence[Array] | Array, F: Sequence[Array] | Array, **more: Number
) -> Trajectory:
    """The Trajectory at y (14 or 16, n), for the horizontal slip u and the force F in space, (2, n) and (3, n)."""
    theta, phi, psi, omega = pose(top, y, path)
    F = np.where((F[2] < 0) & (F[2] > -2 * SLACK), 0.0, F)
    e, turn = turning(top, y)[0], np.exp(-1j * phi)
    u_h, F_h = (u[0] + 1j * u[1]) * turn, (F[0] + 1j * F[1]) * turn
    p, half = y[:4] / np.sqrt((y[:4] ** 2).sum(axis=0)), np.exp(0.5j * y[4])  # q = p Rz(chi)
    xy, zw = (p[0] + 1j * p[1]) * half.conj(), (p[3] + 1j * p[2]) * half
    parts: dict[str, Number] = {
        "contact": np.stack([y[10] + top.a * e[0], y[11] + top.a * e[1]], axis=1),
        "com": np.stack([y[10], y[11], 1 - top.a * np.cos(theta)], axis=1),
        "regime": np.full(len(theta), "slip")}  # fmt: skip
    if len(y) > 14:
        v = (y[8] + 1j * y[9]) * turn
        parts["com"], parts["velocity"] = y[[10, 11, 15]].T.copy(), np.stack([v.real, v.imag, y[14]], axis=1)
    return Trajectory(
        top=top, t=y[12], theta=theta, phi=phi, psi=psi,
        quaternion=np.stack([xy.real, xy.imag, zw.imag, zw.real], axis=1), omega=omega.T,
        slip=np.stack([u_h.real, u_h.imag], axis=1), force=np.stack([F_h.real, F_h.imag, F[2]], axis=1),
        heat=y[13], **parts | more)  # fmt: skip


def gap(edge: Rim, c: Number, s: Number) -> Number:
    """Height of the edge's lowest point above the table while the sphere stands on it."""
    b, h, q = edge
    return 1 + h * c - b * s - q


class Body:
    """The top with its two possible contacts. Its states are y of 16.

    Its modes are a dict {SPHERE or EDGE: "slip" or "stick"} of the contacts that carry, {} in the air.
    """

    def __init__(self, top: Top, friction: Friction, tolerance: float, edge: Rim | None, progress: Progress) -> None:
        self.top, self.friction, self.tolerance, self.progress = top, friction, tolerance, progress
        self.edge: Rim = edge or (0.0, 0.0, 0.0)  # of a whole sphere none, and no contact asks for it
        # touching more softly than this, both contacts stay closed, for else ever smaller bounces would follow without
        # end, down to heights below the tolerance; the energy is its square
        self.gentle = 10 * tolerance**0.5
        self.sticks, self.mu_s = isinstance(friction, Coulomb), holding(friction)
        self.contacts = (SPHERE,) if edge is None else (SPHERE, EDGE)
        self.tips = tipping_energy(top, edge) if edge else 0.0

    def on_sphere(self, y: Array) -> Array:
        """y of 16 from that of 14, on the sphere."""
        (ex, ey, ez), (wx, wy, _), _, _ = turning(self.top, y)
        return np.append(y, [-self.top.a * (wx * ey - wy * ex), 1 - self.top.a * ez])

    def on_edge(self, y: Array) -> Array:
        """y of 16 from that of 14, on the edge."""
        y = np.append(y, [0.0, 0.0])
        if self.edge[0]:
            y = leaned(y, *turning(self.top, y)[:2])
        _, _, height, u = self._contact(y, EDGE)
        y[14:] = -u[2], -height
        return y

    # ---- contacts ----

    def _contact(
        self, y: Sequence[float] | Array, i: int, e: Vector | None = None, w: Vector | None = None
    ) -> tuple[Vector, Vector, float, Vector]:
        """rho, rho', its height above the table and u, of contact i."""
        if e is None or w is None:
            e, w, _, _ = turning(self.top, y)
        (ex, ey, ez), (ex_, ey_, ez_) = e, _cross(w, e)  # e, e'
        if i == SPHERE:
            along, turns, down = self.top.a, 0.0, self.top.a * ez - 1.0
        else:
            b, h, q = self.edge
            along, turns = self.top.a + h, 0.0
            down = along * ez - q
            if b:  # rho = (a + h + b e_z/s) e - (b/s + q) z
                s = sqrt(ex * ex + ey * ey)
                along, turns, down = along + b * ez / s, b * ez_ / (s * s * s), down - b * s
        rho = along * ex, along * ey, down
        rho_dot = along * ex_ + turns * ex, along * ey_ + turns * ey, along * ez_
        return rho, rho_dot, y[15] + rho[2], _sum((y[8], y[9], y[14]), _cross(w, rho))

    def heights(self, y: Sequence[Number] | Array) -> Array:
        """Of the sphere's and the edge's lowest points above the table (k, n), at y (16, n)."""
        px, py, pz, pw = y[:4]
        s, c = 2 * np.sqrt((px * px + py * py) * (pz * pz + pw * pw)), 1 - 2 * (px * px + py * py)
        rise = y[15] + self.top.a * c - 1
        return np.array([rise, rise + gap(self.edge, c, s)] if EDGE in self.contacts else [rise])

    def floor(self, y: Array) -> Array:
        """Heights that count as 0 from y on: what the tolerance took from those of contacts that just parted."""
        return np.minimum(self.heights(y), 0.0)

    def _response(self, e: Vector, F: Sequence[Number], at: Vector, rho: Vector) -> Vector:
        """v' + w' x rho for the force F at `at`; u' for an impulse."""
        top, torque = self.top, _cross(at, F)
        along = (1 / top.I3 - 1 / top.I1) * (torque[0] * e[0] + torque[1] * e[1] + torque[2] * e[2])
        w_dot = [x / top.I1 + along * axis for x, axis in zip(torque, e, strict=True)]
        return _sum(F, _cross(w_dot, rho))

    def forces(
        self, y: Sequence[float] | Array, modes: Modes, beside: bool = True
    ) -> tuple[dict[int, Force], dict[int, float], float]:
        """{i: (F, rho, u)} for the contacts of modes; {i: float}, what the others' u_z' is, if asked; and the least
        principal minor of u_z' by the N, not above 0 beyond Painleve's limit."""
        top = self.top
        e, w, L3, _ = turning(top, y)
        free = [(1 / top.I3 - 1 / top.I1) * L3 * x for x in _cross(w, e)]  # w' but for the forces
        at, away, unknowns, rows = {}, {}, [], []
        for i in self.contacts if beside else sorted(modes):
            rho, rho_dot, height, u = at[i] = self._contact(y, i, e, w)
            x, yy, z = away[i] = _sum(_cross(w, rho_dot), _cross(free, rho), (0.0, 0.0, -1.0))
            mode = modes.get(i)
            if mode:
                rows.append((i, 2, -z - 2 * STEADY * u[2] - STEADY * STEADY * height))
            if mode == "stick":
                rows += (i, 0, -x - 2 * STEADY * u[0]), (i, 1, -yy - 2 * STEADY * u[1])
                unknowns += [(i, axis) for axis in ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))]
            elif mode == "slip":
                k = self.friction.k(u[0] * u[0] + u[1] * u[1])
                unknowns.append((i, (-k * u[0], -k * u[1], 1.0)))
        moved = [{i: self._response(e, d, at[j][0], at[i][0]) for i in at} for j, d in unknowns]
        minor = min((column[j][2] for (j, _), column in zip(unknowns, moved, strict=True) if modes[j] == "slip"),
                    default=1.0)  # fmt: skip
        if len(rows) == 1:
            i, part, needed = rows[0]
            sizes = [needed / moved[0][i][part]]
        elif rows:
            matrix = np.array([[column[i][part] for column in moved] for i, part, _ in rows])
            right = np.array([needed for _, _, needed in rows])
            singular = len(right) == 6
            if len(modes) == 2 and not singular:
                minor = min(minor, np.linalg.det(matrix))
            sizes = np.linalg.lstsq(matrix, right, rcond=1e-9)[0] if singular else np.linalg.solve(matrix, right)
        found = {i: [0.0, 0.0, 0.0] for i in modes}
        others = {i: away[i][2] for i in at if i not in modes}
        for (j, d), size, column in zip(unknowns, sizes if rows else (), moved, strict=True):
            for part in range(3):
                found[j][part] += size * d[part]
            for i in others:
                others[i] += size * column[i][2]
        return {i: (F, at[i][0], at[i][3]) for i, F in found.items()}, others, minor

    # ---- followed on one or two contacts ----

    def _clock(self, y: Sequence[float] | Array, modes: Modes, found: dict[int, Force] | None = None) -> float:
        """dt/dtau."""
        g = 1.0
        if self.sticks:
            for i, mode in modes.items():
                if mode == "slip":
                    u = found[i][2] if found else self._contact(y, i)[3]
                    speed = sqrt(u[0] * u[0] + u[1] * u[1])
                    g *= speed / (speed + SLOW)
        return g

    def _rates(self, y: Array, modes: Modes) -> Array:
        top = self.top
        y = y.tolist()
        found, _, _ = self.forces(y, modes, beside=False)
        (ex, ey, ez), (wx, wy, wz), L3, _ = turning(top, y)
        px, py, pz, pw = y[:4]
        w3 = L3 / top.I3
        ox, oy, oz = (wx - w3 * ex) / 2, (wy - w3 * ey) / 2, (wz - w3 * ez) / 2  # half the frame's angular velocity
        total, torque, heat = (0.0, 0.0, -1.0), (0.0, 0.0, 0.0), 0.0
        for F, rho, u in found.values():
            total, torque = _sum(total, F), _sum(torque, _cross(rho, F))
            heat -= F[0] * u[0] + F[1] * u[1] + F[2] * u[2]
        rates = np.array([
            ox * pw + oy * pz - oz * py, oy * pw + oz * px - ox * pz,
            oz * pw + ox * py - oy * px, -ox * px - oy * py - oz * pz, w3,
            *torque, total[0], total[1], y[8], y[9], 1.0, heat, total[2], y[14]])  # fmt: skip
        return rates * self._clock(y, modes, found)

    def _guards(self, y: Array, modes: Modes, floor: Array) -> dict[Event, float]:
        """What must not be negative: {(kind, contact): float}. floor: heights that count as the table's."""
        y = y.tolist()
        found, _, minor = self.forces(y, modes)
        guards: dict[Event, float] = {("balances", None): minor - LEAST}
        for i, (F, _, _) in found.items():
            guards["leaves", i] = F[2] + SLACK
            if modes[i] == "stick":
                guards["slips", i] = self.mu_s * F[2] - sqrt(F[0] * F[0] + F[1] * F[1]) + SLACK
        heights = self.heights(y)
        guards |= {("touches", i): max(heights[i] - floor[i] + TOUCH, self._contact(y, i)[3][2] + SLACK)
                   for i in self.contacts if i not in modes}  # fmt: skip
        if EDGE in modes and self.edge[0]:
            e, w, L3, _ = turning(self.top, y)
            if e[2] < 0:
                s, rate = leaning(e, w)
                above = energy_above_rest(self.top, self.edge, y, L3)
                guards["stands", EDGE] = max(s / STANDS - 1, above - self.tips)
                guards["rocks", EDGE] = max(s / FLAT - 1, rate + SLACK)
        return guards

    def follow(self, y: Array, times: Array, modes: Modes) -> tuple[Trajectory, Array, Event | None]:
        """A Trajectory of the times before the next event, the state then, and (kind, contact) of it, or None."""
        end, begin = times[-1], float(y[12])
        atol = np.full(16, self.tolerance)
        atol[5:8] *= max(1.0, float(np.linalg.norm(y[5:8])))
        scaled = self.sticks and "slip" in modes.values()
        # in tau the last of a slip dies away like a motion coming to rest, which must not tempt to longer steps
        bound, longest = (np.inf, 0.05) if scaled else (end - begin, np.inf)
        solver = LSODA(lambda _, y: self._rates(y, modes), 0.0, y, bound, max_step=longest, rtol=1e-13, atol=atol)
        done, event, path = int(np.searchsorted(times, y[12], "right")), None, [y]
        rows, speeds = [np.tile(y, (done, 1))], self._speeds(y, modes)
        floor = self.floor(y)
        if (event := self._first(self._guards(y, modes, floor))) is not None:
            end, rows, done = begin, [np.zeros((0, 16))], 0
        while y[12] < end and event is None:
            last, before = y, speeds
            if solver.step() or not np.all(np.isfinite(solver.y)):
                raise TopError("friction", self.friction, "weaker friction for this top",
                               f"The equations could not be followed past t = {last[12]:.6g}.")  # fmt: skip
            y, dense = solver.y.copy(), solver.dense_output()
            if not scaled:  # without the rounding of its integration
                y[12] = end if solver.status == "finished" else begin + solver.t
            if min((guards := self._guards(y, modes, floor)).values()) < 0.05:
                third = (solver.t - solver.t_old) / 3
                for tau in (solver.t_old + third, solver.t - third, solver.t):
                    if event := self._first(guards if tau == solver.t else self._guards(dense(tau), modes, floor)):
                        y = dense(self._crossing(dense, modes, floor, event, tau, tau - third))
                        break
            speeds = self._speeds(y, modes)
            for i, speed in speeds.items():
                if event is None and speed < min(before[i], 1e5 * self.tolerance):
                    if self._may_stick(y, modes, i):
                        y, event = self._halted(y, modes, i), ("sticks", i)
                    elif speed < 10 * self.tolerance:  # through 0 without a halt
                        y, event = self._halted(y, modes, i), ("slips", i)
            count = int(np.searchsorted(times, min(y[12], end), "right"))
            if count > done:
                rows.append(self._at(times[done:count], dense, modes) if scaled else dense(times[done:count] - begin).T)
                done = count
            path.append(y)
            # as long as 64 steps on the sphere alone
            if len(path) % 8 == 0 and self.progress(float(y[12])) and event is None:
                event = "turns", None
        samples = np.concatenate(rows)
        samples[:, 12] = times[:done]
        return self._record(samples, np.array(path), modes), y, event

    def _speeds(self, y: Array, modes: Modes) -> dict[int, float]:
        if not self.sticks:
            return {}
        return {i: float(np.hypot(*self._slip(y, i))) for i, mode in modes.items() if mode == "slip"}

    def _slip(self, y: Array, i: int) -> Array:
        return np.array(self._contact(y, i)[3][:2])

    def _halted(self, y: Array, modes: Modes, i: int) -> Array:
        """y where the last of the slip at contact i is gone: by the midpoint rule."""
        middle, u = y, self._slip(y, i)
        for _ in range(3):
            rates = self._rates(middle, modes) / self._clock(middle, modes)
            left = 1e-6 * (u @ u) / (u @ (u - self._slip(y + 1e-6 * rates, i)))
            middle = y + left / 2 * rates
        return y + left * rates

    def _may_stick(self, y: Array, modes: Modes, i: int) -> bool:
        """Whether contact i could stick here."""
        F = self.forces(y, modes | {i: "stick"})[0][i][0]
        return bool(np.hypot(F[0], F[1]) <= self.mu_s * F[2])

    @staticmethod
    def _first(guards: dict[Event, float]) -> Event | None:
        return next((key for key, value in guards.items() if not value >= 0), None)

    def _crossing(self, dense: Dense, modes: Modes, floor: Array, event: Event, after: float, before: float) -> float:
        """tau at which the guard of the event falls below 0."""

        def guard(tau: float) -> float:
            return self._guards(dense(tau), modes, floor)[event]

        kind, i = event
        if kind == "touches" and self.heights(dense(before))[i] > 0:
            return brentq(lambda tau: self.heights(dense(tau))[i], before, after, xtol=1e-15)

        return brentq(guard, before, after, xtol=1e-15) if guard(before) > 0 else before

    def _at(self, times: Array, dense: Dense, modes: Modes) -> Array:
        """y (n, 16) at times within the last step."""
        limits = min(dense.t_old, dense.t), max(dense.t_old, dense.t)
        tau = np.full(len(times), limits[1])
        for i, t in enumerate(times):
            for _ in range(30):  # Newton's steps
                y = dense(tau[i])
                if abs(t - y[12]) < 1e-13 * (1 + abs(t)):
                    break
                tau[i] = np.clip(tau[i] + (t - y[12]) / self._clock(y, modes), *limits)
        return dense(tau).T.reshape(len(times), 16)

    def _record(self, samples: Array, path: Array, modes: Modes) -> Trajectory:
        n = len(samples)
        u, F, contact = np.zeros((2, n)), np.zeros((3, n)), np.empty((n, 2))
        for k, y in enumerate(samples):
            found = self.forces(y, modes)[0].values()
            F[:, k] = np.sum([push for push, _, _ in found], axis=0)
            share = [push[2] / F[2, k] for push, _, _ in found]
            u[:, k] = share @ np.array([slip[:2] for _, _, slip in found])
            contact[k] = y[10:12] + share @ np.array([rho[:2] for _, rho, _ in found])
        rolls = set(modes.values()) == {"stick"}
        if rolls:
            u[:] = 0
        regime = np.full(n, "roll" if rolls else "slip")
        return record(self.top, samples.T, path.T, u, F, contact=contact, regime=regime)

    # ---- in the air ----

    def _flown(self, y: Array, t: Array) -> Array:
        """y (16, n) a time t (n,) later, in the air."""
        L, I1 = y[5:8], self.top.I1
        size = np.linalg.norm(L)
        L3 = turning(self.top, y)[2]
        half = size * t / (2 * I1)
        x, yy, z = (L / size)[:, None] * np.sin(half) if size else np.zeros((3, len(t)))
        w, turn = np.cos(half), -L3 * t / (2 * I1)
        px, py, pz, pw = y[:4]
        # p(t) = (turn about L) p (turn about e, backwards)
        qx, qy = w * px + x * pw + yy * pz - z * py, w * py + yy * pw + z * px - x * pz
        qz, qw = w * pz + z * pw + x * py - yy * px, w * pw - x * px - yy * py - z * pz
        C, S = np.cos(turn), np.sin(turn)
        out = np.repeat(y[:, None], len(t), axis=1)
        out[:4] = qx * C + qy * S, qy * C - qx * S, qz * C + qw * S, qw * C - qz * S
        out[4] += L3 / self.top.I3 * t
        out[10], out[11], out[12] = y[10] + y[8] * t, y[11] + y[9] * t, y[12] + t
        out[14], out[15] = y[14] - t, y[15] + y[14] * t - t * t / 2
        return out

    def fly(self, y: Array, times: Array) -> tuple[Trajectory, Array, Event | None]:
        """As follow(), in the air."""
        rate, begin, left = np.linalg.norm(y[5:8]) / self.top.I1, y[12], times[-1] - y[12]
        floor = self.floor(y)[:, None]
        step, at, event, ends = 0.02 / (1 + rate / 10), 0.0, None, left
        path = [y]
        while at < left and event is None:
            t = np.minimum(at + step * np.arange(257), left)
            flown = self._flown(y, t)
            heights = self.heights(flown)
            low = (heights < floor - TOUCH) & (np.diff(heights, axis=1, prepend=np.inf) < 0)
            for i in np.flatnonzero(low.any(axis=1)):
                k = int(np.argmax(low[i]))

                def height(x: float, i: np.intp = i) -> float:
                    return self.heights(self._flown(y, np.array([x])))[i, 0]

                # after the short hop of a start it may have risen and come down within the first step
                after = t[k - 1] + (t[k] - t[k - 1]) * HOP if k else t[:1]
                risen = np.flatnonzero(self.heights(self._flown(y, after))[i] > 0)
                lands = brentq(height, after[risen[-1]], t[k], xtol=1e-15) if risen.size else float(after[0])
                if lands <= ends:
                    ends, event = lands, ("lands", int(i))
            path.extend(flown[:, t <= ends].T)
            at = float(t[-1])
            if self.progress(float(begin + min(at, ends))) and event is None:
                ends, event = at, ("turns", None)
        count = int(np.searchsorted(times, begin + ends, "right" if event is None else "left"))
        samples = self._flown(y, times[:count] - begin)
        samples[12] = times[:count]
        none = np.zeros((3, count))
        trajectory = record(self.top, samples, np.array(path).T, none[:2], none, regime=np.full(count, "air"))
        return trajectory, self._flown(y, np.array([ends]))[:, 0], event

    # ---- touching, leaving ----

    def settle(self, y: Array, event: Event) -> tuple[Array, Modes | None]:
        """The state after the event (kind, contact) at y, with any impact, and the modes in which it goes on, or None
        beyond Painleve's limit."""
        if event[0] == "rocks":
            y = self._rocked(y)
        heights, (kind, touched) = self.heights(y), event
        closed = [i for i in self.contacts if heights[i] < 1e-9 or (i, kind) == (EDGE, "rocks")]
        if kind in ("touches", "lands", "rocks"):
            y = self._soft(y, closed)
            for _ in range(1000):
                falls = {i: self._contact(y, i)[3][2] for i in closed}
                i = min(falls, key=falls.__getitem__)
                if falls[i] >= -1e-12:
                    break
                y = self._impact(y, i)
        options: dict[int, list[str | None]]
        options = {i: [None, "slip"] for i in closed if self._contact(y, i)[3][2] < 1e-9}
        for i in options:
            if self._rests(y, i):
                options[i] = [None, "stick", "slip"]
        if touched in options and kind in ("leaves", "sticks", "slips"):  # it is settled; elsewhere rounding may decide
            options[touched] = [{"leaves": None, "sticks": "stick", "slips": "slip"}[kind]]
        return self._modes(y, options)

    def _soft(self, y: Array, closed: list[int]) -> Array:
        """y with both contacts closed for good, where they touch too softly to tell and both would carry."""
        speeds = np.array([self._contact(y, i)[3][2] for i in closed])
        if len(closed) < 2 or np.abs(speeds).max() > self.gentle:
            return y
        found, _, _ = self.forces(y, {i: "stick" if self._rests(y, i) else "slip" for i in closed})
        if min(F[2] for F, _, _ in found.values()) <= 0:
            return y
        W = [[self._mobility(y, i, j)[2, 2] for j in closed] for i in closed]
        for i, P in zip(closed, np.linalg.solve(W, -speeds), strict=True):
            y = self._pushed(y, i, P * UP)
        return y

    def _modes(self, y: Array, options: dict[int, list[str | None]]) -> tuple[Array, Modes | None]:
        """The contacts that carry from here on: none pulls, none sinks in, none holds more than it can; or None."""
        best, unbalanced = (np.inf, y, None), False
        for chosen in sorted(product(*options.values()), key=lambda c: (c.count(None), -c.count("stick"))):
            modes = {i: mode for i, mode in zip(options, chosen, strict=True) if mode}
            y_now = self._let_go(y, modes)
            found, others, minor = self.forces(y_now, modes)
            if minor < LEAST:
                unbalanced = True
                continue
            lacking = [-F[2] for F, _, _ in found.values()]
            lacking += [-others[i] for i in options if i not in modes and len(options[i]) > 1]
            lacking += [np.hypot(F[0], F[1]) - self.mu_s * F[2]
                        for i, (F, _, _) in found.items() if modes[i] == "stick" and len(options[i]) > 1]  # fmt: skip
            worst = max(lacking, default=0.0)
            if worst <= SLACK / 2:
                return y_now, modes
            if worst < best[0]:
                best = worst, y_now, modes
        return (y, None) if unbalanced and best[0] > SINKS else best[1:]

    def stays_flat(self, y: Array, modes: Modes) -> bool:
        """Whether the impact that brought its flat end down left it no way to lean further."""
        e, w, _, _ = turning(self.top, y)
        return EDGE in modes and (leaning(e, w)[1] <= 0 or lies(self.top, self.edge, e, w))

    def start_alone(self, y: Array, time: Array, event: str, i: int) -> Trajectory:
        """The Trajectory of one instant on contact i, where the event ends it at once."""
        if event == "lifts off":
            return self.fly(y, time)[0]
        stands, y = event == ENDS["stands"], y if len(y) == 16 else self.on_sphere(y)
        rho = self._contact(y, i)[0]
        none, weight = np.zeros((2, 1)), np.array([[0.0], [0.0], [float(stands)]])
        return record(self.top, y[:, None], y[:, None], none, weight, contact=(y[10:12] + rho[:2])[None])

    def _rocked(self, y: Array) -> Array:
        """y leaning on the opposite point of the rim; what energy the small turn takes is heat."""
        before, y = self._kinetic(y) + y[15], crossed(y, turning(self.top, y)[0])
        y[15] -= self._contact(y, EDGE)[2]
        y[13] += before - self._kinetic(y) - y[15]
        return y

    def _let_go(self, y: Array, modes: Modes) -> Array:
        """y with the least slip where a contact at rest starts to slip: against the force that would have held it."""
        for i, mode in modes.items():
            if mode == "slip" and self._rests(y, i):
                F = self.forces(y, modes | {i: "stick"})[0][i][0]
                y = y.copy()
                y[8:10] -= 1e-9 * np.array(F[:2]) / (np.hypot(F[0], F[1]) or 1.0) + self._slip(y, i)
        return y

    def _rests(self, y: Array, i: int) -> bool:
        return self.sticks and np.hypot(*self._slip(y, i)) < REST

    def _mobility(self, y: Array, i: int, j: int) -> Array:
        """(3, 3): u_i for an impulse at contact j."""
        e, at, rho = turning(self.top, y)[0], self._contact(y, j)[0], self._contact(y, i)[0]
        return np.array([self._response(e, axis, at, rho) for axis in np.eye(3).tolist()]).T

    def _pushed(self, y: Array, i: int, impulse: Array) -> Array:
        before, y = self._kinetic(y), y.copy()
        y[5:8] += _cross(self._contact(y, i)[0], impulse)
        y[[8, 9, 14]] += impulse
        y[13] += before - self._kinetic(y)
        return y

    def _kinetic(self, y: Array) -> float:
        L3 = turning(self.top, y)[2]
        L, v = y[5:8], y[[8, 9, 14]]
        return (L @ L / self.top.I1 + (1 / self.top.I3 - 1 / self.top.I1) * L3 * L3 + v @ v) / 2

    def _impact(self, y: Array, i: int) -> Array:
        """y after the plastic impact at contact i."""
        W, u0 = self._mobility(y, i, i), np.array(self._contact(y, i)[3])
        impulse = impact(W, u0, self.friction)
        return self._pushed(y, i, impulse)


def impact(W: Array, u0: Array, friction: Friction) -> Array:
    """The impulse (3,) of a plastic impact: u = u0 + W impulse, d(impulse)/dP = z - k(u) u until u_z = 0."""
    sticks, mu_s = isinstance(friction, Coulomb), holding(friction)
    scale = float(np.linalg.norm(u0))

    def rates(_: float, impulse: Array) -> Array:
        u = u0 + W @ impulse
        square = u[0] * u[0] + u[1] * u[1]
        k = friction.k(square)
        g = sqrt(square) / (sqrt(square) + SLOW * scale) if sticks else 1.0
        return np.array([-k * u[0] * g, -k * u[1] * g, g])

    def closes(_: float, impulse: Array) -> float:
        return (u0 + W @ impulse)[2]

    def halts(_: float, impulse: Array) -> float:
        u = u0 + W @ impulse
        return np.hypot(u[0], u[1]) - 1e-9 * scale

    closes.terminal, closes.direction = True, 1.0  # type: ignore[attr-defined]  # what solve_ivp reads
    halts.terminal, halts.direction = True, -1.0  # type: ignore[attr-defined]
    impulse, slipped = np.zeros(3), False
    for _ in range(3):
        u = u0 + W @ impulse
        if sticks and np.hypot(u[0], u[1]) <= 1.001e-9 * scale and not slipped:
            rest = np.linalg.solve(W, -u)
            if np.hypot(rest[0], rest[1]) <= mu_s * rest[2]:
                return impulse + rest
            away = -rest[:2] / np.hypot(rest[0], rest[1])  # slips on, against the impulse that would have held it
            impulse, slipped = impulse + np.linalg.solve(W, np.append(2e-9 * scale * away - u[:2], 0.0)), True
        solved = solve_ivp(rates, (0, 1e6 * scale), impulse, "DOP853", rtol=1e-12, atol=1e-14 * scale,
                           events=[closes, halts] if sticks and not slipped else [closes])  # fmt: skip
        impulse = solved.y[:, -1]
        if solved.t_events[0].size:
            return impulse
    return impulse


def change(before: Iterable[int], after: Iterable[int], event: Event) -> str:
    """What to call the change of modes after an event (kind, contact)."""
    carried, carries = tuple(sorted(before)), tuple(sorted(after))
    if not carried:
        return "lands on its stem" if EDGE in carries or (not carries and event[1] == EDGE) else "lands"
    if carried == carries or carries == (SPHERE, EDGE):
        if event[0] == "rocks":
            return "rocks over"
        touches: dict[int | None, str] = {SPHERE: "ball touches", EDGE: "stem touches"}
        return event[0] if event[0] in ("sticks", "slips") else touches[event[1]]
    if carried == (SPHERE, EDGE) and carries == (SPHERE,):
        return "stem leaves"
    return {(): "lifts off", (SPHERE,): "falls back on its ball", (EDGE,): "stands on its stem"}[carries]


def _cross(x: Number, y: Number) -> Vector:
    (x0, x1, x2), (y0, y1, y2) = x, y
    return x1 * y2 - x2 * y1, x2 * y0 - x0 * y2, x0 * y1 - x1 * y0


def _sum(*vectors: Sequence[Number]) -> Vector:
    x, y, z = map(sum, zip(*vectors, strict=True))
    return x, y, z
