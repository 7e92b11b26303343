"""Where the model ends: liquid that leaves its depth, and a burner that chokes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from harness import (
    DISCARD,
    ERROR,
    EVERYTHING,
    OK,
    OUTPUTS,
    RIGID,
    SLOSH_BEAM,
    STATES,
    Instance,
    Package,
    Refused,
)
from oracle import Vehicle

MARGIN = "choking_margin"
# Both solve the same equations up to rounding.
EQUAL = 1e-11
# Speed of the sloshing masses relative to their tanks that leads beyond the depth, m/s.
KICKS = [("slosh1", 25.0), ("slosh1", -25.0), ("slosh2", 9.0), ("slosh2", -9.0)]


def depths(oracle: Vehicle, fuel_fraction: float) -> dict[str, float]:
    """Depth of the liquid in m in the tank that each output names."""
    residual = oracle.data["mass"]["residual_fraction"]
    level = residual + (1.0 - residual) * fuel_fraction
    return {
        f"slosh{number}": tank["depth_full_m"] * level
        for number, tank in enumerate(oracle.data["tank"], 1)
    }


def assert_ended(flight: Instance, begin: float, name: str) -> None:
    """The last step was discarded at an instant within it, and the log names a variable."""
    last, message = flight.last_time(), flight.log[-1]
    assert begin <= last < begin + 0.01
    assert flight.terminated()
    assert message.status == DISCARD and f"{name} =" in message.text
    assert np.isfinite(flight.get(*EVERYTHING)).all()


@pytest.mark.parametrize("fuel_fraction", [1.0, 0.5])
@pytest.mark.parametrize(("name", "speed"), KICKS)
def test_verif_liquid_that_leaves_its_depth_ends_the_flight(
    package: Package,
    vehicle: Callable[..., Vehicle],
    name: str,
    speed: float,
    fuel_fraction: float,
) -> None:
    """At the instant that it does: the state is the last valid one, and a flight to it is valid."""
    depth = depths(vehicle(SLOSH_BEAM), fuel_fraction)
    given = {f"{name}_dot_offset": speed, "fuel_fraction": fuel_fraction}
    with package.instance(logging=True) as flight:
        flight.initialise(**given)
        status, begin = OK, 0.0
        while status == OK and begin < 1.0:
            begin, status = flight.time, flight.step_status(0.01)
        assert status == DISCARD
        assert_ended(flight, begin, name)
        values = dict(zip(EVERYTHING, flight.get(*EVERYTHING), strict=True))
        assert f"{depth[name]:.6f}" in flight.log[-1].text
        assert abs(values[name]) <= depth[name]
        assert values[name] == pytest.approx(np.copysign(depth[name], speed), abs=1e-6)
        last = flight.last_time()
    with package.flight(**given) as again:
        while again.time < begin:
            again.step(0.01)
        if last > begin:
            again.step(last - begin)
        states = [values[state] for state in STATES]
        np.testing.assert_allclose(again.get(*STATES), states, rtol=1e-6, atol=1e-9)


def test_verif_liquid_stays_in_its_depth_without_sloshing_masses(package: Package) -> None:
    """A configuration without them has no such limit: the same offsets end nothing."""
    for configuration in (1, 2):
        with package.flight(configuration=configuration, slosh1_dot_offset=25.0) as flight:
            flight.fly(30, 0.01)


@pytest.mark.parametrize("aero", ["xu2015", "parker2007"])
def test_verif_published_sets_fly_beyond_choking(
    package: Package, vehicle: Callable[..., Vehicle], aero: str
) -> None:
    """The margin is above 0 in trim and below with more fuel; it tells, and ends nothing."""
    oracle = vehicle(RIGID, aero=aero)
    active = oracle.states
    with package.flight(configuration=RIGID, aero=aero) as flight:
        seen = []
        for beyond in (0.0, 0.5, 0.999, 1.001, 1.5):
            margin = flight[MARGIN] + flight["phi"]
            assert 0.05 < margin < 1.0
            flight.set(phi=beyond * margin)
            assert flight[MARGIN] == pytest.approx((1.0 - beyond) * margin, abs=EQUAL)
            flight.step(0.01)
            names = (*STATES[:active], "delta_e_effective", "phi_effective", MARGIN)
            *values, shown = flight.get(*names)
            expected = oracle.outputs(np.array(values[:active]), np.array(values[active:]))
            assert shown == pytest.approx(expected[MARGIN], abs=EQUAL)
            seen.append(shown)
        assert max(seen) > 0.0 > min(seen)
        assert flight.log == []


@pytest.mark.parametrize("configuration", [RIGID, SLOSH_BEAM])
def test_verif_first_principles_end_where_the_burner_chokes(
    package: Package, configuration: int
) -> None:
    """Fuel just below the margin flies; beyond, no step is made, and the log says why."""
    with package.instance(logging=True) as flight:
        flight.initialise(configuration=configuration, aero="shock_expansion")
        margin = flight[MARGIN]
        flight.set(phi=0.99 * margin)
        flight.step(0.001)
        begin, states = flight.time, flight.get(*STATES)
        flight.set(phi=margin + 0.05)
        assert flight[MARGIN] < 0.0
        assert flight.step_status(0.01) == DISCARD
        assert_ended(flight, begin, MARGIN)
        assert flight.last_time() == begin
        assert np.array_equal(flight.get(*STATES), states)


def test_verif_first_principles_end_within_the_step_in_which_the_burner_chokes(
    package: Package,
) -> None:
    """Pitching up compresses the stream until the same fuel is too much."""
    with package.instance(logging=True) as flight:
        flight.initialise(configuration=RIGID, aero="shock_expansion")
        flight.set(phi=0.98 * flight[MARGIN], delta_e=-0.02)
        status, begin = OK, 0.0
        while status == OK and begin < 1.0:
            begin, status = flight.time, flight.step_status(0.01)
        assert status == DISCARD
        assert_ended(flight, begin, MARGIN)
        assert 0.0 <= flight[MARGIN] < 1e-6


def test_verif_a_start_with_a_choked_burner_is_refused(package: Package) -> None:
    """Where no fuel can be burnt there is no trim."""
    with package.instance() as instance:
        instance.set(aero="shock_expansion", mach0=6.0, altitude0=36000.0)
        instance.setup()
        with pytest.raises(Refused) as refused:
            instance.call("fmi2ExitInitializationMode")
        assert refused.value.status == ERROR


@pytest.mark.parametrize("aero", ["xu2015", "parker2007", "shock_expansion"])
def test_verif_the_margin_by_itself_is_the_oracles(
    package: Package, vehicle: Callable[..., Vehicle], aero: str
) -> None:
    """Over speed, height and incidence, from where nothing burns to where much does."""
    oracle = vehicle(RIGID, aero=aero)
    assert MARGIN in OUTPUTS
    seen = []
    for mach in (6.2, 8.0, 10.5):
        for altitude in (20e3, 30e3):
            for alpha in (-0.05, 0.0, 0.05, 0.12):
                start = {"trim": False, "mach0": mach, "altitude0": altitude, "alpha0": alpha}
                with package.flight(configuration=RIGID, aero=aero, **start) as flight:
                    x, found = flight.get(*STATES[:5]), flight[MARGIN]
                expected = oracle.outputs(x, np.zeros(2))[MARGIN]
                assert found == pytest.approx(expected, abs=EQUAL)
                seen.append(found)
    assert np.ptp(seen) > 0.5
