"""Errors for values that cannot be used: a code, the quantity's name, its value, the allowed range, and a remedy."""

import functools
import inspect
import math
from collections.abc import Callable
from types import NoneType, UnionType
from typing import Any, Self, SupportsFloat, TypeVar, Union, cast, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import ArrayLike

from .types import Array

Function = TypeVar("Function", bound=Callable[..., Any])
NUMERIC = float, complex, ArrayLike  # an annotation with one of these takes numbers

CODES = {
    # any quantity
    "out-of-range": "outside the range that `allowed` gives as a formula",
    "not-finite": "nan, infinity, or no number at all",
    "wrong-kind": "of another type or form than those that `allowed` names as Python does",
    "many": "arrays in the place of numbers",
    "wrong-count": "too many values, or too few",
    "not-whole": "not a whole number of that range",
    "falling": "a value less than the one before it",
    "shapes-differ": "arrays that do not broadcast together",
    "too-large": "a number no top comes near to",
    # tops and what they do
    "too-high": "the centre of mass is not above the contact point",
    "too-flat": "I3 > 2 I1, which no body has",
    "no-times": "times that are no one-dimensional array of finite numbers, or none",
    "no-rows": "no instant of a motion",
    "outside-times": "a time at which the motion is not known",
    "no-motion": "the energy is below the bottom of every well of f",
    "no-direction": "omega_2' on the vertical axis, where axis 2' has no direction",
    "contradiction": "given twice, and not alike",
    "energy-not-resolved": "an energy whose nutation takes almost for ever",
    "start-not-resolved": "a start whose nutation takes almost for ever",
    # friction and contacts
    "profile-in-r": "an outline in metres where the radius is the unit",
    "in-flight": "a top that does not touch the table",
    "below-sliding": "static friction smaller than sliding friction",
    "too-strong": "friction that no normal force balances (Painleve's paradox)",
    "not-followed": "friction under which the equations could not be integrated",
    "beyond-rim": "a tilt at which the sphere has ended",
    "inside-sphere": "an edge that cannot touch the table before the sphere does",
    # bodies
    "too-dense": "more mass than so large a body has",
    "cut-misses": "a cut that does not go through the sphere",
    "stem-too-wide": "a stem wider than the face it stands on",
    "half-a-stem": "a stem without a length, or without a radius",
    "half-a-hole": "a hole without a depth, or without a radius",
    "hole-too-deep": "a hole that goes through the bottom",
    "hole-too-wide": "a hole that leaves no wall around it, or no wider than the stem",
    "half-a-disc": "a disc with a radius, a thickness or a height of 0",
    "disc-sticks-out": "a disc that is not inside the wood",
    "lighter-than-its-disc": "a body of less mass than the steel in it",
    "core-sticks-out": "a core that is not inside the ball",
    "hangs-on-a-point": "a body joined to its peg by a point alone",
    "does-not-fit": "moments of inertia, or a centre of mass, that the body is too small for",
    "several-bodies": "a solid in more than one piece, or in none",
    "meets-in-a-point": "parts of a solid that meet in a point or a circle alone",
    "more-taken-away": "a negative density",
    "outside-sphere": "a zone that is not of its sphere",
    "no-peg": "a solid that does not stand on a sphere about O",
    "inside-unknown": "a body whose inside would have to be known",
    # the measured period of rocking
    "does-not-rock": "a top that does not rock about theta = 0",
    "none-rocks": "a range without a body that rocks",
    "too-fast": "a period shorter than any such top has",
    "reached-twice": "a period that more than one body has",
    "not-reached": "a period that no body has",
    # files
    "file-too-large": "more bytes than a saved top has",
    "not-json": "text that is no JSON document",
    "not-ours": "a document that is no saved top, or of another version",
    "no-object": "something else in the place of an object with fields",
    "unknown-field": "a field that does not belong there",
    "missing-field": "a field that is not there",
    "repeated-field": "a field that is there more than once",
}
"""{code: what is wrong}: every code that a TopError of this package can have."""


class TopError(ValueError):
    """A quantity is outside its allowed range.

    str() is the whole sentence; its parts are the attributes name, value, allowed and remedy. code is a key of CODES,
    for programs that choose their own words. numbers, {name: value}, are the numbers in the sentence: if there are any,
    allowed and remedy are format strings for them, such as "at most {most:g}".
    """

    def __init__(
        self, name: str, value: object, allowed: str, remedy: str = "", *, code: str = "out-of-range", **numbers: Any
    ) -> None:
        self.code, self.name, self.value, self.numbers = code, name, value, numbers
        self._formats = allowed, remedy
        self.allowed, self.remedy = (words.format(**numbers) if numbers else words for words in self._formats)
        said = f"{name} = {shown(value)} is not possible: allowed is {self.allowed}."
        super().__init__(f"{said} {self.remedy}" if self.remedy else said)

    def __reduce__(self) -> tuple[Any, ...]:
        return _anew, (type(self), self.name, self.value, *self._formats, self.code, self.numbers)

    def replaced(self, name: str, value: object, **numbers: Any) -> Self:
        """The same error for a quantity with another name or in another unit.

        Parameters
        ----------
        name : str
            of the quantity
        value : object
            as it was given
        **numbers
            in place of its own, for its texts

        Returns
        -------
        TopError
            of the same class and code
        """
        return type(self)(name, value, *self._formats, code=self.code, **self.numbers | numbers)


class NoMotionError(TopError):
    """The energy is too low: f < 0 at every theta, so no such motion exists. Its code is "no-motion"."""


