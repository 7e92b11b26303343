"""Ten minutes of level flight while fuel burns, with the autopilot designed for the start.

As the vehicle gets lighter, it needs less incidence, elevator and fuel. The flight is compared with
trims at the remaining fuel, without burning.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import NamedTuple

try:
    import matplotlib
    import numpy as np
    from fmpy import extract

    import command_line
    import design
    from flight import Flight, Vehicle, fly
    from margins import cell, margins
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt

OUTPUTS = (
    *("h", "mach", "alpha", "delta_e_effective", "phi_effective"),
    *("fuel_mass", "der(fuel_mass)"),
)
COLUMNS = ("time", "V", "gamma", "q", *OUTPUTS, "delta_e_change", "phi_change")
# Interval of the rows of the CSV; number of trims for comparison.
ROW_S, TRIMS = 1.0, 7
TRIMMED = ("alpha_trim", "delta_e_trim", "phi_trim")
PANELS = [
    ("fuel, kg/m", "fuel_mass", 1.0),
    ("height gained, m", "h", 1.0),
    ("speed gained, m/s", "V", 1.0),
    ("$\\alpha$, deg", "alpha", np.degrees(1.0)),
    ("$\\delta_e$, deg", "delta_e_effective", np.degrees(1.0)),
    ("fuel ratio", "phi_effective", 1.0),
]
GAINED = ("h", "V")


class Cruise(NamedTuple):
    """The flight, also by column; rows with a trim for comparison, and these trims by column.

    `seconds`: computing time; `fuel_fraction`: at the end.
    """

    flight: Flight
    flown: dict[str, np.ndarray]
    places: np.ndarray
    trimmed: dict[str, np.ndarray]
    seconds: float
    fuel_fraction: float


def cruise(folder: str, stop_s: float, fuel_fraction: float = 1.0) -> Cruise:
    """Hold the initial speed and level flight from this fuel fraction, with the initial design."""
    law = design.design(design.model(folder, fuel_fraction=fuel_fraction))
    commands = np.zeros((round(stop_s / design.PERIOD_S), 2))
    begin = time.perf_counter()
    flight = fly(folder, law, commands, OUTPUTS, fuel_burn=True, fuel_fraction=fuel_fraction)
    seconds = time.perf_counter() - begin
    flown = dict(zip(COLUMNS, flight.rows.T, strict=True))
    with Vehicle(folder, ("fuel_mass",)) as full:
        fractions = flown["fuel_mass"] / full.read()[-1]
    places = np.linspace(0, len(flight.rows) - 1, TRIMS).astype(int)
    trims = []
    for i in places:
        start = {"mach0": flown["mach"][i], "altitude0": flown["h"][i]}
        with Vehicle(folder, TRIMMED, fuel_fraction=fractions[i], **start) as vehicle:
            trims.append(vehicle.read()[-len(TRIMMED) :])
    names = ("alpha", "delta_e_effective", "phi_effective")
    trimmed = dict(zip(names, np.transpose(trims), strict=True))
    return Cruise(flight, flown, places, trimmed, seconds, fractions[-1])


def picture(found: Cruise, path: Path) -> None:
    """Plot the flight against time, and the trims as dots."""
    figure, axes = plt.subplots(2, 3, figsize=(9, 4.6), sharex=True, layout="constrained")
    times = found.flown["time"]
    for axis, (label, name, factor) in zip(axes.ravel(), PANELS, strict=True):
        values = found.flown[name] * factor
        axis.plot(times, values - (values[0] if name in GAINED else 0.0), "C0", lw=1.2)
        if name in found.trimmed:
            axis.plot(
                times[found.places],
                found.trimmed[name] * factor,
                "ko",
                ms=3.5,
                label="trim at this fuel",
            )
            axis.legend(fontsize=8)
        axis.set_ylabel(label)
        axis.ticklabel_format(useOffset=False)
        axis.grid(alpha=0.3)
    for axis in axes[-1]:
        axis.set_xlabel("time, s")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--stop", type=command_line.duration, default=600.0, help="duration, s")
    parser.add_argument("--fuel", type=float, default=1.0, help="fuel fraction at the start")
    parser.add_argument("--output", type=Path, default=Path("target/closed_loop"))
    options = parser.parse_args()
    command_line.need(options.fmu)
    command_line.make(options.output)
    folder = extract(str(options.fmu))
    found = cruise(folder, options.stop, options.fuel)
    flown, table, image = found.flown, options.output / "cruise.csv", options.output / "cruise.png"
    every = round(ROW_S / design.PERIOD_S)
    np.savetxt(
        table, found.flight.rows[::every], delimiter=",", header=",".join(COLUMNS), comments=""
    )
    picture(found, image)
    print(f"{table}, {image}")
    burnt = np.ptp(flown["fuel_mass"])
    print(
        f"{flown['time'][-1]:.0f} s in {found.seconds:.1f} s, "
        f"{flown['time'][-1] / found.seconds:.0f} times real time with the autopilot in Python\n"
        f"{burnt:.1f} kg/m burnt, {burnt / flown['time'][-1]:.3f} kg/(m s) on average, "
        f"{100 * found.fuel_fraction:.1f} % of full tanks left"
    )
    law = design.design(design.model(folder, fuel_fraction=options.fuel))
    for when, fuel in (("start", options.fuel), ("end", found.fuel_fraction)):
        full = design.model(folder, fuel_fraction=fuel)
        m = margins(design.sampled(full, design.STATES[design.SLOSH]), law)
        print(f"margins at the {when}: {cell(m._asdict())}")
    if found.flight.ended:
        sys.exit(f"error: after t = {flown['time'][-1]:.2f} s: {found.flight.ended}")


if __name__ == "__main__":
    main()
