"""The lesson as data: ten steps, each a question, a motion to set up, and the answer that the computation gives.

Nothing here is a stored key: answer(scene) works it out from the scene's own top and motion. The words are in
app/text, under the steps' names.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple, TypeAlias

import numpy as np

from app.model.bodies import body, second_part
from app.model.colours import COLOURS, GREY
from app.model.runs import look
from app.model.scene import Scene, solve
from app.text import say
from tippe_core import (
    UPRIGHT,
    Constants,
    Ending,
    Shape,
    SmoothedCoulomb,
    State,
    Tielines,
    Top,
    Trajectory,
    allowed_shares,
    ending,
    f,
    f1_squared,
    f3_squared,
    normal_force,
    omega3,
    pole_constants,
    slide,
    sunk,
    thresholds,
    tielines,
    turning_points,
)
from tippe_core.types import Array, Number, Rim

K_R = 10.0  # the paper's, for Figs. 5 and 6
# At K_R = 10 the paper's toy comes back from its stem, at this it stays there: tests/test_lesson.py.
K_R_THROWN = 13.0
TILT = 0.1  # rad: nobody lets a top go exactly upright
FRICTION = SmoothedCoulomb(0.3, 1.0)
# (R/g)^1/2: a run is made again, longer, until its end is reached; STEP and MOST, of its instants, draw the top between
WHILES, STEP, MOST = (260.0, 1200.0), 0.05, 8000
HAND = 1e-3  # rad: who lets a top go cannot say its tilt better; where that decides the end, nobody can foretell it
CURVE = 750  # points of a curve
FEW = 24

Numbers: TypeAlias = dict[str, Number]  # by their names in the words, some of which stand there as words
Inputs: TypeAlias = dict[str, Number]  # of the Explorer
Guessed: TypeAlias = Number  # an option or a number, as the step asks


class Curve(NamedTuple):
    """x, y (n,)."""

    key: str
    colour: str
    x: Array
    y: Array
    dash: str = "solid"


class Point(NamedTuple):
    """A place on the graph."""

    key: str
    x: float
    y: float


@dataclass(frozen=True, eq=False)
class Picture:
    """A graph beside a step; x, y are the symbols on its axes, the curves' and points' keys name their words."""

    x: str
    y: str
    curves: tuple[Curve, ...]
    points: tuple[Point, ...] = ()


@dataclass(frozen=True, eq=False)
class Answer:
    """truth: what the computation says, an option or a number; numbers: for the words of the explanation.

    motion: a Trajectory to show in 3-D in place of the scene's own, stem: whether it is of the body with its stem;
    told: which of the step's explanations says it. doubt: why truth is not certain, or "": "early" the computation
    came to where it cannot go on, "cut" the motion still changes at its end, "scatters" a start HAND beside it ends
    elsewhere, "differs" a run ends otherwise than the formula says.
    """

    truth: str | float
    numbers: Numbers
    picture: Picture
    motion: Trajectory | None = None
    told: str = "explain"
    stem: bool = False
    doubt: str = ""


@dataclass(frozen=True)
class Choice:
    """A prediction that is one of a few."""

    options: tuple[str, ...]

    def verdict(self, guess: Guessed, truth: Guessed) -> str:
        return "right" if guess == truth else "off"


@dataclass(frozen=True)
class Guess:
    """A prediction on a slider. near: how far a good one may be off, a share of the truth and at least so much."""

    low: float
    high: float
    step: float
    unit: str
    share: float
    least: float

    def verdict(self, guess: Guessed, truth: Guessed) -> str:
        if np.isnan(truth):
            return "never"
        near = max(self.least, self.share * abs(truth))
        return "right" if abs(guess - truth) <= near else "near" if abs(guess - truth) <= 3 * near else "off"


@dataclass(frozen=True)
class Step:
    """A step: the prediction asked for, the Explorer's inputs for a top, and the answer of a scene.

    tex: the paper's equations, and their numbers; sources: names in sources.toml. slides: whether the answer is read
    from runs with friction, which may take long; its question then has the numbers of start() alone.
    """

    name: str
    asks: Callable[[Scene], Choice | Guess]
    inputs: Callable[[Top], Inputs]
    answer: Callable[[Scene], Answer]
    tex: tuple[str, ...]
    sources: tuple[str, ...]
    slides: bool = False

    def question(self, scene: Scene) -> Numbers:
        """The numbers in the words of its question."""
        return start(scene) if self.slides else self.answer(scene).numbers


def at(K_J_share: float, energy: float, mu_s: float = 0.5) -> Callable[[Top], Inputs]:
    """Inputs for a motion of K_R = 10 at this share of K_J(P) and of the energy's marks."""

    def inputs(top: Top) -> Inputs:
        K_J = K_J_share * pole_constants(top, K_R)[0]
        return {"K_J": K_J, "K_R": K_R, "energy": energy, "mu_s": mu_s, "given": "share"}

    return inputs


