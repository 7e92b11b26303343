"""Effect of sloshing on the loop: margins over fuel, slosh damping and slosh frequency.

Four autopilots: designed without flexibility, without slosh, with the nominal slosh, and for each
vehicle. The hardest case is flown with the first and the last of them.
"""

from __future__ import annotations

import argparse
import csv
import sys
from pathlib import Path

try:
    import matplotlib
    import numpy as np
    from fmpy import extract

    import command_line
    import design
    import models
    from flight import Flight, fly, wanted
    from margins import cell, margins
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt

LAWS = ("rigid", "no slosh", "slosh", "redesigned")
LIGHT = 0.01  # damping ratio of a tank without baffles
SWEEPS = {
    "fuel_fraction": ({}, [0.0, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0]),
    "slosh_damping": ({}, [0.001, 0.003, 0.01, 0.03, 0.05, 0.1, 0.3]),
    "slosh_frequency": (
        {},
        [2, 3, 4, 5, 6, 7, 8, 10, 12, 15, 17, 18, 19, 20, 21, 22, 23, 24, 26, 30],
    ),
    "slosh_frequency, damping 0.01": (
        {"slosh_damping": LIGHT},
        [2, 3, 4, 5, 6, 7, 8, 10, 12, 15, 17, 18, 19, 20, 21, 22, 23, 24, 26, 30],
    ),
}
# Slosh within the bandwidth of the loop, with little damping.
HARD = {"slosh_frequency": 4.0, "slosh_damping": LIGHT}


def study(folder: str, points: int | None = None) -> list[dict[str, float | str]]:
    """One row per point of each sweep and law."""
    nominal = [
        design.design(models.rigid_model(folder), models.RIGID),
        design.design(design.model(folder, configuration=models.EVEN), models.EVEN),
        design.design(design.model(folder)),
    ]
    rows = []
    for sweep, (fixed, values) in SWEEPS.items():
        for value in values[:points]:
            parameters = fixed | {sweep.split(",")[0]: float(value)}
            full = design.model(folder, **parameters)
            plant = design.sampled(full, design.STATES[design.SLOSH])
            for name, law in zip(LAWS, [*nominal, design.design(full)], strict=True):
                row = {"sweep": sweep, "value": value, "law": name}
                rows.append(row | margins(plant, law)._asdict())
    return rows


def show(rows: list[dict[str, float | str]]) -> None:
    """The margins at the elevator as a table."""
    for sweep in SWEEPS:
        print(f"\n| {sweep} | " + " | ".join(LAWS) + " |")
        print("|---" * (1 + len(LAWS)) + "|")
        for value in SWEEPS[sweep][1]:
            cells = [r for r in rows if r["sweep"] == sweep and r["value"] == value]
            if cells:
                print(f"| {value:g} | " + " | ".join(map(cell, cells)) + " |")


def picture(rows: list[dict[str, float | str]], path: Path) -> None:
    """Plot the smallest distance from -1 over each sweep; zero where the loop is unstable."""
    figure, axes = plt.subplots(
        1, len(SWEEPS), figsize=(11, 3.5), sharey=True, layout="constrained"
    )
    for axis, sweep in zip(axes, SWEEPS, strict=True):
        for law, style in zip(LAWS, ("C0:", "C1--", "C2-.", "k-"), strict=True):
            points = [r for r in rows if r["sweep"] == sweep and r["law"] == law]
            distance = [0.0 if np.isnan(r["distance"]) else r["distance"] for r in points]
            axis.plot([r["value"] for r in points], distance, style, lw=1.4, marker=".", label=law)
        if sweep == "slosh_damping":
            axis.set_xscale("log")
        axis.set_xlabel(sweep.replace("slosh_frequency", "slosh_frequency, rad/s"), fontsize=9)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("distance from -1; 0: unstable")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=len(LAWS))
    figure.savefig(path, dpi=110)
    plt.close(figure)


def hard_case(folder: str, stop_s: float, path: Path) -> dict[str, Flight]:
    """The climb of the manoeuvre on the hardest vehicle."""
    manoeuvre = np.genfromtxt(design.HERE / "manoeuvre.csv", delimiter=",", names=True)
    commands = wanted(manoeuvre, stop_s, design.PERIOD_S)
    rigid = design.design(models.rigid_model(folder), models.RIGID)
    laws = {"rigid": rigid, "redesigned": design.design(design.model(folder, **HARD))}
    flights = {name: fly(folder, law, commands, ("slosh2",), **HARD) for name, law in laws.items()}
    figure, axes = plt.subplots(1, 2, figsize=(9, 3), layout="constrained")
    for (name, flight), colour in zip(flights.items(), ("C0", "k"), strict=True):
        axes[0].plot(flight.rows[:, 0], np.degrees(flight.rows[:, 2]), colour, lw=1, label=name)
        axes[1].plot(flight.rows[:, 0], flight.rows[:, 4], colour, lw=1, label=name)
    for axis, label in zip(axes, ("$\\gamma$, deg", "slosh in the aft tank, m"), strict=True):
        axis.set_xlabel("time, s")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return flights


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--points", type=int, help="points of each sweep; default: all")
    parser.add_argument(
        "--stop", type=command_line.duration, default=60.0, help="duration of the hard case, s"
    )
    parser.add_argument("--output", type=Path, default=Path("target/closed_loop"))
    options = parser.parse_args()
    command_line.need(options.fmu)
    command_line.make(options.output)
    folder = extract(str(options.fmu))
    rows = study(folder, options.points)
    show(rows)
    with (options.output / "margins.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, rows[0])
        table.writeheader()
        table.writerows(rows)
    picture(rows, options.output / "margins.png")
    for name, flight in hard_case(folder, options.stop, options.output / "hard.png").items():
        end = flight.rows[-1]
        reason = f", ended: {flight.ended}" if flight.ended else ""
        print(
            f"hard case, {name}: t = {end[0]:.1f} s, gamma = {np.degrees(end[2]):.2f} deg{reason}"
        )


if __name__ == "__main__":
    main()
