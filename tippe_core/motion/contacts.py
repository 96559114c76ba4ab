"""Which contacts carry the top, and what changes that: guards that must not fall below 0, and what follows when one
does.

Painleve's limit: a normal force N must increase u_z'. For two loaded contacts all principal minors of the matrix of
du_z'/dN must be positive. If friction is too strong for that, no N balances it, or several do, and these equations do
not say what follows. If nothing presses the contact down (u_z' > 0 without contact forces), it opens instead.
"""

import numpy as np

from ..paper.constants import CLOSED
from ..paper.search import zero
from ..types import Array, Bools, Indices, Number
from . import at
from .dynamics import arrange, carried, forces, kinetic, rates, slip_rate, turning
from .friction import bounds
from .impact import give_impulse, held, impact, mobility, moving, rests
from .kinds import BALANCES, HALTS, LEAVES, NONE, RIM, ROCKS, SLIPS, STANDS_UP, STARTS, TOUCHES, Event, Modes
from .records import BALL, NO_ONE, OPEN, SLIP, STEM, STICK, Record
from .standing import FLAT, STANDS, crossed, energy_above_rest, leaning, tipping_energy

# STILL: slip below which the rest of the motion to a halt takes far less time than 1e-9, to which events are located.
# SLACK (Mg), TOUCH (R): smaller values count as 0. LEAST_MINOR: the smallest du_z'/dN allowed, relative to that
# without friction.
STILL, SLACK, TOUCH, LEAST_MINOR = 1e-13, 1e-10, 1e-11, 1e-6
FALLS = 1e-12  # ((gR)^1/2): a closed contact that moves down more slowly is at rest
NUDGE = 1e-8  # ((gR)^1/2): the slip with which a patch starts to slide; far above the errors of steps
SINKS = 1e-6  # (g): an open contact that accelerates downwards faster than this would have to carry
LOG_STILL = float(np.log(STILL))
DIRECTIONS = 64
# modes of ball and stem, in the order in which they are tried: loaded and sticking ones first
MODES_IN_ORDER = np.array([[2, 2], [2, 1], [1, 2], [1, 1], [0, 2], [2, 0], [0, 1], [1, 0], [0, 0]])


def spare(i: int, modes: Modes, P: Record, C: Record) -> float:
    """How far static friction at contact i is below its limit: mu_s N - F_h, and the same for its torque."""
    most, twists = bounds(P.law)
    holds = most * C.F[i, 2] - np.sqrt(C.F[i, 0] ** 2 + C.F[i, 1] ** 2)
    if P.law.pivots and carried(modes) < 3:
        holds = min(holds, twists * C.F[i, 2] - abs(C.M[i, 2]))
    return holds


def margin(y: Array, minor: float, modes: Modes, P: Record, C: Record) -> float:
    """A cheap estimate of how close the guards are to 0, after rates()."""
    least = minor
    for i in range(1 + P.stem):
        if modes[i] == OPEN:
            least = min(least, C.height[i])
        else:
            least = min(least, C.F[i, 2])
            if modes[i] == STICK:
                least = min(least, spare(i, modes, P, C))
    down = y[at.PX] * y[at.PX] + y[at.PY] * y[at.PY]
    up = 1 - 2 * down
    if modes[STEM] != OPEN and P.b > 0.0 and up < 0:
        least = min(least, 2 * np.sqrt(down * (y[at.PZ] * y[at.PZ] + y[at.PW] * y[at.PW])))
    for value in tilt_guards(up, P):
        least = min(least, value)
    return least


def tilt_guards(up: Number, P: Record) -> tuple[Number, ...]:
    """The guards that follow from e_z alone, of the kinds from RIM on; also of arrays."""
    return (up - P.rim,)


def guards(y: Array, slowest: int, modes: Modes, floor: Array, P: Record, S: Record, C: Record, out: Array) -> None:
    """Writes the guards, which must not become negative, into out[kind, contact]; what is of the whole top, into that
    of the ball. floor: heights that count as the table's."""
    e, w, L3 = turn = arrange(y, slowest, modes, P, C)
    out[:] = 1.0
    out[BALANCES, BALL] = forces(turn, modes, P, C) - LEAST_MINOR
    for i in range(1 + P.stem):
        if modes[i] == OPEN:
            out[TOUCHES, i] = max(C.height[i] - floor[i] + TOUCH, C.u[i, 2] + SLACK)
        else:
            out[LEAVES, i] = C.F[i, 2] + SLACK
        if modes[i] == STICK:
            out[SLIPS, i] = spare(i, modes, P, C) + SLACK
    values = tilt_guards(e[2], P)
    for n in range(len(values)):
        out[RIM + n, BALL] = values[n]
    if modes[STEM] != OPEN and P.b > 0.0 and e[2] < 0.0:
        edge = P.b, P.h, P.q
        s, rate = leaning(e, w)
        S.at[:] = y
        known(S.at, C)
        out[STANDS_UP, BALL] = max(s / STANDS - 1, energy_above_rest(P, edge, S.at, L3) - tipping_energy(P, edge))
        out[ROCKS, BALL] = max(s / FLAT - 1, rate + SLACK)


