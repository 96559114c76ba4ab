"""Kernels: plain functions that numba compiles at their first call and stores on disk (kept.py). They run as ordinary
Python if numba is not installed or switched off (NUMBA_DISABLE_JIT=1), and while another thread compiles ahead of time.
"""

import functools
import hashlib
import importlib.util
import os
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any, TypeAlias, TypeVar, cast

from . import kept

Function = TypeVar("Function", bound=Callable[..., Any])
Numba: TypeAlias = Any  # a module, a dispatcher or a type of numba, which ships no annotations

_INSTALLED = importlib.util.find_spec("numba") is not None  # without importing it
_making = threading.RLock()
_shared: set[Callable[..., Any]] = set()  # with numba: it may compile them into kernels
_compiler: int | None = None  # the thread that compiles ahead of time, while there is one
made: list[str] = []  # kernels that this process had to compile, each with the types of its arguments
_unwritten: dict[str, str] = {}  # kernels that could not be stored, and why


def compiled(function: Function) -> Function:
    """Decorator: compiles function at its first call and stores the result on disk. The arguments are numbers, arrays
    and named tuples of them; it runs without the GIL, and dividing by 0 gives inf or nan as in numpy. The functions
    that it calls need no mark: they are compiled into it, and stay as they are for floats, arrays and Decimals."""
    return cast(Function, Kernel(function)) if _INSTALLED else function


class Kernel:
    """A stand-in for the compiled function, callable from Python and from other kernels. numba is imported only when
    the first one is called: the import takes 0.3 s and 100 MB."""

    def __init__(self, function: Callable[..., Any]) -> None:
        functools.update_wrapper(self, function)
        self.py_func = function  # the name that numba uses

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        if _compiler is not None and _compiler != threading.get_ident():
            return self.py_func(*arguments, **named)
        return self.dispatcher(*arguments, **named)

    @functools.cached_property
    def dispatcher(self) -> Numba:
        """numba's dispatcher, or the plain function if numba cannot compile."""
        with _making:
            if "dispatcher" not in self.__dict__:  # another thread may have made it meanwhile
                self.__dict__["dispatcher"] = _dispatcher(self.py_func)
            return self.__dict__["dispatcher"]

    @property
    def _numba_type_(self) -> Numba:
        """The attribute by which numba learns how to call an object."""
        return self.dispatcher._numba_type_


def why_not() -> str:
    """Why the kernels run as plain Python; empty if they are compiled."""
    numba = _numba()
    if isinstance(numba, ImportError):
        return f"numba cannot be imported ({numba})"
    return "NUMBA_DISABLE_JIT is set" if numba.config.DISABLE_JIT else ""


def not_kept() -> str:
    """Why the next process will have to compile this process's kernels again; empty if they are stored."""
    if kept.folder() is None:
        return f"no folder can be written to, neither {kept.PACKAGE / '__pycache__'} nor numba's cache"
    return next(iter(_unwritten.values()), "")


@contextmanager
def ahead() -> Iterator[None]:
    """Context in which this thread compiles while all others run kernels as plain Python, so that nobody waits."""
    global _compiler
    _compiler = threading.get_ident()
    try:
        yield
    finally:
        _compiler = None


@functools.cache
def _numba() -> Numba:
    """The module numba, or the ImportError that it raises, for example when numpy is too new for it."""
    try:
        return importlib.import_module("numba")
    except ImportError as error:
        return error


def _dispatcher(function: Callable[..., Any]) -> Numba:
    if why_not():
        return function
    share_called(function)
    dispatcher = _numba().njit(nogil=True, error_model="numpy")(function)
    with suppress(ImportError, AttributeError):  # private parts; without them each process compiles the kernels anew
        if kept.folder() is not None and Path(function.__code__.co_filename).is_file():
            dispatcher._cache = _cache()(function)
        _once(dispatcher)
    return dispatcher


def share_called(function: Callable[..., Any]) -> None:
    """Lets numba compile the functions that this one calls, by their names or as attributes of modules."""
    called, names = function.__globals__, function.__code__.co_names
    modules = [vars(called[name]) for name in names if isinstance(called.get(name), ModuleType)]
    for found in (space.get(name) for name in names for space in (called, *modules)):
        ours = isinstance(found, FunctionType) and found.__module__.partition(".")[0] not in ("numpy", "numba")
        if ours and found not in _shared:
            _shared.add(found)
            importlib.import_module("numba.extending").register_jitable(error_model="numpy")(found)
            share_called(found)


def _once(dispatcher: Numba) -> None:
    """Makes one version of a kernel serve all numbers of a type. Otherwise numba compiles a separate version for each
    literal argument in a calling kernel, and separate versions of everything that it calls."""
    from numba.types import unliteral

    resolved = dispatcher.get_call_template

    def template(arguments: tuple[Numba, ...], named: dict[str, Numba]) -> Numba:
        return resolved(tuple(map(unliteral, arguments)), {name: unliteral(kind) for name, kind in named.items()})

    dispatcher.get_call_template = template


@functools.cache
def _cache() -> Numba:
    """numba's cache, in the folder of kept.py: its own makes a call fail that needs a file which cannot be read or
    written."""
    from numba.core.caching import CompileResultCacheImpl, FunctionCache, InTreeCacheLocator

    class Locator(InTreeCacheLocator):  # type: ignore[misc]
        def get_cache_path(self) -> str:
            return str(kept.folder())

        def ensure_cache_path(self) -> None:
            """Nothing to do: folder() has created it."""

        def get_disambiguator(self) -> str:
            """Tells apart functions of the same name in files of the same name."""
            path = os.path.relpath(self._py_file, kept.PACKAGE)
            return f"{hashlib.sha256(path.encode()).hexdigest()[:8]}-{self._lineno}"

    class Implementation(CompileResultCacheImpl):  # type: ignore[misc]
        _locator_classes = (Locator,)

    class Cache(FunctionCache):  # type: ignore[misc]
        _impl_class = Implementation

        def load_overload(self, signature: Numba, context: Numba) -> Numba:
            try:
                found = super().load_overload(signature, context)
            except Exception:  # a truncated file may raise anything; start a new index
                with suppress(OSError):
                    self.flush()
                return None
            # Two processes that write at the same time, without locks, may give the code of two signatures one name.
            asked: Numba = getattr(signature, "args", signature)
            return found if found is not None and tuple(found.signature.args) == tuple(asked) else None

        def save_overload(self, signature: Numba, result: Numba) -> None:
            kernel = f"{self._py_func.__module__}.{self._py_func.__qualname__}{signature}"
            made.append(kernel)
            try:
                with kept.locked(Path(self.cache_path), "write"):
                    super().save_overload(signature, result)
                _unwritten.pop(kernel, None)
            except Exception as error:  # a read-only system, a full disk, a deleted folder
                _unwritten[kernel] = str(error)

    return Cache
