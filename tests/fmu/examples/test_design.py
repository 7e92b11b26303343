"""What the design of own gains says when it cannot be."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import design
from harness import Package
from law import autopilot_beside


def refused(package: Package, *options: str) -> str:
    """The line with which the program ends."""
    command = [sys.executable, str(Path(design.__file__)), "--fmu", str(package.path), *options]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert run.stderr.startswith("error: ") and run.stderr.count("\n") == 1
    return run.stderr


@pytest.mark.parametrize("period", ["-0.01", "nan", "inf", "5"])
def test_a_period_without_a_design_is_refused(package: Package, period: str) -> None:
    assert "at most 0.1 s" in refused(package, "--period", "0.01", period)


@pytest.mark.parametrize("fuel", ["-0.1", "nan"])
def test_fuel_that_no_tank_has_is_refused(package: Package, fuel: str) -> None:
    assert "within 0 and 1" in refused(package, "--fuel", "1", fuel)


def test_gains_go_into_an_autopilot_only(package: Package, tmp_path: Path) -> None:
    for source, name, said in (
        (package.path, "own.fmu", "is not the FMU ahv_autopilot"),
        (autopilot_beside(package.path), "own.json", "with --autopilot the output is an FMU"),
    ):
        output = tmp_path / name
        assert said in refused(package, "--autopilot", str(source), "--output", str(output))
        assert not output.exists()
