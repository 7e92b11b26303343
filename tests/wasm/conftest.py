"""The components, in AHV_WASM (by default target/components), and the FMUs, their measure."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from harness import MODELS, REPOSITORY, Package, packaged
from host import Host


@pytest.fixture(scope="session")
def package(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The FMU for this machine, unzipped once."""
    return packaged(tmp_path_factory.mktemp("ahv with space"))


def component(model: str) -> Path:
    """The file of a model's component."""
    folder = Path(os.environ.get("AHV_WASM", REPOSITORY / "target" / "components"))
    return folder / f"{model}.wasm"


@pytest.fixture
def host(package: Package) -> Host:
    """The vehicle's component in a fresh runtime."""
    return Host(component("ahv"), package)


@pytest.fixture(params=MODELS)
def each(request: pytest.FixtureRequest, tmp_path: Path) -> Host:
    """The component of each model in turn, beside its FMU."""
    return Host(component(request.param), packaged(tmp_path, request.param))
