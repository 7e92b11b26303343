"""What goes wrong is refused with a message, and leaves the flight as it was."""

from __future__ import annotations

import math
import subprocess
import sys
from ctypes import byref
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy.fmi2 import fmi2Boolean, fmi2Integer, fmi2Real, fmi2String, fmi2ValueReference

from harness import (
    DISCARD,
    ERROR,
    EVERYTHING,
    INPUTS,
    OK,
    STATES,
    Instance,
    Package,
    Refused,
)

HERE = Path(__file__).parent
C_TYPES = {
    "Real": fmi2Real,
    "Integer": fmi2Integer,
    "Boolean": fmi2Boolean,
    "String": fmi2String,
}
# The envelope of the curve fits in alpha.
ALPHA = (math.radians(-5.0), math.radians(10.0))


def put(flight: Instance, kind: str, reference: int, value: Any) -> int:
    """Status of setting one value by its reference."""
    number = C_TYPES[kind](value)
    return flight.status(f"fmi2Set{kind}", fmi2ValueReference(reference), 1, byref(number))


def read(flight: Instance, kind: str, reference: int) -> int:
    """Status of reading one value by its reference."""
    return flight.status(f"fmi2Get{kind}", fmi2ValueReference(reference), 1, byref(C_TYPES[kind]()))


@pytest.mark.parametrize("delta", [0.05, -0.05], ids=["down", "up"])
@pytest.mark.parametrize("configuration", [1, 2, 3])
def test_verif_leaving_the_envelope_is_discarded(
    package: Package, configuration: int, delta: float
) -> None:
    """The step is discarded, the state is the last valid one, and the simulation shall end."""
    with package.instance(logging=True) as flight:
        flight.initialise(configuration=configuration, delta_e=delta)
        for _ in range(300):
            begin, status = flight.time, flight.step_status(0.01)
            if status != OK:
                break
        assert status == DISCARD
        last = flight.last_time()
        assert begin <= last < begin + 0.01
        assert flight.terminated()
        assert flight.log[-1].status == DISCARD
        assert "alpha" in flight.log[-1].text
        values = flight.get(*EVERYTHING)
        assert np.isfinite(values).all()
        alpha = flight["alpha"]
        assert ALPHA[0] <= alpha <= ALPHA[1]
        assert min(abs(alpha - limit) for limit in ALPHA) < 1e-6
        # A flight to exactly that instant is valid and ends in the same state.
        with package.flight(configuration=configuration, delta_e=delta) as again:
            while again.time < begin:
                again.step(0.01)
            if last > begin:
                again.step(last - begin)
            np.testing.assert_allclose(again.get(*STATES), values[: len(STATES)], rtol=1e-6)


def test_verif_leaving_the_envelope_ends_every_step(package: Package) -> None:
    """A step that crosses the limit returns, whatever its size and its end round to."""
    script = [sys.executable, str(HERE / "leave.py"), str(package.folder)]
    run = subprocess.run(script, capture_output=True, text=True, timeout=60, check=False)
    assert run.returncode == 0, run.stderr
    assert set(run.stdout.split()) == {str(DISCARD)}


def test_verif_discarded_flight_can_be_reset(package: Package) -> None:
    """After a discarded step a reset gives a fresh flight."""
    with package.flight(configuration=1, delta_e=0.3) as flight:
        while flight.step_status(0.05) == OK:
            pass
        flight.call("fmi2Reset")
        flight.initialise()
        again = flight.fly(5, 0.01)
    with package.flight() as fresh:
        assert np.array_equal(fresh.fly(5, 0.01), again)


@pytest.mark.parametrize(
    ("start", "limit"),
    [({"alpha0": 0.5}, "alpha0"), ({"mach0": 3.0}, "mach0"), ({"altitude0": 80e3}, "altitude0")],
    ids=lambda value: value if isinstance(value, str) else next(iter(value)),
)
def test_verif_start_outside_the_envelope_is_refused(
    package: Package, start: dict[str, float], limit: str
) -> None:
    """trim = false does not start where the curve fits mean nothing."""
    with package.instance() as instance:
        instance.set(trim=False, **start)
        instance.setup()
        with pytest.raises(Refused) as refused:
            instance.call("fmi2ExitInitializationMode")
        assert refused.value.status == ERROR
        assert limit in refused.value.text.lower()


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf], ids=str)
@pytest.mark.parametrize("name", INPUTS)
def test_verif_input_that_is_no_number_is_refused(
    package: Package, name: str, value: float
) -> None:
    """fmi2Error, a message with variable and value, and everything as before."""
    with package.flight() as flight:
        flight.set(delta_e=0.001, phi=0.01)
        flight.step(0.01)
        before = flight.bits()
        assert put(flight, "Real", package.variables[name].valueReference, value) == ERROR
        message = flight.log[-1]
        assert message.status == ERROR and message.instance == "ahv"
        assert name in message.text and str(value)[-3:] in message.text.lower()
        assert flight.bits() == before


