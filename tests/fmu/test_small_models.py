"""The example models of crates/fmi as FMUs: one with every capability, one with none."""

from __future__ import annotations

import json
import shutil
import subprocess
from ctypes import byref, c_void_p
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract, simulate_fmu
from fmpy.fmi2 import (
    FMU2Model,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2Integer,
    fmi2Real,
    fmi2ValueReference,
)
from fmpy.validation import validate_fmu

from harness import ERROR, OK, REPOSITORY, Instance, Package

# Rate, initial value and input of dahlquist.
K, X0, U = 3.0, 2.0, 0.5
START = {"k": K, "x0": X0, "u": U}
STOP, STEP = 2.0, 0.125


def written(model: str, folder: Path) -> Package:
    """The FMU that the model's program writes, in `folder`: others may run it meanwhile."""
    build = ["cargo", "build", "--package", model, "--message-format", "json", "--quiet"]
    lines = subprocess.run(build, cwd=REPOSITORY, capture_output=True, text=True, check=True).stdout
    messages = [json.loads(line) for line in lines.splitlines()]
    own = [m for m in messages if m.get("target", {}).get("name") == model]
    built = [Path(file) for message in own for file in message["filenames"]]
    # The program and, beside it, the library; not what other crates are compiled with.
    for file in (file for file in built if file.suffix not in (".rlib", ".rmeta")):
        shutil.copy2(file, folder)
    program = next(Path(m["executable"]) for m in own if m.get("executable"))
    command = [folder / program.name]
    answer = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    path = folder / f"{model}.fmu"
    assert answer.split("\n") == [str(path), str(folder / f"{model}_fmi3.fmu"), ""]
    (folder / "unpacked").mkdir()
    extract(str(path), unzipdir=str(folder / "unpacked"))
    return Package(path, folder / "unpacked")


@pytest.fixture(scope="module")
def dahlquist(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """x' = k (u - x)."""
    return written("dahlquist", tmp_path_factory.mktemp("dahlquist"))


@pytest.fixture(scope="module")
def idle(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """Steps that do nothing."""
    return written("idle", tmp_path_factory.mktemp("idle"))


@pytest.mark.parametrize("model", ["dahlquist", "idle"])
def test_verif_fmpy_finds_no_problem_in_a_small_model(
    model: str, request: pytest.FixtureRequest
) -> None:
    """Schema, names, units, required start values, causality and model structure are valid."""
    path = request.getfixturevalue(model).path
    assert validate_fmu(str(path)) == []
    assert validate_fmu(str(path.with_name(f"{model}_fmi3.fmu"))) == []


@pytest.mark.parametrize(
    ("interface", "error"),
    # Steps are exact but for rounding; CVode asks for ten digits and keeps most of them.
    [("CoSimulation", 1e-14), ("ModelExchange", 1e-8)],
)
def test_verif_dahlquist_decays_as_its_closed_form(
    dahlquist: Package, interface: str, error: float
) -> None:
    """x = u + (x0 - u) exp(-k t)."""
    result = simulate_fmu(
        str(dahlquist.path),
        fmi_type=interface,
        stop_time=STOP,
        output_interval=STEP,
        relative_tolerance=1e-10,
        start_values=START,
        output=["x"],
    )
    time = result["time"]
    assert len(time) == 1 + round(STOP / STEP)
    exact = U + (X0 - U) * np.exp(-K * time)
    np.testing.assert_allclose(result["x"], exact, rtol=0, atol=error * X0)


def test_verif_dahlquist_has_the_derivatives_and_states_that_it_promises(
    dahlquist: Package,
) -> None:
    """Directional derivatives by state and input; a kept state goes on with the same bits."""
    slave = dahlquist.description.coSimulation
    assert slave.providesDirectionalDerivative and slave.canSerializeFMUstate
    rate, state, control = dahlquist.references("der(x)", "x", "u")
    with Instance(dahlquist) as instance:
        instance.initialise(**START)
        assert instance.fmu.getDirectionalDerivative([rate], [state], [1.0]) == [-K]
        assert instance.fmu.getDirectionalDerivative([rate], [control], [1.0]) == [K]
        kept = instance.fmu.getFMUstate()
        kept_bytes = instance.fmu.serializeFMUstate(kept)
        instance.call("fmi2DoStep", 0.0, STEP, 0)
        first = instance.fmu.getReal([state])
        with Instance(dahlquist) as other:
            restored = other.fmu.deSerializeFMUstate(kept_bytes)
            other.fmu.setFMUstate(restored)
            other.call("fmi2DoStep", 0.0, STEP, 0)
            assert other.fmu.getReal([state]) == first
            other.fmu.freeFMUstate(restored)
        instance.fmu.freeFMUstate(kept)


def test_verif_idle_promises_nothing_and_stays_at_rest(idle: Package) -> None:
    """Co-simulation only, without any capability that is left to the model."""
    assert idle.description.modelExchange is None
    slave = idle.description.coSimulation
    assert not slave.canGetAndSetFMUstate and not slave.canSerializeFMUstate
    assert not slave.providesDirectionalDerivative and not slave.canInterpolateInputs
    assert slave.maxOutputDerivativeOrder == 0
    result = simulate_fmu(str(idle.path), stop_time=STOP, output_interval=STEP)
    assert len(result) == 1 + round(STOP / STEP)
    assert all((result[f"y{number}"] == 0).all() for number in range(1, 6))


def test_verif_idle_is_not_instantiated_for_model_exchange(idle: Package) -> None:
    """NULL, and a message that says why."""
    heard: list[str] = []
    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(lambda *message: heard.append(message[-1].decode()))
    model = FMU2Model(
        guid=idle.description.guid,
        unzipDirectory=str(idle.folder),
        modelIdentifier="idle",
        instanceName="one",
    )
    with pytest.raises(Exception, match="Failed to instantiate"):
        model.instantiate(callbacks=callbacks)
    assert len(heard) == 1
    assert "fmi2Instantiate" in heard[0] and "Model Exchange" in heard[0]
    model.freeLibrary()


def test_verif_idle_refuses_what_it_does_not_promise_by_name(idle: Package) -> None:
    """fmi2Error and what the description lacks; the instance goes on."""
    known, unknown = idle.references("u1", "y1")
    one, value = fmi2Real(1.0), fmi2Real(7.0)
    known, unknown = fmi2ValueReference(known), fmi2ValueReference(unknown)
    order, state = fmi2Integer(1), c_void_p()
    seeds = (byref(unknown), 1, byref(known), 1, byref(one), byref(value))
    refused = {
        "fmi2GetFMUstate": ((byref(state),), "that its state can be saved"),
        "fmi2GetDirectionalDerivative": (seeds, "directional derivatives"),
        "fmi2SetRealInputDerivatives": (
            (byref(known), 1, byref(order), byref(one)),
            "inputs that move within a step",
        ),
    }
    with Instance(idle) as instance:
        instance.initialise()
        for function, (arguments, capability) in refused.items():
            assert instance.status(function, *arguments) == ERROR
            assert f"does not promise {capability}" in instance.log[-1].text
        assert len(instance.log) == len(refused)
        assert state.value is None and value.value == 7.0
        assert instance.status("fmi2DoStep", 0.0, STEP, 0) == OK
