"""Inputs of the Explorer that follow from dragging something in a picture of a Scene."""

import numpy as np

from app.model.region import least_energy
from app.model.scene import Scene


def pulled(scene: Scene, grip: str, theta: float, K_J: float, limit: str) -> dict[str, float | str]:
    """The inputs for a pointer at (theta, K_J). grip: "tieline" makes that tieline the motion, up to the limit "slip"
    or "lift-off"; "line" drags the motion's own line; "end", or a "point" beyond it, is where the motion then turns."""
    if grip == "tieline":
        return {"K_J": K_J, "energy": {"slip": 1.0, "lift-off": 2.0}[limit], "given": "share"}
    if grip == "line":
        return {"K_J": K_J, "given": "share"}
    K_J = float(scene.constants.K_J) if grip == "end" else K_J
    at = np.array(min(max(theta, 0.0), np.pi))
    E = least_energy(at, scene.top, K_J, scene.inputs["K_R"])
    return {"K_J": K_J, "E": float(E), "given": "E"}
