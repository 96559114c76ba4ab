"""Linear stability of the sliding top: how fast small deviations from steady spinning grow, and how fast they rotate.

Near a pole, c = +1 upright or -1 inverted, the top spins about its own axis with omega. Horizontal vectors in space are
written as complex numbers: xi for the axis, v for the velocity of G, u for the slip at the contact, F = -k u with
F_z = 1. L = I1 e x e' + I3 omega e and the torque of the forces about G give

    I1 c xi'' = i I3 omega xi' + (a c - 1) F - a xi ,     v' = F ,     u = v + i omega xi + (a - c) xi'

so solutions vary as exp(lambda t) with three complex lambda (divide by c, which equals 1/c). The real part is the
growth rate, the imaginary part the rate of rotation, seen from above. k is the slope of the friction law at small slip:
gamma, mu/eps, or (3 pi/8) mu/(radius |omega_n|). Where that is infinite (Coulomb's law, or a patch without size or
spin), or so large that only rounding would tell, the contact sticks, u = 0, and the top rolls: friction.sticks().

Tumbling is a steady precession that neither slips nor needs friction: w2^2 [I1 c - I3 (c - a)] = a s^2 and
w3 s = w2 (c - a). Near it the Jacobian of the sliding equations in (theta, w1, w2, w3, v) is found by complex-step
differentiation, which loses no digits. The spin is taken as constant; the pivoting torque changes it slowly.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import TopError, checked, finite
from .motion.friction import Friction, sticks
from .paper.top import Top
from .types import Array

Modes = NDArray[np.complex128]
ALIKE = 1e-9  # relative to the median eigenvalue, among whose larger ones are those of the slip
STEP = 1e-30  # of the complex-step derivative, whose truncation error is then below rounding


@checked
def spinning_modes(top: Top, friction: Friction, spin: float, inverted: bool = False) -> Modes:
    """The eigenvalues of small disturbances of a top that spins about its own vertical axis.

    Parameters
    ----------
    top : Top
        the top
    friction : Friction
        a law of friction
    spin : float
        angular velocity about axis 3, in (g/R)^1/2
    inverted : bool
        theta = pi in place of 0

    Returns
    -------
    complex array
        lambda in (g/R)^1/2: three, or two where friction makes the contact stick: Coulomb's always, Contensou's
        with radius or spin 0, and each whose k exceeds 1e8 there. The one that grows fastest comes first; of those
        that grow alike, the slowest: the precession before the nutation

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    a, I1, I3, c, w = top.a, top.I1, top.I3, -1.0 if inverted else 1.0, finite("spin", spin)
    if sticks(friction.law, c * w):
        # F = v' = -(i omega xi' + (a - c) xi''), and c (a c - 1) = a - c
        inertia, gyro = I1 + (a - c) ** 2, 1j * w * (c * I3 - (a - c))
        return _sorted(np.array([[0, 1], [-c * a / inertia, gyro / inertia]]))
    k = float(friction.k(0.0, c * w))
    F = -k * np.array([1j * w, a - c, 1.0])  # of xi, xi', v
    bends = ((a - c) * F + np.array([-c * a, 1j * c * I3 * w, 0])) / I1
    return _sorted(np.array([[0, 1, 0], bends, F]))


@checked
def tumbling_modes(top: Top, friction: Friction, theta: float) -> Modes:
    """The eigenvalues of small disturbances of tumbling: the steady precession that neither slips nor needs friction.

    Parameters
    ----------
    top : Top
        the top
    friction : Friction
        a law of friction
    theta : float
        its tilt in rad

    Returns
    -------
    complex array
        lambda in (g/R)^1/2: six, or four where friction makes the contact stick, as in spinning_modes(); the one
        that grows fastest comes first. One is 0, because neighbouring precessions are steady too

    Raises
    ------
    TopError
        if there is no such precession at that tilt
    """
    y = tumbling(top, theta)
    omega_n = float(y[2] * np.sin(theta) + y[3] * np.cos(theta))
    holds = sticks(friction.law, omega_n)
    k = 0.0 if holds else float(friction.k(0.0, omega_n))
    columns = []
    for i in range(4 if holds else 6):
        moved = y.astype(complex)
        moved[i] += 1j * STEP
        columns.append((_rolling if holds else _sliding)(moved, top, k).imag / STEP)
    return _sorted(np.array(columns).T[: len(columns)])


