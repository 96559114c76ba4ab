"""What slow oracles have found, kept: data/<function>.npz, remade by make proof (pytest --remake).

A function with @kept(oracle, ...) is asked for its answer once. It is looked up by the numbers it is given and by the
code of the oracles, so another start or a changed oracle has no answer yet; then it is computed, which takes the
oracle's time and is said among the warnings.
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
    """Decorates a function of tops, states, laws, numbers and arrays; it returns a tuple of numbers, words, arrays."""

    def decorate(function):
        file = FOLDER / f"{function.__name__}.npz"
        found = {}  # what is kept, and in a remake what will be

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
                    warnings.warn(f"{function.__name__}: no such answer is kept; make proof keeps it", stacklevel=2)
                parts = {f"{key}.{i}": np.asarray(part) for i, part in enumerate(function(*given, **named))}
                found.update(parts)
                names = [*parts]
                if REMAKE:
                    np.savez_compressed(file, **found)
            return tuple(found[name][()] for name in names)

        return answered

    return decorate


def text(given):
    """All digits of what a function is given."""
    if isinstance(given, np.ndarray):
        return text(given.tolist())
    if isinstance(given, list | tuple):
        return f"({', '.join(map(text, given))})"
    if is_dataclass(given):
        return f"{type(given).__name__}{text(astuple(given))}"
    return repr(given.item() if isinstance(given, np.float64) else given)
