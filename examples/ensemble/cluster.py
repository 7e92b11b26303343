"""The ensemble on Dask: a cluster or this machine, and batches sized by time."""

from __future__ import annotations

import logging
import os
import sys
import zipfile
from collections.abc import Iterator
from concurrent.futures import CancelledError
from math import ceil
from pathlib import Path

import numpy as np
from dask.distributed import Client, Future, as_completed

import ahv
import batch
import law
from batch import Loaded, Task, fly_part
from parts import Parts

CONNECT_S = 10
# Worker failures after which a batch is given up.
RETRIES = 3
# The first batches show how long a flight takes; the others take so long that a lost worker loses
# little, and the client writes no more than so many files per second.
FIRST, AIM_S, LEAST_S, FILES_PER_S = 8, 5.0, 1.0, 10.0
# Batches that are at the scheduler, per core: one that is flown, and one that waits.
AHEAD = 2
# Files that every worker imports.
HERE, LOOP = Path(batch.__file__).parent, Path(law.__file__).parent
MODULES = [
    *(HERE / f"{name}.py" for name in ("batch", "vehicles")),
    *(LOOP / f"{name}.py" for name in ("flight", "law", "loop", "margins", "models")),
    *sorted(Path(ahv.__file__).parent.glob("*.py")),
]


def connect(scheduler: str | None, workers: int | None) -> Client:
    """An existing cluster, or one of processes on this machine."""
    if scheduler is None:
        # A worker that takes long to end is killed, which matters to nobody.
        logging.getLogger("distributed.nanny").setLevel(logging.ERROR)
        return Client(
            n_workers=workers or os.cpu_count(), threads_per_worker=1, dashboard_address=None
        )
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


def upload(client: Client, folder: Path) -> None:
    """Send the modules to all workers."""
    modules = folder / "modules.zip"
    with zipfile.ZipFile(modules, "w") as archive:
        for module in MODULES:
            is_packaged = module.parent == Path(ahv.__file__).parent
            archive.write(module, f"ahv/{module.name}" if is_packaged else module.name)
    client.upload_file(str(modules))


class Batches:
    """Divides missing flights into batches that take about as long as is aimed at."""

    def __init__(self, missing: list[range]) -> None:
        self._missing = list(missing)
        self._flights, self._seconds = 0, 0.0

    def flown(self, count: int, seconds: float) -> None:
        """A batch of so many flights took so long."""
        self._flights += count
        self._seconds += seconds

    def next(self, cores: int) -> range | None:
        """Flights of the next batch."""
        if not self._missing:
            return None
        size = FIRST
        if self._flights:
            aim_s = max(AIM_S, cores / FILES_PER_S)
            per_s = self._flights / self._seconds
            # Towards the end shorter ones, so that all cores end together.
            share = max(ceil(sum(map(len, self._missing)) / (AHEAD * cores)), LEAST_S * per_s)
            size = max(FIRST, round(min(aim_s * per_s, share)))
        gap = self._missing.pop(0)
        if len(gap) > size:
            self._missing.insert(0, gap[size:])
        return gap[:size]


def fly(
    client: Client, fmus: Loaded, task: Task, vehicles: np.ndarray, parts: Parts
) -> Iterator[int | str]:
    """Fly what is missing and write its parts; yields how many flights each has, or its error."""
    upload(client, parts.folder.parent)
    shared = client.scatter(fmus, broadcast=True, hash=True)
    batches, flown = Batches(parts.missing()), as_completed()
    flying: dict[Future, range] = {}

    def submit() -> None:
        try:
            cores = max(1, sum(client.ncores().values()))
        except OSError:
            # Without a scheduler; what is flown says so.
            return
        while len(flying) < AHEAD * cores and (flights := batches.next(cores)):
            mine = task._replace(vehicles=vehicles[flights.start : flights.stop])
            future = client.submit(fly_part, shared, mine, retries=RETRIES, pure=False)
            flying[future] = flights
            flown.add(future)

    submit()
    for future in flown:
        flights, outcome = flying.pop(future), result(future)
        if isinstance(outcome, str):
            yield f"flights {flights.start} to {flights.stop - 1}: {outcome}"
        else:
            content, seconds = outcome
            parts.write(flights.start, content, len(flights))
            batches.flown(len(flights), seconds)
            yield len(flights)
        if client.status == "running":
            submit()


def result(future: Future) -> tuple[bytes, float] | str:
    """What `fly_part` returned, or why it did not; waits if the result died with its worker."""
    try:
        # A future that was over may wait again: Dask repeats what a lost worker had done.
        failure = future.exception()
        return future.result() if failure is None else str(failure)
    except (CancelledError, OSError):
        return "the scheduler is gone"
