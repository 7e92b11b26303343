"""Lowest eigenpairs of K v = lambda M v in 40-digit arithmetic, for the test oracle.

The conditioning of the beam's matrices is about 1e13: double precision loses the low modes. Here
K + s M is factored as a banded L D L^T in decimal arithmetic, followed by block inverse iteration
with Rayleigh-Ritz, so that nothing is lost to rounding.
"""

from __future__ import annotations

from decimal import Decimal, localcontext

import numpy as np
from scipy.linalg import eigh

DIGITS = 40
ITERATIONS = 40
TURN = 1e-12  # rad: how far a converged mode may still turn in one iteration
SHIFT = 30.0  # rad^2/s^2: K + SHIFT M is positive definite, rigid-body modes included


def to_decimal(array: np.ndarray) -> np.ndarray:
    """The same numbers, exactly, as Decimal objects."""
    return np.vectorize(lambda value: Decimal(float(value)), otypes=[object])(array)


def _bands(matrix: dict, size: int, width: int) -> list[np.ndarray]:
    """Diagonals of a symmetric matrix: bands[d][j] is its element (j + d, j)."""
    bands = [np.full(size - d, Decimal(0), dtype=object) for d in range(width + 1)]
    for (row, column), value in matrix.items():
        bands[row - column][column] = value
    return bands


def _times(bands: list[np.ndarray], block: np.ndarray) -> np.ndarray:
    """Symmetric banded matrix times a block of vectors."""
    product = bands[0][:, None] * block
    for d in range(1, len(bands)):
        product[d:] += bands[d][:, None] * block[:-d]
        product[:-d] += bands[d][:, None] * block[d:]
    return product


def _lowest(
    stiff: dict, mass: dict, start: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """The work of `lowest`, in the current decimal context."""
    size = len(start)
    width = max(row - column for row, column in stiff)
    k, m = _bands(stiff, size, width), _bands(mass, size, width)
    factor = [list(a + Decimal(SHIFT) * b) for a, b in zip(k, m, strict=True)]
    for j in range(size):
        reach = min(width, size - 1 - j)
        ratios = [factor[d][j] / factor[0][j] for d in range(1, reach + 1)]
        for a in range(1, reach + 1):
            for b in range(a, reach + 1):
                factor[b - a][j + a] -= ratios[a - 1] * factor[b][j]
        for d in range(1, reach + 1):
            factor[d][j] = ratios[d - 1]

    def solve(block: np.ndarray) -> np.ndarray:
        for j in range(size):
            for d in range(1, min(width, size - 1 - j) + 1):
                block[j + d] -= factor[d][j] * block[j]
        for j in reversed(range(size)):
            block[j] /= factor[0][j]
            for d in range(1, min(width, size - 1 - j) + 1):
                block[j] -= factor[d][j] * block[j + d]
        return block

    block = to_decimal(start)
    for _ in range(ITERATIONS):
        before = block[:, 2:count]
        load = _times(m, block)
        block = solve(load.copy())
        # Rayleigh-Ritz on the inverse: largest values first, which favours the wanted modes.
        gram = (block.T @ _times(m, block)).astype(float)
        inverse = (block.T @ load).astype(float)
        scale = 1.0 / np.sqrt(np.diag(inverse))
        values, turn = eigh(gram * np.outer(scale, scale), inverse * np.outer(scale, scale))
        turn = (scale[:, None] * turn / np.sqrt(values))[:, ::-1]
        block = block @ to_decimal(turn)
        # Converged once no elastic mode turns any more, in the metric of M.
        weighted = _times(m, block[:, :count])
        norm = (block[:, :count] * weighted).sum(axis=0)
        earlier = (before * _times(m, before)).sum(axis=0)
        cosine = (weighted[:, 2:] * before).sum(axis=0) ** 2 / norm[2:] / earlier
        if max(float(abs(1 - entry)) for entry in cosine) < TURN**2:
            break
    else:
        raise ArithmeticError("the inverse iteration has not converged")
    block = block[:, :count]
    values = ((block * _times(k, block)).sum(axis=0) / norm).astype(float)
    vectors = (block / np.array([entry.sqrt() for entry in norm], dtype=object)).astype(float)
    return values, vectors


def lowest(stiff: dict, mass: dict, start: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Lowest `count` eigenvalues and vectors, v^T M v = 1; the first two are the rigid-body modes.

    stiff and mass are lower triangles {(row, column): Decimal}; start is a block of more than
    `count` vectors that spans the rigid-body modes roughly.
    """
    with localcontext() as context:
        context.prec = DIGITS
        return _lowest(stiff, mass, start, count)
