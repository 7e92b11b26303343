"""What every example says when something it needs is not there."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from harness import Package

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
SCRIPTS = (
    "closed_loop/fly.py",
    "closed_loop/sloshing.py",
    "closed_loop/coupling.py",
    "closed_loop/container.py",
    "closed_loop/steps.py",
    "closed_loop/hardware.py",
    "closed_loop/design.py",
    "closed_loop/cruise.py",
    "closed_loop/own_controller.py",
    "ensemble/ensemble.py",
    "ensemble/replay.py",
    "ensemble/sensitivity.py",
    "ensemble/rates.py",
    "gusts/gusts.py",
)


def run(script: str, *options: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run an example."""
    return subprocess.run(
        [sys.executable, str(EXAMPLES / script), *options],
        capture_output=True,
        text=True,
        env=os.environ | environment,
        check=False,
    )


def output(script: str, folder: Path) -> list[str]:
    """Where the example writes, unless it only prints."""
    prints = ("steps.py", "hardware.py", "own_controller.py")
    return [] if script.endswith(prints) else ["--output", str(folder / "out")]


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_missing_package_is_named_with_the_command_that_brings_it(
    script: str, tmp_path: Path
) -> None:
    (tmp_path / "fmpy.py").write_text("raise ModuleNotFoundError(name='fmpy')\n", "utf-8")
    done = run(script, PYTHONPATH=str(tmp_path))
    assert done.returncode == 1
    assert done.stderr.startswith("fmpy is missing: pip install")


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_missing_fmu_is_named_with_the_command_that_makes_it(script: str, tmp_path: Path) -> None:
    done = run(script, "--fmu", str(tmp_path / "none.fmu"), *output(script, tmp_path))
    assert done.returncode == 1
    assert done.stderr.startswith("error: ") and "none.fmu" in done.stderr
    assert "run `cargo ahv package`" in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_file_that_is_no_fmu_is_refused_in_one_line(script: str, tmp_path: Path) -> None:
    for name in ("ahv.fmu", "ahv_autopilot.fmu"):
        (tmp_path / name).write_text("none", "utf-8")
    done = run(script, "--fmu", str(tmp_path / "ahv.fmu"), *output(script, tmp_path))
    assert done.returncode == 1
    assert done.stderr.startswith("error: ") and done.stderr.count("\n") == 1
    assert "ahv.fmu is no FMU" in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_controller_in_python_climbs_and_is_lost_with_its_gyro(package: Package) -> None:
    script, fmu = "closed_loop/own_controller.py", str(package.path)
    done = run(script, "--fmu", fmu)
    assert done.returncode == 0, done.stderr
    *_, last = done.stdout.splitlines()
    time_s, wanted, gamma, _, elevator = map(float, last.split())
    assert (time_s, wanted) == (60.0, 1.0)
    assert gamma == pytest.approx(1.0, abs=0.05) and elevator < 19.0
    lost = run(script, "--fmu", fmu, "--stuck", "10")
    assert lost.returncode == 1 and "alpha = 0.174533 reached the edge" in lost.stdout + lost.stderr
