"""The worst flights of an ensemble flown again, each from its row alone, and drawn.

By default the one that ended first, the one that grew fastest but flew to the end, and the stable
one with the least phase margin.
"""

from __future__ import annotations

import sys
from pathlib import Path

try:
    import matplotlib
    import numpy as np
    import pyarrow as pa

    import ensemble
    from batch import (
        OUTPUTS,
        SAMPLE_S,
        SCHEMA,
        STEP_S,
        Loaded,
        Task,
        margins_of,
        opened_vehicle,
        setting,
        unzipped,
    )
    from loop import Flown, Loop
    from summary import COLUMNS
    from vehicles import SETS, VARIED
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt

DRAWN = (*OUTPUTS, "delta_e_effective")
PANELS = [
    ("$\\gamma$, deg", "gamma", np.degrees(1.0)),
    ("$\\delta_e$, deg", "delta_e_effective", np.degrees(1.0)),
    ("fore slosh, m", "slosh1", 1.0),
    ("aft slosh, m", "slosh2", 1.0),
]


def worst(table: pa.Table) -> dict[str, int]:
    """Numbers of the worst flights, by what is bad about them."""
    trimmed = table["trimmed"].to_numpy()
    ended = trimmed & (table["ended"].to_numpy() != "")
    columns = {
        name: table[name].to_numpy().astype(float)
        for name in ("flown_s", "growth_per_s", "phase_deg")
    }
    marks = {
        "ended first": np.where(ended, columns["flown_s"], np.inf),
        "fastest growth": np.where(trimmed & ~ended, -columns["growth_per_s"], np.inf),
        "least phase margin": np.nan_to_num(columns["phase_deg"], nan=np.inf),
    }
    return {what: int(mark.argmin()) for what, mark in marks.items() if np.isfinite(mark).any()}


def fly(fmus: Loaded, task: Task, row: dict[str, object]) -> Flown:
    """The flight of a row, of which only the varied parameters are used."""
    vehicle = np.array([row[name] for name in VARIED])
    _, trim = margins_of(opened_vehicle(fmus.vehicle)[0], task.law, vehicle)
    with unzipped(fmus.loop) as folder, Loop(folder, DRAWN) as loop:
        return loop.fly(setting(task.commands, trim, vehicle), task.stop_s, STEP_S)


def same(flown: Flown, row: dict[str, object]) -> bool:
    """Whether the flight is that of the row, bit for bit."""
    every = round(SAMPLE_S / STEP_S)
    kept = flown.rows[every - 1 :: every]
    return (
        kept[:, 1].tolist() == row["V_m_per_s"][1:]
        and kept[:, 2].tolist() == row["gamma_rad"][1:]
        and flown.ended == row["ended"]
    )


def label(what: str, row: dict[str, object]) -> str:
    """A title of a few lines."""
    margin = row["phase_deg"]
    is_stable = not np.isnan(margin)
    state = f"margin {margin:.2f} deg" if is_stable else f"unstable, {row['growth_per_s']:+.2f} 1/s"
    return (
        f"{what}\n{state}\n{SETS[int(row['aero']) - 1]}, fuel {row['fuel_fraction']:.2f}\n"
        f"slosh {row['slosh_frequency']:.1f} rad/s, {100 * row['slosh_damping']:.1f} %"
    )


def picture(flights: list[tuple[str, dict[str, object], Flown]], path: Path) -> None:
    """A column of panels for each flight."""
    size = (3.2 * len(flights), 7)
    figure, axes = plt.subplots(
        len(PANELS), len(flights), figsize=size, sharex=True, layout="constrained", squeeze=False
    )
    for column, (what, row, flown) in zip(axes.T, flights, strict=True):
        column[0].set_title(label(what, row), fontsize=9)
        for axis, (name, output, factor) in zip(column, PANELS, strict=True):
            axis.plot(flown.rows[:, 0], factor * flown.rows[:, 1 + DRAWN.index(output)], lw=1)
            axis.grid(alpha=0.3)
            if column is axes.T[0] or axis in axes.T[0]:
                axis.set_ylabel(name)
        column[-1].set_xlabel("time, s")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main() -> None:
    """Command line."""
    parser = ensemble.arguments()
    parser.add_argument("--number", type=int, nargs="+", help="of the flights; default: the worst")
    options = parser.parse_args()
    fmus, task, vehicles, parts = ensemble.prepare(options)
    parts.find()
    if parts.missing():
        sys.exit(f"error: {options.output} is not complete: run ensemble.py with the same options")
    if beyond := [n for n in options.number or () if not 0 <= n < len(vehicles)]:
        sys.exit(f"error: there is no flight {beyond[0]}: 0 to {len(vehicles) - 1} are there")
    numbers = {f"flight {n}": n for n in options.number or ()}
    numbers = numbers or worst(parts.table([*COLUMNS, "flown_s"]))
    table, flights = parts.table(SCHEMA.names), []
    for what, number in numbers.items():
        (row,) = table.slice(number, 1).to_pylist()
        if not row["trimmed"]:
            sys.exit(f"error: flight {number} has no trim: {row['ended']}")
        flown = fly(fmus, task, row)
        if not same(flown, row):
            sys.exit(f"error: flight {number} is another one than in {parts.folder}")
        flights.append((what, row, flown))
        print(f"flight {number}, {what}: as in the ensemble, bit for bit", end="")
        print(f"; ended: {flown.ended}" if flown.ended else "")
    image = options.output / "worst.png"
    picture(flights, image)
    print(image)


if __name__ == "__main__":
    main()
