"""CoFMUPy, which shows outputs only."""

from __future__ import annotations

import numpy as np
import pytest
from cofmupy import Coordinator

from harness import CONTROLS, Package
from reference import FLIGHTS, JUMPS, NAMES, STEP, STEPS, Flight, Reference


def names(package: Package) -> list[str]:
    """Outputs."""
    return [name for name in NAMES if package.variables[name].causality == "output"]


def fly(package: Package, flight: Flight) -> np.ndarray:
    """Values of the outputs after each step."""
    # CoFMUPy sums time, so a jump at a communication point might come one step late.
    controls = {(k - 0.5) * STEP: flight.controls(k) for k in JUMPS}
    connections = [
        {
            "source": {
                "type": "literal",
                "values": {str(time): values[index] for time, values in controls.items()},
            },
            "target": {"type": "fmu", "id": "ahv", "variable": name},
        }
        for index, name in enumerate(CONTROLS)
    ]
    coordinator = Coordinator()
    ahv = {
        "id": "ahv",
        "name": "ahv",
        "path": str(package.path),
        "initialization": dict(flight.start),
    }
    coordinator.start({"fmus": [ahv], "connections": connections, "cosim_method": "jacobi"})
    for _ in range(STEPS):
        coordinator.do_step(STEP)
    flown = coordinator.get_results()
    return np.column_stack([flown["ahv", name] for name in names(package)])


@pytest.mark.parametrize("flight", FLIGHTS, ids=str)
def test_verif_master_flies_like_fmpy(
    package: Package, reference: Reference, flight: Flight
) -> None:
    """Every output at every communication point."""
    reference.compare(flight, fly(package, flight), names(package))
