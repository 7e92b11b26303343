"""The native autopilot: the law of the example, other gains, and gains that follow the fuel."""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import design
import law
from harness import Instance, Package, Refused, packaged
from margins import margins

MEASURED, COMMANDS = ("V", "gamma", "q"), ("delta_e", "phi")
# Sums of twenty products in another order, in a loop that amplifies rounding.
SAME_LAW = 1e-10
# Designs differ by the rounding of eigenvalue problems in LAPACK, amplified by Riccati equations.
SAME_DESIGN = 1e-6


@pytest.fixture(scope="module")
def autopilot(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The FMU of the autopilot, unzipped once."""
    return packaged(tmp_path_factory.mktemp("autopilot"), "ahv_autopilot")


def schedule(package: Package) -> list[law.Law]:
    """The designs in the FMU."""
    text = (package.folder / design.LAW).read_text(encoding="utf-8")
    return [
        law.Law(**{k: np.array(v) if isinstance(v, list) else v for k, v in values.items()})
        for values in json.loads(text)["designs"]
    ]


def test_verif_commands_are_those_of_the_law_in_numpy(autopilot: Package) -> None:
    """Noise, failed measurements and commands that saturate, for each third design."""
    for own in schedule(autopilot)[2::3]:
        random, pilot = np.random.default_rng(1), law.Autopilot(own)
        with autopilot.flight(fuel_fraction=own.fuel_fraction) as native:
            for k in range(1000):
                measured = own.level + random.normal(size=3) * [3.0, 0.002, 0.01]
                if k % 37 == 5:
                    measured[k % 3] = np.nan
                wanted = np.array([8.0 * np.sin(k / 60), 0.02 * np.cos(k / 90)])
                native.set(**dict(zip(MEASURED, map(float, measured), strict=True)))
                native.set(V_change=float(wanted[0]), gamma_wanted=float(wanted[1]))
                native.step(own.period_s)
                expected = pilot.step(measured, wanted)
                np.testing.assert_allclose(native.get(*COMMANDS), expected, atol=SAME_LAW)
            assert native["missed"] == pilot.missed > 0
            assert native["saturated"] == pilot.saturated > 0


def test_a_speed_of_no_flight_is_not_believed(autopilot: Package) -> None:
    """That of a sensor without a signal, which its noise moves, would upset the estimate."""
    own = max(schedule(autopilot), key=lambda own: own.fuel_fraction)
    with autopilot.flight() as native:
        for share, missed in ((0.0, 1), (1e-4, 2), (0.499, 3), (0.501, 3), (1.0, 3)):
            native.set(V=float(share * own.level[0]))
            native.step(own.period_s)
            assert native["missed"] == missed, share


def test_the_law_in_the_fmu_is_what_the_design_gives_today(
    package: Package, autopilot: Package
) -> None:
    kept = schedule(autopilot)
    assert [own.fuel_fraction for own in kept] == design.FUELS
    for own in (kept[4], kept[-1]):
        (new,) = design.schedule(str(package.folder), [own.fuel_fraction])
        for name, value in vars(own).items():
            scale = np.abs(value).max()
            np.testing.assert_allclose(
                vars(new)[name], value, atol=SAME_DESIGN * scale, err_msg=name
            )


def test_gains_between_designs_keep_two_thirds_of_the_distance(
    package: Package, autopilot: Package
) -> None:
    """In the middle between two designs, where interpolation is worst."""
    kept = schedule(autopilot)
    for before, after in pairwise(kept):
        fuel = 0.5 * (before.fuel_fraction + after.fuel_fraction)
        full = design.model(str(package.folder), fuel_fraction=fuel)
        plant, own = design.sampled(full, design.STATES[design.SLOSH]), design.design(full)
        middle = {
            name: 0.5 * (getattr(before, name) + getattr(after, name))
            for name in ("A", "B", "C", "K", "Ki", "L")
        }
        between = margins(plant, replace(own, **middle))
        assert between.distance > 0.66 * margins(plant, own).distance, fuel


def loop(vehicle: Instance, pilot: Instance, stop_s: float, measured: tuple[str, ...]) -> float:
    """Fly the closed loop; the largest flight-path angle, rad."""
    largest = 0.0
    values = vehicle.get(*measured)
    while vehicle.time < stop_s - 1e-9:
        vehicle.set(**dict(zip(COMMANDS, map(float, pilot.get(*COMMANDS)), strict=True)))
        pilot.set(**dict(zip(measured, map(float, values), strict=True)))
        vehicle.step(law.PERIOD_S)
        pilot.step(law.PERIOD_S)
        values = vehicle.get(*measured)
        largest = max(largest, abs(float(values[1])))
    return largest


def test_gains_that_follow_the_fuel_fly_where_fixed_ones_fail(
    package: Package, autopilot: Package
) -> None:
    """From a tenth of the fuel on: fixed gains lose the vehicle after 138 s."""
    start: dict[str, Any] = {"fuel_fraction": 0.1}
    with (
        package.flight(fuel_burn=True, **start) as vehicle,
        autopilot.flight(**start) as pilot,
    ):
        assert loop(vehicle, pilot, 300.0, (*MEASURED, "fuel_mass")) < 1e-3
    with (
        package.flight(fuel_burn=True, **start) as vehicle,
        autopilot.flight(**start) as pilot,
        pytest.raises(Refused, match="fmi2DoStep"),
    ):
        loop(vehicle, pilot, 300.0, MEASURED)


def test_the_manoeuvre_of_the_parameters_is_that_of_the_inputs(
    package: Package, autopilot: Package
) -> None:
    """A ramp of gamma and a step of speed, which two breakpoints at one time are."""
    breakpoints = [(1.0, 0.0, 0.0), (4.0, 0.0, 0.01), (6.0, 0.0, 0.01), (6.0, 3.0, 0.01)]
    names = ("time", "V_change", "gamma")
    parameters = {
        f"command{i}_{name}": value
        for i, point in enumerate(breakpoints, start=1)
        for name, value in zip(names, point, strict=True)
    }
    flown = []
    for steered in (False, True):
        with (
            package.flight() as vehicle,
            autopilot.flight(**{} if steered else parameters) as pilot,
        ):
            for k in range(1000):
                if steered:
                    ramp = np.interp(k * law.PERIOD_S, [1.0, 4.0], [0.0, 0.01])
                    pilot.set(gamma_wanted=float(ramp), V_change=3.0 if k >= 600 else 0.0)
                loop(vehicle, pilot, (k + 1) * law.PERIOD_S, MEASURED)
            flown.append(vehicle.get(*MEASURED))
            assert pilot["missed"] == pilot["saturated"] == 0
    np.testing.assert_allclose(*flown, atol=SAME_LAW)
    assert flown[0][1] > 0.005


def with_law(autopilot: Package, folder: Path, text: str) -> Package:
    """The FMU with another file of gains."""
    path = folder / "own.fmu"
    (folder / "law.json").write_text(text, encoding="utf-8")
    design.with_law(autopilot.path, folder / "law.json", path)
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder / "own")
    return Package(path, folder / "own")


def test_a_file_of_gains_of_the_wrong_size_is_refused_with_the_place(
    autopilot: Package, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    values = json.loads((autopilot.folder / design.LAW).read_text(encoding="utf-8"))
    values["designs"][3]["K"][1].pop()
    wrong = with_law(autopilot, tmp_path, json.dumps(values))
    messages: list[str] = []

    class Listening(Instance):
        def _hear(self, *arguments: Any) -> None:
            messages.append(arguments[-1].decode())

    with pytest.raises(Exception, match="Failed to instantiate"):
        Listening(wrong)
    assert "law.json: design 4: K has 13 numbers in row 2; 14 are needed" in messages[-1]


def test_own_gains_are_designed_packaged_and_flown(
    package: Package, autopilot: Package, tmp_path: Path
) -> None:
    output = tmp_path / "own.fmu"
    command = [sys.executable, str(design.HERE / "design.py"), "--fmu", str(package.path)]
    command += ["--autopilot", str(autopilot.path), "--output", str(output)]
    run = subprocess.run(
        [*command, "--fuel", "1", "--period", "0.01", "0.02"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout == f"{output}: 2 designs\n"
    with zipfile.ZipFile(output) as archive:
        archive.extractall(tmp_path / "own")
    own = Package(output, tmp_path / "own")
    for period_s in (0.01, 0.02):
        with package.flight(alpha_offset=0.002) as vehicle, own.flight(period=period_s) as pilot:
            assert pilot["sampling_period"] == period_s
            loop(vehicle, pilot, 20.0, MEASURED)
            assert abs(vehicle["gamma"]) < 5e-4
    with pytest.raises(Refused, match=r"law.json has designs for 0.01 s, 0.02 s"):
        own.flight(period=0.005)


@pytest.mark.parametrize("option", [["--period", "0"], ["--fuel", "1.2"], ["--fmu", "none.fmu"]])
def test_a_design_that_cannot_be_is_refused_in_one_line(
    package: Package, option: list[str]
) -> None:
    command = [sys.executable, str(design.HERE / "design.py"), "--fmu", str(package.path), *option]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert run.stderr.startswith("error: ") and run.stderr.count("\n") == 1
