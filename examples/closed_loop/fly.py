"""Connect vehicle and autopilot by a system structure (SSP), and fly it in three masters."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

try:
    import matplotlib
    import numpy as np
    from fmpy import extract

    import command_line
    import design
    import hardware
    import system
    from law import BadLaw, Law, autopilot_beside
    from margins import cell, margins
    from masters import MasterFailed, fly_ecos, fly_fmpy, fly_libcosim, names
    from models import FMUError
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Relative to each variable's range. The masters round time differently, which the integrator
# sees; the loop keeps the difference small.
SAME_FLIGHT = 1e-9
VERSIONS = ("1.0", "2.0")
# Outputs that a command changes at once; Ecos reads them after the exchange.
DIRECT = ("n_z", "delta_e_effective", "phi_effective", "choking_margin")
# Level flight of a vehicle: for the law, and as parameters of the native autopilot.
LEVEL = (system.MEASURED, ("delta_e_trim", "phi_trim"))
KNOWN = {"V_level": "V", "delta_e_trim": "delta_e_trim", "phi_trim": "phi_trim"}
PANELS = [
    ("change of speed, m/s", [("vehicle.V", "flown"), ("V_change", "wanted")], 1.0),
    ("$\\gamma$, deg", [("vehicle.gamma", "flown"), ("gamma_wanted", "wanted")], 57.296),
    ("$\\delta_e$, deg", [("vehicle.delta_e_effective", "")], 57.296),
    ("fuel ratio", [("vehicle.phi_effective", "")], 1.0),
    ("slosh, m", [("vehicle.slosh1", "fore"), ("vehicle.slosh2", "aft")], 1.0),
    ("$\\eta_1$, m of nose", [("vehicle.eta1", "")], 1.0),
]


def picture(rows: np.ndarray, outputs: list[str], wanted: np.ndarray, path: Path) -> None:
    """Plot the flight and what is wanted against time."""
    figure, axes = plt.subplots(3, 2, figsize=(9, 6.5), sharex=True, layout="constrained")
    for axis, (label, lines, factor) in zip(axes.T.ravel(), PANELS, strict=True):
        for name, legend in lines:
            if legend == "wanted":
                values = np.interp(rows[:, 0], wanted["time_s"], wanted[name]) * factor
            else:
                values = rows[:, 1 + outputs.index(name)] * factor
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


def agreement(
    one: np.ndarray, other: np.ndarray, outputs: list[str], without: tuple[str, ...] = ()
) -> float:
    """Largest difference of any of the vehicle's outputs, over its range."""
    compared = [name for name in outputs if name.startswith("vehicle.")]
    vehicle = [1 + outputs.index(name) for name in compared if name.split(".")[1] not in without]
    difference = np.abs(one[:, vehicle] - other[:, vehicle]).max(axis=0)
    ranges = np.ptp(one[:, vehicle], axis=0)
    # What does not change in this flight has no range.
    return float((difference / np.where(ranges > 0.0, ranges, 1.0)).max())


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--autopilot", type=Path, help="its FMU; default: beside the vehicle's")
    parser.add_argument(
        "--python",
        action="store_true",
        help="an autopilot in Python instead, designed on the FMU and exported by PythonFMU",
    )
    parser.add_argument(
        "--hardware", action="store_true", help="with two actuators and three sensors between them"
    )
    parser.add_argument(
        "--set",
        type=command_line.setting,
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="parameters of the vehicle",
    )
    parser.add_argument("--manoeuvre", type=Path, default=design.HERE / "manoeuvre.csv")
    parser.add_argument("--stop", type=command_line.duration, default=150.0, help="s")
    parser.add_argument("--patience", type=float, default=30.0, help="longest pause, s")
    parser.add_argument("--output", type=Path, default=Path("target/closed_loop"))
    options = parser.parse_args()
    autopilot = options.autopilot or autopilot_beside(options.fmu)
    between = hardware.components(options.fmu) if options.hardware else []
    native = [] if options.python else [autopilot]
    command_line.need(options.fmu, *native, *(part.fmu for part in between))
    command_line.make(options.output)

    folder, case = extract(str(options.fmu)), dict(options.set)
    files = {version: options.output / f"closed_loop_ssp{version[0]}.ssp" for version in VERSIONS}
    try:
        law = design.design(design.model(folder)) if options.python else Law.within(autopilot)
        vehicle = system.Component("vehicle", options.fmu, case)
        system.parameter_set(vehicle, system.read(options.fmu), "2.0")
        flown = design.model(folder, **case)
        if case:
            # The gains stay those of the default vehicle; level flight is another.
            law = law.at(*(np.array([flown.trim[name] for name in group]) for group in LEVEL))
        with tempfile.TemporaryDirectory() as name:
            if options.python:
                parts = system.foreign(
                    options.fmu, law, options.manoeuvre, Path(name), case, between
                )
            else:
                level = {own: flown.trim[name] for own, name in KNOWN.items()} if case else {}
                parts = system.native(
                    options.fmu, autopilot, options.manoeuvre, case, between, level
                )
            for version, file in files.items():
                system.build(file, parts, options.stop, version)
        wanted = system.check_manoeuvre(options.manoeuvre)
    except (BadLaw, FMUError, system.BadSystem, OSError, ValueError) as failure:
        sys.exit(f"error: {failure}")
    for actuator, name in enumerate(flown.inputs):
        if between:
            plant = hardware.with_hardware(flown, period_s=law.period_s)
        else:
            plant = design.sampled(flown, design.STATES[design.SLOSH], law.period_s)
        print(f"margins at {name}: {cell(margins(plant, law, actuator)._asdict())}")
    print(", ".join(map(str, files.values())))
    one, two = files.values()
    csv = options.output / "libcosim.csv"
    try:
        rows = fly_libcosim(two, csv, options.stop, options.patience)
    except MasterFailed as failure:
        sys.exit(f"error: {failure}")
    outputs = names(two)
    picture(rows, outputs, wanted, options.output / "flight.png")
    print(f"{csv}, {options.output / 'flight.png'}: {len(rows)} steps")
    others = {}
    if between:
        # It starts all connections at zero, so the noise of the first two readings is missing.
        print("FMPy is left out: its flight has another noise")
    else:
        others["FMPy"] = (fly_fmpy, ())
    if not options.python:
        others["Ecos"] = (fly_ecos, DIRECT)
    for master, (fly, without) in others.items():
        try:
            apart = agreement(rows, fly(one, options.stop), outputs, without)
        except MasterFailed as failure:
            print(f"{master} is left out: {failure}")
            continue
        print(f"libcosim and {master} differ by {apart:.1e} of a variable's range")
        if apart > SAME_FLIGHT:
            sys.exit(f"error: more than {SAME_FLIGHT:.0e}")


if __name__ == "__main__":
    main()
