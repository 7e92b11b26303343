"""Factors on the data and offsets of the start, by the names of the FMU's parameters."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import numpy as np

FACTORS = {
    **{"mass_factor": 1.0, "inertia_factor": 1.0, "density_factor": 1.0, "lift_factor": 1.0},
    **{"drag_factor": 1.0, "moment_alpha_factor": 1.0, "elevator_factor": 1.0},
    **{"thrust_factor": 1.0, "elastic_factor": 1.0, "stiffness_factor": 1.0},
    **{"structural_damping_factor": 1.0, "mass_centre_shift": 0.0, "pitch_rate_factor": 0.0},
}
OFFSETS = (
    *("alpha_offset", "q_offset"),
    *(f"eta{i}{dot}_offset" for i in (1, 2, 3) for dot in ("", "_dot")),
    *(f"slosh{j}{dot}_offset" for j in (1, 2) for dot in ("", "_dot")),
)
IN_ALPHA = ("constant", "alpha", "alpha2")
IN_DELTA = ("delta_e", "delta_e2", "delta_e3", "alpha_delta_e")


def chosen(given: dict[str, float]) -> tuple[dict[str, float], dict[str, float]]:
    """All factors and all offsets, the given ones in place of the defaults."""
    offsets = dict.fromkeys(OFFSETS, 0.0)
    unknown = sorted(given.keys() - FACTORS.keys() - offsets.keys())
    if unknown:
        raise TypeError(f"no such parameter: {', '.join(unknown)}")
    factors = {name: float(given.get(name, value)) for name, value in FACTORS.items()}
    return factors, {name: float(given.get(name, value)) for name, value in offsets.items()}


def applied(data: Any, earth: Any, aero: Any, factors: dict[str, float]) -> tuple[Any, Any, Any]:
    """Copies of vehicle, earth and coefficients that carry the factors."""
    data, earth, aero = (deepcopy(table) for table in (data, earth, aero))

    def scale(table: dict[str, Any], name: str, *keys: str) -> None:
        for key in keys:
            if key in table:
                value = np.multiply(table[key], factors[name])
                table[key] = value.tolist()

    scale(data["mass"], "mass_factor", "fore_beam_kg_per_m2", "aft_beam_kg_per_m2")
    scale(data["beam"], "stiffness_factor", "stiffness_n_m2_per_m")
    scale(earth["air"], "density_factor", "sea_level_pressure_pa")
    scale(aero["inertia"], "inertia_factor", "i_yy_kg_m2_per_m")
    scale(aero["inertia"], "structural_damping_factor", "structural_damping")
    scale(aero["reference"], "elastic_factor", "elastic_scale")
    for force in ("lift", "drag"):
        scale(aero[force], f"{force}_factor", *IN_ALPHA)
        fuel = aero.get(f"{force}_phi", {})
        scale(fuel, f"{force}_factor", *fuel)
    scale(aero["moment"], "moment_alpha_factor", "alpha", "alpha2")
    for force in ("lift", "drag", "moment"):
        scale(aero[force], "elevator_factor", *IN_DELTA)
    for force in ("thrust", "thrust_phi"):
        scale(aero[force], "thrust_factor", *aero[force])
    return data, earth, aero
