"""Where the runs of the paper's top end, by spin and tilt, and whether the border between the ends is a fractal.

    python tests/basins.py [cells a side]

400 a side unless told otherwise, hours on two cores; `make proof` runs it. Writes docs/basins.png and docs/basins.md.
"""

import sys
import time
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from tippe_core import PRESETS, SmoothedCoulomb, State, slide_many

DOCS = Path(__file__).parent.parent / "docs"
SPINS, TILTS, SECONDS = (15.0, 60.0), (2.0, 30.0), 60.0  # rev/s, degrees, s
SPLIT = 40.0  # rev/s: below it they interleave
DRAWS = 200  # of the bootstrap
COLOURS = {"upright": "#f6f1e6", "leaning": "#e8dcc2", "rolling": "#dccaa2", "moving": "#cdb88f",
           "inverted": "#a88a55", "stem": "#80632f", "refused": "#9aa3ac"}  # fmt: skip


def ends(cells, say):
    """(spins, tilts, end (tilt, spin))."""
    body, friction = PRESETS[0], SmoothedCoulomb(0.3, 0.1)
    scales, part = body.shape.scales, (np.arange(cells) + 0.5) / cells
    spins, tilts = (low + (high - low) * part for low, high in (SPINS, TILTS))
    w = 2 * np.pi * spins / scales.angular_velocity
    states = np.array([[State(float(np.radians(tilt)), 0, 0, float(one)) for one in w] for tilt in tilts], dtype=object)
    many = slide_many(body.top, states, friction, SECONDS / scales.time, body.shape.edge, progress=say)
    return spins, tilts, many.end


def uncertain(end):
    """{k: (rows,)}: for each row the share of cells whose end is another one k cells on, for k = 1, 2, 4, ..."""
    width = end.shape[1]
    return {k: (end[:, k:] != end[:, :-k]).mean(axis=1) for k in 2 ** np.arange(int(np.log2(width)) - 1)}


def exponent(end, step, rng):
    """(distances, shares, alpha, its error, how many distances it holds for): share ~ distance^alpha.

    Fitted over the distances at which the share is below half of that of pairs taken at random: beyond, it levels off.
    The error is of the bootstrap over rows.
    """
    found = uncertain(end)
    counts = np.unique(end, return_counts=True)[1]
    chance = 1 - np.sum((counts / end.size) ** 2)
    shares = np.array([row.mean() for row in found.values()])
    use = (shares > 0) & (shares < chance / 2)
    use &= np.cumprod(use).astype(bool) if use[0] else use
    x = np.log(np.array([*found])[use] * step)
    rows = np.array([*found.values()])[use]

    def slope(values):
        return np.polyfit(x, np.log(values), 1)[0] if len(x) > 1 and np.all(values > 0) else np.nan

    draws = [slope(rows[:, rng.integers(0, end.shape[0], end.shape[0])].mean(axis=1)) for _ in range(DRAWS)]
    return np.array([*found]) * step, shares, slope(rows.mean(axis=1)), float(np.nanstd(draws)), int(use.sum())


def drawn(spins, tilts, end):
    figure = Figure(figsize=(7.2, 4.8), layout="constrained")
    axes = figure.add_subplot(xlabel="spin, rev/s", ylabel="tilt at the start, degrees")
    rgb = np.array([[int(COLOURS[one][i : i + 2], 16) for i in (1, 3, 5)] for one in end.ravel()], np.uint8)
    axes.imshow(rgb.reshape(*end.shape, 3), origin="lower", aspect="auto", extent=(*SPINS, *TILTS),
                interpolation="nearest")  # fmt: skip
    there = [one for one in COLOURS if (end == one).any()]
    axes.legend(handles=[Patch(facecolor=COLOURS[one], edgecolor="black", label=one) for one in there], fontsize=7)
    figure.savefig(DOCS / "basins.png", dpi=150)


def main(cells):
    began = time.monotonic()
    spins, tilts, end = ends(cells, lambda share: print(f"\r{share:.0%}", end="", flush=True))
    drawn(spins, tilts, end)
    rng, step = np.random.default_rng(4), spins[1] - spins[0]
    lines = [
        "# Where the paper’s top ends",
        "",
        f"The paper’s top with its stem, `SmoothedCoulomb(0.3, 0.1)`, {SECONDS:g} s, {cells} × {cells} runs of "
        f"`slide_many`, each cell one run: `make proof` ({time.monotonic() - began:.0f} s here).",
        "",
        "![Ends over spin and tilt](basins.png)",
        "",
        "How often two starts at one tilt whose spins differ by ε end differently goes like ε to the power α; "
        "the border has the dimension 2 − α. A smooth border has α = 1.",
        "",
        "| spin, rev/s | ε, rev/s | share that ends differently | α | distances it is fitted to |",
        "|---|---|---|---|---|",
    ]
    for name, part in ((f"{SPINS[0]:g} to {SPLIT:g}", spins < SPLIT), (f"{SPLIT:g} to {SPINS[1]:g}", spins >= SPLIT)):
        distances, shares, alpha, error, used = exponent(end[:, part], step, rng)
        told = ", ".join(f"{share:.3f}" for share in shares)
        power = f"{alpha:.2f} ± {error:.2f}" if np.isfinite(alpha) else "not to be told"
        lines.append(f"| {name} | {', '.join(f'{each:.3g}' for each in distances)} | {told} | {power} | {used} |")
    (DOCS / "basins.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 400)
