"""The linear model: numbers, names, both standards, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fmpy import extract

import ahv

# Poles of README.md in rad/s, those with an imaginary part above the axis.
POLES = {
    "Rigid": [3.218, -3.289],
    "EvenMassBeam": [4.451, -4.522, -0.294 + 19.55j, -1.112 + 45.23j, -2.264 + 96.39j],
    "SloshBeam": [
        *(4.641, -4.722, -0.365 + 23.03j, -1.339 + 54.00j, -2.562 + 108.08j),
        *(-0.403 + 7.61j, -0.457 + 8.52j),
    ],
}


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("configuration", POLES)
def test_poles_are_those_of_the_readme(version: str, configuration: str) -> None:
    found = np.linalg.eigvals(ahv.linear_model(ahv.fmu(version), configuration=configuration).A)
    for pole in POLES[configuration]:
        nearest = found[np.abs(found - pole).argmin()]
        assert nearest.real == pytest.approx(pole.real, abs=6e-4)
        assert nearest.imag == pytest.approx(pole.imag, abs=6e-3)


def test_both_standards_files_folders_names_and_numbers_give_the_same_bits(tmp_path: Path) -> None:
    extract(ahv.fmu(), unzipdir=tmp_path)
    models = [
        ahv.linear_model(),
        ahv.linear_model(str(ahv.fmu()), configuration="SloshBeam", trim=True),
        ahv.linear_model(ahv.fmu("3.0"), configuration=3, mach0=8, aero="XU2015"),
        ahv.linear_model(tmp_path, trim=1),
    ]
    for model in models:
        assert model.states == models[0].states and model.trim == models[0].trim
        for name in "ABCD":
            assert np.array_equal(getattr(model, name), getattr(models[0], name)), name
    changed = ahv.linear_model(tmp_path, mach0=9.0)
    assert not np.array_equal(changed.A, models[0].A)


def test_shapes_and_names_are_those_asked_for() -> None:
    model = ahv.linear_model(outputs=["n_z"], inputs=["delta_e", "w_gust", "phi"])
    assert (model.A.shape, model.B.shape) == ((16, 16), (16, 3))
    assert (model.C.shape, model.D.shape) == ((1, 16), (1, 3))
    assert (model.inputs, model.outputs) == (["delta_e", "w_gust", "phi"], ["n_z"])
    swapped = ahv.linear_model(outputs=["n_z"])
    assert np.array_equal(model.B[:, [0, 2]], swapped.B)
    # At Mach 8 the curvature of the earth carries a tenth of the weight.
    assert model.trim["n_z"] == pytest.approx(0.9, abs=0.01)
    assert model.trim["V"] > 2000.0 and model.trim["delta_e_trim"] > 0.2


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"mach": 8.0}, "there is no parameter `mach`; did you mean mach0?"),
        ({"V": 8.0}, "there is no parameter `V`"),
        ({"delta_e": 0.1}, "there is no parameter `delta_e`"),
        ({"configuration": "Soft"}, "choose one of Rigid (1), EvenMassBeam (2), SloshBeam (3)"),
        ({"configuration": 7}, "configuration = 7 is refused; choose one of"),
        ({"trim": 2}, "trim = 2 is refused; True or False is expected"),
        ({"mach0": "fast"}, "mach0 = 'fast' is refused; a number is expected"),
        ({"outputs": ["v"]}, "there is no variable `v`"),
        ({"inputs": ["elevator"]}, "there is no variable `elevator`"),
    ],
)
def test_wrong_names_and_values_are_refused(options: dict[str, object], said: str) -> None:
    with pytest.raises(ValueError) as refused:
        ahv.linear_model(**options)  # type: ignore[arg-type]
    assert said in str(refused.value)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize(
    ("options", "said"),
    [({"mach0": 99.0}, "mach0"), ({"mach0": 2.0}, "trim"), ({"inputs": ["V", "h"]}, None)],
)
def test_the_fmu_says_why_it_refuses(
    version: str, options: dict[str, object], said: str | None
) -> None:
    if said is None:
        assert ahv.linear_model(ahv.fmu(version), **options).B.shape == (16, 2)  # type: ignore[arg-type]
        return
    with pytest.raises(ahv.FMUError, match=said):
        ahv.linear_model(ahv.fmu(version), **options)  # type: ignore[arg-type]


def test_versions_and_templates_that_do_not_exist_are_refused() -> None:
    with pytest.raises(ValueError, match=r'"2.0" or "3.0" is expected'):
        ahv.fmu("1.0")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match='"autopilot", "actuator", "sensor" is expected'):
        ahv.fmu(model="engine")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match='"vehicle" or "coefficients" is expected'):
        ahv.template("engine")  # type: ignore[arg-type]


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_one_instance_gives_the_models_of_many(version: str) -> None:
    """Nothing is left of the vehicle before, nor of one that was refused."""
    fmu, outputs = ahv.fmu(version), ("V", "n_z")  # type: ignore[arg-type]
    cases: list[dict[str, float | str]] = [{"mach0": 9.0}, {"aero": "parker2007"}, {}]
    with ahv.Linearizer(fmu, outputs) as linearizer:
        for case in cases:
            mine, alone = linearizer.model(**case), ahv.linear_model(fmu, outputs, **case)
            for name in "ABCD":
                assert np.array_equal(getattr(mine, name), getattr(alone, name)), name
            assert mine.trim == alone.trim
            with pytest.raises(ahv.FMUError, match="no trim"):
                linearizer.model(mach0=9.0, elevator_factor=0.5, fuel_fraction=1.0)
            with pytest.raises(ValueError, match="there is no parameter `mach`"):
                linearizer.model(fuel_fraction=0.5, mach=9.0)
