"""The seven steps of the lesson, the last one of the page's own top: what each asks, and the answer that its run gives.

No answers are stored: they are computed from the run that is shown.
"""

import numpy as np

from app.model.colours import COLOURS
from app.model.events import first_times
from app.model.lesson.parts import Answer, Choice, Curve, Picture, Point, Step
from app.model.lesson.runs import on_ball, on_table, own, proof, slipped
from app.model.run import TableMotion
from app.model.scene import Scene
from tippe_core.types import Array

UNSURE = "unsure"
SPINS = 0.5  # rev/s: a smaller spin counts as none
LIKE = 0.5  # two losses are alike if the smaller is at least this share of the larger
MORE = 1.02  # a sum of energies that grew by more would be wrong


def at(motion: TableMotion, t: float) -> Array:
    """The row of the curves at a time in s."""
    rows = motion.curves
    return rows[min(int(np.searchsorted(rows[:, 0], t)), len(rows) - 1)]


def flips(scene: Scene) -> Answer:
    """What the toy does; its fall, later than the step shows, is told."""
    motion = on_table("ordinary")
    when = first_times(motion)
    truth = "over" if {"over", "stands-on-stem"} <= when.keys() else "falls" if "falls" in when else "upright"
    codes = {"over": "over", "stands": "stands-on-stem", "falls": "falls"}
    return Answer(truth, {name: when.get(code, np.nan) for name, code in codes.items()})


def way(scene: Scene) -> Answer:
    """Which way it spins about its own axis when it stands on its stem, and which way it goes round."""
    motion, step = on_table("ordinary"), BY_NAME["way"]
    first, last = motion.curves[0], at(motion, step.end)
    stopped, same = abs(last[5]) < SPINS, first[5] * last[5] > 0
    still = motion.curves[int(np.argmax(motion.curves[:, 5] <= 0.0))]
    numbers = {"own": first[5], "own_end": last[5], "above": first[6], "above_end": last[6], "zero": still[0],
               "zero_tilt": still[1]}  # fmt: skip
    return Answer("stopped" if stopped else "same" if same else "other", numbers)


def height(scene: Scene) -> Answer:
    """Where the energy for the height of G comes from, expressed as the height to which it could lift the top."""
    motion, step = on_table("ordinary"), BY_NAME["height"]
    first, last = motion.curves[0], at(motion, step.end)
    spin = (first[3] - first[2]) - (last[3] - last[2])
    gained, heat = last[2] - first[2], last[4] - first[4]
    paid = gained > 0 and spin > 0 and gained + heat <= MORE * spin
    numbers = {"low": first[2], "high": last[2], "spin_start": first[3] - first[2], "spin_end": last[3] - last[2],
               "spin": spin, "height": gained, "heat": heat}  # fmt: skip
    return Answer("spin" if paid else "push", numbers)


def tables(scene: Scene) -> Answer:
    """Whether it still turns over on the rough table or on ice."""
    found = {table: on_table(table) for table in ("rough", "ice")}
    turned = [table for table, motion in found.items() if "over" in first_times(motion)]
    numbers = {f"{table}_{name}": float(getattr(motion.tilt, name)()) for table, motion in found.items()
               for name in ("min", "max")}  # fmt: skip
    return Answer("both" if len(turned) == 2 else turned[0] if turned else "neither", numbers)


def arms(scene: Scene) -> Answer:
    """How much friction takes from L_3 and from L_z, while only the ball touches."""
    motion = on_table("ordinary")
    moved, n = motion.trajectory, on_ball(motion)
    a = motion.start.top.a
    t, L_3, L_z = motion.seconds[:n], moved.L_3[:n], moved.L_z[:n]
    own_axis, upright = L_3[0] - L_3[-1], L_z[0] - L_z[-1]
    kept = L_z - a * L_3
    smaller, larger = sorted((own_axis, upright))
    truth = "alike" if smaller > LIKE * larger else "own" if own_axis > upright else "above"
    numbers = {"a": a, "one_to": 1 / a, "share": 100 * upright / own_axis, "ideal": 100 * a,
               "drift": 100 * np.ptp(kept) / abs(kept[0]), "until": t[-1]}  # fmt: skip
    whole = 100 / L_3[0]
    thin = slice(None, None, 2)
    curves = tuple(Curve(key, COLOURS[colour], t[thin], (whole * values)[thin], dash) for key, colour, values, dash in (
        ("L_3", "omega", L_3, "solid"), ("L_z", "ink", L_z, "dashed"), ("kept", "jellett", kept, "solid")
    ))  # fmt: skip
    return Answer(truth, numbers, Picture("t", "share", curves))


