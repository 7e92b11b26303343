"""The InitialUnknowns of ModelStructure: complete, and true for the binary."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from contract import FACTORS, OFFSETS
from harness import INPUTS, Package

# Starting points of the parameters: each parameter has an effect in one of these.
UNTRIMMED = {"trim": False, "alpha0": 0.02, "q0": 0.03, "eta10": 0.05, "phi": 0.3}
BASES = [
    {"configuration": 3},
    {"configuration": 2, **UNTRIMMED},
    # The set in which fuel changes the lift, and masses that move relative to their tanks.
    {"configuration": 3, "aero": 3, **UNTRIMMED},
    # With fuel flow.
    {"configuration": 3, "fuel_burn": True},
    # A start at which damped states move.
    {"configuration": 3, "eta1_dot_offset": 0.1, "slosh1_dot_offset": 0.1},
]
# Another value for each parameter and input.
MOVED = {
    **{"configuration": 1, "aero": 2, "fuel_fraction": 0.6, "slosh_damping": 0.1},
    **{"slosh_frequency": 12.0, "mach0": 7.5, "altitude0": 25000.0, "gamma0": 0.01},
    **{"trim": False, "input_mode": 2, "alpha0": 0.03, "q0": 0.05},
    **{"eta10": 0.04, "eta20": 0.03, "eta30": 0.02, "delta_e": 0.05, "phi": 0.2},
    **{"w_gust": 4.0, "u_gust": 4.0, "fuel_burn": True},
    **{"imu_station": 9.0, "probe_station": 1.0},
    **{f"{name}_factor": 1.1 for name in (*FACTORS, "pitch_rate")},
    "mass_centre_shift": 0.1,
    **{f"{name}_offset": 0.01 for name in OFFSETS},
}


def initial(package: Package, given: dict[str, Any]) -> np.ndarray:
    """All initial unknowns, in initialization mode."""
    names = [unknown.variable.name for unknown in package.description.initialUnknowns]
    with package.instance() as instance:
        instance.set(**given)
        instance.setup()
        return instance.get(*names)


def test_verif_initial_unknowns_are_all_that_is_computed(package: Package) -> None:
    """Each output, calculated parameter, state and derivative, once, in ascending order."""
    description = package.description
    states = {unknown.variable.derivative.name for unknown in description.derivatives}
    rates = {unknown.variable.name for unknown in description.derivatives}
    expected = [
        variable.name
        for variable in description.modelVariables
        if variable.initial in ("calculated", "approx")
        and (
            variable.causality in ("output", "calculatedParameter")
            or variable.name in states | rates
        )
    ]
    assert [unknown.variable.name for unknown in description.initialUnknowns] == expected


@pytest.mark.parametrize("known", MOVED)
def test_verif_initial_unknowns_claim_what_moves_them(package: Package, known: str) -> None:
    """What moves with a parameter or input says so, and what claims an input moves with it."""
    moved = False
    for base in BASES:
        moved = moved | (initial(package, base) != initial(package, base | {known: MOVED[known]}))
    assert moved.any()
    for unknown, moves in zip(package.description.initialUnknowns, moved, strict=True):
        claimed = known in {variable.name for variable in unknown.dependencies}
        exact = known in INPUTS
        assert claimed == moves if exact else claimed or not moves, unknown.variable.name


def test_verif_every_parameter_and_input_is_moved(package: Package) -> None:
    """The test above knows all of them."""
    settable = {
        name for name, v in package.variables.items() if v.causality in ("parameter", "input")
    }
    assert set(MOVED) == settable
