"""The runs that the lesson shows, each computed by tippe_core for a top released by a hand.

One toy, that of the Lab on arrival, on its three tables; the same toy with a point contact, and with a small contact
patch; the paper's top as a whole ball, rolling, and upside down with either of two spins; and the page's own top.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from app.model.arrival import MU, SPIN, TILT, TOY
from app.model.frames import in_space
from app.model.lesson.parts import K_R
from app.model.lesson.parts import TILT as THROWN_TILT
from app.model.life import Lived, thinned
from app.model.regimes import OF_CORE
from app.model.run import TableMotion, motion_on, on, watched
from app.model.scene import Scene
from app.model.setup import TOYS, Setup, start_of
from tippe_core import Constants, SmoothedCoulomb, State, Trajectory, omega3, roll, slide
from tippe_core.types import Array, Indices

SMALL_PATCH = 0.1  # mm: of a hard toy
HEAD_SECONDS = 1.2  # s for which an inverted top is shown
A_NUTATION = 96  # frames
LAW = SmoothedCoulomb(0.3, 1.0)


@lru_cache(4)
def of_contact(law: str) -> TableMotion:
    """The toy and start of the arrival on the ordinary table, touching it at a point, with Coulomb's law, or in a small
    patch."""
    start = replace(start_of(TOY, SPIN, TILT, MU), law=law, patch=SMALL_PATCH)
    return on(start, "ordinary")


def on_table(table: str) -> TableMotion:
    """The toy and start of the arrival on a table."""
    return motion_on(table, start_of(TOY, SPIN, TILT, MU))


def own(scene: Scene) -> TableMotion:
    """The page's own top, released like the toy of the arrival; raises TopError if that is not possible."""
    start = Setup(top=scene.top, scales=scene.scales, shape=scene.shape, spin=SPIN, tilt=TILT, mu=MU, mu_s=MU)
    return on(start, "ordinary")


# ---- the proof: the paper's top, a whole ball ----


@dataclass(frozen=True, eq=False, kw_only=True)
class Proof:
    """A rolling top near upright, and the inverted spins that its constants require, in rev/s about its own axis.

    start: its Constants; spin: its spin at the start.
    """

    start: Constants
    spin: float
    jellett: float
    routh: float
    setup: Setup

    def at(self, theta: Array) -> Array:
        """The spin about its own axis that Routh's constant requires at these tilts, rev/s."""
        return self.setup.turns * omega3(theta, self.setup.top, self.start)


@lru_cache(1)
def proof() -> Proof:
    """The Proof for the paper's top with the paper's K_R."""
    preset = TOYS["The paper's tippe top"]
    top, turns = preset.top, preset.shape.scales.angular_velocity / (2 * np.pi)
    omega = float(omega3(THROWN_TILT, top, Constants(0.0, K_R, 0.0)))
    start = Constants.from_state(top, THROWN_TILT, 0.0, 0.0, omega)
    # (30) at theta = pi, where omega_2' does not contribute
    jellett = -top.I1 / top.I3 * float(start.K_J) / (1 + top.a)
    setup = Setup(top=top, scales=preset.shape.scales, shape=None, spin=turns * omega,
                  tilt=float(np.degrees(THROWN_TILT)), mu=MU, mu_s=MU, stem=False, seconds=HEAD_SECONDS)  # fmt: skip
    return Proof(start=start, spin=turns * omega, jellett=turns * jellett,
                 routh=turns * float(omega3(np.pi, top, start)), setup=setup)  # fmt: skip


@lru_cache(4)
def rolled(tilt: float, spin: float) -> TableMotion:
    """The top of the proof, rolling from this tilt (rad) with this spin about its own axis (rev/s), its axis at
    rest."""
    setup = proof().setup
    motion = roll(setup.top, None, setup.times, State(tilt, 0.0, 0.0, spin / setup.turns))
    return watched(setup, "rough", Lived(thinned(motion, setup.scales.time), setup.seconds, ""), whole=True)


def named(name: str) -> TableMotion:
    """The run to which a step refers by this name."""
    found = proof()
    if name in ("point", "patch"):
        return of_contact("coulomb" if name == "point" else "contact")
    if name == "rolls":
        return rolled(THROWN_TILT, found.spin)
    if name in ("by_jellett", "by_routh"):
        return rolled(np.pi, found.jellett if name == "by_jellett" else found.routh)
    return on_table(name)


def nutations(scene: Scene, count: float) -> tuple[tuple[Array | Indices, ...], Array]:
    """Some nutations of a Scene's motion: the arguments of top3d.pack_frames, and rows of curves as in a TableMotion,
    but only with the time, the tilt and the regime."""
    moved = scene.rolling(np.linspace(0.0, count * scene.rolling.period, int(count * A_NUTATION) + 1))
    codes = np.array([OF_CORE[regime] for regime in moved.regime])
    rows = np.zeros((len(moved.t), 8))
    rows[:, 0], rows[:, 1], rows[:, 7] = moved.t * scene.scales.time, np.degrees(moved.theta), codes
    return (moved.t, moved.quaternion, moved.contact, moved.com, moved.theta, *in_space(moved), codes), rows


@lru_cache(1)
def slipped() -> Trajectory:
    """The top of the proof with slipping: with an ordinary friction of 0.3 it turns over."""
    found = proof()
    state = State(THROWN_TILT, 0.0, 0.0, found.spin / found.setup.turns)
    return slide(found.setup.top, state, LAW, np.linspace(0.0, 400.0, 4001))


def on_ball(motion: TableMotion) -> int:
    """The number of instants of its trajectory at which only the ball carries it."""
    others = np.flatnonzero(motion.carried != "ball")
    return int(others[0]) if len(others) else len(motion.trajectory.t)
