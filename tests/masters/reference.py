"""The flights that every master flies, what FMPy makes of them, and the comparison."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from harness import ALL_STATES, CONTROLS, FUEL, OUTPUTS, Package

NAMES = (*ALL_STATES, *OUTPUTS, "delta_e_effective", "phi_effective")
STEP, STEPS = 0.01, 100
# Communication points of masters differ by rounding, which the short period amplifies by e^(5 t).
# Relative to each variable's excursion.
SAME_FLIGHT = 1e-9
# For a solver outside the FMU, compared with a flight of negligible error: it rounds an altitude of
# 26 km at every step, and a rounding error is 1e-10 of the excursion of 5 cm.
OTHER_SOLVER = 1e-8
EXACT = 1e-12


class Flight(NamedTuple):
    """Controls held in each step, and start values."""

    name: str
    controls: Callable[[int], tuple[float, float]]
    start: Mapping[str, float]

    def __str__(self) -> str:
        return self.name


def level(_: int) -> tuple[float, float]:
    """Nothing moves."""
    return 0.0, 0.0


def doublet(step: int) -> tuple[float, float]:
    """Elevator up and down, 0.2 s each; a little fuel in between."""
    delta = 0.005 if 10 <= step < 30 else -0.005 if 30 <= step < 50 else 0.0
    return delta, 0.02 if 20 <= step < 40 else 0.0


# Where `doublet` jumps, in steps.
JUMPS = (0, 10, 20, 30, 40, 50)
LEVEL, DOUBLET = Flight("level", level, {}), Flight("doublet", doublet, {})
ELSEWHERE = {"fuel_fraction": 0.5, "mach0": 7.5, "altitude0": 24000.0, "gamma0": 0.01}
FLIGHTS = (LEVEL, DOUBLET, Flight("elsewhere", doublet, ELSEWHERE))


class Rows(NamedTuple):
    """Values of NAMES in each step, before it with its controls already set, and after it."""

    before: np.ndarray
    after: np.ndarray


class Reference:
    """Flights of FMPy, and how far from them the others were."""

    def __init__(self, package: Package) -> None:
        self.package = package
        self.differences: dict[str, float] = {}

    def rows(self, flight: Flight, tolerance: float | None) -> Rows:
        """What FMPy flies."""
        before, after = [], []
        with self.package.flight(tolerance, **flight.start) as instance:
            for k in range(STEPS):
                instance.set(**dict(zip(CONTROLS, flight.controls(k), strict=True)))
                before.append(instance.get(*NAMES))
                instance.step(STEP)
                after.append(instance.get(*NAMES))
        return Rows(np.array(before), np.array(after))

    def compare(
        self,
        flight: Flight,
        rows: ArrayLike,
        names: Sequence[str] = NAMES,
        *,
        limit: float = SAME_FLIGHT,
        tolerance: float | None = None,
        when: str = "after",
        label: str = "",
    ) -> None:
        """All of `names` agree with FMPy to `limit` of their excursion in the doublet.

        `rows` has their values after (or before) each step. What never moves has to be equal.
        """
        columns = [NAMES.index(name) for name in names]
        theirs = getattr(self.rows(flight, tolerance), when)[:, columns]
        moved = self.rows(DOUBLET if flight is LEVEL else flight, tolerance).after[:, columns]
        excursion = np.abs(moved - moved[0]).max(axis=0)
        error = np.abs(np.asarray(rows) - theirs).max(axis=0)
        still = excursion == 0.0
        assert [name for name, at_rest in zip(names, still, strict=True) if at_rest] in ([], [FUEL])
        assert not error[still].any(), "a constant differs"
        error = error[~still] / excursion[~still]
        self.differences[f"{flight} {label}".strip()] = error.max()
        worst = np.array(names)[~still][error.argmax()]
        assert error.max() <= limit, f"{worst}: {error.max():.2e}"
