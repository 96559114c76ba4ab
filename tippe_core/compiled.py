"""Kernels: plain functions that numba compiles where it is installed, and that run as Python where it is not."""

from collections.abc import Callable
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])

try:
    import numba
    import numba.extending
except ImportError:
    numba = None


def compiled(function: Function) -> Function:
    """function, compiled at its first call and kept on disk. It takes numbers, arrays and named tuples of them, holds
    no lock of Python's while it runs, and divides by 0 as numpy does."""
    if numba is None:
        return function
    return numba.njit(cache=True, nogil=True, error_model="numpy")(function)


def shared_with_kernels(function: Function) -> Function:
    """function as it is, for floats, arrays and Decimals; kernels may call it too, and it is compiled into them."""
    if numba is None:
        return function
    return numba.extending.register_jitable(function)
