"""Shapes to and from small JSON documents, which may come from anyone."""

import json
from collections.abc import Collection
from dataclasses import MISSING, fields
from typing import Any, TypeAlias

from ..errors import TopError, checked
from .ranges import MOST_PIECES, MOST_POINTS
from .shape import Shape, Turned
from .shapes import KINDS
from .slices import Frustum, Zone
from .solids import Solid

SCHEMA, VERSION, LONGEST = "tippe-top-explorer/top", 1, 65_536  # bytes
Json: TypeAlias = Any  # any JSON value


def names_of(kind: type[Shape]) -> tuple[list[str], list[str]]:
    """The names of the dimensions of a kind of shape, and those of the optional ones, which come last."""
    found = fields(kind)
    return [field.name for field in found], [field.name for field in found if field.default is not MISSING]


def given(shape: Shape) -> dict[str, Json]:
    """{dimension: value in SI} of a shape, without optional ones that have their default."""
    return {field.name: value for field in fields(shape) if (value := getattr(shape, field.name)) != field.default}


@checked
def save_top(shape: Shape) -> str:
    """The shape as a small JSON document.

    Parameters
    ----------
    shape : Shape
        a body of one of the kinds of tippe_core

    Returns
    -------
    str
        its kind, and its dimensions in SI units
    """
    dimensions = given(shape)
    if isinstance(shape, Turned):
        dimensions["solid"] = [
            {"piece": type(piece).__name__, **{field.name: getattr(piece, field.name) for field in fields(piece)}}
            for piece in shape.solid.slices
        ]
    document = {"schema": SCHEMA, "version": VERSION, "kind": type(shape).__name__, "dimensions": dimensions}
    return json.dumps(document, indent=1) + "\n"


@checked
def load_top(text: str | bytes) -> Shape:
    """The shape in a document.

    Parameters
    ----------
    text : str or bytes
        written by save_top(), or like it

    Returns
    -------
    Shape
        the body

    Raises
    ------
    TopError
        naming the field at fault
    """
    if len(text) > LONGEST:
        raise TopError("file", f"{len(text)} bytes", "at most {most} bytes", "A saved top is far smaller.",
                       code="file-too-large", most=LONGEST)  # fmt: skip
    try:
        text = text.decode("utf-8-sig") if isinstance(text, bytes) else text
        # every number is read as a float: an integer of a million digits becomes inf, and is refused
        document = json.loads(text, parse_int=float, parse_constant=float, object_pairs_hook=_without_repeats)
    except TopError:
        raise
    except (ValueError, RecursionError) as error:
        line, column = getattr(error, "lineno", 1), getattr(error, "colno", 1)
        raise TopError("file", "text", "a JSON document", "{why}.", code="not-json", why=str(error)[:120], line=line,
                       column=column) from None  # fmt: skip
    _fields("file", document, ("schema", "version", "kind", "dimensions"))
    for name, wanted in (("schema", SCHEMA), ("version", VERSION)):
        if isinstance(document[name], bool) or document[name] != wanted:
            raise TopError(name, _short(document[name]), repr(wanted), "This is not a top saved by this program.",
                           code="not-ours")  # fmt: skip
    kind = KINDS.get(document["kind"]) if isinstance(document["kind"], str) else None
    if kind is None:
        raise TopError("kind", _short(document["kind"]), " | ".join(KINDS), code="wrong-kind")
    dimensions = document["dimensions"]
    _fields("dimensions", dimensions, *names_of(kind))
    for name, value in dimensions.items():
        if name == "points" or (name == "density" and isinstance(value, list)):
            _numbers(name, value)
        elif name == "solid":
            dimensions[name] = _solid(value)
        else:
            _number(name, value)
    return kind(**{name: _frozen(value) for name, value in dimensions.items()})


def _solid(pieces: Json) -> Solid:
    if not isinstance(pieces, list) or not 1 <= len(pieces) <= MOST_PIECES:
        raise TopError(
            "solid", _short(pieces), "a list of {count} pieces", code="wrong-count", count=f"1 - {MOST_PIECES}"
        )
    slices = []
    for index, piece in enumerate(pieces):
        name = f"solid[{index}]"
        word = piece.get("piece") if isinstance(piece, dict) else None
        kinds: dict[str, type[Zone | Frustum]] = {"Zone": Zone, "Frustum": Frustum}
        kind = kinds.get(word) if isinstance(word, str) else None
        if kind is None:
            raise TopError(f"{name}.piece", _short(word), "Zone | Frustum", code="wrong-kind")
        _fields(name, piece, ["piece", *(field.name for field in fields(kind))])
        sizes = {key: value for key, value in piece.items() if key != "piece"}
        for key, value in sizes.items():
            _number(f"{name}.{key}", value)
        try:
            slices.append(kind(**sizes))
        except TopError as error:
            raise error.replaced(f"{name}.{error.name}", error.value) from None
    return Solid(tuple(slices))


def _without_repeats(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
    names = [name for name, _ in pairs]
    for name in names:
        if names.count(name) > 1:
            raise TopError(_short(name), "given more than once", "one value", code="repeated-field")
    return dict(pairs)


def _fields(name: str, record: Json, wanted: Collection[str], optional: Collection[str] = ()) -> None:
    if not isinstance(record, dict):
        raise TopError(name, _short(record), "an object with {fields}", code="no-object", fields=", ".join(wanted))
    for field in record:
        if field not in wanted:
            raise TopError(_short(field), "unknown field", "{fields}", "Remove it from {record}.",
                           code="unknown-field", fields=", ".join(wanted), record=name)  # fmt: skip
    for field in wanted:
        if field not in record and field not in optional:
            raise TopError(field, "missing", "{fields}", "Add it to {record}.", code="missing-field",
                           fields=", ".join(wanted), record=name)  # fmt: skip


def _number(name: str, value: Json) -> None:
    if not isinstance(value, float):
        raise TopError(name, _short(value), "a number", code="not-finite")


def _numbers(name: str, values: Json) -> None:
    """values as a number, a list of numbers, or a list of lists of numbers."""
    if not isinstance(values, list) or not 1 <= len(values) <= MOST_POINTS:
        raise TopError(name, _short(values), "a list of {count}", code="wrong-count", count=f"1 - {MOST_POINTS}")
    for index, value in enumerate(values):
        for number in value if name == "points" and isinstance(value, list) else [value]:
            _number(f"{name}[{index}]", number)


def _frozen(value: Json) -> Json:
    return tuple(_frozen(item) for item in value) if isinstance(value, list) else value


def _short(value: Json) -> Json:
    """An untrusted value, shortened for an error message."""
    shown = value if isinstance(value, (str, float, bool, type(None))) else type(value).__name__
    return shown[:40] if isinstance(shown, str) else shown
