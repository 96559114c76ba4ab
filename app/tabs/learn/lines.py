"""The derivation on the page: each equation typeset, the present values of both its sides, and symbols that can be
pointed at."""

import numpy as np
import param

from app.bundle import Bundled
from app.model import stretches
from app.model.roll import derivation
from app.text import listed, say
from app.widgets.cards import column

PLANES = ("rough", "smooth")


class Lines(Bundled):
    """The equations. The tables have one row for each instant of one nutation, with t first; the browser picks the row
    for its clock.

    It listens to `tippe:clock:<clock>`, and sends `tippe:highlight:<clock>` with what is pointed at: `{vector, start,
    label}`, a vector along 1', y, z from "com" or "contact", or null.
    """

    clock = param.String(default="", constant=True)
    lines = param.List(default=[], doc="number, tex, words, symbols, plane, and the columns of its sides in the table")
    symbols = param.Dict(default={}, doc="name: texts, words, and the columns of value and arrow in a table")
    words = param.Dict(default={})
    rough = param.Bytes(default=b"", doc="float64 rows of the rough plane")
    smooth = param.Bytes(default=b"", doc="float64 rows of the smooth plane")
    periods = param.List(default=[1.0, 1.0])
    widths = param.List(default=[1, 1])


def rows(m, plane):
    """The contents of a table: [(key, (n, k))], for all instants of a Window except those near its ends."""
    inner = slice(stretches.EDGE, -stretches.EDGE)
    yield "t", m.t[inner, None]
    for name, symbol in derivation.SYMBOLS.items():
        for part, get in (("value", symbol.value), ("arrow", symbol.arrow)):
            if get is not None:
                found = np.asarray(get(m), dtype=float)
                yield f"{part} {name}", found.reshape(len(m.t), -1)[inner]
    for line in derivation.LINES:
        if line.plane == plane:
            _, left, right = derivation.both_sides(line, [m])
            yield f"left {line.number}", left
            yield f"right {line.number}", right


def table(parts, plane):
    """(values (n, k), {key: (first column, columns)})."""
    blocks = [dict(rows(m, plane)) for m in parts]
    at, places = 0, {}
    for key, block in blocks[0].items():
        places[key] = (at, block.shape[1])
        at += block.shape[1]
    return np.vstack([np.hstack(list(block.values())) for block in blocks]), places


LABELS = {"omega": "ω", "w1": "ω₁′", "w2": "ω₂′", "w3": "ω₃", "wz": "ω_z", "theta": "θ", "I1": "I₁", "I3": "I₃",
          "dI": "ΔI", "L_3": "L₃", "L_z": "L_z", "r3": "r₃", "rp": "r⊥", "vz": "v_z", "Fx": "F_x", "Fy": "F_y",
          "Fz": "F_z", "three": "3̂", "z": "ẑ", "Ep": "E′", "f1": "f₁", "f2": "f₂", "f3": "f₃"}  # fmt: skip


class Derivation:
    """The equations for the scene's motion, updated while they are shown."""

    def __init__(self, clock):
        self._scene = None
        self._clock = clock
        self.place = column()

    def show(self, scene):
        if scene is self._scene:
            return
        self._scene = scene
        parts = {"rough": stretches.rolled(scene), "smooth": stretches.glided(scene)}
        tables = {plane: table(parts[plane], plane) for plane in PLANES}
        lines = []
        for line in derivation.LINES:
            values, places = tables[line.plane]
            (at, size), (after, _) = (places[f"{side} {line.number}"] for side in ("left", "right"))
            both = values[:, at : after + size]
            lines.append({"number": line.number, "tex": line.tex, "words": say(f"derivation.lines.{line.key}"),
                          "symbols": line.symbols.split(), "plane": line.plane, "at": at, "size": size,
                          "scale": 1 + float(np.nanmax(np.abs(both), initial=0.0))})  # fmt: skip
        places = tables["rough"][1]
        symbols = {
            name: {"texts": list(symbol.texts), "says": listed(f"derivation.symbols.{name}"), "start": symbol.start,
                   "label": LABELS.get(name, name), "at": places[f"value {name}"][0],
                   "size": places[f"value {name}"][1],
                   "arrow": places[f"arrow {name}"][0] if symbol.arrow else -1}
            for name, symbol in derivation.SYMBOLS.items()
        }  # fmt: skip
        # built anew with the scene, because the numbers and the scales of the differences belong together
        self.place.objects = [Lines(
            clock=self._clock, lines=lines, symbols=symbols, words=listed("derivation.page"),
            rough=tables["rough"][0].tobytes(), smooth=tables["smooth"][0].tobytes(),
            widths=[tables[plane][0].shape[1] for plane in PLANES],
            periods=[parts[plane][-1].t[-stretches.EDGE - 1] for plane in PLANES], sizing_mode="stretch_width",
        )]  # fmt: skip
