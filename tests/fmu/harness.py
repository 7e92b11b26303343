"""One co-simulation instance of the packaged FMU, addressed by the names of its variables."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np
import pytest
from fmpy import calloc, extract, free
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2Boolean,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2Integer,
    fmi2LastSuccessfulTime,
    fmi2Real,
    fmi2Terminated,
    fmi2ValueReference,
)
from fmpy.model_description import ModelDescription, read_model_description

if TYPE_CHECKING:
    from fmpy.model_description import ModelVariable

REPOSITORY = Path(__file__).resolve().parents[2]

ROOT = Path(__file__).resolve().parents[2]

OK, WARNING, DISCARD, ERROR = 0, 1, 2, 3

RIGID, EVEN_MASS_BEAM, SLOSH_BEAM = 1, 2, 3
CONFIGURATIONS = (RIGID, EVEN_MASS_BEAM, SLOSH_BEAM)
AERO_SETS = ("xu2015", "parker2007", "shock_expansion")

# States in the order of the oracle.
STATES = (
    *("V", "h", "gamma", "alpha", "q"),
    *("eta1", "eta1_dot", "eta2", "eta2_dot", "eta3", "eta3_dot"),
    *("eta_slosh1", "eta_slosh1_dot", "eta_slosh2", "eta_slosh2_dot"),
)
DERIVATIVES = tuple(f"der({name})" for name in STATES)
# Last: a state only while fuel burns.
FUEL = "fuel_mass"
ALL_STATES, ALL_DERIVATIVES = (*STATES, FUEL), (*DERIVATIVES, f"der({FUEL})")
CONTROLS = ("delta_e", "phi")
# Models of the control loop: the vehicle, and the parts around it.
PARTS = tuple(sorted(d.name for d in (REPOSITORY / "modelDescription").glob("ahv_*")))
MODELS = ("ahv", *PARTS)
# What a part measures, where zero is no measurement: m/s.
MEASURED = {"V": 2390.0}
GUSTS = ("w_gust", "u_gust")
INPUTS = (*CONTROLS, *GUSTS)
# Outputs that are not states: our name, the oracle's name.
SENSORS = ("theta_imu", "q_imu", "gamma_imu", "n_z_imu", "n_x_imu", "alpha_probe")
LOADS = ("lift", "drag", "thrust", "moment", "mach", "qbar", "n_z", "choking_margin")
OUTPUTS = {
    **{name: name for name in ("theta", *LOADS, *SENSORS)},
    **{"slosh1": "slosh_1", "slosh2": "slosh_2"},
}
EVERYTHING = (
    *(*STATES, *OUTPUTS, *DERIVATIVES, "delta_e_effective", "phi_effective"),
    *(FUEL, f"der({FUEL})"),
)
ACTIVE_STATES = {RIGID: 5, EVEN_MASS_BEAM: 11, SLOSH_BEAM: 15}


def ahv(*arguments: Any) -> subprocess.CompletedProcess[str]:
    """`cargo ahv` with these arguments; Cargo itself says nothing."""
    command = ["cargo", "ahv", *map(str, arguments)]
    quiet = os.environ | {"CARGO_TERM_QUIET": "true"}
    return subprocess.run(command, cwd=ROOT, env=quiet, capture_output=True, text=True, check=False)


class Message(NamedTuple):
    """What the FMU told its master."""

    instance: str
    status: int
    category: str
    text: str


class Package:
    """The FMU: its file, the directory it is unzipped to and its description."""

    def __init__(self, path: Path, folder: Path) -> None:
        self.path, self.folder = path, folder
        self.description: ModelDescription = read_model_description(str(folder))
        self.variables: dict[str, ModelVariable] = {
            variable.name: variable for variable in self.description.modelVariables
        }

    def references(self, *names: str) -> list[int]:
        """Value references of these variables."""
        return [self.variables[name].valueReference for name in names]

    def instance(self, name: str = "ahv", logging: bool = False) -> Instance:
        """A new instance, not initialised."""
        return Instance(self, name, logging)

    def flight(self, tolerance: float | None = None, **start: Any) -> Instance:
        """A new instance, initialised with these start values."""
        flight = Instance(self)
        try:
            flight.initialise(tolerance=tolerance, **start)
        except BaseException:
            flight.close()
            raise
        return flight


def package_path(model: str = "ahv", version: str = "2.0") -> Path:
    """The FMU under test (AHV_FMU, by default target/ahv.fmu), or that of a part beside it."""
    path = Path(os.environ.get("AHV_FMU", REPOSITORY / "target" / "ahv.fmu")).resolve()
    stem = path.stem if model == "ahv" else f"{model}{path.stem.removeprefix('ahv')}"
    path = path.with_name(f"{stem}{'_fmi3' if version == '3.0' else ''}.fmu")
    if not path.is_file():
        pytest.fail(f"{path} does not exist: run `cargo ahv package` or set AHV_FMU", pytrace=False)
    return path


def packaged(folder: Path, model: str = "ahv") -> Package:
    """The FMU of a model, unzipped to `folder`."""
    path = package_path(model)
    extract(str(path), unzipdir=str(folder))
    return Package(path, folder)


class Refused(Exception):
    """A call returned fmi2Discard or worse."""

    def __init__(self, function: str, status: int, log: Sequence[Message]) -> None:
        self.function, self.status = function, status
        self.text = log[-1].text if log else ""
        super().__init__(f"{function} returned {status}: {self.text}")


class Instance:
    """One instance: `log` has its messages, `time` is the end of the last step."""

    def __init__(self, package: Package, name: str = "ahv", logging: bool = False) -> None:
        self.package, self.time, self.log = package, 0.0, []
        self.fmu = FMU2Slave(
            guid=package.description.guid,
            unzipDirectory=str(package.folder),
            modelIdentifier=package.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(self._hear)
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self.fmu.instantiate(callbacks=callbacks, loggingOn=logging)
        self._open = True

    def _hear(self, _: Any, instance: bytes, status: int, category: bytes, text: bytes) -> None:
        self.log.append(Message(instance.decode(), status, category.decode(), text.decode()))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Free the instance."""
        if self._open:
            self._open = False
            self.fmu.freeInstance()

    def status(self, function: str, *arguments: Any) -> int:
        """Status of a plain FMI call."""
        try:
            return getattr(self.fmu, function)(self.fmu.component, *arguments)
        except FMICallException as error:
            return error.status

    def call(self, function: str, *arguments: Any) -> None:
        """A plain FMI call that has to return fmi2OK."""
        status = self.status(function, *arguments)
        if status != OK:
            raise Refused(function, status, self.log)

    def setup(
        self, tolerance: float | None = None, start: float = 0.0, stop: float | None = None
    ) -> None:
        """Set up the experiment and enter initialization mode."""
        given = (tolerance is not None, tolerance or 0.0, start, stop is not None, stop or 0.0)
        self.call("fmi2SetupExperiment", *given)
        self.call("fmi2EnterInitializationMode")
        self.time = start

    def initialise(
        self,
        tolerance: float | None = None,
        start: float = 0.0,
        stop: float | None = None,
        **values: Any,
    ) -> None:
        """Set start values and initialise; instances that were reset too."""
        self.set(**values)
        self.setup(tolerance, start, stop)
        self.call("fmi2ExitInitializationMode")

    def _number(self, variable: ModelVariable, value: Any) -> Any:
        if isinstance(value, str):
            items = variable.declaredType.items
            return next(int(item.value) for item in items if item.name == value)
        return value

    def set(self, **values: Any) -> None:
        """Set variables; enumerations by name or number."""
        for name, value in values.items():
            variable = self.package.variables[name]
            kind = "Integer" if variable.type == "Enumeration" else variable.type
            c_type = {"Real": fmi2Real, "Integer": fmi2Integer, "Boolean": fmi2Boolean}[kind]
            reference = fmi2ValueReference(variable.valueReference)
            number = c_type(self._number(variable, value))
            self.call(f"fmi2Set{kind}", reference, 1, number)

    def get(self, *names: str) -> np.ndarray:
        """Values of real variables."""
        count = len(names)
        references = self.package.references(*names)
        values = (fmi2Real * count)()
        self.call("fmi2GetReal", (fmi2ValueReference * count)(*references), count, values)
        return np.array(values)

    def __getitem__(self, name: str) -> float | int | bool:
        variable = self.package.variables[name]
        if variable.type == "Real":
            return float(self.get(name)[0])
        get = self.fmu.getBoolean if variable.type == "Boolean" else self.fmu.getInteger
        return get([variable.valueReference])[0]

    def bits(self) -> bytes:
        """The bits of all real variables."""
        names = [name for name, v in self.package.variables.items() if v.type == "Real"]
        return self.get(*names).tobytes()

    def step(self, size: float) -> None:
        """One communication step."""
        self.call("fmi2DoStep", self.time, size, True)
        self.time += size

    def step_status(self, size: float) -> int:
        """Status of a communication step that may fail."""
        status = self.status("fmi2DoStep", self.time, size, True)
        if status == OK:
            self.time += size
        return status

    def last_time(self) -> float:
        """The time that the last step reached."""
        return self.fmu.getRealStatus(fmi2LastSuccessfulTime)

    def terminated(self) -> bool:
        """Whether the FMU wants the simulation to end."""
        return self.fmu.getBooleanStatus(fmi2Terminated)

    def fly(
        self,
        steps: int,
        step: float,
        inputs: Callable[[int], Sequence[float]] | None = None,
        names: Sequence[str] = EVERYTHING,
    ) -> np.ndarray:
        """Values of `names` at the start and after each step; inputs(k) are held in step k.

        It gives the controls, and the gusts if it likes.
        """
        rows = []
        for k in range(steps):
            if inputs is not None:
                self.set(**dict(zip(INPUTS, map(float, inputs(k)), strict=False)))
            if k == 0:
                rows.append(self.get(*names))
            self.step(step)
            rows.append(self.get(*names))
        return np.array(rows)
