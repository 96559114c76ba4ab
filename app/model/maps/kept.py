"""Maps that were computed before, shared by all visitors: the newest in memory, more as files if the operator names a
folder. Those that are shown first ship with the page, in app/data.

    python -m app.model.maps.kept

computes these anew, after a change of the physics; a test compares some of their cells with fresh runs.
"""

import hashlib
import json
import threading
from collections import OrderedDict
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from app.model.maps.choice import AT
from app.model.maps.maps import AT_FIRST, UNITS, Map
from app.model.maps.rates import Branch, OfLaw, Power, Rates, rates
from app.model.maps.solving import Level, solve
from app.model.maps.steady import Bifurcation, Life, Line, bifurcation
from tippe_core import kept

DATA = Path(__file__).parents[2] / "data"
PAPERS = "The paper's tippe top"
SHIPPED = {
    Map(): DATA / "map.npz",
    Map(body=PAPERS): DATA / "map-paper.npz",
    AT_FIRST: DATA / "map-first.npz",
    replace(AT_FIRST, body=PAPERS): DATA / "map-paper-first.npz",
}
BELOW = {AT_FIRST: DATA / "below-first.json", replace(AT_FIRST, body=PAPERS): DATA / "below-paper-first.json"}
"""What is below a map of AT_FIRST, at the bead's first place."""
IN_MEMORY, AS_FILES = 64, 100_000_000  # maps; bytes, of which one of 48 x 48 cells takes some 80,000
_folder: Path | None = None
_memory: OrderedDict[Map, Level] = OrderedDict()
_changing = threading.Lock()


def keep_in(folder: Path) -> None:
    """From now on maps are stored in this folder too."""
    global _folder
    _folder = folder


def recall(request: Map) -> Level | None:
    """The complete map, if it was computed before by the same sources of tippe_core."""
    with _changing:
        level = _memory.get(request)
        if level is not None:
            _memory.move_to_end(request)
            return level
    path = SHIPPED.get(request) or _path(request)
    if path is None or not path.exists():
        return None
    with suppress(OSError, ValueError, KeyError, BadZipFile), np.load(path) as file:
        x, y = request.centres(request.cells)
        columns = {name: file[name].astype(float) for name in UNITS}
        level = Level(request=request, x=x, y=y, end=file["end"], columns=columns)
        _remember(level)
        return level
    return None


def keep(level: Level) -> None:
    """Stores a complete map; the oldest files are deleted, so that all have AS_FILES bytes at most."""
    _remember(level)
    path = _path(level.request)
    if path is None:
        return
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        _write(level, path)
        left = AS_FILES
        for file in sorted(path.parent.glob("*.npz"), key=lambda each: each.stat().st_mtime, reverse=True):
            left -= file.stat().st_size
            if left < 0:
                file.unlink(missing_ok=True)


def _write(level: Level, path: Path, kind: Any = float) -> None:
    new = path.with_suffix(f".{threading.get_ident()}.new")
    with new.open("wb") as file:
        columns = {name: values.astype(kind) for name, values in level.columns.items()}
        np.savez_compressed(file, allow_pickle=False, end=level.end, **columns)
    new.replace(path)


def _remember(level: Level) -> None:
    with _changing:
        _memory[level.request] = level
        while len(_memory) > IN_MEMORY:
            _memory.popitem(last=False)


def _path(request: Map) -> Path | None:
    """The file's name is a hash of the map's contents and of the sources of tippe_core."""
    if _folder is None:
        return None
    return _folder / f"{hashlib.sha256(f'{request!r} {kept.name()}'.encode()).hexdigest()[:32]}.npz"


def ships_below(request: Map, place: tuple[float, float]) -> bool:
    """Whether what is below a map at a place ships with the page."""
    return place == AT and request in BELOW


def read_below(request: Map) -> tuple[Bifurcation, Rates]:
    """What ships of what is below a map."""
    found, small = json.loads(BELOW[request].read_text(encoding="utf-8"))
    lines = tuple(Line(np.array(spin), np.array(theta), stable) for spin, theta, stable in found.pop("lines"))
    (t, spin, theta, *moments), times = found.pop("life"), found.pop("times")
    life = Life(np.array(t), np.array(spin), np.array(theta), *moments)
    arrays = {name: np.array(values) for name, values in found.items()}
    branches = tuple(Branch(name, *map(np.array, columns)) for name, *columns in small["branches"])
    laws, powers = (tuple(OfLaw(*each) for each in small["laws"]), tuple(Power(*each) for each in small["powers"]))
    return (Bifurcation(lines=lines, times=(times[0], times[1]), life=life, **arrays),
            Rates(branches=branches, laws=laws, powers=powers))  # fmt: skip


def _plain(found: Any) -> Any:
    """Of an array or a dataclass, for JSON."""
    return found.tolist() if isinstance(found, np.ndarray) else vars(found)


def main() -> None:
    for request, path in SHIPPED.items():
        _write(next(level for level in solve(request) if level.finest), path, np.float32)
    for request, path in BELOW.items():
        found = bifurcation(request, AT), rates(request, AT)
        path.write_text(json.dumps(found, default=_plain, separators=(",", ":")) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
