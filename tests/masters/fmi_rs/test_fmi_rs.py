"""fmi-rs, an importer in Rust: its co-simulation, and its model exchange with a solver of ours."""

from __future__ import annotations

import os
import subprocess
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from harness import CONTROLS, REPOSITORY, Package
from reference import (
    EXACT,
    FLIGHTS,
    JUMPS,
    NAMES,
    OTHER_SOLVER,
    STEP,
    STEPS,
    Flight,
    Reference,
)


@pytest.fixture(scope="session")
def program() -> Path:
    """The Rust program beside this file, compiled."""
    target = REPOSITORY / "target" / "fmi_rs"
    manifest = Path(__file__).with_name("Cargo.toml")
    command = [os.environ.get("CARGO", "cargo"), "build", "--quiet", "--locked"]
    command += ["--manifest-path", str(manifest), "--target-dir", str(target)]
    subprocess.run(command, check=True)
    return target / "debug" / "fly"


def fly(
    program: Path, version: int, kind: str, package: Package, flight: Flight, folder: Path
) -> np.ndarray:
    """Values of NAMES after each step, of the FMU for this version of the standard."""
    fmu = package.path if version == 2 else package.path.with_name(f"{package.path.stem}_fmi3.fmu")
    jumps = [*JUMPS, STEPS]
    # fmi-rs interpolates between rows: a jump is two rows with the same time.
    rows = [
        (step * STEP, *flight.controls(first))
        for first, last in pairwise(jumps)
        for step in (first, last)
    ]
    controls, result = folder / "controls.csv", folder / "result.csv"
    header = ",".join(["time", *CONTROLS])
    np.savetxt(controls, rows, fmt="%.17g", delimiter=",", header=header, comments="")
    command = [program, version, kind, fmu, controls, result, STEP, STEPS * STEP, ",".join(NAMES)]
    command += [f"{name}={value}" for name, value in flight.start.items()]
    subprocess.run(list(map(str, command)), check=True)
    flown = np.loadtxt(result, delimiter=",", skiprows=1)
    # The first of two rows with the same time is before the jump of the controls.
    _, first = np.unique(flown[:, 0], return_index=True)
    return flown[first[1:], 1:]


@pytest.mark.parametrize("flight", FLIGHTS, ids=str)
def test_verif_master_flies_like_fmpy(
    program: Path, package: Package, reference: Reference, flight: Flight, tmp_path: Path
) -> None:
    """Every state and output at every communication point; FMI 3.0 has the bits of FMI 2.0."""
    rows = fly(program, 2, "cs", package, flight, tmp_path)
    reference.compare(flight, rows)
    assert np.array_equal(rows, fly(program, 3, "cs", package, flight, tmp_path))


@pytest.mark.parametrize("flight", FLIGHTS, ids=str)
def test_verif_master_integrates_like_fmpy(
    program: Path, package: Package, reference: Reference, flight: Flight, tmp_path: Path
) -> None:
    """Every state and output, a solver outside of the FMU against FMPy's flight by that inside."""
    rows = fly(program, 2, "me", package, flight, tmp_path)
    reference.compare(flight, rows, limit=OTHER_SOLVER, tolerance=EXACT, label="exchange")
    assert np.array_equal(rows, fly(program, 3, "me", package, flight, tmp_path))
