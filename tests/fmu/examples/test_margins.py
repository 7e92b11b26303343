"""Margins of the closed loop: against python-control, where they turn unstable, and defective."""

from __future__ import annotations

import control as ct
import numpy as np
import pytest
from scipy.stats import ortho_group

import design
import margins
import models
import vehicles
from ahv import LinearModel
from harness import Package
from law import Law
from models import Plant
from sampling import sample

# What the example states.
DECIBELS, DEGREES = 0.01, 0.01
# Relative change of a gain to both sides of its margin; twice what the example states.
BESIDE = 0.002
POINTS = 8_000


def plants(package: Package, count: int) -> list[Plant]:
    """Vehicles of the ensemble."""
    with models.linearizer(package.folder) as linearizer:
        full = [models.model(linearizer, **vehicles.parameters(v)) for v in sample(count, 1)]
    return [models.sampled(model, models.STATES[models.SLOSH]) for model in full]


@pytest.fixture(scope="module")
def law(package: Package) -> Law:
    """The autopilot of the example."""
    return design.design(models.model(str(package.folder)))


def jordan() -> LinearModel:
    """Equal lags in series: thirteen equal poles with one eigenvector, most states mixed."""
    states = models.STATES[models.SLOSH]
    n = len(states)
    a = -2.0 * np.eye(n) + np.diag(np.r_[0.0, np.full(n - 2, 2.0)], 1)
    b = np.zeros((n, 2))
    b[-1, 0] = b[0, 1] = 2.0
    mix = np.eye(n)
    mix[4:, 4:] = ortho_group.rvs(n - 4, random_state=1)
    a, b = mix @ a @ mix.T, mix @ b
    trim = dict.fromkeys((*models.MEASURED, "delta_e_trim", "phi_trim", "fuel_mass"), 0.0)
    c = np.eye(n)[[0, 1, 3]]
    inputs = ["delta_e", "phi"]
    return LinearModel(a, b, c, np.zeros((3, 2)), states, inputs, list(models.MEASURED), trim)


def response(system: Plant, z: np.ndarray) -> np.ndarray:
    """Frequency response at the points z, shape (points, outputs, inputs), by direct solution."""
    shifted = z[:, None, None] * np.eye(len(system.A)) - system.A
    return system.C @ np.linalg.solve(shifted, np.broadcast_to(system.B, (len(z), *system.B.shape)))


def by_control(plant: Plant, law: Law, actuator: int) -> tuple[float, ...]:
    """Gain margins, dB, phase margin, deg, and distance, from points of the frequency response."""
    rates = np.geomspace(1e-3, 0.999 * np.pi / law.period_s, POINTS)
    z = np.exp(1j * rates * law.period_s)
    loop = -response(margins.linear(law), z) @ response(plant, z)
    i, o = actuator, 1 - actuator
    broken = loop[:, i, i] - loop[:, i, o] * loop[:, o, i] / (1 + loop[:, o, o])
    points = np.abs(broken), np.degrees(np.unwrap(np.angle(broken))), rates
    gains, phases, *_ = ct.stability_margins(points, returnall=True)
    decibels = 20 * np.log10(np.asarray(gains))
    return (
        max(decibels[decibels < 0], default=-np.inf),
        min(decibels[decibels > 0], default=np.inf),
        min(np.abs(phases), default=np.inf),
        np.abs(1 + broken).min(),
    )


def agree(plant: Plant, law: Law, actuator: int) -> bool:
    """Whether the loop is stable; its margins are those of python-control."""
    found = margins.margins(plant, law, actuator)
    blocks = [ct.ss(*block, 0, law.period_s) for block in (plant, margins.linear(law))]
    poles = ct.feedback(*blocks, 1).poles()
    rates = np.log(poles.astype(complex)) / law.period_s
    assert found.growth_per_s == pytest.approx(rates.real.max(), abs=1e-6)
    if np.abs(poles).max() >= 1.0:
        assert np.isnan(found[:4]).all() and found.growth_per_s > 0.0
        return False
    down, up, phase, distance = by_control(plant, law, actuator)
    assert found.gain_down_db == pytest.approx(down, abs=DECIBELS)
    assert found.gain_up_db == pytest.approx(up, abs=DECIBELS)
    assert found.phase_deg == pytest.approx(phase, abs=DEGREES)
    assert found.distance == pytest.approx(distance, abs=1e-3)
    return True


def test_margins_are_those_of_python_control(package: Package, law: Law) -> None:
    cases = [(plant, actuator) for plant in plants(package, 5) for actuator in (0, 1)]
    stable = [agree(plant, law, actuator) for plant, actuator in cases]
    assert any(stable) and not all(stable)


def test_defective_poles_cost_no_digits() -> None:
    model = jordan()
    plant = models.sampled(model, models.STATES[models.SLOSH])
    # As single eigenvalues they are lost.
    assert np.ptp(np.abs(np.linalg.eigvals(plant.A))) > 1e-3
    assert agree(plant, design.design(model), 0) and agree(plant, design.design(model), 1)


@pytest.mark.parametrize("configuration", [models.RIGID, models.SLOSH])
@pytest.mark.parametrize("actuator", [0, 1])
def test_margins_are_where_the_closed_loop_turns_unstable(
    package: Package, configuration: int, actuator: int
) -> None:
    full = models.model(str(package.folder), configuration=configuration)
    plant = models.sampled(full, models.STATES[configuration])
    law = design.design(full, configuration)
    found = margins.margins(plant, law, actuator)
    assert found.phase_deg > 30.0 and found.distance > 0.5
    for decibels in filter(np.isfinite, (found.gain_down_db, found.gain_up_db)):
        for factor, stable in ((1 - BESIDE, True), (1 + BESIDE, False)):
            gain = np.ones(2)
            gain[actuator] = 10 ** (decibels * factor / 20)
            assert (margins.poles(plant, law, gain).real.max() < 0.0) == stable


def test_ten_times_as_many_frequencies_find_nothing_else(
    package: Package, law: Law, monkeypatch: pytest.MonkeyPatch
) -> None:
    flown = plants(package, 40)
    found = [margins.margins(plant, law) for plant in flown]
    monkeypatch.setattr(margins, "PER_DECADE", 10 * margins.PER_DECADE)
    monkeypatch.setattr(margins, "ABOUT", np.tan(np.linspace(-0.499, 0.499, 160) * np.pi))
    for plant, before in zip(flown, found, strict=True):
        assert margins.margins(plant, law) == pytest.approx(before, abs=1e-4, nan_ok=True)


def test_a_curve_that_rounding_has_falsified_is_refused(package: Package, law: Law) -> None:
    curve = margins.Curve(margins.loop(plants(package, 1)[0], law), 0)
    rates = np.array([0.1, 10.0])
    curve.check(rates)
    curve.zeros = curve.zeros * (1 + 1e-5)
    with pytest.raises(margins.Inexact, match="the Nyquist curve is wrong by"):
        curve.check(rates)
