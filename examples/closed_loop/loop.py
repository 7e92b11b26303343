"""The container of autopilot and vehicle flown again and again by one instance, in FMPy."""

from __future__ import annotations

import ctypes
import re
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.logging import addLoggerProxy

from flight import Instance, NoFlight

WARNING = 1
# What an FMU within the container says, but for the container's own account of the function.
WITHIN = re.compile(r"\w+\.fmu: (?!fmu\w+ status=)(.*)", re.DOTALL)


class Flown(NamedTuple):
    """Rows of time, s, and outputs after each communication step; the reason of an early end."""

    rows: np.ndarray
    ended: str


class Loop(Instance):
    """An instance of the container unzipped in `folder`, which records these outputs."""

    def __init__(self, folder: str, outputs: tuple[str, ...]) -> None:
        self._said: list[str] = []
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(self._hear)
        # The container passes the text as an argument of printf, which Python cannot read.
        addLoggerProxy(ctypes.byref(callbacks))
        super().__init__(folder, "loop", callbacks)
        self._is_used = False
        self._out = self._references(outputs)
        # FMPy's wrappers cost more than the calls, and so does releasing the interpreter's lock
        # for microseconds where other threads want it.
        library = ctypes.PyDLL(self._fmu.dll._name)
        component = ctypes.c_void_p(self._fmu.component)
        self._step, self._get = library.fmi2DoStep, library.fmi2GetReal
        double = ctypes.c_double
        self._step.argtypes = [ctypes.c_void_p, double, double, ctypes.c_int]
        self._get.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
        self._component = component

    def _hear(self, _: object, __: bytes, status: int, ___: bytes, text: bytes) -> None:
        if status >= WARNING and (said := WITHIN.fullmatch(text.decode("utf-8", "replace"))):
            self._said.append(said[1])

    def _start(self, parameters: Mapping[str, float]) -> None:
        if self._is_used:
            self._fmu.reset()
        self._is_used = True
        self._said.clear()
        try:
            self._initialise(parameters)
        except FMICallException as error:
            raise NoFlight(self._said[0] if self._said else str(error)) from error

    def fly(self, parameters: Mapping[str, float], stop_s: float, step_s: float) -> Flown:
        """Fly with these parameters in communication steps of `step_s`; or NoFlight.

        The steps of the master within the container do not depend on it.
        """
        self._start(parameters)
        rows = np.zeros((round(stop_s / step_s), 1 + len(self._out)))
        width, ended, count = len(self._out), "", 0
        at = rows.ctypes.data
        for k in range(len(rows)):
            if self._step(self._component, k * step_s, step_s, 1):
                ended = self._said[0] if self._said else "the container gave no reason"
                break
            self._get(self._component, self._out, width, at + 8 * (k * (width + 1) + 1))
            count = k + 1
        rows = rows[:count]
        rows[:, 0] = step_s * np.arange(1, count + 1)
        return Flown(rows, ended)
