"""The paper's Fig. 5, f1^2 theta_dot^2 over the (K_J, theta) plane, as a surface that can be turned, enlarged and
read."""

import numpy as np
import param

from app.bundle import Bundled, pack


class Surface3D(Bundled):
    """Each row of the surface is one tieline, from its inner to its outer turning point; a row with nan is a gap.

    All bytes are float32, from `pack`; n rows of m points.
    """

    SAYS = ("Stage",)
    REGIMES = "why_html"

    K_J = param.Bytes(default=b"", doc="(n,) ascending")
    theta = param.Bytes(default=b"", doc="(n, m) in rad")
    heights = param.Bytes(default=b"", doc="(n, m) f1^2 theta_dot^2, 0 at both ends")
    energy = param.Bytes(default=b"", doc="(n,) E")
    verge = param.Bytes(default=b"", doc="(k, 2) theta, K_J: where the limit is reached, on the floor")
    steady = param.Bytes(default=b"", doc="(k, 2) theta, K_J: the steady precessions, on the floor")
    P = param.Bytes(default=b"", doc="(3,) theta, K_J, height of the point P; empty if it is not shown")
    selected = param.Bytes(default=b"", doc="(4,) K_J, inner, outer theta, worst regime of the motion on display")
    selected_curve = param.Bytes(default=b"", doc="(m, 2) theta, height of the motion on display")
    theta_max = param.Number(default=np.pi / 2, doc="The end of the theta axis.")
    limit = param.Selector(default="lift-off", objects=["lift-off", "slip"], doc="Which limit `verge` is of.")
    hand = param.List(
        default=[],
        doc="[grip, theta, K_J] of a hand, the browser writes it; grip: on the floor, 'end' of the motion on display, "
        "its 'line', or a 'point' that is on no tieline; a 'tieline' of the surface.",
    )


def show_surface(surface, scene):
    plane, motion = scene.plane, scene.constants
    if surface.is_new(plane):
        surface.tell(
            K_J=pack(plane.K_J), theta=pack(plane.theta), heights=pack(plane.height), energy=pack(plane.surface.E),
            verge=pack(np.column_stack([plane.surface.theta_verge, plane.K_J])),
            steady=pack(np.column_stack([plane.lift.theta_steady, plane.K_J])),
            P=pack([0, plane.pole, plane.pole_height]), theta_max=plane.surface_range[1], limit=plane.limit,
        )  # fmt: skip
    surface.tell(selected=pack([motion.K_J, *scene.turning, scene.regime.max()]), selected_curve=pack(scene.curve))
