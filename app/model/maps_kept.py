"""Maps that were made, for all visitors: the newest in memory, and as files beside the kernels that made them."""

import hashlib
import threading
from collections import OrderedDict
from contextlib import suppress
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from app.model.maps import UNITS, Map
from app.model.maps_solving import Level
from tippe_core import kept

IN_MEMORY, AS_FILES = 64, 400  # of 48 x 48 cells each takes some 150 kB
_memory: OrderedDict[Map, Level] = OrderedDict()
_changing = threading.Lock()


def recall(asked: Map) -> Level | None:
    """The whole map, if it was made before with these sources of tippe_core."""
    with _changing:
        level = _memory.get(asked)
        if level is not None:
            _memory.move_to_end(asked)
            return level
    path = _path(asked)
    if path is None or not path.exists():
        return None
    with suppress(OSError, ValueError, KeyError, BadZipFile), np.load(path) as file:
        x, y = asked.centres(asked.cells)
        level = Level(asked=asked, x=x, y=y, end=file["end"], columns={name: file[name] for name in UNITS})
        _remember(level)
        return level
    return None


def keep(level: Level) -> None:
    """A whole map; the oldest files go."""
    _remember(level)
    path = _path(level.asked)
    if path is None:
        return
    with suppress(OSError):
        path.parent.mkdir(exist_ok=True)
        new = path.with_suffix(f".{threading.get_ident()}.new")
        with new.open("wb") as file:
            np.savez_compressed(file, allow_pickle=False, end=level.end, **level.columns)
        new.replace(path)
        for old in sorted(path.parent.glob("*.npz"), key=lambda each: each.stat().st_mtime)[:-AS_FILES]:
            old.unlink(missing_ok=True)


def _remember(level: Level) -> None:
    with _changing:
        _memory[level.asked] = level
        while len(_memory) > IN_MEMORY:
            _memory.popitem(last=False)


def _path(asked: Map) -> Path | None:
    """By content; the folder's own name says which sources of tippe_core computed it."""
    try:
        folder = kept.folder()
    except ImportError:  # no numba: nothing is kept
        return None
    return folder and folder / "maps" / f"{hashlib.sha256(repr(asked).encode()).hexdigest()[:32]}.npz"
