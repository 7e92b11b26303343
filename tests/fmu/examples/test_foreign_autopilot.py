"""The autopilot in Python, exported by PythonFMU: it flies as the native one, and may fail."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

import fly
import system
from harness import Package, packaged
from law import Law, autopilot_beside
from masters import MasterFailed, fly_libcosim, names

EXAMPLE = Path(system.__file__).parent
MANOEUVRE = EXAMPLE / "manoeuvre.csv"
# Duration of the flights that end early.
STOP_S = 8.0
# With the whole entry into the climb.
LONG_S = 30.0
# Of a command's range. Sums of twenty products in another order differ by at most 20 times 2^-53,
# 2e-15; the filter forgets earlier differences, and the integrals are the same bits.
SAME_LAW = 1e-14
# Of a variable's range: the unstable vehicle amplifies it until the loop answers, to 4e-13.
SAME_FLIGHT = 1e-12


@pytest.fixture(scope="module")
def autopilot(package: Package) -> Path:
    """The FMU of the native autopilot."""
    return autopilot_beside(package.path)


@pytest.fixture(scope="module")
def parts(
    package: Package, autopilot: Path, tmp_path_factory: pytest.TempPathFactory
) -> list[system.Component]:
    """The loop with an autopilot in Python, which has the gains of the native one."""
    folder = tmp_path_factory.mktemp("foreign")
    return system.foreign(package.path, Law.within(autopilot), MANOEUVRE, folder)


@pytest.fixture(scope="module")
def ssp(parts: list[system.Component], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same as a file."""
    return system.build(tmp_path_factory.mktemp("ssp") / "closed_loop.ssp", parts, STOP_S)


def test_verif_the_autopilot_in_python_commands_what_the_native_one_does(
    autopilot: Path, parts: list[system.Component], tmp_path: Path
) -> None:
    """Noise, failed measurements and commands that saturate."""
    random, law = np.random.default_rng(1), Law.within(autopilot)
    foreign = {part.name: part.fmu for part in parts}["autopilot"]
    with zipfile.ZipFile(foreign) as archive:
        archive.extractall(tmp_path / "python")
    python, native = Package(foreign, tmp_path / "python"), packaged(tmp_path, "ahv_autopilot")
    outputs, rows = (*system.COMMANDS, "missed", "saturated"), []
    with python.flight() as one, native.flight() as other:
        for k in range(3000):
            measured = law.level + random.normal(size=3) * [3.0, 0.002, 0.01]
            if k % 37 == 5:
                measured[k % 3] = np.nan
            wanted = [8.0 * np.sin(k / 60), 0.02 * np.cos(k / 90)]
            values = zip((*system.MEASURED, *system.WANTED), (*measured, *wanted), strict=True)
            values = {name: float(value) for name, value in values}
            for pilot in (one, other):
                pilot.set(**values)
                pilot.step(law.period_s)
            rows.append([one.get(*outputs), other.get(*outputs)])
    first, second = np.moveaxis(np.array(rows), 1, 0)
    assert (np.abs(first - second).max(axis=0) <= SAME_LAW * np.ptp(second, axis=0)).all()
    assert np.array_equal(first[:, 2:], second[:, 2:]) and (second[-1, 2:] > 0).all()


def test_verif_the_autopilot_in_python_flies_as_the_native_one_does(
    package: Package, autopilot: Path, parts: list[system.Component], tmp_path: Path
) -> None:
    native = system.native(package.path, autopilot, MANOEUVRE)
    systems = {"native": native, "python": parts}
    files = [system.build(tmp_path / f"{name}.ssp", loop, LONG_S) for name, loop in systems.items()]
    flown = [fly_libcosim(file, tmp_path / "flight.csv", LONG_S) for file in files]
    for name in names(files[0]):
        one, other = (
            rows[:, 1 + names(file).index(name)] for rows, file in zip(flown, files, strict=True)
        )
        assert np.abs(one - other).max() <= SAME_FLIGHT * np.ptp(one), name


def test_an_autopilot_that_sends_nan_ends_the_flight_and_loses_nothing(
    package: Package, tmp_path: Path
) -> None:
    manoeuvre = tmp_path / "manoeuvre.csv"
    manoeuvre.write_text("time_s,V_change,gamma_wanted\n0,0,0\n1,0,0\n2,0,nan\n", encoding="utf-8")
    command = [sys.executable, fly.__file__, "--python", "--fmu", str(package.path)]
    command += ["--stop", str(STOP_S), "--manoeuvre", str(manoeuvre), "--output", str(tmp_path)]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert "NaN is refused" in run.stderr and "after t = 1.0" in run.stderr
    rows = np.genfromtxt(tmp_path / "libcosim.csv", delimiter=",", names=True)
    assert len(rows) > 90 and np.isfinite(rows["vehicleV"]).all()


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
    assert rows.shape == (100, 1 + len(names(bad)))
