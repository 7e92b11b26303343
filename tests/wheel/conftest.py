"""The wheel under test (AHV_WHEEL), installed for these tests, and its FMU (AHV_FMU)."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import mkdtemp

import pytest

ROOT = Path(__file__).resolve().parents[2]


def pytest_configure(config: pytest.Config) -> None:
    """Import the package from the wheel, not from the sources."""
    folder = mkdtemp(prefix="ahv wheel ")
    config.stash[INSTALLED] = Path(folder)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", folder]
    subprocess.run([*pip, os.environ["AHV_WHEEL"]], check=True)
    sys.path.insert(0, folder)


INSTALLED = pytest.StashKey[Path]()


@pytest.fixture(scope="session")
def root() -> Path:
    """Top directory of the repository."""
    return ROOT


@pytest.fixture(scope="session")
def wheel() -> Path:
    """The wheel under test."""
    return Path(os.environ["AHV_WHEEL"]).resolve()


@pytest.fixture(scope="session")
def installed(request: pytest.FixtureRequest) -> Path:
    """The folder in which the wheel is installed."""
    return request.config.stash[INSTALLED]


@pytest.fixture(scope="session")
def fmus() -> dict[str, Path]:
    """The vehicle's FMUs that the wheel was built with, by version of the standard."""
    fmu = Path(os.environ["AHV_FMU"]).resolve()
    return {"2.0": fmu, "3.0": fmu.with_name(f"{fmu.stem}_fmi3.fmu")}


@pytest.fixture(scope="session")
def all_fmus(fmus: dict[str, Path]) -> dict[tuple[str, str], Path]:
    """The FMUs that the wheel was built with, by version of the standard and model."""
    own = {("vehicle", version): file for version, file in fmus.items()}
    parts = {
        (part.name.removeprefix("ahv_"), version): file.with_name(
            file.name.replace("ahv", part.name, 1)
        )
        for part in (ROOT / "modelDescription").glob("ahv_*")
        for version, file in fmus.items()
    }
    assert len(parts) >= 2
    return own | parts


@pytest.fixture(scope="session")
def tool() -> Callable[..., subprocess.CompletedProcess[str]]:
    """`cargo ahv` with these arguments; Cargo itself says nothing."""

    def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
        command: Sequence[str] = ["cargo", "ahv", *map(str, arguments)]
        quiet = os.environ | {"CARGO_TERM_QUIET": "true"}
        return subprocess.run(
            command, cwd=ROOT, env=quiet, capture_output=True, text=True, check=False
        )

    return run
