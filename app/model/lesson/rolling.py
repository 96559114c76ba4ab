"""The answers for theorists, about one rolling top: where it turns back, and where it slips or leaves the table."""

import numpy as np

from app.model.colours import COLOURS, GREY, INK
from app.model.lesson.parts import FEW, Answer, Curve, Picture, Point, level, limit_words, selected, tied
from app.model.scene import Scene
from tippe_core import Constants, allowed_shares, f, f1_squared, normal_force, pole_constants, tielines


def turning(scene: Scene) -> Answer:
    """The tilt at which the motion turns back, in degrees."""
    top, constants = scene.top, scene.constants
    inner, outer = np.degrees(scene.turning)
    reach = 0.35 * (scene.turning[1] - scene.turning[0]) + 0.02
    theta = np.linspace(max(scene.turning[0] - reach, 1e-3), min(scene.turning[1] + reach, np.pi - 1e-3), 241)
    height = f1_squared(theta, top) * f(theta, top, constants)
    numbers = {
        "inner": inner, "outer": outer, "K_J": constants.K_J, "K_R": constants.K_R, "E": constants.E,
        "two_E_prime": constants.two_E_prime(top), "steady": np.degrees(scene.marks.theta_steady),
        "fastest": np.abs(scene.nutation.omega[:, 0]).max(), "period": scene.rolling.period,
        "milliseconds": 1e3 * scene.rolling.period * scene.scales.time,
    }  # fmt: skip
    curves = (
        Curve("curve", COLOURS["theta"], np.degrees(theta), height),
        level("zero", GREY, np.degrees(theta), 0.0, "solid"),
    )
    points = (Point("inner", inner, 0.0), Point("outer", outer, 0.0))
    return Answer(float(outer), numbers, Picture("degrees", "height", curves, points))


def ties(scene: Scene) -> Answer:
    """How the range of tilt changes as K_J increases towards P: the paper's Fig. 5 from above."""
    top, K_J, K_R = scene.top, float(scene.constants.K_J), float(scene.constants.K_R)
    pole = pole_constants(top, K_R)[0]
    K = np.linspace(0, 1, FEW + 1) * pole
    found, here = tielines(top, K, K_R), tielines(top, [K_J, K_J + 0.1 * pole], K_R)
    middle = np.degrees((here.theta_inner + here.theta_outer) / 2)
    change = middle[1] - middle[0]
    truth = "no motion" if np.isnan(change) else "stays" if abs(change) < 0.5 else "down" if change < 0 else "up"
    numbers = {
        "K_J": K_J, "next": K_J + 0.1 * pole, "pole": pole, "middle": middle[0], "middle_next": middle[1],
        "inner": np.degrees(here.theta_inner[0]), "outer": np.degrees(here.theta_outer[0]), "K_R": K_R,
        "limit": limit_words(here.E[0]),
    }  # fmt: skip
    return Answer(truth, numbers, Picture("degrees", "K_J", (tied(found, "lift", COLOURS["normal"]), selected(scene))))


def jump(scene: Scene) -> Answer:
    """Where on the trajectory F_z first reaches 0 as the energy is raised."""
    top, constants = scene.top, scene.constants
    limit = tielines(top, [float(constants.K_J)], float(constants.K_R))
    E, inner, outer, verge = (float(x[0]) for x in (limit.E, limit.theta_inner, limit.theta_outer, limit.theta_verge))
    theta = np.linspace(*scene.turning, 121)[1:-1]
    curves = [Curve("motion", COLOURS["normal"], np.degrees(theta), normal_force(theta, top, constants))]
    if not np.isfinite(E):
        truth = "never"
    else:
        near = 1e-3 * (outer - inner)
        truth = "inner" if verge - inner < near else "outer" if outer - verge < near else "between"
        on = np.linspace(inner, outer, 121)[1:-1]
        F_z = normal_force(on, top, Constants(constants.K_J, constants.K_R, E))
        curves.append(Curve("limit", COLOURS["normal"], np.degrees(on), F_z, "dashed"))
    span = np.concatenate([curve.x for curve in curves])
    curves.append(level("zero", GREY, np.array([span.min(), span.max()]), 0.0, "solid"))
    numbers = {
        "E": E, "now": constants.E, "verge": np.degrees(verge), "inner": np.degrees(inner), "outer": np.degrees(outer),
        "least": scene.normal.min(), "most": scene.normal.max(),
    }  # fmt: skip
    told = "never" if truth == "never" else "told"
    return Answer(truth, numbers, Picture("degrees", "F_z", tuple(curves)), told=told)


def slip(scene: Scene) -> Answer:
    """The share of Fig. 5's region that is lost to slipping, in percent: Fig. 6."""
    top, K_R, mu_s = scene.top, float(scene.constants.K_R), scene.mu_s
    lost = 100 * (1 - float(allowed_shares(top.a, top.I1, top.I3, K_R, mu_s)))
    K = np.linspace(0, 1, FEW + 1) * pole_constants(top, K_R)[0]
    lift, slips = tielines(top, K, K_R), tielines(top, K, K_R, mu_s)
    numbers = {
        "lost": lost, "left": 100 - lost, "mu_s": mu_s, "ratio": scene.ratio.max(), "K_J": scene.constants.K_J,
        "E": scene.constants.E, "slips": limit_words(scene.marks.slip), "jumps": limit_words(scene.marks.lift),
    }  # fmt: skip
    curves = (tied(lift, "lift", COLOURS["normal"]), tied(slips, "slip", INK), selected(scene))
    return Answer(lost, numbers, Picture("degrees", "K_J", curves))
