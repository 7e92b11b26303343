"""The example of gusts: the air is what it says it is, and the loop holds in it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.signal import welch

import air
import gusts
from ahv import linear_model
from harness import Package

SIGMA, SPEED, PERIOD_S = 1.5, 2400.0, 0.01


def spectrum(rate: np.ndarray | float) -> np.ndarray | float:
    """MIL-F-8785C, 3.7.1.2, vertical, m^2/s^2 per rad/s, of positive rates in rad/s."""
    s = air.SCALE_M * rate / SPEED
    return SIGMA**2 * air.SCALE_M / (np.pi * SPEED) * (1 + 3 * s**2) / (1 + s**2) ** 2


def test_filter_has_the_spectrum_of_the_specification() -> None:
    a, b, c = air.filter_of(SIGMA, SPEED)
    for rate in (0.1, 1.0, 4.5, 10.0, 100.0):
        gain = c @ np.linalg.solve(1j * rate * np.eye(2) - a, b)
        # One-sided, per rad/s, of noise with unit intensity.
        assert np.abs(gain) ** 2 / np.pi == pytest.approx(spectrum(rate), rel=1e-12)
    assert quad(spectrum, 0.0, np.inf)[0] == pytest.approx(SIGMA**2, rel=1e-6)


def test_turbulence_has_that_spectrum_too() -> None:
    steps = 1 << 19
    w = air.turbulence(SIGMA, SPEED, steps, PERIOD_S)
    assert len(w) == steps + 1
    # Standard deviation of the estimate: about 1 % over some 20,000 correlation times.
    assert w.std() == pytest.approx(SIGMA, rel=0.04)
    hertz, found = welch(w, 1.0 / PERIOD_S, nperseg=4096)
    band = (hertz > 0.2) & (hertz < 10.0)
    wanted = 2.0 * np.pi * spectrum(2.0 * np.pi * hertz[band])
    # Averaging 256 windows leaves an error of 6 % per bin, hardly any in the mean of 400.
    assert np.mean(found[band] / wanted) == pytest.approx(1.0, abs=0.03)


def test_gust_is_one_minus_cosine() -> None:
    w = air.gust(5.0, 240.0, SPEED, 100, PERIOD_S, 0.5)
    assert w[50] == 0.0 and w[55] == pytest.approx(2.5) and w[60] == pytest.approx(5.0)
    assert w[:50].max() == w[70:].max() == 0.0


def test_a_short_gust_loads_the_vehicle_as_its_lift_slope_says(package: Package) -> None:
    """Before the vehicle turns, w is a change of incidence by w / V and nothing else."""
    folder = str(package.folder)
    law, _ = gusts.autopilots(folder)
    model = linear_model(folder, ("n_z",))
    slope = model.C[0, model.states.index("alpha")]
    w = gusts.vertical(air.gust(1.0, 107.0, law.level[0], 30, law.period_s, 0.0))
    met = gusts.away(folder, gusts.meet(folder, law, w), w)
    load = met[:, gusts.COLUMNS.index("n_z_g")].max()
    # The peak is between two points, and the vehicle has started to pitch up.
    assert load == pytest.approx(slope / law.level[0], rel=0.04)


def test_a_short_gust_from_ahead_loads_the_vehicle_as_its_pressure_says(package: Package) -> None:
    """u is a change of speed and nothing else: the coefficients of this set know no Mach number."""
    folder = str(package.folder)
    law, _ = gusts.autopilots(folder)
    lengthwise = air.gust(5.0, 107.0, law.level[0], 30, law.period_s, 0.0)
    met = gusts.away(
        folder,
        gusts.meet(folder, law, np.column_stack([0.0 * lengthwise, -lengthwise])),
        np.column_stack([0.0 * lengthwise, -lengthwise]),
    )
    model = linear_model(folder, ("n_z",))
    slope = model.C[0, model.states.index("V")]
    load = met[:, gusts.COLUMNS.index("n_z_g")].max()
    assert load == pytest.approx(5.0 * slope, rel=0.1)


def test_air_that_rises_for_long_only_turns_the_vehicle_into_its_wind(package: Package) -> None:
    folder = str(package.folder)
    law, _ = gusts.autopilots(folder)
    rise = np.minimum(np.arange(12_001) * law.period_s / 20.0, 1.0)
    w = gusts.vertical(rise * gusts.PEAK_M_PER_S)
    flight = gusts.meet(folder, law, w)
    assert not flight.ended
    met = dict(zip(gusts.COLUMNS, gusts.away(folder, flight, w)[-1], strict=True))
    # Remainder from the speed, not yet settled, and the change of height.
    assert abs(met["incidence_deg"]) < 2e-3 and abs(met["n_z_g"]) < 1e-3
    turned = flight.rows[-1, 4] - flight.rows[0, 4]
    assert turned == pytest.approx(-gusts.PEAK_M_PER_S / law.level[0], rel=0.02)


def test_the_loop_holds_where_the_vehicle_alone_is_lost(package: Package) -> None:
    folder = str(package.folder)
    law, idle = gusts.autopilots(folder)
    severe = max(air.SIGMA_M_PER_S.values())
    w = gusts.vertical(air.turbulence(severe, law.level[0], 1000, law.period_s))
    held, free = (gusts.meet(folder, pilot, w) for pilot in (law, idle))
    assert not held.ended and len(held.rows) == 1000
    assert "alpha" in free.ended and free.rows[-1, 0] < 5.0
    load = gusts.away(folder, held, w)[:, gusts.COLUMNS.index("n_z_g")]
    # Within five standard deviations of the values in the example's README.
    assert np.abs(load).max() < 5 * 0.0241


def test_example_runs(package: Package, tmp_path: Path) -> None:
    command = [sys.executable, gusts.__file__, "--fmu", str(package.path), "--stop", "20"]
    run = subprocess.run(
        [*command, "--output", str(tmp_path)], capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    assert "without autopilot lost" in run.stdout
    assert (tmp_path / "gusts.png").stat().st_size > 10_000
    largest = np.genfromtxt(tmp_path / "largest.csv", delimiter=",", names=True)
    assert sorted(set(largest["gradient_m"])) == gusts.GRADIENTS_M
    flight = np.genfromtxt(tmp_path / "gust_428_0.05.csv", delimiter=",", names=True)
    assert np.abs(flight["n_z_g"]).max() == largest["n_z_g"][largest["gradient_m"] == 428][0]
