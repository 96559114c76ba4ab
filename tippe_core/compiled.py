"""Kernels: plain functions that numba compiles at their first call and stores on disk (kept.py). They run as ordinary
Python if numba is not installed or switched off (NUMBA_DISABLE_JIT=1), and while another thread compiles ahead of time.
"""

import functools
import importlib
import importlib.util
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FunctionType, ModuleType
from typing import Any, TypeVar, cast

from . import kept

Function = TypeVar("Function", bound=Callable[..., Any])

# Nobody calls a kernel as a C function; the code for that would be a good part of what is compiled.
OPTIONS = {"error_model": "numpy", "no_cfunc_wrapper": True}

_making = threading.RLock()
_shared: set[Callable[..., Any]] = set()  # with numba: it may compile them into kernels
_compiler: int | None = None  # the thread that compiles ahead of time, while there is one


def compiled(function: Function) -> Function:
    """Decorator: compiles function at its first call and stores the result on disk. The arguments are numbers, arrays
    and named tuples of them; it runs without the GIL, and dividing by 0 gives inf or nan as in numpy. The functions
    that it calls need no mark: they are compiled into it, and stay as they are for floats, arrays and Decimals."""
    return cast(Function, Kernel(function)) if importlib.util.find_spec("numba") else function


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
    def dispatcher(self) -> Any:
        """numba's dispatcher, or the plain function if numba cannot compile."""
        with _making:  # another thread may have made it meanwhile
            return vars(self).get("dispatcher") or _dispatcher(self.py_func)

    @property
    def _numba_type_(self) -> Any:
        """The attribute by which numba learns how to call an object."""
        return self.dispatcher._numba_type_


def why_not() -> str:
    """Why the kernels run as plain Python; empty if they are compiled."""
    try:
        import numba
    except ImportError as error:  # for example when numpy is too new for it
        return f"numba cannot be imported ({error})"
    return "NUMBA_DISABLE_JIT is set" if numba.config.DISABLE_JIT else ""


def not_kept() -> str:
    """Why the next process will have to compile this process's kernels again; empty if they are stored."""
    if kept.folder() is None:
        return f"no folder can be written to, neither {kept.PACKAGE / '__pycache__'} nor numba's cache"
    return next(filter(None, kept.made.values()), "")


@contextmanager
def ahead() -> Iterator[None]:
    """Context in which this thread compiles while all others run kernels as plain Python, so that nobody waits."""
    global _compiler
    _compiler = threading.get_ident()
    try:
        yield
    finally:
        _compiler = None


def _dispatcher(function: Callable[..., Any]) -> Any:
    if why_not():
        return function
    import numba

    share_called(function)
    dispatcher = numba.njit(nogil=True, **OPTIONS)(function)
    # Private parts; without them, or a folder, each process compiles the kernels anew.
    with suppress(ImportError, AttributeError, RuntimeError):
        _once(dispatcher)
        dispatcher._cache = kept.store()(function)
    return dispatcher


def share_called(function: Callable[..., Any]) -> None:
    """Lets numba compile the functions that this one calls, by their names or as attributes of modules."""
    called, names = function.__globals__, function.__code__.co_names
    modules = [vars(called[name]) for name in names if isinstance(called.get(name), ModuleType)]
    for found in (space.get(name) for name in names for space in (called, *modules)):
        ours = isinstance(found, FunctionType) and found.__module__.partition(".")[0] not in ("numpy", "numba")
        if ours and found not in _shared:
            _shared.add(found)
            importlib.import_module("numba.extending").register_jitable(**OPTIONS)(found)
            share_called(found)


def _once(dispatcher: Any) -> None:
    """Makes one version of a kernel serve all numbers of a type. Otherwise numba compiles a separate version for each
    literal argument in a calling kernel, and separate versions of everything that it calls."""
    from numba.types import unliteral

    resolved = dispatcher.get_call_template

    def template(arguments: tuple[Any, ...], named: dict[str, Any]) -> Any:
        return resolved(tuple(map(unliteral, arguments)), {name: unliteral(kind) for name, kind in named.items()})

    dispatcher.get_call_template = template
