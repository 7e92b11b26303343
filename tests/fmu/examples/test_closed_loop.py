"""The example of a closed loop: what it claims, and what it says when something goes wrong."""

from __future__ import annotations

import csv
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import coupling
import design
import flight
from harness import Package
from law import HIGH
from masters import NAMES, MasterFailed, fly_libcosim
from system import BadSystem, build, validate

EXAMPLE = Path(design.__file__).parent
# Short flight: the climb begins at 5 s.
STOP_S = 8.0


def example(
    script: str, package: Package, output: Path, *options: str
) -> subprocess.CompletedProcess[str]:
    """Run a script of the example."""
    command = [sys.executable, str(EXAMPLE / script), "--fmu", str(package.path)]
    return subprocess.run(
        [*command, "--output", str(output), *options], capture_output=True, text=True, check=False
    )


def fly(package: Package, output: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Run the short flight."""
    return example("fly.py", package, output, "--stop", str(STOP_S), *options)


@pytest.fixture(scope="module")
def law(package: Package) -> design.Law:
    """The autopilot of the example."""
    return design.design(design.model(str(package.folder)))


@pytest.fixture(scope="module")
def ssp(package: Package, law: design.Law, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The closed loop as a file."""
    path = tmp_path_factory.mktemp("ssp") / "closed_loop.ssp"
    return build(path, package.path, law, EXAMPLE / "manoeuvre.csv", STOP_S)


def test_example_climbs_alike_in_both_masters(package: Package, tmp_path: Path) -> None:
    """fly.py itself compares the masters, and fails if they differ."""
    run = fly(package, tmp_path)
    assert run.returncode == 0, run.stdout + run.stderr
    assert "differ by" in run.stdout
    rows = np.genfromtxt(tmp_path / "libcosim.csv", delimiter=",", names=True, deletechars="")
    assert len(rows) == round(STOP_S / design.PERIOD_S)
    level = rows["time_s"] < 5.0
    assert np.abs(rows["vehicle.gamma"][level]).max() < 1e-9
    assert rows["vehicle.gamma"][-1] > 0.1 * rows["manoeuvre.gamma_wanted"][-1] > 0.0
    assert not rows["autopilot.saturated"].any()
    assert (tmp_path / "flight.png").stat().st_size > 10_000


def test_an_autopilot_that_sends_nan_ends_the_flight_and_loses_nothing(
    package: Package, tmp_path: Path
) -> None:
    manoeuvre = tmp_path / "manoeuvre.csv"
    manoeuvre.write_text("time_s,V_change,gamma_wanted\n0,0,0\n1,0,0\n2,0,nan\n", encoding="utf-8")
    run = fly(package, tmp_path, "--manoeuvre", str(manoeuvre))
    assert run.returncode == 1
    assert "NaN is refused" in run.stderr and "after t = 1.0" in run.stderr
    rows = np.genfromtxt(tmp_path / "libcosim.csv", delimiter=",", names=True)
    assert len(rows) > 90 and np.isfinite(rows["vehicleV"]).all()


def test_a_law_that_commands_no_number_ends_its_flight_with_the_reason(
    package: Package, law: design.Law
) -> None:
    bad = replace(law, Ki=np.full_like(law.Ki, np.nan))
    flown = flight.fly(str(package.folder), bad, np.zeros((100, 2)))
    assert "delta_e" in flown.ended and "NaN is refused" in flown.ended
    # The command for the second step; the first step is flown and its row kept.
    assert len(flown.rows) == 1 and np.isfinite(flown.rows[:, :4]).all()


def test_an_autopilot_at_its_stops_does_not_wind_up(package: Package, tmp_path: Path) -> None:
    """A speed that needs more than all fuel: the ratio stays at its limit, the flight goes on."""
    manoeuvre = tmp_path / "manoeuvre.csv"
    manoeuvre.write_text("time_s,V_change,gamma_wanted\n0,0,0\n1,0,0\n1.1,90,0\n", "utf-8")
    run = fly(package, tmp_path, "--manoeuvre", str(manoeuvre))
    assert run.returncode == 0, run.stderr
    rows = np.genfromtxt(tmp_path / "libcosim.csv", delimiter=",", names=True)
    assert rows["autopilotsaturated"][-1] > 0
    assert rows["vehiclephi_effective"].max() == pytest.approx(HIGH[1], rel=1e-12)
    assert 0.0 < rows["vehicleV"][-1] - rows["vehicleV"][0] < 1.2 * 90.0
    assert np.abs(rows["vehiclegamma"]).max() < 5.0 * design.DEG


@pytest.mark.parametrize(
    ("trouble", "said"),
    [("time.sleep(60)", "no answer for 3 s"), ("os.abort()", "exit status -6")],
    ids=["stops answering", "crashes"],
)
def test_a_component_that_hangs_or_dies_ends_the_flight_and_loses_nothing(
    ssp: Path, tmp_path: Path, trouble: str, said: str
) -> None:
    code = (EXAMPLE / "manoeuvre.py").read_text(encoding="utf-8").replace("from pathlib", "%s", 1)
    code = code.replace("%s", "import os\nimport time\nfrom pathlib")
    at = '"""Values at the end of the step."""\n'
    assert at in code
    script = tmp_path / "manoeuvre.py"
    script.write_text(
        code.replace(at, f"{at}        if current_time > 0.995:\n            {trouble}\n"), "utf-8"
    )
    bad = tmp_path / "bad.ssp"
    with zipfile.ZipFile(ssp) as good, zipfile.ZipFile(bad, "w") as copy:
        good.extract("resources/manoeuvre.fmu", tmp_path)
        with (
            zipfile.ZipFile(tmp_path / "resources/manoeuvre.fmu") as fmu,
            copy.open("resources/manoeuvre.fmu", "w") as file,
            zipfile.ZipFile(file, "w") as changed,
        ):
            for name in fmu.namelist():
                new = script.read_bytes() if name == "resources/manoeuvre.py" else fmu.read(name)
                changed.writestr(name, new)
        for name in good.namelist():
            if name != "resources/manoeuvre.fmu":
                copy.writestr(name, good.read(name))
    with pytest.raises(MasterFailed) as failure:
        fly_libcosim(bad, tmp_path / "flight.csv", STOP_S, patience_s=3.0)
    assert said in str(failure.value) and "after t = 1.00 s" in str(failure.value)
    rows = np.genfromtxt(tmp_path / "flight.csv", delimiter=",", skip_header=1)
    assert rows.shape == (100, 1 + len(NAMES))


def test_a_structure_that_names_what_is_not_there_is_refused(ssp: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.ssp"
    with zipfile.ZipFile(ssp) as good, zipfile.ZipFile(bad, "w") as copy:
        for name in good.namelist():
            copy.writestr(name, good.read(name).replace(b'"slosh1"', b'"sludge"'))
    with pytest.raises(BadSystem, match="vehicle has no output sludge"):
        validate(bad)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "the first line must be time_s,V_change,gamma_wanted"),
        ("time_s,gamma\n0,0\n", "the first line must be time_s,V_change,gamma_wanted"),
        ("time_s,V_change,gamma_wanted\n1,0,0\n1,0,1\n", "time_s must increase"),
        (None, "No such file"),
    ],
    ids=["empty", "another column", "time stands still", "no file"],
)
def test_a_manoeuvre_that_is_none_is_refused_before_the_flight(
    package: Package, tmp_path: Path, text: str | None, said: str
) -> None:
    manoeuvre = tmp_path / "bad.csv"
    if text is not None:
        manoeuvre.write_text(text, "utf-8")
    run = fly(package, tmp_path, "--manoeuvre", str(manoeuvre))
    assert run.returncode == 1
    assert run.stderr.startswith("error: ") and "bad.csv" in run.stderr and said in run.stderr
    assert not (tmp_path / "libcosim.csv").exists()


