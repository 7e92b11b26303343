"""What a worker does: fly some vehicles of the ensemble in closed loop, and find their margins."""

from __future__ import annotations

import tempfile
import time
import zipfile
from contextlib import suppress
from functools import cache
from io import BytesIO
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

import flight
import models
from ahv import FMUError, Linearizer
from law import Law
from loop import Loop
from margins import Margins, margins
from vehicles import VARIED, parameters

# What a flight adds to the parameters that vary; missing where there is no flight.
MARGINS = Margins._fields
NUMBERS = ("saturated_steps", "delta_e_trim", "slosh_largest_m", "n_z_largest")
HISTORIES = ("V_m_per_s", "gamma_rad")
NOTHING = dict.fromkeys((*MARGINS, *NUMBERS, *HISTORIES))
# Columns of flights, also for vehicles without trim, which have none.
SCHEMA = pa.schema(
    [(name, pa.float64()) for name in (*VARIED, *MARGINS, *NUMBERS, "flown_s")]
    + [(name, pa.list_(pa.float64())) for name in HISTORIES]
    + [("trimmed", pa.bool_()), ("ended", pa.string())]
)
KEY = b"ensemble"
OUTPUTS = ("V", "gamma", "slosh1", "slosh2", "n_z", "saturated")
# Communication step, of which the largest slosh and load are taken, and interval of histories.
STEP_S, SAMPLE_S = 0.02, 0.5
# Level flight of a vehicle, which the autopilot is told.
LEVEL = {"V_level": "V", "delta_e_trim": "delta_e_trim", "phi_trim": "phi_trim"}


class Loaded(NamedTuple):
    """The FMUs: the container of the loop, and the vehicle for its linear models."""

    loop: bytes
    vehicle: bytes


class Task(NamedTuple):
    """What else a worker needs; `commands` are parameters of the container."""

    law: Law
    commands: dict[str, float]
    stop_s: float
    identity: bytes
    vehicles: np.ndarray


def unzipped(fmu: bytes) -> tempfile.TemporaryDirectory[str]:
    """The FMU's folder."""
    folder = tempfile.TemporaryDirectory(prefix="ahv_")
    with zipfile.ZipFile(BytesIO(fmu)) as archive:
        archive.extractall(folder.name)
    return folder


@cache
def opened_loop(fmu: bytes) -> tuple[Loop, tempfile.TemporaryDirectory[str]]:
    """An instance, made once in every worker, and the folder that is removed with it."""
    folder = unzipped(fmu)
    return Loop(folder.name, OUTPUTS), folder


@cache
def opened_vehicle(fmu: bytes) -> tuple[Linearizer, tempfile.TemporaryDirectory[str]]:
    """The same of the vehicle alone."""
    folder = unzipped(fmu)
    return models.linearizer(folder.name), folder


def fly_part(fmus: Loaded, task: Task) -> tuple[bytes, float]:
    """A Parquet file of the task's flights, and the seconds that they took, once all is loaded."""
    opened_loop(fmus.loop)
    begin = time.monotonic()
    table = pa.Table.from_pylist(fly_all(fmus, task), SCHEMA)
    with BytesIO() as file:
        pq.write_table(table.replace_schema_metadata({KEY: task.identity}), file)
        return file.getvalue(), time.monotonic() - begin


def fly_all(fmus: Loaded, task: Task) -> list[dict[str, object]]:
    """One row for every vehicle: what varied, margins at the elevator, and the flight."""
    loop, linearizer = opened_loop(fmus.loop)[0], opened_vehicle(fmus.vehicle)[0]
    return [fly_one(loop, linearizer, task, vehicle) for vehicle in task.vehicles]


def margins_of(linearizer: Linearizer, law: Law, vehicle: np.ndarray) -> tuple[Margins, dict]:
    """Margins at the elevator, and level flight; or FMUError."""
    full = models.model(linearizer, **parameters(vehicle))
    plant = models.sampled(full, models.STATES[models.SLOSH], law.period_s)
    return margins(plant, law), full.trim


def margins_part(vehicle_fmu: bytes, law: Law, vehicles: np.ndarray) -> np.ndarray:
    """Distances of the Nyquist curves from -1; 0 if the loop is unstable, or there is no trim."""
    linearizer, _ = opened_vehicle(vehicle_fmu)
    distances = np.zeros(len(vehicles))
    for i, vehicle in enumerate(vehicles):
        with suppress(FMUError):
            distances[i] = margins_of(linearizer, law, vehicle)[0].distance
    return np.nan_to_num(distances)


def fly_one(
    loop: Loop, linearizer: Linearizer, task: Task, vehicle: np.ndarray
) -> dict[str, object]:
    """Margins and flight of one vehicle."""
    varied = dict(zip(VARIED, vehicle.tolist(), strict=True))
    try:
        found, trim = margins_of(linearizer, task.law, vehicle)
        flown = loop.fly(setting(task.commands, trim, vehicle), task.stop_s, STEP_S)
    # By module: a cluster reloads modules it is sent, and the class is then another one.
    except (FMUError, flight.NoFlight) as refused:
        return varied | NOTHING | {"trimmed": False, "ended": str(refused), "flown_s": 0.0}
    rows, every = flown.rows, round(SAMPLE_S / STEP_S)
    return (
        varied
        | found._asdict()
        | {
            "trimmed": True,
            "ended": flown.ended,
            "flown_s": len(rows) * STEP_S,
            "saturated_steps": float(rows[-1, 6]) if len(rows) else 0.0,
            "delta_e_trim": trim["delta_e_trim"],
            "slosh_largest_m": float(np.abs(rows[:, 3:5]).max(initial=0.0)),
            "n_z_largest": float(rows[:, 5].max(initial=0.0)),
            "V_m_per_s": [trim["V"], *rows[every - 1 :: every, 1].tolist()],
            "gamma_rad": [trim["gamma"], *rows[every - 1 :: every, 2].tolist()],
        }
    )


def setting(
    commands: dict[str, float], trim: dict[str, float], vehicle: np.ndarray
) -> dict[str, float]:
    """Parameters of the container: what is wanted, level flight, and the vehicle."""
    return (
        commands
        | {f"autopilot.{name}": trim[own] for name, own in LEVEL.items()}
        | {f"vehicle.{name}": value for name, value in parameters(vehicle).items()}
    )
