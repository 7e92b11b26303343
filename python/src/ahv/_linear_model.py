"""A, B, C, D of the trimmed vehicle from the FMU's exact directional derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from os import PathLike
from types import TracebackType
from typing import NamedTuple, Self

import numpy as np
import numpy.typing as npt

from ahv._instance import Instance
from ahv._package import unzipped

TRIM = ("alpha_trim", "delta_e_trim", "phi_trim", "mass_centre")


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


class Linearizer:
    """Linear models of many vehicles by one instance of the FMU: about a millisecond each.

    Args:
        fmu: path of an FMU, of FMI 2.0 or 3.0, or of the folder that it was unzipped to; by
            default the FMU of this package.
        outputs: names of y, or one name.
        inputs: names of u.

    Raises:
        ValueError: there is no such variable.

    Example:
        >>> with Linearizer() as linearizer:
        ...     models = [linearizer.model(mach0=mach) for mach in (7.0, 8.0, 9.0)]
    """

    def __init__(
        self,
        fmu: str | PathLike[str] | None = None,
        outputs: str | Sequence[str] = ("V", "gamma"),
        inputs: Sequence[str] = ("delta_e", "phi"),
    ) -> None:
        self._outputs = [outputs] if isinstance(outputs, str) else list(outputs)
        self._inputs = list(inputs)
        with ExitStack() as opened:
            folder = opened.enter_context(unzipped(fmu))
            self._instance = opened.enter_context(Instance(folder))
            rates = [unknown.variable for unknown in self._instance.description.derivatives]
            self._states = [rate.derivative.name for rate in rates]
            self._rows = [*[rate.name for rate in rates], *self._outputs]
            self._instance.references([*self._outputs, *self._inputs])
            self._opened = opened.pop_all()
        self._is_used = False

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Free the instance."""
        self._opened.close()

    def model(self, **parameters: float | bool | str) -> LinearModel:
        """A, B, C, D of the vehicle trimmed with these parameters.

        Args:
            **parameters: of the FMU, such as `mach0=9.0`; enumerations by name or number, such as
                `configuration="Rigid"`; others have their start values.

        Raises:
            ValueError: there is no such parameter, or no such value of an enumeration.
            FMUError: the FMU refuses a value, or has no trim; the text names the limit.
        """
        instance, n = self._instance, len(self._states)
        if self._is_used:
            instance.reset()
        self._is_used = True
        for name, value in parameters.items():
            instance.set_parameter(name, value)
        instance.initialise()
        jacobian = instance.jacobian(self._rows, [*self._states, *self._inputs])
        names = [*self._states, *self._outputs, *TRIM]
        return LinearModel(
            A=jacobian[:n, :n],
            B=jacobian[:n, n:],
            C=jacobian[n:, :n],
            D=jacobian[n:, n:],
            states=list(self._states),
            inputs=list(self._inputs),
            outputs=list(self._outputs),
            trim=dict(zip(names, instance.get(names), strict=True)),
        )


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
            default the FMU of this package. For many models, a `Linearizer` is faster.
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
    with Linearizer(fmu, outputs, inputs) as linearizer:
        return linearizer.model(**parameters)
