"""An instance of the FMU for FMI 3.0, addressed by the names of its variables."""

from __future__ import annotations

from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from fmpy import extract
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Model, FMU3Slave
from fmpy.model_description import ModelDescription, read_model_description

from harness import Message, package_path

if TYPE_CHECKING:
    from fmpy.model_description import ModelVariable

TIME = 2_147_483_647


class Package3:
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

    def slave(self, **options: Any) -> Instance3:
        """A new instance for co-simulation."""
        return Instance3(self, FMU3Slave, **options)

    def model(self) -> Instance3:
        """A new instance for model exchange."""
        return Instance3(self, FMU3Model)


def packaged3(folder: Path) -> Package3:
    """The FMU for FMI 3.0 beside the one under test, unzipped to `folder`."""
    path = package_path(version="3.0")
    extract(str(path), unzipdir=str(folder))
    return Package3(path, folder)


class Instance3:
    """One instance: `log` has its messages."""

    def __init__(self, package: Package3, kind: type, token: str | None = None, **options) -> None:
        self.package, self.log = package, []
        description = package.description
        self.fmu = kind(
            guid=description.guid if token is None else token,
            unzipDirectory=str(package.folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="ahv",
        )
        self.fmu.instantiate(logMessage=self._hear, **options)

    def _hear(self, _: Any, status: int, category: bytes, text: bytes) -> None:
        self.log.append(Message("ahv", status, category.decode(), text.decode()))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.fmu.freeInstance()

    def status(self, call: str, *arguments: Any) -> int:
        """Status of a call of FMPy's."""
        try:
            getattr(self.fmu, call)(*arguments)
        except FMICallException as error:
            return error.status
        return 0

    def set(self, **values: Any) -> None:
        """Set variables; enumerations by name or number."""
        for name, value in values.items():
            variable = self.package.variables[name]
            if isinstance(value, str):
                items = variable.declaredType.items
                value = next(int(item.value) for item in items if item.name == value)
            kind = {"Enumeration": "Int64"}.get(variable.type, variable.type)
            getattr(self.fmu, f"set{kind}")([variable.valueReference], [value])

    def initialise(self, tolerance: float | None = None, **values: Any) -> Self:
        """Set start values and initialise."""
        self.set(**values)
        self.fmu.enterInitializationMode(tolerance=tolerance)
        self.fmu.exitInitializationMode()
        return self

    def get(self, *names: str) -> np.ndarray:
        """Values of real variables."""
        return np.array(self.fmu.getFloat64(self.package.references(*names)))

    def __getitem__(self, name: str) -> float | int | bool:
        variable = self.package.variables[name]
        kind = {"Enumeration": "Int64"}.get(variable.type, variable.type)
        return getattr(self.fmu, f"get{kind}")([variable.valueReference])[0]
