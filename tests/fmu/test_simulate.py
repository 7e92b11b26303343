"""What users write with FMPy works as it stands."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest

from harness import Package

OUTPUTS = 28


def test_verif_one_line_flies_level(package: Package) -> None:
    """simulate_fmu without any argument: all outputs, trimmed flight, the default experiment."""
    result = fmpy.simulate_fmu(str(package.path))
    assert result["time"][0] == 0.0 and result["time"][-1] == pytest.approx(2.0)
    assert len(result.dtype.names) == 1 + OUTPUTS
    np.testing.assert_allclose(result["V"], result["V"][0], rtol=1e-7)
    assert all(np.isfinite(result[name]).all() for name in result.dtype.names)


@pytest.mark.parametrize("value", [1, "1"])
def test_verif_start_values_by_name(package: Package, value: int | str) -> None:
    """Start values as FMPy takes them: enumerations by number, angles in degrees, Booleans."""
    result = fmpy.simulate_fmu(
        str(package.path),
        start_values={"configuration": value, "gamma0": (1.0, "deg"), "trim": "true"},
        output=["configuration", "gamma0", "gamma", "omega1"],
        stop_time=0.1,
    )
    assert (result["configuration"] == 1).all()
    assert (result["omega1"] == 0.0).all()
    np.testing.assert_allclose(result["gamma"][0], np.radians(1.0), rtol=1e-15)


def test_verif_input_signals_reach_the_vehicle(package: Package) -> None:
    """Inputs as a table; a pair of rows at the same time makes a step."""
    kinds = [("time", float), ("delta_e", float), ("phi", float)]
    table = np.array(
        [(0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.1, 0.01, 0.0), (0.3, 0.01, 0.0)], dtype=kinds
    )
    result = fmpy.simulate_fmu(
        str(package.path),
        input=table,
        output=["delta_e_effective", "q", "alpha"],
        output_interval=0.01,
        stop_time=0.3,
    )
    change = result["delta_e_effective"] - result["delta_e_effective"][0]
    before = result["time"] < 0.105
    assert np.abs(change[before]).max() == 0.0
    np.testing.assert_allclose(change[~before], 0.01, rtol=1e-12)
    assert result["q"][-1] < -1e-3


def test_verif_discard_ends_the_simulation(package: Package) -> None:
    """FMPy ends at the last valid time instead of raising an error."""
    result = fmpy.simulate_fmu(
        str(package.path),
        start_values={"configuration": 1, "delta_e": 0.2, "phi": 0.0},
        output=["alpha", "V"],
        stop_time=5.0,
    )
    assert 0.0 < result["time"][-1] < 5.0
    assert np.isfinite(result["alpha"]).all()


def test_verif_quickstart_runs(package: Package, repository: Path, tmp_path: Path) -> None:
    """The example in the repository, with this FMU."""
    shutil.copytree(repository / "examples", tmp_path / "examples")
    (tmp_path / "target").mkdir()
    shutil.copy(package.path, tmp_path / "target" / "ahv.fmu")
    script = [sys.executable, str(Path("examples") / "fmpy_quickstart.py")]
    run = subprocess.run(script, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    rows = [line for line in run.stdout.splitlines() if line.startswith("t = ")]
    assert len(rows) > 5 and "nan" not in run.stdout.lower()
