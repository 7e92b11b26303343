"""The wheel: its bytes, its content, its types, and its use in a fresh environment."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from email.parser import Parser
from pathlib import Path

import pytest
from fmpy import read_model_description

import ahv

# What a user does first, in a folder of their own.
USE = """
import json, shutil, numpy as np, ahv
from fmpy import simulate_fmu

shutil.copyfile(ahv.template("vehicle"), "mine.toml")
with open("doublet.csv", "w") as file:
    file.write("time,delta_e[deg],phi\\n0,0,0\\n0.1,0,0\\n0.1,0.05,0\\n0.2,0.05,0\\n")
doublet = ahv.manoeuvre("doublet.csv")
options = dict(stop_time=0.5, output_interval=0.01, input=doublet, output=["V", "gamma", "eta1"])
flown = {version: simulate_fmu(ahv.fmu(version), **options) for version in ("2.0", "3.0")}
mine = simulate_fmu(ahv.vehicle("mine.toml"), **options)
print(json.dumps({
    "place": ahv.__file__,
    "end": [list(map(float, flight[-1])) for flight in (*flown.values(), mine)],
    "states": ahv.linear_model().A.shape,
}))
"""


def metadata(wheel: Path) -> dict[str, list[str]]:
    """Fields of the wheel's METADATA."""
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (n for n in archive.namelist() if n.endswith(".dist-info/METADATA"))
        message = Parser().parsestr(archive.read(name).decode())
    return {key: message.get_all(key, []) for key in message.keys()}  # noqa: SIM118


def test_the_same_fmus_give_the_same_wheel(wheel: Path, tmp_path: Path) -> None:
    """Built again elsewhere, from files of another date."""
    sources = tmp_path / "another place"
    shutil.copytree(wheel.parent / "wheel/package", sources)
    for file in sources.rglob("*"):
        os.utime(file, (1_700_000_000, 1_700_000_000))
    command = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory"]
    subprocess.run([*command, str(tmp_path)], cwd=sources, check=True)
    assert (tmp_path / wheel.name).read_bytes() == wheel.read_bytes()


def test_the_wheel_has_modules_fmus_templates_and_licences_alone(
    wheel: Path, all_fmus: dict[tuple[str, str], Path], root: Path
) -> None:
    with zipfile.ZipFile(wheel) as archive:
        content = {name: archive.read(name) for name in archive.namelist()}
    data = {
        **{file.name: file for file in all_fmus.values()},
        "vehicle.toml": root / "src/data/vehicle.toml",
        "parker2007.toml": root / "src/data/aero/parker2007.toml",
    }
    for name, file in data.items():
        assert content.pop(f"ahv/data/{name}") == file.read_bytes(), name
    sources = {f"ahv/{file.name}" for file in (root / "python/src/ahv").glob("*.py")}
    info = f"ahv-{metadata(wheel)['Version'][0]}.dist-info"
    licences = {f"{info}/licenses/{name}" for name in ("LICENSE-APACHE", "LICENSE-MIT")}
    described = {f"{info}/{name}" for name in ("METADATA", "RECORD", "WHEEL")}
    assert set(content) == sources | {"ahv/py.typed"} | licences | described


def test_each_model_has_its_fmus(all_fmus: dict[tuple[str, str], Path]) -> None:
    for (model, version), file in all_fmus.items():
        path = ahv.fmu(version, model)  # type: ignore[arg-type]
        assert path.read_bytes() == file.read_bytes()
        description = read_model_description(str(path))
        assert description.modelName == file.stem.removesuffix("_fmi3")
        assert description.fmiVersion == version


def test_the_wheel_needs_fmpy_and_numpy_alone(wheel: Path) -> None:
    fields = metadata(wheel)
    needed = sorted(re.split(r"[<>=!~ ]", text)[0] for text in fields["Requires-Dist"])
    assert needed == ["fmpy", "numpy"]
    assert fields["Requires-Python"] == [">=3.11"]
    assert fields["License-Expression"] == ["MIT OR Apache-2.0"]


@pytest.mark.parametrize("version", ["3.11", "3.12", "3.13"])
def test_a_fresh_environment_flies(version: str, wheel: Path, root: Path, tmp_path: Path) -> None:
    python = f"python{version}"
    if sys.version_info[:2] == tuple(map(int, version.split("."))):
        python = sys.executable
    found = shutil.which(python)
    if not found or subprocess.run([found, "-c", "import ensurepip"], check=False).returncode:
        pytest.skip(f"no {python} with venv on this machine")
    environment = tmp_path / "environment"
    subprocess.run([found, "-m", "venv", str(environment)], check=True)
    (own,) = [*environment.glob("bin/python"), *environment.glob("Scripts/python.exe")]
    # The versions that the other tests have, so that no new release fails this one.
    lock = (root / "tests/wheel/requirements.lock").read_text("utf-8")
    constraints = tmp_path / "constraints.txt"
    constraints.write_text("\n".join(re.findall(r"^\S+==\S+", lock, re.MULTILINE)), "utf-8")
    pip = [str(own), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, "--constraint", str(constraints), str(wheel)], check=True)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    done = subprocess.run(
        [str(own), "-I", "-W", "error", "-c", USE],
        cwd=elsewhere,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    # FMPy prints before which inputs have no column.
    said = json.loads(done.stdout.splitlines()[-1])
    assert Path(said["place"]).is_relative_to(environment)
    fmi2, fmi3, mine = said["end"]
    assert fmi2[0] == 0.5 and fmi2[2] != 0.0
    assert fmi2 == fmi3 == mine
    assert said["states"] == [16, 16]


def test_types_are_complete_inside_and_known_outside(
    installed: Path, root: Path, tmp_path: Path
) -> None:
    use = tmp_path / "use.py"
    use.write_text(
        "import ahv\n"
        "import numpy.typing as npt\nimport numpy as np\nfrom pathlib import Path\n"
        "fmu: Path = ahv.vehicle(ahv.template('vehicle'), fmu=ahv.fmu('3.0'))\n"
        "matrix: npt.NDArray[np.float64] = ahv.linear_model(fmu, configuration='Rigid').A\n"
        "table: npt.NDArray[np.void] = ahv.manoeuvre('doublet.csv')\n"
        "autopilot: Path = ahv.fmu(model='autopilot')\n"
        "wrong: int = ahv.fmu('4.0', 'engine')\n",
        "utf-8",
    )
    mypy = [sys.executable, "-m", "mypy", "--cache-dir", str(tmp_path / "cache")]
    config = ["--config-file", str(root / "python/pyproject.toml")]
    inside = subprocess.run(
        [*mypy, *config, str(root / "python/src/ahv")], capture_output=True, text=True, check=False
    )
    assert inside.returncode == 0, inside.stdout
    outside = subprocess.run(
        [*mypy, *config, str(use)],
        cwd=tmp_path,
        env=os.environ | {"MYPYPATH": str(installed)},
        capture_output=True,
        text=True,
        check=False,
    )
    errors = [line for line in outside.stdout.splitlines() if ": error: " in line]
    assert len(errors) == 3 and all("use.py:9" in line for line in errors), outside.stdout


def test_a_package_without_fmus_says_what_to_do(root: Path, tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", "import ahv; ahv.fmu()"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(root / "python/src")},
        capture_output=True,
        text=True,
        check=False,
    )
    error = done.stderr.splitlines()[-1]
    assert error.startswith("FileNotFoundError: ") and "ahv.fmu does not exist" in error
    assert "pip install target/ahv-*.whl" in error and "pass the path of an FMU" in error
