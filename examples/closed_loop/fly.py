"""Design an autopilot on the FMU, export it as an FMU, connect both and fly in two masters."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

try:
    import matplotlib
    import numpy as np
    from fmpy import extract

    import design
    from margins import margins
    from masters import NAMES, MasterFailed, fly_fmpy, fly_libcosim
    from system import BadSystem, build
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Relative to each variable's range. The masters round time differently, which the integrator
# sees; the loop keeps the difference small.
SAME_FLIGHT = 1e-9
PANELS = [
    ("change of speed, m/s", [("vehicle.V", "flown"), ("manoeuvre.V_change", "wanted")], 1.0),
    ("$\\gamma$, deg", [("vehicle.gamma", "flown"), ("manoeuvre.gamma_wanted", "wanted")], 57.296),
    ("$\\delta_e$, deg", [("vehicle.delta_e_effective", "")], 57.296),
    ("fuel ratio", [("vehicle.phi_effective", "")], 1.0),
    ("slosh, m", [("vehicle.slosh1", "fore"), ("vehicle.slosh2", "aft")], 1.0),
    ("$\\eta_1$, m of nose", [("vehicle.eta1", "")], 1.0),
]


def picture(rows: np.ndarray, path: Path) -> None:
    """Plot the flight against time."""
    figure, axes = plt.subplots(3, 2, figsize=(9, 6.5), sharex=True, layout="constrained")
    for axis, (label, lines, factor) in zip(axes.T.ravel(), PANELS, strict=True):
        for name, legend in lines:
            values = rows[:, 1 + NAMES.index(name)] * factor
            if name == "vehicle.V":
                values = values - values[0]
            dashed = {"ls": "--", "color": "k"} if legend == "wanted" else {}
            axis.plot(rows[:, 0], values, lw=1, label=legend, **dashed)
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
        if len(lines) > 1:
            axis.legend(fontsize=8)
    for axis in axes[-1]:
        axis.set_xlabel("time, s")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def agreement(one: np.ndarray, other: np.ndarray) -> float:
    """Largest difference of any of the vehicle's outputs, over its range."""
    vehicle = [1 + i for i, name in enumerate(NAMES) if name.startswith("vehicle.")]
    difference = np.abs(one[:, vehicle] - other[:, vehicle]).max(axis=0)
    return float((difference / np.ptp(one[:, vehicle], axis=0)).max())


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--manoeuvre", type=Path, default=design.HERE / "manoeuvre.csv")
    parser.add_argument("--stop", type=float, default=150.0, help="duration, s")
    parser.add_argument("--patience", type=float, default=30.0, help="longest pause, s")
    parser.add_argument("--output", type=Path, default=Path("target/closed_loop"))
    options = parser.parse_args()
    if not options.fmu.is_file():
        sys.exit(f"error: {options.fmu} does not exist: run `cargo ahv package`")
    options.output.mkdir(parents=True, exist_ok=True)

    full = design.model(extract(str(options.fmu)))
    law = design.design(full)
    for actuator, name in enumerate(full.inputs):
        m = margins(design.sampled(full, design.STATES[design.SLOSH]), law, actuator)
        print(
            f"{name:8} gain {m.gain_down_db:+.1f} to {m.gain_up_db:+.1f} dB, "
            f"phase {m.phase_deg:.0f} deg, distance from -1 {m.distance:.2f}"
        )
    try:
        ssp = build(
            options.output / "closed_loop.ssp", options.fmu, law, options.manoeuvre, options.stop
        )
    except (BadSystem, OSError) as failure:
        sys.exit(f"error: {failure}")
    print(f"{ssp}: valid")
    csv = options.output / "libcosim.csv"
    try:
        rows = fly_libcosim(ssp, csv, options.stop, options.patience)
    except MasterFailed as failure:
        sys.exit(f"error: {failure}")
    picture(rows, options.output / "flight.png")
    apart = agreement(rows, fly_fmpy(ssp, options.stop))
    print(f"{csv}, {options.output / 'flight.png'}: {len(rows)} steps")
    print(f"libcosim and FMPy differ by {apart:.1e} of a variable's range")
    if apart > SAME_FLIGHT:
        sys.exit(f"error: more than {SAME_FLIGHT:.0e}")


if __name__ == "__main__":
    main()
