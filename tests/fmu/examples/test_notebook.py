"""The notebook of the examples runs, and its stored output is that of this FMU.

`python tests/fmu/examples/test_notebook.py` runs it and keeps the new outputs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

from harness import Package

NOTEBOOK = Path(__file__).parents[3] / "examples/from_fmu_to_closed_loop.ipynb"
PATIENCE_S = 300
NUMBER = re.compile(r"[+-]?\d+(?:\.\d+)?")
# Tolerance of printed numbers: half of the second decimal, and margins between grid points.
RELATIVE, ABSOLUTE = 0.02, 0.011


def execute() -> nbformat.NotebookNode:
    """The notebook, run anew where it stands."""
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    NotebookClient(
        notebook,
        timeout=PATIENCE_S,
        record_timing=False,
        coalesce_streams=True,
        resources={"metadata": {"path": str(NOTEBOOK.parent)}},
    ).execute()
    return notebook


def printed(notebook: nbformat.NotebookNode) -> Iterator[str]:
    """What each cell prints, and the kind of each picture; a kernel may send a text in parts."""
    for cell in notebook.cells:
        outputs = cell.get("outputs", [])
        text = "".join(output.get("text", "") for output in outputs)
        if text:
            yield text
        for output in outputs:
            if "text" not in output:
                yield "image/png" if "image/png" in output.get("data", {}) else "?"


@pytest.fixture(scope="module")
def run(package: Package) -> nbformat.NotebookNode:
    """The notebook with this FMU."""
    with pytest.MonkeyPatch.context() as environment:
        environment.setenv("AHV_FMU", str(package.path))
        return execute()


def test_the_notebook_prints_what_its_reader_sees(run: nbformat.NotebookNode) -> None:
    new, old = list(printed(run)), list(printed(nbformat.read(NOTEBOOK, as_version=4)))
    assert old.count("image/png") == 3 and "?" not in old
    assert [NUMBER.sub("#", text) for text in new] == [NUMBER.sub("#", text) for text in old]
    for mine, theirs in zip(new, old, strict=True):
        values = [[float(number) for number in NUMBER.findall(text)] for text in (mine, theirs)]
        assert values[0] == pytest.approx(values[1], rel=RELATIVE, abs=ABSOLUTE), mine


def test_the_prose_of_the_notebook_holds(run: nbformat.NotebookNode) -> None:
    said = "\n".join(printed(run))
    assert "still in trim after 2 s: True" in said

    def numbers(line: str) -> list[float]:
        (found,) = re.findall(rf"^{line}(.*)$", said, re.MULTILINE)
        return [float(number) for number in NUMBER.findall(found)]

    _, fast = numbers("short period")
    (zero,) = numbers("zero in the right half plane")
    assert fast < zero < 2.0 * fast
    # Slosh at 3, 4, 6, 8 and 15 rad/s; tables of the poles' growth.
    assert [growth > 0.0 for growth in numbers("damping 0.05")] == 2 * [True] + 3 * [False]
    assert [growth > 0.0 for growth in numbers("damping 0.01")] == 4 * [True] + [False]
    (left,) = numbers("elevator left:")
    assert left > 1.0
    rigid, redesigned = numbers("rigid:"), numbers("redesigned:")
    assert rigid[0] < 30.0 and redesigned[0] == 60.0 and redesigned[1] < 0.5 * rigid[1]


if __name__ == "__main__":
    nbformat.write(execute(), NOTEBOOK)
