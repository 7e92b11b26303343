"""Linear models of the vehicle, with the measurements and states that a design needs."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.linalg import expm

# The package of this repository, unless it is installed.
sys.path.append(str(Path(__file__).resolve().parents[2] / "python/src"))
from ahv import FMUError as FMUError
from ahv import Linearizer, LinearModel
from law import PERIOD_S

MEASURED = ("V", "gamma", "q")
SLOSHING = ("slosh1", "slosh2")
RIGID, EVEN, SLOSH = 1, 2, 3
# States of the design model; height hardly affects V, gamma and q within seconds.
RIGID_STATES = ["V", "gamma", "alpha", "q"]
FLEXIBLE_STATES = [f"eta{i}{suffix}" for i in (1, 2, 3) for suffix in ("", "_dot")]
SLOSH_STATES = [f"{slosh}{suffix}" for slosh in SLOSHING for suffix in ("", "_dot")]
STATES = {
    RIGID: RIGID_STATES,
    EVEN: RIGID_STATES + FLEXIBLE_STATES,
    SLOSH: RIGID_STATES + FLEXIBLE_STATES + SLOSH_STATES,
}


class Plant(NamedTuple):
    """x+ = A x + B u, y = C x."""

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray


def linearizer(folder: str | Path) -> Linearizer:
    """For the models of many vehicles, of the FMU unzipped in `folder`."""
    return Linearizer(folder, (*MEASURED, *SLOSHING))


def model(fmu: str | Path | Linearizer, **parameters: float) -> LinearModel:
    """Linear model of the FMU unzipped in a folder, with the measurements of the autopilot.

    With the displacements of the liquid in place of the slosh modes: where their frequencies cross,
    the modes change places, and gains between two levels of fuel could not be interpolated.
    """
    if not isinstance(fmu, Linearizer):
        with linearizer(fmu) as opened:
            return model(opened, **parameters)
    full = fmu.model(**parameters)
    liquid, measured = full.C[len(MEASURED) :], full.C[: len(MEASURED)]
    old = [full.states.index(f"eta_{slosh}") for slosh in SLOSHING]
    names = [name.removeprefix("eta_") if "slosh" in name else name for name in full.states]
    change = np.eye(len(names))
    if liquid.any():
        change[old] = liquid
        # A mode's rate stands behind it.
        moving = np.flatnonzero(liquid.any(axis=0))
        for row, displacement in zip(old, liquid, strict=True):
            change[row + 1, moving + 1] = displacement[moving]
    back = np.linalg.inv(change)
    return full._replace(
        A=change @ full.A @ back,
        B=change @ full.B,
        C=measured @ back,
        D=full.D[: len(MEASURED)],
        states=names,
        outputs=list(MEASURED),
    )


def rigid_model(folder: str) -> LinearModel:
    """The vehicle without bending and slosh, with the mass centre of the default vehicle."""
    centres = [
        model(folder, configuration=configuration).trim["mass_centre"]
        for configuration in (RIGID, SLOSH)
    ]
    return model(folder, configuration=RIGID, mass_centre_shift=centres[1] - centres[0])


def sampled(full: LinearModel, states: Sequence[str], period_s: float = PERIOD_S) -> Plant:
    """The model with these states only, discretised with held inputs."""
    kept = [full.states.index(name) for name in states]
    a, b = held(full.A[np.ix_(kept, kept)], full.B[kept], period_s)
    return Plant(a, b, full.C[:, kept])


def held(a: np.ndarray, b: np.ndarray, period_s: float) -> tuple[np.ndarray, np.ndarray]:
    """A and B over a period with held inputs, of the continuous ones: shapes (n, n) and (n, m)."""
    n, inputs = b.shape
    whole = np.zeros((n + inputs, n + inputs))
    whole[:n] = np.hstack([a, b])
    moved = expm(whole * period_s)
    return moved[:n, :n], moved[:n, n:]
