"""The uncertain vehicle: factors and shifts change the FMU as they change the oracle."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from contract import FACTORS
from harness import (
    ALL_STATES,
    CONFIGURATIONS,
    DERIVATIVES,
    EVEN_MASS_BEAM,
    INPUTS,
    OUTPUTS,
    RIGID,
    SLOSH_BEAM,
    STATES,
    Package,
)
from oracle import Vehicle
from test_dependencies import jacobian as slopes
from test_linear import jacobian
from test_run import STEP, STEPS, assert_equal_flights, columns, doublet
from test_trim import OMEGA, OMEGA_EQUAL, TRIM, TRIM_EQUAL

# Relative to the largest entry in a row, with columns scaled by typical changes: two solutions of
# the modes, and rounding of the trim.
LINEAR_EQUAL = 1e-9
FLIGHT_EQUAL = 1e-7  # as in test_run.py, at the default tolerance
# Far enough from 1 to have an effect, near enough for a trim.
EACH: list[dict[str, Any]] = [
    *({f"{name}_factor": value} for name in FACTORS for value in (0.94, 1.07)),
    *({"pitch_rate_factor": value} for value in (0.0, 0.5, 1.0)),
    *({"mass_centre_shift": value} for value in (-0.2, 0.2)),
    {"stiffness_factor": 50.0},
]
ALL_AT_ONCE = {
    **{f"{name}_factor": 1.0 + 0.01 * (-1) ** k * (k + 1) / 4 for k, name in enumerate(FACTORS)},
    **{"pitch_rate_factor": 1.0, "mass_centre_shift": 0.1},
}
OTHERS: list[dict[str, Any]] = [
    *({"configuration": k, **ALL_AT_ONCE} for k in CONFIGURATIONS),
    *({"aero": name, **ALL_AT_ONCE} for name in ("parker2007", "shock_expansion")),
    {"fuel_fraction": 0.4, **ALL_AT_ONCE},
]
ROWS, COLUMNS = (*DERIVATIVES, *OUTPUTS), (*STATES, *INPUTS)
# Typical changes of the inputs.
USUAL = {"delta_e": 0.1, "phi": 0.1, "w_gust": 10.0, "u_gust": 10.0}


def name_of(parameters: dict[str, Any]) -> str:
    """Name of a test case."""
    return "all" if len(parameters) > 1 else ",".join(f"{k}={v}" for k, v in parameters.items())


@pytest.mark.parametrize("parameters", [*EACH, *OTHERS], ids=name_of)
def test_verif_an_uncertain_vehicle_is_the_oracles(
    package: Package, vehicle: Callable[..., Vehicle], parameters: dict[str, Any]
) -> None:
    """Trim, frequencies, mass centre, inertia and the linear model, gusts among its inputs."""
    oracle = vehicle(**parameters)
    state, control = oracle.trim()
    omega = np.zeros(len(OMEGA))
    omega[: oracle.modes_count] = oracle.omega
    expected = np.zeros(len(STATES))
    expected[: oracle.states] = state
    x = np.zeros(len(ALL_STATES))
    x[: oracle.states] = state
    u = np.append(control, [0.0, 0.0])
    places = [(*ALL_STATES, *INPUTS).index(name) for name in COLUMNS]
    theirs = np.column_stack([slopes(oracle, list(ROWS), x, u, place) for place in places])
    size = [float(package.variables[name].nominal) for name in STATES]
    size = np.append(size, [USUAL[name] for name in INPUTS])
    with package.flight(**parameters) as flight:
        found = flight.get(*TRIM)
        np.testing.assert_allclose(found, [state[3], *control], rtol=TRIM_EQUAL, atol=0.0)
        np.testing.assert_allclose(flight.get(*STATES), expected, rtol=TRIM_EQUAL, atol=1e-13)
        np.testing.assert_allclose(flight.get(*OMEGA), omega, rtol=OMEGA_EQUAL, atol=0.0)
        body = flight.get("mass_centre", "pitch_inertia")
        np.testing.assert_allclose(body, [oracle.x_cg, oracle.i_yy], rtol=1e-12)
        ours = jacobian(flight, ROWS, COLUMNS)
    scale = np.abs(theirs * size).max(axis=1)
    error = (np.abs(ours - theirs) * size).max(axis=1)
    for name, wrong, largest in zip(ROWS, error, scale, strict=True):
        assert wrong <= LINEAR_EQUAL * largest, f"{name}: {wrong / largest:.2e}"


@pytest.mark.parametrize("parameters", EACH, ids=name_of)
def test_every_factor_is_felt(package: Package, parameters: dict[str, Any]) -> None:
    """The linear model of the changed vehicle is another one, unless the value is the default."""
    (known,) = parameters
    default = parameters[known] == float(package.variables[known].start)
    with package.flight() as plain, package.flight(**parameters) as changed:
        same = np.array_equal(
            jacobian(plain, DERIVATIVES, COLUMNS), jacobian(changed, DERIVATIVES, COLUMNS)
        )
    assert same == default


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_an_uncertain_flight_is_the_oracles(
    package: Package, vehicle: Callable[..., Vehicle], configuration: int
) -> None:
    """All factors at once, a doublet, all states and outputs."""
    given = {"configuration": configuration, **ALL_AT_ONCE}
    oracle = vehicle(**given)
    _, states, outputs = oracle.simulate(STEPS * STEP, STEP, doublet)
    with package.flight(**given) as flight:
        ours = flight.fly(STEPS, STEP, doublet, (*STATES, *OUTPUTS))
    assert_equal_flights(ours, columns(oracle, states, outputs), FLIGHT_EQUAL)


def test_verif_what_factors_are_for_a_rigid_vehicle(package: Package) -> None:
    """Known ratios, without an oracle: density scales the loads, inertia the answer in pitch."""

    def start(**factors: float) -> dict[str, float]:
        names = ("qbar", "lift", "thrust", "der(q)", "mass_centre", "pitch_inertia")
        given = {"trim": False, "alpha0": 0.02, "delta_e": 0.1, "phi": 0.3}
        with package.flight(configuration=RIGID, **given, **factors) as flight:
            return dict(zip(names, flight.get(*names), strict=True))

    plain = start()
    thin, heavy = start(density_factor=0.8), start(inertia_factor=2.0)
    for name in ("qbar", "lift", "thrust", "der(q)"):
        assert thin[name] == pytest.approx(0.8 * plain[name], rel=1e-12), name
    assert heavy["der(q)"] == pytest.approx(plain["der(q)"] / 2.0, rel=1e-12)
    assert heavy["pitch_inertia"] == pytest.approx(2.0 * plain["pitch_inertia"], rel=1e-12)
    shifted = start(mass_centre_shift=-0.3)
    assert shifted["mass_centre"] == pytest.approx(plain["mass_centre"] - 0.3, rel=1e-12)
    assert shifted["lift"] == plain["lift"]


@pytest.mark.parametrize("configuration", [EVEN_MASS_BEAM, SLOSH_BEAM])
def test_a_stiffer_beam_bends_less(package: Package, configuration: int) -> None:
    """Frequencies rise; without sloshing masses by the root of the factor."""
    names = OMEGA[:3]
    with package.flight(configuration=configuration) as flight:
        soft = flight.get(*names)
    with package.flight(configuration=configuration, stiffness_factor=4.0) as flight:
        stiff = flight.get(*names)
    if configuration == EVEN_MASS_BEAM:
        np.testing.assert_allclose(stiff, 2.0 * soft, rtol=1e-9)
    assert (stiff > soft).all()
