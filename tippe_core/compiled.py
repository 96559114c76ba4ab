"""Kernels: plain functions that numba compiles at their first call, and keeps (kept.py). They run as Python where numba
is not installed or is told not to compile (NUMBA_DISABLE_JIT=1), and while another thread compiles ahead.
"""

import functools
import hashlib
import importlib.util
import os
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, TypeAlias, TypeVar, cast

from . import kept

Function = TypeVar("Function", bound=Callable[..., Any])
Numba: TypeAlias = Any  # a module, a dispatcher or a type of numba's, which has no types of its own

_INSTALLED = importlib.util.find_spec("numba") is not None  # which does not import it
_making = threading.RLock()
_shared: list[Callable[..., Any]] = []  # of which numba has not been told yet
_compiler: int | None = None  # the thread that compiles ahead, while there is one
made: list[str] = []  # kernels that this process had to compile, each with the types of its arguments
_unwritten = ""  # why the last kernel that could not be written could not


def compiled(function: Function) -> Function:
    """function, compiled at its first call and kept on disk. It takes numbers, arrays and named tuples of them, holds
    no lock of Python's while it runs, and divides by 0 as numpy does."""
    return cast(Function, Kernel(function)) if _INSTALLED else function


def shared_with_kernels(function: Function) -> Function:
    """function as it is, for floats, arrays and Decimals; kernels may call it too, and it is compiled into them."""
    _shared.append(function)
    return function


class Kernel:
    """A function that stands in for its compiled self, from Python and from other kernels. numba is not imported
    before one is called: with its types it takes 0.3 s and 100 MB."""

    def __init__(self, function: Callable[..., Any]) -> None:
        functools.update_wrapper(self, function)
        self.py_func = function  # as numba's own are called

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        if _compiler is not None and _compiler != threading.get_ident():
            return self.py_func(*arguments, **named)
        return self.dispatcher(*arguments, **named)

    @functools.cached_property
    def dispatcher(self) -> Numba:
        """numba's; where it cannot compile, the function itself."""
        with _making:
            if "dispatcher" not in self.__dict__:  # that another thread has made meanwhile
                self.__dict__["dispatcher"] = _dispatcher(self.py_func)
            return self.__dict__["dispatcher"]

    @property
    def _numba_type_(self) -> Numba:
        """What numba asks an object for, to know how to call it."""
        return self.dispatcher._numba_type_


def why_not() -> str:
    """Why kernels run as Python; empty where they are compiled."""
    numba = _numba()
    if isinstance(numba, ImportError):
        return f"numba cannot be imported ({numba})"
    return "NUMBA_DISABLE_JIT is set" if numba.config.DISABLE_JIT else ""


def not_kept() -> str:
    """Why kernels of this process are compiled again by the next one; empty where they are kept."""
    if kept.folder() is None:
        return "no folder can be written to: " + ", ".join(map(str, kept.places()))
    return _unwritten


@contextmanager
def ahead() -> Iterator[None]:
    """While it lasts this thread compiles, and all others run kernels as Python: nobody waits for a compiler."""
    global _compiler
    _compiler = threading.get_ident()
    try:
        yield
    finally:
        _compiler = None


@functools.cache
def _numba() -> Numba:
    """The module, or the ImportError that it raises: with a numpy too new for it, say."""
    try:
        return importlib.import_module("numba")
    except ImportError as error:
        return error


def _dispatcher(function: Callable[..., Any]) -> Numba:
    if why_not():
        return function
    while _shared:
        importlib.import_module("numba.extending").register_jitable(error_model="numpy")(_shared.pop())
    dispatcher = _numba().njit(nogil=True, error_model="numpy")(function)
    if kept.folder() is not None and Path(function.__code__.co_filename).is_file():
        # Private: where another numba has none of these, kernels are compiled anew by each process.
        with suppress(ImportError, AttributeError):
            dispatcher._cache = _cache()(function)
    with suppress(ImportError, AttributeError):
        _once(dispatcher)
    return dispatcher


def _once(dispatcher: Numba) -> None:
    """One kernel for all numbers of a type that other kernels call it with: numba would make its own for each literal,
    and with it its own of all that it calls."""
    from numba.types import unliteral

    resolved = dispatcher.get_call_template

    def template(arguments: tuple[Numba, ...], named: dict[str, Numba]) -> Numba:
        return resolved(tuple(map(unliteral, arguments)), {name: unliteral(kind) for name, kind in named.items()})

    dispatcher.get_call_template = template


@functools.cache
def _cache() -> Numba:
    """numba's cache in the folder of kept.py.

    numba's own wants to write wherever it reads, so on a read-only system it raises at import; and what it cannot read
    or write it raises in the call that happened to need it.
    """
    from numba.core.caching import CompileResultCacheImpl, FunctionCache

    class Implementation(CompileResultCacheImpl):  # type: ignore[misc]
        _locator_classes = (_Locator,)

    class Cache(FunctionCache):  # type: ignore[misc]
        _impl_class = Implementation

        def load_overload(self, signature: Numba, context: Numba) -> Numba:
            try:
                found = super().load_overload(signature, context)
            except Exception:  # a file cut short raises anything; the list of files is begun anew
                with suppress(OSError):
                    self.flush()
                return None
            if found is None:
                return None
            # Two processes that write at once, without locks, may give one name to the code for two signatures.
            asked: Numba = getattr(signature, "args", signature)
            return found if tuple(found.signature.args) == tuple(asked) else None

        def save_overload(self, signature: Numba, result: Numba) -> None:
            global _unwritten
            made.append(f"{self._py_func.__module__}.{self._py_func.__qualname__}{signature}")
            try:
                with kept.locked(Path(self.cache_path), "write"):
                    super().save_overload(signature, result)
            except Exception as error:  # a read-only system, a full disk, a folder that somebody took away
                _unwritten = str(error)

    return Cache


class _Locator:
    """What numba asks where a function's files are, and whether they are of its source as it is."""

    def __init__(self, path: str, line: int) -> None:
        self._py_file, self._line = path, line

    @classmethod
    def from_function(cls, function: Callable[..., Any], path: str) -> "_Locator":
        return cls(path, function.__code__.co_firstlineno)

    def get_cache_path(self) -> str:
        return str(kept.folder())

    def ensure_cache_path(self) -> None:
        """Nothing: folder() has made it."""

    def get_source_stamp(self) -> bytes:
        """Of tippe_core the folder's name tells; of a kernel elsewhere, its file."""
        return hashlib.sha256(Path(self._py_file).read_bytes()).digest()

    def get_disambiguator(self) -> str:
        """Two files of one name may have functions of one name."""
        path = os.path.relpath(self._py_file, kept.PACKAGE)
        return f"{hashlib.sha256(path.encode()).hexdigest()[:8]}-{self._line}"
