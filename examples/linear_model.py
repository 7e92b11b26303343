"""A, B, C, D of the trimmed vehicle from the FMU in FMPy, exact: no step size to choose."""

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

folder = extract("target/ahv.fmu")
description = read_model_description(folder)
references = {v.name: v.valueReference for v in description.modelVariables}
rates = [unknown.variable for unknown in description.derivatives]
x = [rate.derivative.valueReference for rate in rates]
u = [references[name] for name in ("delta_e", "phi")]
y = [references[name] for name in ("V", "gamma")]

fmu = FMU2Slave(
    guid=description.guid, unzipDirectory=folder, modelIdentifier="ahv", instanceName="linear"
)
fmu.instantiate()
fmu.setupExperiment()
fmu.enterInitializationMode()
fmu.exitInitializationMode()


def jacobian(unknowns: list[int], knowns: list[int]) -> np.ndarray:
    """Changes of the unknowns per change of each known."""
    columns = [fmu.getDirectionalDerivative(unknowns, [known], [1.0]) for known in knowns]
    return np.array(columns).T


xdot = [rate.valueReference for rate in rates]
A, B = jacobian(xdot, x), jacobian(xdot, u)
C, D = jacobian(y, x), jacobian(y, u)
fmu.terminate()
fmu.freeInstance()

if __name__ == "__main__":
    np.set_printoptions(precision=4, suppress=True)
    print("poles, rad/s:", np.linalg.eigvals(A), sep="\n")
