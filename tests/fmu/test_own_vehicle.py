"""A package with data of its own: made by the tool, made by hand, moved, and damaged."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import calloc, extract, free, simulate_fmu
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)

from harness import REPOSITORY, Package, ahv

WRONG = "{00000000-0000-0000-0000-000000000000}"
DATA = REPOSITORY / "src" / "data"


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Our vehicle with half the stiffness, which starts higher; the published coefficients."""
    folder = tmp_path_factory.mktemp("data")
    vehicle, air = folder / "vehicle.toml", folder / "aero.toml"
    text = (DATA / "vehicle.toml").read_text().replace("value = 25900", "value = 26500")
    (stiffness,) = re.findall(r"stiffness_n_m2_per_m = \{ value = \[(.*?)\]", text)
    half = ", ".join(repr(float(number) / 2) for number in stiffness.split(", "))
    vehicle.write_text(text.replace(stiffness, half))
    shutil.copy(DATA / "aero" / "parker2007.toml", air)
    return {"--vehicle": vehicle, "--coefficients": air}


@pytest.fixture(scope="module")
def options(files: dict[str, Path]) -> list[Any]:
    """Options of the tool that name the files."""
    return [word for option in files.items() for word in option]


@pytest.fixture(scope="module")
def own(tmp_path_factory: pytest.TempPathFactory, options: list[Any]) -> Package:
    """The package that the tool makes of the files, in a folder that a URI has to encode."""
    folder = tmp_path_factory.mktemp("own 100% vehicle")
    fmu = folder / "own.fmu"
    made = ahv("package", *options, "--output", fmu)
    assert made.returncode == 0, made.stderr
    extract(str(fmu), unzipdir=str(folder / "ahv"))
    return Package(fmu, folder / "ahv")


def refusal(folder: Path, guid: str) -> str:
    """What the log says of an instance with this GUID; nothing if there is one."""
    heard: list[str] = []
    fmu = FMU2Slave(
        guid=guid, unzipDirectory=str(folder), modelIdentifier="ahv", instanceName="asked"
    )
    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(lambda *words: heard.append(words[-1].decode()))
    callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
    callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
    try:
        fmu.instantiate(callbacks=callbacks)
    except Exception:
        fmu.freeLibrary()
        return heard[-1]
    fmu.freeInstance()
    return ""


def test_verif_an_own_vehicle_flies_as_the_tool_says(
    own: Package, options: list[Any], tmp_path: Path
) -> None:
    """FMPy and `cargo ahv fly` give one flight, which is not that of our vehicle."""
    flown = ahv("fly", *options, "--stop", 0.5, "--output", tmp_path)
    assert flown.returncode == 0, flown.stderr
    theirs = np.genfromtxt(tmp_path / "flight.csv", delimiter=",", names=True)
    doublet = np.genfromtxt(
        REPOSITORY / "examples" / "elevator_doublet.csv", delimiter=",", names=True
    )
    names = ["h", "alpha", "eta1", "slosh1", "n_z"]
    ours = simulate_fmu(
        str(own.path), input=doublet, output=names, stop_time=0.5, output_interval=0.01
    )
    assert abs(ours["h"][0] - 26500.0) < 1e-9
    for name in names:
        # Before a jump of an input the tool writes another row for the same time.
        _, last = np.unique(theirs["time"][::-1], return_index=True)
        expected = theirs[name][::-1][last]
        scale = np.ptp(expected)
        np.testing.assert_allclose(ours[name][-1], expected[-1], atol=1e-9 * scale, rtol=1e-12)


def test_verif_start_values_of_an_own_vehicle_are_those_of_its_description(own: Package) -> None:
    """Also in a folder to which the package was moved."""
    with own.instance() as instance:
        instance.setup()
        for name, variable in own.variables.items():
            if variable.causality == "parameter" and variable.type == "Real":
                assert instance.get(name)[0] == float(variable.start), name
    assert own.variables["aero"].start == "4"
    assert "data: vehicle.toml, aero.toml" in own.description.description
    assert sorted(path.name for path in (own.folder / "resources").iterdir()) == [
        "aero.toml",
        "vehicle.toml",
    ]


def test_verif_data_of_another_package_are_refused(own: Package, tmp_path: Path) -> None:
    """A wrong GUID, changed data, damaged data and none: the log says which and why."""
    guid = own.description.guid
    assert refusal(own.folder, guid) == ""
    assert f"belong to {guid}" in refusal(own.folder, WRONG)
    copy = tmp_path / "copy"
    shutil.copytree(own.folder, copy)
    file = copy / "resources" / "vehicle.toml"
    good = file.read_text()
    for damaged, told in [
        (good.replace("value = 26500", "value = 26501"), "belong to {"),
        (good.replace("value = 30.48", "value = nan"), "geometry.length_m: NaN must lie in"),
        (good[: len(good) // 2], "vehicle.toml: "),
    ]:
        file.write_text(damaged)
        assert told in refusal(copy, guid)
    shutil.rmtree(copy / "resources")
    assert "belong to {" in refusal(copy, guid)


def test_verif_a_package_can_be_made_by_hand(
    own: Package, package: Package, files: dict[str, Path], tmp_path: Path
) -> None:
    """Our package with other resources, whose GUID and start values the library itself tells."""
    folder = tmp_path / "by hand"
    shutil.copytree(package.folder, folder)
    (folder / "resources").mkdir()
    shutil.copy(files["--vehicle"], folder / "resources" / "vehicle.toml")
    shutil.copy(files["--coefficients"], folder / "resources" / "aero.toml")
    (guid,) = re.findall(r"belong to (\{[0-9a-f-]+\})", refusal(folder, WRONG))
    assert guid == own.description.guid
    xml = folder / "modelDescription.xml"
    xml.write_text(xml.read_text().replace(package.description.guid, guid))
    made = Package(package.path, folder)
    with made.instance() as instance:
        instance.setup()
        for name, variable in own.variables.items():
            if variable.causality == "parameter" and variable.type == "Real":
                assert instance.get(name)[0] == float(variable.start), name
