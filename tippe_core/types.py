"""The types of numbers used in the signatures."""

from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
Bools: TypeAlias = NDArray[np.bool_]
Indices: TypeAlias = NDArray[np.intp]
Complex: TypeAlias = NDArray[np.complexfloating]
Scalars: TypeAlias = float | Array  # a number, or an array; several of them broadcast together
Like = TypeVar("Like", bound=Scalars)  # a number if it is given one, an array if an array
# Any, because one formula serves floats, arrays (real or complex) and Decimals.
Number: TypeAlias = Any
Vector: TypeAlias = tuple[Number, Number, Number]
Rim: TypeAlias = tuple[float, float, float]  # a circle about axis 3: radius, height above O, rounding, in R
