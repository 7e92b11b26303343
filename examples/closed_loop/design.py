"""Design of the autopilot, with python-control.

As a program: gains scheduled over fuel, as `law.json` or in a copy of the FMU ahv_autopilot.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

try:
    import control as ct
    import numpy as np
    from fmpy import extract

    import command_line
    from law import LAW, PERIOD_S, BadLaw, Law, save_schedule
    from models import MEASURED, SLOSH, STATES, LinearModel, model, sampled
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

HERE = Path(__file__).resolve().parent
DEG = np.pi / 180
# Bryson's rule: acceptable errors of V and gamma, of their integrals over the seconds in which
# they should vanish, and acceptable actuator deflections.
ERROR = np.array([5.0, 0.5 * DEG])
VANISH_S = np.array([20.0, 5.0])
EFFORT = np.array([1.0 * DEG, 0.1])
# Standard deviations per sample: disturbances at the inputs (as in loop transfer recovery),
# disturbances of V, gamma and q, and sensor noise.
INPUT_NOISE = np.array([1.0 * DEG, 0.05])
STATE_NOISE = {"V": 0.01, "gamma": 0.001 * DEG, "q": 0.01 * DEG}
SENSOR_NOISE = np.array([0.5, 0.02 * DEG, 0.02 * DEG])
# Above it the vehicle, which doubles a disturbance in 0.15 s, has hardly any margins.
LONGEST_S = 0.1
# Fuel fractions of a schedule: dense where the margins of interpolated gains need it.
FUELS = [
    *(0.0, 0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2, 0.25),
    *(0.3, 0.4, 0.5, 0.75, 1.0),
]


def design(
    full: LinearModel,
    configuration: int = SLOSH,
    input_noise: float = 1.0,
    period_s: float = PERIOD_S,
) -> Law:
    """LQR with integral action and a Kalman filter, for a model of this configuration."""
    states = STATES[configuration]
    assert tuple(full.outputs) == MEASURED and states[:2] == ["V", "gamma"]
    plant, n = sampled(full, states, period_s), len(states)
    weight = np.zeros(n + 2)
    weight[:2], weight[n:] = 1 / ERROR**2, 1 / (ERROR * VANISH_S) ** 2
    gain, _, _ = ct.dlqr(
        plant.A,
        plant.B,
        np.diag(weight),
        np.diag(1 / EFFORT**2),
        integral_action=period_s * plant.C[:2],
    )
    noise = plant.B @ np.diag((input_noise * INPUT_NOISE) ** 2) @ plant.B.T
    for name, deviation in STATE_NOISE.items():
        noise[states.index(name), states.index(name)] += deviation**2
    # The gain of the one-step predictor: A P C' (C P C' + R)^-1.
    predictor, _, _ = ct.dlqe(plant.A, np.eye(n), plant.C, noise, np.diag(SENSOR_NOISE**2))
    trim = full.trim
    return Law(
        period_s=period_s,
        A=plant.A,
        B=plant.B,
        C=plant.C,
        K=gain[:, :n],
        Ki=gain[:, n:],
        L=predictor,
        level=np.array([trim[name] for name in MEASURED]),
        trim=np.array([trim["delta_e_trim"], trim["phi_trim"]]),
        fuel_mass_kg_per_m=trim["fuel_mass"],
    )


def schedule(folder: str, fuels: Sequence[float], period_s: float = PERIOD_S) -> list[Law]:
    """Designs for these fuel fractions, of the default vehicle otherwise."""
    return [
        replace(design(model(folder, fuel_fraction=fuel), period_s=period_s), fuel_fraction=fuel)
        for fuel in fuels
    ]


def with_law(autopilot: Path, law: Path, path: Path) -> None:
    """Write a copy of the FMU ahv_autopilot with another law."""
    new = path.with_name(path.name + ".new")
    with zipfile.ZipFile(autopilot) as old, zipfile.ZipFile(new, "w") as archive:
        for entry in old.infolist():
            content = law.read_bytes() if entry.filename == LAW else old.read(entry)
            archive.writestr(entry, content)
    new.replace(path)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--fuel", type=float, nargs="+", default=FUELS, help="fuel fractions")
    parser.add_argument(
        "--period", type=float, nargs="+", default=[PERIOD_S], help="sampling periods, s"
    )
    parser.add_argument("--autopilot", type=Path, help="FMU to copy; then --output is an FMU too")
    parser.add_argument(
        "--output", type=Path, help="default: law.json, or own.fmu, in target/closed_loop"
    )
    options = parser.parse_args()
    own = [options.autopilot] if options.autopilot else []
    command_line.need(options.fmu, *own)
    if not all(0.0 < period_s <= LONGEST_S for period_s in options.period):
        sys.exit(f"error: periods must be more than 0 and at most {LONGEST_S} s")
    if not all(0.0 <= fuel <= 1.0 for fuel in options.fuel):
        sys.exit("error: fuel fractions must be within 0 and 1")
    output = options.output or Path("target/closed_loop", "own.fmu" if own else "law.json")
    if own and output.suffix != ".fmu":
        sys.exit(f"error: {output}: with --autopilot the output is an FMU, NAME.fmu")
    command_line.make(output.parent)
    try:
        for autopilot in own:
            Law.within(autopilot)
    except BadLaw as failure:
        sys.exit(f"error: {failure}")
    folder = extract(str(options.fmu))
    fuels = sorted(set(options.fuel))
    laws = [law for period_s in options.period for law in schedule(folder, fuels, period_s)]
    with tempfile.TemporaryDirectory() as name:
        file = Path(name) / "law.json" if own else output
        save_schedule(file, laws)
        for autopilot in own:
            with_law(autopilot, file, output)
    print(f"{output}: {len(laws)} designs")


if __name__ == "__main__":
    main()
