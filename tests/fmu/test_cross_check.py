"""The reference set in the FMU is what another master computes with it."""

from __future__ import annotations

import io
import itertools
import zipfile

import numpy as np
import pytest
from fmpy import simulate_fmu

from harness import Package

FOLDER = "documentation/cross-check"
# Relative to the largest value in a column. A master's clock may differ in its last bit, which the
# unstable short period amplifies a thousand times in 2 s; the inputs are the same.
TOLERANCE = 1e-9


@pytest.fixture
def files(package: Package) -> dict[str, str]:
    """The set as text, by the end of its files' names."""
    with zipfile.ZipFile(package.path) as archive:
        return {
            part: archive.read(f"{FOLDER}/ahv_{part}").decode()
            for part in ("in.csv", "ref.csv", "ref.opt")
        }


def test_verif_fmpy_flies_the_reference_set(package: Package, files: dict[str, str]) -> None:
    """Inputs and options of the set give its outputs, all of them, over the whole flight."""
    inputs, reference = (
        np.genfromtxt(io.StringIO(files[part]), delimiter=",", names=True)
        for part in ("in.csv", "ref.csv")
    )
    lines = (line.split(",") for line in files["ref.opt"].splitlines())
    options = {name: float(value) for name, value in lines}
    assert set(options) == {"StartTime", "StopTime", "StepSize", "RelTol"}
    outputs = [v.name for v in package.description.modelVariables if v.causality == "output"]
    assert reference.dtype.names == ("time", *outputs)
    result = simulate_fmu(
        str(package.path),
        start_time=options["StartTime"],
        stop_time=options["StopTime"],
        step_size=options["StepSize"],
        output_interval=options["StepSize"],
        relative_tolerance=options["RelTol"],
        input=inputs,
        output=outputs,
    )
    assert len(result) == len(reference) == round(options["StopTime"] / options["StepSize"]) + 1
    for name in outputs:
        scale = np.abs(reference[name]).max()
        assert np.abs(result[name] - reference[name]).max() <= TOLERANCE * scale, name
    moved = np.ptp(inputs["delta_e"])
    assert np.ptp(reference["delta_e_effective"]) == pytest.approx(moved, rel=1e-12) != 0.0


def test_verif_fmpy_s_calls_give_the_bits_of_the_reference_set(
    package: Package, files: dict[str, str]
) -> None:
    """Every output at every step, if the clock of the master is that of the set."""
    inputs, reference = (
        np.genfromtxt(io.StringIO(files[part]), delimiter=",", names=True)
        for part in ("in.csv", "ref.csv")
    )
    times, outputs = reference["time"], reference.dtype.names[1:]
    # Where an input jumps, the later row holds.
    held = np.searchsorted(inputs["time"], times, side="right") - 1
    with package.flight() as flight:
        for k, (start, end) in enumerate(itertools.pairwise(times)):
            flight.set(delta_e=float(inputs["delta_e"][held[k]]), phi=0.0)
            flight.fmu.doStep(start, end - start)
            assert flight.get(*outputs).tolist() == list(reference[k + 1])[1:], end
