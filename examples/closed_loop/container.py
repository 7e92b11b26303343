"""The closed loop as one FMU: autopilot and vehicle in a container, which brings its own master.

FMUContainer of the FMU Manipulation Toolbox packs them with a native master. Every 10 ms all FMUs
step with what the others had before the step, as in the masters of SSP: a command acts one step
late. The container has the parameters of all, as `vehicle.mach0`, `autopilot.command1_time`; an
enumeration is an integer there. Names of FMUs are in lower case.
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

    import command_line
    import hardware
    import system
    from law import PERIOD_S, autopilot_beside
    from system import BadSystem, Component
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


def description(name: str, components: list[Component], period_s: float) -> dict[str, object]:
    """What FMUContainer reads."""
    return {
        "name": name,
        "fmu": [f"{component.name}.fmu" for component in components],
        "step_size": period_s,
        "sequential": False,
        "auto_parameter": True,
        "auto_link": False,
        "auto_output": False,
        "output": [[f"{fmu}.fmu", name, name] for fmu, names in OUTPUTS.items() for name in names],
        "link": [
            [f"{source}.fmu", output, f"{target}.fmu", into]
            for source, output, target, into in system.connected(components)
        ],
    }


def build(path: Path, components: list[Component], period_s: float = PERIOD_S) -> Path:
    """Write the container of these FMUs; or BadSystem, if one lacks a variable.

    Without their parameters: what FMUContainer starts with, the container's own parameters cannot
    change any more. `settings` are for its master.
    """
    # The toolbox warns of each output that is not connected.
    logging.getLogger(LOGGED).setLevel(logging.CRITICAL)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for component in components:
            system.read(component.fmu)
            shutil.copy(component.fmu, folder / f"{component.name}.fmu")
        plan = folder / "loop.json"
        text = json.dumps(description(path.name, components, period_s))
        plan.write_text(text, encoding="utf-8")
        try:
            Assembly(plan.name, fmu_directory=folder).make_fmu()
        except (FMUContainerError, AssemblyError) as failure:
            files = ", ".join(str(component.fmu) for component in components)
            raise BadSystem(f"{files}: {failure}") from failure
        shutil.copy(folder / path.name, path)
    return path


def settings(components: list[Component]) -> dict[str, float]:
    """Parameters of the components as those of the container, which names FMUs in lower case."""
    return {
        f"{component.name.lower()}.{name}": value
        for component in components
        for name, value in component.parameters.items()
    }


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--autopilot", type=Path, help="its FMU; default: beside the vehicle's")
    parser.add_argument(
        "--hardware", action="store_true", help="with two actuators and three sensors between them"
    )
    parser.add_argument("--output", type=Path, default=Path("target/closed_loop/loop.fmu"))
    options = parser.parse_args()
    autopilot = options.autopilot or autopilot_beside(options.fmu)
    between = hardware.components(options.fmu) if options.hardware else []
    command_line.need(options.fmu, autopilot, *(part.fmu for part in between))
    command_line.make(options.output.parent)
    try:
        build(options.output, system.native(options.fmu, autopilot, between=between))
    except (BadSystem, OSError) as failure:
        sys.exit(f"error: {failure}")
    count = len(read_model_description(str(options.output)).modelVariables)
    print(f"{options.output}: {count} variables")


if __name__ == "__main__":
    main()
