"""Actuators and sensors between the autopilot and the vehicle: what they are, and what they cost.

As a program: margins at the elevator against the bandwidth of its actuator.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

try:
    import numpy as np
    from fmpy import extract

    import command_line
    import design
    from law import PERIOD_S, BadLaw, Law, part_beside
    from margins import cell, margins
    from models import MEASURED, SLOSH, STATES, LinearModel, Plant, held, sampled
    from system import COMMANDS, Component
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

# Parameters of ahv_actuator and ahv_sensor by the signal that passes through, all assumed. The fuel
# lags by 0.1 s: with so much damping the other pole is a hundred times as fast. That the
# actuator is of first order cannot be said in a parameter set: masters set no enumerations.
ACTUATORS = {
    "delta_e": {"bandwidth": 60.0, "damping": 0.7, "rate_limit": 100.0 * design.DEG},
    "phi": {"bandwidth": 100.0, "damping": 5.0, "rate_limit": 2.0},
}
# Noise as the filter is designed for. No quantum: it hides rounding from the loop, and the unstable
# vehicle makes so much of that within seconds that no two masters fly alike.
SENSORS = {
    name: {"period": PERIOD_S, "noise": float(noise), "seed": seed}
    for seed, (name, noise) in enumerate(zip(MEASURED, design.SENSOR_NOISE, strict=True), start=1)
}
BANDWIDTHS = (20.0, 40.0, 60.0, 100.0)


def components(vehicle: Path) -> list[Component]:
    """An actuator for each command and a sensor for each measurement; FMUs beside the vehicle's."""
    return [
        Component(f"{signal}_{kind}", part_beside(vehicle, kind), parameters)
        for kind, signals in (("sensor", SENSORS), ("actuator", ACTUATORS))
        for signal, parameters in signals.items()
    ]


def with_hardware(
    full: LinearModel,
    actuators: Mapping[str, Mapping[str, float]] = ACTUATORS,
    period_s: float = PERIOD_S,
) -> Plant:
    """The vehicle from command to reading: every part acts on what it was given a period ago."""
    plant, pairs = sampled(full, STATES[SLOSH], period_s), []
    for command in COMMANDS:
        rate, damping = (actuators[command][name] for name in ("bandwidth", "damping"))
        moving = np.array([[0.0, 1.0], [-(rate**2), -2.0 * damping * rate]])
        pairs.append(held(moving, np.array([[0.0], [rate**2]]), period_s))
    n = len(plant.A)
    first, readings = n + 2 * len(pairs), len(MEASURED)
    a, b = np.zeros((first + readings,) * 2), np.zeros((first + readings, len(pairs)))
    a[:n, :n], a[first:, :n] = plant.A, plant.C
    for i, (moved, pushed) in enumerate(pairs):
        own = slice(n + 2 * i, n + 2 * i + 2)
        a[:n, own.start] = plant.B[:, i]
        a[own, own], b[own, [i]] = moved, pushed
    return Plant(a, b, np.hstack([np.zeros((readings, first)), np.eye(readings)]))


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    options = parser.parse_args()
    autopilot = part_beside(options.fmu, "autopilot")
    command_line.need(options.fmu, autopilot)
    full = design.model(extract(str(options.fmu)))
    try:
        law = Law.within(autopilot)
    except BadLaw as failure:
        sys.exit(f"error: {failure}")
    cells = [cell(margins(sampled(full, STATES[SLOSH], law.period_s), law)._asdict())]
    for bandwidth in BANDWIDTHS:
        elevator = ACTUATORS["delta_e"] | {"bandwidth": bandwidth}
        plant = with_hardware(full, ACTUATORS | {"delta_e": elevator}, law.period_s)
        cells.append(cell(margins(plant, law)._asdict()))
    names = ["none", *(f"{bandwidth:g} rad/s" for bandwidth in BANDWIDTHS)]
    print("| elevator actuator | " + " | ".join(names) + " |")
    print("|---" * (1 + len(names)) + "|")
    print("| margins | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
