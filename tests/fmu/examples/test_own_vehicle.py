"""The FMU of somebody else's vehicle: their numbers fly in it, and wrong ones are refused."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from harness import CONFIGURATIONS, DERIVATIVES, ERROR, Package, ahv
from oracle import DATA_DIR, Vehicle

# Both solve the same equations up to rounding, amplified by the conditioning.
EQUAL = 1e-9
# Rates in equilibrium: rounding of terms of about 1e3 m/s^2.
RATE_AT_REST = 1e-9
STIFFNESS = re.compile(r"(?<=stiffness_n_m2_per_m = \{ value = \[)[^]]*")


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Data of a vehicle with half the stiffness, less propellant and other coefficients."""
    folder = tmp_path_factory.mktemp("my data") / "data"
    shutil.copytree(DATA_DIR, folder)
    vehicle = (folder / "vehicle.toml").read_text()
    (numbers,) = STIFFNESS.findall(vehicle)
    half = ", ".join(str(0.5 * float(number)) for number in numbers.split(","))
    vehicle = STIFFNESS.sub(half, vehicle).replace("value = 0.65", "value = 0.6")
    (folder / "vehicle.toml").write_text(vehicle)
    air = (folder / "aero" / "parker2007.toml").read_text().replace("2.1335", "1.9")
    (folder / "aero" / "own.toml").write_text(air)
    return folder


@pytest.fixture(scope="module")
def own(data: Path, tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The FMU built with these data."""
    folder = tmp_path_factory.mktemp("own")
    fmu = folder / "own.fmu"
    files = ("--vehicle", data / "vehicle.toml", "--coefficients", data / "aero" / "own.toml")
    built = ahv("package", "--host-only", *files, "--output", fmu)
    assert built.returncode == 0, built.stderr
    fmpy.extract(str(fmu), unzipdir=str(folder / "unzipped"))
    return Package(fmu, folder / "unzipped")


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_own_vehicle_equals_the_oracle(own: Package, data: Path, configuration: int) -> None:
    """Frequencies, trim, and the rates off trim, with nothing but the configuration set."""
    oracle = Vehicle(configuration, data_dir=data, aero="own")
    names = ("omega1", "omega2", "omega3", "omega_slosh1", "omega_slosh2")
    count = oracle.modes_count
    x, u = oracle.trim()
    with own.flight(configuration=configuration) as flight:
        np.testing.assert_allclose(flight.get(*names)[:count], oracle.omega, rtol=EQUAL)
        expected = [x[3], *u]
        trim = flight.get("alpha_trim", "delta_e_trim", "phi_trim")
        np.testing.assert_allclose(trim, expected, rtol=EQUAL)
        assert np.abs(flight.get(*DERIVATIVES)).max() < RATE_AT_REST
        assert flight.log == []


def test_verif_own_vehicle_is_told_apart(own: Package, package: Package) -> None:
    """A master that holds both sees another GUID and whose data they are; ours stay selectable."""
    assert own.description.guid != package.description.guid
    assert own.description.description.endswith("; data: vehicle.toml, own.toml")
    sets = [item.name for item in own.variables["aero"].declaredType.items]
    assert sets[-1] == "own"
    assert set(sets) > {item.name for item in package.variables["aero"].declaredType.items}
    with own.flight() as mine, own.flight(aero="xu2015") as ours:
        assert mine["alpha_trim"] != ours["alpha_trim"]


def test_verif_a_state_of_another_vehicle_is_refused(own: Package, package: Package) -> None:
    """Its parameters would fit, its masses and modes would not."""
    with package.flight() as ours, own.flight() as mine:
        data = ours.fmu.serializeFMUstate(ours.fmu.getFMUstate())
        before = mine.bits()
        with pytest.raises(FMICallException):
            mine.fmu.deSerializeFMUstate(data)
        assert mine.log[-1].status == ERROR and "another model" in mine.log[-1].text
        assert mine.bits() == before


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('unit = "kg/m^2"', 'unit = "lb/ft^2"', "mass.fore_beam_kg_per_m2: the unit is lb/ft^2"),
        ("value = 0.65", "value = 6.5", "mass.propellant_fraction: 6.5 must lie in [0, 1]"),
        ("[beam]", "[baem]", "baem: unknown key"),
    ],
)
def test_wrong_data_are_refused_before_anything_is_built(
    tmp_path: Path, old: str, new: str, told: str
) -> None:
    """File, key, value and limit; no FMU."""
    file, fmu = tmp_path / "mine.toml", tmp_path / "own.fmu"
    text = (DATA_DIR / "vehicle.toml").read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    refused = ahv("package", "--vehicle", file, "--output", fmu)
    assert refused.returncode != 0
    assert str(file) in refused.stderr and told in refused.stderr
    assert not fmu.exists()


def test_a_file_that_is_not_there_is_named() -> None:
    """And the command fails."""
    refused = ahv("modes", "--coefficients", "nowhere.toml")
    assert refused.returncode != 0 and "nowhere.toml" in refused.stderr


def test_compare_draws_both(
    repository: Path, own: Package, package: Package, tmp_path: Path
) -> None:
    """The example's script: a line each, and a picture."""
    script = repository / "examples" / "own_vehicle" / "compare.py"
    picture = tmp_path / "compare.png"
    command = [sys.executable, script, package.path, own.path, "--stop", "0.2"]
    done = subprocess.run(
        [*map(str, command), "--output", str(picture)], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("from least to most") == 2
    assert picture.stat().st_size > 10_000
