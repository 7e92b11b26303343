"""Flights that begin beside the trim: offsets of the initial state."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from contract import OFFSETS
from harness import (
    CONFIGURATIONS,
    EVEN_MASS_BEAM,
    OUTPUTS,
    RIGID,
    SLOSH_BEAM,
    STATES,
    Package,
)
from oracle import Vehicle
from test_run import STEP, assert_equal_flights, columns, throttle
from test_trim import TRIM

STEPS = 40
FLIGHT_EQUAL = 1e-7  # as in test_run.py, at the default tolerance
START_EQUAL = 1e-9  # two solutions of the modes
SIZE = {
    **{"alpha": 0.01, "q": 0.03, "eta1": 0.02, "eta2": 0.01, "eta3": 0.005},
    **{"eta1_dot": 0.3, "eta2_dot": 0.3, "eta3_dot": 0.3},
    **{"slosh1": 0.1, "slosh2": -0.08, "slosh1_dot": 0.4, "slosh2_dot": -0.5},
}
EACH = [{f"{name}_offset": SIZE[name]} for name in OFFSETS]
ALL_AT_ONCE = {f"{name}_offset": 0.3 * size for name, size in SIZE.items()}


@pytest.mark.parametrize("offsets", EACH, ids=lambda given: next(iter(given)))
def test_verif_an_offset_is_the_oracles(
    package: Package, vehicle: Callable[..., Vehicle], offsets: dict[str, float]
) -> None:
    """In the state and the outputs at the start, and in the flight that follows."""
    fly_and_compare(package, vehicle(SLOSH_BEAM, **offsets), SLOSH_BEAM, offsets)


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_all_offsets_are_the_oracles(
    package: Package, vehicle: Callable[..., Vehicle], configuration: int
) -> None:
    """Those of parts that a configuration does not have change nothing."""
    oracle = vehicle(configuration, **ALL_AT_ONCE)
    fly_and_compare(package, oracle, configuration, ALL_AT_ONCE)


def fly_and_compare(
    package: Package, oracle: Vehicle, configuration: int, offsets: dict[str, float]
) -> None:
    """Start and flight, in the FMU and in the oracle; with fuel, without which V hardly moves."""
    _, states, outputs = oracle.simulate(STEPS * STEP, STEP, throttle)
    theirs = columns(oracle, states, outputs)
    names = (*STATES, *OUTPUTS)
    with package.flight(configuration=configuration, **offsets) as flight:
        ours = flight.fly(STEPS, STEP, throttle, names)
        assert flight.log == []
    nominal = {name: float(package.variables[name].nominal) for name in STATES}
    for name, found, expected in zip(names, ours[0], theirs[0], strict=True):
        size = max(abs(expected), nominal.get(name, 1.0))
        assert abs(found - expected) <= START_EQUAL * size, name
    assert_equal_flights(ours, theirs, FLIGHT_EQUAL)


@pytest.mark.parametrize("trim", [True, False])
@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_offsets_move_what_they_name(
    package: Package, configuration: int, trim: bool
) -> None:
    """By as much as they say, and nothing else that starts a flight; with start values too."""
    there = {
        RIGID: OFFSETS[:2],
        EVEN_MASS_BEAM: OFFSETS[:8],
        SLOSH_BEAM: (*OFFSETS[:8], "slosh1", "slosh2"),
    }[configuration]
    names = (*STATES[:11], "slosh1", "slosh2")
    given = {"trim": trim, "configuration": configuration}
    if not trim:
        given |= {"alpha0": 0.02, "eta10": 0.01}
    with package.flight(**given) as flight:
        before, plain = flight.get(*TRIM)[1:], flight.get(*names)
    for name in OFFSETS:
        with package.flight(**given, **{f"{name}_offset": SIZE[name]}) as flight:
            assert np.array_equal(flight.get(*TRIM)[1:], before)
            moved = flight.get(*names) - plain
        expected = np.array([SIZE[name] * (name == n and name in there) for n in names])
        np.testing.assert_allclose(moved, expected, atol=1e-14, err_msg=name)


def test_verif_a_released_mass_starts_to_slosh(package: Package) -> None:
    """It swings about its place of rest, about as fast as its mode."""
    offset = 0.1
    with package.flight(slosh1_offset=offset) as flight:
        omega = flight["omega_slosh1"]
        history = flight.fly(40, STEP, names=("slosh1",))[:, 0]
    assert history[0] == pytest.approx(offset, abs=1e-3)
    quarter = round(np.pi / 2.0 / omega / STEP)
    assert abs(history[quarter]) < 0.3 * offset < abs(history[2 * quarter])
    assert history[2 * quarter] < 0.0
