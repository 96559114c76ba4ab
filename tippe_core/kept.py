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

    target = cpu_target.target_context.codegen().magic_tuple()  # the processor and its features, as set or detected
    known = hashlib.sha256(repr((sys.version, numba.__version__, np.__version__, target)).encode())
    for path in sorted(PACKAGE.rglob("*.py")):
        known.update(path.relative_to(PACKAGE).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return f"kernels-{sys.implementation.cache_tag}-{target[1]}-{known.hexdigest()[:16]}"


@cache
def folder() -> Path | None:
    """The folder, in the first place in which numba would store that is complete or can be written to: its cache
    directory if one is set, next to the sources, the user's cache. None if there is none, or inside an archive."""
    from numba.core.caching import InTreeCacheLocator, UserProvidedCacheLocator, UserWideCacheLocator

    class Here:
        def get_cache_path(self) -> str:
            return os.path.join(super().get_cache_path(), name())  # type: ignore[misc]

        def ensure_cache_path(self) -> None:
            if not complete(Path(self.get_cache_path())):
                super().ensure_cache_path()  # type: ignore[misc]

        @classmethod
        def get_suitable_cache_subpath(cls, path: str) -> str:
            return "tippe-top-explorer"

    for place in (UserProvidedCacheLocator, InTreeCacheLocator, UserWideCacheLocator):
        if found := type(place.__name__, (Here, place), {}).from_function(complete, __file__):  # type: ignore[attr-defined]
            path = Path(found.get_cache_path())
            used(path)
            return path
    return None


def complete(path: Path | None) -> bool:
    """Whether all that compiling ahead of time produces is there; more may have been added since."""
    try:
        listed = [line.split(" ", 1) for line in (path / COMPLETE).read_text(encoding="utf-8").splitlines()]  # type: ignore[operator]
        return all((path / file).stat().st_size >= int(size) for size, file in listed)  # type: ignore[operator]
    except (OSError, ValueError, TypeError):
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
