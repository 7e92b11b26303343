"""Ecos. It reads no enumerations, so it flies the default configuration."""

from __future__ import annotations

import pytest
from ecospy import EcosSimulation, EcosSimulationStructure

from harness import CONTROLS, Package
from reference import FLIGHTS, NAMES, STEP, STEPS, Flight, Reference


def fly(package: Package, flight: Flight) -> list[list[float]]:
    """Values of NAMES after each step."""
    with EcosSimulationStructure() as structure:
        structure.add_model("ahv", package.path)
        given = {f"ahv::{name}": value for name, value in flight.start.items()}
        assert structure.add_parameter_set("start", given)
        simulation = EcosSimulation(STEP, structure=structure)
    assert simulation.init(parameter_set="start")
    rows = []
    for k in range(STEPS):
        for name, value in zip(CONTROLS, flight.controls(k), strict=True):
            simulation.set_real(f"ahv::{name}", value)
        simulation.step()
        rows.append([simulation.get_real(f"ahv::{name}") for name in NAMES])
    simulation.terminate()
    return rows


@pytest.mark.parametrize("flight", FLIGHTS, ids=str)
def test_verif_master_flies_like_fmpy(
    package: Package, reference: Reference, flight: Flight
) -> None:
    """Every state and output at every communication point."""
    reference.compare(flight, fly(package, flight))
