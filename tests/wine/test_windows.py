"""The library for Windows computes the bits of the library for Linux, and each continues a flight
of the other. One driver in C, compiled for both; Windows is played by wine."""

from __future__ import annotations

import os
import shutil
import struct
import subprocess
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import fmpy
import numpy as np
import pytest

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
STEP = 0.01
STOP = 2.0
INPUTS = ("delta_e", "phi")


class System(NamedTuple):
    """How a program is compiled and run."""

    binary: str
    compiler: str
    options: tuple[str, ...]
    runner: tuple[str, ...]


SYSTEMS = {
    "linux": System("linux64/ahv.so", "cc", ("-ldl",), ()),
    "windows": System("win64/ahv.dll", "x86_64-w64-mingw32-gcc", ("-static",), ("wine",)),
}


class Flights:
    """The packaged FMU, and a driver for each system."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        path = os.environ.get("AHV_FMU", REPOSITORY / "target" / "ahv.fmu")
        description = fmpy.read_model_description(str(path))
        self.guid = description.guid
        variables = description.modelVariables
        names = {variable.name: variable.valueReference for variable in variables}
        outputs = [v.name for v in variables if v.causality == "output"]
        self.references = [str(names[name]) for name in (*INPUTS, *outputs)]
        self.outputs = len(outputs)
        with zipfile.ZipFile(path) as archive:
            for system, parts in SYSTEMS.items():
                archive.extract(f"binaries/{parts.binary}", folder)
                self.compile(system, HERE / "driver.c", f"{system}.exe", parts.options)
        options = ("-shared", "-ladvapi32")
        self.compile("windows", HERE / "prng.c", "bcryptprimitives.dll", options)
        # The prefix is kept: making one takes longer than the tests.
        prefix = REPOSITORY / "target" / "wine"
        prefix.mkdir(parents=True, exist_ok=True)
        # No installers, no messages of wine itself.
        quiet = {"WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml="}
        self.environment = {**os.environ, "WINEPREFIX": str(prefix), **quiet}

    def compile(self, system: str, source: Path, name: str, options: Sequence[str]) -> None:
        """Compiles one file."""
        headers = Path(fmpy.__file__).parent / "c-code"
        command = [SYSTEMS[system].compiler, "-O1", "-Wall", f"-I{headers}", str(source)]
        subprocess.run([*command, "-o", str(self.folder / name), *options], check=True)

    def fly(
        self, system: str, steps: np.ndarray, *, restore: str = "-", save: str = "-"
    ) -> np.ndarray:
        """Outputs after each step as their 64 bits; steps are time, length, inputs."""
        parts = SYSTEMS[system]
        program = [*parts.runner, str(self.folder / f"{system}.exe")]
        library = f"binaries/{parts.binary}"
        arguments = [library, self.guid, restore, save, str(len(INPUTS)), *self.references]
        rows = (" ".join(struct.pack(">d", x).hex() for x in row) for row in steps)
        result = subprocess.run(
            [*program, *arguments],
            input="\n".join(rows),
            capture_output=True,
            text=True,
            cwd=self.folder,
            env=self.environment,
            timeout=300,
        )
        assert result.returncode == 0, result.stderr
        lines = result.stdout.split()
        bits = np.array([[int(word, 16) for word in line.split(",")] for line in lines], np.uint64)
        assert bits.shape == (len(steps), self.outputs)
        return bits


@pytest.fixture(scope="module")
def flights(tmp_path_factory: pytest.TempPathFactory) -> Flights:
    """Drivers and libraries, in a folder with a space."""
    for system in SYSTEMS.values():
        for program in (system.compiler, *system.runner):
            assert shutil.which(program), f"{program} is missing; see `cargo ahv test`"
    return Flights(tmp_path_factory.mktemp("two systems"))


@pytest.fixture(scope="module")
def doublet() -> np.ndarray:
    """Steps of the example's manoeuvre: time, length, elevator, fuel ratio."""
    file = REPOSITORY / "examples" / "elevator_doublet.csv"
    given = np.loadtxt(file, delimiter=",", skiprows=1)
    time = STEP * np.arange(round(STOP / STEP))
    inputs = (np.interp(time, given[:, 0], given[:, column]) for column in (1, 2))
    return np.column_stack([time, np.full_like(time, STEP), *inputs])


@pytest.fixture(scope="module")
def on_linux(flights: Flights, doublet: np.ndarray) -> np.ndarray:
    """The whole flight on Linux."""
    return flights.fly("linux", doublet)


def test_verif_windows_computes_the_bits_of_linux(
    flights: Flights, doublet: np.ndarray, on_linux: np.ndarray
) -> None:
    """Every output after every step is the same double; and the vehicle has moved."""
    assert np.array_equal(flights.fly("windows", doublet), on_linux)
    assert (on_linux[0] != on_linux[-1]).sum() > flights.outputs // 2


def test_verif_each_system_continues_a_flight_of_the_other(
    flights: Flights, doublet: np.ndarray, on_linux: np.ndarray
) -> None:
    """Linux, Windows, Linux: the state travels as bytes, and the flight is that of Linux alone."""
    first, second, third = np.split(doublet, [70, 140])
    flown = [
        flights.fly("linux", first, save="first.state"),
        flights.fly("windows", second, restore="first.state", save="second.state"),
        flights.fly("linux", third, restore="second.state"),
    ]
    assert np.array_equal(np.vstack(flown), on_linux)
