"""Linear equations by Gaussian elimination, for kernels."""

import numpy as np

from ..types import Array, Indices


def solve_linear(matrix: Array, right: Array, n: int) -> float:
    """Solves matrix x = right for the first n rows, x into right; returns the determinant."""
    pivots = np.zeros(n, np.int64)
    determinant = decompose(matrix, pivots, n)
    substitute(matrix, pivots, right, n)
    return determinant


def decompose(matrix: Array, pivots: Indices, n: int) -> float:
    """Gaussian elimination of the first n rows, in place, with the rows exchanged in pivots; returns the
    determinant."""
    determinant = 1.0
    for j in range(n):
        best = j
        for r in range(j + 1, n):
            if abs(matrix[r, j]) > abs(matrix[best, j]):
                best = r
        pivots[j] = best
        if best != j:
            determinant = -determinant
            for c in range(j, n):
                matrix[j, c], matrix[best, c] = matrix[best, c], matrix[j, c]
        pivot = matrix[j, j]
        determinant *= pivot
        for r in range(j + 1, n):
            share = matrix[r, j] / pivot
            matrix[r, j] = share
            for c in range(j + 1, n):
                matrix[r, c] -= share * matrix[j, c]
    return determinant


def substitute(matrix: Array, pivots: Indices, right: Array, n: int) -> None:
    """The solution x of matrix x = right, after decompose(), into right."""
    for j in range(n):
        right[j], right[pivots[j]] = right[pivots[j]], right[j]
        for r in range(j + 1, n):
            right[r] -= matrix[r, j] * right[j]
    for j in range(n - 1, -1, -1):
        for c in range(j + 1, n):
            right[j] -= matrix[j, c] * right[c]
        right[j] /= matrix[j, j]
