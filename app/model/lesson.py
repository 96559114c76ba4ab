"""The lesson as data: ten steps, each a question, a motion to set up, and the answer that the computation gives.

Nothing here is a stored key: answer(scene) works it out from the scene's own top and motion. The words are in
app/text, under the steps' names.
"""

from collections.abc import Callable

import numpy as np

from app.model.lesson_parts import K_R, Answer, Guess, Guessed, Step, at, choice, revolutions
from app.model.lesson_rolling import energy, jellett, jump, lifting, routh, slip, taken, ties, turning
from app.model.lesson_sliding import K_R_THROWN, flip, free, needed_spin, proof, thrown
from app.model.scene import Scene, solve
from tippe_core import State

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


def planned(step: Step, scene: Scene) -> Scene:
    """The Scene that a step's inputs give this scene's top."""
    inputs = step.inputs(scene.top)
    state = {name: inputs[name] for name in ("theta", "theta_dot", "omega2", "omega3") if name in inputs}
    share, shape = inputs.get("energy", 0.0), scene.inputs["shape"]
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
