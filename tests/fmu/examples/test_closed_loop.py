"""The example of a closed loop: what it claims, and what it says when something goes wrong."""

from __future__ import annotations

import csv
import ctypes
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import container
import coupling
import design
import flight
import steps
import system
from fly import agreement
from harness import Package, packaged
from law import HIGH, autopilot_beside
from loop import Loop
from masters import fly_fmpy, fly_libcosim, names
from system import BadSystem

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
def autopilot(package: Package) -> Path:
    """The FMU of the native autopilot."""
    return autopilot_beside(package.path)


def test_example_climbs_alike_in_all_masters(package: Package, tmp_path: Path) -> None:
    """fly.py itself compares the masters, and fails if they differ."""
    run = fly(package, tmp_path, "--set", "fuel_fraction=0.8")
    assert run.returncode == 0, run.stdout + run.stderr
    assert "libcosim and FMPy differ by" in run.stdout
    assert "libcosim and Ecos differ by" in run.stdout or "Ecos is left out" in run.stdout
    rows = np.genfromtxt(tmp_path / "libcosim.csv", delimiter=",", names=True, deletechars="")
    assert len(rows) == round(STOP_S / design.PERIOD_S)
    level = rows["time_s"] < 5.0
    assert np.abs(rows["vehicle.gamma"][level]).max() < 1e-9
    assert rows["vehicle.gamma"][-1] > 0.1 * 0.0175 * (STOP_S - 5.0) / 20.0 > 0.0
    assert not rows["autopilot.saturated"].any()
    assert (tmp_path / "flight.png").stat().st_size > 10_000


def test_parameter_sets_reach_autopilot_and_vehicle(
    package: Package, autopilot: Path, tmp_path: Path
) -> None:
    """In SSP 2.0 by files and in SSP 1.0 within the structure, the flight is that of the same
    parameters in the container."""
    case = {"fuel_fraction": 0.6, "mass_factor": 1.02, "slosh_damping": 0.04}
    parts = system.native(package.path, autopilot, EXAMPLE / "manoeuvre.csv", case)
    flown = {}
    for version in ("1.0", "2.0"):
        path = system.build(tmp_path / f"{version}.ssp", parts, STOP_S, version)
        flown[version] = fly_libcosim(path, tmp_path / "flight.csv", STOP_S)
    assert np.array_equal(flown["1.0"], flown["2.0"])
    assert agreement(flown["2.0"], fly_fmpy(tmp_path / "1.0.ssp", STOP_S), names(path)) < 1e-9
    loop = container.build(tmp_path / "loop.fmu", parts)
    with zipfile.ZipFile(loop) as archive:
        archive.extractall(tmp_path / "loop")
    settings = container.settings(parts)
    with Loop(str(tmp_path / "loop"), ("V", "gamma", "slosh2")) as instance:
        rows = instance.fly(settings, STOP_S, design.PERIOD_S).rows
        # Neither the step nor a flight before it changes a flight.
        instance.fly({"vehicle.aero": 2}, 1.0, 0.5)
        long = instance.fly(settings, STOP_S, 0.5).rows
    assert np.array_equal(long[:, 1:], rows[49::50, 1:])
    for column, name in enumerate(("V", "gamma", "slosh2"), start=1):
        values = flown["2.0"][:, 1 + names(path).index(f"vehicle.{name}")]
        assert np.abs(rows[:, column] - values).max() < 1e-9 * np.ptp(values), name


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


def test_fmus_that_do_not_fit_are_refused(
    package: Package, autopilot: Path, tmp_path: Path
) -> None:
    manoeuvre, none = EXAMPLE / "manoeuvre.csv", tmp_path / "none.fmu"
    none.write_bytes(b"none")
    for vehicle, pilot, said in (
        (autopilot, package.path, "there is no"),
        (package.path, none, "none.fmu is no FMU"),
    ):
        with pytest.raises(BadSystem, match=said):
            system.build(tmp_path / "bad.ssp", system.native(vehicle, pilot, manoeuvre), STOP_S)
        with pytest.raises(BadSystem):
            container.build(tmp_path / "bad.fmu", system.native(vehicle, pilot))


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
    for kind in ([], ["--python"]):
        run = fly(package, tmp_path, "--manoeuvre", str(manoeuvre), *kind)
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


@pytest.mark.parametrize("is_moving", [False, True], ids=["held", "moving"])
def test_the_step_of_the_master_moves_the_margins_as_predicted(
    package: Package, tmp_path: Path, is_moving: bool
) -> None:
    """Samples of 10 ms in steps of 40 ms: the linear loop flies as the FMUs do."""
    full, step_s, count = design.model(str(package.folder)), 0.04, 50
    law = design.design(full)
    same = [steps.coupled(full, law, short_s, is_moving) for short_s in (0.001, 0.005, 0.01)]
    assert all(np.array_equal(loop.A, same[0].A) for loop in same)
    linear = steps.coupled(full, law, step_s, is_moving)
    a, states = linear.closed(np.ones(2)), design.STATES[design.SLOSH]
    x = np.zeros(len(a))
    x[states.index("alpha")] = 1e-4
    predicted, flown = [], []
    with (
        flight.Vehicle(str(package.folder), alpha_offset=1e-4) as vehicle,
        packaged(tmp_path, "ahv_autopilot").flight() as pilot,
    ):
        references = (ctypes.c_uint32 * 3)(*pilot.package.references(*design.MEASURED))
        for _ in range(count):
            vehicle.command(np.array([float(pilot[name]) for name in ("delta_e", "phi")]))
            values = dict(zip(design.MEASURED, map(float, vehicle.read()), strict=True))
            pilot.set(**values)
            if is_moving:
                orders, rates = (ctypes.c_int * 3)(1, 1, 1), vehicle.rates()
                pilot.fmu.fmi2SetRealInputDerivatives(
                    pilot.fmu.component, references, 3, orders, flight.pointer(rates)
                )
            vehicle.step(step_s)
            pilot.step(step_s)
            flown.append(vehicle.read()[1])
            x = a @ x
            predicted.append(x[states.index("gamma")])
    assert np.abs(np.subtract(flown, predicted)).max() < 0.01 * np.abs(predicted).max()
