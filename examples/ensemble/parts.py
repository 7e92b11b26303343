"""Identity of an ensemble, and its results on disk: a Parquet file per batch, written on arrival.

Every file has the identity of the ensemble. Missing or damaged files, and those of other ensembles,
are flown again; other files in the folder are ignored.
"""

from __future__ import annotations

import hashlib
import json
import tempfile
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from law import Law

KEY = b"ensemble"
# Laws designed on different machines may differ by rounding.
SAME_LAW = 1e-6

# Vehicles: one row of varied parameters each.
Batch = list[dict[str, float]]


class AnotherEnsemble(Exception):
    """The folder holds results that do not belong to this ensemble."""


def claim(folder: Path, what: dict[str, object], law: Law) -> tuple[Law, bytes]:
    """The law and identity of the ensemble in a folder, which are written if it is new.

    The law that is kept there flies all parts, whichever machine goes on. Raises AnotherEnsemble if
    `what` or the law differ from what is there.
    """
    kept, kept_law = folder / "ensemble.json", folder / "law.json"
    if kept.exists():
        try:
            before = json.loads(kept.read_text(encoding="utf-8"))
            known = Law.load(kept_law) if kept_law.exists() else None
        except ValueError as failure:
            raise AnotherEnsemble(f"{folder} holds a damaged ensemble: {failure}") from failure
        differ = [name for name in what if before.get(name) != what[name]]
        if known is None or not alike(known, law):
            differ.append("law")
        if differ:
            raise AnotherEnsemble(
                f"{folder} holds another ensemble; differing: {', '.join(differ)}"
            )
        law = known
    else:
        folder.mkdir(parents=True, exist_ok=True)
        law.save(kept_law)
        law = Law.load(kept_law)
        # A truncated file would match no ensemble.
        new = kept.with_suffix(".new")
        new.write_text(json.dumps(what, indent=1), encoding="utf-8")
        new.replace(kept)
    identity = hashlib.sha256(kept.read_bytes() + kept_law.read_bytes())
    return law, identity.hexdigest().encode()


def alike(one: Law, other: Law) -> bool:
    """Whether two laws are equal up to rounding."""
    pairs = [(np.asarray(vars(one)[name]), np.asarray(vars(other)[name])) for name in vars(one)]
    return all(
        a.shape == b.shape and np.allclose(a, b, rtol=SAME_LAW, atol=SAME_LAW * np.abs(a).max())
        for a, b in pairs
    )


class Parts:
    """The parts of one ensemble in a folder."""

    def __init__(self, folder: Path, identity: bytes, schema: pa.Schema) -> None:
        self.folder, self.schema = folder, schema.with_metadata({KEY: identity})
        folder.mkdir(parents=True, exist_ok=True)

    def path(self, number: int) -> Path:
        """File of a batch."""
        return self.folder / f"part-{number:06}.parquet"

    def write(self, number: int, table: pa.Table) -> None:
        """Write a part; an incomplete file is in another folder and has another name."""
        with tempfile.TemporaryDirectory(dir=self.folder.parent) as folder:
            new = Path(folder) / self.path(number).name
            pq.write_table(table.cast(self.schema), new)
            new.replace(self.path(number))

    def read(self, batches: list[Batch]) -> tuple[dict[int, pa.Table], list[str]]:
        """The existing parts by number, and a message on those ignored."""
        tables, said = {}, []
        names = {self.path(number).name for number in range(len(batches))}
        others = sorted(path.name for path in self.folder.iterdir() if path.name not in names)
        if others:
            more = ", ..." if len(others) > 3 else ""
            said.append(f"{self.folder}: not of this ensemble: {', '.join(others[:3])}{more}")
        for number, batch in enumerate(batches):
            path = self.path(number)
            if not path.exists():
                continue
            try:
                table = pq.read_table(path, partitioning=None)
            except (pa.ArrowException, OSError) as failure:
                said.append(f"{path} is damaged, its flights are flown again: {failure}")
                continue
            own = (table.schema.metadata or {}).get(KEY) == self.schema.metadata[KEY]
            if own and table.schema.equals(self.schema) and same(table, batch):
                tables[number] = table.replace_schema_metadata(None)
            else:
                said.append(f"{path} is of another ensemble, its flights are flown again")
        return tables, said


def same(table: pa.Table, batch: Batch) -> bool:
    """Whether the part is of these vehicles."""
    return table.select(list(batch[0])).to_pylist() == batch
