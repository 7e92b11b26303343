"""The closed loop as one FMU: autopilot and vehicle in a container, which brings its own master.

FMUContainer of the FMU Manipulation Toolbox packs both with a native master. Every 10 ms both FMUs
step with what the other had before the step, as in the masters of SSP: a command acts one step
late. The container has the parameters of both, as `vehicle.mach0`, `autopilot.command1_time`; an
enumeration is an integer there.
"""

from __future__ import annotations

import argparse
import json
import logging
import shutil
import sys
import tempfile
from pathlib import Path

try:
    from fmpy import read_model_description
    from fmu_manipulation_toolbox.assembly import Assembly, AssemblyError
    from fmu_manipulation_toolbox.container import FMUContainerError

    import system
    from law import PERIOD_S, autopilot_beside
    from system import COMMANDS, MEASURED, BadSystem
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

LOGGED = "fmu_manipulation_toolbox"
# Outputs of the container, by FMU.
OUTPUTS = {
    "vehicle": (
        *("V", "h", "gamma", "alpha", "eta1", "slosh1", "slosh2", "n_z"),
        *("delta_e_effective", "phi_effective", "choking_margin"),
    ),
    "autopilot": ("missed", "saturated"),
}


def description(name: str, period_s: float) -> dict[str, object]:
    """What FMUContainer reads."""
    vehicle, autopilot = "vehicle.fmu", "autopilot.fmu"
    return {
        "name": name,
        "fmu": [autopilot, vehicle],
        "step_size": period_s,
        "sequential": False,
        "auto_parameter": True,
        "auto_link": False,
        "auto_output": False,
        "output": [[f"{fmu}.fmu", name, name] for fmu, names in OUTPUTS.items() for name in names],
        "link": [
            *([vehicle, name, autopilot, name] for name in MEASURED),
            *([autopilot, name, vehicle, name] for name in COMMANDS),
        ],
    }


def build(path: Path, vehicle: Path, autopilot: Path, period_s: float = PERIOD_S) -> Path:
    """Write the container of these FMUs; or BadSystem, if one lacks a variable."""
    # The toolbox warns of each output that is not connected.
    logging.getLogger(LOGGED).setLevel(logging.CRITICAL)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for fmu, file in (("vehicle", vehicle), ("autopilot", autopilot)):
            system.read(file)
            shutil.copy(file, folder / f"{fmu}.fmu")
        plan = folder / "loop.json"
        plan.write_text(json.dumps(description(path.name, period_s)), encoding="utf-8")
        try:
            Assembly(plan.name, fmu_directory=folder).make_fmu()
        except (FMUContainerError, AssemblyError) as failure:
            raise BadSystem(f"{vehicle}, {autopilot}: {failure}") from failure
        shutil.copy(folder / path.name, path)
    return path


def commands(manoeuvre: Path) -> dict[str, float]:
    """The manoeuvre of a CSV file as parameters of the container; or BadSystem."""
    return {f"autopilot.{name}": value for name, value in system.commands(manoeuvre).items()}


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--autopilot", type=Path, help="its FMU; default: beside the vehicle's")
    parser.add_argument("--output", type=Path, default=Path("target/closed_loop/loop.fmu"))
    options = parser.parse_args()
    autopilot = options.autopilot or autopilot_beside(options.fmu)
    for file in (options.fmu, autopilot):
        if not file.is_file():
            sys.exit(f"error: {file} does not exist: run `cargo ahv package`")
    options.output.parent.mkdir(parents=True, exist_ok=True)
    try:
        build(options.output, options.fmu, autopilot)
    except (BadSystem, OSError) as failure:
        sys.exit(f"error: {failure}")
    count = len(read_model_description(str(options.output)).modelVariables)
    print(f"{options.output}: {count} variables")


if __name__ == "__main__":
    main()
