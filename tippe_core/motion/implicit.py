"""One step of a linearly implicit method of order 5, for a patch that hardly slips and hardly spins.

Contensou's law is stiff there: the slip relaxes at a rate of about k N, which grows as 1/|u|, to the value at which
friction balances the other forces, and the steps of stepper.py would shrink with |u|. With f = dz/dtau, J = df/dz,

    [1/(gamma h) - J] U_i = f(z + sum_j a_ij U_j) + sum_j c_ij U_j/h ,   i = 0 ... 7 ,
    new z = z + sum_j a_8j U_j ,   error: U_7 ,

and the polynomial through the step is z + x {new z - z + (1 - x) [V_0 + x V_1 + x^2 V_2]}, V_i = sum_j h_ij U_j.
Rodas5P of G. Steinebach, BIT Numer. Math. 63, 27 (2023), whose coefficients these are.
"""

import numpy as np

from ..types import Array
from . import at
from .contacts import margin
from .dynamics import rates, time_scale, turning
from .elimination import decompose, substitute
from .kinds import Modes
from .records import NO_ONE, SLIP, Record, modes_of
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
FEEDS = np.array([0, 1, 2, 3, 5, 6, 7, 8, 9])  # the components on which the rates depend: p, L, v_x and v_y
STIFF = 4.0  # relaxation times of the slip in a step; those of stepper.py are stable up to about 6
CREEPING_SLIP = 1e-3  # ((gR)^1/2): slip above which implicit steps are hardly longer than others
DIFFERENCE = 1e-8  # ((gR)^1/4): times the root of the slip, the change of v for a difference quotient
TOLERANCE = 5e-9  # the least tolerance of an implicit step


def slowness(w_z: float, modes: Modes, P: Record, C: Record) -> tuple[float, float]:
    """The least slip speed, including that of the spin, of the contacts that slip, and the fastest relaxation of a
    slip, k N (1 + z^2/I1) with the height z of G above the contact; after forces()."""
    least, fastest = np.inf, 0.0
    for i in range(1 + P.stem):
        if modes[i] == SLIP:
            u = np.hypot(C.u[i, 0], C.u[i, 1])
            least = min(least, np.hypot(u, P.law.radius * w_z))
            if u > 0.0:
                k_N = np.hypot(C.F[i, 0], C.F[i, 1]) / u
                fastest = max(fastest, k_N * (1 + C.rho[i, 2] ** 2 / P.I1))
    return least, fastest


def is_stiff(W: Record, P: Record, h: float) -> bool:
    """Whether stability would limit the steps of stepper.py, after a step of length h to step.new, whose slip it keeps
    in W.slip."""
    C, modes = W.contacts, modes_of(W)
    w_z = turning(W.step.new, P)[1][2]
    W.slip, fastest = slowness(w_z, modes, P, C)
    return W.slip < CREEPING_SLIP and h * (1.0 if W.implicit else time_scale(modes, w_z, P, C)) * fastest > STIFF


def rates_in_time(z: Array, modes: Modes, P: Record, C: Record, out: Array) -> float:
    """rates(), as dz/dt."""
    minor = rates(z, NO_ONE, modes, P, C, out)
    g = out[at.TIME]
    for i in range(16):
        out[i] /= g
    return minor


def differentiate(W: Record, P: Record) -> None:
    """Writes dz/dtau at step.z into step.K[0], and J, column by column, into step.J."""
    S, C, modes = W.step, W.contacts, modes_of(W)
    rates_in_time(S.z, modes, P, C, S.K[0])
    w = turning(S.z, P)[1]
    slip = slowness(w[2], modes, P, C)[0]
    small = DIFFERENCE * np.sqrt(slip)
    S.at[:] = S.z
    for n in range(len(FEEDS)):
        i = FEEDS[n]
        S.at[i] += small if i > at.PW else small / (1 + abs(w[0]) + abs(w[1]) + abs(w[2]))
        rates_in_time(S.at, modes, P, C, S.K[1])
        for j in range(16):
            S.J[j, n] = (S.K[1, j] - S.K[0, j]) / (S.at[i] - S.z[i])
        S.at[i] = S.z[i]


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
            minor = rates_in_time(S.at, modes, P, C, f)
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
    minor = rates(S.new, NO_ONE, modes, P, C, S.K[STAGES])
    polynomial(S)
    square = 0.0
    for i in range(16):
        square += (U[PARTS - 1, i] / S.scale[i]) ** 2
    return np.sqrt(square / 16), min(near, margin(S.new, minor, modes, P, C))


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