def tumbling(top: Top, theta: float) -> Array:
    """(theta, w1, w2, w3, vx, vy) of the steady precession at the tilt theta that needs no friction."""
    s, c = np.sin(finite("theta", theta)), np.cos(theta)
    turns = top.I1 * c - top.I3 * (c - top.a)
    if not 0 < theta < np.pi or top.a * turns <= 0:
        raise TopError("theta", theta, "0 < theta < pi, a (I1 c - I3 (c - a)) > 0")
    w2 = s * np.sqrt(top.a / turns)
    return np.array([theta, 0.0, w2, w2 * (c - top.a) / s, 0.0, 0.0])


def _sliding(y: Modes, top: Top, k: float) -> Modes:
    """Time derivative of the state by the sliding equations, with F_h = -k F_z u."""
    theta, w1, w2, w3, vx, vy = y
    a, s, c = top.a, np.sin(theta), np.cos(theta)
    phi_dot = w2 / s
    ux, uy = vx - (w2 * (c - a) - w3 * s), vy + w1 * (1 - a * c)  # c (c - a) + s^2
    # w1' = F_z arm/I1 + free, and F_z = 1 + a (s w1' + c w1^2)
    arm = -a * s - k * uy * (1 - a * c)
    free = -top.I3 * w2 * w3 / top.I1 + phi_dot * c * w2
    F_z = (1 + a * (s * free + c * w1 * w1)) / (1 - a * s * arm / top.I1)
    Fx, Fy = -k * F_z * ux, -k * F_z * uy
    return np.array([
        w1, F_z * arm / top.I1 + free, (-Fx * (c - a) + top.I3 * w1 * w3) / top.I1 - phi_dot * c * w1,
        Fx * s / top.I3, Fx + phi_dot * vy, Fy - phi_dot * vx])  # fmt: skip


def _rolling(y: Modes, top: Top, k: float) -> Modes:
    """The same for u = 0: v and v' follow from the angular velocity, and F from v'."""
    theta, w1, w2, w3 = y[:4]
    a, s, c, I1, I3 = top.a, np.sin(theta), np.cos(theta), top.I1, top.I3
    phi_dot, arm = w2 / s, 1 - a * c  # c (c - a) + s^2
    vx, vy = w2 * (c - a) - w3 * s, -w1 * arm
    # unknowns: w1', w2', w3', Fx, Fy, F_z
    A = np.array([
        [I1, 0, 0, 0, -arm, a * s], [0, I1, 0, c - a, 0, 0], [0, 0, I3, -s, 0, 0],
        [0, c - a, -s, -1, 0, 0], [-arm, 0, 0, 0, -1, 0], [-a * s, 0, 0, 0, 0, 1]])  # fmt: skip
    right = np.array([
        I1 * phi_dot * c * w2 - I3 * w2 * w3, I3 * w1 * w3 - I1 * phi_dot * c * w1, 0,
        w2 * s * w1 + w3 * c * w1 + phi_dot * vy, a * s * w1 * w1 - phi_dot * vx, 1 + a * c * w1 * w1])  # fmt: skip
    return np.concatenate([[w1], np.linalg.solve(A, right)[:3]])


def _sorted(matrix: NDArray[Any]) -> Modes:
    """The eigenvalues by falling growth. Growths that rounding alone tells apart count as equal."""
    found = np.linalg.eigvals(matrix)
    sizes = np.sort(np.abs(found))
    alike = max(ALIKE * sizes[len(sizes) // 2], 100 * np.finfo(float).eps * sizes[-1])
    growth = np.round(found.real / (alike or ALIKE))
    return np.asarray(found[np.lexsort((np.abs(found.imag), -growth))], complex)
