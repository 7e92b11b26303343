"""A system in three independent masters: FMPy, DNV's libcosim and Ecos.

`python masters.py SSP CSV STOP_S` flies it in libcosim and writes each row at once, so that rows
are kept if a component crashes the process.
"""

from __future__ import annotations

import subprocess
import sys
import time
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import ParameterSet, read_ssd
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver

from law import PERIOD_S
from system import SET, SSP

# Patience before the first step, while the process loads libraries.
START_S = 60.0
# Interval at which the output file of the master is checked.
LOOK_S = 0.2


class MasterFailed(Exception):
    """The master or a component ended early or hung; the message has the time of the last row."""


def names(ssp: Path) -> list[str]:
    """All outputs in a system, as component.name, in its order; the vehicle's come last."""
    with zipfile.ZipFile(ssp) as archive:
        structure = ElementTree.fromstring(archive.read("SystemStructure.ssd"))
    return [
        f"{component.get('name')}.{connector.get('name')}"
        for component in structure.iter(f"{{{SSP}Description}}Component")
        for connector in component.iter(f"{{{SSP}Description}}Connector")
        if connector.get("kind") == "output"
    ]


def parameters(ssp: Path) -> ParameterSet:
    """All parameters in a system of SSP 1.0, by component.name, for FMPy, which reads none."""
    every = ParameterSet(parameters=[])
    for component in read_ssd(str(ssp), validate=False).system.elements:
        for binding in component.parameterBindings:
            for parameter in binding.parameterValues[0].parameters:
                parameter.name = f"{component.name}.{parameter.name}"
                every.parameters.append(parameter)
    return every


def fly_fmpy(ssp: Path, stop_s: float) -> np.ndarray:
    """Rows of time, s, and outputs at the end of each step, in FMPy's SSP master."""
    # Half a step less, because the master sums time and rounding must not add a step.
    rows = simulate_ssp(
        str(ssp),
        stop_time=stop_s - 0.5 * PERIOD_S,
        step_size=PERIOD_S,
        parameter_set=parameters(ssp),
    )
    return np.column_stack([rows["time"] + PERIOD_S, *[rows[name] for name in names(ssp)]])


def fly_ecos(ssp: Path, stop_s: float) -> np.ndarray:
    """The same in Ecos, which reads SSP 1.0; or MasterFailed, if its library cannot be loaded.

    It exchanges values at the end of a step and reads outputs then: those that depend on a command
    at once are those of the next step.
    """
    try:
        from ecospy import EcosSimulation
    except (ImportError, OSError) as failure:
        raise MasterFailed(f"Ecos cannot be loaded: {failure}") from failure
    simulation = EcosSimulation(PERIOD_S, ssp_path=str(ssp))
    simulation.init(parameter_set=SET)
    outputs, rows = [name.replace(".", "::") for name in names(ssp)], []
    for k in range(round(stop_s / PERIOD_S)):
        simulation.step(1)
        rows.append([(k + 1) * PERIOD_S, *map(simulation.get_real, outputs)])
    simulation.terminate()
    return np.array(rows)


def fly_libcosim(ssp: Path, csv: Path, stop_s: float, patience_s: float = 30.0) -> np.ndarray:
    """The same in libcosim, in a process that must write a row every `patience_s`."""
    csv.unlink(missing_ok=True)
    command = [sys.executable, __file__, str(ssp), str(csv), str(stop_s)]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as master:
        size, since = -1, time.monotonic()
        while master.poll() is None:
            time.sleep(LOOK_S)
            now = csv.stat().st_size if csv.exists() else -1
            if now != size:
                size, since = now, time.monotonic()
            elif time.monotonic() - since > (patience_s if size > 0 else max(patience_s, START_S)):
                master.kill()
                raise MasterFailed(f"no answer for {patience_s:g} s {flown(csv)}")
        said = master.stdout.read().strip()
    if master.returncode:
        raise MasterFailed(f"{said or f'exit status {master.returncode}'}\nended {flown(csv)}")
    return read(csv)


def flown(csv: Path) -> str:
    """The time reached, for messages."""
    if not csv.exists() or not len(rows := read(csv)):
        return "before the first step was over"
    return f"after t = {rows[-1, 0]:.2f} s; the flight until then is in {csv}"


def read(csv: Path) -> np.ndarray:
    """Rows of a flight, without a truncated last line."""
    with csv.open(encoding="utf-8") as lines:
        rows = [line.rstrip("\n").split(",") for line in lines if line.endswith("\n")]
    return np.array([[float(value) for value in row] for row in rows[1:]])


def step_libcosim(ssp: Path, csv: Path, stop_s: float) -> None:
    """Fly in this process."""
    log_output_level(CosimLogLevel.ERROR)
    execution = CosimExecution.from_ssp_file(str(ssp), step_size=round(PERIOD_S * 1e9))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    slaves = {info.name.decode(): info.index for info in execution.slave_infos()}
    wanted, outputs = {}, names(ssp)
    for output in outputs:
        component, name = output.split(".")
        slave = slaves[component]
        variables = {v.name.decode(): v.reference for v in execution.slave_variables(slave)}
        wanted.setdefault(component, (slave, []))[1].append(variables[name])
    with csv.open("w", encoding="utf-8", buffering=1) as file:
        print("time_s", *outputs, sep=",", file=file)
        for k in range(round(stop_s / PERIOD_S)):
            if not execution.step():
                sys.exit("libcosim gave up")
            values = [(k + 1) * PERIOD_S]
            for slave, references in wanted.values():
                values += observer.last_real_values(slave, references)
            print(*map(float, values), sep=",", file=file)


if __name__ == "__main__":
    step_libcosim(Path(sys.argv[1]), Path(sys.argv[2]), float(sys.argv[3]))
