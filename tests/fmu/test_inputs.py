"""What the inputs mean: deviation or absolute, saturation, immediate effect."""

from __future__ import annotations

import math

import numpy as np
import pytest

from harness import CONFIGURATIONS, EVERYTHING, STATES, Package

ELEVATOR_LIMIT, FUEL_LIMIT = math.radians(20.0), 1.5
# Two ways to set the same effective controls differ by rounding, which grows as e^(5 t).
SAME_FLIGHT = 1e-11


def wave(step: int) -> tuple[float, float]:
    """Deviations on both inputs."""
    return 0.005 * math.sin(0.4 * step), 0.05 * math.cos(0.3 * step)


def assert_same(ours: np.ndarray, theirs: np.ndarray) -> None:
    """Equal but for rounding, relative to each variable's largest value."""
    scale = np.abs(theirs).max(axis=0)
    assert np.all(np.abs(ours - theirs) <= SAME_FLIGHT * scale)


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_absolute_is_deviation_plus_trim(package: Package, configuration: int) -> None:
    """Absolute inputs with the trim added fly what deviations fly."""
    names = (*STATES, "delta_e_effective", "phi_effective")
    with package.flight(configuration=configuration) as flight:
        trim = flight.get("delta_e_trim", "phi_trim")
        deviation = flight.fly(50, 0.01, wave, names)
    with package.flight(configuration=configuration, input_mode="Absolute") as flight:
        absolute = flight.fly(50, 0.01, lambda k: np.add(trim, wave(k)), names)
    assert_same(absolute, deviation)


@pytest.mark.parametrize("configuration", CONFIGURATIONS[:2])
def test_verif_start_without_trim_flies_the_same(package: Package, configuration: int) -> None:
    """trim = false, started from the trim solution, with its controls, flies like trim = true."""
    names = (*STATES, "delta_e_effective", "phi_effective")
    with package.flight(configuration=configuration) as flight:
        trim = flight.get("delta_e_trim", "phi_trim")
        alpha, *eta = (float(value) for value in flight.get("alpha", "eta1", "eta2", "eta3"))
        expected = flight.fly(50, 0.01, wave, names)
    given = {"alpha0": alpha, **dict(zip(("eta10", "eta20", "eta30"), eta, strict=True))}
    with package.flight(configuration=configuration, trim=False, **given) as flight:
        found = flight.fly(50, 0.01, lambda k: np.add(trim, wave(k)), names)
    assert_same(found, expected)


@pytest.mark.parametrize("mode", ["DeviationFromTrim", "Absolute"])
def test_verif_without_trim_inputs_are_absolute(package: Package, mode: str) -> None:
    """trim = false starts where it is told, and takes the inputs as they are."""
    start = {"alpha0": 0.01, "q0": 0.02, "eta10": 0.03, "eta20": -0.004, "eta30": 0.005}
    with package.flight(trim=False, input_mode=mode, delta_e=0.2, phi=0.3, **start) as flight:
        names = ("alpha", "q", "eta1", "eta2", "eta3")
        assert list(flight.get(*names)) == list(start.values())
        assert list(flight.get("delta_e_effective", "phi_effective")) == [0.2, 0.3]


def test_verif_controls_saturate(package: Package) -> None:
    """|delta_e| <= 20 deg and 0 <= phi <= 1.5, in both meanings of the inputs."""
    for mode in ("DeviationFromTrim", "Absolute"):
        with package.flight(input_mode=mode) as flight:
            for delta, phi, expected in (
                (1.0, 9.0, (ELEVATOR_LIMIT, FUEL_LIMIT)),
                (-1.0, -9.0, (-ELEVATOR_LIMIT, 0.0)),
            ):
                flight.set(delta_e=delta, phi=phi)
                effective = flight.get("delta_e_effective", "phi_effective")
                np.testing.assert_allclose(effective, expected, rtol=1e-15)
                assert list(flight.get("delta_e", "phi")) == [delta, phi]


def test_verif_saturated_input_is_the_limit(package: Package) -> None:
    """Beyond the limit more input changes nothing: bit-identical flights."""
    flights = []
    for delta in (ELEVATOR_LIMIT, 0.5, 3.0):
        with package.flight(configuration=1, input_mode="Absolute") as flight:
            phi = flight["phi_trim"]
            flights.append(flight.fly(5, 0.01, lambda _, d=delta, p=phi: (d, p)).tobytes())
    assert flights[0] == flights[1] == flights[2]


def test_verif_outputs_follow_the_inputs_without_a_step(package: Package) -> None:
    """After setting an input, outputs and rates belong to it at once; the state has not moved."""
    with package.flight() as flight:
        flight.step(0.01)
        states = flight.get(*STATES)
        before = dict(zip(EVERYTHING, flight.get(*EVERYTHING), strict=True))
        flight.set(delta_e=0.01)
        after = dict(zip(EVERYTHING, flight.get(*EVERYTHING), strict=True))
        assert np.array_equal(flight.get(*STATES), states)
        for name in ("lift", "drag", "moment", "n_z", "der(gamma)", "der(q)", "der(eta1_dot)"):
            assert after[name] != before[name], name
        assert after["lift"] > before["lift"] and after["moment"] < before["moment"]
        assert after["thrust"] == before["thrust"]
        flight.set(delta_e=0.0)
        assert dict(zip(EVERYTHING, flight.get(*EVERYTHING), strict=True)) == before
        flight.set(phi=0.1)
        assert flight["thrust"] > before["thrust"] and flight["lift"] == before["lift"]


def test_verif_reading_changes_nothing(package: Package) -> None:
    """A flight that is read often is the flight that is read once."""
    with package.flight() as often, package.flight() as once:
        for k in range(20):
            for flight in (often, once):
                flight.set(delta_e=wave(k)[0])
            for _ in range(3):
                often.bits()
            often.step(0.01)
            once.step(0.01)
        assert often.bits() == once.bits()
