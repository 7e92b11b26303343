"""Lowest elastic eigenpairs of K v = lambda M' v in 40-digit arithmetic, for the test oracle.

The conditioning of the beam's matrices is about 1e13: double precision loses the low modes. Here
K, held at the nose, is factored as a banded L D L^T in decimal arithmetic. A free beam under a load
that moves it nowhere pulls at no support, so that block inverse iteration with Rayleigh-Ritz
happens among the motions orthogonal to heave and pitch; there M' need not be sparse.
"""

from __future__ import annotations

from decimal import Decimal

import numpy as np
from scipy.linalg import eigh

DIGITS = 40
ITERATIONS = 40
TURN = 1e-12  # rad: how far a converged mode may still turn in one iteration
HELD = 2  # unknowns of the node at the nose, w and theta


def to_decimal(array: np.ndarray) -> np.ndarray:
    """The same numbers, exactly, as Decimal objects."""
    return np.vectorize(lambda value: Decimal(float(value)), otypes=[object])(array)


def _bands(matrix: dict, size: int) -> list[np.ndarray]:
    """Diagonals of a symmetric matrix: bands[d][j] is its element (j + d, j)."""
    width = max(row - column for row, column in matrix)
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


def _inverse(matrix: np.ndarray) -> np.ndarray:
    """Inverse of a 2 x 2 matrix."""
    (a, b), (c, d) = matrix
    return np.array([[d, -b], [-c, a]], dtype=object) / (a * d - b * c)


class Inertia:
    """M': the consistent mass matrix, with a rigid part of the body as heavy as it is told to be.

    A motion of the body is its mean heave and pitch, `body` times two numbers, and a rest without
    momentum. The rest keeps its mass; the two numbers get the 2 x 2 matrix `rigid`, about the nose.
    """

    def __init__(self, mass: dict, body: np.ndarray, rigid: np.ndarray | None) -> None:
        """mass {(row, column): Decimal}, body [unknown, 2]; `rigid` None leaves M as it is."""
        self._bands = _bands(mass, len(body))
        momentum = _times(self._bands, body)
        own = body.T @ momentum
        mean = _inverse(own)
        self._mean = mean @ momentum.T
        rigid = own if rigid is None else rigid
        self._load = momentum @ mean @ (rigid - own)

    def times(self, block: np.ndarray) -> np.ndarray:
        """M' times a block of vectors of Decimal numbers."""
        return _times(self._bands, block) + self._load @ (self._mean @ block)


class _HeldBeam:
    """K without the unknowns of the nose, factored."""

    def __init__(self, stiff: list[np.ndarray]) -> None:
        factor = [list(band[HELD:]) for band in stiff]
        self.size, self.width = len(factor[0]), len(factor) - 1
        for j in range(self.size):
            reach = min(self.width, self.size - 1 - j)
            ratios = [factor[d][j] / factor[0][j] for d in range(1, reach + 1)]
            for a in range(1, reach + 1):
                for b in range(a, reach + 1):
                    factor[b - a][j + a] -= ratios[a - 1] * factor[b][j]
            for d in range(1, reach + 1):
                factor[d][j] = ratios[d - 1]
        self.factor = factor

    def solve(self, load: np.ndarray) -> np.ndarray:
        """Displacements under a balanced load; the nose rests."""
        factor, found = self.factor, load.copy()
        found[:HELD] = Decimal(0)
        block = found[HELD:]
        for j in range(self.size):
            for d in range(1, min(self.width, self.size - 1 - j) + 1):
                block[j + d] -= factor[d][j] * block[j]
        for j in reversed(range(self.size)):
            block[j] /= factor[0][j]
            for d in range(1, min(self.width, self.size - 1 - j) + 1):
                block[j] -= factor[d][j] * block[j + d]
        return found


def lowest(
    stiff: dict, inertia: Inertia, free: np.ndarray, start: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Lowest `count` elastic eigenvalues and vectors, v^T M' v = 1, in the caller's precision.

    stiff is the lower triangle {(row, column): Decimal}, free [unknown, 2] spans heave and pitch of
    everything, start is a block of more than `count` vectors.
    """
    k = _bands(stiff, len(start))
    held = _HeldBeam(k)
    heavy = inertia.times(free)
    part = _inverse(free.T @ heavy) @ heavy.T

    block = to_decimal(start)
    block = block - free @ (part @ block)
    load = inertia.times(block)
    for _ in range(ITERATIONS):
        before, momentum = block[:, :count], load[:, :count]
        block = held.solve(load)
        block = block - free @ (part @ block)
        heavy = inertia.times(block)
        # Rayleigh-Ritz on the inverse: largest values first, which favours the wanted modes.
        gram, inverse = ((block.T @ other).astype(float) for other in (heavy, load))
        scale = 1.0 / np.sqrt(np.diag(inverse))
        values, turn = eigh(gram * np.outer(scale, scale), inverse * np.outer(scale, scale))
        turn = to_decimal((scale[:, None] * turn / np.sqrt(values))[:, ::-1])
        block, load = block @ turn, heavy @ turn
        # Converged once no mode turns any more, in the metric of M'.
        weighted = load[:, :count]
        norm = (block[:, :count] * weighted).sum(axis=0)
        earlier = (before * momentum).sum(axis=0)
        cosine = (weighted * before).sum(axis=0) ** 2 / norm / earlier
        if max(float(abs(1 - entry)) for entry in cosine) < TURN**2:
            break
    else:
        raise ArithmeticError("the inverse iteration has not converged")
    block = block[:, :count]
    values = ((block * _times(k, block)).sum(axis=0) / norm).astype(float)
    vectors = (block / np.array([entry.sqrt() for entry in norm], dtype=object)).astype(float)
    return values, vectors
