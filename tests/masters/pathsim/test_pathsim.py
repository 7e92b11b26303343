"""PathSim with PathSim-FMI: its co-simulation, and model exchange by one of its solvers."""

from __future__ import annotations

import numpy as np
import pytest
from pathsim import Connection, Simulation
from pathsim.blocks import Constant, Scope, Source
from pathsim.solvers import RKDP87
from pathsim_fmi import CoSimulationFMU, ModelExchangeFMU

from harness import CONTROLS, Package
from reference import EXACT, FLIGHTS, OTHER_SOLVER, STEP, STEPS, Flight, Reference

# Dormand and Prince of order 8 in steps of 2.5 ms: its error is smaller than the rounding.
SOLVER_STEPS = 4


def co_simulation(package: Package, flight: Flight) -> tuple[list[str], np.ndarray]:
    """Outputs after each step. PathSim steps as soon as a communication point is reached, and
    shows the outputs of the step's end there: row k has step k.
    """
    ahv = CoSimulationFMU(str(package.path), start_values=dict(flight.start), dt=STEP)
    outputs = list(ahv.fmu_wrapper.output_refs)
    sources = [
        Source(lambda time, index=index: flight.controls(round(time / STEP))[index])
        for index in range(len(CONTROLS))
    ]
    scope = Scope()
    wires = [Connection(source, ahv[name]) for source, name in zip(sources, CONTROLS, strict=True)]
    wires += [Connection(ahv[name], scope[index]) for index, name in enumerate(outputs)]
    simulation = Simulation([ahv, *sources, scope], wires, dt=STEP, log=False)
    simulation.run((STEPS - 1) * STEP, adaptive=False)
    return outputs, np.transpose(scope.read()[1])


def model_exchange(package: Package, flight: Flight) -> tuple[list[str], np.ndarray]:
    """Outputs after each step; the controls change between two."""
    ahv = ModelExchangeFMU(str(package.path), start_values=dict(flight.start))
    outputs = list(ahv.fmu_wrapper.output_refs)
    sources = [Constant(0.0) for _ in CONTROLS]
    wires = [Connection(source, ahv[name]) for source, name in zip(sources, CONTROLS, strict=True)]
    simulation = Simulation([ahv, *sources], wires, Solver=RKDP87, log=False)
    rows = []
    for k in range(STEPS):
        for source, value in zip(sources, flight.controls(k), strict=True):
            source.value = value
        for _ in range(SOLVER_STEPS):
            simulation.timestep(STEP / SOLVER_STEPS, adaptive=False)
        rows.append(ahv.outputs.to_array().copy())
    return outputs, np.array(rows)


@pytest.mark.parametrize("flight", FLIGHTS, ids=str)
def test_verif_master_flies_like_fmpy(
    package: Package, reference: Reference, flight: Flight
) -> None:
    """Every output at every communication point."""
    names, rows = co_simulation(package, flight)
    reference.compare(flight, rows, names)


@pytest.mark.parametrize("flight", FLIGHTS, ids=str)
def test_verif_master_integrates_like_fmpy(
    package: Package, reference: Reference, flight: Flight
) -> None:
    """Every output, its solver outside of the FMU against FMPy's flight by the one inside."""
    names, rows = model_exchange(package, flight)
    reference.compare(flight, rows, names, limit=OTHER_SOLVER, tolerance=EXACT, label="exchange")
