"""The example of an ensemble: nothing is lost, whatever dies, and every message says what to do."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
import zipfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from dask.distributed import Client, LocalCluster

import batch
import cluster as dask_cluster
import ensemble
from batch import Loaded, Task, fly_all
from harness import Package
from law import LAW, autopilot_beside
from parts import Parts
from sampling import sample
from vehicles import VARIED

SCRIPT = Path(ensemble.__file__)
FLIGHTS, STOP_S = 400, 4.0
OPTIONS = ("--flights", str(FLIGHTS), "--stop", str(STOP_S))
# Time within which a worker restarts and flies the rest.
PATIENCE_S = 240.0


def command(package: Package, output: Path, *options: str) -> list[str]:
    """The example's command line."""
    autopilot = autopilot_beside(package.path)
    files = ["--fmu", str(package.path), "--autopilot", str(autopilot), "--output", str(output)]
    return [sys.executable, str(SCRIPT), *files, *OPTIONS, *options]


def run(package: Package, output: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Run the example to its end."""
    line = command(package, output, *options)
    return subprocess.run(line, capture_output=True, text=True, check=False, timeout=PATIENCE_S)


def found(output: Path) -> Parts:
    """The parts of an ensemble."""
    identity = hashlib.sha256((output / "ensemble.json").read_bytes()).hexdigest().encode()
    own = Parts(output / "flights", identity, sample(FLIGHTS, 1))
    own.find()
    return own


def rows(output: Path) -> list[dict[str, object]]:
    """Flights in the order of the sample."""
    return found(output).table(batch.SCHEMA.names).to_pylist()


@pytest.fixture(scope="module")
def cluster() -> Iterator[LocalCluster]:
    """Two workers in processes of their own, whom a nanny replaces."""
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        yield cluster


@pytest.fixture(scope="module")
def flown(
    package: Package, cluster: LocalCluster, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """An ensemble during which a busy worker was killed as soon as the first results were there."""
    output = tmp_path_factory.mktemp("ensemble")
    line = command(package, output, "--scheduler", cluster.scheduler_address)
    with (
        Client(cluster) as client,
        subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as flying,
    ):
        # Slow work comes first: a worker must not finish between the check and the kill.
        processes = client.run(os.getpid)
        end, busy = time.monotonic() + PATIENCE_S, []
        while not (busy and list(output.glob("flights/part-*.parquet"))):
            assert flying.poll() is None, "over before a worker was killed"
            assert time.monotonic() < end, "no result"
            time.sleep(0.01)
            busy = [worker for worker, batches in client.processing().items() if batches]
        os.kill(processes[busy[0]], signal.SIGKILL)
        said, wrong = flying.communicate(timeout=PATIENCE_S)
    assert flying.returncode == 0, said + wrong
    return output


def test_a_worker_that_dies_loses_no_result(flown: Path) -> None:
    vehicles, flights = sample(FLIGHTS, 1), rows(flown)
    assert len(flights) == FLIGHTS
    assert np.array_equal([[row[name] for name in VARIED] for row in flights], vehicles)
    for picture in ("envelope.png", "margins.png", "convergence.png"):
        assert (flown / picture).stat().st_size > 10_000


def test_a_result_that_dies_with_its_worker_is_awaited() -> None:
    """Between the end of a batch and the transfer of its result."""
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        future = client.submit(os.getpid)
        first = future.result()
        os.kill(first, signal.SIGKILL)
        end = time.monotonic() + PATIENCE_S
        while future.status != "lost":
            assert time.monotonic() < end, "the worker is still there"
            time.sleep(0.01)
        again = dask_cluster.result(future)
    assert isinstance(again, int) and again != first


def test_a_flight_is_the_same_on_any_worker(fmus: Loaded, task: Task, flown: Path) -> None:
    """And whichever flights were flown before it by the same instance."""
    here = fly_all(fmus, task._replace(vehicles=sample(FLIGHTS, 1)[::50]))
    # LAPACK may round differently on another processor.
    for mine, theirs in zip(here, rows(flown)[::50], strict=True):
        assert mine["gamma_rad"] == theirs["gamma_rad"]
        assert mine["growth_per_s"] == pytest.approx(theirs["growth_per_s"], abs=1e-6)


def test_running_again_flies_only_what_is_missing(
    package: Package, cluster: LocalCluster, flown: Path
) -> None:
    """A part that is gone or cut off is flown again; files of other origin are named, not read.

    Whatever the sizes of the parts: those of the second run are others.
    """
    before = rows(flown)
    folder = flown / "flights"
    gone, cut, first, *_ = sorted(folder.iterdir())
    missing = sum(pq.read_metadata(path).num_rows for path in (gone, cut))
    gone.unlink()
    cut.write_bytes(cut.read_bytes()[:-100])
    (folder / "part-000000.new").write_bytes(b"half")
    shutil.copy(first, folder / "part-000999.parquet")
    again = run(package, flown, "--scheduler", cluster.scheduler_address)
    assert again.returncode == 0, again.stderr
    assert f"{FLIGHTS - missing} kept" in again.stdout
    assert f"{missing} flights in" in again.stdout and f"{FLIGHTS} vehicles" in again.stdout
    assert f"{cut.name} is damaged, its flights are flown again" in again.stderr
    others = "not of this ensemble: part-000000.new, part-000999.parquet"
    assert others in again.stderr
    # NaN is not equal to itself.
    assert repr(rows(flown)) == repr(before)


def test_two_ensembles_are_not_mixed(package: Package, flown: Path, tmp_path: Path) -> None:
    other = run(package, flown, "--seed", "2")
    assert other.returncode == 1 and "holds another ensemble; differing: seed" in other.stderr
    # Another FMU, by an irrelevant byte.
    fmu = tmp_path / "ahv.fmu"
    shutil.copy(package.path, fmu)
    with zipfile.ZipFile(fmu, "a") as archive:
        archive.writestr("extra/note.txt", "another")
    other = run(package, flown, "--fmu", str(fmu))
    assert other.returncode == 1 and "holds another ensemble; differing: fmu" in other.stderr


def test_an_unreachable_scheduler_is_named(
    package: Package, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    monkeypatch.setattr(dask_cluster, "CONNECT_S", 1)
    with pytest.raises(SystemExit) as refused:
        dask_cluster.connect(address, None)
    assert f"no scheduler answers at {address}" in str(refused.value)


def test_a_scheduler_without_workers_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dask_cluster, "CONNECT_S", 1)
    with (
        LocalCluster(n_workers=0, dashboard_address=None) as empty,
        pytest.raises(SystemExit) as refused,
    ):
        dask_cluster.connect(empty.scheduler_address, None)
    assert f"the scheduler at {empty.scheduler_address} has no worker" in str(refused.value)


def test_a_scheduler_that_dies_loses_no_result(
    package: Package, cluster: LocalCluster, tmp_path: Path
) -> None:
    code = (
        "from dask.distributed import LocalCluster\n"
        "cluster = LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None)\n"
        "print(cluster.scheduler_address, flush=True)\n"
        "input()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as scheduler:
        line = command(package, tmp_path, "--scheduler", scheduler.stdout.readline().strip())
        with subprocess.Popen(
            line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as flying:
            end = time.monotonic() + PATIENCE_S
            while not list(tmp_path.glob("flights/part-*.parquet")):
                assert flying.poll() is None and time.monotonic() < end
                time.sleep(0.01)
            scheduler.kill()
            _, said = flying.communicate(timeout=PATIENCE_S)
    assert flying.returncode == 1
    assert "the scheduler is gone" in said and "run again" in said and "Traceback" not in said
    kept = len(rows(tmp_path))
    assert 0 < kept < FLIGHTS
    again = run(package, tmp_path, "--scheduler", cluster.scheduler_address)
    assert again.returncode == 0, again.stderr
    assert f"{FLIGHTS - kept} flights in" in again.stdout and len(rows(tmp_path)) == FLIGHTS


def script(name: str, package: Package, output: Path, *options: str) -> str:
    """Run another script on an ensemble to its end; what it prints."""
    line = command(package, output, *options)
    line[1] = str(SCRIPT.with_name(f"{name}.py"))
    done = subprocess.run(line, capture_output=True, text=True, check=False, timeout=PATIENCE_S)
    return done.stdout + done.stderr


def test_the_worst_flights_are_replayed_from_their_rows(package: Package, flown: Path) -> None:
    """Bit for bit, in an instance of its own."""
    said = script("replay", package, flown)
    assert "least phase margin: as in the ensemble, bit for bit" in said
    assert (flown / "worst.png").stat().st_size > 10_000
    assert "flight 7, flight 7: as in the ensemble" in script(
        "replay", package, flown, "--number", "7"
    )
    assert f"error: there is no flight {FLIGHTS}" in script(
        "replay", package, flown, "--number", str(FLIGHTS)
    )


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--flights", "0"], "at least one flight"),
        (["--autopilot", "none.fmu"], "none.fmu does not exist"),
        (["--autopilot", "law.json"], "law.json is no FMU"),
        (["--autopilot", "own.fmu"], "own.fmu: K has the shape (2, 13); (2, 14) is needed"),
        (["--scheduler", "nowhere"], "no scheduler answers at nowhere"),
    ],
)
def test_what_cannot_be_flown_is_refused_in_one_line(
    package: Package, tmp_path: Path, options: list[str], said: str
) -> None:
    (tmp_path / "law.json").write_text("{}", "utf-8")
    with zipfile.ZipFile(autopilot_beside(package.path)) as fmu:
        (own, *_) = json.loads(fmu.read(LAW))["designs"]
    own["K"] = [row[:-1] for row in own["K"]]
    with zipfile.ZipFile(tmp_path / "own.fmu", "w") as fmu:
        fmu.writestr(LAW, json.dumps({"designs": [own]}))
    options = [str(tmp_path / text) if (tmp_path / text).is_file() else text for text in options]
    done = run(package, tmp_path / "out", *options)
    assert done.returncode == 1 and done.stderr.count("\n") == 1, done.stderr
    assert done.stderr.startswith("error: ") and said in done.stderr