def contradiction(scene: Scene) -> Answer:
    """The spins at theta = pi that Jellett's and Routh's constants of a start near upright require."""
    found, run = proof(), slipped()
    product = found.jellett * found.routh
    alike = abs(found.jellett - found.routh) < 1e-9 * abs(found.spin)
    turns, end = found.setup.turns, np.degrees(run.theta[-1])
    numbers = {"jellett": found.jellett, "routh": found.routh, "spin": found.spin, "end": end,
               "slipped": turns * run.omega[-1, 2]}  # fmt: skip
    theta, every = np.linspace(0, np.pi, 91), slice(None, None, 8)
    curves = (
        Curve("by_routh", COLOURS["routh"], np.degrees(theta), found.at(theta), "dashed"),
        Curve("slips", COLOURS["omega"], np.degrees(run.theta)[every], turns * run.omega[every, 2]),
    )
    points = (Point("by_jellett", 180.0, found.jellett), Point("by_routh", 180.0, found.routh))
    truth = "agree" if alike else "opposite" if product < 0 else "size"
    return Answer(truth, numbers, Picture("degrees", "turns", curves, points))


def yours(scene: Scene) -> Answer:
    """Whether the page's own top turns over while it is watched."""
    motion = own(scene)
    over, seen = first_times(motion).get("over", np.nan), motion.seconds <= YOURS.end
    tilt, seconds = motion.tilt[seen], float(motion.seconds[seen][-1])
    numbers = {"over": over, "low": tilt.min(), "high": tilt.max(), "end": tilt[-1], "seconds": seconds}
    turned = bool(over <= YOURS.end)
    return Answer("over" if turned else "not", numbers, told="told_over" if turned else "told_not")


def choice(*options: str) -> Choice:
    return Choice((*options, UNSURE))


DOT = 0.6235  # s: its painted dot faces who looks
THREE = ("ordinary", "rough", "ice")
SIX = (
    Step("flips", choice("over", "upright", "falls"), flips, ("ordinary",), 0.25, 3.0, sources=("perry", "bohr")),
    Step("way", choice("same", "other", "stopped"), way, ("ordinary",), DOT, 2.3737, "spin", sources=("gray",)),
    Step("height", choice("push", "spin", "free"), height, ("ordinary",), DOT, 1.6, "energy", sources=("pliskin",)),
    Step("tables", choice("both", "rough", "ice", "neither"), tables, THREE, 0.25, 2.4, sources=("gallop",)),
    Step("arms", choice("own", "above", "alike"), arms, ("ordinary",), 0.745, 1.36, "arms",
         tex=(r"\frac{\tau_z}{\tau_3}=\frac{a\sin\theta}{R\sin\theta}=\frac aR",
              r"L_z-\frac aR\,L_3=J\quad(13)"), sources=("jellett", "leutwyler")),
    Step("proof", choice("agree", "size", "opposite"), contradiction, ("rolls", "by_jellett", "by_routh"), 0.3, 1.2,
         "heads", ("by_jellett", "by_routh"),
         tex=(r"\omega_3(\pi)=-\frac{I_1}{I_3}\frac{K_J}{1+a}\quad(30)\qquad "
              r"\omega_3(\pi)=\frac{K_R}{f_3(\pi)}\quad(31)",), sources=("gray", "routh")),
)  # fmt: skip
YOURS = Step("yours", choice("over", "not"), yours, ("yours",), 0.25, 5.9)
BY_NAME = {step.name: step for step in (*SIX, YOURS)}
