"""Monte Carlo in closed loop on Dask: slosh, fuel, air and mass vary, with one autopilot.

Results are written on arrival, one Parquet file per batch; the same command run again flies only
missing batches.
"""

from __future__ import annotations

import argparse
import hashlib
import logging
import re
import sys
import time
import zipfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).resolve().parent
LOOP = HERE.parent / "closed_loop"
sys.path[:0] = [str(HERE), str(LOOP)]
# The package of this repository, unless it is installed.
sys.path.append(str(HERE.parents[1] / "python/src"))
try:
    import numpy as np
    import pyarrow as pa
    from dask.distributed import Client, LocalCluster, as_completed
    from fmpy import extract
    from scipy.stats import qmc

    import ahv
    import design
    import pictures
    from batch import HISTORIES, MARGINS, NUMBERS, SAMPLE_EVERY, Task, fly_all
    from flight import wanted
    from parts import AnotherEnsemble, Parts, claim
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

# Files that every worker imports.
MODULES = [
    HERE / "batch.py",
    *(LOOP / f"{name}.py" for name in ("design", "flight", "law", "margins")),
    *sorted(Path(ahv.__file__).parent.glob("*.py")),
]
# Varied parameters of the FMU with their limits; uniform, slosh_damping in its logarithm.
VARIED = {
    "fuel_fraction": (0.2, 1.0),
    "slosh_damping": (0.005, 0.1),
    "slosh_frequency": (4.0, 12.0),
    "aero": (1, 3),
    "elevator_factor": (0.8, 1.2),
    "moment_alpha_factor": (0.8, 1.2),
    "mass_factor": (0.95, 1.05),
    "inertia_factor": (0.8, 1.2),
    "density_factor": (0.85, 1.15),
    "mass_centre_shift": (-0.3, 0.3),
    "pitch_rate_factor": (0.0, 1.0),
}
SETS = ("xu2015", "parker2007", "shock_expansion")
# Columns of flights, also for vehicles without trim, which have none.
SCHEMA = pa.schema(
    [(name, pa.float64()) for name in (*VARIED, *MARGINS, *NUMBERS, "flown_s")]
    + [(name, pa.list_(pa.float64())) for name in HISTORIES]
    + [("trimmed", pa.bool_()), ("ended", pa.string())]
)
BATCH = 25
CONNECT_S = 10
# Worker failures after which a batch is given up.
RETRIES = 3
# Number of reasons printed; after the loss of a cluster all batches have the same.
SAID = 5
# Slosh expected to be critical: near the short period, with little damping.
SLOW, LIGHT = 8.0, 0.03
NUMBER = re.compile(r"(?<![a-z])[+-]?\d+(\.\d+)?(e[+-]?\d+)?")


def sample(count: int, seed: int) -> list[dict[str, float]]:
    """Sample vehicles by a Latin hypercube."""
    unit = qmc.LatinHypercube(len(VARIED), rng=seed).random(count)
    columns = {}
    for (name, (low, high)), part in zip(VARIED.items(), unit.T, strict=True):
        if name == "aero":
            columns[name] = low + np.floor((high - low + 1) * part)
        elif name == "slosh_damping":
            columns[name] = low * (high / low) ** part
        else:
            columns[name] = low + (high - low) * part
    rows = np.column_stack([columns[name] for name in VARIED]).tolist()
    return [dict(zip(VARIED, row, strict=True)) for row in rows]


def connect(scheduler: str | None, workers: int | None) -> Client:
    """An existing cluster, or one of processes on this machine."""
    if scheduler is None:
        return Client(LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None))
    # Dask would print pages after the loss of a scheduler; fly() reports it in a line.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    try:
        client = Client(scheduler, timeout=CONNECT_S)
    except (OSError, ValueError) as failure:
        sys.exit(f"error: no scheduler answers at {scheduler} within {CONNECT_S} s: {failure}")
    try:
        client.wait_for_workers(1, timeout=CONNECT_S)
    except TimeoutError:
        client.close()
        sys.exit(
            f"error: the scheduler at {scheduler} has no worker: start `dask worker {scheduler}`"
        )
    return client


def fly(
    client: Client, tasks: dict[int, Task], fmu: bytes, parts: Parts
) -> Iterator[tuple[int, pa.Table | str]]:
    """Fly the batches and write their parts; yields number and table, or an error, of each."""
    modules = parts.folder.parent / "modules.zip"
    with zipfile.ZipFile(modules, "w") as archive:
        for module in MODULES:
            is_packaged = module.parent == Path(ahv.__file__).parent
            archive.write(module, f"ahv/{module.name}" if is_packaged else module.name)
    client.upload_file(str(modules))
    shared = client.scatter(fmu, broadcast=True, hash=True)
    futures = {
        client.submit(
            lambda fmu, task: fly_all(task._replace(fmu=fmu)), shared, task, retries=RETRIES
        ): number
        for number, task in tasks.items()
    }
    for future in as_completed(futures):
        number = futures[future]
        if future.status != "finished":
            # Without a scheduler the exception is not available.
            why = future.exception() or f"{future.status}: the scheduler is gone"
            yield number, f"batch {number}: {why}"
            continue
        table = pa.Table.from_pylist(future.result(), SCHEMA)
        parts.write(number, table)
        future.release()
        yield number, table


def bar(done: int, total: int, since: float) -> None:
    """Print progress on one line."""
    filled = 40 * done // total
    seconds = time.monotonic() - since
    left = seconds / done * (total - done) if done else 0.0
    line = f"[{'#' * filled}{'.' * (40 - filled)}] {done}/{total} batches, {left:5.0f} s left"
    print(f"\r{line}", end="", file=sys.stderr, flush=True)


