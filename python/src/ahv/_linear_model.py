"""A, B, C, D of the trimmed vehicle from the FMU's exact directional derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ahv._instance import Instance
from ahv._package import unzipped


class LinearModel(NamedTuple):
    """dx/dt = A x + B u, y = C x + D u about level flight; x, u and y are deviations from trim."""

    A: npt.NDArray[np.float64]
    """(states, states)"""
    B: npt.NDArray[np.float64]
    """(states, inputs)"""
    C: npt.NDArray[np.float64]
    """(outputs, states)"""
    D: npt.NDArray[np.float64]
    """(outputs, inputs)"""
    states: list[str]
    """Names of x; units are those of the FMU's variables."""
    inputs: list[str]
    """Names of u."""
    outputs: list[str]
    """Names of y."""
    trim: dict[str, float]
    """Values at trim: states, outputs, `alpha_trim`, `delta_e_trim`, `phi_trim`, `mass_centre`."""


def linear_model(
    fmu: str | PathLike[str] | None = None,
    outputs: str | Sequence[str] = ("V", "gamma"),
    inputs: Sequence[str] = ("delta_e", "phi"),
    **parameters: float | bool | str,
) -> LinearModel:
    """A, B, C, D of the trimmed vehicle.

    The FMU computes them by dual numbers: exact, without a step size. SI units and radians.

    Args:
        fmu: path of an FMU, of FMI 2.0 or 3.0, or of the folder that it was unzipped to; by
            default the FMU of this package. A folder is faster for many models.
        outputs: names of y, or one name.
        inputs: names of u.
        **parameters: of the FMU, such as `mach0=9.0`; enumerations by name or number, such as
            `configuration="Rigid"`.

    Raises:
        ValueError: there is no such variable or parameter, or no such value of an enumeration.
        FMUError: the FMU refuses a value, or has no trim; the text names the limit.

    Example:
        >>> np.linalg.eigvals(linear_model(mach0=9.0).A)  # poles, rad/s
    """
    outputs = (outputs,) if isinstance(outputs, str) else outputs
    with unzipped(fmu) as folder, Instance(folder) as instance:
        rates = [unknown.variable for unknown in instance.description.derivatives]
        states = [rate.derivative.name for rate in rates]
        xdot = [rate.name for rate in rates]
        for name, value in parameters.items():
            instance.set_parameter(name, value)
        instance.initialise()
        names = [*states, *outputs, "alpha_trim", "delta_e_trim", "phi_trim", "mass_centre"]
        return LinearModel(
            A=instance.jacobian(xdot, states),
            B=instance.jacobian(xdot, inputs),
            C=instance.jacobian(outputs, states),
            D=instance.jacobian(outputs, inputs),
            states=states,
            inputs=list(inputs),
            outputs=list(outputs),
            trim=dict(zip(names, instance.get(names), strict=True)),
        )
