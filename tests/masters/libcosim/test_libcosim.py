"""DNV's libcosim. It reads no enumerations, so it flies the default configuration."""

from __future__ import annotations

import pytest
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

from harness import CONTROLS, Package
from reference import FLIGHTS, NAMES, STEP, STEPS, Flight, Reference

# libcosim counts in nanoseconds.
STEP_NS = round(STEP * 1e9)


def fly(package: Package, flight: Flight) -> list[list[float]]:
    """Values of NAMES after each step."""
    execution = CosimExecution.from_step_size(STEP_NS)
    slave = CosimLocalSlave(str(package.path), "ahv")
    index = execution.add_local_slave(slave)
    manipulator, observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
    assert execution.add_manipulator(manipulator) and execution.add_observer(observer)
    for name, value in flight.start.items():
        (reference,) = package.references(name)
        assert execution.real_initial_value(index, reference, value), name
    controls, everything = package.references(*CONTROLS), package.references(*NAMES)
    rows = []
    for k in range(STEPS):
        assert manipulator.slave_real_values(index, controls, flight.controls(k))
        assert execution.step()
        rows.append(observer.last_real_values(index, everything))
    assert execution.status().current_time == STEPS * STEP_NS
    return rows


@pytest.mark.parametrize("flight", FLIGHTS, ids=str)
def test_verif_master_flies_like_fmpy(
    package: Package, reference: Reference, flight: Flight
) -> None:
    """Every state and output at every communication point."""
    reference.compare(flight, fly(package, flight))