def summary(table: pa.Table) -> str:
    """Print a summary of the ensemble."""
    trimmed = np.array(table["trimmed"])
    columns = {name: table[name].to_numpy()[trimmed].astype(float) for name in (*VARIED, *MARGINS)}
    saturated = table["saturated_steps"].to_numpy()[trimmed] > 0
    ended = [reason for reason in np.array(table["ended"])[trimmed] if reason]
    causes = Counter(
        # "fmi2DoStep: alpha = 0.1745 reached the edge of its valid range ..."
        reason.removeprefix("fmi2DoStep: ").split(" = ")[0]
        for reason in ended
    )
    phase = columns["phase_deg"]
    unstable, kept = np.isnan(phase), phase[~np.isnan(phase)]
    slow = (columns["slosh_frequency"] < SLOW) & (columns["slosh_damping"] < LIGHT)
    lines = [
        f"{table.num_rows} vehicles, {np.sum(~trimmed)} of them without a trim",
        *(f"    {count} {why}" for why, count in refusals(table).most_common(SAID)),
        f"{trimmed.sum()} flights: {len(ended)} ended early "
        f"({', '.join(f'{count} {cause}' for cause, count in causes.most_common()) or 'none'}), "
        f"{saturated.sum()} with an actuator at its limit",
        f"{unstable.sum()} with an unstable loop, {np.sum(unstable & slow)} of these with slosh "
        f"below {SLOW:g} rad/s and damping below {LIGHT:g}",
        f"phase margin of the others: least {kept.min(initial=np.inf):.1f}, "
        f"median {median(kept):.1f} deg; below 30 deg: {(kept < 30).sum()}",
    ]
    for number, name in enumerate(SETS, start=1):
        own = columns["aero"] == number
        if not own.any():
            continue
        lines.append(
            f"{name}: {own.sum()} flights, {100 * unstable[own].mean():.0f} % unstable, "
            f"median {median(phase[own & ~unstable]):.0f} deg"
        )
    return "\n".join(lines)


def median(values: np.ndarray) -> float:
    """NaN, if there are none."""
    return float(np.median(values)) if values.size else np.nan


def refusals(table: pa.Table) -> Counter[str]:
    """Why vehicles have no trim, without the numbers."""
    said = (
        row["ended"] for row in table.select(["trimmed", "ended"]).to_pylist() if not row["trimmed"]
    )
    return Counter(NUMBER.sub("#", reason) for reason in said)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--flights", type=int, default=1000)
    parser.add_argument("--stop", type=float, default=20.0, help="duration of each flight, s")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scheduler", help="Dask cluster, tcp://HOST:PORT; default: this machine")
    parser.add_argument("--workers", type=int, help="local processes; default: one per core")
    parser.add_argument("--output", type=Path, default=Path("target/ensemble"))
    options = parser.parse_args()
    if not options.fmu.is_file():
        sys.exit(f"error: {options.fmu} does not exist: run `cargo ahv package`")
    fmu = options.fmu.read_bytes()
    law = design.design(design.model(extract(str(options.fmu))))
    manoeuvre = np.genfromtxt(LOOP / "manoeuvre.csv", delimiter=",", names=True)
    commands = wanted(manoeuvre, options.stop, design.PERIOD_S)
    vehicles = sample(options.flights, options.seed)
    batches = [vehicles[i : i + BATCH] for i in range(0, len(vehicles), BATCH)]
    what = {
        "flights": options.flights,
        "stop_s": options.stop,
        "seed": options.seed,
        "batch": BATCH,
        "fmu": hashlib.sha256(fmu).hexdigest(),
        "commands": hashlib.sha256(commands.tobytes()).hexdigest(),
    }
    try:
        law, identity = claim(options.output, what, law)
    except AnotherEnsemble as other:
        sys.exit(f"error: {other}: give another --output")
    parts = Parts(options.output / "flights", identity, SCHEMA)
    tables, said = parts.read(batches)
    for line in said:
        print(line, file=sys.stderr)
    tasks = {
        number: Task(b"", law, commands, batch)
        for number, batch in enumerate(batches)
        if number not in tables
    }
    print(
        f"{len(vehicles)} flights of {options.stop:g} s; "
        f"{len(tables)} of {len(batches)} batches kept"
    )

    failures = []
    if tasks:
        since = time.monotonic()
        with connect(options.scheduler, options.workers) as client:
            bar(0, len(tasks), since)
            for done, (number, flown) in enumerate(fly(client, tasks, fmu, parts), start=1):
                bar(done, len(tasks), since)
                if isinstance(flown, str):
                    failures.append(flown)
                else:
                    tables[number] = flown
        seconds = time.monotonic() - since
        count = sum(len(task.vehicles) for number, task in tasks.items() if number in tables)
        print(f"\n{count} flights in {seconds:.0f} s: {count / seconds:.1f} per second")
    lost = (
        f"error: {len(failures)} of {len(batches)} batches are missing: run again to fly them\n"
        + "\n".join(failures[:SAID])
    )
    if not tables:
        sys.exit(lost)
    table = pa.concat_tables(tables[number] for number in sorted(tables))
    print(summary(table))
    every_s = SAMPLE_EVERY * design.PERIOD_S
    pictures.envelope(table, commands[::SAMPLE_EVERY], every_s, options.output / "envelope.png")
    pictures.margins(table, options.output / "margins.png")
    print(f"{parts.folder}, {options.output / 'envelope.png'}, {options.output / 'margins.png'}")
    if failures:
        sys.exit(lost)


if __name__ == "__main__":
    main()
