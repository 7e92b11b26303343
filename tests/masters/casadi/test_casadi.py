"""CasADi as a master: DaeBuilder sets states by fmi2SetReal, and CVODES integrates the vehicle.

What it computes is held against the same FMU in FMPy.
"""

from __future__ import annotations

import casadi as ca
import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model

from harness import CONFIGURATIONS, Package

# Tolerances of CVODES per step, relative and absolute; resulting error after a flight.
TOLERANCE, SMALLEST, AGREEMENT = 1e-9, 1e-3, 1e-6
ELEVATOR = 0.003
# Deviation from trim, so that nothing is zero: share of each nominal value, and inputs.
DISTURBANCE, INPUTS = 0.1, (0.003, 0.01, 5.0, -3.0)


class Case:
    """One configuration in both masters, ready to evaluate."""

    def __init__(self, package: Package, configuration: int) -> None:
        self.folder, self.configuration = package.folder, configuration
        self.description = package.description
        self.dae = ca.DaeBuilder("ahv", str(package.folder))
        self.dae.set("configuration", configuration)
        self.states, self.inputs = list(self.dae.x()), list(self.dae.u())
        self.start = np.array(self.dae.get(self.states))
        self.rates = self.dae.create("rates", ["x", "u"], ["ode"])
        variables = package.variables
        self.references = {name: variable.valueReference for name, variable in variables.items()}
        nominal = [float(variables[name].nominal) for name in self.states]
        self.nominal = np.array(nominal)
        self.disturbed = self.start + DISTURBANCE * self.nominal

    def exchange(self) -> FMU2Model:
        """An instance in continuous-time mode, driven without CasADi."""
        model = FMU2Model(
            guid=self.description.guid,
            unzipDirectory=str(self.folder),
            modelIdentifier=self.description.modelExchange.modelIdentifier,
        )
        model.instantiate()
        model.setInteger([self.references["configuration"]], [self.configuration])
        model.setupExperiment(startTime=0.0)
        model.enterInitializationMode()
        model.exitInitializationMode()
        model.enterContinuousTimeMode()
        return model

    def in_order(self, values: np.ndarray) -> np.ndarray:
        """From the order of CasADi to that of the model structure, in which the states stand."""
        order = [derivative.variable.derivative.name for derivative in self.description.derivatives]
        return values[[self.states.index(name) for name in order]]


@pytest.fixture(params=CONFIGURATIONS)
def case(package: Package, request: pytest.FixtureRequest) -> Case:
    """Every configuration."""
    return Case(package, request.param)


def test_verif_casadi_starts_in_trimmed_flight(case: Case) -> None:
    """States that a master does not give are those of the trim, and none of them moves."""
    assert case.start[case.states.index("V")] > 2000
    rates = np.array(case.rates(case.start, np.zeros(4))).ravel()
    assert np.abs(rates / case.nominal).max() < 1e-6


def test_verif_casadi_gets_the_derivatives_of_the_states_that_it_sets(case: Case) -> None:
    """Set by name in CasADi, in an array in FMPy: the same bits, and those of no state before."""
    model = case.exchange()
    model.setReal([case.references[name] for name in case.inputs], INPUTS)
    order = case.in_order(np.arange(len(case.states))).astype(int)
    for state in (case.start, case.disturbed, case.start):
        values = np.ascontiguousarray(state[order])
        model.setContinuousStates(
            values.ctypes.data_as(fmpy.fmi2.POINTER(fmpy.fmi2.c_double)), len(values)
        )
        expected = np.zeros(len(values))
        model.getDerivatives(
            expected.ctypes.data_as(fmpy.fmi2.POINTER(fmpy.fmi2.c_double)), len(values)
        )
        rates = np.array(case.rates(state, INPUTS)).ravel()
        assert rates[order].tolist() == expected.tolist()
    model.terminate()
    model.freeInstance()


def test_verif_casadi_jacobian_is_the_one_of_the_fmu(case: Case) -> None:
    """Exact: the directional derivatives; and nearly so: differences of the rates."""
    jacobian = case.rates.factory("jacobian", ["x", "u"], ["jac:ode:x", "jac:ode:u"])
    by_state, by_input = (np.array(part) for part in jacobian(case.disturbed, INPUTS))
    model = case.exchange()
    model.setReal(
        [case.references[name] for name in (*case.states, *case.inputs)], [*case.disturbed, *INPUTS]
    )
    rates = [case.references[f"der({name})"] for name in case.states]
    columns = [(case.states, by_state), (case.inputs, by_input)]
    for names, block in columns:
        for column, name in enumerate(names):
            exact = model.getDirectionalDerivative(rates, [case.references[name]], [1.0])
            scale = np.abs(exact).max()
            assert np.allclose(block[:, column], exact, rtol=1e-12, atol=1e-12 * scale), name
    model.terminate()
    model.freeInstance()
    for column, step in enumerate(1e-4 * case.nominal):
        moved = np.zeros(len(case.states))
        moved[column] = step
        ahead, behind = (
            np.array(case.rates(case.disturbed + sign * moved, INPUTS)).ravel() for sign in (1, -1)
        )
        slope = (ahead - behind) / (2 * step)
        size = np.abs(by_state[:, column]).max() + np.abs(ahead).max() * 1e-12 / step
        assert np.abs(slope - by_state[:, column]).max() <= 1e-4 * size, case.states[column]


def test_verif_casadi_flies_where_co_simulation_does(case: Case) -> None:
    """CVODES from the trim, with the elevator held away from it, to the end of a second's third."""
    x, u = ca.MX.sym("x", len(case.states)), ca.MX.sym("u", len(case.inputs))
    grid = [0.1, 0.2, 0.3]
    dae = {"x": x, "u": u, "ode": case.rates(x, u)}
    options = {"reltol": TOLERANCE, "abstol": TOLERANCE * SMALLEST}
    fly = ca.integrator("fly", "cvodes", dae, 0, grid, options)
    inputs = np.zeros((len(case.inputs), len(grid)))
    inputs[case.inputs.index("delta_e")] = ELEVATOR
    outside = np.array(fly(x0=case.start, u=inputs)["xf"])
    inside = fmpy.simulate_fmu(
        str(case.folder),
        fmi_type="CoSimulation",
        stop_time=grid[-1],
        output_interval=grid[0],
        relative_tolerance=TOLERANCE,
        start_values={"configuration": case.configuration, "delta_e": ELEVATOR},
        output=case.states,
    )
    for row, name in enumerate(case.states):
        size = case.nominal[row] + np.abs(outside[row]).max()
        assert np.abs(outside[row] - inside[name][1:]).max() <= AGREEMENT * size, name
    assert np.ptp(inside["q"]) > 0.004, "the elevator moves the vehicle"
