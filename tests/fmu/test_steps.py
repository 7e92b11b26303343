"""The result does not depend on how a master cuts time into steps."""

from __future__ import annotations

import math

import numpy as np
import pytest

from harness import OK, SLOSH_BEAM, STATES, Package

STOP = 0.6
# In units of the tolerance, relative to the larger of value and nominal value as in the integrator.
# The unstable short period may amplify an early difference by e^(5 STOP), about 20.
SPLIT = 5.0
DEFAULT_TOLERANCE = 1e-8


def elevator(time: float) -> float:
    """Elevator up for 0.2 s, then down; it changes at 0.2 s only."""
    return 0.005 if time < 0.2 - 1e-9 else -0.005


def cut(size: float) -> list[float]:
    """Equal steps to STOP."""
    return [size] * round(STOP / size)


def uneven() -> list[float]:
    """Steps of all sizes from 1e-6 to 0.05 s that meet 0.2 s and STOP."""
    generator = np.random.default_rng(20150101)
    sizes: list[float] = []
    for length in (0.2, STOP - 0.2):
        parts = 10.0 ** generator.uniform(-6.0, math.log10(0.05), 40)
        sizes += list(parts * length / parts.sum())
    return sizes


def flown(package: Package, sizes: list[float], tolerance: float | None) -> np.ndarray:
    """State at STOP."""
    with package.flight(tolerance, configuration=SLOSH_BEAM) as flight:
        for size in sizes:
            flight.set(delta_e=elevator(flight.time))
            flight.step(size)
        assert math.isclose(flight.time, STOP, rel_tol=1e-12)
        return flight.get(*STATES)


@pytest.mark.parametrize("tolerance", [None, 1e-10], ids=["default", "tight"])
def test_verif_split_steps_change_nothing(package: Package, tolerance: float | None) -> None:
    """Steps of 0.2, 0.02, 0.01, 0.005, 0.001 s and uneven ones lead to the same state."""
    reference = flown(package, cut(0.01), tolerance)
    nominal = [float(package.variables[name].nominal) for name in STATES]
    size = np.maximum(np.abs(reference), nominal) * (tolerance or DEFAULT_TOLERANCE)
    for sizes in (cut(0.2), cut(0.02), cut(0.005), cut(0.001), uneven()):
        error = np.abs(flown(package, sizes, tolerance) - reference) / size
        worst = STATES[int(error.argmax())]
        assert error.max() < SPLIT, f"{len(sizes)} steps, {worst}: {error.max():.2e}"


@pytest.mark.parametrize("size", [0.01, 1.0 / 3.0, 0.0123456789, 1e-9, 0.7, math.pi / 10.0])
def test_verif_step_lands_exactly(package: Package, size: float) -> None:
    """The step ends at t + h to the bit, whatever h is."""
    with package.flight() as flight:
        for _ in range(2):
            flight.step(size)
            assert flight.last_time() == flight.time


def test_verif_altitude_follows_the_flight_path_over_any_step(package: Package) -> None:
    """No part of a step is lost: h - h0 is the integral of V sin(gamma) for odd step sizes."""
    size = 0.0123456789
    with package.flight(gamma0=0.02, configuration=1) as flight:
        history = flight.fly(60, size, names=("h", "V", "gamma"))
    climb = history[:, 1] * np.sin(history[:, 2])
    h, end = history[:, 0] - history[0, 0], climb[-1] - climb[0]
    steps = size * (climb[1:] + climb[:-1]) / 2.0
    np.testing.assert_allclose(h[-1], steps.sum(), rtol=1e-6, atol=1e-6 * abs(end))


def test_verif_last_step_may_miss_the_stop_time_by_rounding(package: Package) -> None:
    """Sums of 0.1 and of 0.01 beyond the stop time by rounding are accepted."""
    for size, count in ((0.1, 10), (0.01, 100)):
        stop = size * count
        with package.instance() as instance:
            instance.initialise(stop=stop)
            for _ in range(count - 1):
                instance.step(size)
            ulp = math.ulp(stop)
            assert instance.step_status(stop - instance.time + 2 * ulp) == OK
            assert instance.log == []


def test_verif_communication_point_may_differ_by_rounding(package: Package) -> None:
    """A master that computes k h and one that adds h up are both understood."""
    with package.flight() as flight:
        for k in range(30):
            assert flight.status("fmi2DoStep", k * 0.1 * 0.1, 0.01, True) == OK
        assert flight.log == []


def test_verif_start_time_is_free(package: Package) -> None:
    """The model knows no clock: a flight that starts at 1000 s is the same flight."""
    with package.flight() as flight:
        first = flight.fly(20, 0.0078125, lambda _: (0.005, 0.0))
    with package.instance() as late:
        late.initialise(start=1024.0)
        assert np.array_equal(late.fly(20, 0.0078125, lambda _: (0.005, 0.0)), first)


@pytest.mark.parametrize("size", [0.0, -0.01, math.nan, math.inf])
def test_verif_step_that_goes_nowhere_is_refused(package: Package, size: float) -> None:
    """Zero, negative and non-finite steps are refused, and the state stays."""
    with package.flight() as flight:
        flight.step(0.01)
        before = flight.bits()
        assert flight.status("fmi2DoStep", flight.time, size, True) != OK
        assert flight.log[-1].text
        assert flight.bits() == before


def test_verif_step_from_the_wrong_time_is_refused(package: Package) -> None:
    """A communication point that is not where the flight is."""
    with package.flight() as flight:
        flight.step(0.01)
        before = flight.bits()
        assert flight.status("fmi2DoStep", 0.5, 0.01, True) != OK
        assert flight.bits() == before