def thrown(K_R: float = K_R) -> Callable[[Top], Inputs]:
    """Inputs for a top spun to this K_R and let go, tilted a little."""

    def inputs(top: Top) -> Inputs:
        state = {"theta": TILT, "theta_dot": 0.0, "omega2": 0.0, "phi": 0.0, "psi": 0.0, "given": "state"}
        return state | {"omega3": float(omega3(TILT, top, Constants(0.0, K_R, 0.0)))}

    return inputs


def choice(*options: str) -> Callable[[Scene], Choice]:
    return lambda scene: Choice(options)


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


def limit_words(E: float) -> str:
    """An energy that limits a motion: a number, or that there is none, or that it lies below the least."""
    return say(f"learn.limits.{'energy' if np.isfinite(E) else 'always' if np.isnan(E) else 'never'}", E=E)


def revolutions(scene: Scene, spin: float) -> float:
    """rev/s of the real top."""
    return spin * scene.scales.angular_velocity / (2 * np.pi)


def level(key: str, colour: str, x: Array, y: float, dash: str = "dashed") -> Curve:
    return Curve(key, colour, np.array([x[0], x[-1]]), np.array([y, y]), dash)


def start(scene: Scene) -> Numbers:
    """How the top is let go, near upright."""
    return {"spin": revolutions(scene, scene.upright_spin), "tilt": np.degrees(TILT)}


