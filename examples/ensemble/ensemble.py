"""Monte Carlo in closed loop on Dask: slosh, fuel, air and mass vary, with one autopilot.

Results are written on arrival, one Parquet file per batch; the same command run again flies only
what is missing.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
LOOP = HERE.parent / "closed_loop"
sys.path[:0] = [str(HERE), str(LOOP)]
# The package of this repository, unless it is installed.
sys.path.append(str(HERE.parents[1] / "python/src"))
try:
    import numpy as np

    import command_line
    import container
    import pictures
    import system
    from batch import HISTORIES, SAMPLE_S, Loaded, Task
    from cluster import connect, fly
    from law import BadLaw, Law, autopilot_beside
    from parts import AnotherEnsemble, Parts, claim
    from sampling import sample
    from summary import COLUMNS, SAID, summary
    from system import BadSystem
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

# Flights that the envelope is drawn of.
DRAWN = 20_000


def bar(done: int, total: int, since: float) -> None:
    """Print progress on one line."""
    filled = 40 * done // total
    seconds = time.monotonic() - since
    left = seconds / done * (total - done) if done else 0.0
    line = f"[{'#' * filled}{'.' * (40 - filled)}] {done}/{total} flights, {left:5.0f} s left"
    print(f"\r{line}", end="", file=sys.stderr, flush=True)


def arguments() -> argparse.ArgumentParser:
    """Options that say which ensemble it is; other scripts on ensembles have them too."""
    parser = argparse.ArgumentParser(description=sys.modules["__main__"].__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--autopilot", type=Path, help="its FMU; default: beside the vehicle's")
    parser.add_argument("--flights", type=int, default=1000)
    parser.add_argument(
        "--stop", type=command_line.duration, default=20.0, help="duration of each flight, s"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=Path, default=Path("target/ensemble"))
    return parser


def prepare(options: argparse.Namespace) -> tuple[Loaded, Task, np.ndarray, Parts]:
    """FMUs, task, vehicles and parts of the ensemble; ends with a message if it is none."""
    autopilot = options.autopilot or autopilot_beside(options.fmu)
    command_line.need(options.fmu, autopilot)
    if options.flights < 1:
        sys.exit("error: at least one flight is expected")
    try:
        both = system.native(options.fmu, autopilot, LOOP / "manoeuvre.csv")
        commands = container.settings(both)
        law = Law.within(autopilot)
        what = {
            "flights": options.flights,
            "stop_s": options.stop,
            "seed": options.seed,
            "fmu": hashlib.sha256(options.fmu.read_bytes()).hexdigest(),
            "autopilot": hashlib.sha256(autopilot.read_bytes()).hexdigest(),
            "commands": commands,
        }
        identity = claim(options.output, what)
        loop = container.build(options.output / "loop.fmu", both)
    except AnotherEnsemble as other:
        sys.exit(f"error: {other}: give another --output")
    except (BadLaw, BadSystem, OSError) as failure:
        sys.exit(f"error: {failure}")
    vehicles = sample(options.flights, options.seed)
    task = Task(law, commands, options.stop, identity, vehicles[:0])
    fmus = Loaded(loop.read_bytes(), options.fmu.read_bytes())
    return fmus, task, vehicles, Parts(options.output / "flights", identity, vehicles)


def main() -> None:
    """Command line."""
    parser = arguments()
    parser.add_argument("--scheduler", help="Dask cluster, tcp://HOST:PORT; default: this machine")
    parser.add_argument("--workers", type=int, help="local processes; default: one per core")
    options = parser.parse_args()
    fmus, task, vehicles, parts = prepare(options)
    for line in parts.find():
        print(line, file=sys.stderr)
    total, kept = len(vehicles), parts.count()
    print(f"{total} flights of {options.stop:g} s; {kept} kept")

    failures = []
    if kept < total:
        with connect(options.scheduler, options.workers) as client:
            since, done = time.monotonic(), 0
            bar(0, total - kept, since)
            for flown in fly(client, fmus, task, vehicles, parts):
                if isinstance(flown, str):
                    failures.append(flown)
                else:
                    done += flown
                bar(done, total - kept, since)
            seconds = time.monotonic() - since
        print(f"\n{done} flights in {seconds:.0f} s: {done / seconds:.1f} per second")
    lost = (
        f"error: {total - parts.count()} of {total} flights are missing: run again to fly them\n"
        + "\n".join(failures[:SAID])
    )
    if not parts.count():
        sys.exit(lost)
    table = parts.table(COLUMNS)
    print(summary(table))
    images = [options.output / f"{name}.png" for name in ("envelope", "margins", "convergence")]
    pictures.envelope(parts.table(HISTORIES, DRAWN), task.commands, SAMPLE_S, images[0])
    pictures.margins(table, images[1])
    pictures.convergence(table, images[2])
    print(", ".join(map(str, (parts.folder, *images))))
    if parts.count() < total:
        sys.exit(lost)


if __name__ == "__main__":
    main()
