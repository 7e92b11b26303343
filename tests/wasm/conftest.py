"""The component (AHV_WASM, by default target/ahv.wasm) and the packaged FMU, its measure."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from harness import REPOSITORY, Package, packaged
from host import Host


@pytest.fixture(scope="session")
def package(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The FMU for this machine, unzipped once."""
    return packaged(tmp_path_factory.mktemp("ahv with space"))


@pytest.fixture
def host(package: Package) -> Host:
    """The component in a fresh runtime."""
    return Host(Path(os.environ.get("AHV_WASM", REPOSITORY / "target" / "ahv.wasm")), package)
