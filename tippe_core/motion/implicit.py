"""One step of a linearly implicit method of order 5, for a patch that hardly slips and hardly spins.

Contensou's law is stiff there. Friction depends only on the direction n of s = (u_x, u_y, radius w_z), which relaxes at
a rate of about k N, which grows as 1/|s|, to the one in which friction balances the other forces. The steps of
stepper.py would shrink with |s|, while |s| itself changes slowly. So z has n and sigma = |s|/unit in place of v_x, v_y
and L_z, where the unit is |s| at the start of the step:

    sigma' = n . s'/unit ,   n' = [s' - (n . s') n]/(unit sigma) .

With v and L_z in their place |s| would be the small difference of large numbers, and a step that changes n by dn would
change it by dn^2. With f = dz/dt, J = df/dz,

    [1/(gamma h) - J] U_i = f(z + sum_j a_ij U_j) + sum_j c_ij U_j/h ,   i = 0 ... 7 ,
    new z = z + sum_j a_8j U_j ,   error: U_7 ,

and the polynomial through the step is z + x {new z - z + (1 - x) [V_0 + x V_1 + x^2 V_2]}, V_i = sum_j h_ij U_j.
Rodas5P of G. Steinebach, BIT Numer. Math. 63, 27 (2023), whose coefficients these are.
"""

import numpy as np

from ..types import Array
from . import at
from .contacts import margin
from .dynamics import arrange, from_direction, rates, slip_rate, time_scale, turning
from .elimination import decompose, substitute
from .friction import push
from .kinds import Modes
from .records import BALL, NO_ONE, SLIP, STICK, Record, modes_of
from .stepper import STAGES, stage

IMPLICIT_ORDER = 5
GAMMA = 0.21193756319429014
PARTS = 8
_END = (-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946)
A_IJ = np.array([
    [0.0] * 8,
    [3.0, *[0.0] * 7],
    [2.849394379747939, 0.45842242204463923, *[0.0] * 6],
    [-6.954028509809101, 2.489845061869568, -10.358996098473584, *[0.0] * 5],
    [2.8029986275628964, 0.5072464736228206, -0.3988312541770524, -0.04721187230404641, *[0.0] * 4],
    [*_END, 0.0, 0.0, 0.0],
    [*_END, 1.0, 0.0, 0.0],
    [*_END, 1.0, 1.0, 0.0],
    [*_END, 1.0, 1.0, 1.0],
])  # fmt: skip
C_IJ = np.array([
    [0.0] * 8,
    [-14.155112264123755, *[0.0] * 7],
    [-17.97296035885952, -2.859693295451294, *[0.0] * 6],
    [147.12150275711716, -1.41221402718213, 71.68940251302358, *[0.0] * 5],
    [165.43517024871676, -0.4592823456491126, 42.90938336958603, -5.961986721573306, *[0.0] * 4],
    [24.854864614690072, -3.0009227002832186, 47.4931110020768, 5.5814197821558125, -0.6610691825249471, 0.0, 0.0, 0.0],
    [30.91273214028599, -3.1208243349937974, 77.79954646070892, 34.28646028294783, -19.097331116725623,
     -28.087943162872662, 0.0, 0.0],
    [37.80277123390563, -3.2571969029072276, 112.26918849496327, 66.9347231244047, -40.06618937091002,
     -54.66780262877968, -9.48861652309627, 0.0],
])  # fmt: skip
H_IJ = np.array([
    [25.948786856663858, -2.5579724845846235, 10.433815404888879, -2.3679251022685204, 0.524948541321073,
     1.1241088310450404, 0.4272876194431874, -0.17202221070155493],
    [-9.91568850695171, -0.9689944594115154, 3.0438037242978453, -24.495224566215796, 20.176138334709044,
     15.98066361424651, -6.789040303419874, -6.710236069923372],
    [11.419903575922262, 2.8879645146136994, 72.92137995996029, 80.12511834622643, -52.072871366152654,
     -59.78993625266729, -0.15582684282751913, 4.883087185713722],
])  # fmt: skip
FEEDS = np.array([0, 1, 2, 3, 5, 6, 7, 8, 9, 14])  # the components on which the rates depend: p, L_x, L_y, n and sigma
STIFF = 4.0  # relaxation times of the slip in a step; those of stepper.py are stable up to about 6
CREEPING_SLIP = 1e-3  # ((gR)^1/2): slip above which implicit steps are hardly longer than others
DIFFERENCE, OF_SIGMA = 1e-8, 1e-4  # the changes of z, and of sigma, for a difference quotient
SLIP_TOLERANCE = 1e-4  # of sigma and n at most
TOLERANCE = 5e-9  # the least tolerance of an implicit step


