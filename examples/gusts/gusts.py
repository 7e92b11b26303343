"""The closed loop in Dryden turbulence and single gusts, from below and from ahead."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "closed_loop")]
try:
    import matplotlib
    import numpy as np
    from fmpy import extract

    import command_line
    import design
    from air import SIGMA_M_PER_S, gust, turbulence
    from flight import Flight, fly
    from law import Law
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# One amplitude for all lengths; up to 20 m/s the response is proportional to within a tenth.
PEAK_M_PER_S = 5.0
# From the longest of CS-25.341 (350 ft), which lasts 0.09 s at Mach 8, upwards.
GRADIENTS_M = [107, 214, 428, 856, 1712, 3424]
DRAWN_M = [107, 428, 1712]
START_S, GUST_S = 0.5, 12.0
# Part of the turbulence shown in the figure.
SHOWN_S = 20.0
SEVERE = max(SIGMA_M_PER_S, key=SIGMA_M_PER_S.get)
SHOWN = ("alpha", "n_z", "eta1", "slosh1")
COLUMNS = ("gamma_deg", "incidence_deg", "n_z_g", "nose_mm", "slosh_mm", "elevator_deg")
HEAD = ("time_s", "w_gust_m_per_s", "u_gust_m_per_s", *COLUMNS)
PANELS = {
    "incidence_deg": "incidence, deg",
    "n_z_g": "load factor, g",
    "nose_mm": "nose, mm",
    "slosh_mm": "slosh, fore, mm",
    "elevator_deg": "elevator, deg",
}
# With and without baffles.
DAMPINGS = (0.05, 0.01)


def autopilots(folder: str, **parameters: float) -> tuple[Law, Law]:
    """The autopilot of the closed loop, and constant controls."""
    law = design.design(design.model(folder, **parameters))
    idle = Law(**vars(law) | {"K": 0.0 * law.K, "Ki": 0.0 * law.Ki})
    return law, idle


def vertical(air: np.ndarray) -> np.ndarray:
    """Vertical gusts w with u = 0, shape (points, 2)."""
    return np.column_stack([air, np.zeros_like(air)])


def meet(folder: str, law: Law, air: np.ndarray, **parameters: float) -> Flight:
    """Fly level through this air; shape (steps + 1, 2), m/s, up and along."""
    return fly(folder, law, np.zeros((len(air) - 1, 2)), SHOWN, gust=air, **parameters)


def values(rows: np.ndarray, air: np.ndarray) -> np.ndarray:
    """COLUMNS of rows of a flight, shape (rows, 6); incidence is relative to this air."""
    w, u = air.T
    _, speed, gamma, _, alpha, n_z, nose, slosh, elevator, _ = rows.T
    met = alpha + gamma - np.arctan2(speed * np.sin(gamma) - w, speed * np.cos(gamma) - u)
    degrees = [gamma / design.DEG, met / design.DEG]
    return np.column_stack([*degrees, n_z, nose * 1e3, slosh * 1e3, elevator / design.DEG])


def away(folder: str, flight: Flight, air: np.ndarray) -> np.ndarray:
    """COLUMNS as deviations from trimmed flight in still air."""
    still = meet(folder, flight.pilot.law, np.zeros((2, 2))).rows
    return values(flight.rows, air[1 : len(flight.rows) + 1]) - values(still, np.zeros((1, 2)))


def line(*cells: object) -> str:
    """A row of a table."""
    shown = [f"{cell:.3g}" if isinstance(cell, float) else str(cell) for cell in cells]
    return f"| {' | '.join(shown)} |"


def write(path: Path, head: tuple[str, ...], rows: np.ndarray) -> None:
    """Write a CSV file with all digits."""
    np.savetxt(path, rows, fmt="%.17g", delimiter=",", header=",".join(head), comments="")


def draw(axes: np.ndarray, rows: np.ndarray, label: str, style: str) -> None:
    """Plot one flight."""
    axes[0].plot(rows[:, 0], rows[:, 1], style, lw=1, label=label)
    for axis, name in zip(axes[1:], PANELS, strict=True):
        axis.plot(rows[:, 0], rows[:, 3 + COLUMNS.index(name)], style, lw=1)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument(
        "--stop", type=command_line.duration, default=120.0, help="duration of the turbulence, s"
    )
    parser.add_argument("--seed", type=int, default=1, help="random seed of the turbulence")
    parser.add_argument("--output", type=Path, default=Path("target/gusts"))
    options = parser.parse_args()
    command_line.need(options.fmu)
    command_line.make(options.output)
    folder = extract(str(options.fmu))
    law, idle = autopilots(folder)
    speed, period = law.level[0], law.period_s
    figure, axes = plt.subplots(6, 2, figsize=(9, 9), sharex="col", layout="constrained")

    def flown(name: str, air: np.ndarray, **parameters: float) -> np.ndarray:
        """Rows of time, air and COLUMNS, written as CSV; the flight must not end early."""
        own, _ = autopilots(folder, **parameters)
        flight = meet(folder, own, air, **parameters)
        changes = away(folder, flight, air)
        rows = np.column_stack([flight.rows[:, 0], air[1 : len(changes) + 1], changes])
        write(options.output / f"{name}.csv", HEAD, rows)
        if flight.ended:
            sys.exit(f"error: the flight {name}.csv ended early: {flight.ended}")
        return rows

    print(f"turbulence, standard deviations over {options.stop:g} s:")
    print(line("exceeded with", "sigma, m/s", "slosh damping", *COLUMNS))
    steps = round(options.stop / period)
    for name, sigma in SIGMA_M_PER_S.items():
        air = vertical(turbulence(sigma, speed, steps, period, options.seed))
        for damping in DAMPINGS:
            rows = flown(f"turbulence_{name}_{damping:g}", air, slosh_damping=damping)
            print(line(name, sigma, damping, *rows[:, 3:].std(axis=0)))
            if name == SEVERE and damping == DAMPINGS[0]:
                draw(axes[:, 0], rows, "", "C0")
                free = meet(folder, idle, air)
    if free.ended:
        print(f"without autopilot lost after {free.rows[-1, 0]:.1f} s: {free.ended}")

    print(f"\ngusts of {PEAK_M_PER_S:g} m/s, largest changes:")
    print(line("gradient, m", "slosh damping", *COLUMNS))
    largest, styles = [], iter(("C0", "C1--", "k:"))
    along = []
    for gradient in GRADIENTS_M:
        shape = gust(PEAK_M_PER_S, gradient, speed, round(GUST_S / period), period, START_S)
        for damping in DAMPINGS:
            rows = flown(f"gust_{gradient}_{damping:g}", vertical(shape), slosh_damping=damping)
            largest.append([gradient, damping, *np.abs(rows[:, 3:]).max(axis=0)])
            print(line(gradient, *map(float, largest[-1][1:])))
            if damping == DAMPINGS[0] and gradient in DRAWN_M:
                draw(axes[:, 1], rows, f"{gradient} m", next(styles))
        # The same gust from ahead.
        rows = flown(f"head_{gradient}", np.column_stack([0.0 * shape, -shape]))
        along.append([gradient, *np.abs(rows[:, 3:]).max(axis=0)])
    print("\nthe same from ahead:")
    print(line("gradient, m", *COLUMNS))
    for gradient, *rest in along:
        print(line(gradient, *map(float, rest)))
    head = ("gradient_m", "slosh_damping", *COLUMNS)
    write(options.output / "largest.csv", head, np.array(largest))

    for column in axes.T:
        for axis, label in zip(column, ("air, m/s, up", *PANELS.values()), strict=True):
            axis.set_ylabel(label)
            axis.grid(alpha=0.3)
        column[-1].set_xlabel("time, s")
    axes[0, 0].set_title(f"turbulence, {SIGMA_M_PER_S[SEVERE]:.2f} m/s", fontsize=10)
    axes[0, 1].set_title(f"gusts of {PEAK_M_PER_S:g} m/s", fontsize=10)
    axes[0, 0].set_xlim(0.0, min(SHOWN_S, options.stop))
    axes[0, 1].set_xlim(0.0, 4.0)
    axes[0, 1].legend(title="gradient length", fontsize=8, title_fontsize=8)
    figure.align_ylabels()
    figure.savefig(options.output / "gusts.png", dpi=110)
    plt.close(figure)
    print(f"\n{options.output}: gusts.png, largest.csv, and each flight")


if __name__ == "__main__":
    main()
