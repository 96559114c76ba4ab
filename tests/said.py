"""False sentences: what the page says of a run, held against the samples of that run. Of app it uses only what tell()
returns.

    python tests/said.py [SEED [NUMBER]]

counts them by kind over that many random starts (200 by default) on all three tables.
"""

import re
import sys
from collections import Counter

import numpy as np

TOYS = {  # (a; whether it has a stem or a rim that may touch)
    "The paper's tippe top": 0.07, "Top S": 0.3, "Loaded sphere": 0.13, "Disc on a peg": -10.1, "Wooden cone": -2.9,
    "Uniform ball": 0.0, "Leine and Glocker's toy": 0.2,
}  # fmt: skip
QUIET = 1e-6  # MgR


def starts(seed, number=200):
    """Random ordinary starts: (toy, spin in rev/s, tilt in degrees, mu)."""
    rng = np.random.default_rng(seed)
    names = list(TOYS)
    for _ in range(number):
        toy = names[rng.integers(len(names))]
        most = 60.0 if TOYS[toy] < 0 else 110.0
        yield (
            toy,
            round(rng.uniform(0, 50), 2),
            round(rng.uniform(0, most), 1),
            round(float(rng.uniform(0.02, 0.8)), 3),
        )


class Run:
    """The samples of one table as arrays."""

    def __init__(self, table):
        self.table = table
        samples = table["samples"]
        self.t, self.tilt, self.spin, self.kinetic = (
            np.array(samples[name], float) for name in ("t", "tilt", "spin", "kinetic")
        )

    def inside(self, start, end=np.inf):
        return (self.t >= start - 1e-6) & (self.t <= end + 1e-6)

    def beyond(self, level, start=0.0):
        """For how long the tilt is above a level, at a stretch, s; dips of 10 degrees and 0.1 s do not count."""
        longest, since, last = 0.0, None, -np.inf
        for t, tilt in zip(self.t, self.tilt, strict=True):
            if t < start - 1e-6 or tilt < level - 10:
                since, last = None, -np.inf
            elif tilt > level:
                since = t if since is None or t - last > 0.12 else since
                longest, last = max(longest, t - since), t
        return longest


def faults(told):
    """[(kind, table, sentence)] of what is false in the result of tell()."""
    tables = {name: table for name, table in told["tables"].items() if not table["refused"]}
    runs = {name: Run(table) for name, table in tables.items()}
    found = [(kind, "three", said) for said in told["said"] for kind in _of_all(said, tables, runs)]
    for name, table in tables.items():
        run = runs[name]
        caption = {"headline": table["caption"], "why": "", "from": 0.0, "to": run.t[-1], "kind": ""}
        for phase in [*table["phases"], *([caption] if table["caption"] else [])]:
            said = f"{phase['headline']} {phase['why']}"
            found += [(kind, name, said) for kind in _of_phase(said, phase, table, run)]
        for quantity, kept in table["kept"].items():
            found += [(kind, name, kept["said"]) for kind in _of_kept(quantity, kept["said"], name)]
    return found


def _of_all(said, tables, runs):
    quiet = [name for name in ("rough", "ice") if name in runs]
    if "keep the energy" in said and tables.get("rough", {}).get("gripped", 0.0) > 0.1:
        yield "both keep the energy"
    if "must stay near" in said and any(np.ptp(runs[name].tilt) > 30 for name in quiet):
        yield "must stay near its tilt"
    if "never turns over" in said and any(crosses(runs[name]) for name in quiet):
        yield "never turns over"
    if "turns it over" in said and "ordinary" in runs and runs["ordinary"].beyond(120) < 0.3:
        yield "turns over, but not beyond 120"


def crosses(run):
    return run.tilt[0] < 90 < run.tilt.max()


def _of_phase(said, phase, table, run):
    a, here = table["a"], run.inside(phase["from"], phase["to"])
    after = run.inside(phase["from"])
    tilt = run.tilt[here] if here.any() else run.tilt[-1:]
    early = bool(table["ended"])
    if "never turns over" in said and crosses(run):
        yield "never turns over"
    if re.search("forever|for ever", said) and early:
        yield "forever, of a run that ended"
    if re.search("back and forth", said) and early:
        yield "back and forth, of a run that ended"
    if "Nods between" in said and early:
        yield "nods, of a run that ended"
    if "further and further" in said and (
        run.tilt[after].min() < run.tilt[after][0] - 10 or run.tilt.min() < run.tilt[0] - 10
    ):
        yield "leans further, and rises"
    if "hold it there" in said and a > 0:
        yield "spin holds it, where spin unsettles it"
    if re.search("lies still|comes to rest", said) and run.kinetic[after].max() > 10 * QUIET:
        yield "lies still, and moves"
    elif (
        "lies still" in said
        and a > 0
        and set(table["samples"].get("support", ["ball"])[-1:]) == {"ball"}
        and run.tilt[-1] > 20
    ):
        yield "lies still, and would fall"
    if re.match("It turns over", said) and run.beyond(120, phase["from"]) < 0.3:
        yield "turns over, but not beyond 120"
    if "turned it over" in said and run.tilt[~after].min(initial=180) > 90 and phase["from"] > 0:
        yield "rubbing turned it over, as it was put down"
    if re.match("It falls", said) and np.ptp(run.tilt[after]) < 15:
        yield "falls, and hangs"
    if re.match("It stands on its", said) and run.tilt[here].size and np.mean(tilt > 165) < 0.5:
        yield "stands, and does not"
    if not a and "heavy side" in said:
        yield "the heavy side of a uniform ball"
    if "nothing can turn it over" in said and tilt.max() > 120 > 60 > tilt.min():
        yield "nothing can turn it over, and it goes over and back"
    if table["part"] == "none" and re.search(r"\bstem\b|\brim\b", said):
        yield "the stem of a bare ball"


def _of_kept(quantity, text, name):
    if quantity == "energy" and "swings" in text and name == "ordinary":
        yield "energy swings, where it only falls"
    if re.search(r"[-\N{MINUS SIGN}]0(\.0+)?(?![.\d])", text):
        yield "minus zero"


def counted(tell, seed, number=200):
    """{kind: number of starts with such a sentence} for a function from a start to the result of tell(); "none": of
    starts without any; "refused": of those that cannot be computed on the ordinary table."""
    total = Counter()
    for start in starts(seed, number):
        found = tell(*start)
        total.update({kind for kind, *_ in faults(found)} or {"none"})
        total["refused"] += bool(found["tables"]["ordinary"]["refused"])
    return total


def link(toy, spin, tilt, mu):
    """The link of a start."""
    from app.state.codecs import Body, Number
    from tippe_core import PRESETS

    preset = next(preset for preset in PRESETS if preset.name == toy)
    numbers = {"a": preset.top.a, "I1": preset.top.I1, "I3": preset.top.I3, "spin": spin, "tilt": tilt, "mu_k": mu}
    texts = {"body": Body.text(preset.shape)} | {name: Number.text(value) for name, value in numbers.items()}
    return "?" + "&".join(["v=2", "tab=lab", "by=hand", *(f"{name}={text}" for name, text in texts.items())])


if __name__ == "__main__":
    from app.model import tell

    seed, number, *_ = [*map(int, sys.argv[1:]), *(51, 200)[len(sys.argv) - 1 :]]
    for kind, count in counted(lambda *start: tell(link(*start)), seed, number).most_common():
        print(f"{count:5} {kind}")
