"""The sensor: noise beside a second implementation, statistics, samples and failures in FMPy."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

from harness import Package, Refused, package_path, packaged

PERIOD, NOISE, SEED = 0.01, 0.25, 11
NOISY = {"period": PERIOD, "noise": NOISE, "seed": SEED}
VERSIONS = ("2.0", "3.0")


@pytest.fixture(scope="module")
def sensor(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The FMU of the sensor, unzipped once."""
    return packaged(tmp_path_factory.mktemp("sensor"), "ahv_sensor")


def normal(seed: int, sample: int) -> float:
    """Philox4x32-10 and Box-Muller, with Python's integers."""
    mask = 0xFFFFFFFF
    a, b, c, d = sample & mask, sample >> 32, 0, 0
    key = [seed & mask, 0]
    for _ in range(10):
        first, second = 0xD2511F53 * a, 0xCD9E8D57 * c
        a, b = second >> 32 ^ b ^ key[0], second & mask
        c, d = first >> 32 ^ d ^ key[1], first & mask
        key = [key[0] + 0x9E3779B9 & mask, key[1] + 0xBB67AE85 & mask]
    radius = ((b << 32 | a) >> 11) + 1
    angle = (d << 32 | c) >> 11
    return math.sqrt(-2.0 * math.log(radius / 2**53)) * math.cos(math.tau * angle / 2**53)


def simulated(version: str, stop: float, step: float, **start: Any) -> np.ndarray:
    """Readings of FMPy's own loop."""
    return simulate_fmu(
        str(package_path("ahv_sensor", version)),
        stop_time=stop,
        output_interval=step,
        start_values=start,
        output=["y"],
    )["y"]


@pytest.mark.parametrize("version", VERSIONS)
def test_verif_fmpy_finds_no_problem_in_the_sensor(version: str) -> None:
    assert validate_fmu(str(package_path("ahv_sensor", version))) == []


def test_verif_readings_have_no_unit_of_their_own(sensor: Package) -> None:
    """A master connects them to any quantity."""
    for name in ("u", "y", "bias", "noise", "quantum", "failure_value"):
        assert sensor.variables[name].unit is None, name


@pytest.mark.parametrize("step", [PERIOD / 4, PERIOD, 5 * PERIOD])
def test_verif_noise_is_that_of_seed_and_sample_number_at_any_step(step: float) -> None:
    """Beside a second implementation."""
    readings = simulated(VERSIONS[0], 2.0, step, u=3.0, **NOISY)
    samples = [math.floor(i * step / PERIOD + 1e-6) for i in range(len(readings))]
    expected = [3.0 + NOISE * normal(SEED, sample) for sample in samples]
    np.testing.assert_allclose(readings, expected, rtol=0, atol=2e-15)


def test_verif_noise_is_white_with_the_variance_asked_for() -> None:
    """Within five standard deviations of estimates from so many samples."""
    readings = simulated(VERSIONS[0], 200.0, PERIOD, **NOISY) / NOISE
    count = len(readings)
    assert count == 20001
    assert abs(readings.mean()) < 5.0 / math.sqrt(count)
    assert abs(readings.var() - 1.0) < 5.0 * math.sqrt(2.0 / count)
    for lag in (1, 2, 3, 10, 100):
        covariance = np.mean(readings[lag:] * readings[:-lag])
        assert abs(covariance) < 5.0 / math.sqrt(count), lag


def test_verif_both_standards_read_alike() -> None:
    """The same bits."""
    options = NOISY | {"u": 2.0, "lag": 0.1, "quantum": 0.125, "scale": 1.5, "bias": -1.0}
    first, second = (simulated(version, 2.0, 0.004, **options) for version in VERSIONS)
    assert first.tobytes() == second.tobytes()
    assert np.all(first * 8.0 == np.round(first * 8.0)) and len(set(first)) > 5


def test_verif_a_kept_state_goes_on_with_the_same_noise(sensor: Package) -> None:
    """Back in time, and on again."""
    with sensor.flight(**NOISY) as flight:
        for _ in range(7):
            flight.step(0.004)
        kept, time = flight.fmu.getFMUstate(), flight.time
        flown = []
        for _ in range(2):
            flight.fmu.setFMUstate(kept)
            flight.time = time
            readings = []
            for _ in range(20):
                flight.step(0.004)
                readings.append(flight["y"])
            flown.append(readings)
        flight.fmu.freeFMUstate(kept)
        assert flown[0] == flown[1] and len(set(flown[0])) > 5


@pytest.mark.parametrize("version", VERSIONS)
def test_only_the_failure_asked_for_reads_nan(version: str) -> None:
    readings = simulated(version, 1.0, 0.1, u=1.0, failure=6, failure_time=0.5)
    assert np.all(readings[:5] == 1.0) and np.all(np.isnan(readings[5:]))


def test_noise_without_a_period_is_refused(sensor: Package) -> None:
    with pytest.raises(Refused, match="set period to the sampling period, or noise to 0"):
        sensor.flight(noise=0.1)
