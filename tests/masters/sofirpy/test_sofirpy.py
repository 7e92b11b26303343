"""sofirpy, whose controls come from a component in Python."""

from __future__ import annotations

import pytest
from sofirpy import SimulationEntity, simulate

from harness import CONTROLS, Package
from reference import FLIGHTS, NAMES, STEP, STEPS, Flight, Reference


def controls(flight: Flight) -> type[SimulationEntity]:
    """A component that knows after step k what the controls are in the next."""

    class Controls(SimulationEntity):
        def __init__(self) -> None:
            self.step, self.values = 0, flight.controls(0)

        def initialize(self, start_values: dict[str, float]) -> None:
            assert not start_values

        def do_step(self, time: float) -> None:
            self.step += 1
            self.values = flight.controls(self.step)

        def set_parameter(self, parameter_name: str, parameter_value: float) -> None:
            raise AssertionError("no inputs")

        def get_parameter_value(self, output_name: str) -> float:
            return self.values[CONTROLS.index(output_name)]

    return Controls


def fly(package: Package, flight: Flight) -> list[list[float]]:
    """Values of NAMES before each step: sofirpy records when the next controls are set."""
    connections = [
        {
            "parameter_name": name,
            "connect_to_system": "controls",
            "connect_to_external_parameter": name,
        }
        for name in CONTROLS
    ]
    flown = simulate(
        stop_time=STEPS * STEP,
        step_size=STEP,
        fmu_paths={"ahv": package.path},
        model_classes={"controls": controls(flight)},
        connections_config={"ahv": connections},
        start_values={"ahv": dict(flight.start)} if flight.start else None,
        parameters_to_log={"ahv": list(NAMES)},
    )
    return flown[[f"ahv.{name}" for name in NAMES]].to_numpy()[:STEPS]


@pytest.mark.parametrize("flight", FLIGHTS, ids=str)
def test_verif_master_flies_like_fmpy(
    package: Package, reference: Reference, flight: Flight
) -> None:
    """Every state and output at every communication point."""
    reference.compare(flight, fly(package, flight), when="before")
