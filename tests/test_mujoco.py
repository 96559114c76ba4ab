"""MuJoCo, a rigid-body engine that knows nothing of tops: a sphere with its mass off centre on a plane.

Its contact is soft and its step is of first order, so it is a peer for short times only: stiff contacts, small steps,
and slow slip, for its friction cone is convex and lifts a fast sliding body off the table. Allowed: 3e-4 of theta, the
spin and G's place after one or two (R/g)^1/2, and with Richardson's extrapolation in the step 2e-5 where the contact
itself is smooth.
"""

import mujoco
import numpy as np
import pytest
from cases import LOADED, PAPER
from mujoco_sphere import placed

from tippe_core import Coulomb, State, Top, Viscous, glide, slide

STIFFNESS = 1e5


def moved(top, state, friction, duration, step):
    """theta, G's place and omega_3 after a duration."""
    coulomb = isinstance(friction, Coulomb)
    model, data = placed(top, state.theta, step, STIFFNESS, friction.mu_k if coulomb else None)
    s, c = np.sin(state.theta), np.cos(state.theta)
    spin = np.array([state.theta_dot, state.omega2, state.omega3])
    turned = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    O = np.array([state.vx or 0.0, state.vy or 0.0, 0.0]) + np.cross(turned @ spin, top.a * turned[:, 2])
    data.qvel[:] = *O[:2], 0, *spin
    down, contact = np.array([0, 0, -1.0]), np.zeros(6)
    contact[0] = 1
    for _ in range(round(duration / step)):
        mujoco.mj_step1(model, data)
        if not coulomb:  # we supply the law; its normal force is that of the previous step
            body = data.xmat[1].reshape(3, 3)
            u = data.qvel[:3] + np.cross(body @ data.qvel[3:], down)
            push = -friction.gamma * contact[0] * u * [1, 1, 0]
            data.qfrc_applied[:] = [*push, *(body.T @ np.cross(down, push))]
        mujoco.mj_step2(model, data)
        if data.ncon:
            mujoco.mj_contactForce(model, data, 0, contact)
    mujoco.mj_forward(model, data)
    return np.array([np.arccos(data.xmat[1][8]), *data.xipos[1], data.qvel[5]])


def ours(top, motion):
    """The same, with G at the start where MuJoCo's sphere has it."""
    place = motion.com[-1] + [0, top.a * np.sin(motion.theta[0]), 0]
    return np.array([motion.theta[-1], *place, motion.omega[-1, 2]])


STARTS = {"paper": (PAPER, State(0.8, 0.2, 1.0, 6.0, vx=0.5, vy=0.3)), "loaded": (LOADED, State(0.5, 0.1, 0.5, 4.0)),
          "ordinary": (Top(a=-1.0, I1=1.2, I3=0.5), State(0.4, 0.0, 0.5, 9.0, vx=0.2))}  # fmt: skip
AGAINST = "MuJoCo, extrapolated to step 0"


def extrapolated(*arguments):
    coarse, fine = (moved(*arguments, step) for step in (5e-4, 2.5e-4))
    return 2 * fine - coarse


@pytest.mark.parametrize(("top", "state"), STARTS.values(), ids=STARTS.keys())
def test_smooth_plane(top, state, compare):
    expected = extrapolated(top, state, Viscous(0.0), 1.0)
    compare("MuJoCo: smooth", ours(top, glide(top, state, [0.0, 1.0])), expected, 2e-5, AGAINST)


@pytest.mark.parametrize(("top", "state"), STARTS.values(), ids=STARTS.keys())
def test_viscous_friction(top, state, compare):
    friction = Viscous(0.3)
    expected = extrapolated(top, state, friction, 1.0)
    found = ours(top, slide(top, state, friction, [0.0, 1.0], rtol=1e-11))
    compare("MuJoCo: viscous", found, expected, 2e-5, AGAINST)
    start = ours(top, slide(top, state, friction, [0.0, 1e-9]))
    assert np.abs(found - start)[[0, 4]].min() > 0.01  # the motion is not one that hardly moves


@pytest.mark.parametrize("mu", [0.1, 0.3])
def test_coulomb_friction_until_it_sticks(mu, compare):
    """A top near upright, slipping slowly, is caught rolling and rolls on."""
    state, friction = State(0.1, 0.0, 0.0, 4.0), Coulomb(mu)
    motion = slide(PAPER, state, friction, [0.0, 2.0], rtol=1e-11)
    assert [what for _, what in motion.events] == ["sticks"]
    expected = moved(PAPER, state, friction, 2.0, 2.5e-4)
    compare("MuJoCo: Coulomb", ours(PAPER, motion), expected, 3e-4, "MuJoCo, step 2.5e-4")
