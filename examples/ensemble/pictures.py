"""Pictures of an ensemble: the envelope of the flights, and the distribution of margins."""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy as np
import pyarrow as pa

matplotlib.use("Agg")
import matplotlib.pyplot as plt

BANDS = [(0, 100, 0.15), (1, 99, 0.3), (10, 90, 0.5)]


def padded(table: pa.Table, column: str) -> np.ndarray:
    """Flights as rows; NaN after the end of one that ended early."""
    flights = table[column].to_pylist()
    rows = np.full((len(flights), max(len(flight or ()) for flight in flights)), np.nan)
    for row, flight in zip(rows, flights, strict=True):
        row[: len(flight or ())] = flight or ()
    return rows


def envelope(table: pa.Table, commands: np.ndarray, every_s: float, path: Path) -> None:
    """Percentiles of V and gamma against time. `commands`: (steps, 2), one per `every_s`."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    speed = padded(table, "V_m_per_s")
    panels = [
        (speed - speed[:, :1], commands[:, 0], "change of speed, m/s"),
        (np.degrees(padded(table, "gamma_rad")), np.degrees(commands[:, 1]), "$\\gamma$, deg"),
    ]
    for axis, (values, wanted, label) in zip(axes, panels, strict=True):
        time = np.arange(values.shape[1]) * every_s
        for low, high, shade in BANDS:
            between = np.nanpercentile(values, [low, high], axis=0)
            name = f"{low} to {high} %"
            axis.fill_between(time, *between, color="C0", alpha=shade, lw=0, label=name)
        axis.plot(time, np.nanmedian(values, axis=0), "C0", lw=1, label="median")
        axis.plot(time, wanted[: len(time)], "k--", lw=1, label="wanted")
        axis.set_xlabel("time, s")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    axes[1].legend(fontsize=8, loc="upper left")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def margins(table: pa.Table, path: Path) -> None:
    """Distribution of the phase margin, and where the unstable vehicles are."""
    table = table.filter(table["trimmed"])
    phase = table["phase_deg"].to_numpy().astype(float)
    frequency = table["slosh_frequency"].to_numpy()
    damping = table["slosh_damping"].to_numpy()
    unstable = np.isnan(phase)
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    axes[0].hist(phase[~unstable], bins=np.arange(0, 95, 2.5), color="C0")
    axes[0].set_xlabel(f"phase margin, deg; {100 * unstable.mean():.1f} % unstable, not shown")
    axes[0].set_ylabel("vehicles")
    dots = axes[1].scatter(
        frequency[~unstable], damping[~unstable], c=phase[~unstable], s=3, vmin=0, vmax=60
    )
    axes[1].scatter(frequency[unstable], damping[unstable], c="r", s=3, label="unstable")
    axes[1].set_yscale("log")
    axes[1].set_xlabel("slosh_frequency, rad/s")
    axes[1].set_ylabel("slosh_damping")
    axes[1].legend(fontsize=8, loc="upper right")
    figure.colorbar(dots, ax=axes[1], label="phase margin, deg")
    figure.savefig(path, dpi=110)
    plt.close(figure)
