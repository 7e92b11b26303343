"""Closed loop of the FMU and an autopilot in numpy, without a master."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from functools import cache
from types import TracebackType
from typing import NamedTuple, Self

import numpy as np
from fmpy import read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE, fmi2OK

from law import Autopilot, Law

MEASURED = ("V", "gamma", "q")
COMMANDS = ("delta_e", "phi")
TRIM = ("delta_e_trim", "phi_trim")
AIR = ("w_gust", "u_gust")


described = cache(read_model_description)


class NoFlight(Exception):
    """The FMU refused its parameters or found no trim; with its message."""


class Instance:
    """An instance of the FMU unzipped in `folder`; not initialised."""

    def __init__(self, folder: str, name: str, callbacks: fmi2CallbackFunctions) -> None:
        description = described(folder)
        self.variables = {v.name: v for v in description.modelVariables}
        self._fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self._fmu.instantiate(callbacks=callbacks)

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
        self._fmu.freeInstance()

    def _initialise(self, parameters: Mapping[str, float]) -> None:
        kinds = {"Real": self._fmu.setReal, "Boolean": self._fmu.setBoolean}
        for name, value in parameters.items():
            variable = self.variables[name]
            call = kinds.get(variable.type, self._fmu.setInteger)
            call([variable.valueReference], [value])
        self._fmu.setupExperiment()
        self._fmu.enterInitializationMode()
        self._fmu.exitInitializationMode()

    def _references(self, names: tuple[str, ...]) -> ctypes.Array:
        references = [self.variables[name].valueReference for name in names]
        return (ctypes.c_uint32 * len(names))(*references)


class Vehicle(Instance):
    """An instance of the FMU unzipped in `folder`, trimmed with these parameters; or NoFlight.

    `said` is its last message, `trim` delta_e, rad, and phi of level flight. Calls that do not
    return fmi2OK raise FMICallException.
    """

    def __init__(self, folder: str, outputs: tuple[str, ...] = (), **parameters: float) -> None:
        self.said, self.time = "", 0.0
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(self._hear)
        super().__init__(folder, "vehicle", callbacks)
        try:
            self._initialise(parameters)
        except FMICallException as error:
            self.close()
            raise NoFlight(self.said or str(error)) from error
        # Buffers and pointers are created once, so that a step is three plain C calls.
        self.outputs = (*MEASURED, *outputs)
        self._commands, self._values = np.zeros(2), np.zeros(len(self.outputs))
        self._commands_at, self._values_at = pointer(self._commands), pointer(self._values)
        self._into, self._out = self._references(COMMANDS), self._references(self.outputs)
        self._air = self._references(AIR)
        self.trim = np.array(self._fmu.getReal([self.variables[n].valueReference for n in TRIM]))

    def _hear(self, _: object, __: bytes, status: int, ___: bytes, text: bytes) -> None:
        if status != fmi2OK:
            self.said = text.decode()

    def command(self, commands: np.ndarray, rates: np.ndarray | None = None) -> None:
        """Set delta_e, rad, and phi; `rates` per second if they vary within the next step."""
        self._commands[:] = commands
        self._fmu.fmi2SetReal(self._fmu.component, self._into, 2, self._commands_at)
        if rates is not None:
            slopes, orders = np.array(rates, dtype=float), (ctypes.c_int * 2)(1, 1)
            self._fmu.fmi2SetRealInputDerivatives(
                self._fmu.component, self._into, 2, orders, pointer(slopes)
            )

    def gust(self, air: np.ndarray, rates: np.ndarray) -> None:
        """Set w_gust (up) and u_gust (along), m/s, and their `rates` within the next step."""
        component, orders = self._fmu.component, (ctypes.c_int * 2)(1, 1)
        speeds, slopes = np.array(air, dtype=float), np.array(rates, dtype=float)
        self._fmu.fmi2SetReal(component, self._air, 2, pointer(speeds))
        self._fmu.fmi2SetRealInputDerivatives(component, self._air, 2, orders, pointer(slopes))

    def step(self, size_s: float) -> None:
        """One communication step."""
        self._fmu.fmi2DoStep(self._fmu.component, self.time, size_s, 0)
        self.time += size_s

    def read(self) -> np.ndarray:
        """Current values of `outputs`."""
        size = len(self._values)
        self._fmu.fmi2GetReal(self._fmu.component, self._out, size, self._values_at)
        return self._values.copy()

    def rates(self) -> np.ndarray:
        """First derivatives of `outputs` from the FMU."""
        size = len(self._values)
        slopes, orders = np.zeros(size), (ctypes.c_int * size)(*[1] * size)
        self._fmu.fmi2GetRealOutputDerivatives(
            self._fmu.component, self._out, size, orders, pointer(slopes)
        )
        return slopes

    def save(self) -> tuple[object, float]:
        """Save the FMU state."""
        return self._fmu.getFMUState(), self.time

    def restore(self, state: tuple[object, float]) -> None:
        """Restore a saved state."""
        self._fmu.setFMUState(state[0])
        self.time = state[1]

    def forget(self, state: tuple[object, float]) -> None:
        """Free a saved state."""
        self._fmu.freeFMUState(state[0])


def pointer(values: np.ndarray) -> ctypes.POINTER(ctypes.c_double):
    """Pointer to an array of doubles."""
    return values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


class Flight(NamedTuple):
    """Rows of time, V, gamma, q, further outputs, delta_e, phi; the reason of an early end."""

    rows: np.ndarray
    ended: str
    pilot: Autopilot


def wanted(manoeuvre: np.ndarray, stop_s: float, period_s: float) -> np.ndarray:
    """Commands of the manoeuvre at every communication point, shape (steps, 2)."""
    times = np.arange(round(stop_s / period_s)) * period_s
    columns = [
        np.interp(times, manoeuvre["time_s"], manoeuvre[name])
        for name in ("V_change", "gamma_wanted")
    ]
    return np.column_stack(columns)


def fly(
    folder: str,
    law: Law,
    commands: np.ndarray,
    outputs: tuple[str, ...] = (),
    gust: np.ndarray | None = None,
    **parameters: float,
) -> Flight:
    """Fly `commands`, shape (steps, 2), in closed loop.

    `gust`, m/s, shape (steps + 1, 2): AIR at the communication points, linear between them.
    What the law calls level flight is that of this vehicle, as if it had been trimmed before.
    """
    rows, ended = [], ""
    with Vehicle(folder, outputs, **parameters) as vehicle:
        values, held = vehicle.read(), np.zeros(2)
        pilot = Autopilot(law.at(values[:3], vehicle.trim))
        try:
            for k, wish in enumerate(commands):
                vehicle.command(held)
                if gust is not None:
                    vehicle.gust(gust[k], (gust[k + 1] - gust[k]) / law.period_s)
                vehicle.step(law.period_s)
                held = pilot.step(values[:3], wish)
                values = vehicle.read()
                rows.append([vehicle.time, *values, *held])
        except FMICallException:
            ended = vehicle.said
    width = 3 + len(vehicle.outputs)
    return Flight(np.array(rows).reshape(-1, width), ended, pilot)
