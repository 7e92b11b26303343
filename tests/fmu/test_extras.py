"""What tools may find beside the model: terminals with icons, and a reference experiment."""

from __future__ import annotations

import posixpath
import struct
import zipfile
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import pytest
from lxml import etree

from harness import INPUTS, Package

TERMINALS = "terminalsAndIcons"
RELATED = "extra/org.fmi-standard.fmi-ls-ref"
PNG = b"\x89PNG\r\n\x1a\n"
FMI_LS = "{http://fmi-standard.org/fmi-ls-manifest}"


@pytest.fixture
def archive(package: Package) -> Iterator[zipfile.ZipFile]:
    """The FMU as a ZIP file."""
    with zipfile.ZipFile(package.path) as opened:
        yield opened


@pytest.fixture
def terminals(archive: zipfile.ZipFile) -> ElementTree.Element:
    """The root of the terminals' file."""
    return ElementTree.fromstring(archive.read(f"{TERMINALS}/terminalsAndIcons.xml"))


def test_verif_terminals_are_valid_by_the_schema(archive: zipfile.ZipFile) -> None:
    """By the schema of FMI 3.0, to which FMI 2.0.4 refers."""
    file = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
    schema = etree.XMLSchema(etree.parse(str(file)))
    schema.assertValid(etree.fromstring(archive.read(f"{TERMINALS}/terminalsAndIcons.xml")))


def test_verif_terminals_name_variables_of_the_model(
    package: Package, terminals: ElementTree.Element
) -> None:
    """Inputs on one side, outputs on the other; all inputs, none twice."""
    names: list[str] = []
    for terminal in terminals.iter("Terminal"):
        members = [member.get("variableName") for member in terminal.iter("TerminalMemberVariable")]
        (causality,) = {package.variables[name].causality for name in members}
        (drawn,) = terminal.iter("TerminalGraphicalRepresentation")
        assert drawn.get("iconBaseName") == causality
        left = float(drawn.get("x1")) < 0.0
        assert left == (causality == "input")
        names += members
    assert set(INPUTS) < set(names)
    assert len(set(names)) == len(names)


def test_verif_icons_are_pictures(archive: zipfile.ZipFile, terminals: ElementTree.Element) -> None:
    """Square PNGs of the icons that the file names, and of the FMU itself."""
    drawn = terminals.iter("TerminalGraphicalRepresentation")
    for name in {"icon", *(entry.get("iconBaseName") for entry in drawn)}:
        content = archive.read(f"{TERMINALS}/{name}.png")
        assert content.startswith(PNG)
        width, height = struct.unpack(">II", content[16:24])
        assert width == height >= 40, name


def test_verif_reference_experiment_leads_to_its_files(archive: zipfile.ZipFile) -> None:
    """Every file that is named is there, and the experiment is the one of the cross-check."""

    def found(source: str) -> str:
        path = posixpath.normpath(posixpath.join(RELATED, source))
        assert path in archive.namelist()
        return path

    manifest = ElementTree.fromstring(archive.read(f"{RELATED}/fmi-ls-manifest.xml"))
    assert manifest.get(f"{FMI_LS}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    files = {entry.get("role"): found(entry.get("source")) for entry in manifest.iter("Related")}
    (experiment,) = ElementTree.fromstring(archive.read(files["experiment"])).iter("Experiment")
    assert found(experiment.find("Stimuli").get("source")) == files["testcase"]
    assert found(experiment.find("References").get("source")) == files["result"]
    options = archive.read("documentation/cross-check/ahv_ref.opt").decode().splitlines()
    said = [float(line.split(",")[1]) for line in options]
    keys = ("startTime", "stopTime", "stepSize", "tolerance")
    assert [float(experiment.get(key)) for key in keys] == said
