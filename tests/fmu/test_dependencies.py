"""The dependencies in ModelStructure are complete and none is superfluous.

By perturbation of the FMU: the inputs, and the states that a start parameter sets (V, h, gamma,
alpha, q, eta1 to eta3, with trim = false). The rates and the slosh states cannot be set from
outside in co-simulation. For these, and again for all others, the claims are compared with the
sparsity of the oracle's equations, which test_run.py proves equal to the FMU's at every state.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from harness import (
    AERO_SETS,
    ALL_DERIVATIVES,
    ALL_STATES,
    CONFIGURATIONS,
    EVEN_MASS_BEAM,
    INPUTS,
    OUTPUTS,
    RIGID,
    SLOSH_BEAM,
    Package,
)
from oracle import Vehicle
from oracle_aero import TINY
from oracle_burn import Burning

KNOWNS = (*ALL_STATES, *INPUTS)
# Between 18 and 20 km the temperature is constant: altitude affects only density and gravity, and
# the speed of a given Mach number is exactly constant.
BASE = {
    **{"trim": False, "altitude0": 19000.0, "mach0": 8.0, "gamma0": 0.01, "alpha0": 0.02},
    **{"q0": 0.03, "eta10": 0.05, "eta20": -0.02, "eta30": 0.01, "delta_e": 0.1, "phi": 0.3},
    # In still air the loads would not depend on the flight-path angle, and by eq. (4) as printed
    # not on the pitch rate.
    **{"w_gust": 5.0, "u_gust": 2.0, "fuel_burn": True, "pitch_rate_factor": 1.0},
}
# Start values, the state or input that each changes, and its change.
MOVES = {
    **{"V": ("mach0", 0.5), "h": ("altitude0", 100.0), "gamma": ("gamma0", 0.02)},
    **{"alpha": ("alpha0", 0.03), "q": ("q0", 0.05)},
    **{"eta1": ("eta10", 0.04), "eta2": ("eta20", 0.03), "eta3": ("eta30", 0.02)},
    **{"delta_e": ("delta_e", 0.05), "phi": ("phi", 0.2), "w_gust": ("w_gust", 3.0)},
    "u_gust": ("u_gust", 3.0),
}
# Initial speed, altitude and path angle also determine the weight on the tank floors: with
# sloshing masses they change parameters of the model, not only the state.
ALSO_PARAMETERS = ("V", "h", "gamma")
# Dependent only through the speed of sound, which is constant with the temperature.
BY_TEMPERATURE = (("mach", "h"), ("choking_margin", "h"))
LINEAR = 1e-9  # rounding of a difference quotient, relative


def unknowns(package: Package) -> dict[str, dict[str, str]]:
    """For each output and rate: what it is said to depend on, and how."""
    description = package.description
    return {
        unknown.variable.name: {
            known.name: kind
            for known, kind in zip(unknown.dependencies, unknown.dependenciesKind, strict=True)
        }
        for unknown in (*description.outputs, *description.derivatives)
    }


@pytest.fixture(scope="module")
def claims(package: Package) -> dict[str, dict[str, str]]:
    """The dependencies in the model description."""
    return unknowns(package)


@pytest.fixture(scope="module")
def start(package: Package, claims: dict) -> Callable[..., np.ndarray]:
    """Outputs and rates at the start of a flight without trim."""
    names = tuple(claims)
    known: dict = {}

    def values(configuration: int, **changes: Any) -> np.ndarray:
        key = (configuration, *changes.items())
        if key not in known:
            given = BASE | changes
            if configuration == SLOSH_BEAM:
                given["slosh_frequency"] = 20.0
            with package.flight(configuration=configuration, **given) as flight:
                known[key] = flight.get(*names)
        return known[key]

    return values


@pytest.mark.parametrize("known", MOVES)
def test_verif_claimed_dependencies_are_all_dependencies(
    claims: dict, start: Callable[..., np.ndarray], known: str
) -> None:
    """Perturbed in the FMU: what is claimed moves, what is not claimed keeps its bits."""
    parameter, size = MOVES[known]
    moved = np.zeros(len(claims), dtype=bool)
    for configuration in CONFIGURATIONS:
        if configuration == SLOSH_BEAM and known in ALSO_PARAMETERS:
            continue
        for aero in AERO_SETS:
            base = start(configuration, aero=aero)
            for part in (1.0, -0.6):
                moved_to = {parameter: BASE[parameter] + part * size}
                moved |= start(configuration, aero=aero, **moved_to) != base
    for name, changed in zip(claims, moved, strict=True):
        beyond = known in ALSO_PARAMETERS and "slosh" in name
        if not beyond and (name, known) not in BY_TEMPERATURE:
            assert changed == (known in claims[name]), f"{name} of {known}"


def test_verif_mach_number_depends_on_the_altitude(
    claims: dict, start: Callable[..., np.ndarray]
) -> None:
    """Where the temperature changes, another altitude means another speed for the same number."""
    still = {"w_gust": 0.0, "u_gust": 0.0}
    low, high = start(RIGID, **still), start(RIGID, altitude0=25900.0, **still)
    speed, mach = list(claims).index("V"), list(claims).index("mach")
    assert high[speed] > low[speed] + 1.0
    assert high[mach] == pytest.approx(low[mach], rel=1e-14)
    assert {"V", "h", "gamma", "w_gust", "u_gust"} == set(claims["mach"])
    margin = list(claims).index("choking_margin")
    assert high[margin] != pytest.approx(low[margin], rel=1e-3)
    assert "h" in claims["choking_margin"]


@pytest.mark.parametrize("known", MOVES)
def test_verif_linear_dependencies_are_linear(
    claims: dict, start: Callable[..., np.ndarray], known: str
) -> None:
    """Perturbed in the FMU: `fixed` has one slope in a flight, `constant` one slope for ever."""
    parameter, size = MOVES[known]
    kinds = [(row, names[known]) for row, names in enumerate(claims.values()) if known in names]
    slopes: dict[int, list[float]] = {}
    for configuration in (EVEN_MASS_BEAM, SLOSH_BEAM):
        if configuration == SLOSH_BEAM and known in ALSO_PARAMETERS:
            continue
        other = {"alpha0": 0.04, "eta10": 0.02} if known not in ("alpha", "eta1") else {"q0": 0.1}
        for elsewhere in ({}, other):
            at = [BASE[parameter] + part * size for part in (0.0, 0.5, 1.0)]
            low, middle, high = (start(configuration, **elsewhere, **{parameter: x}) for x in at)
            for row, kind in kinds:
                if kind == "dependent":
                    continue
                first, second = middle[row] - low[row], high[row] - middle[row]
                assert first == pytest.approx(second, rel=LINEAR, abs=1e-13), list(claims)[row]
                same = row if kind == "constant" else (row, configuration)
                slopes.setdefault(same, []).append((first + second) / size)
    for found in slopes.values():
        np.testing.assert_allclose(found, found[0], rtol=LINEAR, atol=1e-12)
    if known != "V":  # changed through the Mach number
        constant = [slopes[row][0] for row, kind in kinds if kind == "constant"]
        np.testing.assert_allclose(constant, 1.0, rtol=LINEAR)


def jacobian(
    oracle: Vehicle, names: list[str], x: np.ndarray, u: np.ndarray, known: int
) -> np.ndarray:
    """Slope of every output and rate of the oracle by complex step; NaN where it has none."""
    state, control = x.astype(complex), u.astype(complex)
    if known < len(ALL_STATES):
        if known < oracle.states:
            state[known] += 1j * TINY
    else:
        control[known - len(ALL_STATES)] += 1j * TINY
    active = state[: oracle.states]
    padded = np.zeros(len(ALL_STATES), dtype=complex)
    padded[: oracle.states] = oracle.rhs(0.0, active, control)
    values = dict(zip(ALL_DERIVATIVES, padded, strict=True))
    full = state.copy()
    full[oracle.states :] = 0.0
    values |= dict(zip(ALL_STATES, full, strict=True))
    found = oracle.outputs(active, control)
    values |= {ours: found[theirs] for ours, theirs in OUTPUTS.items()}
    values |= {"delta_e_effective": control[0], "phi_effective": control[1]}
    return np.array([np.imag(values[name]) / TINY for name in names])


def test_verif_dependencies_are_the_sparsity_of_the_equations(
    claims: dict, vehicle: Callable[..., Vehicle]
) -> None:
    """All states and inputs: the dependencies are the nonzero pattern of the oracle's derivatives.

    In one coefficient set or another: only one has a plume under the aft-body. What the fuel does
    is seen in that one while it burns, and what the pitch rate does if its terms count.
    """
    names = list(claims)
    generator = np.random.default_rng(7)
    cases = [(configuration, aero) for configuration in CONFIGURATIONS for aero in AERO_SETS]
    oracles = [vehicle(configuration=configuration, aero=aero) for configuration, aero in cases]
    burning = {"configuration": SLOSH_BEAM, "aero": "shock_expansion", "pitch_rate_factor": 1.0}
    oracles.append(Burning(**burning))
    slopes = np.zeros((len(oracles), 3, len(names), len(KNOWNS)))
    for c, oracle in enumerate(oracles):
        trim, control = oracle.trim()
        for point in range(3):
            x = generator.normal(0.0, 0.01, len(ALL_STATES))
            x[: oracle.states] += trim
            u = np.append(control, [5.0, 2.0]) + generator.normal(0.0, 0.02, len(INPUTS))
            for known in range(len(KNOWNS)):
                slopes[c, point, :, known] = jacobian(oracle, names, x, u, known)
    for row, name in enumerate(names):
        for column, known in enumerate(KNOWNS):
            found = slopes[:, :, row, column]
            kind = claims[name].get(known)
            assert found.any() == (kind is not None), f"{name} of {known}"
            if kind == "fixed":
                np.testing.assert_allclose(found, found[:, :1] + 0.0 * found, rtol=LINEAR)
            if kind == "constant":
                there = found[np.abs(found).any(axis=1)]
                np.testing.assert_allclose(there, there[0, 0], rtol=LINEAR)


def test_verif_controls_in_effect_depend_on_their_own_input_only(claims: dict) -> None:
    """Saturation makes the dependency neither constant nor fixed."""
    assert claims["delta_e_effective"] == {"delta_e": "dependent"}
    assert claims["phi_effective"] == {"phi": "dependent"}


def test_verif_inputs_reach_no_state_directly(claims: dict) -> None:
    """V, gamma and the modal coordinates have no direct feed-through: no algebraic loops there."""
    for name in ("V", "gamma", "eta1", "eta2", "eta3", "h", "alpha", "q", "theta"):
        assert not set(INPUTS) & set(claims[name]), name
