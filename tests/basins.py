"""Where the runs of the paper's top end, by spin and tilt, and whether the border between the ends is a fractal.

    python tests/basins.py [cells a side]

400 a side unless told otherwise, hours on two cores; `make proof` runs it. Writes docs/basins.png and docs/basins.md.
"""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from scipy.optimize import minimize

from tippe_core import PRESETS, SmoothedCoulomb, slide_many

DOCS = Path(__file__).parent.parent / "docs"
SPINS, TILTS, SECONDS = (15.0, 60.0), (2.0, 30.0), 60.0  # rev/s, degrees, s
DISTANCES = 10.0 ** np.arange(-5, 0.5, 0.5)  # rev/s
SCALES = {"1 to 0.03": (0.03, 1.0), "0.01 to 0.001": (0.001, 0.01)}
STARTS, CELLS = 800, 400
SPLIT = 40.0  # rev/s: below it they interleave
DRAWS = 200  # of the bootstrap
COLOURS = {"upright": "#f6f1e6", "leaning": "#e8dcc2", "rolling": "#dccaa2", "moving": "#cdb88f",
           "inverted": "#a88a55", "stem": "#80632f", "refused": "#9aa3ac"}  # fmt: skip


def ended(spins, tilts, say, rtol=1e-6):
    """The ends of starts in rev/s and degrees, in the words of slide_many."""
    body, friction = PRESETS[0], SmoothedCoulomb(0.3, 0.1)
    w = 2 * np.pi * spins / body.shape.scales.angular_velocity
    state = SimpleNamespace(theta=np.radians(tilts), theta_dot=0.0, omega2=0.0, omega3=w)
    seconds = SECONDS / body.shape.scales.time
    return slide_many(body.top, state, friction, seconds, body.shape.edge, rtol=rtol, progress=say).end


def pairs(low, high, count, rng, say, rtol=1e-6):
    """(count, 1 + distances) ends: of starts between two spins, and of their neighbours, each DISTANCES faster."""
    spins = rng.uniform(low, high, (count, 1)) + np.concatenate([[0.0], DISTANCES])
    return ended(spins, rng.uniform(*TILTS, (count, 1)) + 0 * spins, say, rtol)


def exponent(other, use, rng):
    """(alpha, its error): the share whose neighbour ends otherwise goes like distance^alpha, over the distances of use.

    By the most likely power of binomial shares; its error is of the bootstrap over starts, whose pairs share a start.
    """
    x, count = np.log(DISTANCES[use]), len(other)

    def slope(shares):
        def unlikely(line):
            p = np.clip(np.exp(line[0] + line[1] * (x - x.mean())), 1e-12, 1 - 1e-12)
            return -count * np.sum(shares * np.log(p) + (1 - shares) * np.log1p(-p))

        begin = np.log(np.clip(shares.mean(), 1e-6, 1)), 0.7
        return minimize(unlikely, begin, method="Nelder-Mead").x[1]

    draws = [slope(other[rng.integers(0, count, count)][:, use].mean(axis=0)) for _ in range(DRAWS)]
    return slope(other[:, use].mean(axis=0)), float(np.std(draws))


def drawn(spins, tilts, end):
    figure = Figure(figsize=(7.2, 4.8), layout="constrained")
    axes = figure.add_subplot(xlabel="spin, rev/s", ylabel="tilt at the start, degrees")
    rgb = np.array([[int(COLOURS[one][i : i + 2], 16) for i in (1, 3, 5)] for one in end.ravel()], np.uint8)
    axes.imshow(rgb.reshape(*end.shape, 3), origin="lower", aspect="auto", extent=(*SPINS, *TILTS),
                interpolation="nearest")  # fmt: skip
    there = [one for one in COLOURS if (end == one).any()]
    axes.legend(handles=[Patch(facecolor=COLOURS[one], edgecolor="black", label=one) for one in there], fontsize=7)
    figure.savefig(DOCS / "basins.png", dpi=150)