def known(y: Array, C: Record) -> None:
    """Copies v and z into y, after arrange()."""
    y[at.VX], y[at.VY], y[at.VZ], y[at.Z] = C.G[0], C.G[1], C.G[2], C.G[3]


def first_negative(found: Array) -> Event:
    """The event of the first guard below 0 (or nan), or NONE."""
    for kind in range(len(found)):
        for i in range(2):
            if not found[kind, i] >= 0.0:
                return kind, i
    return NONE, BALL


# ---- slipping ----


def stuck(modes: Modes, i: int) -> Modes:
    """The modes if contact i sticks."""
    return (STICK, modes[STEM]) if i == BALL else (modes[BALL], STICK)


def may_stick(y: Array, modes: Modes, i: int, P: Record, C: Record) -> bool:
    """Whether contact i, which sticks in these modes, could do so in this state."""
    forces(arrange(y, NO_ONE, modes, P, C), modes, P, C)
    return spare(i, modes, P, C) >= 0.0


def may_both_stick(y: Array, P: Record, C: Record) -> bool:
    """Whether both contacts could stick in this state."""
    return may_stick(y, (STICK, STICK), BALL, P, C) and spare(STEM, (STICK, STICK), P, C) >= 0.0


def let_go(y: Array, modes: Modes, P: Record, S: Record, C: Record) -> None:
    """y with a minimal slip at a contact that starts to slip, in the direction in which the slip grows."""
    for i in range(1 + P.stem):
        if modes[i] == SLIP and rests(y, i, P, C):
            if P.law.radius > 0.0:
                let_patch_go(y, modes, i, P, C)
            else:
                beta, u = direction(y, modes, i, P, S, C), moving(y, i, P, C)
                y[at.VX] += STILL * np.cos(beta) - u[0]
                y[at.VY] += STILL * np.sin(beta) - u[1]


def direction(y: Array, modes: Modes, i: int, P: Record, S: Record, C: Record) -> float:
    """The direction beta of a slip that begins: u' is parallel to u; if there are several, the fastest-growing one."""
    best, found, last, given = -np.inf, 0.0, 0.0, (y, modes, i, P, S, C)
    for n in range(DIRECTIONS + 1):
        beta = 2 * np.pi * n / DIRECTIONS
        now = sideways_rate(beta, *given)
        if n > 0 and last * now <= 0.0:
            steady = zero(sideways_rate, beta - 2 * np.pi / DIRECTIONS, beta, given)
            sideways_rate(steady, *given)
            if S.K[0, at.LOG_U] > best:
                best, found = S.K[0, at.LOG_U], steady
        last = now
    return found


def sideways_rate(beta: float, y: Array, modes: Modes, i: int, P: Record, S: Record, C: Record) -> float:
    """The component of u' perpendicular to u for an almost vanishing u in the direction beta; S.K[0, LOG_U] is the
    parallel one."""
    S.at[:] = y
    S.at[at.LOG_U], S.at[at.BETA] = LOG_STILL, beta
    rates(S.at, i, modes, P, C, S.K[0])
    return S.K[0, at.BETA]


def let_patch_go(y: Array, modes: Modes, i: int, P: Record, C: Record) -> None:
    """y with a minimal slip and spin at a patch that starts to slide, opposite to the force and torque that held it."""
    modes = stuck(modes, i)
    forces(arrange(y, NO_ONE, modes, P, C), modes, P, C)
    most, twists = bounds(P.law)
    F, M, N = (C.F[i, 0], C.F[i, 1]), C.M[i, 2], abs(C.F[i, 2]) + SLACK
    q, pull, twist = moving(y, i, P, C), np.hypot(F[0], F[1]) / (most * N), 0.0
    if P.law.pivots:
        twist = M / (twists * N)
    size = NUDGE / max(pull, abs(twist), 1.0)  # far above the limits at times, as the torque of a small patch
    slip = size / (most * N)
    change = q[0] + slip * F[0], q[1] + slip * F[1], q[2], q[3] + size / P.law.radius * twist
    give_impulse(y, i, held(mobility(i, i, y, P, C), change, P.law), P, C)


# ---- touching, leaving ----


