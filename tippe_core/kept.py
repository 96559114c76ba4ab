"""Where compiled kernels are kept between two starts: a folder for these sources, this Python, numba and processor.

numba looks only at the file that a kernel stands in; of a callee in another file that changed it would not know, and
call the old one. So a folder's name holds a hash of all sources of tippe_core, and what is found in it is never stale.
"""

import hashlib
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows: there a folder has no lock, and whoever finds it changed compiles again
    fcntl = None  # type: ignore[assignment]

PACKAGE = Path(__file__).parent
COMPLETE = "complete"  # a file that lists what is kept, each with its size, once nothing is missing


@cache
def name() -> str:
    """Of the folder: kernels-<Python>-<processor>-<hash>."""
    import numba
    import numpy as np
    from numba.core.registry import cpu_target

    target = (
        cpu_target.target_context.codegen().magic_tuple()
    )  # system, processor's name and abilities, as told or found
    known = hashlib.sha256(repr((sys.version, numba.__version__, np.__version__, target)).encode())
    for path in sorted(PACKAGE.rglob("*.py")):
        known.update(path.relative_to(PACKAGE).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return f"kernels-{sys.implementation.cache_tag}-{target[1]}-{known.hexdigest()[:16]}"


def places() -> Iterator[Path]:
    """Folders in which it may be: where numba is told to keep its own, else beside the sources and the user's cache."""
    if told := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(told)
        return
    yield PACKAGE / "__pycache__"
    with suppress(RuntimeError):  # a user without a home
        yield _users_cache() / "tippe-top-explorer"


def _users_cache() -> Path:
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches"
    told = os.environ.get("XDG_CACHE_HOME", "")
    return Path(told) if os.path.isabs(told) else Path.home() / ".cache"


@cache
def folder() -> Path | None:
    """The first that is complete, written to or not; else the first that can be written to; None where none can."""
    if not Path(__file__).is_file():  # in an archive, whose files cannot be listed
        return None
    candidates = [place / name() for place in places()]
    return next((each for each in candidates if complete(each)), None) or next(filter(writable, candidates), None)


def complete(path: Path | None) -> bool:
    """Whether all that compiling ahead makes is there; lists may have become longer since."""
    if path is None:
        return False
    try:
        listed = [line.split(" ", 1) for line in (path / COMPLETE).read_text(encoding="utf-8").splitlines()]
        return all((path / file).stat().st_size >= int(size) for size, file in listed)
    except (OSError, ValueError):
        return False


def mark(path: Path) -> None:
    """Says of a folder that nothing is missing."""
    files = sorted(each for each in path.iterdir() if each.suffix in (".nbi", ".nbc"))
    new = path / f"{COMPLETE}.{os.getpid()}"
    new.write_text("".join(f"{each.stat().st_size} {each.name}\n" for each in files), encoding="utf-8")
    new.replace(path / COMPLETE)


def writable(path: Path) -> bool:
    """Whether files can be made in it. Where it is new, what was kept there for other sources or another numba goes."""
    try:
        new = not path.is_dir()
        path.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=path).close()
    except OSError:
        return False
    if new:
        for old in path.parent.glob(path.name.rpartition("-")[0] + "-*"):
            if old != path:
                shutil.rmtree(old, ignore_errors=True)
    return True


@contextmanager
def locked(path: Path, what: str) -> Iterator[None]:
    """For one process at a time, where the system has such locks; they end with the process that holds them."""
    if fcntl is None:
        yield
        return
    with (path / f"{what}.lock").open("w") as lock:
        with suppress(OSError):  # a network's disk that has none
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield
