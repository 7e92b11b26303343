"""The libraries for Windows and for Linux on ARM compute the bits of the library for Linux on
x86-64, and each continues a flight of it. One driver in C, compiled for all, in wine and qemu."""

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
# What a part measures, where zero is no measurement: m/s.
MEASURED = {"V": 2390.0}
# The parts of the control loop.
PARTS = sorted(folder.name for folder in (REPOSITORY / "modelDescription").glob("ahv_*"))


class System(NamedTuple):
    """How a program is compiled and run."""

    platform: str
    ending: str
    compiler: tuple[str, ...]
    options: tuple[str, ...]
    runner: tuple[str, ...]


TARGET = REPOSITORY / "target"
ZIG = (
    str(TARGET / "zig" / "bin" / "python"),
    "-m",
    "ziglang",
    "cc",
    "-target",
    "aarch64-linux-gnu.2.17",
)
ARM_LIBRARIES = "/usr/aarch64-linux-gnu"
SYSTEMS = {
    "linux": System("linux64", "so", ("cc",), ("-ldl",), ()),
    "windows": System("win64", "dll", ("x86_64-w64-mingw32-gcc",), ("-static",), ("wine",)),
    "arm": System("aarch64-linux", "so", ZIG, ("-ldl",), ("qemu-aarch64", "-L", ARM_LIBRARIES)),
}
OTHERS = [system for system in SYSTEMS if system != "linux"]
CONFIGURATIONS = (1, 2, 3)
COEFFICIENT_SETS = (1, 2, 3)


class Flights:
    """A packaged FMU, and drivers for Linux and another system."""

    def __init__(self, folder: Path, other: str, model: str = "ahv") -> None:
        self.folder = folder
        self.other = other
        self.model = model
        path = Path(os.environ.get("AHV_FMU", REPOSITORY / "target" / "ahv.fmu"))
        path = path.with_name(path.name.replace("ahv", model, 1))
        description = fmpy.read_model_description(str(path))
        self.guid = description.guid
        variables = description.modelVariables
        names = {variable.name: variable.valueReference for variable in variables}
        outputs = [v.name for v in variables if v.causality == "output"]
        self.parameters = [names[name] for name in ("configuration", "aero") if name in names]
        inputs = [v.name for v in variables if v.causality == "input"]
        self.inputs = INPUTS if model == "ahv" else inputs
        self.references = [str(names[name]) for name in (*self.inputs, *outputs)]
        self.outputs = len(outputs)
        with zipfile.ZipFile(path) as archive:
            for system in ("linux", other):
                parts = SYSTEMS[system]
                archive.extract(self.library(system), folder)
                self.compile(system, HERE / "driver.c", f"{system}.exe", parts.options)
        if other == "windows":
            options = ("-shared", "-ladvapi32")
            self.compile("windows", HERE / "prng.c", "bcryptprimitives.dll", options)
        # The prefix is kept: making one takes longer than the tests.
        prefix = TARGET / "wine"
        prefix.mkdir(parents=True, exist_ok=True)
        # No installers, no messages of wine itself.
        quiet = {"WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml="}
        self.environment = {**os.environ, "WINEPREFIX": str(prefix), **quiet}

    def library(self, system: str) -> str:
        """The library for a system, in the package and in the folder."""
        return f"binaries/{SYSTEMS[system].platform}/{self.model}.{SYSTEMS[system].ending}"

    def compile(self, system: str, source: Path, name: str, options: Sequence[str]) -> None:
        """Compiles one file."""
        headers = Path(fmpy.__file__).parent / "c-code"
        command = [*SYSTEMS[system].compiler, "-O1", "-Wall", f"-I{headers}", str(source)]
        subprocess.run([*command, "-o", str(self.folder / name), *options], check=True)

    def fly(
        self,
        system: str,
        steps: np.ndarray,
        *,
        restore: str = "-",
        save: str = "-",
        values: Sequence[int] = (),
    ) -> np.ndarray:
        """Outputs after each step as their 64 bits.

        Steps are time, length, inputs; values are those of configuration and coefficient set."""
        parts = SYSTEMS[system]
        program = [*parts.runner, str(self.folder / f"{system}.exe")]
        pairs = zip(self.parameters, values, strict=False)
        settings = ",".join(f"{reference}={value}" for reference, value in pairs)
        arguments = [
            self.library(system),
            self.guid,
            restore,
            save,
            settings,
            str(len(self.inputs)),
            *self.references,
        ]
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


@pytest.fixture(scope="module", params=OTHERS)
def other(request: pytest.FixtureRequest) -> str:
    """Another system, for which this machine has a compiler and an emulator."""
    for system in ("linux", request.param):
        for program in (SYSTEMS[system].compiler[0], *SYSTEMS[system].runner[:1]):
            assert shutil.which(program), f"{program} is missing; see `cargo ahv test`"
    return request.param


@pytest.fixture(scope="module")
def flights(other: str, tmp_path_factory: pytest.TempPathFactory) -> Flights:
    """Drivers and the vehicle's libraries, in a folder with a space."""
    return Flights(tmp_path_factory.mktemp("two systems"), other)


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


@pytest.fixture(scope="module")
def random_steps() -> np.ndarray:
    """Uneven steps with random inputs, too small to leave the region of validity."""
    random = np.random.default_rng(20150181)
    lengths = random.uniform(0.002, 0.03, 40)
    times = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    inputs = random.uniform(-1.0, 1.0, (lengths.size, len(INPUTS))) * (2e-4, 0.02)
    return np.column_stack([times, lengths, inputs])


def test_verif_another_system_computes_the_bits_of_linux(
    flights: Flights, doublet: np.ndarray, on_linux: np.ndarray
) -> None:
    """Every output after every step is the same double; and the vehicle has moved."""
    assert np.array_equal(flights.fly(flights.other, doublet), on_linux)
    assert (on_linux[0] != on_linux[-1]).sum() > flights.outputs // 2


@pytest.mark.parametrize("aero", COEFFICIENT_SETS)
@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_every_vehicle_flies_random_manoeuvres_with_the_same_bits(
    flights: Flights, random_steps: np.ndarray, configuration: int, aero: int
) -> None:
    """All configurations and coefficient sets; and they are different vehicles."""
    values = (configuration, aero)
    bits = flights.fly("linux", random_steps, values=values)
    assert np.array_equal(flights.fly(flights.other, random_steps, values=values), bits)
    default = flights.fly("linux", random_steps)
    assert np.array_equal(bits, default) == (values == (3, 1))


def test_verif_each_system_continues_a_flight_of_the_other(
    flights: Flights, doublet: np.ndarray, on_linux: np.ndarray
) -> None:
    """Linux, elsewhere, Linux: the state travels as bytes; the flight is that of Linux alone."""
    first, second, third = np.split(doublet, [70, 140])
    flown = [
        flights.fly("linux", first, save="first.state"),
        flights.fly(flights.other, second, restore="first.state", save="second.state"),
        flights.fly("linux", third, restore="second.state"),
    ]
    assert np.array_equal(np.vstack(flown), on_linux)


@pytest.mark.parametrize("part", PARTS)
def test_verif_every_part_computes_the_bits_of_linux_and_continues_its_flight(
    part: str, other: str, tmp_path: Path
) -> None:
    """Uneven steps with random inputs, half on each system; and an output has moved."""
    flights = Flights(tmp_path, other, part)
    random = np.random.default_rng(20150181)
    lengths = random.uniform(0.002, 0.03, 60)
    times = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    inputs = random.uniform(-0.05, 0.05, (lengths.size, len(flights.inputs)))
    inputs += [MEASURED.get(name, 0.0) for name in flights.inputs]
    steps = np.column_stack([times, lengths, inputs])
    on_linux = flights.fly("linux", steps)
    assert np.array_equal(flights.fly(other, steps), on_linux)
    assert (on_linux[0] != on_linux[-1]).any()
    flights.fly("linux", steps[:30], save="half.state")
    assert np.array_equal(flights.fly(other, steps[30:], restore="half.state"), on_linux[30:])
