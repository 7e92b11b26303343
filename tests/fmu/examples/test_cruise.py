"""The example of a cruise while the fuel burns: what it claims."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np

import cruise
import design
from harness import Package

# Largest difference from the trim with the remaining fuel, rad, rad and 1: the integrators lag when
# the trim starts to change, the fuel ratio for the first half minute.
LAG = {"alpha": 0.003 * design.DEG, "delta_e_effective": 0.006 * design.DEG, "phi_effective": 1e-3}


def test_cruise_follows_the_trim_of_the_lighter_vehicle(package: Package) -> None:
    """After two minutes trims have moved by many times the lag."""
    found = cruise.cruise(str(package.folder), 120.0)
    assert not found.flight.ended and not found.flight.pilot.saturated
    for name, trims in found.trimmed.items():
        flown = found.flown[name][found.places]
        assert np.abs(flown - trims).max() < LAG[name], name
        assert np.ptp(trims) > 5.0 * LAG[name], name
    assert np.abs(found.flown["V"] - found.flown["V"][0]).max() < 0.2
    burnt = np.ptp(found.flown["fuel_mass"])
    assert 2.1 < burnt / 120.0 < 2.3


def test_cruise_example_writes_its_table_and_picture(package: Package, tmp_path: Path) -> None:
    script = [sys.executable, cruise.__file__, "--fmu", str(package.path), "--stop", "5"]
    run = subprocess.run(
        [*script, "--output", str(tmp_path)], capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert "times real time" in run.stdout and "margins at the end" in run.stdout
    rows = np.genfromtxt(tmp_path / "cruise.csv", delimiter=",", names=True)
    assert len(rows) == 5 and (np.diff(rows["fuel_mass"]) < 0.0).all()
    assert (tmp_path / "cruise.png").stat().st_size > 10_000
