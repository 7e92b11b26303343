"""The actuator beside SciPy's integrator, which stops at every limit that is reached or left."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi2 import fmi2Integer, fmi2Real, fmi2ValueReference
from fmpy.validation import validate_fmu

from harness import Instance, Package, Refused, package_path, packaged
from oracle_actuator import Actuator

# What is left of the integrator's tolerance where limits are met.
ERROR = 1e-9
FIRST = {"kind": "FirstOrder"}

# Limits that the manoeuvres meet, and parameters.
ACTUATORS: dict[str, tuple[str, dict[str, Any]]] = {
    "default": ("rate", {}),
    "without limits": ("", {"rate_limit": 1e6, "position_min": -1e6, "position_max": 1e6}),
    "rings into its stops": ("stop", {"damping": 0.05, "rate_limit": 100.0, "position_max": 0.4}),
    "meets all": ("rate stop", {"damping": 0.2, "rate_limit": 1.5, "position_max": 0.3}),
    "critically damped": ("rate", {"damping": 1.0, "rate_limit": 3.0}),
    "overdamped": ("rate stop", {"damping": 3.0, "rate_limit": 3.0, "position_min": -0.1}),
    "lag": ("rate", FIRST | {"bandwidth": 10.0}),
    "slow lag": ("rate stop", FIRST | {"rate_limit": 0.9, "position_max": 0.2}),
}


@pytest.fixture(scope="module")
def actuator(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The FMU of the actuator, unzipped once."""
    return packaged(tmp_path_factory.mktemp("actuator"), "ahv_actuator")


def follow(flight: Instance, value: float, slope: float, h: float) -> None:
    """A step with a command that moves linearly."""
    flight.set(u=value)
    (u,) = flight.package.references("u")
    flight.call(
        "fmi2SetRealInputDerivatives", fmi2ValueReference(u), 1, fmi2Integer(1), fmi2Real(slope)
    )
    flight.step(h)


def manoeuvre(seed: int) -> list[tuple[float, float, float]]:
    """Value, slope and duration of commands: held and moving."""
    random = np.random.default_rng(seed)
    return [
        (random.uniform(-0.8, 0.8), random.choice([0.0, random.uniform(-4.0, 4.0)]), duration)
        for duration in random.uniform(0.01, 0.3, size=12)
    ]


def test_verif_fmpy_finds_no_problem_in_the_actuator(actuator: Package) -> None:
    """In either standard."""
    assert validate_fmu(str(actuator.path)) == []
    assert validate_fmu(str(package_path("ahv_actuator", "3.0"))) == []


def test_verif_positions_and_rates_have_no_unit_of_their_own(actuator: Package) -> None:
    """A master connects them to any quantity."""
    for name in ("u", "y", "rate", "rate_limit", "position_min", "position_max", "y0"):
        assert actuator.variables[name].unit is None, name


@pytest.mark.parametrize("name", ACTUATORS)
def test_verif_motion_at_the_limits_is_that_of_an_integrator_with_events(
    actuator: Package, name: str
) -> None:
    """Random commands, held and moving."""
    limits, parameters = ACTUATORS[name]
    met: set[str] = set()
    for seed in range(3):
        reference = Actuator(**parameters, met=met)
        with actuator.flight(**parameters) as flight:
            for value, slope, h in manoeuvre(seed):
                follow(flight, value, slope, h)
                reference.advance(value, slope, h)
                assert flight["y"] == pytest.approx(reference.position, abs=ERROR)
    assert met == {"free", *limits.split()}


def test_verif_the_delay_is_the_same_motion_later(actuator: Package) -> None:
    """Communication points lie elsewhere than the changes that arrive."""
    delay, parameters = 0.037, {"bandwidth": 20.0}
    with (
        actuator.flight(delay=delay, **parameters) as late,
        actuator.flight(**parameters) as prompt,
    ):
        for value, slope, h in manoeuvre(7):
            follow(prompt, value, slope, h)
            follow(late, value, slope, h)
        late.step(delay)
        assert late["y"] == pytest.approx(prompt["y"], abs=1e-13)


def test_verif_both_standards_fly_alike(actuator: Package) -> None:
    """The same bits, from FMPy's own loop."""
    rows = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.3), (0.5, 0.3), (0.5, -2.0), (1.0, -2.0)]
    signal = np.array(rows, dtype=[("time", "f8"), ("u", "f8")])
    flown = [
        simulate_fmu(
            str(package_path("ahv_actuator", version)),
            stop_time=1.0,
            output_interval=0.01,
            input=signal,
            start_values={"delay": 0.02},
        )
        for version in ("2.0", "3.0")
    ]
    assert flown[0].tobytes() == flown[1].tobytes()
    assert flown[0]["y"][-1] < -0.5 and flown[0]["rate"].min() == -2.0


def test_the_stops_are_refused_in_the_wrong_order(actuator: Package) -> None:
    with pytest.raises(Refused, match="position_min has to be less than position_max"):
        actuator.flight(position_min=0.5, position_max=0.5, y0=0.5)
