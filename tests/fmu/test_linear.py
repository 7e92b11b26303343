"""Directional derivatives: exact, and the poles of the tables out of the packaged FMU."""

from __future__ import annotations

import json

import numpy as np
import pytest

from ahv import linear_model
from harness import (
    ALL_DERIVATIVES,
    ALL_STATES,
    CONFIGURATIONS,
    CONTROLS,
    DERIVATIVES,
    ERROR,
    EVERYTHING,
    INPUTS,
    SLOSH_BEAM,
    STATES,
    Instance,
    Package,
    ahv,
)

# Difference of the two eigenvalue solvers relative to the largest pole.
ROUNDING = 1e-10
# Error of a central difference with an input change of 1e-4: 1e-8 truncation, 1e-12 rounding.
DIFFERENCE = 1e-6
# In trim the moment and its derivative with respect to u_gust are 0: the quotient is the rounding
# error of its terms, which are lift times this arm in m.
LAST_DIGITS, ARM = 1e-15, 10.0
NAMES = {1: "Rigid", 2: "EvenMassBeam", 3: "SloshBeam"}


def jacobian(flight: Instance, unknowns: tuple[str, ...], knowns: tuple[str, ...]) -> np.ndarray:
    """Changes of the unknowns per change of each known."""
    reference = {name: v.valueReference for name, v in flight.package.variables.items()}
    rows = [reference[name] for name in unknowns]
    columns = [
        flight.fmu.getDirectionalDerivative(rows, [reference[known]], [1.0]) for known in knowns
    ]
    return np.array(columns).T


def tool(configuration: int) -> dict:
    """What `cargo ahv poles` says."""
    done = ahv("poles", "--json", "--set", f"configuration={NAMES[configuration]}")
    assert done.returncode == 0, done.stderr
    (report,) = json.loads(done.stdout)
    return report


def apart(found: np.ndarray, expected: np.ndarray) -> float:
    """Largest distance of each expected value from the nearest found one."""
    assert found.size == expected.size
    return np.abs(expected[:, None] - found[None, :]).min(axis=1).max()


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_poles_of_the_black_box_are_those_of_the_tables(
    package: Package, configuration: int
) -> None:
    with package.flight(configuration=configuration) as flight:
        a = jacobian(flight, DERIVATIVES, STATES)
    poles = tool(configuration)["poles"]
    upper = np.array([complex(pole["re"], pole["im"]) for pole in poles])
    expected = np.concatenate([upper, upper[upper.imag > 0].conj()])
    states = expected.size
    assert not a[states:].any() and not a[:, states:].any()
    found = np.linalg.eigvals(a[:states, :states])
    assert apart(found, expected) < ROUNDING * np.abs(expected).max()


@pytest.mark.parametrize("aero", [1, 2, 3])
def test_inputs_answer_as_a_difference_quotient_says(package: Package, aero: int) -> None:
    step = 1e-4
    with package.flight(configuration=SLOSH_BEAM, aero=aero) as flight:
        exact = jacobian(flight, EVERYTHING, INPUTS)
        for column, name in enumerate(INPUTS):
            both = []
            for sign in (1, -1):
                flight.set(**{name: sign * step})
                both.append(np.array(flight.get(*EVERYTHING)))
            flight.set(**{name: 0.0})
            quotient = (both[0] - both[1]) / (2 * step)
            scale = np.abs(both[0]) + np.abs(exact[:, column]) + step
            limit = DIFFERENCE * scale
            lift = both[0][EVERYTHING.index("lift")]
            limit[EVERYTHING.index("moment")] += LAST_DIGITS * ARM * lift / step
            assert np.all(np.abs(quotient - exact[:, column]) <= limit)


def test_direction_is_linear_and_zero_beyond_a_limit(package: Package) -> None:
    with package.flight() as flight:
        reference = {name: v.valueReference for name, v in package.variables.items()}
        rows = [reference[name] for name in EVERYTHING]
        knowns = [reference["alpha"], reference["delta_e"]]
        one = np.array(flight.fmu.getDirectionalDerivative(rows, knowns, [2.0, -3.0]))
        columns = jacobian(flight, EVERYTHING, ("alpha", "delta_e"))
        assert np.allclose(one, columns @ [2.0, -3.0], rtol=1e-13, atol=0)
        flight.set(delta_e=1.0)
        assert not jacobian(flight, DERIVATIVES, ("delta_e",)).any()


@pytest.mark.parametrize(
    ("unknown", "known", "seed", "said"),
    [
        ("V", "mach0", 1.0, "mach0"),
        ("omega1", "delta_e", 1.0, "omega1"),
        ("V", "delta_e", float("nan"), "NaN"),
    ],
)
def test_what_has_no_derivative_is_refused_by_name(
    package: Package, unknown: str, known: str, seed: float, said: str
) -> None:
    with package.flight() as flight:
        reference = {name: v.valueReference for name, v in package.variables.items()}
        with pytest.raises(Exception) as refused:
            flight.fmu.getDirectionalDerivative([reference[unknown]], [reference[known]], [seed])
        assert getattr(refused.value, "status", ERROR) == ERROR
        assert said in flight.log[-1].text


def test_the_python_package_gives_the_four_matrices(package: Package) -> None:
    outputs = ("V", "gamma", "n_z")
    found = linear_model(package.folder, outputs, configuration="SloshBeam")
    assert found.states == list(ALL_STATES) and found.inputs == list(CONTROLS)
    with package.flight(configuration=SLOSH_BEAM) as flight:
        assert np.array_equal(found.A, jacobian(flight, ALL_DERIVATIVES, ALL_STATES))
        assert np.array_equal(found.B, jacobian(flight, ALL_DERIVATIVES, CONTROLS))
        assert np.array_equal(found.C, jacobian(flight, outputs, ALL_STATES))
        assert np.array_equal(found.D, jacobian(flight, outputs, CONTROLS))
        names = list(found.trim)
        assert list(found.trim.values()) == flight.get(*names).tolist()
    assert np.array_equal(found.C[:2].sum(axis=1), [1.0, 1.0]) and not found.D[:2].any()
