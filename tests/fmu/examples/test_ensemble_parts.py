"""Results of an ensemble on disk, and the sizes of its batches."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

import batch
import cluster
from parts import AnotherEnsemble, Parts, claim
from sampling import sample
from vehicles import VARIED


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
    for cores, longest_s in ((2, cluster.AIM_S), (1000, 1000 / cluster.FILES_PER_S)):
        batches = cluster.Batches([range(10), range(50, 1_000_000)])
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
        assert sizes[-1] <= 100 * cluster.LEAST_S
