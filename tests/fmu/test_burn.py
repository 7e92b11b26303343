"""Flights whose fuel burns."""

from __future__ import annotations

import ctypes

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi2 import FMU2Model

from harness import (
    ALL_STATES,
    CONFIGURATIONS,
    DISCARD,
    EVERYTHING,
    FUEL,
    INPUTS,
    OK,
    OUTPUTS,
    SLOSH_BEAM,
    Package,
)
from oracle_burn import REACH, Burning
from test_exchange import AGREEMENT, STEP, STEPS, STOP, TOLERANCE
from test_linear import DIFFERENCE, jacobian
from test_run import all_inputs, doublet

# Relative to a variable's largest excursion in 0.7 s of flight: FMU and oracle neglect different
# terms of second order in the flow, and the FMU interpolates between fuel levels.
SAME_FLIGHT = 1e-6
# Other limits and steps, by configuration and fuel. A kilogram of fuel turns the slosh modes of a
# light vehicle ten times as far, 2.4e-4 against 2.2e-5: the measured error is up to 6e-6, and a
# tenth of that with half the flow. In 0.7 s its slosh would reach the depth limit.
LIGHT = {(SLOSH_BEAM, 0.4): (1e-5, 60)}
# Perturbation relative to a state's nominal value; and rounding error of the rates.
STATE_STEP, ROUNDING = 1e-3, 1e-14
# Variables that do not depend on the basis of the modes: the oracle uses eigenmodes.
COMPARED = ("V", "h", "gamma", "alpha", "q")


@pytest.mark.parametrize("fuel_fraction", [1.0, 0.4])
@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_a_burning_flight_is_the_oracles(
    package: Package, configuration: int, fuel_fraction: float
) -> None:
    """All that both know, at every communication point; elevator and engine at work."""
    limit, steps = LIGHT.get((configuration, fuel_fraction), (SAME_FLIGHT, 70))
    step = 0.01

    def manoeuvre(k: int) -> tuple[float, float]:
        # Half the doublet of other flights, because of the depth limit of light vehicles.
        return 0.5 * doublet(k)[0], 0.3 if k >= 10 else 0.0

    given = {"configuration": configuration, "fuel_fraction": fuel_fraction}
    oracle = Burning(**given)
    _, states, outputs = oracle.simulate(step * steps, step, manoeuvre)
    theirs = np.column_stack(
        [states[:, :5], states[:, -1], *(outputs[key] for key in OUTPUTS.values())]
    )
    assert states[-1, -1] > (1.0 - REACH) * states[0, -1]
    with package.flight(1e-10, fuel_burn=True, **given) as flight:
        ours = flight.fly(steps, step, manoeuvre, (*COMPARED, FUEL, *OUTPUTS))
    size = np.abs(theirs - theirs[0]).max(axis=0)
    # The liquid of both tanks moves in the same modes, in one of them with smaller amplitude.
    tanks = [(*COMPARED, FUEL, *OUTPUTS).index(name) for name in ("slosh1", "slosh2")]
    size[tanks] = size[tanks].max()
    error = np.abs(ours - theirs).max(axis=0)
    assert theirs[0, 5] - theirs[-1, 5] > 2.0 * step * steps, "kg/m burnt"
    for name, wrong, scale in zip((*COMPARED, FUEL, *OUTPUTS), error, size, strict=True):
        assert wrong <= limit * scale, f"{name}: {wrong / scale if scale else wrong:.2e}"
    # Burning has an effect: a flight without it differs.
    with package.flight(1e-10, **given) as flight:
        kept = flight.fly(steps, step, manoeuvre, (*COMPARED, FUEL, *OUTPUTS))
    felt = np.abs(kept - theirs).max(axis=0) > 10.0 * limit * size
    assert felt[: len(COMPARED)].all(), felt


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_cvode_and_co_simulation_burn_alike(package: Package, configuration: int) -> None:
    outside, inside = (
        simulate_fmu(
            str(package.path),
            fmi_type=kind,
            stop_time=STOP,
            output_interval=STEP,
            relative_tolerance=TOLERANCE,
            start_values={"configuration": configuration, "delta_e": 0.003, "fuel_burn": True},
            output=["V", "gamma", "alpha", "q", "eta1", "slosh1", "lift", FUEL],
        )
        for kind in ("ModelExchange", "CoSimulation")
    )
    for name in outside.dtype.names[1:]:
        error = np.abs(outside[name] - inside[name]).max()
        size = np.abs(inside[name]).max()
        assert error <= AGREEMENT * np.ptp(inside[name]) + STEPS * TOLERANCE * size, name
    assert np.ptp(inside[FUEL]) > 0.5, "fuel burns"


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_a_burning_flight_goes_on_from_a_kept_state(
    package: Package, configuration: int
) -> None:
    """Bit for bit, in this instance, and from bytes in one that never heard of burning."""

    def fly(flight) -> bytes:
        flight.fly(20, 0.01, all_inputs)
        return flight.bits()

    with package.flight(configuration=configuration, fuel_burn=True) as flight:
        fly(flight)
        state, time, here = flight.fmu.getFMUstate(), flight.time, flight.bits()
        data = flight.fmu.serializeFMUstate(state)
        end = fly(flight)
        flight.fmu.setFMUstate(state)
        flight.time = time
        assert flight.bits() == here != end
        assert fly(flight) == end
        flight.fmu.freeFMUstate(state)
    with package.flight() as other:
        other.fmu.setFMUstate(other.fmu.deSerializeFMUstate(data))
        other.time = time
        assert other.bits() == here and other["fuel_burn"]
        assert fly(other) == end


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_the_last_fuel_ends_the_flight(package: Package, configuration: int) -> None:
    """The step is discarded at the instant the tanks are empty, and the log says so."""
    with package.instance(logging=True) as flight:
        flight.initialise(configuration=configuration, fuel_fraction=1e-4, fuel_burn=True)
        board, flow = flight.get(FUEL, f"der({FUEL})")
        while flight.step_status(0.05) == OK:
            assert flight.time < 2.0
        assert flight.log[-1].status == DISCARD and flight.terminated()
        assert "fuel ran out" in flight.log[-1].text and "fuel_fraction" in flight.log[-1].text
        assert flight.last_time() == pytest.approx(-board / flow, rel=1e-3)
        assert 0.0 <= flight[FUEL] < 1e-6 and np.isfinite(flight.get(*EVERYTHING)).all()


