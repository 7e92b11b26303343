"""An input file means the same everywhere: FMPy in both interfaces, NumPy and `cargo ahv fly`."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.util import read_csv

from harness import Package

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
STEP = 0.01
# Of the integration; the open loop makes a thousand of an error in 2 s.
TOLERANCE = 1e-11
# End of the flight, s: the gust is lost soon after; tolerance in FMPy: across the corners of a gust
# its integrator finds no step for the other.
SHIPPED = {
    "elevator_doublet": (2.0, TOLERANCE),
    "throttle_step": (2.0, TOLERANCE),
    "gust": (1.2, 1e-8),
}
NAMES = ("V", "gamma", "alpha", "q", "eta1", "slosh1")
# Relative, of a value at the end.
AGREEMENT = 1e-6


def fly(
    package: Package, output: Path, *options: str, step: float = STEP
) -> tuple[np.ndarray, str]:
    """The record of a flight by the tool, and its hints."""
    command = ["cargo", "ahv", "fly", "--fmu", str(package.path), "--output", str(output)]
    command += ["--step", str(step), "--tolerance", str(TOLERANCE), *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=EXAMPLES.parent)
    assert done.returncode == 0, done.stderr
    record = np.genfromtxt(output / "flight.csv", delimiter=",", names=True)
    return record, done.stderr


def in_fmpy(
    package: Package, table: np.ndarray, kind: str, stop: float, tolerance: float
) -> np.ndarray:
    """The same in FMPy."""
    return simulate_fmu(
        str(package.path),
        fmi_type=kind,
        stop_time=stop,
        output_interval=STEP,
        relative_tolerance=tolerance,
        input=table,
        output=NAMES,
    )


@pytest.mark.parametrize("name", SHIPPED)
def test_verif_a_shipped_manoeuvre_is_one_everywhere(
    package: Package, tmp_path: Path, name: str
) -> None:
    """Jumps are doubled rows, and every reader ends in the same state."""
    file, (stop, tolerance) = EXAMPLES / f"{name}.csv", SHIPPED[name]
    table = np.genfromtxt(file, delimiter=",", names=True)
    assert np.array_equal(table, read_csv(str(file)))
    assert not any(np.isnan(table[column]).any() for column in table.dtype.names)
    still = np.diff(table["time"]) == 0.0
    for column in table.dtype.names[1:]:
        # No ramp that stands for a jump.
        ramps = np.diff(table[column])[~still]
        assert name == "gust" or not ramps.any()
    # In co-simulation FMPy holds inputs during a step, so there it has no slope of the gust.
    kinds = ("ModelExchange",) if name == "gust" else ("ModelExchange", "CoSimulation")
    flown = [in_fmpy(package, table, kind, stop, tolerance) for kind in kinds]
    ours, _ = fly(package, tmp_path, "--input", str(file), "--stop", str(stop))
    for column in NAMES:
        moved = np.ptp(ours[column])
        assert moved > 0.0, column
        for theirs in flown:
            error = abs(theirs[column][-1] - ours[column][-1])
            assert error <= AGREEMENT * abs(ours[column][-1]), column
            # Deviations from the start are small beside some values.
            assert error <= 1e-4 * moved, column


def test_verif_ramps_do_not_depend_on_the_step(package: Package, tmp_path: Path) -> None:
    """A step ends at every row and follows the slope: as exact in long steps as in short ones."""
    file = tmp_path / "ramp.csv"
    file.write_text(
        "time;delta_e[deg];phi\n0;0;0\n0,1;0;0\n0,333;0,2;0,01\n0,333;-0,1;0,01\n0,71;0;0\n",
        "utf-8",
    )
    short, _ = fly(package, tmp_path, "--input", str(file), "--stop", "1")
    long, _ = fly(package, tmp_path, "--input", str(file), "--stop", "1", step=0.4)
    times = long["time"].tolist()
    assert times == [0.0, 0.1, 0.333, 0.333, 0.4, 0.71, 0.8, 1.0]
    for column in (*NAMES, "delta_e", "phi"):
        assert long[column][-1] == pytest.approx(short[column][-1], rel=AGREEMENT, abs=1e-12)
    np.testing.assert_allclose(np.degrees(long["delta_e"][2:4]), [0.2, -0.1], rtol=1e-12)


def test_verif_a_record_flies_the_same_again(package: Package, tmp_path: Path) -> None:
    """One's own result is an input file: jumps have two rows, outputs are named and not read."""
    first, said = fly(package, tmp_path / "one")
    assert said == ""
    assert (np.diff(first["time"]) == 0.0).sum() == 3
    record = tmp_path / "one" / "flight.csv"
    again, said = fly(package, tmp_path / "two", "--input", str(record))
    assert "no inputs and are not read: V, " in said
    assert (tmp_path / "two" / "flight.csv").read_bytes() == record.read_bytes()
    assert again.dtype == first.dtype
