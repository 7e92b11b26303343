"""Vertical velocity of the air over time: Dryden turbulence and single gusts, m/s."""

from __future__ import annotations

import numpy as np
from scipy.linalg import cholesky, expm, solve_continuous_lyapunov

FOOT = 0.3048
# MIL-F-8785C, 3.7.2.1: scale of all components above 2000 ft.
SCALE_M = 1750.0 * FOOT
# MIL-F-8785C, fig. 7: standard deviation at 80,000 ft, its highest altitude, exceeded with this
# probability. 1e-5 is severe; light (1e-2) and moderate (1e-3) turbulence is zero there.
SIGMA_M_PER_S = {"1e-4": 2.1 * FOOT, "1e-5": 5.1 * FOOT}


def filter_of(sigma: float, speed: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """a, b, c of the Dryden filter x' = a x + b n, w = c x; n is white noise of unit intensity.

    MIL-F-8785C, 3.7.1.2: Phi(omega) = sigma^2 L/(pi V) (1 + 3 s^2) / (1 + s^2)^2, s = L omega / V,
    for omega > 0; its integral is sigma^2. `speed` V, m/s, through air that is frozen meanwhile.
    """
    tau = SCALE_M / speed
    a = np.array([[0.0, 1.0], [-1.0 / tau**2, -2.0 / tau]])
    b = np.array([0.0, 1.0])
    c = sigma * np.sqrt(tau) / tau**2 * np.array([1.0, np.sqrt(3.0) * tau])
    return a, b, c


def turbulence(
    sigma: float, speed: float, steps: int, period_s: float, seed: int = 1
) -> np.ndarray:
    """Stationary w at steps + 1 points, with the exact distribution for any period."""
    a, b, c = filter_of(sigma, speed)
    settled = solve_continuous_lyapunov(a, -np.outer(b, b))
    move = expm(a * period_s)
    kick = cholesky(settled - move @ settled @ move.T, lower=True)
    noise = np.random.default_rng(seed).standard_normal((steps + 1, 2))
    states = [cholesky(settled, lower=True) @ noise[0]]
    for pair in noise[1:]:
        states.append(move @ states[-1] + kick @ pair)
    return np.array(states) @ c


def gust(
    peak: float, gradient_m: float, speed: float, steps: int, period_s: float, start_s: float
) -> np.ndarray:
    """One minus cosine, as in CS-25.341(a)(2), at steps + 1 points: `peak`, m/s, is reached after
    the way `gradient_m`, and again as much later all is over.
    """
    way = (np.arange(steps + 1) * period_s - start_s) * speed / gradient_m
    return np.where((way > 0.0) & (way < 2.0), peak / 2.0 * (1.0 - np.cos(np.pi * way)), 0.0)