@pytest.mark.parametrize("aero", [1, 2, 3])
def test_inputs_answer_as_a_difference_quotient_says_while_fuel_burns(
    package: Package, aero: int
) -> None:
    step, rates = 1e-4, EVERYTHING
    with package.flight(aero=aero, fuel_burn=True) as flight:
        flight.fly(10, 0.01, all_inputs)
        flight.set(**dict.fromkeys(INPUTS, 0.0))
        exact = jacobian(flight, rates, INPUTS)
        for column, name in enumerate(INPUTS):
            both = []
            for sign in (1, -1):
                flight.set(**{name: sign * step})
                both.append(flight.get(*rates))
            flight.set(**{name: 0.0})
            quotient = (both[0] - both[1]) / (2 * step)
            scale = np.abs(both[0]) + np.abs(exact[:, column]) + step
            assert np.all(np.abs(quotient - exact[:, column]) <= DIFFERENCE * scale), name
        flow = exact[rates.index(f"der({FUEL})"), INPUTS.index("phi")]
        assert flow < -1.0, "kg/(m s) per fuel ratio"


def test_states_move_a_burning_vehicle_as_a_difference_quotient_says(package: Package) -> None:
    """All columns of A, that of the fuel too, half way through the tanks, in model exchange."""
    reference = {name: v.valueReference for name, v in package.variables.items()}
    vehicle = FMU2Model(
        guid=package.description.guid,
        unzipDirectory=str(package.folder),
        modelIdentifier=package.description.modelExchange.modelIdentifier,
        instanceName="outside",
    )
    vehicle.instantiate()
    vehicle.setBoolean([reference["fuel_burn"]], [True])
    vehicle.setReal([reference["phi"]], [0.3])
    vehicle.setupExperiment()
    vehicle.enterInitializationMode()
    vehicle.exitInitializationMode()
    vehicle.enterContinuousTimeMode()
    count = len(ALL_STATES)
    x, rates = (ctypes.c_double * count)(), (ctypes.c_double * count)()
    vehicle.getContinuousStates(x, count)
    start = np.array(x)
    start[-1] *= 0.53
    start[5:-1] += 0.02

    def slope(state: np.ndarray) -> np.ndarray:
        vehicle.setContinuousStates((ctypes.c_double * count)(*state), count)
        vehicle.getDerivatives(rates, count)
        return np.array(rates)

    here = slope(start)
    rows = [reference[f"der({name})"] for name in ALL_STATES]
    nominal = [float(package.variables[name].nominal) for name in ALL_STATES]
    for column, (name, size) in enumerate(zip(ALL_STATES, nominal, strict=True)):
        slope(start)
        exact = np.array(vehicle.getDirectionalDerivative(rows, [reference[name]], [size]))
        step = np.zeros(count)
        step[column] = STATE_STEP * size
        quotient = (slope(start + step) - slope(start - step)) / (2.0 * STATE_STEP)
        wrong = np.abs(quotient - exact)
        limit = DIFFERENCE * np.abs(exact) + ROUNDING * np.abs(here) / STATE_STEP + 1e-12
        assert np.all(wrong <= limit), f"{name}: {wrong / limit}"
        assert exact.any(), name
    vehicle.freeInstance()
