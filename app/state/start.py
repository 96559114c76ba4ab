"""One top and one start for all views of the Lab: the one that is left hands them to the one that is gone to.

The toy that flips is let go by a hand, with a spin and a tilt, and G at rest. What rolls is given by its constants; of
a hand's start it is what the rough table makes of it. The three planes take either. A start that nobody has changed
comes back as it went.
"""

from dataclasses import dataclass

import numpy as np
import param

from app.model.lab_rolling import rolling
from app.model.lab_run import TOYS, Toy
from tippe_core import BareSphere

TOY, ROLLING, PLANES = "lab", "roll", "three-planes"
PLANE = {"ordinary": "sliding", "rough": "rough", "ice": "smooth", "three": "compare"}
"""{table of the Lab: what the three planes call it}."""
TABLE = {plane: table for table, plane in PLANE.items()}
LAW = "contact"


@dataclass(frozen=True, kw_only=True)
class Start:
    """A toy, spin (rev/s), tilt (degrees) and friction. by_hand: G is at rest; else it rolls, as the Explorer has it,
    and these are what that begins with."""

    toy: Toy
    spin: float
    tilt: float
    mu: float
    by_hand: bool


class OneStart(param.Parameterized):
    """lab: a Lab; explorer: an Explorer, and ask what takes its inputs; builder: a Builder."""

    plane = param.Selector(default=PLANE["ordinary"], objects=list(TABLE), doc="what is looked at of the Planes")

    def __init__(self, lab, explorer, ask, builder):
        super().__init__()
        self._lab, self._explorer, self._ask, self._builder = lab, explorer, ask, builder
        self._planes, self._waits = None, None
        self._gripped, self._asked = None, {}  # a hand's start, and the rolling that it became

    def moved(self, left, room):
        """A room of the page was left for another, by their names in an address."""
        if left == room or not {left, room} <= {TOY, ROLLING, PLANES}:
            return
        start = self._left(left)
        if room == TOY:
            self._let_go(start, "rough" if left == ROLLING else TABLE[self._planes.plane])
            return
        if start.by_hand and not self._rolls(start):
            self._gripped, self._asked = start, rolling(start.toy, start.spin, start.tilt, start.mu)
            self._ask(**self._asked)
        if room == PLANES:
            self._waits = start, PLANE[self._lab.table] if left == TOY else None
            self._set_planes()

    def have(self, planes):
        """The Planes are there now; gone to by a switch of the page they have the friction of a real contact."""
        if self._waits:
            planes.law = LAW
        self._planes, self.plane = planes, planes.plane
        planes.param.watch(lambda event: setattr(self, "plane", event.new), "plane")
        self._set_planes()

    def table(self, name):
        """The room that shows this table at the level of research."""
        if name != "rough":
            self._waits = self._waits or (None, None)
            self._waits = self._waits[0], PLANE[name]
            self._set_planes()
        return ROLLING if name == "rough" else PLANES

    def spin(self):
        """The body on the bench into the Lab, to be let go on the ordinary table."""
        self._lab.ask(toy=self._toy, table="ordinary")
        self._lab.rest()

    def lab_runs(self):
        """(table, its motion, what it began with) of the tables that the Lab shows."""
        scene = self._lab.scene
        return [(table, motion, motion.start) for table, motion in scene.motions.items() if motion] if scene else []

    def planes_runs(self):
        """As lab_runs(), of the planes that are looked at."""
        picture = self._planes.picture if self._planes else None
        if picture is None:
            return []
        return [(plane, motion, picture.settings) for plane, motion in picture.motions.items()
                if motion and self.plane in (plane, "compare")]  # fmt: skip

    def _left(self, room):
        lab, scene = self._lab, self._explorer.scene
        if room == TOY:
            return Start(toy=lab.toy, spin=lab.spin, tilt=lab.tilt, mu=lab.mu, by_hand=True)
        if room == PLANES and self._planes.by == "spin":
            planes = self._planes
            return Start(toy=self._toy, spin=planes.spin, tilt=planes.tilt, mu=planes.mu, by_hand=True)
        if self._gripped and self._rolls(self._gripped):
            return self._gripped
        state = scene.state
        spin = float(state.omega3 * scene.scales.angular_velocity / (2 * np.pi))
        return Start(toy=self._toy, spin=spin, tilt=float(np.degrees(state.theta)), mu=lab.mu, by_hand=False)

    @property
    def _toy(self):
        scene = self._explorer.scene
        if scene.shape is None:  # a, I1 and I3 were set by themselves
            top, scales = scene.top, scene.scales
            return BareSphere(R=scales.R, M=scales.M, a=top.a, I1=top.I1, I3=top.I3)
        name = self._builder.draft.name
        return name if name in TOYS else scene.shape

    def _rolls(self, start):
        """Whether the Explorer has what this start became, and nobody has changed it since."""
        return start == self._gripped and all(getattr(self._explorer, name) == value
                                              for name, value in self._asked.items())  # fmt: skip

    def _let_go(self, start, table):
        self._lab.param.update(toy=start.toy, spin=start.spin, tilt=start.tilt, mu=start.mu, table=table)
        self._lab.rest()

    def _set_planes(self):
        if self._planes is None or self._waits is None:
            return
        (start, plane), self._waits = self._waits, None
        inputs = {"plane": plane} if plane else {}
        if start and start.by_hand:
            inputs |= {"by": "spin", "spin": start.spin, "tilt": start.tilt, "mu": start.mu, "law": LAW, "slip": 1.0}
        elif start:
            inputs |= {"by": "constants"}
        self._planes.param.update(**inputs)