def slowest_patch(w_z: float, modes: Modes, P: Record, C: Record) -> tuple[int, float, float]:
    """Of the contacts that slip, the one with the least |s|, and that |s|; and the fastest relaxation of a slip, k N
    (1 + z^2/I1) with the height z of G above the contact; after forces()."""
    slowest, least, fastest = NO_ONE, np.inf, 0.0
    for i in range(1 + P.stem):
        if modes[i] == SLIP:
            u = np.hypot(C.u[i, 0], C.u[i, 1])
            size = np.hypot(u, P.law.radius * w_z)
            if size < least:
                slowest, least = i, size
            if u > 0.0:
                k_N = np.hypot(C.F[i, 0], C.F[i, 1]) / u
                fastest = max(fastest, k_N * (1 + C.rho[i, 2] ** 2 / P.I1))
    return slowest, least, fastest


def is_stiff(W: Record, P: Record, h: float) -> bool:
    """Whether stability would limit the steps of stepper.py, or they may change v by more than the slip, after one of
    length h to step.new. If the ball sticks, the slip of the stem has one direction only, and nothing relaxes."""
    S, C, modes = W.step, W.contacts, modes_of(W)
    if modes[BALL] == STICK:
        return False
    w_z = turning(S.new, P)[1][2]
    W.creeps, slip, fastest = slowest_patch(w_z, modes, P, C)
    relaxes = h * (1.0 if W.implicit else time_scale(modes, w_z, P, C)) * fastest
    return slip < CREEPING_SLIP and (relaxes > STIFF or 0.0 < slip < S.scale[at.VX])


def to_direction(W: Record, P: Record) -> None:
    """Changes v_x, v_y and L_z in step.z into n and sigma = 1."""
    S, C, i = W.step, W.contacts, W.creeps
    S.creeps = i
    _, w, _ = arrange(S.z, NO_ONE, modes_of(W), P, C)
    S.unit = np.sqrt(C.u[i, 0] ** 2 + C.u[i, 1] ** 2 + (P.law.radius * w[2]) ** 2)
    S.z[at.NX], S.z[at.NY], S.z[at.NZ] = C.u[i, 0] / S.unit, C.u[i, 1] / S.unit, P.law.radius * w[2] / S.unit
    S.z[at.SIGMA], S.z[at.Z] = 1.0, 0.0
    S.scale[at.NX] = S.scale[at.NY] = min(S.scale[at.VX] / S.unit, SLIP_TOLERANCE)
    S.scale[at.NZ] = S.scale[at.SIGMA] = min(S.scale[at.LZ] / P.I1 * P.law.radius / S.unit, S.scale[at.NX])


def creeping_rates(z: Array, W: Record, P: Record, out: Array) -> float:
    """Writes dz/dt into out; returns what forces() returns. Friction has all the digits of n, which u has not."""
    S, C, modes, i, radius = W.step, W.contacts, modes_of(W), W.step.creeps, P.law.radius
    S.y[:] = z
    from_direction(S.y, i, S.unit, P, C)
    k, t = push(P.law, z[at.NX] * z[at.NX] + z[at.NY] * z[at.NY], z[at.NZ] / radius)
    C.friction[0], C.friction[1], C.friction[2] = k * z[at.NX], k * z[at.NY], t
    C.given = 1 + i
    minor = rates(S.y, NO_ONE, modes, P, C, out)
    C.given = 0
    g = out[at.TIME]
    for j in range(16):
        out[j] /= g
    w = turning(S.y, P)[1]
    x, y, turns = slip_rate(w, i, 0, C), slip_rate(w, i, 1, C), radius * C.w_dot[2]
    square = z[at.NX] * z[at.NX] + z[at.NY] * z[at.NY] + z[at.NZ] * z[at.NZ]
    grows = (x * z[at.NX] + y * z[at.NY] + turns * z[at.NZ]) / square
    size = S.unit * z[at.SIGMA]
    out[at.NX], out[at.NY] = (x - grows * z[at.NX]) / size, (y - grows * z[at.NY]) / size
    out[at.NZ], out[at.SIGMA], out[at.Z] = (turns - grows * z[at.NZ]) / size, grows / S.unit, 0.0
    return minor


