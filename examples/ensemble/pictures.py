"""Figures of an ensemble: envelope of the flights, distribution of margins, convergence."""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy as np
import pyarrow as pa

from summary import CONFIDENCE, events, interval

matplotlib.use("Agg")
import matplotlib.pyplot as plt

BANDS = [(0, 100, 0.15), (1, 99, 0.3), (10, 90, 0.5)]


def padded(table: pa.Table, column: str) -> np.ndarray:
    """Flights as rows; NaN after an early end."""
    flights = table[column].to_pylist()
    rows = np.full((len(flights), max(len(flight or ()) for flight in flights)), np.nan)
    for row, flight in zip(rows, flights, strict=True):
        row[: len(flight or ())] = flight or ()
    return rows


def envelope(table: pa.Table, commands: dict[str, float], every_s: float, path: Path) -> None:
    """Plot percentiles of V and gamma against time, and the breakpoints of the commands."""
    figure, axes = plt.subplots(1, 2, figsize=(7.5, 3.2), layout="constrained")
    speed = padded(table, "V_m_per_s")
    panels = [
        (speed - speed[:, :1], "V_change", 1.0, "change of speed, m/s"),
        (np.degrees(padded(table, "gamma_rad")), "gamma", np.degrees(1.0), "$\\gamma$, deg"),
    ]
    for axis, (values, name, factor, label) in zip(axes, panels, strict=True):
        time = np.arange(values.shape[1]) * every_s
        points = [
            [value for key, value in commands.items() if key.endswith(f"_{column}")]
            for column in ("time", name)
        ]
        wanted = factor * np.interp(time, *points)
        for low, high, shade in BANDS:
            between = np.nanpercentile(values, [low, high], axis=0)
            shown = f"{low} to {high} %"
            axis.fill_between(time, *between, color="C0", alpha=shade, lw=0, label=shown)
        axis.plot(time, np.nanmedian(values, axis=0), "C0", lw=1, label="median")
        axis.plot(time, wanted, "k--", lw=1, label="wanted")
        axis.set_xlabel("time, s")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    axes[1].legend(fontsize=8, loc="upper left")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def margins(table: pa.Table, path: Path) -> None:
    """Plot the distribution of the phase margin, and unstable vehicles over slosh parameters."""
    table = table.filter(table["trimmed"])
    phase = table["phase_deg"].to_numpy().astype(float)
    unstable = np.isnan(phase)
    figure, axes = plt.subplots(1, 2, figsize=(7.5, 3.4), layout="constrained")
    axes[0].hist(phase[~unstable], bins=np.arange(0, 95, 2.5), color="C0")
    axes[0].set_title(f"stable loops: {100 - 100 * unstable.mean():.1f} %", fontsize=11)
    axes[0].set_xlabel("phase margin, deg")
    axes[0].set_ylabel("vehicles")
    shares(axes[1], table, unstable)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def shares(axis: plt.Axes, table: pa.Table, unstable: np.ndarray) -> None:
    """Draw the percentage of unstable loops in cells of slosh frequency and damping."""
    places = [table[name].to_numpy() for name in ("slosh_frequency", "slosh_damping")]
    edges = [np.linspace(4, 12, 9), np.geomspace(0.005, 0.1, 7)]
    count, lost = (
        np.histogram2d(*(place[mask] for place in places), bins=edges)[0]
        for mask in (np.full_like(unstable, True), unstable)
    )
    share = 100 * np.divide(lost, count, out=np.full_like(count, np.nan), where=count > 0)
    # Shades of grey with numbers need no distinction of colours.
    axis.pcolormesh(*edges, share.T, cmap="Greys", vmin=0, vmax=130, edgecolors="w", lw=0.5)
    middles = (edges[0][1:] + edges[0][:-1]) / 2, np.sqrt(edges[1][1:] * edges[1][:-1])
    for (i, j), value in np.ndenumerate(share):
        if np.isfinite(value):
            colour = "w" if value > 65 else "k"
            place = middles[0][i], middles[1][j]
            axis.text(*place, f"{value:.0f}", color=colour, ha="center", va="center", fontsize=10)
    axis.set_title("unstable loops, % of the vehicles in a cell", fontsize=11)
    axis.set_yscale("log")
    axis.set_yticks([0.005, 0.01, 0.02, 0.05, 0.1], ["0.5", "1", "2", "5", "10"])
    axis.minorticks_off()
    axis.set_xlabel("slosh frequency, rad/s")
    axis.set_ylabel("slosh damping, %")


def convergence(table: pa.Table, path: Path) -> None:
    """Plot each probability over the number of flights, with its confidence interval.

    The first flights of a Latin hypercube are a random part of it.
    """
    figure, axis = plt.subplots(figsize=(7.5, 3.6), layout="constrained")
    total = table.num_rows
    counts = np.unique(np.geomspace(min(20, total), total, 60).astype(int))
    for number, (name, hits) in enumerate(events(table).items()):
        if not hits.any():
            continue
        sums = np.cumsum(hits)[counts - 1]
        bounds = np.array([interval(*pair) for pair in zip(sums, counts, strict=True)])
        axis.fill_between(counts, *(100 * bounds.T), color=f"C{number}", alpha=0.2, lw=0)
        axis.plot(counts, 100 * sums / counts, f"C{number}", lw=1.3, label=name)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_ylim(0.02, 100)
    axis.yaxis.set_major_formatter("{x:g}")
    axis.set_xlabel("flights")
    axis.set_ylabel(f"vehicles, %, with {100 * CONFIDENCE:g} % confidence")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8, loc="lower left")
    figure.savefig(path, dpi=110)
    plt.close(figure)
