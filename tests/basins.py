"""Where the runs of the paper's top end, by spin and tilt, and whether the border between the ends is a fractal.

    python tests/basins.py [cells a side [folder of what was run]]

400 a side unless told otherwise, 1.3 hours of one core; `make proof` runs it. What was run is in tests/data/basins with
its date and a hash of the code that ran it; it goes on where that was stopped, unless the code is another one now.
Writes docs/basins.png and docs/basins.md; `python tests/ages.py` only how old they are.
"""

import datetime
import functools
import sys
import zlib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from fingerprint import fingerprint, short
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from scipy.optimize import minimize

from tippe_core import PRESETS, SmoothedCoulomb, slide_many

DOCS, KEPT = Path(__file__).parent.parent / "docs", Path(__file__).parent / "data" / "basins"
SPINS, TILTS, SECONDS = (15.0, 60.0), (2.0, 30.0), 60.0  # rev/s, degrees, s
DISTANCES = 10.0 ** np.arange(-5, 0.5, 0.5)  # rev/s
SCALES = {"1 to 0.03": (0.03, 1.0), "0.01 to 0.001": (0.001, 0.01)}
STARTS, CELLS, PIECE = 800, 400, 400
SPLIT = 40.0  # rev/s: pairs are computed below it and above it
DRAWS = 200  # of the bootstrap
BANDS = 10, 20, 30  # degrees
COLOURS = {"upright": "#f6f1e6", "leaning": "#e8dcc2", "rolling": "#dccaa2", "moving": "#cdb88f",
           "inverted": "#a88a55", "stem": "#80632f", "refused": "#9aa3ac"}  # fmt: skip
WORDS, NONE = [*COLOURS], 255


def ended(spins, tilts, rtol=1e-6, progress=None):
    """(ends in the words of slide_many, how often it left the table) of starts in rev/s and degrees."""
    body, friction = PRESETS[0], SmoothedCoulomb(0.3, 0.1)
    w = 2 * np.pi * spins / body.shape.scales.angular_velocity
    state = SimpleNamespace(theta=np.radians(tilts), theta_dot=0.0, omega2=0.0, omega3=w)
    seconds = SECONDS / body.shape.scales.time
    many = slide_many(body.top, state, friction, seconds, body.shape.edge, rtol=rtol, progress=progress)
    return many.end, many.hops


@functools.cache
def code():
    """The hash of what computes the ends, and of the numbers of the body that it is given."""
    body = PRESETS[0]
    numbers = [body.top.a, body.top.I1, body.top.I3, *body.shape.edge, body.shape.scales.time]
    return short(f"{fingerprint(slide_many, SmoothedCoulomb)} {[f'{number:.9g}' for number in numbers]}")


def kept(file, spins, tilts, rtol=1e-6, wait=False):
    """(codes of WORDS, hops) of starts, each (n,): what a file has of them, and the rest run and written, a piece at a
    time; wait: only what the file has, NONE for the rest."""
    spins, tilts = np.broadcast_arrays(spins, tilts)
    shape, mark = spins.shape, zlib.crc32(np.array([spins, tilts, 0 * spins + rtol]).round(9).tobytes())
    end, hops = np.full(spins.size, NONE, np.uint8), np.zeros(spins.size, np.uint8)
    if file.exists():
        with np.load(file) as old:
            if old["mark"] == mark and (wait or str(old["code"]) == code()):
                end, hops = old["end"], old["hops"]
    for first in range(0, 0 if wait else spins.size, PIECE):
        piece = slice(first, first + PIECE)
        if (end[piece] != NONE).all():
            continue
        words, times = ended(spins.ravel()[piece], tilts.ravel()[piece], rtol)
        end[piece], hops[piece] = [WORDS.index(word) for word in words], np.minimum(times, 255)
        file.parent.mkdir(parents=True, exist_ok=True)
        made = {"mark": mark, "code": code(), "date": str(datetime.date.today())}
        np.savez_compressed(file.with_suffix(".part.npz"), end=end, hops=hops, **made)
        file.with_suffix(".part.npz").replace(file)
        print(f"{file.stem}: {(end != NONE).mean():.1%}", flush=True)
    return end.reshape(shape), hops.reshape(shape)


def mapped(folder, cells, wait=False):
    """(codes of WORDS, hops), each (cells, cells), tilt up and spin across: each second start across and up first, so
    that what was stopped is a coarser map."""
    spins, tilts = (low + (high - low) * (np.arange(cells) + 0.5) / cells for low, high in (SPINS, TILTS))
    rows, columns = np.divmod(np.arange(cells * cells), cells)
    order = np.lexsort((columns, rows, columns % 2, rows % 2))
    found = kept(folder / f"map-{cells}.npz", spins[columns[order]], tilts[rows[order]], wait=wait)
    return [part[np.argsort(order)].reshape(cells, cells) for part in found]


def pairs(folder, low, high, rtol=1e-6, wait=False):
    """(STARTS, 1 + distances) codes of ends: of starts between two spins, and of their neighbours, each DISTANCES
    faster."""
    rng = np.random.default_rng(4)
    spins = rng.uniform(low, high, (STARTS, 1)) + np.concatenate([[0.0], DISTANCES])
    tilts = rng.uniform(*TILTS, (STARTS, 1))
    return kept(folder / f"pairs-{low:g}-{high:g}-{rtol:.0e}.npz", spins, tilts, rtol, wait)[0]


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


