"""The packaged FMU (AHV_FMU, by default target/ahv.fmu) and the oracle's vehicles."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from pathlib import Path

import fmpy
import pytest

from harness import Package
from oracle import Vehicle

REPOSITORY = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def repository() -> Path:
    """Top directory of the repository."""
    return REPOSITORY


@pytest.fixture(scope="session")
def package(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The FMU under test, unzipped once."""
    path = Path(os.environ.get("AHV_FMU", REPOSITORY / "target" / "ahv.fmu")).resolve()
    if not path.is_file():
        pytest.fail(f"{path} does not exist: run `cargo ahv package` or set AHV_FMU", pytrace=False)
    folder = tmp_path_factory.mktemp("ahv with space")
    fmpy.extract(str(path), unzipdir=str(folder))
    return Package(path, folder)


@pytest.fixture(scope="session")
def vehicle() -> Callable[..., Vehicle]:
    """Vehicles of the oracle, by their parameters; each takes seconds, so they are kept."""
    return cache(Vehicle)
