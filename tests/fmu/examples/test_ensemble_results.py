"""What an ensemble says: rows, probabilities, the worst flights, and what decides."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest

import batch
import ensemble
import replay
import summary
from batch import Loaded, Task, fly_all
from harness import Package
from sampling import sample
from vehicles import VARIED

# Needs more elevator than there is.
WEAK = {"aero": 1.0, "fuel_fraction": 1.0, "elevator_factor": 0.5}


def test_a_vehicle_that_cannot_be_trimmed_is_a_row_with_the_reason(
    fmus: Loaded, task: Task
) -> None:
    vehicle = sample(1, 1)[0]
    weak = np.array(list((dict(zip(VARIED, vehicle, strict=True)) | WEAK).values()))
    row, good = fly_all(fmus, task._replace(vehicles=np.array([weak, vehicle]), stop_s=1.0))
    assert not row["trimmed"] and "delta_e" in row["ended"] and row["flown_s"] == 0.0
    assert good["trimmed"] and good["ended"] == "" and good["flown_s"] == pytest.approx(1.0)
    # The columns of a table do not depend on the first vehicle, and no vehicle is lost.
    table = pa.Table.from_pylist([row, good], batch.SCHEMA)
    assert set(row) == set(good) == set(table.column_names)
    assert pa.Table.from_pylist([row], batch.SCHEMA).schema == table.schema
    said = summary.summary(table)
    assert "2 vehicles" in said and re.search(r"50\.00 % \(9\.45 to 90\.55\)  no trim: 1", said)
    (reason,) = summary.refusals(table)
    assert "delta_e" in reason


def test_a_flight_that_ends_early_is_a_row_with_reason_and_time(fmus: Loaded, task: Task) -> None:
    """Slosh that grows until the liquid leaves its depth."""
    vehicle = dict.fromkeys(VARIED, 1.0) | {
        **{"slosh_damping": 0.005, "slosh_frequency": 5.0},
        **{"mass_centre_shift": 0.0, "pitch_rate_factor": 0.0},
    }
    vehicles = np.array([list(vehicle.values())])
    (row,) = fly_all(fmus, task._replace(vehicles=vehicles, stop_s=60.0))
    assert row["ended"].startswith("fmi2DoStep: slosh") and row["growth_per_s"] > 0.0
    until_s = float(re.search(r"at t = ([\d.]+) s", row["ended"])[1])
    assert until_s - 2 * batch.STEP_S < row["flown_s"] <= until_s < 60.0
    assert len(row["V_m_per_s"]) == 1 + int(row["flown_s"] / batch.SAMPLE_S)


def test_a_row_that_is_not_its_flight_is_named(fmus: Loaded, task: Task) -> None:
    (row,) = fly_all(fmus, task._replace(vehicles=sample(1, 1)))
    again = replay.fly(fmus, task, row)
    assert replay.same(again, row)
    row["gamma_rad"][-1] = np.nextafter(row["gamma_rad"][-1], 1.0)
    assert not replay.same(again, row)


def test_the_worst_are_picked() -> None:
    """Of stable, unstable, ended and untrimmed vehicles."""
    table = pa.table(
        {
            "trimmed": [True, True, True, True, True, False],
            "ended": ["", "alpha", "slosh1", "", "", "no trim"],
            "flown_s": [20.0, 7.0, 5.0, 20.0, 20.0, 0.0],
            "growth_per_s": [-0.1, 0.9, 0.2, 0.3, -0.2, None],
            "phase_deg": [12.0, np.nan, np.nan, np.nan, 9.0, None],
        }
    )
    assert replay.worst(table) == {
        "ended first": 2,
        "fastest growth": 3,
        "least phase margin": 4,
    }


def test_probabilities_have_their_intervals() -> None:
    """By Wilson: 5 of 50, from the formula; and 0 of 20, which excludes more than 16 %."""
    n, p, z = 50, 0.1, 1.959964
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z / (1 + z**2 / n) * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    assert summary.interval(5, n) == pytest.approx((middle - half, middle + half), abs=1e-6)
    assert summary.interval(0, 20) == pytest.approx((0.0, 0.161), abs=5e-4)


def test_sensitivity_is_found_where_it_is(package: Package, tmp_path: Path) -> None:
    """The coefficient set and the liquid decide; 64 samples show that."""
    line = [sys.executable, str(ensemble.HERE / "sensitivity.py"), "--fmu", str(package.path)]
    line += ["--output", str(tmp_path), "--samples"]
    done = subprocess.run([*line, "64"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    tables = done.stdout.split("|---|---|---|")[1:]
    for table in tables:
        names = re.findall(r"^\| `(\w+)`", table, re.MULTILINE)
        assert set(names) == set(VARIED)
        assert set(names[:3]) <= {"aero", "slosh_damping", "slosh_frequency", "fuel_fraction"}
    assert (tmp_path / "sensitivity.png").stat().st_size > 10_000
    done = subprocess.run([*line, "60"], capture_output=True, text=True, check=False)
    assert done.returncode == 1 and done.stderr == "error: --samples 60 is no power of two\n"
