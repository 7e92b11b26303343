"""No call of a part raises a floating-point exception: some hosts trap them.

As of a release build, in which the compiler speculates; tests/abi_host has the vehicle.
"""

from __future__ import annotations

import contextlib
import ctypes
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import fmi2Integer, fmi2Real, fmi2ValueReference
from fmpy.model_description import ModelVariable

from harness import MEASURED, PARTS, Instance, Refused, packaged

pytestmark = pytest.mark.skipif(fmpy.platform != "linux64", reason="asks glibc on x86-64")

# FE_INVALID, FE_DIVBYZERO and FE_OVERFLOW.
EXCEPTIONS = 1 | 4 | 8
CASES, STEPS = 150, 8
STEP_SIZES = (1e-12, 1e-3, 0.01, 0.37, 10.0, 1e6)
STARTS = (0.0, -5.0, 1e9)
# For what has no range.
LARGEST = 1e300


@contextlib.contextmanager
def watched(scene: object) -> Iterator[None]:
    """Calls within raise no exception; a refusal is none."""
    libm = ctypes.CDLL("libm.so.6")
    libm.feclearexcept(EXCEPTIONS)
    try:
        yield
    finally:
        assert libm.fetestexcept(EXCEPTIONS) == 0, scene


def value(random: np.random.Generator, variable: ModelVariable) -> Any:
    """An end of the range, or a number of any size within it."""
    if variable.type == "Enumeration":
        return int(random.integers(len(variable.declaredType.items))) + 1
    if variable.type == "Integer":
        return int(random.integers(-(2**31), 2**31))
    least, largest = (
        float(limit or sign * LARGEST) for limit, sign in ((variable.min, -1), (variable.max, 1))
    )
    size = 10.0 ** random.uniform(-12.0, np.log10(largest))
    known = MEASURED.get(variable.name, 0.0)
    return float(random.choice(np.clip([least, largest, size, -size, known], least, largest)))


def lead(flight: Instance, name: str, slope: float) -> None:
    """An input moves within the next step."""
    (u,) = flight.package.references(name)
    order = fmi2Integer(1)
    flight.call("fmi2SetRealInputDerivatives", fmi2ValueReference(u), 1, order, fmi2Real(slope))


@pytest.mark.parametrize("model", PARTS)
def test_verif_no_call_raises_a_floating_point_exception(model: str, tmp_path: Path) -> None:
    """Random parameters, inputs, measurements that are NaN, starts and steps."""
    random, package = np.random.default_rng(1), packaged(tmp_path, model)
    variables = package.variables.values()
    parameters = [v for v in variables if v.causality == "parameter"]
    inputs = [v for v in variables if v.causality == "input"]
    outputs = [v.name for v in variables if v.causality == "output"]
    stepped = 0
    for case in range(CASES):
        chosen = {
            v.name: value(random, v) for v in random.choice(parameters, size=case % 5).tolist()
        }
        start = float(random.choice(STARTS))
        with package.instance() as flight, contextlib.suppress(Refused):
            with watched(chosen):
                flight.initialise(start=start, **chosen)
            for _ in range(STEPS):
                given = {v.name: value(random, v) for v in inputs}
                if model == "ahv_autopilot":
                    given |= MEASURED
                    failed = random.choice(["V", "gamma", "q", "fuel_mass"])
                    given[failed] = float(random.choice([np.nan, np.inf, given[failed]]))
                size = float(random.choice(STEP_SIZES))
                with watched((chosen, start, given, size)):
                    flight.set(**given)
                    lead(flight, inputs[0].name, float(random.choice([0.0, 1.0, -1e30])))
                    flight.step(size)
                    flight.get(*outputs)
                    state = flight.fmu.getFMUstate()
                    kept = flight.fmu.serializeFMUstate(state)
                    copy = flight.fmu.deSerializeFMUstate(kept)
                    flight.fmu.setFMUstate(copy)
                    flight.fmu.freeFMUstate(state)
                    flight.fmu.freeFMUstate(copy)
                stepped += 1
    assert stepped > CASES
