"""Samples of the vehicles."""

from __future__ import annotations

import numpy as np
from scipy.stats import qmc

from vehicles import VARIED, scaled


def sample(count: int, seed: int) -> np.ndarray:
    """Vehicles, shape (count, parameters), on a Latin hypercube."""
    return scaled(qmc.LatinHypercube(len(VARIED), rng=seed).random(count))
