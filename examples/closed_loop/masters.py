"""One .ssp file in two independent masters: FMPy and DNV's libcosim.

`python masters.py SSP CSV STOP_S` flies it in libcosim and writes each row at once, so that rows
are kept if a component crashes the process.
"""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from fmpy.ssp.simulation import simulate_ssp
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver

from law import PERIOD_S
from system import connectors

# All outputs; the masters are compared by those of the vehicle, which come last.
NAMES = [
    f"{component}.{name}"
    for component, kinds in connectors().items()
    for name, kind in kinds.items()
    if kind == "output"
]
# Patience before the first step, while the process loads libraries.
START_S = 60.0
# Interval at which the output file of the master is checked.
LOOK_S = 0.2


class MasterFailed(Exception):
    """The master or a component ended early or hung; the message has the time of the last row."""


def fly_fmpy(ssp: Path, stop_s: float) -> np.ndarray:
    """Rows of time, s, and NAMES at the end of each step, in FMPy's SSP master."""
    # Half a step less, because the master sums time and rounding must not add a step.
    rows = simulate_ssp(str(ssp), stop_time=stop_s - 0.5 * PERIOD_S, step_size=PERIOD_S)
    return np.column_stack([rows["time"] + PERIOD_S, *[rows[name] for name in NAMES]])


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
    wanted = {}
    for component, slave in slaves.items():
        variables = {v.name.decode(): v.reference for v in execution.slave_variables(slave)}
        names = [name.split(".")[1] for name in NAMES if name.startswith(f"{component}.")]
        wanted[component] = (slave, [variables[name] for name in names])
    with csv.open("w", encoding="utf-8", buffering=1) as file:
        print("time_s", *NAMES, sep=",", file=file)
        for k in range(round(stop_s / PERIOD_S)):
            if not execution.step():
                sys.exit("libcosim gave up")
            values = [(k + 1) * PERIOD_S]
            for component in connectors():
                values += observer.last_real_values(*wanted[component])
            print(*map(float, values), sep=",", file=file)


if __name__ == "__main__":
    step_libcosim(Path(sys.argv[1]), Path(sys.argv[2]), float(sys.argv[3]))
