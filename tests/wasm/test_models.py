"""The component of every model: what it needs of its host, and the bits of its library."""

from __future__ import annotations

import numpy as np

from flying import moved
from harness import MEASURED
from host import PACKAGE, Host

STEPS = 100


def test_verif_the_component_has_the_interfaces_of_the_draft_and_needs_callbacks_alone(
    each: Host,
) -> None:
    """No clock, no file, no random number: a host has to provide the callbacks and nothing else."""
    assert set(each.imports) == {PACKAGE.format(name) for name in ("types", "callbacks")}
    names = ("common", "co-simulation", "model-exchange")
    assert set(each.exports) == {PACKAGE.format(name) for name in names}
    assert each.run("common", "get-version") == "3.0"


def test_verif_every_model_computes_the_bits_of_its_library(each: Host) -> None:
    """Uneven steps with random inputs; every real variable, and an output has moved."""
    variables = each.package.variables.values()
    inputs = [variable.name for variable in variables if variable.causality == "input"]
    random = np.random.default_rng(20150181)
    rows = []
    with each.package.flight() as native:
        wasm = each.flight()
        for length in random.uniform(0.002, 0.03, STEPS):
            moves = random.uniform(-1e-3, 1e-3, len(inputs))
            values = {n: MEASURED.get(n, 0.0) + x for n, x in zip(inputs, moves, strict=True)}
            for flight in (native, wasm):
                flight.set(**values)
                flight.step(float(length))
            rows.append(native.bits())
            assert rows[-1] == wasm.bits()
    assert moved(rows) > len(inputs)


def test_verif_every_model_starts_without_the_folder_that_it_is_told(each: Host) -> None:
    """A component reads no files: it has the data of its package, and computes the same."""
    here, nowhere = each.flight(), each.instantiate("co-simulation", resources="/nowhere")
    assert nowhere, each.log
    nowhere.initialise()
    assert nowhere.bits() == here.bits()
