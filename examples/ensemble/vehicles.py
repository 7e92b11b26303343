"""The vehicles of the ensemble: which parameters vary, and how far."""

from __future__ import annotations

import numpy as np

# Varied parameters of the FMU with their limits; uniform, slosh_damping in its logarithm.
VARIED = {
    "fuel_fraction": (0.2, 1.0),
    "slosh_damping": (0.005, 0.1),
    "slosh_frequency": (4.0, 12.0),
    "aero": (1, 3),
    "elevator_factor": (0.8, 1.2),
    "moment_alpha_factor": (0.8, 1.2),
    "mass_factor": (0.95, 1.05),
    "inertia_factor": (0.8, 1.2),
    "density_factor": (0.85, 1.15),
    "mass_centre_shift": (-0.3, 0.3),
    "pitch_rate_factor": (0.0, 1.0),
}
SETS = ("xu2015", "parker2007", "shock_expansion")


def scaled(unit: np.ndarray) -> np.ndarray:
    """Vehicles, shape (n, parameters), of points in the unit cube."""
    columns = []
    for (name, (low, high)), part in zip(VARIED.items(), unit.T, strict=True):
        if name == "aero":
            columns.append(np.minimum(low + np.floor((high - low + 1) * part), high))
        elif name == "slosh_damping":
            columns.append(low * (high / low) ** part)
        else:
            columns.append(low + (high - low) * part)
    return np.column_stack(columns)


def parameters(vehicle: np.ndarray) -> dict[str, float | int]:
    """Parameters of the FMU of one vehicle."""
    values = dict(zip(VARIED, vehicle.tolist(), strict=True))
    return values | {"aero": int(values["aero"])}
