"""fmuloader, a thin loader in ctypes that calls every function of the standard."""

from __future__ import annotations

import pytest
from fmuloader.fmi2 import Fmi2Slave, Fmi2Status, Fmi2Type

from harness import CONTROLS, Package
from reference import FLIGHTS, NAMES, STEP, STEPS, Flight, Reference


def fly(package: Package, flight: Flight) -> list[list[float]]:
    """Values of NAMES after each step."""
    about = package.description.coSimulation
    controls, everything = package.references(*CONTROLS), package.references(*NAMES)
    rows = []
    with Fmi2Slave(package.path, model_identifier=about.modelIdentifier) as slave:
        slave.instantiate("ahv", Fmi2Type.CO_SIMULATION, guid=package.description.guid)
        slave.set_real(package.references(*flight.start), list(flight.start.values()))
        slave.setup_experiment()
        slave.enter_initialization_mode()
        slave.exit_initialization_mode()
        for k in range(STEPS):
            slave.set_real(controls, flight.controls(k))
            assert slave.do_step(k * STEP, STEP) == Fmi2Status.OK
            rows.append(slave.get_real(everything))
        slave.terminate()
    return rows


@pytest.mark.parametrize("flight", FLIGHTS, ids=str)
def test_verif_master_flies_like_fmpy(
    package: Package, reference: Reference, flight: Flight
) -> None:
    """Every state and output at every communication point."""
    reference.compare(flight, fly(package, flight))
