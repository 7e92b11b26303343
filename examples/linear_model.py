"""A, B, C, D of the trimmed vehicle from the FMU's exact directional derivatives, in FMPy."""

from typing import NamedTuple

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave


class LinearModel(NamedTuple):
    """dx/dt = A x + B u, y = C x + D u about level flight; names of x, u and y, values at trim."""

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    states: list[str]
    inputs: list[str]
    outputs: list[str]
    trim: dict[str, float]


def linear_model(
    folder: str, outputs: tuple[str, ...] = ("V", "gamma"), **parameters: float
) -> LinearModel:
    """The FMU unzipped in `folder`, trimmed with these parameters (enumerations by number)."""
    description = read_model_description(folder)
    variables = {v.name: v for v in description.modelVariables}
    rates = [unknown.variable for unknown in description.derivatives]
    states = [rate.derivative.name for rate in rates]
    inputs = ["delta_e", "phi"]

    def references(names: list[str]) -> list[int]:
        return [variables[name].valueReference for name in names]

    fmu = FMU2Slave(
        guid=description.guid, unzipDirectory=folder, modelIdentifier="ahv", instanceName="linear"
    )
    fmu.instantiate()
    try:
        for name, value in parameters.items():
            kinds = {"Real": fmu.setReal, "Boolean": fmu.setBoolean}
            set_value = kinds.get(variables[name].type, fmu.setInteger)
            set_value(references([name]), [value])
        fmu.setupExperiment()
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()

        def jacobian(unknowns: list[int], knowns: list[int]) -> np.ndarray:
            """Derivatives of the unknowns with respect to each known."""
            columns = [fmu.getDirectionalDerivative(unknowns, [known], [1.0]) for known in knowns]
            return np.array(columns).T

        x, u, y = references(states), references(inputs), references(list(outputs))
        xdot = [rate.valueReference for rate in rates]
        names = [*states, *outputs, "alpha_trim", "delta_e_trim", "phi_trim", "mass_centre"]
        trim = dict(zip(names, fmu.getReal(references(names)), strict=True))
        return LinearModel(
            jacobian(xdot, x),
            jacobian(xdot, u),
            jacobian(y, x),
            jacobian(y, u),
            states,
            inputs,
            list(outputs),
            trim,
        )
    finally:
        fmu.freeInstance()


if __name__ == "__main__":
    model = linear_model(extract("target/ahv.fmu"))
    np.set_printoptions(precision=4, suppress=True)
    print("poles, rad/s:", np.linalg.eigvals(model.A), sep="\n")