def settle(y: Array, event: Event, chosen: Indices, P: Record, S: Record, C: Record) -> bool:
    """y after the event, including any impact, and the modes in which the motion continues, into
    chosen; False beyond Painleve's limit."""
    kind, contact = event
    if kind == ROCKS:
        rocked(y, P, C)
    moving(y, BALL, P, C)
    closed = np.zeros(2, np.bool_)
    for i in range(1 + P.stem):
        closed[i] = C.height[i] < CLOSED or (i == STEM and kind == ROCKS)
        if kind == STARTS:
            closed[i] = i == contact or (closed[i] and abs(C.u[i, 2]) < CLOSED)
    if kind == ROCKS or kind == TOUCHES:
        soften(y, closed, P, C)
        for _ in range(1000):
            moving(y, BALL, P, C)
            i = STEM if closed[STEM] and (not closed[BALL] or C.u[STEM, 2] < C.u[BALL, 2]) else BALL
            if not closed[i] or C.u[i, 2] >= -FALLS:
                break
            q = moving(y, i, P, C)
            give_impulse(y, i, impact(mobility(i, i, y, P, C), q, P.law, C.impact), P, C)
    options = np.zeros((2, 3), np.bool_)  # for each contact: open, slip, stick
    moving(y, BALL, P, C)
    for i in range(2):
        options[i, OPEN] = True
        options[i, SLIP] = closed[i] and C.u[i, 2] < CLOSED
    for i in range(1 + P.stem):
        options[i, STICK] = options[i, SLIP] and rests(y, i, P, C)
        if options[i, SLIP] and i == contact:  # this is decided; otherwise rounding might decide
            for decides, mode in ((LEAVES, OPEN), (SLIPS, SLIP), (HALTS, STICK)):
                if kind == decides:
                    options[i, :] = False
                    options[i, mode] = True
    return choose(y, options, chosen, P, S, C)


def choose(y: Array, options: Bools, chosen: Indices, P: Record, S: Record, C: Record) -> bool:
    """Writes the modes from now on into chosen: none pulls, none penetrates, none exceeds its static friction.

    If no combination qualifies, the one with the least violation; False beyond Painleve's limit.
    """
    best, trial, kept, unbalanced = np.inf, S.z, S.new, False  # of the finished step, reused as working space
    chosen[:] = OPEN
    for n in range(len(MODES_IN_ORDER)):
        modes = MODES_IN_ORDER[n, BALL], MODES_IN_ORDER[n, STEM]
        if not (options[BALL, modes[BALL]] and options[STEM, modes[STEM]]):
            continue
        trial[:] = y
        let_go(trial, modes, P, S, C)
        _, w, _ = turn = arrange(trial, NO_ONE, modes, P, C)
        minor = forces(turn, modes, P, C)
        if minor < LEAST_MINOR:
            unbalanced = True
            continue
        worst = lacks(w, modes, options, P, C)
        if worst < best:
            best, chosen[BALL], chosen[STEM] = worst, modes[BALL], modes[STEM]
            kept[:] = trial
        if worst <= SLACK / 2:
            break
    if unbalanced and best > SINKS:
        return False
    if best < np.inf:
        y[:] = kept
    return True


def lacks(w: tuple[float, float, float], modes: Modes, options: Bools, P: Record, C: Record) -> float:
    """The largest violation at either contact: pulling, penetrating, or exceeding static friction."""
    worst = -np.inf
    for i in range(1 + P.stem):
        several = options[i, OPEN] + options[i, SLIP] + options[i, STICK] > 1
        if modes[i] != OPEN:
            worst = max(worst, -C.F[i, 2])
        elif several:
            worst = max(worst, -slip_rate(w, i, 2, C))
        if modes[i] == STICK and several:
            worst = max(worst, -spare(i, modes, P, C))
    return worst if worst > -np.inf else 0.0


def soften(y: Array, closed: Bools, P: Record, C: Record) -> None:
    """y with both contacts closed, if they meet so softly that it cannot be resolved and both would carry.

    Otherwise ever smaller bounces would follow without end, down to heights below the tolerance. The energy that this
    neglects is of the order of the tolerance squared.
    """
    moving(y, BALL, P, C)
    fast = max(abs(C.u[BALL, 2]), abs(C.u[STEM, 2]))
    if not (closed[BALL] and closed[STEM]) or fast > 10 * np.sqrt(P.tolerance):
        return
    modes = STICK if rests(y, BALL, P, C) else SLIP, STICK if rests(y, STEM, P, C) else SLIP
    forces(arrange(y, NO_ONE, modes, P, C), modes, P, C)
    if min(C.F[BALL, 2], C.F[STEM, 2]) <= 0.0:
        return
    moving(y, BALL, P, C)
    falls = C.u[BALL, 2], C.u[STEM, 2]
    W = [[mobility(i, j, y, P, C)[2, 2] for j in range(2)] for i in range(2)]
    determinant = W[0][0] * W[1][1] - W[0][1] * W[1][0]
    J = np.zeros(4)
    J[2] = (W[0][1] * falls[1] - W[1][1] * falls[0]) / determinant
    give_impulse(y, BALL, J, P, C)
    J[2] = (W[1][0] * falls[0] - W[0][0] * falls[1]) / determinant
    give_impulse(y, STEM, J, P, C)


def rocked(y: Array, P: Record, C: Record) -> None:
    """y leaning on the opposite point of the rim; the energy lost in this small rotation is counted as heat."""
    e, _, L3 = turning(y, P)
    before = kinetic(y, L3, P) + y[at.Z]
    y[:] = crossed(y, e)
    moving(y, STEM, P, C)
    y[at.Z] -= C.height[STEM]
    y[at.HEAT] += before - kinetic(y, turning(y, P)[2], P) - y[at.Z]
