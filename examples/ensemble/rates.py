"""Rates of masters for one flight of the ensemble: vehicles per second, with their start.

The container in FMPy, by the calls of FMPy that the ensemble uses, in libcosim and in Ecos; the two
FMUs connected by SSP in FMPy, libcosim and Ecos; and the vehicle with the law in numpy.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path

try:
    from fmpy import simulate_fmu
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    import ensemble
    import flight
    import masters
    import system
    from batch import OUTPUTS, STEP_S, margins_of, opened_loop, opened_vehicle, setting, unzipped
    from law import PERIOD_S, autopilot_beside
    from vehicles import parameters
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )


def container_in_libcosim(path: Path, stop_s: float) -> None:
    """One slave, observed after each step."""
    log_output_level(CosimLogLevel.ERROR)
    execution = CosimExecution.from_step_size(step_size=round(STEP_S * 1e9))
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=str(path), instance_name="loop"))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    variables = {v.name.decode(): v.reference for v in execution.slave_variables(slave)}
    references = [variables[name] for name in OUTPUTS]
    for _ in range(round(stop_s / STEP_S)):
        execution.step()
        observer.last_real_values(slave, references)


def container_in_ecos(path: Path, stop_s: float) -> None:
    """One instance, read after each step."""
    from ecospy import EcosSimulation, EcosSimulationStructure

    with EcosSimulationStructure() as structure:
        structure.add_model("loop", path)
        simulation = EcosSimulation(STEP_S, structure=structure)
    simulation.init()
    for _ in range(round(stop_s / STEP_S)):
        simulation.step(1)
        for name in OUTPUTS:
            simulation.get_real(f"loop::{name}")
    simulation.terminate()


def main() -> None:
    """Command line."""
    parser = ensemble.arguments()
    parser.set_defaults(flights=100, output=Path("target/rates"))
    parser.add_argument("--seconds", type=float, default=10.0, help="per master")
    options = parser.parse_args()
    fmus, task, vehicles, _ = ensemble.prepare(options)
    container, stop_s = options.output / "loop.fmu", options.stop
    (loop, folder), linearizer = opened_loop(fmus.loop), opened_vehicle(fmus.vehicle)[0]
    autopilot = options.autopilot or autopilot_beside(options.fmu)
    manoeuvre = ensemble.LOOP / "manoeuvre.csv"
    ssp = options.output / "closed_loop_ssp1.ssp"
    system.build(ssp, system.native(options.fmu, autopilot, manoeuvre), stop_s, "1.0")
    csv = options.output / "flight.csv"
    known = vehicles[0]
    _, trim = margins_of(linearizer, task.law, known)
    given = setting(task.commands, trim, known)
    steps = flight.wanted(system.check_manoeuvre(manoeuvre), stop_s, PERIOD_S)
    vehicle = unzipped(fmus.vehicle)
    ways: dict[str, Callable[[], object]] = {
        "container, one instance, FMPy's calls": lambda: loop.fly(given, stop_s, STEP_S),
        "the same, one step of 20 s": lambda: loop.fly(given, stop_s, stop_s),
        "container, FMPy": lambda: simulate_fmu(
            folder.name,
            stop_time=stop_s,
            output_interval=STEP_S,
            output=list(OUTPUTS),
            start_values=given,
        ),
        "container, libcosim": lambda: container_in_libcosim(container, stop_s),
        "container, Ecos": lambda: container_in_ecos(container, stop_s),
        "SSP, libcosim": lambda: masters.step_libcosim(ssp, csv, stop_s),
        "SSP, Ecos": lambda: masters.fly_ecos(ssp, stop_s),
        "SSP, FMPy": lambda: masters.fly_fmpy(ssp, stop_s),
        "law in numpy": lambda: flight.fly(
            vehicle.name, task.law, steps, OUTPUTS[2:5], **parameters(known)
        ),
        "margins alone": lambda: margins_of(linearizer, task.law, known),
    }
    print("| | flights per second and core | ms of a core |\n|---|---|---|")
    for name, way in ways.items():
        count, begin, busy = 0, time.monotonic(), time.process_time()
        while time.monotonic() - begin < options.seconds:
            way()
            count += 1
        spent = (time.process_time() - busy) / count
        print(f"| {name} | {1 / spent:.1f} | {1e3 * spent:.1f} |", flush=True)


if __name__ == "__main__":
    main()
