"""Actuators and sensors in the closed loop: alike in all masters, as the linear model predicts."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest

import container
import design
import hardware
import system
from fly import SAME_FLIGHT, agreement
from harness import Package
from law import PERIOD_S, Law, autopilot_beside
from loop import Loop
from margins import loop as linear_loop
from margins import margins
from masters import MasterFailed, fly_ecos, fly_fmpy, fly_libcosim, names

STOP_S = 8.0
MANOEUVRE = Path(design.__file__).with_name("manoeuvre.csv")


def loop(package: Package, is_silent: bool = False) -> list[system.Component]:
    """Autopilot, sensors, actuators and vehicle."""
    between = [
        part._replace(parameters=part.parameters | {"noise": 0.0})
        if is_silent and "noise" in part.parameters
        else part
        for part in hardware.components(package.path)
    ]
    return system.native(package.path, autopilot_beside(package.path), MANOEUVRE, between=between)


@pytest.fixture(scope="module")
def folder(package: Package, tmp_path_factory: pytest.TempPathFactory) -> str:
    """The container of the loop, unzipped."""
    path = tmp_path_factory.mktemp("hardware")
    container.build(path / "loop.fmu", loop(package))
    with zipfile.ZipFile(path / "loop.fmu") as archive:
        archive.extractall(path / "loop")
    return str(path / "loop")


def test_a_loop_with_hardware_is_alike_in_all_masters(
    package: Package, folder: str, tmp_path: Path
) -> None:
    """With the noise of the sensors, whose seeds are parameters too."""
    files = [
        system.build(tmp_path / f"{version}.ssp", loop(package), STOP_S, version)
        for version in ("1.0", "2.0")
    ]
    one, two = (fly_libcosim(file, tmp_path / "flight.csv", STOP_S) for file in files)
    outputs = names(files[0])
    assert np.array_equal(one, two)
    settings = container.settings(loop(package))
    with Loop(folder, ("V", "gamma", "slosh2", "n_z")) as instance:
        rows = instance.fly(settings, STOP_S, PERIOD_S).rows
    for column, name in enumerate(("V", "gamma", "slosh2", "n_z"), start=1):
        values = one[:, 1 + outputs.index(f"vehicle.{name}")]
        assert np.abs(rows[:, column] - values).max() < SAME_FLIGHT * np.ptp(values), name
    try:
        readings = one[:, 1 + outputs.index("V_sensor.y")] - one[:, 1 + outputs.index("vehicle.V")]
        assert 0.45 < readings.std() < 0.55
        direct = ("n_z", "delta_e_effective", "phi_effective", "choking_margin")
        assert agreement(one, fly_ecos(files[0], STOP_S), outputs, direct) < SAME_FLIGHT
    except MasterFailed as left_out:
        assert "Ecos cannot be loaded" in str(left_out)


def test_without_noise_fmpy_flies_alike_too(package: Package, tmp_path: Path) -> None:
    """Its first two readings are zero, which the autopilot does not believe."""
    file = system.build(tmp_path / "loop.ssp", loop(package, is_silent=True), STOP_S, "1.0")
    theirs, ours = fly_fmpy(file, STOP_S), fly_libcosim(file, tmp_path / "flight.csv", STOP_S)
    assert agreement(ours, theirs, names(file)) < SAME_FLIGHT
    missed = 1 + names(file).index("autopilot.missed")
    assert theirs[-1, missed] == 2.0 and ours[-1, missed] == 0.0


def test_the_loop_moves_as_the_linear_model_with_hardware(package: Package, folder: str) -> None:
    """A thousandth of a degree of incidence too much."""
    full, law = design.model(str(package.folder)), Law.within(autopilot_beside(package.path))
    states, offset, count = design.STATES[design.SLOSH], 1e-5, 100
    a = linear_loop(hardware.with_hardware(full), law).closed(np.ones(2))
    x = np.zeros(len(a))
    x[states.index("alpha")] = offset
    reading = slice(len(states) + 4, len(states) + 7)
    # Before the first exchange the sensors have read the start.
    x[reading] = hardware.with_hardware(full).A[reading] @ x[: reading.stop]
    predicted, level = [], system.native(package.path, autopilot_beside(package.path))
    settings = container.settings([*level, *loop(package, is_silent=True)[1:]])
    for _ in range(count):
        x = a @ x
        predicted.append(x[[states.index(name) for name in ("gamma", "alpha")]])
    with Loop(folder, ("gamma", "alpha")) as instance:
        still, moved = (
            instance.fly(settings | start, count * PERIOD_S, PERIOD_S).rows
            for start in ({}, {"vehicle.alpha_offset": offset})
        )
    flown = moved[:, 1:] - still[:, 1:]
    assert np.abs(flown - predicted).max() < 0.01 * np.abs(predicted).max()


def test_an_actuator_that_is_too_slow_loses_the_vehicle(package: Package, folder: str) -> None:
    full, law = design.model(str(package.folder)), Law.within(autopilot_beside(package.path))
    slow = {"bandwidth": 10.0}
    actuators = hardware.ACTUATORS | {"delta_e": hardware.ACTUATORS["delta_e"] | slow}
    assert margins(hardware.with_hardware(full, actuators), law).growth_per_s > 0.0
    assert margins(hardware.with_hardware(full), law).phase_deg > 30.0
    settings = container.settings(loop(package))
    with Loop(folder, ("V", "gamma")) as instance:
        assert not instance.fly(settings, 60.0, 0.5).ended
        flown = instance.fly(settings | {"delta_e_actuator.bandwidth": 10.0}, 60.0, 0.5)
    assert flown.ended and len(flown.rows) < 120


@pytest.mark.parametrize(("signal", "largest"), [("v", 0.001), ("gamma", 0.01)])
def test_a_flight_survives_the_loss_of_a_sensor(
    package: Package, folder: str, signal: str, largest: float
) -> None:
    """Before the climb, for good: what the model expects takes the place of the reading."""
    settings, stop_s, at_s = container.settings(loop(package)), 60.0, 2.0
    failure = {f"{signal}_sensor.failure": 6, f"{signal}_sensor.failure_time": at_s}
    with Loop(folder, ("gamma", "missed")) as instance:
        whole = instance.fly(settings, stop_s, PERIOD_S).rows
        lost = instance.fly(settings | failure, stop_s, PERIOD_S)
    assert not lost.ended
    before, steps = round(at_s / PERIOD_S), round(stop_s / PERIOD_S)
    assert np.array_equal(lost.rows[:before, 1:], whole[:before, 1:])
    assert lost.rows[-1, 2] == pytest.approx(steps - before, abs=1)
    assert np.abs(lost.rows[:, 1] - whole[:, 1]).max() < largest
