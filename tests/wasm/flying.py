"""The library and the component side by side."""

from __future__ import annotations

import numpy as np

from harness import Instance as Native
from host import Instance

STEP = 1e-3


def inputs(step: int) -> dict[str, float]:
    """Elevator up and down, a little fuel, gusts: small enough for every vehicle."""
    elevator = 5e-4 if 100 <= step < 300 else -5e-4 if 300 <= step < 500 else 0.0
    gust = 0.1 * np.sin(0.02 * step)
    return {"delta_e": elevator, "phi": 1e-3 * (step % 50), "w_gust": gust, "u_gust": -gust}


def moved(rows: list[bytes]) -> int:
    """How many real variables differ between the first and the last row."""
    first, last = np.frombuffer(rows[0], np.uint64), np.frombuffer(rows[-1], np.uint64)
    return int((first != last).sum())


def reason(text: str) -> str:
    """A message without the name of the function, which is another in FMI 3.0."""
    return text.partition(": ")[2]


def same_steps(one: Native, other: Native | Instance, steps: range) -> list[bytes]:
    """Flies both; the bits of all real variables after each step, which are the same."""
    rows = []
    for step in steps:
        for flight in (one, other):
            flight.set(**inputs(step))
            flight.step(STEP)
        rows.append(one.bits())
        assert rows[-1] == other.bits(), f"step {step}"
    return rows
