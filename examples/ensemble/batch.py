"""What a worker does: fly a few vehicles of the ensemble in closed loop, and find their margins."""

from __future__ import annotations

import tempfile
import zipfile
from functools import cache
from io import BytesIO
from typing import NamedTuple

import numpy as np

import design
import flight
from law import Law
from margins import Margins, margins

# What a flight adds to the parameters that vary; missing where there is no flight.
MARGINS = Margins._fields
NUMBERS = ("saturated_steps", "delta_e_trim", "slosh_largest_m", "n_z_largest")
HISTORIES = ("V_m_per_s", "gamma_rad")
NOTHING = dict.fromkeys((*MARGINS, *NUMBERS, *HISTORIES))
OUTPUTS = ("slosh1", "slosh2", "n_z")
SAMPLE_EVERY = 50  # steps between the kept points of a flight


class Task(NamedTuple):
    """Everything a worker needs."""

    fmu: bytes
    law: Law
    commands: np.ndarray  # (steps, 2) change of V, m/s, and gamma, rad
    vehicles: list[dict[str, float]]


@cache
def unpacked(fmu: bytes) -> tempfile.TemporaryDirectory:
    """The FMU's folder, made once in every worker and removed with it."""
    folder = tempfile.TemporaryDirectory(prefix="ahv_")
    with zipfile.ZipFile(BytesIO(fmu)) as archive:
        archive.extractall(folder.name)
    return folder


def fly_all(task: Task) -> list[dict[str, object]]:
    """One row for every vehicle: what varied, margins at the elevator, and the flight."""
    folder = unpacked(task.fmu).name
    return [fly_one(folder, task.law, task.commands, vehicle) for vehicle in task.vehicles]


def fly_one(
    folder: str, law: Law, commands: np.ndarray, vehicle: dict[str, float]
) -> dict[str, object]:
    """Margins and flight of one vehicle."""
    parameters = vehicle | {"aero": int(vehicle["aero"])}
    # By module: a cluster reloads modules it is sent, and the class is then another one.
    try:
        flown = flight.fly(folder, law, commands, OUTPUTS, **parameters)
    except flight.NoFlight as refused:
        return vehicle | NOTHING | {"trimmed": False, "ended": str(refused), "flown_s": 0.0}
    full = design.model(folder, **parameters)
    plant = design.sampled(full, design.STATES[design.SLOSH])
    found = margins(plant, law)
    rows = flown.rows
    return (
        vehicle
        | {name: float(value) for name, value in found._asdict().items()}
        | {
            "trimmed": True,
            "ended": flown.ended,
            "flown_s": len(rows) * law.period_s,
            "saturated_steps": float(flown.pilot.saturated),
            "delta_e_trim": full.trim["delta_e_trim"],
            "slosh_largest_m": float(np.abs(rows[:, 4:6]).max(initial=0.0)),
            "n_z_largest": float(rows[:, 6].max(initial=0.0)),
            "V_m_per_s": rows[::SAMPLE_EVERY, 1].tolist(),
            "gamma_rad": rows[::SAMPLE_EVERY, 2].tolist(),
        }
    )
