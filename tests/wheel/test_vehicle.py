"""An FMU with the user's own vehicle, made without a compiler."""

from __future__ import annotations

import subprocess
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from fmpy import read_model_description, simulate_fmu

import ahv

Tool = Callable[..., subprocess.CompletedProcess[str]]
VERSIONS = ["2.0", "3.0"]


@pytest.fixture
def mine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Our vehicle, which starts higher, with a name that XML has to escape."""
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "mine & 'yours'.toml"
    text = ahv.template("vehicle").read_text("utf-8")
    assert text.count("value = 25900") == 1
    file.write_text(text.replace("value = 25900", "value = 26500"), "utf-8")
    return file


@pytest.fixture
def air(tmp_path: Path) -> Path:
    """The published coefficients, as our own."""
    file = tmp_path / "my_air.toml"
    file.write_bytes(ahv.template("coefficients").read_bytes())
    return file


def content(fmu: Path) -> dict[str, bytes]:
    """Files of an FMU."""
    with zipfile.ZipFile(fmu) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.mark.parametrize("given", ["both", "vehicle", "coefficients"])
def test_verif_the_description_is_that_of_the_tool(
    given: str, mine: Path, air: Path, tmp_path: Path, fmus: dict[str, Path], tool: Tool
) -> None:
    toml = None if given == "coefficients" else mine
    coefficients = None if given == "vehicle" else air
    libraries = []
    # Those of FMI 3.0: in FMI 2.0 one file may be for several processors.
    for name, library in content(fmus["3.0"]).items():
        if name.startswith("binaries/") and not name.endswith(".wasm"):
            file = tmp_path / name.replace("/", "_")
            file.write_bytes(library)
            libraries += ["--library", f"{name.split('/')[1]}={file}"]
    data = [*(["--vehicle", toml] if toml else [])]
    data += [*(["--coefficients", coefficients] if coefficients else [])]
    theirs = tmp_path / "theirs.fmu"
    done = tool("package", *libraries, *data, "--output", theirs)
    assert done.returncode == 0, done.stderr
    for version in VERSIONS:
        ours = content(ahv.vehicle(toml, coefficients, fmu=ahv.fmu(version)))
        expected = content(theirs if version == "2.0" else tmp_path / "theirs_fmi3.fmu")
        assert ours["modelDescription.xml"].decode() == expected["modelDescription.xml"].decode()
        for name in (name for name in expected if name.startswith(("resources/", "binaries/"))):
            assert ours[name] == expected[name], name
        assert not any(name.endswith(".wasm") for name in ours), "a component reads no files"


@pytest.mark.parametrize("version", VERSIONS)
def test_it_flies_with_its_own_defaults_and_identity(version: str, mine: Path, air: Path) -> None:
    fmu = ahv.vehicle(mine, air, fmu=ahv.fmu(version))
    assert fmu == Path(f"mine & 'yours'{'_fmi3' if version == '3.0' else ''}.fmu")
    description, built_in = (read_model_description(str(f)) for f in (fmu, ahv.fmu(version)))
    assert description.guid != built_in.guid
    assert description.description == f"{built_in.description}; data: {mine.name}, {air.name}"
    start = {v.name: v.start for v in description.modelVariables}
    assert start["altitude0"] == "26500" and start["aero"] == "4" and start["trim"] == "true"
    flown = simulate_fmu(str(fmu), stop_time=0.1, output_interval=0.01, output=["h", "gamma"])
    assert flown["h"] == pytest.approx(26500.0, abs=1e-3)
    # Our own sets remain, under their names.
    ours = ahv.linear_model(fmu, aero="xu2015", altitude0=25900.0)
    assert (ours.A == ahv.linear_model(ahv.fmu(version)).A).all()
    assert (ours.A != ahv.linear_model(fmu, aero="own", altitude0=25900.0).A).any()


def test_the_same_files_give_the_same_bytes_without_what_is_of_another_vehicle(
    mine: Path, tmp_path: Path
) -> None:
    first, second = (ahv.vehicle(mine, output=tmp_path / name) for name in ("1.fmu", "2.fmu"))
    assert first.read_bytes() == second.read_bytes()
    made, built_in = content(first), content(ahv.fmu())
    assert list(made) == sorted(made)
    gone = {name for name in built_in if name not in made}
    assert {name.split("/")[0] for name in gone} == {"documentation", "extra"}
    assert not any("licenses" in name for name in gone)
    same = set(built_in) - gone - {"modelDescription.xml"}
    assert all(made[name] == built_in[name] for name in same)
    with zipfile.ZipFile(first) as archive:
        assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("value = 30.48", "value = -1", "geometry.length_m: -1 must lie in [0.001, 1000] m"),
        ("[beam]", "[baem]", "baem: unknown key, must be one of geometry, mass, beam, tank"),
        ("value = 26500", "value = 99000", "default.altitude_m: 99000 must lie in [0, 85000] m"),
        ("value = 26500", "value =", "line "),
    ],
)
def test_wrong_data_are_refused_with_file_key_and_limit(
    version: str, old: str, new: str, said: str, mine: Path
) -> None:
    text = mine.read_text("utf-8")
    assert old in text
    mine.write_text(text.replace(old, new), "utf-8")
    target = Path("old.fmu")
    target.write_text("as it was", "utf-8")
    with pytest.raises(ahv.VehicleError) as refused:
        ahv.vehicle(mine, output=target, fmu=ahv.fmu(version))
    assert str(refused.value).startswith(f"{mine}: ") and said in str(refused.value)
    assert target.read_text("utf-8") == "as it was"
    assert sorted(Path().iterdir()) == sorted([target, Path(mine.name)])


def test_coefficients_are_refused_by_their_name(air: Path, tmp_path: Path) -> None:
    air.write_text(air.read_text("utf-8") + "\n[engine]\n", "utf-8")
    with pytest.raises(ahv.VehicleError) as refused:
        ahv.vehicle(None, air, tmp_path / "x.fmu")
    assert str(refused.value).startswith(f"{air}: engine: unknown key")


def test_a_vehicle_without_trim_is_refused_with_the_limit(mine: Path) -> None:
    mine.write_text(mine.read_text("utf-8").replace("value = 26500", "value = 80000"), "utf-8")
    with pytest.raises(ahv.VehicleError, match="trim"):
        ahv.vehicle(mine)


def test_nothing_given_and_a_base_with_data_are_refused(mine: Path) -> None:
    with pytest.raises(ValueError, match="a vehicle or coefficients of your own are needed"):
        ahv.vehicle(None)
    fmu = ahv.vehicle(mine)
    with pytest.raises(ahv.VehicleError, match="has data of its own"):
        ahv.vehicle(mine, fmu=fmu)


def test_files_that_cannot_be_read_or_written_are_said(mine: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"none\.toml"):
        ahv.vehicle("none.toml")
    with pytest.raises(FileNotFoundError):
        ahv.vehicle(mine, output="no folder/mine.fmu")
    assert not Path("no folder").exists()
