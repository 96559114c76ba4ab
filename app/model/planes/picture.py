"""One frozen Picture: one top on all three planes, and the Setup from which it was computed.

In units of R, M and g, except for what a person sets: rev/s, degrees, s.
"""

from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np

from app.model.run import TableMotion
from app.model.setup import TABLES, Setup
from tippe_core import Friction, Outcome, State

SET = ("spin", "tilt", "slip", "law", "mu", "mu_s", "gamma", "eps", "patch", "landing", "stem", "seconds")
BY = {True: "spin", False: "constants"}

SHORT = 0.05  # s: a touch or hop that is too short to be seen


@dataclass(frozen=True, eq=False, kw_only=True)
class Picture:
    """Everything that the views show. motions: {plane: Motion or None}; if None, messages has the reason under the
    plane.

    outcome: that of the ball alone. growth: the factor by which NUDGE grew in the disturbed sliding run, None without
    one. inputs: those of the Planes, by name. messages: a sentence for each control whose value was refused, and "run"
    for a run that was stopped; everything but the inputs is then that of the last valid Picture. nearest: {control: the
    nearest possible value}, where it is known.
    """

    settings: Setup
    state: State
    friction: Friction
    motions: MappingProxyType[str, TableMotion | None]
    outcome: Outcome
    inputs: MappingProxyType[str, Any]
    growth: float | None = None
    messages: MappingProxyType[str, str] = field(default_factory=lambda: MappingProxyType({}))
    nearest: MappingProxyType[str, float] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def is_old(self) -> bool:
        """Whether it is not of its inputs, but of the last ones that gave one."""
        return not {*self.messages} <= {*TABLES}

    @property
    def turns(self) -> float:
        """The spin at the start, rev/s."""
        return self.state.omega3 * self.settings.turns

    @property
    def slip(self) -> float:
        """The slip speed at the start, m/s."""
        state, a = self.state, self.settings.top.a
        s, c = np.sin(state.theta), np.cos(state.theta)
        vx, vy = state.vx or 0.0, state.vy or 0.0
        ux = vx - (state.omega2 * (c - a) - state.omega3 * s)
        uy = vy + state.theta_dot * (1 - a * c)
        return float(self.settings.scales.velocity * np.hypot(ux, uy))