def _anew(
    kind: type[TopError], name: str, value: object, allowed: str, remedy: str, code: str, numbers: dict[str, Any]
) -> TopError:
    """The error again, as another process takes it."""
    return kind(name, value, allowed, remedy, code=code, **numbers)


def shown(value: object) -> str:
    """A value as it is printed in a sentence."""
    return f"{value:.10g}" if isinstance(value, float) else repr(value)


def finite(name: str, value: SupportsFloat) -> float:
    """value as a float, or a TopError that names it."""
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if isinstance(value, bool) or not math.isfinite(number):
        raise TopError(name, value, "a finite number", code="not-finite")
    return number


def positive(name: str, value: SupportsFloat, zero: bool = False, unit: str = "") -> float:
    """value as a float, or a TopError unless it is above 0, or 0 if that is allowed. unit: as in " (SI)"."""
    number = finite(name, value)
    if number < 0 or (number == 0 and not zero):
        raise TopError(name, number, f"{name} {'>=' if zero else '>'} 0{unit}")
    return number


def single(name: str, value: Any) -> None:
    """Raises a TopError if the value is a record that stands for many."""
    if isinstance(value, Compared) and has_arrays(value):
        raise TopError(name, value, "{kind} of numbers", "These are many: give one; many motions: slide_many().",
                       code="many", kind=type(value).__name__)  # fmt: skip


def checked(function: Function, many: bool = False) -> Function:
    """Decorator: an argument of another kind than its annotation names, or a record that stands for many, raises a
    TopError before anything else does. many: such records are allowed."""
    names, kinds = list(inspect.signature(function).parameters), dict[str, Any]()

    @functools.wraps(function)
    def call(*given: Any, **named: Any) -> Any:
        if not kinds:  # at the first call: not while the modules are imported
            kinds.update(get_type_hints(function))
        for name, value in (*zip(names, given, strict=False), *named.items()):
            of_kind(name, value, kinds.get(name, Any))
            if not many:
                single(name, value)
        return function(*given, **named)

    return cast(Function, call)


def checked_many(function: Function) -> Function:
    """checked() for a function whose arguments broadcast."""
    return checked(function, many=True)


def of_kind(name: str, value: Any, kind: Any) -> None:
    """Raises a TopError if the value is not what an annotation takes: one of the types that it names, or numbers."""
    kind = getattr(kind, "__bound__", None) or kind
    parts = get_args(kind) if get_origin(kind) in (Union, UnionType) else (kind,)
    types = [_origin(part) for part in parts]
    if Any in types or (value is None and NoneType in types):
        return
    if np.ndarray in types or any(part in NUMERIC for part in (kind, *parts)):
        if not isinstance(value, SupportsFloat):  # a list, or no number at all
            numbers(name, value, finite=False)
    elif all(isinstance(each, type) for each in types) and bool not in types and not isinstance(value, tuple(types)):
        raise TopError(name, value, " | ".join(each.__name__ for each in types if each is not NoneType),
                       code="wrong-kind")  # fmt: skip


def _origin(part: Any) -> Any:
    """The class of which an annotation is a special case; NumPy 2.5 has an alias for its arrays."""
    found = get_origin(part) or part
    return get_origin(found.__value__) if hasattr(found, "__value__") else found


class Compared:
    """Equality of frozen records, field by field, whose fields may be arrays."""

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and all(map(np.array_equal, vars(self).values(), vars(other).values()))

    def __hash__(self) -> int:
        return hash(tuple(x.tobytes() if isinstance(x, np.ndarray) else x for x in vars(self).values()))


def read_only(*values: object) -> None:
    """Makes those of the values that are arrays read-only."""
    for value in values:
        if isinstance(value, np.ndarray):
            value.flags.writeable = False


def has_arrays(record: Any) -> bool:
    """Whether a field of a record is an array, so that it stands for many."""
    return any(isinstance(field, np.ndarray | list | tuple) for field in vars(record).values())


def set_arrays(name: str, record: Any, finite: bool = False) -> None:
    """Turns the fields of a frozen record that may stand for many into floats and read-only arrays, or raises a
    TopError if they do not broadcast together. Which of the many are possible is not checked; finite: but all of them
    must be finite."""
    for field, value in vars(record).items():
        if value is not None or finite:
            array = np.asarray(numbers(field, value, finite) + 0.0)  # -0 becomes 0
            read_only(array)
            object.__setattr__(record, field, array if array.ndim else float(array))
    common_shape(
        name, "fields that broadcast together", *(value for value in vars(record).values() if value is not None)
    )


def common_shape(name: str, allowed: str, *values: ArrayLike) -> tuple[int, ...]:
    """The shape to which values broadcast, or a TopError with their shapes."""
    shapes = [np.shape(value) for value in values]
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        raise TopError(name, ", ".join(map(str, shapes)), allowed, code="shapes-differ") from None


def numbers(name: str, values: ArrayLike, finite: bool = True, kinds: str = "iuf") -> Array:
    """values as a new float array, or a TopError that names them; finite: reject nan and infinity; kinds: of dtypes."""
    try:
        array = np.array(values)
    except (TypeError, ValueError, OverflowError):
        array = np.array("")
    if array.dtype.kind not in kinds:
        raise TopError(name, values, "finite numbers", code="not-finite")
    array = array.astype(float)
    if finite and not np.all(np.isfinite(array)):
        raise TopError(name, float(array[~np.isfinite(array)].flat[0]), "a finite number", code="not-finite")
    return array