def differentiate(W: Record, P: Record) -> None:
    """Changes step.z by to_direction(); writes dz/dt there into step.K[0], and J, column by column, into step.J."""
    S = W.step
    to_direction(W, P)
    creeping_rates(S.z, W, P, S.K[0])
    S.at[:] = S.z
    for n in range(len(FEEDS)):
        i = FEEDS[n]
        S.at[i] += OF_SIGMA if i == at.SIGMA else DIFFERENCE
        creeping_rates(S.at, W, P, S.K[1])
        for j in range(16):
            S.J[j, n] = (S.K[1, j] - S.K[0, j]) / (S.at[i] - S.z[i])
        S.at[i] = S.z[i]


def until_half(W: Record) -> float:
    """How long the slip takes to be half as large, as it changes now, after differentiate(). At half the slip n relaxes
    twice as fast as the Jacobian says, and the stages of a longer step would diverge."""
    grows = W.step.K[0, at.SIGMA]
    return -0.5 / grows if grows < 0.0 else np.inf


def implicit_step(W: Record, P: Record, h: float) -> tuple[float, float]:
    """Computes a step of length h from step.z, after differentiate(), and its end into step.new: its error relative to
    the allowed one, and the least margin()."""
    S, C, modes, near = W.step, W.contacts, modes_of(W), np.inf
    U, J, matrix, right, n = S.U, S.J, S.matrix, S.right, len(FEEDS)
    for r in range(n):
        for c in range(n):
            matrix[r, c] = -J[FEEDS[r], c]
        matrix[r, r] += 1 / (GAMMA * h)
    decompose(matrix, S.pivots, n)
    for s in range(PARTS):
        f = S.K[min(s, 1)]
        if s > 0:
            stage(S.z, U, A_IJ[s], s, 1.0, S.at)
            minor = creeping_rates(S.at, W, P, f)
            near = min(near, margin(S.at, minor, modes, P, C))
        stage(f, U, C_IJ[s], s, 1 / h, S.at)
        for r in range(n):
            right[r] = S.at[FEEDS[r]]
        substitute(matrix, S.pivots, right, n)
        for i in range(16):  # of these, the components that do not feed back
            total = S.at[i]
            for c in range(n):
                total += J[i, c] * right[c]
            U[s, i] = GAMMA * h * total
        for r in range(n):
            U[s, FEEDS[r]] = right[r]
    stage(S.z, U, A_IJ[PARTS], PARTS, 1.0, S.new)
    polynomial(S)
    square, slips = 0.0, S.new[at.SIGMA] > 0.0
    for i in range(16):
        square += (U[PARTS - 1, i] / S.scale[i]) ** 2
    from_direction(S.new, S.creeps, S.unit, P, C)
    minor = rates(S.new, NO_ONE, modes, P, C, S.K[STAGES])
    return np.sqrt(square / 16) if slips else np.inf, min(near, margin(S.new, minor, modes, P, C))


def polynomial(S: Record) -> None:
    """The polynomial through the last step, in the form of stepper.py."""
    F = S.polynomial
    F[:] = 0.0
    for i in range(16):
        F[0, i] = S.new[i] - S.z[i]
        for j in range(PARTS):
            F[1, i] += H_IJ[0, j] * S.U[j, i]
            F[2, i] += (H_IJ[1, j] + H_IJ[2, j]) * S.U[j, i]
            F[3, i] -= H_IJ[2, j] * S.U[j, i]
