"""Model exchange in FMPy: its CVODE drives the vehicle, and arrives where co-simulation does."""

from __future__ import annotations

import numpy as np
import pytest
from fmpy import simulate_fmu

from harness import AERO_SETS, CONFIGURATIONS, Package

STOP, STEP = 0.5, 0.01
TOLERANCE = 1e-8
# Relative to the excursion: CVODE controls the error per step; the open loop amplifies it by e^2.
AGREEMENT = 2e-5
# Relative to a value: number of steps whose tolerances may add up.
STEPS = 10
# Until then every vehicle is inside the envelope with the elevator off its trim by this, rad.
EULER_STOP, ELEVATOR = 1.5, 5e-4
# Share of the excursion, mostly in the third mode, which rings initially; and rounding in trim, m
# and rad.
EULER_ERROR, EULER_ROUNDING = 0.1, 1e-13


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_cvode_and_co_simulation_agree(package: Package, configuration: int) -> None:
    """The elevator is held, as FMPy holds inputs in one interface and interpolates in the other."""
    outside, inside = (
        simulate_fmu(
            str(package.path),
            fmi_type=kind,
            stop_time=STOP,
            output_interval=STEP,
            relative_tolerance=TOLERANCE,
            start_values={"configuration": configuration, "delta_e": 0.003},
            output=["V", "gamma", "alpha", "q", "eta1", "slosh1", "lift"],
        )
        for kind in ("ModelExchange", "CoSimulation")
    )
    assert len(outside) == len(inside) == round(STOP / STEP) + 1
    for name in outside.dtype.names[1:]:
        error = np.abs(outside[name] - inside[name]).max()
        size = np.abs(inside[name]).max()
        assert error <= AGREEMENT * np.ptp(inside[name]) + STEPS * TOLERANCE * size, name
    assert np.ptp(inside["q"]) > 0.01, "the elevator moves the vehicle"


@pytest.mark.parametrize("aero", range(1, 1 + len(AERO_SETS)))
@pytest.mark.parametrize("configuration", CONFIGURATIONS)
@pytest.mark.parametrize("elevator", [0.0, ELEVATOR])
def test_verif_explicit_euler_holds_at_the_default_step(
    package: Package, configuration: int, aero: int, elevator: float
) -> None:
    """The simplest master, at the step that the FMU advertises."""
    experiment = package.description.defaultExperiment
    step = float(experiment.stepSize)
    euler, exact = (
        simulate_fmu(
            str(package.folder),
            fmi_type=kind,
            solver="Euler",
            step_size=step,
            output_interval=step,
            stop_time=EULER_STOP,
            start_values={"configuration": configuration, "aero": aero, "delta_e": elevator},
            output=["alpha", "q", "eta1", "eta2", "eta3", "slosh1", "slosh2"],
        )
        for kind in ("ModelExchange", "CoSimulation")
    )
    assert len(euler) == len(exact) == round(EULER_STOP / step) + 1
    for name in euler.dtype.names[1:]:
        excursion = np.ptp(exact[name])
        error = np.abs(euler[name] - exact[name]).max()
        assert error <= EULER_ERROR * excursion + EULER_ROUNDING, (name, error, excursion)
