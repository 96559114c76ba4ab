"""The impact by which a rough table stops the slip of a top that is not rolling yet.

An impulse (J_x, J_y, J_z) at the contact stops the slip, and J_z keeps the ball on the table. There is no other
impulse, so the angular momentum about the contact point is conserved, and so is C_J (14). With the velocity
(vx, vy, a s w1) of G and the slip u of dynamics.py, the equations for x and y decouple:

    J_x = -I3 u_x/f3^2 ,   I1 dw2 = -(c - a) J_x ,   I3 dw3 = s J_x ,   dvx = J_x ,
    J_y = -m u_y/f1^2 ,    m dw1 = (1 - a c) J_y ,   dvy = J_y ,   m = I1 + a^2 s^2 ,

    energy lost = (1/2) (I3 u_x^2/f3^2 + m u_y^2/f1^2) ,

with f1 and f3 of (35) and (32). E. J. Routh, Dynamics of a System of Rigid Bodies, part I (impulses on perfectly rough
bodies). The rough table of the paper exerts whatever force is needed: J_z may be negative, and |J_h| may be larger than
mu_s J_z.
"""

from dataclasses import replace

import numpy as np

from ..errors import checked
from ..paper import equations as eq
from ..paper.constants import State, require_contact, versines
from ..paper.top import Top


@checked
def grip(top: Top, state: State) -> tuple[State, float]:
    """The rolling State right after a rough table has stopped the slip at the ball, and the energy lost.

    C_J is conserved, K_R and E are not. A State that rolls already loses nothing. The position of G and the orientation
    do not change; at a pole phi is chosen so that 1' is along the horizontal part of omega, and psi accordingly.

    Parameters
    ----------
    top : Top
        the top
    state : State
        vx, vy None mean that G is at rest, as for slide()

    Returns
    -------
    tuple of State and float
        the State, and the energy lost in MgR (0 or more)

    Raises
    ------
    TopError
        for anything but a Top and a State, and for a State in flight
    """
    require_contact(top, state)
    a, I1, I3 = top.a, top.I1, top.I3
    v, m = (float(x) for x in versines(state.theta))
    c, s = (1 - v if v <= m else m - 1), (v * m) ** 0.5
    w1, w2, w3 = state.theta_dot, state.omega2, state.omega3
    x, y = eq.rolling_velocity(c, s, w1, w2, w3, top)
    ux, uy = (state.vx or 0.0) - x, (state.vy or 0.0) - y
    inertia = I1 + (a * s) ** 2
    Jx, Jy = -I3 * ux / eq.f3_2(c, s * s, top), -inertia * uy / eq.f1_2(c, top)
    lost = -(Jx * ux + Jy * uy) / 2
    w1, w2, w3 = w1 + (1 - a * c) * Jy / inertia, w2 - (c - a) * Jx / I1, w3 + s * Jx / I3
    phi, psi = state.phi, state.psi
    if s == 0.0 and w2:
        lean = float(np.angle(c * (w1 + 1j * c * w2)))
        w1, w2, phi, psi = c * float(np.hypot(w1, w2)), 0.0, phi + lean, psi - c * lean
    vx, vy = eq.rolling_velocity(c, s, w1, w2, w3, top)
    return replace(state, theta_dot=w1, omega2=w2, omega3=w3, phi=phi, psi=psi, vx=vx, vy=vy), lost
