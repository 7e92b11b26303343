"""An input file means the same everywhere: FMPy in both interfaces, NumPy and `cargo ahv fly`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.util import read_csv

from harness import Package, ahv

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
STEP = 0.01
# Tolerance of the integration; the open loop amplifies an error a thousand times in 2 s.
TOLERANCE = 1e-11
# Duration, s; in the gust the vehicle is lost soon after.
STOP, GUST_STOP = 2.0, 1.2
NAMES = ("V", "gamma", "alpha", "q", "eta1", "slosh1")
# Relative to a final value.
AGREEMENT = 1e-6
# Relative to the excursion, as some values hardly change.
MOVED = 1e-4


def fly(
    package: Package, output: Path, *options: str, step: float = STEP
) -> tuple[np.ndarray, str]:
    """The record of a flight by the tool, and its hints."""
    where = ("--fmu", package.path, "--output", output)
    done = ahv("fly", *where, "--step", step, "--tolerance", TOLERANCE, *options)
    assert done.returncode == 0, done.stderr
    record = np.genfromtxt(output / "flight.csv", delimiter=",", names=True)
    return record, done.stderr


def in_fmpy(
    package: Package, table: np.ndarray, stop: float, kind: str = "CoSimulation", step: float = STEP
) -> np.ndarray:
    """The same in FMPy."""
    return simulate_fmu(
        str(package.path),
        fmi_type=kind,
        stop_time=stop,
        output_interval=step,
        relative_tolerance=TOLERANCE,
        input=table,
        output=NAMES,
    )


def assert_same_end(theirs: dict[str, float], ours: np.ndarray) -> None:
    """Equal in the last row, relative to the value and to how far it moved."""
    for name in NAMES:
        error, moved = abs(theirs[name] - ours[name][-1]), np.ptp(ours[name])
        assert 0.0 < moved, name
        assert error <= AGREEMENT * abs(ours[name][-1]), name
        assert error <= MOVED * moved, name


@pytest.mark.parametrize("name", ["elevator_doublet", "throttle_step"])
def test_verif_a_shipped_manoeuvre_is_one_everywhere(
    package: Package, tmp_path: Path, name: str
) -> None:
    """Jumps are doubled rows, and every reader ends in the same state."""
    file = EXAMPLES / f"{name}.csv"
    table = np.genfromtxt(file, delimiter=",", names=True)
    assert np.array_equal(table, read_csv(str(file)))
    still = np.diff(table["time"]) == 0.0
    for column in table.dtype.names[1:]:
        ramps = np.diff(table[column])[~still]
        assert not ramps.any(), "a ramp that stands for a jump"
    ours, _ = fly(package, tmp_path, "--input", str(file), "--stop", str(STOP))
    for kind in ("CoSimulation", "ModelExchange"):
        assert_same_end(in_fmpy(package, table, STOP, kind)[-1], ours)


def test_verif_a_gust_is_the_same_in_the_limit_of_short_steps(
    package: Package, tmp_path: Path
) -> None:
    """FMPy holds an input during a step: its error is of first order, and extrapolated away."""
    file = EXAMPLES / "gust.csv"
    table = np.genfromtxt(file, delimiter=",", names=True)
    ours, _ = fly(package, tmp_path, "--input", str(file), "--stop", str(GUST_STOP))
    long, short = (in_fmpy(package, table, GUST_STOP, step=step)[-1] for step in (5e-4, 2.5e-4))
    theirs = {name: 2.0 * short[name] - long[name] for name in NAMES}
    assert_same_end(theirs, ours)
    assert abs(long["q"] - ours["q"][-1]) > MOVED * np.ptp(ours["q"]), "a step makes a difference"


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
    assert "not inputs and are ignored: V, " in said
    assert (tmp_path / "two" / "flight.csv").read_bytes() == record.read_bytes()
    assert again.dtype == first.dtype
