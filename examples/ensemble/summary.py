"""What an ensemble shows: probabilities with their confidence intervals, and causes."""

from __future__ import annotations

import re
from collections import Counter

import numpy as np
import pyarrow as pa
from scipy.stats import binomtest

from batch import MARGINS
from vehicles import SETS, VARIED

# Columns that the summary needs; histories stay on the disk.
COLUMNS = (*VARIED, *MARGINS, "saturated_steps", "trimmed", "ended")
CONFIDENCE = 0.95
# Phase margin that is too small, deg.
SMALL_DEG = 30.0
# Number of reasons printed; after the loss of a cluster all batches have the same.
SAID = 5
# Slosh expected to be critical: near the short period, with little damping.
SLOW, LIGHT = 8.0, 0.03
NUMBER = re.compile(r"(?<![a-z])[+-]?\d+(\.\d+)?(e[+-]?\d+)?")


def events(table: pa.Table) -> dict[str, np.ndarray]:
    """Whether each of these happened, by vehicle; the first one to the others' exclusion."""
    trimmed = table["trimmed"].to_numpy()
    phase = table["phase_deg"].to_numpy().astype(float)
    return {
        "no trim": ~trimmed,
        "unstable loop": trimmed & np.isnan(phase),
        f"stable, phase margin below {SMALL_DEG:g} deg": trimmed & (phase < SMALL_DEG),
        "flight ended early": trimmed & (table["ended"].to_numpy() != ""),
        "actuator at its limit": trimmed & (table["saturated_steps"].to_numpy() > 0),
    }


def interval(count: int, total: int) -> tuple[float, float]:
    """Confidence interval of a probability, by Wilson's score.

    For independent samples; on a Latin hypercube the error is smaller.
    """
    found = binomtest(int(count), int(total)).proportion_ci(CONFIDENCE, method="wilson")
    return found.low, found.high


def summary(table: pa.Table) -> str:
    """A summary of the ensemble."""
    happened = events(table)
    flights = table.filter(table["trimmed"])
    columns = {name: flights[name].to_numpy().astype(float) for name in (*VARIED, *MARGINS)}
    causes = Counter(
        # "fmi2DoStep: alpha = 0.1745 reached the edge of its valid range ..."
        reason.removeprefix("fmi2DoStep: ").split(" = ")[0]
        for reason in flights["ended"].to_pylist()
        if reason
    )
    phase = columns["phase_deg"]
    unstable, kept = np.isnan(phase), phase[~np.isnan(phase)]
    slow = (columns["slosh_frequency"] < SLOW) & (columns["slosh_damping"] < LIGHT)
    lines = [f"{table.num_rows} vehicles; of all, with {100 * CONFIDENCE:g} % confidence:"]
    for name, hits in happened.items():
        low, high = (100 * bound for bound in interval(hits.sum(), len(hits)))
        percent = 100 * hits.mean()
        lines.append(f"    {percent:6.2f} % ({low:.2f} to {high:.2f})  {name}: {hits.sum()}")
    lines += [
        *(f"no trim: {count} {why}" for why, count in refusals(table).most_common(SAID)),
        *(f"ended early: {count} by {cause}" for cause, count in causes.most_common()),
        f"unstable: {np.sum(unstable & slow)} with slosh below {SLOW:g} rad/s and damping below "
        f"{LIGHT:g}",
        f"phase margin of stable loops: least {kept.min(initial=np.inf):.1f}, "
        f"median {median(kept):.1f} deg",
    ]
    for number, name in enumerate(SETS, start=1):
        own = columns["aero"] == number
        if not own.any():
            continue
        low, high = (100 * bound for bound in interval(unstable[own].sum(), own.sum()))
        lines.append(
            f"{name}: {own.sum()} flights, {100 * unstable[own].mean():.1f} % ({low:.1f} to "
            f"{high:.1f}) unstable, median {median(phase[own & ~unstable]):.0f} deg"
        )
    return "\n".join(lines)


def median(values: np.ndarray) -> float:
    """NaN, if there are none."""
    return float(np.median(values)) if values.size else np.nan


def refusals(table: pa.Table) -> Counter[str]:
    """Why vehicles have no trim, without the numbers."""
    said = table.filter(np.logical_not(table["trimmed"].to_numpy()))["ended"].to_pylist()
    return Counter(NUMBER.sub("#", reason) for reason in said)
