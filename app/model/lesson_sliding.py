"""The lesson's answers about a top that slides: where it ends, and the spin that turns it over."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from app.model.bodies import body, second_part
from app.model.colours import COLOURS
from app.model.lesson_parts import (
    CURVE,
    K_R,
    TILT,
    Answer,
    Curve,
    Inputs,
    Picture,
    Point,
    curve,
    level,
    revolutions,
    start,
)
from app.model.runs import look
from app.model.scene import Scene
from app.text import say
from tippe_core import (
    UPRIGHT,
    Constants,
    Ending,
    Shape,
    SmoothedCoulomb,
    State,
    Top,
    Trajectory,
    ending,
    omega3,
    slide,
    sunk,
    thresholds,
    turning_points,
)
from tippe_core.types import Rim

# At K_R = 10 the paper's toy comes back from its stem, at this it stays there: tests/test_lesson.py.
K_R_THROWN = 13.0
FRICTION = SmoothedCoulomb(0.3, 1.0)
# (R/g)^1/2: a run is made again, longer, until its end is reached; STEP and MOST, of its instants, draw the top between
WHILES, STEP, MOST = (260.0, 1200.0), 0.05, 8000
HAND = 1e-3  # rad: who lets a top go cannot say its tilt better; where that decides the end, nobody can foretell it


def thrown(K_R: float = K_R) -> Callable[[Top], Inputs]:
    """Inputs for a top spun to this K_R and let go, tilted a little."""

    def inputs(top: Top) -> Inputs:
        state = {"theta": TILT, "theta_dot": 0.0, "omega2": 0.0, "phi": 0.0, "psi": 0.0, "given": "state"}
        return state | {"omega3": float(omega3(TILT, top, Constants(0.0, K_R, 0.0)))}

    return inputs


# ---- the answers ----


@lru_cache(maxsize=32)
def slid(top: Top, spin: float, edge: Rim | None = None, tilt: float = TILT) -> tuple[Trajectory, Ending]:
    """(Trajectory, Ending) of a top let go with this spin on a table that is not rough enough, followed to its end."""
    rtol = 1e-8 if edge is None else 1e-6  # after an impact HAND counts for more, and both contacts take long
    for long in WHILES:
        times = np.linspace(0.0, long, int(min(long / STEP, MOST)) + 1)
        motion = slide(top, State(tilt, 0.0, 0.0, spin), FRICTION, times, rtol=rtol, landing="plastic", edge=edge,
                       progress=look)  # fmt: skip
        found = ending(motion)
        if not unsettled(found):
            break
    return motion, found


def unsettled(found: Ending) -> bool:
    """Whether an Ending still changes: not where the shape holds the tilt, on ball and stem both, nor where all that is
    left is to lose the spin, on the stem alone and upside down."""
    leans, stands = found.end == "leaning" and found.on == "both", found.on == "stem" and found.least > np.pi - UPRIGHT
    return found.cut and not (leans or stands)


def where(found: Ending) -> str:
    """An Ending as one of the options of step 1."""
    middle = (found.least + found.most) / 2
    if found.flat or found.end in ("stem", "inverted"):
        return "over"
    return "upright" if found.end == "upright" or (found.end == "rolling" and middle < UPRIGHT) else "between"


def doubt(top: Top, spin: float, edge: Rim | None, found: Ending, shape: Shape | None = None) -> str:
    """Why it is not certain where this run ends, see Answer. shape: the body, of which slide() knows ball and edge."""
    moved = slid(top, spin, edge)[0]
    if (found.ended and not found.flat) or (edge and shape and sunk(moved, body(shape)) < len(moved.t)):
        return "early"
    if unsettled(found):
        return "cut"
    if len(found.stretches) == 1:  # no impact, nothing that scatters
        return ""
    beside = slid(top, spin, edge, TILT + HAND)[1]
    return "scatters" if where(beside) != where(found) or unsettled(beside) else ""


def stem_of(scene: Scene) -> Rim | None:
    """The edge of the stem's end, None where the body has none or is not known."""
    return scene.shape.edge if scene.shape else None


def only_ball(scene: Scene) -> Rim | None:
    """The edge for what is told of a single contact: none where a > 0, the paper's Fig. 2. An ordinary top has its own,
    for its ball alone would fall through the table's plane."""
    return stem_of(scene) if scene.top.a < 0 else None


def free(scene: Scene) -> Answer:
    top, spin, edge = scene.top, scene.upright_spin, stem_of(scene)
    motion, found = slid(top, spin, edge)
    inner, outer = np.degrees(turning_points(top, Constants.from_state(top, TILT, 0.0, 0.0, spin))[0])
    numbers = start(scene) | {
        "end": np.degrees(motion.theta[-1]), "most": np.degrees(motion.theta.max()), "mu": FRICTION.mu,
        "seconds": motion.t[-1] * scene.scales.time, "inner": inner, "outer": outer,
        "spin_end": revolutions(scene, motion.omega[-1, 2]),
        "on": say(f"learn.on.{on_what(found, edge)}", part=part(scene.shape)),
    }  # fmt: skip
    curves = (
        curve("slides", COLOURS["friction"], motion, np.degrees(motion.theta)),
        level("rolls", COLOURS["theta"], motion.t, inner),
        level("rolls", COLOURS["theta"], motion.t, outer),
    )
    return Answer(where(found), numbers, Picture("t", "degrees", curves), motion, stem=edge is not None,
                  doubt=doubt(top, spin, edge, found, scene.shape))  # fmt: skip


