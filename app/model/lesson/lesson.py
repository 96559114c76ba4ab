"""The lesson as data: seven steps, the last one of the page's own top, and the part for theorists.

No answers are stored: Step.answer(scene) computes the answer from the run that is shown, or from the scene's own top.
The words are in app/text, under the names of the steps.
"""

import numpy as np

from app.model.events import first_times
from app.model.lesson.parts import K_R, Answer, Guess, Step, at
from app.model.lesson.rolling import jump, slip, ties, turning
from app.model.lesson.runs import named
from app.model.lesson.six import SIX, YOURS, choice
from app.model.scene import Scene, solve


def creep(scene: Scene) -> Answer:
    """Which toy turns over: the one with a point contact, or the one with a small contact patch."""
    point, patch = named("point"), named("patch")
    over = {name: first_times(motion).get("over", np.nan) for name, motion in (("point", point), ("patch", patch))}
    turned = [name for name, time in over.items() if not np.isnan(time)]
    rolling = point.tilt[point.seconds >= point.rolls_since]
    numbers = {
        "caught": point.rolls_since, "low": rolling.min() if len(rolling) else np.nan,
        "high": rolling.max() if len(rolling) else np.nan,
        "over": over["patch"],
    }  # fmt: skip
    return Answer("both" if len(turned) == 2 else turned[0] if turned else "neither", numbers)


PERCENT, ANGLE = Guess(0.0, 100.0, 0.5, "%", 0.25, 2.0), Guess(0.0, 180.0, 0.5, "°", 0.0, 3.0)
THEORY = (
    Step("creep", choice("both", "point", "patch", "neither"), creep, ("point", "patch"), 0.03, 2.4,
         sources=("cohen", "leine")),
    Step("turning", ANGLE, turning, before=0.25, end=2.0, picture="curves", inputs=at(0.6, 0.95),
         tex=(r"\begin{aligned}f_1^2\,\dot\theta^2={}&2E'-2a(1-\cos\theta)\\&-\frac{f_2^2}{\sin^2\theta}\left[K_J-"
              r"\frac{I_3}{I_1}(\cos\theta-a)\frac{K_R}{f_3}\right]^2\quad(36)\end{aligned}",),
         sources=("gray", "arnold")),
    Step("ties", choice("down", "stays", "up"), ties, before=1.0, end=2.0, picture="curves", inputs=at(0.6, 1.9),
         tex=(r"f(\theta_m)=0\qquad f(\theta_p)=f'(\theta_p)=0",), sources=("gray",)),
    Step("jump", choice("inner", "between", "outer", "never"), jump, before=1.0, end=2.0, picture="curves",
         inputs=at(0.6, 1.98), tex=(r"F_z=1+a\left(\tfrac12\sin\theta\,f'+\cos\theta\,f\right)\quad(37)",),
         sources=("gray",)),
    Step("slip", PERCENT, slip, before=1.0, end=2.0, picture="curves", inputs=at(0.6, 0.98),
         tex=(r"F_x=-\frac{I_3K_R\,f^{1/2}}{f_3^3}\left(\cos\theta-\frac{I_3}{I_1}(\cos\theta-a)\right)\quad(38)",
              r"\left(F_x^2+F_y^2\right)^{1/2}\le\mu_sF_z"), sources=("gray", "kane")),
)  # fmt: skip
LESSON = (*SIX, YOURS)
STEPS = (*LESSON, *THEORY)
NAMES = tuple(step.name for step in STEPS)
OF_NAME = {step.name: step for step in STEPS}
BEFORE = {"free": "flips", "jellett": "arms", "energy": "height", "routh": "arms", "flip": "yours"}
"""The step that a link to a former step opens."""


def planned(step: Step, scene: Scene) -> Scene:
    """The Scene that a step is about: for a step with inputs, the Scene that they give for this scene's top."""
    if step.inputs is None:
        return scene
    inputs = step.inputs(scene.top)
    return solve(scene.top, inputs["K_J"], K_R, inputs["mu_s"], inputs["energy"], shape=scene.inputs["shape"])
