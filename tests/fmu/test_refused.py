"""Uncertain values, stations and offsets that make no vehicle are refused by name."""

from __future__ import annotations

import math
from typing import Any

import pytest

from contract import FACTORS, OFFSETS
from harness import ERROR, OK, Instance, Package, Refused
from test_description import limits
from test_failures import put

ALL_FACTORS = tuple(f"{name}_factor" for name in (*FACTORS, "pitch_rate"))
ALL_OFFSETS = tuple(f"{name}_offset" for name in OFFSETS)
OTHERS = ("mass_centre_shift", "imu_station", "probe_station")


def shown(value: float) -> str:
    """How a message says a number, without what platforms differ in."""
    return str(value)[-3:].lower() if not math.isfinite(value) else f"{value:g}"


def said(instance: Instance, name: str, value: float, *more: float) -> None:
    """The last message names the parameter, the value and the range."""
    text = instance.log[-1].text.lower()
    assert name in text and shown(value) in text
    for number in more:
        assert f"{number:g}" in text, text


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, -1.0, 0.0, 2000.0], ids=str)
@pytest.mark.parametrize("name", [*ALL_FACTORS, *ALL_OFFSETS, *OTHERS])
def test_verif_a_value_out_of_its_range_is_refused(
    package: Package, name: str, value: float
) -> None:
    """fmi2Error with name, value and range when it is set; the parameter keeps its value."""
    variable = package.variables[name]
    least, most = limits(variable)
    with package.instance() as instance:
        status = put(instance, "Real", variable.valueReference, value)
        if least <= value <= most:
            assert status == OK
            return
        assert status == ERROR
        said(instance, name, value, *((least, most) if math.isfinite(value) else ()))
        instance.setup()
        assert instance[name] == float(variable.start)
        instance.call("fmi2ExitInitializationMode")


@pytest.mark.parametrize("name", ALL_FACTORS)
def test_a_factor_of_nothing_is_none(package: Package, name: str) -> None:
    """All but the part of the pitch rate's terms start above 0."""
    least, most = limits(package.variables[name])
    assert (least == 0.0) == (name == "pitch_rate_factor") and least >= 0.0
    assert most < math.inf


def refused(package: Package, given: dict[str, Any]) -> str:
    """What the FMU says when it is initialised with these values, in small letters."""
    with package.instance() as instance:
        instance.set(**given)
        instance.setup()
        with pytest.raises(Refused) as said_no:
            instance.call("fmi2ExitInitializationMode")
        assert said_no.value.status == ERROR
        # The instance can be used again.
        instance.call("fmi2Reset")
        instance.initialise()
        instance.step(0.01)
        return said_no.value.text.lower()


@pytest.mark.parametrize("configuration", [1, 3])
@pytest.mark.parametrize("name", ["imu_station", "probe_station"])
def test_verif_a_sensor_off_the_body_is_refused(
    package: Package, name: str, configuration: int
) -> None:
    """With its station and where the body ends."""
    text = refused(package, {name: 31.0, "configuration": configuration})
    assert name in text and "31" in text and "30.48" in text


@pytest.mark.parametrize(
    ("given", "name", "value"),
    [
        ({"alpha_offset": 0.3}, "alpha_offset", "0.3"),
        ({"alpha_offset": -0.2, "configuration": 1}, "alpha_offset", "-0.2"),
        ({"trim": False, "alpha0": 0.1, "alpha_offset": 0.1}, "alpha_offset", "0.1"),
        ({"slosh1_offset": 2.5}, "slosh1_offset", "2.5"),
        ({"slosh2_offset": -0.7}, "slosh2_offset", "-0.7"),
        ({"slosh2_offset": 0.4, "fuel_fraction": 0.5}, "slosh2_offset", "0.4"),
        ({"trim": False, "alpha0": 0.02, "eta10": 5.0}, "eta10", "5"),
    ],
    ids=str,
)
def test_verif_an_offset_beyond_the_limits_of_the_model_is_refused(
    package: Package, given: dict[str, Any], name: str, value: str
) -> None:
    """By the name of the offset, with its value, where it leads and the range there."""
    text = refused(package, given)
    assert f"{name} = {value} is refused" in text
    led = "alpha" if name == "alpha_offset" else "slosh"
    assert led in text and "holds in [" in text


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"inertia_factor": 0.1}, ("pitch inertia", "inertia_factor")),
        ({"elevator_factor": 0.7}, ("no trim", "delta_e", "residual")),
        ({"thrust_factor": 0.1}, ("no trim", "phi", "residual")),
        ({"density_factor": 0.1}, ("no trim", "residual")),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_verif_a_factor_that_makes_no_flight_is_refused(
    package: Package, given: dict[str, float], words: tuple[str, ...]
) -> None:
    """Within its range, but no body has that inertia, or no controls hold that vehicle level."""
    text = refused(package, given)
    assert all(word in text for word in words), text