def test_sloshing_example_shows_a_redesign_that_copes(package: Package, tmp_path: Path) -> None:
    """Two points of each sweep; the redesign is stable where the design without slosh is not."""
    run = example("sloshing.py", package, tmp_path, "--points", "2", "--stop", "20")
    assert run.returncode == 0, run.stdout + run.stderr
    with (tmp_path / "margins.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4 * 2 * 4
    for row in rows:
        if row["law"] == "redesigned":
            assert float(row["phase_deg"]) > 30.0 and float(row["gain_down_db"]) < -4.0
    slow = [r for r in rows if r["sweep"].endswith("0.01") and r["law"] == "rigid"]
    assert all(float(row["growth_per_s"]) > 0.0 for row in slow)
    for name in ("margins.png", "hard.png"):
        assert (tmp_path / name).stat().st_size > 10_000


def test_signals_that_move_within_a_step_raise_the_order_of_the_coupling(package: Package) -> None:
    folder, stop_s = str(package.folder), 2.0
    exact = coupling.fixed(folder, coupling.REFERENCE_S, coupling.BOTH, stop_s)
    for how, order in ((coupling.HOLD, 1.0), (coupling.BOTH, 2.0)):
        long, short = (
            coupling.error(coupling.fixed(folder, size, how, stop_s), exact)
            for size in (0.01, 0.005)
        )
        assert np.log2(long / short) == pytest.approx(order, abs=0.4), how


def test_a_master_that_takes_steps_back_needs_fewer_for_the_same_error(package: Package) -> None:
    folder, stop_s, size = str(package.folder), 4.0, 0.005
    exact = coupling.fixed(folder, coupling.REFERENCE_S, coupling.BOTH, stop_s)
    varied = coupling.adaptive(folder, np.array([1e-3, 1e-6, 1e-6]), stop_s)
    assert varied.rejected > 0 and varied.rows[-1, 0] == pytest.approx(stop_s, abs=1e-9)
    assert len(varied.rows) < 0.5 * stop_s / size
    fixed = coupling.error(coupling.fixed(folder, size, coupling.BOTH, stop_s), exact)
    assert coupling.error(varied.rows, exact) < 2.0 * fixed


def test_coupling_example_runs(package: Package, tmp_path: Path) -> None:
    run = example("coupling.py", package, tmp_path, "--stop", "1")
    assert run.returncode == 0, run.stdout + run.stderr
    assert "rejected" in run.stdout and (tmp_path / "coupling.png").stat().st_size > 10_000
