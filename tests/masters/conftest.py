"""The packaged FMU, and the flights of FMPy that every other master is compared with."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from harness import Package, packaged
from reference import Reference

DIFFERENCES = pytest.StashKey[dict[str, float]]()


@pytest.fixture(scope="session")
def package(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The FMU under test, unzipped once."""
    return packaged(tmp_path_factory.mktemp("ahv with space"))


@pytest.fixture(scope="session")
def reference(package: Package, request: pytest.FixtureRequest) -> Iterator[Reference]:
    """What FMPy makes of the flights."""
    reference = Reference(package)
    yield reference
    request.config.stash[DIFFERENCES] = reference.differences


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    """How far the master is from FMPy, in one line: `cargo ahv test` shows it."""
    differences = config.stash.get(DIFFERENCES, {})
    if differences:
        largest = ", ".join(f"{flown} {error:.0e}" for flown, error in differences.items())
        terminalreporter.write_line(f"difference: {largest}")