def last_borders(end):
    """{tilt: the fastest spin below which, at smaller tilts than this, two neighbours end differently}."""
    spins, tilts = (low + (high - low) * (np.arange(n) + 0.5) / n
                    for n, (low, high) in zip(end.shape[::-1], (SPINS, TILTS), strict=True))  # fmt: skip
    differ = end[:, 1:] != end[:, :-1]
    return {tilt: float(spins[1:][differ[tilts < tilt].any(axis=0)].max()) for tilt in BANDS}


def drawn(end):
    figure = Figure(figsize=(7.2, 4.8), layout="constrained")
    axes = figure.add_subplot(xlabel="spin, rev/s", ylabel="tilt at the start, degrees")
    rgb = np.array([[int(COLOURS[one][i : i + 2], 16) for i in (1, 3, 5)] for one in WORDS], np.uint8)
    axes.imshow(rgb[end], origin="lower", aspect="auto", extent=(*SPINS, *TILTS), interpolation="nearest")
    there = [one for code, one in enumerate(WORDS) if (end == code).any()]
    axes.legend(handles=[Patch(facecolor=COLOURS[one], edgecolor="black", label=one) for one in there], fontsize=7)
    figure.savefig(DOCS / "basins.png", dpi=150)


def age(folder):
    """The line of the page that says when and by which code the ends were computed."""
    made = []
    for file in sorted(folder.glob("*-*.npz")):
        with np.load(file) as old:
            made.append((str(old["date"]), str(old["code"]) == code()))
    first, last = min(made)[0], max(made)[0]
    when = f"Computed on {first}" if first == last else f"Computed from {first} to {last}"
    old = sum(not same for _, same in made)
    return (f"{when}; **{old} of the {len(made)} parts are not of today’s code**: a function that the runs go through "
            "has changed since." if old else f"{when} with today’s code.")  # fmt: skip


def page(cells, starts, found, last, told, rtol=None):
    """The lines of docs/basins.md. told: of age(). last: of last_borders(). found: {(low, high): ends of pairs()}.
    rtol: the share of the same starts that end otherwise where steps are a thousand times as exact, if asked."""
    rng, others = np.random.default_rng(5), {spins: ends[:, 1:] != ends[:, :1] for spins, ends in found.items()}
    yield from ("# Where the paper’s top ends", "")
    yield (f"The final state of the paper’s top with its stem after {SECONDS:g} s, with `SmoothedCoulomb(0.3, 0.1)`: "
           f"{cells} × {cells} runs of `slide_many`, one for each cell. `python tests/basins.py {cells}` computes "
           f"them (for {CELLS} × {CELLS}, as `make proof` does, 1.3 hours of one core) and can be stopped and "
           "continued; what was run is kept in `tests/data/basins`."
           )  # fmt: skip
    yield from ("", told, "", "![Ends over spin and tilt](basins.png)", "")
    fastest = ", ".join(f"{spin:.0f} rev/s below {tilt} degrees" for tilt, spin in last.items())
    yield ("Above about 28 rev/s different ends alternate. The fastest start that ends differently from a neighbour "
           f"has {fastest}; all faster ones end on the stem.")  # fmt: skip
    yield ""
    yield ("Is the boundary between the ends a fractal? Take two starts with the same tilt, one of them faster by ε. "
           "The share of such pairs that end differently scales as ε to the power α, and the boundary has the "
           f"dimension 2 − α: 1 if it is smooth, more if it is a fractal. The table is for {starts} random starts in "
           "each range, each with its neighbours; errors are one standard error, those of α from a bootstrap over "
           "the starts."
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
    yield ("So there is no single power. From 1 down to 0.03 rev/s the boundary looks like a fractal: halving the "
           "distance hardly makes the end more predictable. Below about 0.01 rev/s the power is consistent with 1, "
           "that of a smooth boundary, and pairs closer than 0.001 rev/s hardly ever end differently. A possible "
           "explanation, which was not tested: each hop of the top folds the boundary once more, but the top hops "
           "only a few times before it comes to rest.")  # fmt: skip
    if rtol is not None:
        yield ""
        yield (f"With a tolerance a thousand times smaller (`rtol` 1e-9) {rtol:.1%} of the starts from {SPINS[0]:g} to "
               f"{SPLIT:g} rev/s end differently. So the end of a single cell near a boundary is uncertain, but how "
               "often neighbours differ, if all are computed in the same way, is not.")  # fmt: skip


def computed(cells, folder, wait=False):
    """(ends of the map, {(low, high): ends of pairs()}, the share that ends otherwise with steps a thousand times as
    exact); wait: only what is kept."""
    end, _ = mapped(folder, cells, wait)
    found = {between: pairs(folder, *between, wait=wait) for between in ((SPINS[0], SPLIT), (SPLIT, SPINS[1]))}
    exact = pairs(folder, SPINS[0], SPLIT, rtol=1e-9, wait=wait)
    return end, found, (exact[:, 0] != found[SPINS[0], SPLIT][:, 0]).mean()


def main(cells=CELLS, folder=KEPT):
    end, found, other = computed(cells, folder)
    drawn(end)
    text = "\n".join(page(cells, STARTS, found, last_borders(end), age(folder), other)) + "\n"
    (DOCS / "basins.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else CELLS, Path(sys.argv[2]) if len(sys.argv) > 2 else KEPT)
