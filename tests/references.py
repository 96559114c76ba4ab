"""Stores the answers of slow oracles in data/<function>.npz: `pytest -n 0 --store` those that are missing there, make
proof (pytest --remake) all of them anew.

The key of an answer contains the arguments and a hash of the oracle with all of the tests' code that it goes through
(fingerprint.py). So with new arguments or a changed oracle the answer is computed, which takes time and gives a
warning; a comment, or another file for the same code, changes nothing.
"""

import functools
import hashlib
import warnings
from dataclasses import astuple, fields, is_dataclass
from pathlib import Path

import numpy as np
from fingerprint import Code, fingerprint

TESTS = Path(__file__).parent
FOLDER = TESTS / "data"
REMAKE = STORE = False  # set by conftest.py


@functools.cache
def oracles():
    """The code of the tests. tippe_core is none of it: an oracle does not depend on it."""
    return Code({path.name: path for path in TESTS.glob("*.py")})


LATER = (
    "z",
    "vz",
    "pivots",
)  # fields of a State or a law that came later: what is stored without them holds at their defaults


def kept(function):
    """Decorates a function of tops, states, laws, numbers and arrays whose result is a tuple of numbers and arrays."""
    file = FOLDER / f"{function.__name__}.npz"
    found = {}  # the stored answers, and "code", the hash of what gave them; with --remake, those that will be stored

    @functools.cache
    def code():
        return fingerprint(function, code=oracles())

    @functools.wraps(function)
    def answered(*given, **named):
        if not found and file.exists() and not REMAKE:
            with np.load(file) as kept:
                found.update(kept)
        key = key_of(code(), text((given, sorted(named.items()))))
        names = sorted((name for name in found if name.startswith(key)), key=lambda name: int(name.split(".")[1]))
        if not names:
            if not STORE:
                warnings.warn(f"{function.__name__}: this answer is not stored; --store stores it", stacklevel=2)
            elif str(found.get("code", code())) != code():
                found.clear()  # nobody asks for the answers of older code
            parts = {f"{key}.{i}": np.asarray(part) for i, part in enumerate(function(*given, **named))}
            found.update(parts, code=np.asarray(code()))
            names = [*parts]
            if STORE:
                np.savez_compressed(file, **found)
        return tuple(found[name][()] for name in names)

    return answered


def key_of(code, arguments):
    return hashlib.sha256(f"{code} {arguments}".encode()).hexdigest()[:16]


def text(given):
    """The arguments of a function as text, with all digits."""
    if isinstance(given, np.ndarray):
        return text(given.tolist())
    if isinstance(given, list | tuple):
        return f"({', '.join(map(text, given))})"
    if is_dataclass(given):
        late = [field.name in LATER and getattr(given, field.name) is field.default for field in fields(given)]
        values = [value for value, left_out in zip(astuple(given), late, strict=True) if not left_out]
        return f"{type(given).__name__}{text(values)}"
    return repr(given.item() if isinstance(given, np.float64) else given)
