"""The poles of Tables 2 and 3 identified from inputs and outputs of the FMU.

The inputs reach every state and every state can be read, so the discrete transition matrix of one
step follows from responses by least squares (dynamic mode decomposition with control: Proctor,
Brunton, Kutz, SIAM J. Applied Dynamical Systems 15(1), 2016).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

from harness import ACTIVE_STATES, CONFIGURATIONS, STATES, Package
from oracle import Vehicle

# The phase of the fastest mode advances by 1.1 rad per step, below pi, so logarithms are unique.
STEP = 0.01
# Runs so short that the unstable short period grows little, and enough random inputs to excite all
# states independently: with few, speed and altitude are lost in rounding.
STEPS, RUNS = 60, 24
# Inputs, rad and fuel ratio. A pair of runs with opposite inputs cancels even terms; cubic terms
# decrease as the square of the size, and are near the integration error.
SIZE = (5e-5, 5e-4)
TOLERANCE = 1e-12  # of the FMU

# Largest distance of a pole, rad/s. Cubic terms cause 6e-8 (measured).
FAST = 2e-7
# Phugoid and height mode take minutes, a run 0.6 s: speed and altitude hardly change, and a
# relative error of 1e-12 in them causes up to 2.7e-6 (measured). This shows only that the height
# pole is small.
SLOW = 5e-6
# Boundary between phugoid, 0.04, and short period, 3.4, rad/s.
DIVIDE = 0.5


def transition(package: Package, configuration: int) -> np.ndarray:
    """Transition matrix over STEP around trim, [state, state], in the units of the states."""
    names = STATES[: ACTIVE_STATES[configuration]]
    generator = np.random.default_rng(3)
    before, after = [], []
    for _ in range(RUNS):
        inputs = generator.choice((-1.0, 1.0), (STEPS, 2)) * SIZE
        runs = []
        for signed in (inputs, -inputs):
            with package.flight(TOLERANCE, configuration=configuration) as flight:
                runs.append(flight.fly(STEPS, STEP, signed.__getitem__, names))
        x = (runs[0] - runs[1]) / 2.0
        before.append(np.hstack([x[:-1], inputs]))
        after.append(x[1:])
    known, found = np.vstack(before), np.vstack(after)
    size = np.abs(known).max(axis=0)
    fit = np.linalg.lstsq(known / size, found / size[: len(names)], rcond=None)[0]
    scaled = fit[: len(names)].T
    return scaled * size[: len(names), None] / size[: len(names)]


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_poles_by_steps_alone_are_those_of_the_oracle(
    package: Package, vehicle: Callable[..., Vehicle], configuration: int
) -> None:
    """log(eig)/h of the identified matrix, one to one with the eigenvalues of the oracle's A."""
    found = np.log(np.linalg.eigvals(transition(package, configuration)).astype(complex)) / STEP
    expected = vehicle(configuration).poles()
    distance = np.abs(found[:, None] - expected)
    rows, columns = linear_sum_assignment(distance)
    assert len(rows) == len(expected)
    for wrong, pole in zip(distance[rows, columns], expected[columns], strict=True):
        limit = FAST if abs(pole) > DIVIDE else SLOW
        assert wrong < limit, f"{pole:.6g} rad/s: off by {wrong:.1e}"