def test_verif_vector_with_one_bad_value_changes_nothing(package: Package) -> None:
    """[good, bad] sets neither."""
    with package.flight() as flight:
        before = flight.bits()
        references = (fmi2ValueReference * 2)(0, 1)
        values = (fmi2Real * 2)(0.01, math.nan)
        assert flight.status("fmi2SetReal", references, 2, values) == ERROR
        assert "phi" in flight.log[-1].text
        assert flight.bits() == before


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("w_gust", 201.0),
        ("fuel_fraction", 1.5),
        ("fuel_fraction", -0.1),
        ("fuel_fraction", math.nan),
        ("slosh_damping", -1.0),
        ("slosh_frequency", -5.0),
        ("mach0", math.inf),
        ("altitude0", -1.0),
        ("configuration", 0),
        ("configuration", 4),
        ("aero", 99),
        ("input_mode", 3),
    ],
    ids=str,
)
def test_verif_parameter_out_of_range_is_refused(package: Package, name: str, value: float) -> None:
    """The message names the parameter and the value; the parameter keeps its value."""
    variable = package.variables[name]
    kind = "Integer" if variable.type == "Enumeration" else "Real"
    with package.instance() as instance:
        assert put(instance, kind, variable.valueReference, value) == ERROR
        text = instance.log[-1].text
        assert name in text and f"{value:g}".lower() in text.lower()
        instance.call("fmi2Reset")
        instance.setup()
        assert instance[name] == pytest.approx(float(variable.start), rel=0.0)


@pytest.mark.parametrize("kind", ["Real", "Integer", "Boolean", "String"])
def test_verif_unknown_reference_is_refused(package: Package, kind: str) -> None:
    """Reading and setting a variable that does not exist: the message has its number."""
    for reference in (len(package.variables), 9999, 2**32 - 1):
        for action in (put, read):
            with package.flight() as flight:
                before = flight.bits()
                value = [b"" if kind == "String" else 0] if action is put else []
                assert action(flight, kind, reference, *value) == ERROR
                assert str(reference) in flight.log[-1].text
                assert flight.bits() == before


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("delta_e", "Integer"),
        ("delta_e", "Boolean"),
        ("delta_e", "String"),
        ("configuration", "Real"),
        ("configuration", "Boolean"),
        ("trim", "Real"),
        ("trim", "Integer"),
        ("V", "Integer"),
    ],
)
def test_verif_wrong_type_is_refused(package: Package, name: str, kind: str) -> None:
    """A variable is read and set by its own type only."""
    reference = package.variables[name].valueReference
    for action in (put, read):
        with package.instance() as instance:
            instance.setup()
            value = [b"" if kind == "String" else 1] if action is put else []
            assert action(instance, kind, reference, *value) == ERROR
            assert name in instance.log[-1].text


@pytest.mark.parametrize("name", ["V", "lift", "alpha_trim", "omega1", "eta1_dot", "der(V)"])
def test_verif_results_cannot_be_set(package: Package, name: str) -> None:
    """Outputs, rates, local states and calculated parameters are not for setting."""
    with package.flight() as flight:
        before = flight.bits()
        assert put(flight, "Real", package.variables[name].valueReference, 1.0) == ERROR
        assert name in flight.log[-1].text
        assert flight.bits() == before


@pytest.mark.parametrize("name", ["fuel_fraction", "mach0", "configuration", "trim"])
def test_verif_fixed_parameters_are_fixed_in_flight(package: Package, name: str) -> None:
    """A fixed parameter cannot be set after initialisation."""
    variable = package.variables[name]
    kind = "Integer" if variable.type == "Enumeration" else variable.type
    with package.flight() as flight:
        before = flight.bits()
        assert put(flight, kind, variable.valueReference, 1) == ERROR
        assert flight.log[-1].text
        assert flight.bits() == before


def test_verif_wrong_guid_is_refused(package: Package) -> None:
    """A description of another model does not get an instance."""
    other = package.instance()
    guid = other.fmu.guid
    other.close()
    other.fmu.guid = "{00000000-0000-0000-0000-000000000000}"
    assert other.fmu.guid != guid
    fresh = type(other.fmu)(
        guid=other.fmu.guid,
        unzipDirectory=str(package.folder),
        modelIdentifier="ahv",
        instanceName="other",
    )
    with pytest.raises(Exception, match="Failed to instantiate"):
        fresh.instantiate()
    fresh.freeLibrary()


def test_verif_calls_out_of_order_are_refused(package: Package) -> None:
    """A step before initialisation, and an initialisation that was not entered."""
    with package.instance() as instance:
        assert instance.status("fmi2DoStep", 0.0, 0.01, True) == ERROR
        assert "fmi2DoStep" in instance.log[-1].text
    with package.instance() as instance:
        assert instance.status("fmi2ExitInitializationMode") == ERROR


def test_verif_log_categories_are_those_described(package: Package) -> None:
    """A master may enable every category of the description; the FMU uses no others.

    All but the one of internal errors, of which there are none.
    """
    described = [category.name for category in package.description.logCategories]
    with package.instance() as flight:
        for name in described:
            categories = (fmi2String * 1)(name.encode())
            assert flight.status("fmi2SetDebugLogging", True, 1, categories) == OK, name
        flight.fmu.setDebugLogging(True, [])
        flight.initialise(configuration=1, delta_e=0.2)
        while flight.step_status(0.1) == OK:
            pass
        put(flight, "Real", 9999, 0.0)
        used = {message.category for message in flight.log}
    assert used == set(described) - {"logStatusFatal"}


def test_verif_nothing_to_say_about_a_good_flight(package: Package) -> None:
    """No warning and no message from instantiation to the end."""
    with package.instance() as instance:
        instance.initialise(tolerance=1e-9, stop=0.1, fuel_fraction=0.7)
        instance.fly(10, 0.01, lambda _: (0.001, 0.01))
        instance.call("fmi2Terminate")
        assert instance.log == []
