"""A sphere with its mass off centre on a plane, in MuJoCo."""

import mujoco
import numpy as np

XML = """
<mujoco>
  <option timestep="{step}" integrator="{integrator}" cone="elliptic" gravity="0 0 -1" tolerance="1e-15"/>
  <default>
    <geom friction="{mu} 0 0" condim="{condim}" solref="-{k} -{damping}" solimp="0.95 0.95 0.001"/>
  </default>
  <worldbody>
    <geom type="plane" size="0 0 1"/>
    <body pos="0 0 1">
      <freejoint/>
      <inertial mass="1" pos="0 0 {G}" diaginertia="{I1} {I1} {I3}"/>
      <geom type="sphere" size="1"/>
    </body>
  </worldbody>
</mujoco>
"""


def placed(top, theta, step, k, mu=None, integrator="implicitfast"):
    """(model, data) of a top at rest, tilted about 1, pressed in by its own weight; k: the contact's stiffness.

    mu: Coulomb's friction; None: the contact has none.
    """
    model = mujoco.MjModel.from_xml_string(XML.format(
        step=step, integrator=integrator, mu=mu or 0, condim=1 if mu is None else 3, k=k, damping=2 * k**0.5,
        G=-top.a, I1=top.I1, I3=top.I3))  # fmt: skip
    data = mujoco.MjData(model)
    data.qpos[:] = 0, 0, 1 - 0.05 / k, np.cos(theta / 2), np.sin(theta / 2), 0, 0
    return model, data
