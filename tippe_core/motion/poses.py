"""The derived quantities of a state (angles, quaternion, omega, forces) as one row of a Trajectory."""

import numpy as np

from ..compiled import compiled
from ..types import Array
from .dynamics import BALL, NO_ONE, OPEN, STICK, Turning, arrange
from .records import Record

PULLS = 2e-10  # (Mg): smaller values are rounding
AIR, SLIPPING, ROLLING = range(3)
REGIMES = np.array(["air", "slip", "roll"])
# columns of a row
COLUMNS = {"t": slice(0, 1), "theta": slice(1, 2), "phi": slice(2, 3), "psi": slice(3, 4), "quaternion": slice(4, 8),
           "contact": slice(8, 10), "com": slice(10, 13), "omega": slice(13, 16), "slip": slice(16, 18),
           "force": slice(18, 21), "velocity": slice(21, 24), "heat": slice(24, 25), "regime": slice(25, 26),
           }  # fmt: skip
WIDTH = 26


@compiled
def turned(y: Array, angles: Array) -> None:
    """(phi + psi - chi)/2 and (phi - psi + chi)/2 at y, continued from angles, half turns included.

    p_w + i p_z = cos(theta/2) exp i(phi + psi - chi)/2,  p_x + i p_y = sin(theta/2) exp i(phi - psi + chi)/2
    """
    for n in range(2):
        up, along = (y[2], y[3]) if n == 0 else (y[1], y[0])
        if up != 0.0 or along != 0.0:
            by = np.arctan2(up, along) - angles[n]
            angles[n] += by - 2 * np.pi * np.round(by / (2 * np.pi))


@compiled
def record(
    y: Array, t: float, turn: Turning, angles: Array, ball: int, stem: int, P: Record, C: Record, out: Array
) -> None:
    """The row of COLUMNS at y, after forces()."""
    e, w, _ = turn
    phi, psi = angles[0] + angles[1], angles[0] - angles[1] + y[4]
    theta = 2 * np.arctan2(np.hypot(y[0], y[1]), np.hypot(y[2], y[3]))
    out[0], out[1], out[2], out[3] = t, theta, phi, psi
    # q = p Rz(chi)
    size = 1 / np.sqrt(y[0] ** 2 + y[1] ** 2 + y[2] ** 2 + y[3] ** 2)
    c, s = np.cos(y[4] / 2) * size, np.sin(y[4] / 2) * size
    out[4], out[5] = y[0] * c + y[1] * s, y[1] * c - y[0] * s
    out[6], out[7] = y[2] * c + y[3] * s, y[3] * c - y[2] * s
    out[8], out[9] = y[10] + P.a * e[0], y[11] + P.a * e[1]
    out[10], out[11], out[12] = y[10], y[11], C.G[3]
    # from axes fixed in space to 1' and z cross 1'
    c, s = np.cos(phi), np.sin(phi)
    across, cos_theta, sin_theta = w[1] * c - w[0] * s, np.cos(theta), np.sin(theta)
    out[13] = w[0] * c + w[1] * s
    out[14], out[15] = cos_theta * across + sin_theta * w[2], cos_theta * w[2] - sin_theta * across
    out[21], out[22], out[23] = C.G[0] * c + C.G[1] * s, C.G[1] * c - C.G[0] * s, C.G[2]
    out[24], out[25] = y[13], AIR
    for i in range(16, 21):
        out[i] = 0.0
    if ball == OPEN and stem == OPEN:
        return
    rolls = (ball == STICK or ball == OPEN) and (stem == STICK or stem == OPEN)
    out[25], N = (ROLLING if rolls else SLIPPING), 0.0
    ux = uy = Fx = Fy = rho_x = rho_y = 0.0
    for i in range(1 + P.stem):
        N += C.F[i, 2]
    for i in range(1 + P.stem):
        if (ball if i == BALL else stem) != OPEN:
            share = C.F[i, 2] / N if N != 0.0 else 1.0
            Fx, Fy = Fx + C.F[i, 0], Fy + C.F[i, 1]
            rho_x, rho_y = rho_x + share * C.rho[i, 0], rho_y + share * C.rho[i, 1]
            if not rolls:
                ux, uy = ux + share * C.u[i, 0], uy + share * C.u[i, 1]
    out[8], out[9] = y[10] + rho_x, y[11] + rho_y
    out[16], out[17] = ux * c + uy * s, uy * c - ux * s
    out[18], out[19], out[20] = Fx * c + Fy * s, Fy * c - Fx * s, (0.0 if -PULLS < N < 0.0 else N)


@compiled
def row_at(W: Record, P: Record, ball: int, stem: int, out: Array) -> None:
    """The row at W.y in these modes, with the forces in W.contacts."""
    turn = arrange(W.y, NO_ONE, ball, stem, P, W.contacts)
    record(W.y, W.y[12], turn, W.angles, ball, stem, P, W.contacts, out)
