"""The derived quantities of a state (angles, quaternion, omega, forces) as one SAMPLE of a Trajectory."""

import numpy as np

from ..compiled import compiled
from ..types import Array
from . import at
from .dynamics import Turning, arrange, carried
from .kinds import Modes
from .records import NO_ONE, OPEN, SLIP, Record

PULLS = 2e-10  # (Mg): smaller values are rounding
AIR, SLIPPING, ROLLING = range(3)
REGIMES = np.array(["air", "slip", "roll"])


def continue_angles(y: Array, angles: Array) -> None:
    """(phi + psi - chi)/2 and (phi - psi + chi)/2 at y, continued from angles, half turns included.

    p_w + i p_z = cos(theta/2) exp i(phi + psi - chi)/2,  p_x + i p_y = sin(theta/2) exp i(phi - psi + chi)/2
    """
    for n in range(2):
        up, along = (y[at.PZ], y[at.PW]) if n == 0 else (y[at.PY], y[at.PX])
        if up != 0.0 or along != 0.0:
            by = np.arctan2(up, along) - angles[n]
            angles[n] += by - 2 * np.pi * np.round(by / (2 * np.pi))


def tilt_of(y: Array) -> float:
    """theta"""
    return 2 * np.arctan2(np.hypot(y[at.PX], y[at.PY]), np.hypot(y[at.PZ], y[at.PW]))


def record(
    y: Array, t: float, turning: Turning, angles: Array, modes: Modes, P: Record, C: Record, out: Record
) -> None:
    """The SAMPLE at y, after forces()."""
    e, w, _ = turning
    phi, psi = angles[0] + angles[1], angles[0] - angles[1] + y[at.CHI]
    theta = tilt_of(y)
    out.t, out.theta, out.phi, out.psi, out.heat = t, theta, phi, psi, y[at.HEAT]
    # q = p Rz(chi)
    size = 1 / np.sqrt(y[at.PX] ** 2 + y[at.PY] ** 2 + y[at.PZ] ** 2 + y[at.PW] ** 2)
    c, s = np.cos(y[at.CHI] / 2) * size, np.sin(y[at.CHI] / 2) * size
    q = out.quaternion
    q[0], q[1] = y[at.PX] * c + y[at.PY] * s, y[at.PY] * c - y[at.PX] * s
    q[2], q[3] = y[at.PZ] * c + y[at.PW] * s, y[at.PW] * c - y[at.PZ] * s
    out.com[0], out.com[1], out.com[2] = y[at.X], y[at.Y], C.G[3]
    # from axes fixed in space to 1' and z cross 1'
    c, s, cos_theta, sin_theta = np.cos(phi), np.sin(phi), np.cos(theta), np.sin(theta)
    across, omega, velocity = w[1] * c - w[0] * s, out.omega, out.velocity
    omega[0] = w[0] * c + w[1] * s
    omega[1], omega[2] = cos_theta * across + sin_theta * w[2], cos_theta * w[2] - sin_theta * across
    velocity[0], velocity[1], velocity[2] = C.G[0] * c + C.G[1] * s, C.G[1] * c - C.G[0] * s, C.G[2]
    rolls = SLIP not in modes
    out.regime = AIR if carried(modes) == 0 else ROLLING if rolls else SLIPPING
    rho_x, rho_y, N = P.a * e[0], P.a * e[1], 0.0
    ux = uy = Fx = Fy = 0.0
    if out.regime != AIR:
        rho_x = rho_y = 0.0
        for i in range(1 + P.stem):
            N += C.F[i, 2]
        for i in range(1 + P.stem):
            if modes[i] != OPEN:
                share = C.F[i, 2] / N if N != 0.0 else 1.0
                Fx, Fy = Fx + C.F[i, 0], Fy + C.F[i, 1]
                rho_x, rho_y = rho_x + share * C.rho[i, 0], rho_y + share * C.rho[i, 1]
                if not rolls:
                    ux, uy = ux + share * C.u[i, 0], uy + share * C.u[i, 1]
    out.contact[0], out.contact[1] = y[at.X] + rho_x, y[at.Y] + rho_y
    out.slip[0], out.slip[1] = ux * c + uy * s, uy * c - ux * s
    out.force[0], out.force[1], out.force[2] = Fx * c + Fy * s, Fy * c - Fx * s, (0.0 if -PULLS < N < 0.0 else N)


@compiled
def sample_at(W: Record, P: Record, modes: Modes, out: Record) -> None:
    """The SAMPLE at W.y in these modes, with the forces in W.contacts."""
    turning = arrange(W.y, NO_ONE, modes, P, W.contacts)
    record(W.y, W.y[at.TIME], turning, W.angles, modes, P, W.contacts, out)
