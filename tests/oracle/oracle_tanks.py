"""Tanks, their sloshing masses and what these do to the modes, for the test oracle.

SI units, per metre of vehicle width.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from oracle_structure import Modes


@dataclass(frozen=True)
class Tank:
    """One tank: masses in kg/m, lengths in m, stiffness in N/m per m, damping in N s/m per m."""

    centre: float
    length: float
    slosh_mass: float
    frozen_mass: float
    omega: float
    stiffness: float
    damping: float


def tanks(
    data: Any, total_mass: float, fuel: float, damping: float, frequency: float, g_eff: float
) -> list[Tank]:
    """Sloshing and frozen liquid of each tank (Graham and Rodriguez 1952, first mode).

    total_mass kg/m of the full vehicle, damping ratio, frequency rad/s (0: geometry), g_eff m/s^2.
    """
    residual = data["mass"]["residual_fraction"]
    level = residual + (1.0 - residual) * fuel
    found = []
    for tank in data["tank"]:
        mass = tank["share"] * data["mass"]["propellant_fraction"] * total_mass * level
        bay = tank["bay_length_m"]
        ratio = tank["depth_full_m"] * level / bay
        slosh = mass * 8.0 * np.tanh(np.pi * ratio) / (np.pi**3 * ratio)
        omega = np.sqrt(g_eff * np.pi / bay * np.tanh(np.pi * ratio))
        omega = frequency if frequency > 0.0 else omega
        found.append(
            Tank(
                tank["centre_m"],
                tank["length_m"],
                float(slosh),
                float(mass - slosh),
                float(omega),
                float(slosh * omega**2),
                float(2.0 * damping * slosh * omega),
            )
        )
    return found


def modal_damping(held: list[Tank], modes: Modes, structural: Sequence[float]) -> np.ndarray:
    """Modal damping matrix D in 1/s: tank dampers, and the structure by its strain energy."""
    mass, omega, rel = modes.mass, modes.omega, modes.rel
    c, k = np.array([t.damping for t in held]), np.array([t.stiffness for t in held])
    in_beam = 1.0 - k @ rel**2 / (omega**2 * mass)
    tank_part = (rel.T * c) @ rel / mass[:, None]
    # Flexible modes have ratios of their own; slosh modes take that of the first.
    ratio = np.concatenate([structural, [structural[0]] * 2])[: len(omega)]
    return tank_part + np.diag(2.0 * ratio * omega * in_beam)


def modal_floor(held: list[Tank], modes: Modes, g_eff: float) -> np.ndarray:
    """Modal acceleration in m/s^2 of the floors of the tanks, which carry the liquid at rest.

    The weight m1_j g_eff of a sloshing mass rests on the floor, not on the spring: a constant force
    upwards on the mass and downwards on the node of its tank. Its power in mode i is
    m1_j g_eff rel[j, i] eta_i'. The pair adds up to nothing on the rigid body.
    """
    weight = np.array([tank.slosh_mass * g_eff for tank in held])
    return weight @ modes.rel / modes.mass
