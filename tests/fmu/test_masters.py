"""Masters that share no code with FMPy fly the FMU as FMPy does.

Neither libcosim nor Ecos reads enumerations, so they fly the default configuration.
"""

from __future__ import annotations

import subprocess
import sysconfig
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from harness import CONTROLS, OUTPUTS, STATES, Package

NAMES = (*STATES, *OUTPUTS, "delta_e_effective", "phi_effective")
STEP_NS, STEPS = 10_000_000, 100
STEP = STEP_NS * 1e-9
# libcosim counts in nanoseconds and FMPy's harness adds up: communication points differ by
# rounding, which the short period amplifies by e^(5 t). Relative to each variable's excursion.
SAME_FLIGHT = 1e-9
# Level flight disturbed by the elevator, with the defaults and with other start values.
STARTS = [{}, {"fuel_fraction": 0.5, "mach0": 7.5, "altitude0": 24000.0, "gamma0": 0.01}]

Flight = Callable[[Package, dict[str, float]], np.ndarray]


def doublet(step: int) -> tuple[float, float]:
    """Elevator up and down, 0.2 s each; a little fuel in between."""
    delta = 0.005 if 10 <= step < 30 else -0.005 if 30 <= step < 50 else 0.0
    return delta, 0.02 if 20 <= step < 40 else 0.0


def references(package: Package, names: tuple[str, ...]) -> list[int]:
    """Value references of these variables."""
    return [package.variables[name].valueReference for name in names]


def libcosim(package: Package, start: dict[str, float]) -> np.ndarray:
    """Values of NAMES after each step, in DNV's libcosim."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    execution = CosimExecution.from_step_size(STEP_NS)
    slave = CosimLocalSlave(str(package.path), "ahv")
    index = execution.add_local_slave(slave)
    manipulator, observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
    assert execution.add_manipulator(manipulator) and execution.add_observer(observer)
    for name, value in start.items():
        (reference,) = references(package, (name,))
        assert execution.real_initial_value(index, reference, value), name
    rows = []
    for k in range(STEPS):
        assert manipulator.slave_real_values(index, references(package, CONTROLS), doublet(k))
        assert execution.step()
        rows.append(observer.last_real_values(index, references(package, NAMES)))
    assert execution.status().current_time == STEPS * STEP_NS
    return np.array(rows)


def ecos(package: Package, start: dict[str, float]) -> np.ndarray:
    """Values of NAMES after each step, in Ecos."""
    from ecospy import EcosSimulation, EcosSimulationStructure

    with EcosSimulationStructure() as structure:
        structure.add_model("ahv", package.path)
        given = {f"ahv::{name}": value for name, value in start.items()}
        assert structure.add_parameter_set("start", given)
        simulation = EcosSimulation(STEP, structure=structure)
    assert simulation.init(parameter_set="start")
    rows = []
    for k in range(STEPS):
        for name, value in zip(CONTROLS, doublet(k), strict=True):
            simulation.set_real(f"ahv::{name}", value)
        simulation.step()
        rows.append([simulation.get_real(f"ahv::{name}") for name in NAMES])
    simulation.terminate()
    return np.array(rows)


@pytest.mark.parametrize("start", STARTS, ids=["default", "other"])
@pytest.mark.parametrize("master", [libcosim, ecos], ids=lambda master: master.__name__)
def test_verif_masters_fly_alike(package: Package, master: Flight, start: dict[str, float]) -> None:
    """Every state and output at every communication point is the one that FMPy gets."""
    with package.flight(**start) as flight:
        theirs = flight.fly(STEPS, STEP, doublet, NAMES)
    ours = master(package, start)
    excursion = np.abs(theirs - theirs[0]).max(axis=0)
    assert (excursion > 0.0).all()
    error = np.abs(ours - theirs[1:]).max(axis=0) / excursion
    for name, wrong in zip(NAMES, error, strict=True):
        assert wrong <= SAME_FLIGHT, f"{name}: {wrong:.2e}"


def test_verif_fmutool_finds_nothing(package: Package) -> None:
    """`fmutool -check` says that the FMU is sound, and gives no warning."""
    tool = Path(sysconfig.get_path("scripts")) / "fmutool"
    command = [str(tool), "-input", str(package.path), "-check"]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    lines = (run.stdout + run.stderr).splitlines()
    assert any("seems to be compliant with FMI-2.0" in line for line in lines), lines
    assert any("No semantic error" in line for line in lines), lines
    assert all(line.startswith("INFO") for line in lines), lines