def part(shape: Shape | None) -> str:
    """What touches beside the ball, in words."""
    return say(f"learn.parts.{second_part(shape)}")


def on_what(found: Ending, edge: Rim | None) -> str:
    """The key of the words on what it ends; a whole sphere has nothing else."""
    if edge is None:
        return "sphere" if found.on == "ball" else "change"
    return "flat" if found.flat else found.on or "change"


def proof(scene: Scene) -> Answer:
    """What Jellett's and Routh's constants, both of a start near upright, say of the spin at theta = pi."""
    top, spin = scene.top, scene.upright_spin
    start = Constants.from_state(top, TILT, 0.0, 0.0, spin)
    by_routh = float(omega3(np.pi, top, start))
    by_jellett = -top.I1 / top.I3 * float(start.K_J) / (1 + top.a) if top.a != -1 else np.nan
    same = abs(by_routh - by_jellett) < 1e-9 * abs(spin)
    truth = "agree" if same else "opposite" if by_routh * by_jellett < 0 else "size"
    motion, found = slid(top, spin, only_ball(scene))
    numbers = {
        "jellett": revolutions(scene, by_jellett), "routh": revolutions(scene, by_routh),
        "spin": revolutions(scene, spin), "K_J": start.K_J, "K_R": start.K_R,
        "toy": revolutions(scene, motion.omega[-1, 2]), "end": np.degrees(motion.theta[-1]),
        "still": say(f"learn.still.{'changes' if unsettled(found) or (found.ended and not found.flat) else 'ends'}"),
    }  # fmt: skip
    theta, every = np.linspace(0, np.pi, 121), slice(None, None, max(1, len(motion.t) // CURVE))
    curves = (
        Curve("by_routh", COLOURS["omega"], np.degrees(theta), omega3(theta, top, start)),
        Curve("slides", COLOURS["friction"], np.degrees(motion.theta)[every], motion.omega[every, 2]),
    )
    points = (Point("jellett_at_pi", 180.0, by_jellett),) if np.isfinite(by_jellett) else ()
    told = "explain" if truth == "opposite" else "size" if points else "nan"
    return Answer(truth, numbers, Picture("degrees", "omega_3", curves, points), told=told)


def needed_spin(top: Top) -> float:
    """The least spin, in (g/R)^1/2, from which a top let go near upright turns over: nan where none does."""
    limits = thresholds(top)
    if top.a <= 0 or limits.group != "can invert" or limits.upright.stable not in ("below", "never"):
        return np.nan
    falls = limits.upright.spin if limits.upright.stable == "below" else 0.0
    stays = limits.launch if limits.inverted.stable == "above" else 0.0
    return max(falls, stays)


def flip(scene: Scene) -> Answer:
    """The spin that turns it over once it may slip, in rev/s."""
    top = scene.top
    least, spin = needed_spin(top), scene.upright_spin
    edge = only_ball(scene)
    runs = [slid(top, share * least, edge) for share in (0.8, 2.0)] if np.isfinite(least) else [slid(top, spin, edge)]
    tried, found = zip(*runs, strict=True)
    motion = tried[-1]
    early, cut = any(each.ended for each in found), any(unsettled(each) for each in found)
    as_said = [where(each) == "over" for each in found] == ([False, True] if np.isfinite(least) else [False])
    half = np.argmax(motion.theta > np.pi / 2)
    numbers = {
        "least": revolutions(scene, least), "rad": least * scene.scales.angular_velocity,
        "gamma": top.I1 / top.I3, "low": 1 - top.a, "high": 1 + top.a,
        "E_start": motion.energy[0], "E_end": motion.energy[-1], "heat": motion.heat[-1],
        "jellett_drift": np.ptp(motion.jellett), "routh_start": motion.routh[0], "routh_end": motion.routh[-1],
        "fast_end": np.degrees(motion.theta[-1]), "slow_end": np.degrees(tried[0].theta[-1]),
        "half": motion.t[half] * scene.scales.time,
    }  # fmt: skip
    keys = ("slower", "faster") if len(tried) == 2 else ("slides",)
    colours = (COLOURS["theta"], COLOURS["friction"])
    curves = tuple(
        curve(key, colour, run, np.degrees(run.theta)) for key, colour, run in zip(keys, colours, tried, strict=False)
    )
    told = "explain" if np.isfinite(least) else "nan"
    touched = any(stretch.on in ("stem", "both") for each in found for stretch in each.stretches)
    numbers["but"] = say("learn.second_contact", part=part(scene.shape)) if touched else ""
    return Answer(revolutions(scene, least), numbers, Picture("t", "degrees", curves), motion, told, edge is not None,
                  "early" if early else "cut" if cut else "" if as_said else "differs")  # fmt: skip
