"""The WebAssembly component computes the bits of the library for this machine."""

from __future__ import annotations

import ctypes
import resource

import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model

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
from harness import Instance as Native
from harness import Refused as NativeRefused
from host import KINDS, PACKAGE, TIME, Host, Instance, Refused

# s; nine flights of as many steps.
STEP, STEPS = 1e-3, 1200
# s, at which explicit Euler lets no flexible mode grow.
EULER_STEP = 2e-4
# In the bytes of a state: offset of the instance's state in the order of calls, length of the checksum.
PHASE, CHECKSUM = 32, 8
# Of a running instance.
LEAST_INSTANCE_KB = 50
FLIGHTS = [(c, a) for c in CONFIGURATIONS for a in range(1, 1 + len(AERO_SETS))]


def inputs(step: int) -> dict[str, float]:
    """Elevator up and down, a little fuel, gusts: small enough for every vehicle."""
    elevator = 5e-4 if 100 <= step < 300 else -5e-4 if 300 <= step < 500 else 0.0
    gust = 0.1 * np.sin(0.02 * step)
    return {"delta_e": elevator, "phi": 1e-3 * (step % 50), "w_gust": gust, "u_gust": -gust}


def moved(rows: list[bytes]) -> int:
    """How many real variables differ between the first and the last row."""
    first, last = np.frombuffer(rows[0], np.uint64), np.frombuffer(rows[-1], np.uint64)
    return int((first != last).sum())


def reason(text: str) -> str:
    """A message without the name of the function, which is another in FMI 3.0."""
    return text.partition(": ")[2]


def same_steps(one: Native, other: Native | Instance, steps: range) -> list[bytes]:
    """Flies both; the bits of all real variables after each step, which are the same."""
    rows = []
    for step in steps:
        for flight in (one, other):
            flight.set(**inputs(step))
            flight.step(STEP)
        rows.append(one.bits())
        assert rows[-1] == other.bits(), f"step {step}"
    return rows


def test_verif_the_component_has_the_interfaces_of_the_draft_and_needs_callbacks_alone(
    host: Host,
) -> None:
    """No clock, no file, no random number: a host has to provide the callbacks and nothing else."""
    assert set(host.imports) == {PACKAGE.format(name) for name in ("types", "callbacks")}
    names = ("common", "co-simulation", "model-exchange")
    assert set(host.exports) == {PACKAGE.format(name) for name in names}
    assert host.run("common", "get-version") == "3.0"


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
    """The step succeeds and ends the simulation, for the same reason and at the same time and values."""
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


def test_verif_wasm_refuses_an_impossible_trim_as_the_library_does(
    package: Package, host: Host
) -> None:
    """Initialisation fails with the same reason; a reset makes the instance new."""
    wasm = host.instantiate("co-simulation")
    with pytest.raises(Refused) as refused:
        wasm.initialise(mach0=6.0, altitude0=42000.0)
    with package.instance() as native, pytest.raises(NativeRefused) as natively:
        native.initialise(mach0=6.0, altitude0=42000.0)
    assert refused.value.status == "error"
    assert reason(refused.value.text) == reason(natively.value.text)
    wasm.call("reset")
    wasm.initialise()
    with package.flight() as native:
        same_steps(native, wasm, range(10))


BAD_CALLS = {
    "not a number": ("set-float64", ([0], [float("nan")]), "delta_e = NaN is refused"),
    "an enumeration without this item": ("set-int64", (["aero"], [4]), "aero = 4"),
    "beyond 32 bits": ("set-int64", (["aero"], [2**32 + 1]), "aero = 4294967297"),
    "no such variable": ("get-float64", ([9999],), "9999 is unknown"),
    "another type": ("get-boolean", ([0],), "delta_e .* is no Boolean"),
    "a type that no variable has": ("get-string", ([0],), "delta_e .* is no String, it is a Float64"),
    "too few values": ("set-float64", ([0, 1], [0.0]), "nValues = 1 is refused: .* 2 values are needed"),
    "too few changes": ("get-directional-derivative", ([2], [0], []), "nSeed = 0 is refused"),
    "time that is set": ("set-float64", ([TIME], [1.0]), f"{TIME} is unknown"),
    "out of order": ("exit-initialization-mode", (), "not allowed in state"),
    "a step back": ("do-step", (-1.0, 0.1, True), "currentCommunicationPoint = -1 s"),
    "no step": ("do-step", (0.0, 0.0, True), "communicationStepSize = 0 is refused"),
    "an unknown category": ("set-debug-logging", (True, ["x"]), 'category "x" is unknown'),
    "bytes": ("set-fmu-state", (b"123",), "these 3 bytes are no FMU state"),
    "structural parameters": ("enter-configuration-mode", (), "not allowed in state"),
    "a function of the other interface": ("enter-event-mode", (), "not allowed in state"),
    "dependencies": ("get-variable-dependencies", (0,), "dependencies of single elements"),
    "a clock": ("get-interval-decimal", ([0],), "not allowed in state"),
}


@pytest.mark.parametrize("bad", BAD_CALLS)
def test_verif_bad_calls_are_refused_with_a_reason(package: Package, host: Host, bad: str) -> None:
    """Nothing traps, nothing changes, another instance is not disturbed."""
    name, arguments, text = BAD_CALLS[bad]
    arguments = [
        package.references(*x) if isinstance(x, list) and x and isinstance(x[0], str) and x != ["x"]
        else x
        for x in arguments
    ]
    wasm, other = host.flight(), host.flight()
    before = wasm.call("get-fmu-state")
    with pytest.raises(Refused, match=text) as refused:
        wasm.call(name, *arguments)
    assert refused.value.status in ("discard", "error") and len(host.log) == 1
    # The first byte after identity and header is the state of the instance: an error may end the run.
    after = wasm.call("get-fmu-state")
    assert after[PHASE + 1 : -CHECKSUM] == before[PHASE + 1 : -CHECKSUM]
    with package.flight() as native:
        same_steps(native, other, range(5))


def test_verif_no_instance_without_name_or_with_another_token(host: Host) -> None:
    """Nor for a mode that the FMU does not have; the host is told why."""
    for arguments, text in (
        (("co-simulation", "", None), "name"),
        (("co-simulation", "ahv", "{0}"), "instantiationToken"),
        (("model-exchange", "ahv", "{0}"), "instantiationToken"),
        (("co-simulation", "ahv", None, True, False, []), "hasEventMode"),
    ):
        assert host.instantiate(*arguments) is None
        assert text in host.log[-1].text and host.log[-1].status == "error"


def test_verif_instances_are_freed(host: Host) -> None:
    """Memory of the component does not grow with the number of instances that were."""
    for _ in range(3):
        host.flight().close()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(500):
        host.flight().close()
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < 500 * LEAST_INSTANCE_KB / 2, "kB"


def test_verif_messages_are_read_by_no_printf(host: Host) -> None:
    """A name or a category with a per cent sign arrives as it is."""
    wasm = host.instantiate("co-simulation", "100 %d")
    with pytest.raises(Refused, match='category "50 %s" is unknown'):
        wasm.call("set-debug-logging", True, ["50 %s"])
    assert host.log[-1].instance == "100 %d"
