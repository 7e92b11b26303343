"""The FMU of every model for both standards: valid, complete, and flown for a second."""

from __future__ import annotations

import re
import struct
import zipfile
from collections.abc import Iterator
from pathlib import Path
from posixpath import normpath
from typing import NamedTuple
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu
from lxml import etree

from harness import MEASURED, MODELS, package_path

VERSIONS = ("2.0", "3.0")
# First bytes and ending of a library; on macOS of one processor, or of both.
MAGIC = {
    "linux": (b"\x7fELF\x02",),
    "win": (b"MZ",),
    "darwin": (b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe"),
    "wasip": (b"\0asm",),
}
ENDINGS = {"linux": "so", "win": "dll", "darwin": "dylib", "wasip": "wasm"}
TERMINALS = "terminalsAndIcons"
PNG = b"\x89PNG\r\n\x1a\n"
STOP, ROWS = 1.0, 101


class Fmu(NamedTuple):
    """A package: its model, its file, and the open archive."""

    model: str
    path: Path
    archive: zipfile.ZipFile


@pytest.fixture(params=[(model, version) for model in MODELS for version in VERSIONS], ids=" ".join)
def fmu(request: pytest.FixtureRequest) -> Iterator[Fmu]:
    """Each package in turn."""
    model, version = request.param
    path = package_path(model, version)
    with zipfile.ZipFile(path) as archive:
        yield Fmu(model, path, archive)


@pytest.fixture
def terminals(fmu: Fmu) -> ElementTree.Element:
    """The root of the terminals' file."""
    return ElementTree.fromstring(fmu.archive.read(f"{TERMINALS}/terminalsAndIcons.xml"))


def test_verif_fmpy_finds_no_problem(fmu: Fmu) -> None:
    """Schema, names, units, required start values, causality and model structure are valid."""
    assert validate_fmu(str(fmu.path)) == []


def test_verif_archive_has_a_binary_for_this_platform(fmu: Fmu) -> None:
    """This platform is served, and every binary is what its directory says."""
    assert fmpy.platform in fmpy.supported_platforms(str(fmu.path))
    assert fmu.archive.testzip() is None
    names = fmu.archive.namelist()
    binaries = [name for name in names if name.startswith("binaries/") and name[-1] != "/"]
    assert binaries
    for name in binaries:
        _, platform, file = name.split("/")
        # linux64, aarch64-linux, x86_64-windows
        system = platform.rpartition("-")[2].rstrip("0123456789").removesuffix("dows")
        assert file == f"{fmu.model}.{ENDINGS[system]}", name
        assert fmu.archive.read(name).startswith(MAGIC[system]), name


def test_verif_the_page_leads_to_files_of_the_package(fmu: Fmu) -> None:
    """Its pictures, its licences; and it has the identity of the description."""
    page = fmu.archive.read("documentation/index.html").decode()
    guid = read_model_description(str(fmu.path)).guid
    assert f"<h1>{fmu.model} " in page and guid in page
    links = re.findall(r'(?:href|src)="([^":]+)"', page)
    assert "licenses/" in links
    for link in links:
        path = normpath(f"documentation/{link}")
        assert any(f"{name}/".startswith(f"{path}/") for name in fmu.archive.namelist()), link


def test_verif_terminals_are_valid_by_the_schema(fmu: Fmu) -> None:
    """By the schema of FMI 3.0, to which FMI 2.0.4 refers."""
    file = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
    schema = etree.XMLSchema(etree.parse(str(file)))
    schema.assertValid(etree.fromstring(fmu.archive.read(f"{TERMINALS}/terminalsAndIcons.xml")))


def test_verif_terminals_name_variables_of_the_model(
    fmu: Fmu, terminals: ElementTree.Element
) -> None:
    """Inputs on one side, outputs on the other; none twice; all inputs, if there are terminals."""
    variables = {v.name: v for v in read_model_description(str(fmu.path)).modelVariables}
    names: list[str] = []
    for terminal in terminals.iter("Terminal"):
        members = [member.get("variableName") for member in terminal.iter("TerminalMemberVariable")]
        (causality,) = {variables[name].causality for name in members}
        (drawn,) = terminal.iter("TerminalGraphicalRepresentation")
        assert drawn.get("iconBaseName") == causality
        left = float(drawn.get("x1")) < 0.0
        assert left == (causality == "input")
        names += members
    inputs = {name for name, v in variables.items() if v.causality == "input"}
    assert not names or inputs < set(names)
    assert len(set(names)) == len(names)


def test_verif_icons_are_pictures(fmu: Fmu, terminals: ElementTree.Element) -> None:
    """Square PNGs of the icons that the file names, and of the FMU itself."""
    drawn = terminals.iter("TerminalGraphicalRepresentation")
    for name in {"icon", *(entry.get("iconBaseName") for entry in drawn)}:
        content = fmu.archive.read(f"{TERMINALS}/{name}.png")
        assert content.startswith(PNG)
        width, height = struct.unpack(">II", content[16:24])
        assert width == height >= 40, name


def flown(path: Path) -> np.ndarray:
    """Outputs over a second, with a small sine at every input."""
    variables = read_model_description(str(path)).modelVariables
    names = [v.name for v in variables if v.causality == "input"]
    time = np.linspace(0.0, STOP, ROWS)
    inputs = np.zeros(ROWS, [(name, np.float64) for name in ("time", *names)])
    inputs["time"] = time
    for number, name in enumerate(names, 1):
        inputs[name] = MEASURED.get(name, 0.0) + 1e-3 * np.sin(number * np.pi * time)
    outputs = [v.name for v in variables if v.causality == "output"]
    options = {"stop_time": STOP, "output_interval": STOP / (ROWS - 1), "output": outputs}
    rows = simulate_fmu(str(path), input=inputs, fmi_type="CoSimulation", **options)
    assert rows["time"][-1] == STOP and len(rows) == ROWS
    return np.array([rows[name] for name in outputs], np.float64)


@pytest.mark.parametrize("model", MODELS)
def test_verif_every_model_flies_alike_in_both_standards(model: str) -> None:
    """Every output is finite, one has moved, and the bits are the same."""
    fmi2, fmi3 = (flown(package_path(model, version)) for version in VERSIONS)
    assert np.isfinite(fmi2).all()
    assert np.ptp(fmi2, axis=1).any()
    assert np.array_equal(fmi2, fmi3)