def curve(key: str, colour: str, motion: Trajectory, values: Array) -> Curve:
    """Of a Trajectory over its time."""
    every = slice(None, None, max(1, len(motion.t) // CURVE))
    return Curve(key, colour, motion.t[every], values[every])


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


def jellett(scene: Scene) -> Answer:
    """dL_z/dL_3 along the motion, by the straight line through its own L_3 and L_z."""
    motion, top = scene.nutation, scene.top
    L_3, L_z = motion.L_3, motion.L_z
    spread = L_3 - L_3.mean()
    steady = np.abs(spread).max() < 1e-7 * (1 + np.abs(L_3).max())
    slope = top.a if steady else float(spread @ (L_z - L_z.mean()) / (spread @ spread))
    numbers = {
        "slope": slope, "a": top.a, "L_3_low": L_3.min(), "L_3_high": L_3.max(), "L_z_low": L_z.min(),
        "L_z_high": L_z.max(), "K_J": scene.constants.K_J, "C_J": top.I1 * scene.constants.K_J,
        "drift": np.ptp(motion.jellett) / top.I1,
    }  # fmt: skip
    picture = Picture("L_3", "L_z", (Curve("motion", COLOURS["jellett"], L_3, L_z),))
    return Answer(slope, numbers, picture)


def lifting(scene: Scene) -> float:
    """What lifting G from upright to inverted costs, in percent of the spin's kinetic energy."""
    return 100 * 2 * scene.top.a / (scene.top.I3 * scene.upright_spin**2 / 2)


def energy(scene: Scene) -> Answer:
    top, spin, motion = scene.top, scene.upright_spin, scene.nutation
    share = lifting(scene)
    ledger, half = motion.ledger, len(motion.t) // 2
    numbers = {
        "share": share, "lift": 2 * top.a, "spin": revolutions(scene, spin), "kinetic": top.I3 * spin**2 / 2,
        "E": scene.constants.E, "drift": np.ptp(motion.energy), "kinetic_inner": ledger.kinetic[0],
        "height_inner": ledger.height[0], "kinetic_outer": ledger.kinetic[half], "height_outer": ledger.height[half],
    }  # fmt: skip
    names = {"spin": "omega", "precession": "momentum", "nutation": "theta", "translation": "friction"}
    curves = [Curve(name, COLOURS[colour], motion.t, getattr(ledger, name)) for name, colour in names.items()]
    curves += [Curve("height", COLOURS["normal"], motion.t, ledger.height),
               Curve("sum", COLOURS["energy"], motion.t, motion.energy)]  # fmt: skip
    return Answer(share, numbers, Picture("t", "energy", tuple(curves)))


def taken(scene: Scene) -> float:
    """What Routh's constant would take of the spin's kinetic energy on the way from upright to inverted, in percent."""
    return 100 * (1 - f3_squared(0.0, scene.top) / f3_squared(np.pi, scene.top))


def routh(scene: Scene) -> Answer:
    top, constants = scene.top, scene.constants
    theta = np.linspace(0, np.pi, 181)
    spin = omega3(theta, top, constants)
    share = taken(scene)
    motion = scene.trajectory
    numbers = {
        "share": share, "K_R": constants.K_R, "upright": spin[0], "inverted": spin[-1], "drift": np.ptp(scene.K_R),
        "inner": motion.omega[:, 2].min(), "outer": motion.omega[:, 2].max(),
        "needed": 100 * 2 * top.a / (top.I3 * spin[0] ** 2 / 2),
    }  # fmt: skip
    here = np.linspace(*scene.turning, 60)
    curves = (
        Curve("would", COLOURS["omega"], np.degrees(theta), spin, "dashed"),
        Curve("motion", COLOURS["theta"], np.degrees(here), omega3(here, top, constants)),
    )
    return Answer(share, numbers, Picture("degrees", "omega_3", curves))


def turning(scene: Scene) -> Answer:
    """Where the motion turns back, in degrees."""
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
    """Where the range of tilt goes as K_J grows towards P: the paper's Fig. 5 from above."""
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


def tied(found: Tielines, key: str, colour: str) -> Curve:
    """Tielines as one curve with gaps."""
    gap = np.full(len(found.K_J), np.nan)
    theta = np.column_stack([found.theta_inner, found.theta_outer, gap]).ravel()
    return Curve(key, colour, np.degrees(theta), np.column_stack([found.K_J, found.K_J, gap]).ravel())


def selected(scene: Scene) -> Curve:
    K_J = scene.constants.K_J
    return Curve("motion", COLOURS["theta"], np.degrees(scene.turning), np.array([K_J, K_J]))


def jump(scene: Scene) -> Answer:
    """Where on the trajectory F_z first reaches 0 as the energy is raised."""
    top, constants = scene.top, scene.constants
    limit = tielines(top, [float(constants.K_J)], float(constants.K_R))
    E, inner, outer, verge = (float(x[0]) for x in (limit.E, limit.theta_inner, limit.theta_outer, limit.theta_verge))
    theta = np.linspace(*scene.turning, 121)[1:-1]
    curves = [Curve("motion", COLOURS["theta"], np.degrees(theta), normal_force(theta, top, constants))]
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
    told = "never" if truth == "never" else "explain"
    return Answer(truth, numbers, Picture("degrees", "F_z", tuple(curves)), told=told)


def slip(scene: Scene) -> Answer:
    """The share of Fig. 5's region that friction takes away, in percent: Fig. 6."""
    top, K_R, mu_s = scene.top, float(scene.constants.K_R), scene.mu_s
    lost = 100 * (1 - float(allowed_shares(top.a, top.I1, top.I3, K_R, mu_s)))
    K = np.linspace(0, 1, FEW + 1) * pole_constants(top, K_R)[0]
    lift, slips = tielines(top, K, K_R), tielines(top, K, K_R, mu_s)
    numbers = {
        "lost": lost, "left": 100 - lost, "mu_s": mu_s, "ratio": scene.ratio.max(), "K_J": scene.constants.K_J,
        "E": scene.constants.E, "slips": limit_words(scene.marks.slip), "jumps": limit_words(scene.marks.lift),
    }  # fmt: skip
    curves = (tied(lift, "lift", "#e3b394"), tied(slips, "slip", COLOURS["friction"]), selected(scene))
    return Answer(lost, numbers, Picture("degrees", "K_J", curves))


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


# ---- the steps ----


def of_torque(scene: Scene) -> Guess:
    reach = max(1.0, np.ceil(1.5 * abs(scene.top.a)))
    return Guess(-reach if scene.top.a < 0 else 0.0, reach, 0.01, "", 0.15, 0.02)


def decade(least: float, number: float) -> float:
    """The first of least, 10 least, 100 least, ... that this number fits in."""
    return float(least * 10 ** max(0, np.ceil(np.log10(abs(number) / least)))) if number else float(least)


def of_percent(share: Callable[[Scene], float]) -> Callable[[Scene], Guess]:
    """Asks for a share that share(scene) gives; the slider's ends are decades, which do not tell it."""

    def asks(scene: Scene) -> Guess:
        found = share(scene)
        low = 0.0 if scene.top.a >= 0 and found >= 0 else -decade(100, min(found, 0.0))
        return Guess(low, decade(100, max(found, 0.0)), 0.5, "%", 0.25, 2.0)

    return asks


def of_spin(scene: Scene) -> Guess:
    """rev/s."""
    least = needed_spin(scene.top)
    return Guess(0.0, decade(60, revolutions(scene, least) if np.isfinite(least) else 0.0), 0.1, "rev/s", 0.2, 0.5)


STEPS = (
    Step("free", choice("over", "between", "upright"), thrown(K_R_THROWN), free,
         (r"\vec r=R\hat z-a\hat 3\quad(3)\qquad "
          r"\vec v=\vec\omega\times\vec r\quad(4)",), ("gray", "perry", "bohr"), slides=True),
    Step("jellett", of_torque, at(0.8, 0.9), jellett,
         (r"\frac{\tau_z}{\tau_3}=\frac{F_x\,a\sin\theta}{F_x\,R\sin\theta}=\frac aR",
          r"L_z-\frac aR\,L_3=J\quad(13)",
          r"\sin\theta\,\omega_{2'}+\frac{I_3}{I_1}(\cos\theta-a)\,\omega_3=K_J\quad(30)"),
         ("jellett", "routh", "obrien", "leutwyler")),
    Step("energy", of_percent(lifting), at(0.8, 0.9), energy,
         (r"\begin{aligned}E={}&\tfrac12 I_1(\omega_{1'}^2+\omega_{2'}^2)+\tfrac12 I_3\omega_3^2\\"
          r"&+\tfrac12Mv^2+Mga(1-\cos\theta)\quad(6)\end{aligned}",), ("gray", "pliskin")),
    Step("routh", of_percent(taken), at(0.8, 0.9), routh,
         (r"f_3\,\omega_3=K_R\quad(31)",
          r"f_3^2=I_3+\sin^2\theta+\frac{I_3}{I_1}(\cos\theta-a)^2\quad(32)"), ("routh", "isaeva")),
    Step("turning", lambda scene: Guess(0.0, 180.0, 0.5, "°", 0.0, 3.0), at(0.6, 0.95), turning,
         (r"\begin{aligned}f_1^2\,\dot\theta^2={}&2E'-2a(1-\cos\theta)\\&-\frac{f_2^2}{\sin^2\theta}\left[K_J-"
          r"\frac{I_3}{I_1}(\cos\theta-a)\frac{K_R}{f_3}\right]^2\quad(36)\end{aligned}",), ("gray", "arnold")),
    Step("ties", choice("down", "stays", "up"), at(0.6, 1.9), ties,
         (r"f(\theta_m)=0\qquad f(\theta_p)=f'(\theta_p)=0",), ("gray",)),
    Step("jump", choice("inner", "between", "outer", "never"), at(0.6, 1.98), jump,
         (r"F_z=1+a\left(\tfrac12\sin\theta\,f'+\cos\theta\,f\right)\quad(37)",), ("gray",)),
    Step("slip", lambda scene: Guess(0.0, 100.0, 0.5, "%", 0.25, 2.0), at(0.6, 0.98), slip,
         (r"F_x=-\frac{I_3K_R\,f^{1/2}}{f_3^3}\left(\cos\theta-\frac{I_3}{I_1}(\cos\theta-a)\right)\quad(38)",
          r"\left(F_x^2+F_y^2\right)^{1/2}\le\mu_sF_z"), ("gray", "kane")),
    Step("proof", choice("agree", "size", "opposite"), thrown(), proof,
         (r"\omega_3(\pi)=-\frac{I_1}{I_3}\frac{K_J}{1+a}\quad(30)\qquad "
          r"\omega_3(\pi)=\frac{K_R}{f_3(\pi)}\quad(31)",), ("gray", "routh", "jellett"), slides=True),
    Step("flip", of_spin, thrown(), flip,
         (r"\vec v\ne\vec\omega\times\vec r",
          r"\omega^2>\frac{Mga\,(1-\alpha)^2}{I_1-I_3(1-\alpha)}\,,\qquad 1-\alpha<\frac{I_1}{I_3}<1+\alpha\,,"
          r"\qquad\alpha=\frac aR"), ("gallop", "leutwyler", "rauch"), slides=True),
)  # fmt: skip
NAMES = tuple(step.name for step in STEPS)


def planned(step: Step, scene: Scene, shape: Shape | None) -> Scene:
    """The Scene that a step's inputs give this scene's top; shape: the Explorer's."""
    inputs = step.inputs(scene.top)
    state = {name: inputs[name] for name in ("theta", "theta_dot", "omega2", "omega3") if name in inputs}
    share = inputs.get("energy", 0.0)
    return solve(scene.top, inputs.get("K_J", 0.0), K_R, inputs.get("mu_s", scene.mu_s), share, shape=shape,
                 state=State(**state) if state else None)  # fmt: skip


def judged(step: Step, scene: Scene, guess: Guessed | None) -> tuple[str | None, Answer]:
    """(verdict, Answer): "right", "near", "off", "never" where there is no such number, or "open" where the
    answer is not certain; by this scene alone.

    (None, Answer) where there is no guess.
    """
    answer = step.answer(scene)
    if guess is None:
        return None, answer
    return "open" if answer.doubt else step.asks(scene).verdict(guess, answer.truth), answer
