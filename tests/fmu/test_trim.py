"""Trimmed flight: with any valid parameters, equal to the oracle's, refused where there is none."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from harness import (
    AERO_SETS,
    CONFIGURATIONS,
    DERIVATIVES,
    ERROR,
    SLOSH_BEAM,
    STATES,
    Package,
    Refused,
)
from oracle import Vehicle

TRIM = ("alpha_trim", "delta_e_trim", "phi_trim")
OMEGA = ("omega1", "omega2", "omega3", "omega_slosh1", "omega_slosh2")

# Both solve the same equations up to rounding, amplified by the conditioning.
TRIM_EQUAL = 1e-9
OMEGA_EQUAL = 1e-9
# Rates in trim: rounding of terms of about 1e3 m/s^2 (omega^2 eta) and 10 m/s^2 and 1 rad/s^2.
RATE_AT_REST = 1e-9
# Drift in two seconds, relative to speed and altitude: rounding, amplified by e^(5 t) of the
# unstable short period.
DRIFT = 1e-7

SWEEP: list[dict[str, Any]] = [
    *({"configuration": number} for number in CONFIGURATIONS),
    *({"aero": name} for name in AERO_SETS),
    *({"fuel_fraction": part} for part in (0.0, 0.5, 1.0)),
    *({"slosh_frequency": omega} for omega in (5.0, 20.0, 60.0)),
    *({"slosh_damping": ratio} for ratio in (0.0, 0.05, 0.3)),
    *({"mach0": mach} for mach in (7.0, 9.0)),
    *({"altitude0": altitude} for altitude in (24000.0, 28000.0)),
    {"fuel_fraction": 0.5, "slosh_frequency": 5.0, "slosh_damping": 0.3, "mach0": 7.5},
    {"configuration": 2, "fuel_fraction": 0.0, "altitude0": 27000.0},
    {"configuration": 1, "fuel_fraction": 0.5, "mach0": 9.0, "altitude0": 28000.0},
]
COMPARED: list[dict[str, Any]] = [
    *({"configuration": k, "aero": name} for k in CONFIGURATIONS for name in AERO_SETS),
    {"fuel_fraction": 0.5, "aero": "xu2015"},
    {"fuel_fraction": 0.0, "slosh_frequency": 5.0, "slosh_damping": 0.3},
    {"slosh_frequency": 60.0, "mach0": 7.5, "altitude0": 24500.0, "gamma0": 0.01},
    {"configuration": 2, "fuel_fraction": 0.5},
    {"configuration": 1, "fuel_fraction": 0.0, "mach0": 9.0, "altitude0": 28000.0},
]


def name_of(parameters: dict[str, Any]) -> str:
    """Name of a test case."""
    return ",".join(f"{name}={value}" for name, value in parameters.items())


@pytest.mark.parametrize("parameters", SWEEP, ids=name_of)
def test_verif_no_input_flies_level(package: Package, parameters: dict[str, Any]) -> None:
    """A master that sets nothing sees all rates zero to rounding, and level flight for 2 s."""
    with package.flight(**parameters) as flight:
        assert np.abs(flight.get(*DERIVATIVES)).max() < RATE_AT_REST
        history = flight.fly(200, 0.01, names=STATES)
        assert flight["gamma0"] == 0.0
        scale = np.ones(len(STATES))
        scale[:2] = history[0][:2]
        assert np.abs((history - history[0]) / scale).max() < DRIFT
        assert flight.log == []


@pytest.mark.parametrize("parameters", COMPARED, ids=name_of)
def test_verif_trim_and_frequencies_equal_the_oracle(
    package: Package, vehicle: Callable[..., Vehicle], parameters: dict[str, Any]
) -> None:
    """Trim solution, start state and frequencies of the kept modes."""
    oracle = vehicle(**parameters)
    state, control = oracle.trim()
    omega = np.zeros(len(OMEGA))
    omega[: oracle.modes_count] = oracle.omega
    expected = np.zeros(len(STATES))
    expected[: oracle.states] = state
    with package.flight(**parameters) as flight:
        found = flight.get(*TRIM)
        np.testing.assert_allclose(found, [state[3], *control], rtol=TRIM_EQUAL, atol=0.0)
        np.testing.assert_allclose(flight.get(*OMEGA), omega, rtol=OMEGA_EQUAL, atol=0.0)
        np.testing.assert_allclose(flight.get(*STATES), expected, rtol=TRIM_EQUAL, atol=1e-13)
        effective = flight.get("delta_e_effective", "phi_effective")
        assert np.array_equal(effective, flight.get("delta_e_trim", "phi_trim"))


@pytest.mark.parametrize(
    ("parameters", "limit"),
    [
        ({"mach0": 2.0}, "mach"),
        ({"altitude0": 60e3}, "altitude"),
        ({"altitude0": 60e3, "configuration": 1}, "altitude"),
        ({"mach0": 7.0, "altitude0": 38e3, "configuration": 1}, "alpha"),
        ({"mach0": 6.5, "altitude0": 35e3}, "delta_e"),
        ({"gamma0": 1.0}, "phi"),
    ],
    ids=lambda value: name_of(value) if isinstance(value, dict) else value,
)
def test_verif_impossible_trim_is_refused(
    package: Package, parameters: dict[str, Any], limit: str
) -> None:
    """fmi2ExitInitializationMode fails and names the residual and the limit that was hit."""
    with package.instance() as instance:
        instance.set(**parameters)
        instance.setup()
        with pytest.raises(Refused) as refused:
            instance.call("fmi2ExitInitializationMode")
        assert refused.value.status == ERROR
        assert limit in refused.value.text and "residual" in refused.value.text
        assert instance.log[-1].status == ERROR
        # The instance can be used again.
        instance.call("fmi2Reset")
        instance.initialise()
        instance.step(0.01)


def test_verif_trim_is_readable_in_initialization_mode(
    package: Package, vehicle: Callable[..., Vehicle]
) -> None:
    """A master may read the trim solution before it leaves initialization mode, and use it."""
    state, control = vehicle(SLOSH_BEAM).trim()
    with package.instance() as instance:
        instance.set(input_mode="Absolute")
        instance.setup()
        found = instance.get(*TRIM)
        np.testing.assert_allclose(found, [state[3], *control], rtol=TRIM_EQUAL)
        instance.set(delta_e=found[1], phi=found[2])
        instance.call("fmi2ExitInitializationMode")
        assert np.abs(instance.get(*DERIVATIVES)).max() < RATE_AT_REST
