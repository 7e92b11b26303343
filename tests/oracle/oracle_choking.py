"""How much fuel the burner can take before it chokes, for the test oracle.

The engine of the first-principles model: oblique shocks at the fore-body and at the inlet (theta,
beta, M), an isentropic diffuser, heat at constant area (Rayleigh). SI units, rad, per metre of
vehicle width. Functions accept complex arguments, for the complex-step derivative.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import brentq, minimize_scalar

TINY = 1e-30  # complex step


def root(f: Callable[..., Any], low: float, high: float, *given: Any) -> Any:
    """Where f(z, *given) is zero between low and high; follows complex steps of what is given."""
    real = tuple(float(np.real(value)) for value in given)
    z = brentq(f, low, high, args=real, xtol=1e-15, rtol=1e-15)
    slope = np.imag(f(z + 1j * TINY, *real)) / TINY
    return z - f(z, *given) / slope


def deflection(beta: Any, mach: Any, gamma: float) -> Any:
    """Angle by which a shock at the angle beta turns a stream."""
    across = (mach * np.sin(beta)) ** 2
    return np.arctan(
        2.0 / np.tan(beta) * (across - 1.0) / (mach**2 * (gamma + np.cos(2.0 * beta)) + 2.0)
    )


def shocked(mach: Any, turn: Any, gamma: float) -> tuple[Any, Any] | None:
    """Mach number and mass flux, over that before, behind the weak shock; None if detached."""
    real = float(np.real(mach))
    if real <= 1.0:
        return None
    limits = (np.arcsin(1.0 / real), np.pi / 2.0)
    top = minimize_scalar(
        lambda beta: -deflection(beta, real, gamma), bounds=limits, options={"xatol": 1e-12}
    ).x
    if deflection(top, real, gamma) <= np.real(turn):
        return None
    beta = root(lambda b, m, t: deflection(b, m, gamma) - t, limits[0], top, mach, turn)
    across = (mach * np.sin(beta)) ** 2
    density = (gamma + 1.0) * across / ((gamma - 1.0) * across + 2.0)
    warmer = (1.0 + 2.0 * gamma / (gamma + 1.0) * (across - 1.0)) / density
    left = ((gamma - 1.0) * across + 2.0) / (2.0 * gamma * across - (gamma - 1.0))
    behind = np.sqrt(left) / np.sin(beta - turn)
    return behind, density * np.sqrt(warmer) * behind / mach


def area(mach: Any, gamma: float) -> Any:
    """Area over that of the throat."""
    ratio = (2.0 + (gamma - 1.0) * mach**2) / (gamma + 1.0)
    return ratio ** ((gamma + 1.0) / (2.0 * (gamma - 1.0))) / mach


def margin(data: Any, gamma: float, mach: Any, sound: Any, inflow: Any, phi: Any) -> Any:
    """Fuel ratio that can be added at this Mach number, speed of sound m/s and incidence rad.

    `data` is the vehicle's. Where no supersonic stream reaches the burner, nothing can be burnt.
    """
    engine, lower = data["engine"], data["outline"]["lower_angle_rad"]
    duct, body = engine["duct_height_m"], data["geometry"]["fore_body_m"]
    along = shocked(mach, inflow + lower, gamma)
    inside = along and shocked(along[0], lower, gamma)
    if not along or not inside:
        return -phi
    # Height of the free stream that the lip takes: within the shock layer, or below the bow shock.
    layer = along[1] * duct * np.cos(lower)
    whole = body * np.sin(inflow) + (body * np.tan(lower) + duct) * np.cos(inflow)
    captured = layer if np.real(layer) < np.real(whole) else whole
    entered = captured / (along[1] * inside[1])
    squeezed = duct / engine["nozzle_area_ratio"] / entered
    wanted = area(inside[0], gamma) * squeezed
    if np.real(inside[0]) <= 1.0 or np.real(wanted) <= 1.0:
        return -phi
    burner = root(lambda m, a: area(m, gamma) - a, 1.0, 50.0, wanted)
    most = (1.0 + gamma * burner**2) ** 2
    rise = most / ((gamma + 1.0) * burner**2 * (2.0 + (gamma - 1.0) * burner**2)) - 1.0
    heat = (
        engine["stoichiometric_ratio"]
        * engine["combustion_efficiency"]
        * engine["heating_value_j_per_kg"]
    )
    total = sound**2 * (1.0 / (gamma - 1.0) + mach**2 / 2.0)
    return total * rise / heat - phi
