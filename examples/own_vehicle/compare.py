"""Fly one manoeuvre with several FMUs and plot the deviations from level flight together.

python examples/own_vehicle/compare.py target/ahv.fmu target/own/ahv.fmu
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from fmpy import read_model_description, simulate_fmu

EXAMPLES = Path(__file__).resolve().parents[1]
# Variable, label, factor to the unit of the label.
PANELS = (
    ("delta_e", "elevator\ndeg", np.degrees(1.0)),
    ("alpha", "incidence\ndeg", np.degrees(1.0)),
    ("n_z", "load factor\ng", 1.0),
    ("eta1", "first mode,\nat the nose\nmm", 1e3),
    ("slosh2", "aft slosh\nmm", 1e3),
)
# Line styles, distinguishable without colour.
LINES = (
    {"color": "#0072b2", "linestyle": "-"},
    {"color": "#d55e00", "linestyle": "--"},
    {"color": "#009e73", "linestyle": "-."},
    {"color": "#555555", "linestyle": ":"},
)
DEFLECTION = np.radians(0.05)


def doublet() -> np.ndarray:
    """Elevator down for 0.2 s, then up for 0.2 s."""
    times = (0.0, 0.1, 0.1, 0.3, 0.3, 0.5, 0.5)
    sizes = (0.0, 0.0, 1.0, 1.0, -1.0, -1.0, 0.0)
    still = ("phi", "w_gust", "u_gust")
    rows = [(t, size * DEFLECTION, 0, 0, 0) for t, size in zip(times, sizes, strict=True)]
    return np.array(rows, dtype=[(key, float) for key in ("time", "delta_e", *still)])


def name(fmu: Path) -> str:
    """File name, and the user's data that the FMU was built with."""
    description = read_model_description(str(fmu)).description or ""
    _, _, data = description.partition("; data: ")
    return f"{fmu}: {data}" if data else str(fmu)


def main() -> None:
    """Fly, print and plot."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("fmu", nargs="+", type=Path, help=f"FMUs to compare, up to {len(LINES)}")
    parser.add_argument("--stop", type=float, default=1.2, metavar="SECONDS")
    parser.add_argument("--output", type=Path, default=Path("target/own/compare.png"))
    options = parser.parse_args()
    if len(options.fmu) > len(LINES):
        parser.error(f"{len(options.fmu)} FMUs, at most {len(LINES)}")
    for fmu in options.fmu:
        if not fmu.is_file():
            parser.error(f"{fmu} does not exist; `cargo ahv package` writes FMUs")

    figure, axes = plt.subplots(
        len(PANELS), 1, sharex=True, figsize=(7.5, 7.5), layout="constrained"
    )
    names = [panel[0] for panel in PANELS]
    for fmu, line in zip(options.fmu, LINES, strict=False):
        flight = simulate_fmu(
            str(fmu), stop_time=options.stop, output_interval=0.005, input=doublet(), output=names
        )
        for axis, (variable, _, factor) in zip(axes, PANELS, strict=True):
            change = (flight[variable] - flight[variable][0]) * factor
            axis.plot(flight["time"], change, label=name(fmu), **line)
        swings = ", ".join(
            f"{variable} {np.ptp(flight[variable]) * factor:.3g} {label.split(chr(10))[-1]}"
            for variable, label, factor in PANELS[1:]
        )
        print(f"{name(fmu)}: from least to most {swings}")
    for axis, (_, label, _) in zip(axes, PANELS, strict=True):
        axis.set_ylabel(label, rotation=0, ha="right", va="center")
        axis.grid(alpha=0.3)
    axes[-1].set_xlabel("time, s")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center")
    options.output.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(options.output, dpi=130)
    print(f"wrote {options.output}")


if __name__ == "__main__":
    main()
