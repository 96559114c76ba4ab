"""What a sentence is held against: the run, and the phase that it is said of. Nothing of the app is imported."""

from dataclasses import dataclass, replace

import numpy as np
from story_phases import facts
from story_samples import Phase, Run


@dataclass(frozen=True)
class Said:
    """A text, and what it is said of.

    others: {table: its Run}; stemless: the body is a ball without a stem; whole: it is said of the run, not of a phase.
    """

    text: str
    run: Run
    phase: Phase
    others: dict
    stemless: bool = False
    whole: bool = False

    def of(self, table):
        """The same of the whole run on another table; None if there is none."""
        run = self.others.get(table)
        return run and replace(self, run=run, phase=Phase("", run.start, run.end), whole=True)

    def tilts(self, whole=False):
        """(least, most) tilt, each as (low, high) that it can be: the ends of a phase may differ by the slack."""
        slack, t0, t1 = self.run.slack, self.phase.t0, self.run.end if whole else self.phase.t1
        wide = self.run.between(max(t0 - slack, self.run.start), min(t1 + slack, self.run.end))[1]
        narrow = self.run.between(*((t0 + slack, t1 - slack) if t1 - t0 > 2 * slack else (t0, t1)))[1]
        return (np.min(wide), np.min(narrow)), (np.max(narrow), np.max(wide))

    def at(self, values, time):
        """(low, high) of samples around a time."""
        t = np.clip([time - self.run.step, time + self.run.step], self.run.start, self.run.end)
        some = np.r_[np.interp(t, self.run.t, values), values[self.run.inside(*t)]]
        return np.min(some), np.max(some)

    def spin(self, time):
        """(low, high) of the spin without its sign around a time."""
        return self.at(np.abs(self.run.spin), time)

    def spins(self):
        """(least, most) spin in the phase, without its sign."""
        spin = np.abs(self.run.spin[self.run.inside(self.phase.t0 - 1e-9, self.phase.t1 + 1e-9)])
        return (np.min(spin), np.max(spin)) if len(spin) else self.spin(self.phase.t0)

    def over(self, sure=False):
        """When it turns over."""
        return facts(self.run, "over", sure)


def number(text):
    """A number as it is written, and half of its last digit."""
    text = text.replace("−", "-")
    return float(text), 0.5 * 10.0 ** -len(text.partition(".")[2])


def differs(text, span):
    """Why a number that is written is not one of a span; None if it is."""
    value, half = number(text)
    low, high = span
    return None if low - half * 1.02 <= value <= high + half * 1.02 else f"says {text}, it is {low:.4g} to {high:.4g}"


def joined(*reasons):
    """The first reason."""
    return next((one for one in reasons if one), None)


def energy(run):
    """In MgR, of the samples in which the ball alone carries it."""
    on = run.support == "ball"
    return run.kinetic[on] + 1 - run.a * np.cos(np.radians(run.tilt[on]))
