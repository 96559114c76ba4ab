"""The top that is being built, as it stands, with its mass and size, and what becomes of it."""

import numpy as np

from app.bundle import pack
from app.tabs.build.verdict import VerdictWords
from app.text import say, written
from app.widgets.cards import stack, words
from app.widgets.forms import Button
from app.widgets.top3d import Top3D, pack_frames

HIGH = 380  # px
ALONE = ".tippe :is(.verdict, .scales) { display: none }"
STAGE = f":host {{ height: clamp(300px, 46vh, {HIGH}px) !important }}"
CORNER = ":host { position: absolute; bottom: 16px; SIDE: 16px; width: max-content !important; z-index: 1 }"
BESIDE = ":host { max-width: calc(100% - 160px) }"  # the button
PILL = """
b { display: block; background: var(--card); border-radius: 16px; padding: 4px 12px;
  font-variant-numeric: tabular-nums }
"""
SHOWN = {f"show_{what}": False for what in ("track", "com_path", "force", "cone", "omega", "momentum")}
POINTS = 96  # points of an outline


class Built:
    """runs: the page's Runs; spin: shows the run of the verdict. show() is for each scene of a hand at rest."""

    def __init__(self, runs, spin):
        self.told = VerdictWords(runs)
        self.top = Top3D(sizing_mode="stretch_width", height=HIGH, clock="build", label=say("build.spin.top"),
                         playing=False, bare=True, stylesheets=[STAGE, ALONE], **SHOWN)  # fmt: skip
        self.size = words(style=PILL + BESIDE + CORNER.replace("SIDE", "left"), sizing_mode=None)
        self.spin = Button(say("build.spin.it"), spin, kind="primary", stylesheets=[CORNER.replace("SIDE", "right")])

    @property
    def view(self):
        """The stage, and the verdict."""
        stage = stack(self.top, self.size, self.spin, styles={"position": "relative", "overflow": "hidden"})
        return [stage, self.told.view, self.told.strip]

    def show(self, scene):
        self.told.show(scene)
        if not self.top.is_new((scene.top, scene.profile.tobytes())):
            return
        self.top.tell(profile=pack(scene.profile), seconds=scene.scales.time, frames=standing(scene.top))
        if scene.shape is not None:
            radius, height = 1e3 * scene.shape.profile(POINTS).T
            mass, wide, high = (written(x, ".3g") for x in (1e3 * scene.shape.mass, 2 * radius.max(), np.ptp(height)))
            size = say("build.spin.size", mass=mass, wide=wide, high=high)
            self.size.object, self.top.label = f"<b>{size}</b>", f"{say('build.spin.top')}. {size}"


def standing(top):
    """The frames of a top that stands on its ball."""
    none, up = np.zeros((2, 3)), np.tile([0.0, 0.0, 1.0], (2, 1))
    return pack_frames(t=[0, 1], quaternion=np.tile([0, 0, 0, 1], (2, 1)), contact=none[:, :2], com=(1 - top.a) * up,
                       theta=[0, 0], force=up, omega=none, momentum=none, regime=[0, 0])  # fmt: skip
