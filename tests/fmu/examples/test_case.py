"""Cases of the closed loop: other parameters of the vehicle, other FMUs, flights that are short."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import system
from fly import agreement
from harness import Package
from law import autopilot_beside
from system import BadSystem

STOP_S = 3.0
KINDS = pytest.mark.parametrize("kind", [[], ["--python"], ["--hardware"]], ids=str)


def fly(package: Package, output: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Fly level for a short while."""
    command = [sys.executable, str(system.HERE / "fly.py"), "--fmu", str(package.path)]
    command += ["--stop", str(STOP_S), "--output", str(output), *options]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@KINDS
def test_the_autopilot_knows_level_flight_of_the_case(
    package: Package, tmp_path: Path, kind: list[str]
) -> None:
    run = fly(package, tmp_path, "--set", "mach0=8.2", *kind)
    assert run.returncode == 0, run.stderr
    rows = np.genfromtxt(tmp_path / "libcosim.csv", delimiter=",", names=True, deletechars="")
    speed = rows["vehicle.V"]
    assert speed[0] == pytest.approx(2451.716, abs=1e-3)
    # With the level flight of Mach 8 it loses 5 m/s in this time.
    assert np.abs(speed - speed[0]).max() < 0.2


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (["sludge=1"], "there is no parameter sludge"),
        (["V=1"], "there is no parameter V"),
        (["aero=2"], "aero is not real: masters do not set it alike"),
        (["elevator_factor=0.1"], "no trim at mach0 = 8"),
        (["mach0=nan"], "mach0 = nan is refused: a number is expected"),
        (["mach0=99"], "mach0 = 99 is refused"),
    ],
)
def test_a_case_that_is_none_is_refused_in_a_line(
    package: Package, tmp_path: Path, settings: list[str], said: str
) -> None:
    for kind in ([], ["--python"]):
        run = fly(
            package, tmp_path, *kind, *(part for text in settings for part in ("--set", text))
        )
        assert run.returncode == 1 and run.stderr.count("\n") == 1
        assert run.stderr.startswith("error: ") and said in run.stderr


def test_a_flight_in_which_nothing_changes_is_compared_all_the_same() -> None:
    level = np.ones((5, 3))
    outputs = ["vehicle.V", "vehicle.h"]
    assert agreement(level, level, outputs) == 0.0
    assert agreement(level, level + 1e-3, outputs) == pytest.approx(1e-3)


def test_fmus_of_fmi_3_are_refused_by_name(package: Package, tmp_path: Path) -> None:
    newer = package.path.with_name(f"{package.path.stem}_fmi3.fmu")
    parts = system.native(newer, autopilot_beside(package.path))
    with pytest.raises(BadSystem, match=r"_fmi3.fmu is of FMI 3.0: give FMUs of FMI 2.0"):
        system.build(tmp_path / "bad.ssp", parts, STOP_S)
