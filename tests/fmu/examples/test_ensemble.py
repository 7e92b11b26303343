"""The example of an ensemble: nothing is lost, whatever dies, and every message says what to do."""

from __future__ import annotations

import hashlib
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
import pyarrow as pa
import pytest
from dask.distributed import Client, LocalCluster

import design
import ensemble
from batch import Task, fly_all
from flight import wanted
from harness import Package
from law import Law
from parts import AnotherEnsemble, Parts, claim

SCRIPT = Path(ensemble.__file__)
FLIGHTS, STOP_S = 100, 4.0
OPTIONS = ("--flights", str(FLIGHTS), "--stop", str(STOP_S))
# Time within which a worker restarts and flies the rest.
PATIENCE_S = 240.0


def command(package: Package, output: Path, *options: str) -> list[str]:
    """The example's command line."""
    files = ["--fmu", str(package.path), "--output", str(output)]
    return [sys.executable, str(SCRIPT), *files, *OPTIONS, *options]


def run(package: Package, output: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Run the example to its end."""
    line = command(package, output, *options)
    return subprocess.run(line, capture_output=True, text=True, check=False, timeout=PATIENCE_S)


def rows(output: Path) -> list[dict[str, object]]:
    """Flights in the order of the sample."""
    vehicles = ensemble.sample(FLIGHTS, 1)
    batches = [vehicles[i : i + ensemble.BATCH] for i in range(0, FLIGHTS, ensemble.BATCH)]
    said = output / "ensemble.json", output / "law.json"
    identity = hashlib.sha256(b"".join(path.read_bytes() for path in said)).hexdigest().encode()
    tables, _ = Parts(output / "flights", identity, ensemble.SCHEMA).read(batches)
    return [row for number in sorted(tables) for row in tables[number].to_pylist()]


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
    vehicles = ensemble.sample(FLIGHTS, 1)
    found = rows(flown)
    assert len(found) == FLIGHTS
    for row, vehicle in zip(found, vehicles, strict=True):
        assert {name: row[name] for name in vehicle} == vehicle
    for picture in ("envelope.png", "margins.png"):
        assert (flown / picture).stat().st_size > 10_000


def test_a_flight_is_the_same_on_any_worker(package: Package, flown: Path) -> None:
    manoeuvre = np.genfromtxt(ensemble.LOOP / "manoeuvre.csv", delimiter=",", names=True)
    law = design.design(design.model(str(package.folder)))
    commands = wanted(manoeuvre, STOP_S, design.PERIOD_S)
    picked = ensemble.sample(FLIGHTS, 1)[::50]
    here = fly_all(Task(package.path.read_bytes(), law, commands, picked))
    # Worker and this process may round differently, which an unstable loop amplifies.
    for mine, theirs in zip(here, rows(flown)[::50], strict=True):
        assert np.allclose(mine["gamma_rad"], theirs["gamma_rad"], rtol=0.0, atol=1e-9)
        assert mine["growth_per_s"] == pytest.approx(theirs["growth_per_s"], abs=1e-6)


def test_running_again_flies_only_what_is_missing(
    package: Package, cluster: LocalCluster, flown: Path
) -> None:
    """A part that is gone or cut off is flown again; files of other origin are named, not read."""
    before = rows(flown)
    folder = flown / "flights"
    (folder / "part-000002.parquet").unlink()
    cut = folder / "part-000001.parquet"
    cut.write_bytes(cut.read_bytes()[:-100])
    (folder / "part-000000.new").write_bytes(b"half")
    shutil.copy(folder / "part-000000.parquet", folder / "part-000007.parquet")
    again = run(package, flown, "--scheduler", cluster.scheduler_address)
    assert again.returncode == 0, again.stderr
    assert "2 of 4 batches kept" in again.stdout
    assert "50 flights in" in again.stdout and f"{FLIGHTS} vehicles" in again.stdout
    assert "part-000001.parquet is damaged, its flights are flown again" in again.stderr
    others = "not of this ensemble: part-000000.new, part-000007.parquet"
    assert others in again.stderr
    assert len(rows(flown)) == len(before)


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


def test_the_law_belongs_to_the_ensemble(package: Package, tmp_path: Path) -> None:
    """One that differs by rounding goes on as the law that is there; another one, or half
    of one, is refused."""
    law = design.design(design.model(str(package.folder)))
    first, identity = claim(tmp_path, {"seed": 1}, law)
    rounded = Law(**vars(law) | {"K": law.K * (1.0 + 1e-12)})
    again, same = claim(tmp_path, {"seed": 1}, rounded)
    assert same == identity and np.array_equal(again.K, first.K)
    with pytest.raises(AnotherEnsemble, match="differing: law"):
        claim(tmp_path, {"seed": 1}, Law(**vars(law) | {"K": law.K * 1.01}))
    for name in ("ensemble.json", "law.json"):
        file = tmp_path / name
        whole = file.read_bytes()
        file.write_bytes(whole[: len(whole) // 2])
        with pytest.raises(AnotherEnsemble, match="damaged"):
            claim(tmp_path, {"seed": 1}, law)
        file.write_bytes(whole)
    assert claim(tmp_path, {"seed": 1}, law)[1] == identity


def test_a_part_of_another_ensemble_is_not_read(tmp_path: Path) -> None:
    """The same batch, flown with another law or FMU, or other vehicles with the same number."""
    vehicles = ensemble.sample(4, 1)
    rows = [dict.fromkeys(ensemble.SCHEMA.names) | vehicle for vehicle in vehicles]
    table = pa.Table.from_pylist(rows, ensemble.SCHEMA)
    mine = Parts(tmp_path / "flights", b"mine", ensemble.SCHEMA)
    mine.write(0, table)
    assert mine.read([vehicles])[0][0].equals(table)
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["part-000000.parquet"]
    theirs = Parts(tmp_path / "flights", b"theirs", ensemble.SCHEMA)
    for parts, batch in ((theirs, vehicles), (mine, ensemble.sample(4, 2))):
        tables, (said,) = parts.read([batch])
        assert not tables and "is of another ensemble, its flights are flown again" in said


def test_an_unreachable_scheduler_is_named(
    package: Package, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    monkeypatch.setattr(ensemble, "CONNECT_S", 1)
    with pytest.raises(SystemExit) as refused:
        ensemble.connect(address, None)
    assert f"no scheduler answers at {address}" in str(refused.value)


def test_a_scheduler_without_workers_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ensemble, "CONNECT_S", 1)
    with (
        LocalCluster(n_workers=0, dashboard_address=None) as empty,
        pytest.raises(SystemExit) as refused,
    ):
        ensemble.connect(empty.scheduler_address, None)
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


def test_a_vehicle_that_cannot_be_trimmed_is_a_row_with_the_reason(package: Package) -> None:
    (vehicle,) = ensemble.sample(1, 1)
    law = design.design(design.model(str(package.folder)))
    weak = vehicle | {"aero": 1.0, "fuel_fraction": 1.0, "elevator_factor": 0.5}
    row, good = fly_all(Task(package.path.read_bytes(), law, np.zeros((100, 2)), [weak, vehicle]))
    assert not row["trimmed"] and "delta_e" in row["ended"] and row["flown_s"] == 0.0
    assert good["trimmed"] and good["ended"] == "" and good["flown_s"] == pytest.approx(1.0)
    # The columns of a table do not depend on the first vehicle, and no vehicle is lost.
    table = pa.Table.from_pylist([row, good], ensemble.SCHEMA)
    assert set(row) == set(good) == set(table.column_names)
    assert pa.Table.from_pylist([row], ensemble.SCHEMA).schema == table.schema
    said = ensemble.summary(table)
    assert "2 vehicles, 1 of them without a trim" in said and "1 flights" in said
    (reason,) = ensemble.refusals(table)
    assert "delta_e" in reason
