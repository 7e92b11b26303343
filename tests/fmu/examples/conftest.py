"""What the tests of an ensemble have alike."""

from __future__ import annotations

import numpy as np
import pytest

import container
import ensemble
import system
from batch import Loaded, Task
from harness import Package
from law import Law, autopilot_beside
from vehicles import VARIED

# Duration of a flight.
STOP_S = 4.0


@pytest.fixture(scope="session")
def fmus(package: Package, tmp_path_factory: pytest.TempPathFactory) -> Loaded:
    """The container of the loop, and the vehicle."""
    autopilot = autopilot_beside(package.path)
    loop = tmp_path_factory.mktemp("loop") / "loop.fmu"
    container.build(loop, system.native(package.path, autopilot))
    return Loaded(loop.read_bytes(), package.path.read_bytes())


@pytest.fixture(scope="session")
def task(package: Package) -> Task:
    """What the example flies."""
    autopilot = autopilot_beside(package.path)
    law = Law.within(autopilot)
    parts = system.native(package.path, autopilot, ensemble.LOOP / "manoeuvre.csv")
    commands = container.settings(parts)
    return Task(law, commands, STOP_S, b"", np.empty((0, len(VARIED))))
