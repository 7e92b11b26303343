"""Identity of an ensemble, and its results on disk: Parquet files, each written on arrival.

A file is named after its first flight and holds any number of the flights from there on, so that
batches of any size fill the same ensemble. Every file has the identity of the ensemble. Flights
of missing or damaged files, and of other ensembles, are flown again; other files are ignored.
"""

from __future__ import annotations

import hashlib
import json
import re
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from batch import KEY, SCHEMA
from vehicles import VARIED

NAME = re.compile(r"part-(\d{6,})\.parquet")


class AnotherEnsemble(Exception):
    """The folder holds results that do not belong to this ensemble."""


def claim(folder: Path, what: dict[str, object]) -> bytes:
    """Identity of the ensemble in a folder, which is written there if it is new.

    Raises AnotherEnsemble if `what` differs from what is there.
    """
    kept = folder / "ensemble.json"
    if kept.exists():
        try:
            before = json.loads(kept.read_text(encoding="utf-8"))
        except ValueError as failure:
            raise AnotherEnsemble(f"{folder} holds a damaged ensemble: {failure}") from failure
        differ = [name for name in what if before.get(name) != what[name]]
        if differ:
            raise AnotherEnsemble(
                f"{folder} holds another ensemble; differing: {', '.join(differ)}"
            )
    else:
        folder.mkdir(parents=True, exist_ok=True)
        # A truncated file would match no ensemble.
        new = kept.with_suffix(".new")
        new.write_text(json.dumps(what, indent=1), encoding="utf-8")
        new.replace(kept)
    return hashlib.sha256(kept.read_bytes()).hexdigest().encode()


class Parts:
    """The parts of one ensemble of these vehicles in a folder."""

    def __init__(self, folder: Path, identity: bytes, vehicles: np.ndarray) -> None:
        self.folder, self.identity, self.vehicles = folder, identity, vehicles
        self._counts: dict[int, int] = {}
        folder.mkdir(parents=True, exist_ok=True)

    def path(self, first: int) -> Path:
        """File of the flights from this one on."""
        return self.folder / f"part-{first:06}.parquet"

    def write(self, first: int, content: bytes, count: int) -> None:
        """Write a part; an incomplete file is in another folder and has another name."""
        with tempfile.TemporaryDirectory(dir=self.folder.parent) as folder:
            new = Path(folder) / self.path(first).name
            new.write_bytes(content)
            new.replace(self.path(first))
        self._counts[first] = count

    def find(self) -> list[str]:
        """Look for the existing parts; a message on each that is ignored."""
        said, others = [], []
        end = 0
        for path in sorted(self.folder.iterdir(), key=lambda path: (len(path.name), path.name)):
            named = NAME.fullmatch(path.name)
            first = int(named[1]) if named else len(self.vehicles)
            if first >= len(self.vehicles):
                others.append(path.name)
                continue
            try:
                file = pq.ParquetFile(path)
                varied = file.read(list(VARIED)) if file.schema_arrow.equals(SCHEMA) else None
                metadata = file.schema_arrow.metadata or {}
            except (pa.ArrowException, OSError) as failure:
                said.append(f"{path} is damaged, its flights are flown again: {failure}")
                continue
            own = varied is not None and metadata.get(KEY) == self.identity and first >= end
            if own and self._same(varied, first):
                self._counts[first] = varied.num_rows
                end = first + varied.num_rows
            else:
                said.append(f"{path} is of another ensemble, its flights are flown again")
        if others:
            more = ", ..." if len(others) > 3 else ""
            said.append(f"{self.folder}: not of this ensemble: {', '.join(others[:3])}{more}")
        return said

    def _same(self, varied: pa.Table, first: int) -> bool:
        rows = np.column_stack([column.to_numpy() for column in varied.columns])
        return np.array_equal(rows, self.vehicles[first : first + len(rows)])

    def missing(self) -> list[range]:
        """Flights of which there is no part."""
        gaps, end = [], 0
        for first, count in [*sorted(self._counts.items()), (len(self.vehicles), 0)]:
            if first > end:
                gaps.append(range(end, first))
            end = first + count
        return gaps

    def count(self) -> int:
        """Number of flights in the parts."""
        return sum(self._counts.values())

    def table(self, columns: Sequence[str], at_most: int | None = None) -> pa.Table:
        """These columns of all flights in their order, or of some parts with about `at_most`."""
        firsts = sorted(self._counts)
        every = 1 if at_most is None else max(1, self.count() // at_most)
        read = [pq.read_table(self.path(first), columns=list(columns)) for first in firsts[::every]]
        return pa.concat_tables(table.replace_schema_metadata(None) for table in read)
