"""Where compiled kernels are stored between runs: one folder for each set of sources, Python, numba and processor.

numba checks only the file in which a kernel is defined: it would not notice that a function called from another file
had changed, and would run the old one. So the folder's name contains a hash of all sources of tippe_core, and nothing
in it is ever stale. Folders of other versions may be in use too, now or after a roll-back: they stay, until nothing has
used them for UNUSED days and another version has compiled all that it needs.
"""

import hashlib
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows: no lock on folders; a process that finds the folder changed compiles again
    fcntl = None  # type: ignore[assignment]

PACKAGE = Path(__file__).parent
COMPLETE = "complete"  # this file lists the stored files and their sizes, once nothing is missing
FOLDERS = f"kernels-*-*-{16 * '[0-9a-f]'}"  # those of all versions
UNUSED = 30  # days after which a folder may be removed


@cache
def name() -> str:
    """The folder's name: kernels-<Python>-<processor>-<hash>."""
    import numba
    import numpy as np
    from numba.core.registry import cpu_target

    target = (
        cpu_target.target_context.codegen().magic_tuple()
    )  # system, processor's name and features, as set or detected
    known = hashlib.sha256(repr((sys.version, numba.__version__, np.__version__, target)).encode())
    for path in sorted(PACKAGE.rglob("*.py")):
        known.update(path.relative_to(PACKAGE).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return f"kernels-{sys.implementation.cache_tag}-{target[1]}-{known.hexdigest()[:16]}"


def places() -> Iterator[Path]:
    """Candidate folders: numba's cache directory if one is set, else next to the sources, then the user's cache."""
    if told := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(told)
        return
    yield PACKAGE / "__pycache__"
    with suppress(RuntimeError):  # a user without a home directory
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
    """The first candidate that is complete, writable or not; else the first writable one; None if there is none."""
    if not Path(__file__).is_file():  # inside an archive, where files cannot be listed
        return None
    candidates = [place / name() for place in places()]
    found = next(filter(complete, candidates), None) or next(filter(writable, candidates), None)
    if found:
        used(found)
    return found


def complete(path: Path | None) -> bool:
    """Whether all that compiling ahead of time produces is there; more may have been added since."""
    if path is None:
        return False
    try:
        listed = [line.split(" ", 1) for line in (path / COMPLETE).read_text(encoding="utf-8").splitlines()]
        return all((path / file).stat().st_size >= int(size) for size, file in listed)
    except (OSError, ValueError):
        return False


def mark(path: Path) -> None:
    """Marks a folder as complete."""
    files = sorted(each for each in path.iterdir() if each.suffix in (".nbi", ".nbc"))
    new = path / f"{COMPLETE}.{os.getpid()}"
    new.write_text("".join(f"{each.stat().st_size} {each.name}\n" for each in files), encoding="utf-8")
    new.replace(path / COMPLETE)


def used(path: Path) -> None:
    """Dates the folder today. Where that is not allowed, nothing can be removed either."""
    with suppress(OSError):
        os.utime(path)


def remove_unused(own: Path) -> None:
    """Removes the folders beside this one that nothing has used for UNUSED days. The date of one that is being compiled
    changes with each kernel."""
    for each in set(own.parent.glob(FOLDERS)) - {own}:
        with suppress(OSError):
            if time.time() - each.stat().st_mtime > UNUSED * 86400:
                shutil.rmtree(each)


def writable(path: Path) -> bool:
    """Whether files can be created in it; it is made if it is missing."""
    try:
        path.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=path).close()
    except OSError:
        return False
    return True


@contextmanager
def locked(path: Path, what: str) -> Iterator[None]:
    """Context for one process at a time, on systems that have such locks; a lock ends with the process that holds
    it."""
    if fcntl is None:
        yield
        return
    with (path / f"{what}.lock").open("w") as lock:
        with suppress(OSError):  # a network drive without locks
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield
