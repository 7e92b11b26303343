"""What tools may find beside the vehicle: a reference experiment."""

from __future__ import annotations

import posixpath
import zipfile
from collections.abc import Iterator
from xml.etree import ElementTree

import pytest

from harness import Package

RELATED = "extra/org.fmi-standard.fmi-ls-ref"
FMI_LS = "{http://fmi-standard.org/fmi-ls-manifest}"


@pytest.fixture
def archive(package: Package) -> Iterator[zipfile.ZipFile]:
    """The FMU as a ZIP file."""
    with zipfile.ZipFile(package.path) as opened:
        yield opened


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
