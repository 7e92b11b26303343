"""Ten minutes of level flight while the fuel burns, with the autopilot designed for full tanks."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

try:
    import matplotlib
    import numpy as np
    from fmpy import extract

    import design
    from flight import fly
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt

RECORDED = ("h", "alpha", "delta_e_effective", "phi_effective", "fuel_mass", "der(fuel_mass)")
COLUMNS = ("time", "V", "gamma", "q", *RECORDED, "delta_e", "phi")
ROW_S = 1.0  # between rows of the table
PANELS = [
    ("speed, from the start, m/s", "V", 1.0),
    ("altitude, from the start, m", "h", 1.0),
    ("$\\alpha$, deg", "alpha", 1.0 / design.DEG),
    ("$\\delta_e$, deg", "delta_e_effective", 1.0 / design.DEG),
    ("fuel on board, t per metre", "fuel_mass", 1e-3),
    ("fuel flow, kg/s per metre", "der(fuel_mass)", -1.0),
]


def picture(rows: np.ndarray, path: Path) -> None:
    """The flight against time."""
    figure, axes = plt.subplots(3, 2, figsize=(9, 6.5), sharex=True, layout="constrained")
    for axis, (label, name, factor) in zip(axes.ravel(), PANELS, strict=True):
        values = rows[:, COLUMNS.index(name)] * factor
        axis.plot(rows[:, 0], values - values[0] if "from the start" in label else values, lw=1.2)
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
    parser.add_argument("--stop", type=float, default=600.0, help="s")
    parser.add_argument("--fuel", type=float, default=1.0, help="fuel_fraction at the start")
    parser.add_argument("--output", type=Path, default=Path("target/closed_loop"))
    options = parser.parse_args()
    if not options.fmu.is_file():
        sys.exit(f"{options.fmu} does not exist: run `cargo ahv package`")
    options.output.mkdir(parents=True, exist_ok=True)
    folder = extract(str(options.fmu))
    law = design.design(design.model(folder))

    level = np.zeros((round(options.stop / law.period_s), 2))
    begin = time.perf_counter()
    flight = fly(folder, law, level, RECORDED, fuel_fraction=options.fuel, fuel_burn=True)
    took = time.perf_counter() - begin
    if not len(flight.rows):
        sys.exit(f"error: {flight.ended}")
    rows = flight.rows[:: round(ROW_S / law.period_s)]
    header = ",".join(COLUMNS)
    np.savetxt(options.output / "cruise.csv", rows, "%.9g", ",", header=header, comments="")
    picture(rows, options.output / "cruise.png")

    last = dict(zip(COLUMNS, flight.rows[-1], strict=True))
    first = dict(zip(COLUMNS, flight.rows[0], strict=True))
    burnt = first["fuel_mass"] - last["fuel_mass"]
    print(f"{last['time']:.0f} s flown in {took:.1f} s, {last['time'] / took:.0f} times real time")
    print(f"{burnt:.1f} kg per metre burnt, {burnt / first['fuel_mass']:.1%} of what was on board")
    for what, name, factor in [
        ("speed, m/s", "V", 1.0),
        ("altitude, m", "h", 1.0),
        ("fuel flow, kg/s per metre", "der(fuel_mass)", -1.0),
        ("alpha, deg", "alpha", 1.0 / design.DEG),
        ("delta_e, deg", "delta_e_effective", 1.0 / design.DEG),
        ("fuel ratio", "phi_effective", 1.0),
    ]:
        print(f"{what}: {first[name] * factor:.4f} to {last[name] * factor:.4f}")
    # The same law on the vehicle as it is at the start and at the end.
    for when, left in (("start", options.fuel), ("end", last["fuel_mass"] / first["fuel_mass"])):
        fuel = left if when == "start" else left * options.fuel
        plant = design.sampled(
            design.model(folder, fuel_fraction=fuel), design.STATES[design.SLOSH]
        )
        m = design.margins(plant, law)
        print(
            f"margins at the {when}: gain {m.gain_down_db:+.1f} to {m.gain_up_db:+.1f} dB, "
            f"phase {m.phase_deg:.0f} deg, distance from -1 {m.distance:.2f}"
        )
    if flight.ended:
        print(f"the flight ended early: {flight.ended}")


if __name__ == "__main__":
    main()
