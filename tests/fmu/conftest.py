"""The packaged FMU (AHV_FMU, by default target/ahv.fmu) and the oracle's vehicles."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from harness import REPOSITORY, Package, packaged
from oracle import Vehicle


@pytest.fixture(scope="session")
def repository() -> Path:
    """Top directory of the repository."""
    return REPOSITORY


@pytest.fixture(scope="session")
def package(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The FMU under test, unzipped once."""
    return packaged(tmp_path_factory.mktemp("ahv with space"))


@pytest.fixture(scope="session")
def vehicle() -> Callable[..., Vehicle]:
    """Vehicles of the oracle, by their parameters; each takes seconds, so they are kept."""
    return cache(Vehicle)
