"""The WebAssembly component computes the bits of the library for this machine."""

from __future__ import annotations

import ctypes

import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model

from flying import inputs, moved, reason, same_steps
from harness import (
    AERO_SETS,
    ALL_DERIVATIVES,
    ALL_STATES,
    CONFIGURATIONS,
    INPUTS,
    OK,
    OUTPUTS,
    Package,
)
from host import KINDS, TIME, Host, Refused

# Of each of the nine flights.
STEPS = 1200
# s, at which explicit Euler lets no flexible mode grow.
EULER_STEP = 2e-4
FLIGHTS = [(c, a) for c in CONFIGURATIONS for a in range(1, 1 + len(AERO_SETS))]


@pytest.mark.parametrize(("configuration", "aero"), FLIGHTS)
def test_verif_wasm_computes_the_bits_of_the_library(
    package: Package, host: Host, configuration: int, aero: int
) -> None:
    """Every real variable after every step is the same double; and the vehicle has moved."""
    start = {"configuration": configuration, "aero": aero, "fuel_burn": True}
    with package.flight(**start) as native:
        wasm = host.flight(**start)
        rows = same_steps(native, wasm, range(STEPS))
        assert moved(rows) > 30
        assert wasm.call("get-float64", [TIME]) == [wasm.time] == [native.time]


def test_verif_wasm_has_the_parameters_that_were_set(package: Package, host: Host) -> None:
    """Of all types; and those that follow from them."""
    changed = {"configuration": 2, "trim": False, "fuel_fraction": 0.25, "mach0": 7.5}
    with package.flight(**changed) as native:
        wasm = host.flight(**changed)
        for name, value in changed.items():
            variable = package.variables[name]
            kind, reference = KINDS[variable.type], variable.valueReference
            assert wasm.call(f"get-{kind}", [reference]) == [native[name]] == [value]
        assert wasm.bits() == native.bits()


def test_verif_a_flight_goes_on_across_library_and_wasm(package: Package, host: Host) -> None:
    """Library, component, library: the state is the same bytes, the flight that of the library."""
    start = {"fuel_fraction": 0.5, "fuel_burn": True}
    with package.flight(**start) as alone, package.flight(**start) as native:
        wasm = host.instantiate("co-simulation")
        rows = same_steps(alone, native, range(70))
        state = native.fmu.serializeFMUstate(native.fmu.getFMUstate())
        wasm.call("set-fmu-state", state)
        wasm.time = native.time
        rows += same_steps(alone, wasm, range(70, 140))
        state = wasm.call("get-fmu-state")
        assert state == alone.fmu.serializeFMUstate(alone.fmu.getFMUstate())
        native.fmu.setFMUstate(native.fmu.deSerializeFMUstate(state))
        native.time = wasm.time
        rows += same_steps(alone, native, range(140, 210))
        assert moved(rows) > 30
        for damaged in (state[:-1], state[:-1] + bytes([state[-1] ^ 1]), b""):
            with pytest.raises(Refused, match="no FMU state of this model"):
                host.flight().call("set-fmu-state", damaged)


def test_verif_wasm_computes_the_derivatives_of_the_library(package: Package, host: Host) -> None:
    """Directional derivatives, derivatives of outputs; inputs that move within a step."""
    outputs = package.references(*OUTPUTS, *ALL_DERIVATIVES)
    knowns = package.references(*ALL_STATES, *INPUTS)
    with package.flight() as native:
        wasm = host.flight()
        pitch, elevator = package.references("theta", "delta_e")
        native.fmu.setRealInputDerivatives([elevator], [1], [0.01])
        wasm.call("set-input-derivatives", [(elevator, 1)], [0.01])
        same_steps(native, wasm, range(3))
        columns = []
        for known in knowns:
            expected = native.fmu.getDirectionalDerivative(outputs, [known], [1.5])
            given = wasm.call("get-directional-derivative", outputs, [known], [1.5])
            assert given == list(expected)
            columns.append(given)
        assert any(map(any, columns))
        seed = [0.5] * len(outputs)
        sums = wasm.call("get-adjoint-derivative", outputs, knowns, seed)
        assert np.allclose(sums, np.array(columns) @ seed / 1.5, rtol=1e-12)
        assert wasm.call("get-output-derivatives", [(pitch, 1)]) == [native["q"]]


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_wasm_integrates_as_the_library_does(
    package: Package, host: Host, configuration: int
) -> None:
    """Model Exchange: explicit Euler, with the bits of states, derivatives and all variables."""
    native = FMU2Model(
        guid=package.description.guid,
        unzipDirectory=str(package.folder),
        modelIdentifier=package.description.modelExchange.modelIdentifier,
    )
    native.instantiate()
    native.setInteger(package.references("configuration"), [configuration])
    native.setupExperiment(startTime=0.0)
    native.enterInitializationMode()
    native.exitInitializationMode()
    native.enterContinuousTimeMode()
    wasm = host.flight("model-exchange", configuration=configuration)
    assert not getattr(wasm.call("update-discrete-states"), "terminate-simulation")
    wasm.call("enter-continuous-time-mode")
    count = wasm.call("get-number-of-continuous-states")
    assert (count, wasm.call("get-number-of-event-indicators")) == (len(ALL_STATES), 0)
    assert wasm.call("get-event-indicators") == []
    reals = [v.valueReference for v in package.variables.values() if v.type == "Real"]
    array = ctypes.c_double * count
    states, rates = array(), array()
    native.getNominalsOfContinuousStates(states, count)
    assert wasm.call("get-nominals-of-continuous-states") == list(states)
    native.getContinuousStates(states, count)
    for step in range(1000):
        native.setTime(step * EULER_STEP)
        wasm.call("set-time", step * EULER_STEP)
        for name, value in inputs(step).items():
            native.setReal(package.references(name), [value])
        wasm.set(**inputs(step))
        native.getDerivatives(rates, count)
        assert wasm.call("get-continuous-state-derivatives") == list(rates), step
        assert wasm.get(*ALL_DERIVATIVES[:-1]).any() or not step
        assert wasm.call("get-float64", reals) == native.getReal(reals), step
        states = array(*(np.array(states) + EULER_STEP * np.array(rates)))
        native.setContinuousStates(states, count)
        wasm.call("set-continuous-states", list(states))
        assert wasm.call("get-continuous-states") == list(states)
        ends = wasm.call("completed-integrator-step", True)
        assert not getattr(ends, "enter-event-mode") and not getattr(ends, "terminate-simulation")
    wasm.call("enter-event-mode")
    wasm.call("terminate")
    native.terminate()
    native.freeInstance()


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_wasm_leaves_the_envelope_where_the_library_does(
    package: Package, host: Host, configuration: int
) -> None:
    """The step succeeds and ends the simulation, for the same reason, with the same values."""
    with package.flight(configuration=configuration, delta_e=0.05) as native:
        wasm = host.flight(configuration=configuration, delta_e=0.05)
        while native.step_status(0.01) == OK:
            wasm.step(0.01)
        ended = wasm.call("do-step", wasm.time, 0.01, True)
        assert getattr(ended, "terminate-simulation") and not getattr(ended, "early-return")
        assert getattr(ended, "last-successful-time") == native.last_time() < wasm.time + 0.01
        assert wasm.call("get-float64", [TIME]) == [native.last_time()]
        assert wasm.bits() == native.bits()
        said = host.log[-1]
        assert said[:3] == ("ahv", "discard", "logStatusDiscard")
        assert reason(said.text) == reason(native.log[-1].text)
        with pytest.raises(Refused, match="not allowed in state"):
            wasm.step(0.001)
