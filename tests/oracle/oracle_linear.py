"""Linear models of the vehicle, their poles and zeros, for the test oracle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import eig, matrix_balance

from oracle_aero import TINY

if TYPE_CHECKING:
    from oracle import Vehicle

FINITE_ZERO = 1e4  # rad/s: generalised eigenvalues beyond are the infinite ones
IN_STATE = {"V": 0, "h": 1, "gamma": 2, "alpha": 3, "q": 4}


@dataclass(frozen=True)
class Linear:
    """x' = A x + B u, y = C x + D u about a trim; u = (delta_e rad, phi)."""

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray


def linear(vehicle: Vehicle, x: np.ndarray, u: np.ndarray, outputs: Sequence[str]) -> Linear:
    """A, B, C, D by complex step about (x, u); `outputs` are states or outputs by name."""
    size = len(x)

    def slopes(place: int) -> tuple[np.ndarray, list[float]]:
        """How the rates and the outputs answer to one state or input."""
        step = 1j * TINY * (np.arange(size + len(u)) == place)
        moved, driven = x + step[:size], u + step[size:]
        rates = vehicle.rhs(0.0, moved, driven).imag / TINY
        found = vehicle.outputs(moved, driven)
        values = [moved[IN_STATE[y]] if y in IN_STATE else found[y] for y in outputs]
        return rates, [np.imag(value) / TINY for value in values]

    columns = [slopes(place) for place in range(size + 2)]
    rates = np.transpose([column[0] for column in columns])
    read = np.transpose([column[1] for column in columns])
    return Linear(rates[:, :size], rates[:, size:], read[:, :size], read[:, size:])


def in_order(values: np.ndarray) -> np.ndarray:
    """By decreasing real part, then by imaginary part."""
    return values[np.lexsort((values.imag, -values.real))]


def invariant_zeros(m: Linear) -> np.ndarray:
    """Finite invariant zeros of a model with two inputs and outputs: the Rosenbrock pencil."""
    a, (scale, _) = matrix_balance(m.a, permute=False, separate=True)
    b, c = m.b / scale[:, None], m.c * scale
    strong, loud = np.linalg.norm(b, axis=0), np.linalg.norm(c, axis=1)[:, None]
    left = np.block([[a, b / strong], [c / loud, m.d / loud / strong]])
    right = np.diag([1.0] * len(a) + [0.0, 0.0])
    found = eig(left, right, right=False)
    return in_order(found[np.isfinite(found) & (abs(found) < FINITE_ZERO)])
