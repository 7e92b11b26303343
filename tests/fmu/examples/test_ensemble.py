"""The example of an ensemble: nothing is lost, whatever dies, and every message says what to do."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import zipfile
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from dask.distributed import Client, LocalCluster

import batch
import cluster as dask_cluster
import container
import ensemble
import replay
import summary
from batch import Loaded, Task, fly_all
from harness import Package
from law import LAW, Law, autopilot_beside
from parts import AnotherEnsemble, Parts, claim
from sampling import sample
from vehicles import VARIED

SCRIPT = Path(ensemble.__file__)
FLIGHTS, STOP_S = 400, 4.0
OPTIONS = ("--flights", str(FLIGHTS), "--stop", str(STOP_S))
# Time within which a worker restarts and flies the rest.
PATIENCE_S = 240.0
# Needs more elevator than there is.
WEAK = {"aero": 1.0, "fuel_fraction": 1.0, "elevator_factor": 0.5}


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
def fmus(package: Package, tmp_path_factory: pytest.TempPathFactory) -> Loaded:
    """The container of the loop, and the vehicle."""
    autopilot = autopilot_beside(package.path)
    loop = tmp_path_factory.mktemp("loop") / "loop.fmu"
    container.build(loop, package.path, autopilot)
    return Loaded(loop.read_bytes(), package.path.read_bytes())


@pytest.fixture(scope="module")
def task(package: Package) -> Task:
    """What the example flies."""
    law = Law.within(autopilot_beside(package.path))
    commands = container.commands(ensemble.LOOP / "manoeuvre.csv")
    return Task(law, commands, STOP_S, b"", sample(FLIGHTS, 1)[:0])


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


def test_a_damaged_ensemble_is_named(tmp_path: Path) -> None:
    identity = claim(tmp_path, {"seed": 1})
    file = tmp_path / "ensemble.json"
    whole = file.read_bytes()
    file.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(AnotherEnsemble, match="damaged"):
        claim(tmp_path, {"seed": 1})
    file.write_bytes(whole)
    assert claim(tmp_path, {"seed": 1}) == identity
    with pytest.raises(AnotherEnsemble, match="differing: seed"):
        claim(tmp_path, {"seed": 2})


def content(vehicles: np.ndarray, identity: bytes) -> bytes:
    """A part without flights."""
    flights = [
        dict.fromkeys(batch.SCHEMA.names) | dict(zip(VARIED, vehicle.tolist(), strict=True))
        for vehicle in vehicles
    ]
    table = pa.Table.from_pylist(flights, batch.SCHEMA.with_metadata({batch.KEY: identity}))
    file = BytesIO()
    pq.write_table(table, file)
    return file.getvalue()


def test_a_part_of_another_ensemble_is_not_read(tmp_path: Path) -> None:
    """The same flights with another autopilot or FMU, or other vehicles with the same numbers."""
    vehicles = sample(4, 1)
    mine = Parts(tmp_path / "flights", b"mine", vehicles)
    mine.write(0, content(vehicles, b"mine"), 4)
    again = Parts(tmp_path / "flights", b"mine", vehicles)
    assert again.find() == [] and again.missing() == [] and again.count() == 4
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["part-000000.parquet"]
    for identity, others in ((b"theirs", vehicles), (b"mine", sample(4, 2))):
        theirs = Parts(tmp_path / "flights", identity, others)
        (said,) = theirs.find()
        assert theirs.missing() == [range(4)]
        assert "is of another ensemble, its flights are flown again" in said


def test_parts_of_any_sizes_fill_an_ensemble(tmp_path: Path) -> None:
    """Also one that reaches into the next, which is then not read."""
    vehicles = sample(20, 1)
    own = Parts(tmp_path / "flights", b"mine", vehicles)
    for flights in (range(3, 5), range(5, 12), range(10, 14), range(16, 20)):
        part = content(vehicles[flights.start : flights.stop], b"mine")
        own.path(flights.start).write_bytes(part)
    (said,) = own.find()
    assert "part-000010.parquet" in said
    assert own.missing() == [range(3), range(12, 16)] and own.count() == 13
    table = own.table(["aero"])
    assert table["aero"].to_pylist() == [*vehicles[3:12, 3], *vehicles[16:, 3]]


def test_batches_are_sized_by_time_and_end_together() -> None:
    """A core flies 100 flights per second."""
    for cores, longest_s in ((2, dask_cluster.AIM_S), (1000, 1000 / dask_cluster.FILES_PER_S)):
        batches = dask_cluster.Batches([range(10), range(50, 1_000_000)])
        flown = [batches.next(cores), batches.next(cores)]
        assert flown == [range(8), range(8, 10)]
        batches.flown(10, 0.1)
        while flights := batches.next(cores):
            flown.append(flights)
        covered = [number for flights in flown for number in flights]
        assert covered == [*range(10), *range(50, 1_000_000)]
        sizes = [len(flights) for flights in flown]
        assert max(sizes) <= 100 * longest_s
        assert len(flown) < 1_000_000 / max(sizes) + 10 * cores
        assert sizes[-1] <= 100 * dask_cluster.LEAST_S


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


def test_a_vehicle_that_cannot_be_trimmed_is_a_row_with_the_reason(
    fmus: Loaded, task: Task
) -> None:
    vehicle = sample(1, 1)[0]
    weak = np.array(list((dict(zip(VARIED, vehicle, strict=True)) | WEAK).values()))
    row, good = fly_all(fmus, task._replace(vehicles=np.array([weak, vehicle]), stop_s=1.0))
    assert not row["trimmed"] and "delta_e" in row["ended"] and row["flown_s"] == 0.0
    assert good["trimmed"] and good["ended"] == "" and good["flown_s"] == pytest.approx(1.0)
    # The columns of a table do not depend on the first vehicle, and no vehicle is lost.
    table = pa.Table.from_pylist([row, good], batch.SCHEMA)
    assert set(row) == set(good) == set(table.column_names)
    assert pa.Table.from_pylist([row], batch.SCHEMA).schema == table.schema
    said = summary.summary(table)
    assert "2 vehicles" in said and re.search(r"50\.00 % \(9\.45 to 90\.55\)  no trim: 1", said)
    (reason,) = summary.refusals(table)
    assert "delta_e" in reason


def test_a_flight_that_ends_early_is_a_row_with_reason_and_time(fmus: Loaded, task: Task) -> None:
    """Slosh that grows until the liquid leaves its depth."""
    vehicle = dict.fromkeys(VARIED, 1.0) | {
        **{"slosh_damping": 0.005, "slosh_frequency": 5.0},
        **{"mass_centre_shift": 0.0, "pitch_rate_factor": 0.0},
    }
    vehicles = np.array([list(vehicle.values())])
    (row,) = fly_all(fmus, task._replace(vehicles=vehicles, stop_s=60.0))
    assert row["ended"].startswith("fmi2DoStep: slosh") and row["growth_per_s"] > 0.0
    until_s = float(re.search(r"at t = ([\d.]+) s", row["ended"])[1])
    assert until_s - 2 * batch.STEP_S < row["flown_s"] <= until_s < 60.0
    assert len(row["V_m_per_s"]) == 1 + int(row["flown_s"] / batch.SAMPLE_S)


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


def test_a_row_that_is_not_its_flight_is_named(fmus: Loaded, task: Task) -> None:
    (row,) = fly_all(fmus, task._replace(vehicles=sample(1, 1)))
    again = replay.fly(fmus, task, row)
    assert replay.same(again, row)
    row["gamma_rad"][-1] = np.nextafter(row["gamma_rad"][-1], 1.0)
    assert not replay.same(again, row)


def test_the_worst_are_picked() -> None:
    """Of stable, unstable, ended and untrimmed vehicles."""
    table = pa.table(
        {
            "trimmed": [True, True, True, True, True, False],
            "ended": ["", "alpha", "slosh1", "", "", "no trim"],
            "flown_s": [20.0, 7.0, 5.0, 20.0, 20.0, 0.0],
            "growth_per_s": [-0.1, 0.9, 0.2, 0.3, -0.2, None],
            "phase_deg": [12.0, np.nan, np.nan, np.nan, 9.0, None],
        }
    )
    assert replay.worst(table) == {
        "ended first": 2,
        "fastest growth": 3,
        "least phase margin": 4,
    }


def test_probabilities_have_their_intervals() -> None:
    """By Wilson: 5 of 50, from the formula; and 0 of 20, which excludes more than 16 %."""
    n, p, z = 50, 0.1, 1.959964
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z / (1 + z**2 / n) * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    assert summary.interval(5, n) == pytest.approx((middle - half, middle + half), abs=1e-6)
    assert summary.interval(0, 20) == pytest.approx((0.0, 0.161), abs=5e-4)


def test_sensitivity_is_found_where_it_is(package: Package, tmp_path: Path) -> None:
    """The coefficient set and the liquid decide; 64 samples show that."""
    line = [sys.executable, str(SCRIPT.with_name("sensitivity.py")), "--fmu", str(package.path)]
    line += ["--output", str(tmp_path), "--samples"]
    done = subprocess.run([*line, "64"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    tables = done.stdout.split("|---|---|---|")[1:]
    for table in tables:
        names = re.findall(r"^\| `(\w+)`", table, re.MULTILINE)
        assert set(names) == set(VARIED)
        assert set(names[:3]) <= {"aero", "slosh_damping", "slosh_frequency", "fuel_fraction"}
    assert (tmp_path / "sensitivity.png").stat().st_size > 10_000
    done = subprocess.run([*line, "60"], capture_output=True, text=True, check=False)
    assert done.returncode == 1 and done.stderr == "error: --samples 60 is no power of two\n"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--flights", "0"], "at least one flight"),
        (["--autopilot", "none.fmu"], "none.fmu does not exist"),
        (["--autopilot", "law.json"], "law.json: File is not a zip file"),
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