def page(cells, starts, found, rtol=None):
    """The lines of docs/basins.md. found: {(low, high): ends of pairs()}; rtol: the share of the same starts that end
    otherwise where steps are a thousand times as exact, where that was asked."""
    rng, others = np.random.default_rng(5), {spins: ends[:, 1:] != ends[:, :1] for spins, ends in found.items()}
    yield from ("# Where the paper’s top ends", "")
    yield (f"The paper’s top with its stem, `SmoothedCoulomb(0.3, 0.1)`, {SECONDS:g} s: {cells} × {cells} runs of "
           f"`slide_many`, each cell one run. `make proof` makes {CELLS} × {CELLS}, hours; `python tests/basins.py "
           f"{cells}` makes this one.")  # fmt: skip
    yield from ("", "![Ends over spin and tilt](basins.png)", "")
    yield ("Below some 40 rev/s the ends interleave. Is the border between them a fractal? Of two starts at one tilt, "
           "one of them faster by ε, the share that end differently goes like ε to the power α, and the border has the "
           f"dimension 2 − α: 1 where it is smooth, more where it is a fractal. {starts} starts at random in each "
           "range, each with its neighbours; errors are one standard error, those of α by the bootstrap over starts."
           )  # fmt: skip
    yield ""
    yield "| ε, rev/s | " + " | ".join(f"{low:g} to {high:g} rev/s" for low, high in found) + " |"
    yield "|---|" + "---|" * len(found)
    for i, distance in enumerate(DISTANCES):
        shares = [(other[:, i].mean(), len(other)) for other in others.values()]
        yield f"| {distance:.1e} | " + " | ".join(f"{p:.4f} ± {max(p * (1 - p), 1 / n) ** 0.5 / n**0.5:.4f}"
                                                  for p, n in shares) + " |"  # fmt: skip
    for name, (least, most) in SCALES.items():
        use = (least * 0.99 < DISTANCES) & (most * 1.01 > DISTANCES)
        powers = ["{:.2f} ± {:.2f}".format(*exponent(other, use, rng)) if other[:, use].any(axis=0).sum() > 1
                  else "too few differ" for other in others.values()]  # fmt: skip
        yield f"| α, {name} | " + " | ".join(powers) + " |"
    yield ""
    yield ("So there is no one power. From 1 down to 0.03 rev/s the border looks like a fractal: halving a distance "
           "hardly makes the end surer. Below some 0.01 rev/s the power is not told from 1, that of a smooth border, "
           "and pairs that are closer than 0.001 rev/s hardly ever end differently. So would it be if each hop of the "
           "top folded the border once more, for it hops a few times only and then comes to rest; that was not tried."
           )  # fmt: skip
    if rtol is not None:
        yield ""
        yield (f"With steps a thousand times as exact (`rtol` 1e-9) {rtol:.1%} of the starts from {SPINS[0]:g} to "
               f"{SPLIT:g} rev/s end otherwise. So where a single cell near a border ends is not certain; how often "
               "neighbours differ, among runs all made in one way, is.")  # fmt: skip


def main(cells):
    say = lambda share: print(f"\r{share:.0%}", end="", flush=True)  # noqa: E731
    part = (np.arange(cells) + 0.5) / cells
    spins, tilts = (low + (high - low) * part for low, high in (SPINS, TILTS))
    drawn(spins, tilts, ended(spins[None], tilts[:, None], say))
    found = {(low, high): pairs(low, high, STARTS, np.random.default_rng(4), say)
             for low, high in ((SPINS[0], SPLIT), (SPLIT, SPINS[1]))}  # fmt: skip
    exact = pairs(SPINS[0], SPLIT, STARTS, np.random.default_rng(4), say, rtol=1e-9)
    other = (exact[:, 0] != found[SPINS[0], SPLIT][:, 0]).mean()
    (DOCS / "basins.md").write_text("\n".join(page(cells, STARTS, found, other)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else CELLS)
