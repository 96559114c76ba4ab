"""The public names of tippe_core are documented as numpydoc has it: what comes in, goes out, and is raised."""

import functools
import inspect
import re
from types import FunctionType

import pytest

import tippe_core

PUBLIC = {name: thing for name in tippe_core.__all__ if callable(thing := getattr(tippe_core, name))}
FUNCTIONS = [name for name, thing in PUBLIC.items() if inspect.isfunction(thing)]
FIELDS = {name: [field for field in (getattr(thing, "__dataclass_fields__", None) or getattr(thing, "_fields", ()))
                 if not field.startswith("_")] for name, thing in PUBLIC.items()}  # fmt: skip
SECTIONS = ("Parameters", "Attributes", "Returns", "Raises", "Notes")
PLAIN = {"Solid"}  # not made by hand


METHODS = {f"{name}.{method}": of for name, thing in PUBLIC.items() if inspect.isclass(thing)
           for method, of in vars(thing).items() if not method.startswith("_")
           and isinstance(of, FunctionType | classmethod | property | functools.cached_property)}  # fmt: skip


def sections(thing):
    """{section: its text} of a docstring, and "" for what stands before them."""
    parts = re.split(r"^(\w+)\n-+\n", inspect.getdoc(thing), flags=re.MULTILINE)
    found = {"": parts[0], **dict(zip(parts[1::2], parts[2::2], strict=True))}
    assert [name for name in found if name] == [name for name in SECTIONS if name in found]
    return found


def named(text):
    """The names that a section describes, each in a line of its own before its description."""
    lines = text.splitlines()
    heads = [line for line in lines if line and not line.startswith(" ")]
    assert all(line.startswith("    ") for line in lines if line not in heads and line)
    return [name.strip(" *") for head in heads for name in head.split(" : ")[0].split(",")]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_says_what_it_takes_gives_and_raises(name):
    thing, found = PUBLIC[name], sections(PUBLIC[name])
    assert named(found["Parameters"]) == [*inspect.signature(thing).parameters] and found["Returns"].strip()
    assert all(kind in ("TopError", "NoMotionError") for kind in named(found.get("Raises", "")))


@pytest.mark.parametrize("name", METHODS)
def test_a_method_says_what_it_takes_and_gives(name):
    """One without parameters, and a property, says it in a sentence."""
    thing = getattr(METHODS[name], "__func__", METHODS[name])
    takes = (
        [] if isinstance(thing, property | functools.cached_property) else [*inspect.signature(thing).parameters][1:]
    )
    found = sections(thing)
    assert found[""].strip()
    if takes:
        assert named(found["Parameters"]) == takes and found["Returns"].strip()
    assert all(kind in ("TopError", "NoMotionError") for kind in named(found.get("Raises", "")))


@pytest.mark.parametrize("name", [name for name, fields in FIELDS.items() if fields and name not in PLAIN])
def test_a_record_says_what_its_fields_are(name):
    """In one order with them; Attributes may add what is computed from them."""
    thing, fields, found = PUBLIC[name], FIELDS[name], sections(PUBLIC[name])
    said = named(found["Parameters"] if "Parameters" in found else found["Attributes"])
    assert [field for field in fields if field not in said and field != "top"] == []
    assert [each for each in said if each not in fields and not hasattr(thing, each)] == []
