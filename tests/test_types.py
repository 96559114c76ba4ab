"""Every public name of tippe_core has type annotations, and the package declares them. (mypy checks that they are
right.)"""

import importlib
import inspect
import pkgutil
from functools import cached_property
from importlib.resources import files
from typing import get_type_hints

import tippe_core

MODULES = [importlib.import_module(module.name) for module in pkgutil.walk_packages(tippe_core.__path__, "tippe_core.")]
SPECIAL = ("__init__", "__call__", "__add__", "__sub__", "__rmul__")


def functions():
    """Every public function, and every public method and property of a public class: (its name, it)."""
    for module in MODULES:
        for name, thing in vars(module).items():
            if name.startswith("_") or getattr(thing, "__module__", "") != module.__name__:
                continue
            if inspect.isfunction(thing):
                yield f"{module.__name__}.{name}", thing
            for inner, part in vars(thing).items() if inspect.isclass(thing) else ():
                if isinstance(part, property):
                    part = part.fget
                elif isinstance(part, cached_property):
                    part = part.func
                part = getattr(part, "__func__", part)  # of a classmethod
                written = getattr(part, "__module__", "") == module.__name__
                if inspect.isfunction(part) and written and (inner in SPECIAL or not inner.startswith("_")):
                    yield f"{module.__name__}.{name}.{inner}", part


def test_every_function_says_its_types():
    untyped = {}
    for name, function in functions():
        wanted = {"return", *inspect.signature(function).parameters} - {"self", "cls"}
        if missing := wanted - {*get_type_hints(function)}:
            untyped[name] = missing
    assert untyped == {}


def test_every_field_says_its_type():
    for thing in filter(inspect.isclass, map(vars(tippe_core).get, tippe_core.__all__)):
        named = getattr(thing, "__dataclass_fields__", None) or getattr(thing, "_fields", ())
        assert {*named} <= {*get_type_hints(thing)}, thing


def test_every_public_function_is_among_those():
    known = [function for _, function in functions()]
    assert all(
        function in known for function in filter(inspect.isfunction, map(vars(tippe_core).get, tippe_core.__all__))
    )


def test_the_package_says_that_it_is_typed():
    assert (files(tippe_core) / "py.typed").is_file()
