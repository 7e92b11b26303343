"""An instance of the FMU for co-simulation, in either version of the standard, by names."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
import numpy.typing as npt
from fmpy import calloc, free, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.fmi3 import FMU3Slave

from ahv._text import suggest

DISCARD = 2  # fmi2Discard and fmi3Discard: the first status that is a failure


class FMUError(RuntimeError):
    """The FMU refused a call; the text is its own message."""


class Instance:
    """A new instance of the FMU unzipped in `folder`; `token` replaces that of its description."""

    def __init__(self, folder: Path, token: str | None = None) -> None:
        self.description = read_model_description(str(folder))
        self.variables = {v.name: v for v in self.description.modelVariables}
        self._parameters = [n for n, v in self.variables.items() if v.causality == "parameter"]
        self._is_fmi3 = self.description.fmiVersion.startswith("3")
        self._refusals: list[str] = []
        if self.description.coSimulation is None:
            raise FMUError(f"{folder}: the FMU has no co-simulation")
        kind = FMU3Slave if self._is_fmi3 else FMU2Slave
        try:
            self._fmu = kind(
                guid=self.description.guid if token is None else token,
                unzipDirectory=str(folder),
                modelIdentifier=self.description.coSimulation.modelIdentifier,
                instanceName="ahv",
            )
        except Exception as error:
            raise FMUError(f"the FMU's library cannot be loaded: {error}") from error
        try:
            self._instantiate()
        except Exception as error:
            self._fmu.freeLibrary()
            raise FMUError(self._refusal(error)) from error

    def _instantiate(self) -> None:
        if self._is_fmi3:
            self._fmu.instantiate(
                logMessage=lambda _, status, category, text: self._hear(status, text)
            )
            return
        callbacks = fmi2CallbackFunctions()
        # The text is a format of printf, in which %% is a percent sign.
        callbacks.logger = fmi2CallbackLoggerTYPE(
            lambda _, name, status, category, text: self._hear(status, text.replace(b"%%", b"%"))
        )
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self._fmu.instantiate(callbacks=callbacks)

    def _hear(self, status: int, text: bytes) -> None:
        if status >= DISCARD:
            self._refusals.append(text.decode("utf-8", "replace"))

    def _refusal(self, error: Exception) -> str:
        return self._refusals[-1] if self._refusals else str(error)

    def _call(self, function: str, *arguments: Any) -> Any:
        try:
            return getattr(self._fmu, function)(*arguments)
        except FMICallException as error:
            raise FMUError(self._refusal(error)) from error

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._fmu.freeInstance()

    def references(self, names: Sequence[str]) -> list[int]:
        """Value references of variables."""
        for name in names:
            if name not in self.variables:
                raise ValueError(f"there is no variable `{name}`; {suggest(name, self.variables)}")
        return [self.variables[name].valueReference for name in names]

    def _access(self, name: str) -> str:
        """Name of its getter and setter in FMPy, without `get` or `set`."""
        kind: str = self.variables[name].type
        if kind == "Enumeration":
            return "Int64" if self._is_fmi3 else "Integer"
        return kind

    def set_parameter(self, name: str, value: float | bool | str) -> None:
        """Set a parameter; an enumeration by name or number."""
        if name not in self._parameters:
            raise ValueError(f"there is no parameter `{name}`; {suggest(name, self._parameters)}")
        number = self._number(name, value)
        self._call(f"set{self._access(name)}", self.references([name]), [number])

    def _number(self, name: str, value: float | bool | str) -> float | bool:
        variable = self.variables[name]
        if variable.type == "Enumeration":
            items = {item.name: int(item.value) for item in variable.declaredType.items}
            names = {known.lower(): number for known, number in items.items()}
            number = names.get(value.lower(), 0) if isinstance(value, str) else value
            if number not in items.values():
                expected = ", ".join(f"{known} ({number})" for known, number in items.items())
                raise ValueError(f"{name} = {value!r} is refused; choose one of {expected}")
            return int(number)
        if isinstance(value, str):
            raise ValueError(f"{name} = {value!r} is refused; a number is expected")
        if variable.type == "Boolean":
            if value not in (0, 1):
                raise ValueError(f"{name} = {value!r} is refused; True or False is expected")
            return bool(value)
        return float(value)

    def value(self, name: str) -> float | bool | int:
        """Value of a variable of any type."""
        (value,) = self._call(f"get{self._access(name)}", self.references([name]))
        return value  # type: ignore[no-any-return]

    def reset(self) -> None:
        """Back to the start values of all variables, as if the instance were new."""
        self._refusals.clear()
        self._call("reset")

    def initialise(self) -> None:
        """Trim the vehicle with the parameters that were set."""
        if not self._is_fmi3:
            self._call("setupExperiment")
        self._call("enterInitializationMode")
        self._call("exitInitializationMode")

    def get(self, names: Sequence[str]) -> list[float]:
        """Values of real variables."""
        getter = "getFloat64" if self._is_fmi3 else "getReal"
        return list(self._call(getter, self.references(names)))

    def jacobian(self, unknowns: Sequence[str], knowns: Sequence[str]) -> npt.NDArray[np.float64]:
        """Derivatives of the unknowns (rows) with respect to the knowns (columns)."""
        rows = self.references(unknowns)
        columns = [
            self._call("getDirectionalDerivative", rows, [known], [1.0])
            for known in self.references(knowns)
        ]
        return np.array(columns, dtype=np.float64).reshape(len(knowns), len(unknowns)).T
