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
from typing import Any  # also of what numba has, which ships no annotations

with suppress(ImportError):  # Windows: no lock on folders; a process that finds the folder changed compiles again
    import fcntl

PACKAGE = Path(__file__).parent
COMPLETE = "complete"  # this file lists the stored files and their sizes, once nothing is missing
FOLDERS = f"kernels-*-*-{16 * '[0-9a-f]'}"  # those of all versions
UNUSED = 30  # days after which a folder may be removed
made: dict[str, str] = {}  # kernels that this process had to compile, with their types, and why one could not be stored


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


class Here:
    """One folder for the kernels of all files, in each of numba's places; if it is complete, it need not be
    writable."""

    @classmethod
    def from_function(cls, function: Any, file: str) -> Any:
        if Path(file).is_file() and (found := super().from_function(function, __file__)):  # type: ignore[misc]
            found._py_file = file
            return found
        return None

    @classmethod
    def get_suitable_cache_subpath(cls, path: str) -> str:
        return "tippe-top-explorer"

    def get_cache_path(self) -> str:
        return os.path.join(super().get_cache_path(), name())  # type: ignore[misc]

    def ensure_cache_path(self) -> None:
        if not complete(Path(self.get_cache_path())):
            super().ensure_cache_path()  # type: ignore[misc]

    def get_disambiguator(self) -> str:
        return f"{Path(self._py_file).parent.name}-{self._lineno}"  # type: ignore[attr-defined]


@cache
def store() -> Any:
    """numba's cache of one kernel, as a class. Its own makes a call fail that needs a file which cannot be read or
    written."""
    from numba.core import caching

    places = caching.UserProvidedCacheLocator, caching.InTreeCacheLocator, caching.UserWideCacheLocator

    class Implementation(caching.CompileResultCacheImpl):  # type: ignore[misc]
        _locator_classes = tuple(type(place.__name__, (Here, place), {}) for place in places)

    class Store(caching.FunctionCache):  # type: ignore[misc]
        _impl_class = Implementation

        def load_overload(self, signature: Any, context: Any) -> Any:
            try:
                found = super().load_overload(signature, context)
            except Exception:  # a truncated file may raise anything; start a new index
                with suppress(OSError):
                    self.flush()
                return None
            # Two processes that write at the same time, without locks, may give the code of two signatures one name.
            asked = getattr(signature, "args", signature)
            return found if found is not None and tuple(found.signature.args) == tuple(asked) else None

        def save_overload(self, signature: Any, result: Any) -> None:
            kernel = f"{self._py_func.__module__}.{self._py_func.__qualname__}{signature}"
            made[kernel] = ""
            try:
                with locked(Path(self.cache_path), "write"):
                    super().save_overload(signature, result)
            except Exception as error:  # a read-only system, a full disk, a deleted folder
                made[kernel] = str(error)

    return Store


@cache
def folder() -> Path | None:
    """The folder, in the first of numba's places that is complete or can be written to: its cache directory if one is
    set, next to the sources, the user's cache. None if there is none, or inside an archive."""
    try:
        path = Path(store()(complete).cache_path)
    except RuntimeError:
        return None
    used(path)
    return path


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
    with (path / f"{what}.lock").open("w") as lock:
        with suppress(OSError, NameError):  # a network drive without locks; no fcntl
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield
