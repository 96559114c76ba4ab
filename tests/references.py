"""Stores the answers of slow oracles in data/<function>.npz; make proof (pytest --remake) computes them again.

The key of an answer contains the arguments and the source code of the oracles. So with new arguments or a changed
oracle, even a changed comment in it, the answer is computed, which takes time and gives a warning.
"""

import functools
import hashlib
import inspect
import warnings
from dataclasses import astuple, is_dataclass
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent / "data"
REMAKE = False  # set by conftest.py


def kept(*oracles):
    """Decorates a function of tops, states, laws, numbers and arrays whose result is a tuple of numbers and arrays."""

    def decorate(function):
        file = FOLDER / f"{function.__name__}.npz"
        found = {}  # the stored answers; with --remake, those that will be stored

        @functools.cache
        def code():
            return "".join(inspect.getsource(part) for part in (function, *oracles))

        @functools.wraps(function)
        def answered(*given, **named):
            if not found and file.exists() and not REMAKE:
                with np.load(file) as kept:
                    found.update(kept)
            key = hashlib.sha256(f"{code()} {text((given, sorted(named.items())))}".encode()).hexdigest()[:16]
            names = sorted((name for name in found if name.startswith(key)), key=lambda name: int(name.split(".")[1]))
            if not names:
                if not REMAKE:
                    warnings.warn(f"{function.__name__}: this answer is not stored; make proof stores it", stacklevel=2)
                parts = {f"{key}.{i}": np.asarray(part) for i, part in enumerate(function(*given, **named))}
                found.update(parts)
                names = [*parts]
                if REMAKE:
                    np.savez_compressed(file, **found)
            return tuple(found[name][()] for name in names)

        return answered

    return decorate


def text(given):
    """The arguments of a function as text, with all digits."""
    if isinstance(given, np.ndarray):
        return text(given.tolist())
    if isinstance(given, list | tuple):
        return f"({', '.join(map(text, given))})"
    if is_dataclass(given):
        return f"{type(given).__name__}{text(astuple(given))}"
    return repr(given.item() if isinstance(given, np.float64) else given)
