"""Margins against the communication step of the master.

An autopilot that is designed for the step, and one that samples every 10 ms whatever the step: in
longer steps it reads measurements as they were at the beginning of the step, or moving by their
derivative (fmi2SetRealInputDerivatives), and the vehicle gets its commands at the end.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

try:
    import numpy as np
    from fmpy import extract

    import command_line
    import design
    from margins import Broken, cell, linear, margins, margins_of
    from models import SLOSH, STATES, LinearModel, sampled
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

STEPS_S = (0.001, 0.005, 0.01, 0.02, 0.04)


def coupled(full: LinearModel, law: design.Law, step_s: float, is_moving: bool) -> Broken:
    """The loop of a sampled autopilot and the vehicle that exchange values every `step_s`."""
    period_s = law.period_s
    if step_s < period_s:
        # A sample reads what is measured then, and its command is there at the next sample.
        step_s = period_s
    plant, pilot = sampled(full, STATES[SLOSH], step_s), linear(law)
    kept = [full.states.index(name) for name in STATES[SLOSH]]
    # Derivatives of what is measured, by state and by command.
    slope, direct = plant.C @ full.A[np.ix_(kept, kept)], plant.C @ full.B[kept]
    n, m = len(plant.A), len(pilot.A)
    alone, read, moved = np.eye(m), np.zeros((m, 3)), np.zeros((m, 3))
    for k in range(round(step_s / period_s)):
        alone, read = pilot.A @ alone, pilot.A @ read + pilot.B
        moved = pilot.A @ moved + k * period_s * is_moving * pilot.B
    a = np.block([[plant.A, np.zeros((n, m))], [read @ plant.C + moved @ slope, alone]])
    b = np.vstack([plant.B, moved @ direct])
    return Broken(a, b, np.hstack([np.zeros((2, n)), pilot.C]), step_s)


def study(full: LinearModel) -> dict[str, list[str]]:
    """Margins at the elevator by kind of coupling, for each step."""
    fixed, rows = design.design(full), {}
    own = [design.design(full, period_s=step_s) for step_s in STEPS_S]
    rows["designed for the step"] = [
        cell(margins(sampled(full, STATES[SLOSH], law.period_s), law)._asdict()) for law in own
    ]
    for name, is_moving in (("10 ms, held", False), ("10 ms, measurements move", True)):
        loops = [coupled(full, fixed, step_s, is_moving) for step_s in STEPS_S]
        rows[name] = [cell(margins_of(loop)._asdict()) for loop in loops]
    return rows


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    options = parser.parse_args()
    command_line.need(options.fmu)
    full = design.model(extract(str(options.fmu)))
    print("| step, ms | " + " | ".join(f"{1e3 * step_s:g}" for step_s in STEPS_S) + " |")
    print("|---" * (1 + len(STEPS_S)) + "|")
    for name, cells in study(full).items():
        print(f"| {name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
