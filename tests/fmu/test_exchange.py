"""Model exchange in FMPy: its CVODE drives the vehicle, and arrives where co-simulation does."""

from __future__ import annotations

import numpy as np
import pytest
from fmpy import simulate_fmu

from harness import CONFIGURATIONS, Package

STOP, STEP = 0.5, 0.01
TOLERANCE = 1e-8
# Over the excursion: CVODE holds its tolerance per step, and the open loop amplifies by e^2.
AGREEMENT = 2e-5
# Of a value: how many steps' tolerance may add up.
STEPS = 10


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
