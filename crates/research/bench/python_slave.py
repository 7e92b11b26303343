"""The vehicle of the test oracle as a PythonFMU slave: what the FMU would be in Python."""

import os
import sys

import numpy as np
from pythonfmu import Fmi2Causality, Fmi2Slave, Real
from scipy.integrate import solve_ivp

# The folder tests/oracle; a PythonFMU cannot tell where it was built.
sys.path.insert(0, os.environ["AHV_ORACLE"])

TOLERANCE = 1e-8
NOMINAL = np.array(
    [1e3, 1e4, 0.01, 0.01, 0.01, 1e-3, 0.01, 1e-3, 0.01, 1e-4, 0.005, 0.01, 0.05, 0.01, 0.05]
)


class Vehicle(Fmi2Slave):
    """Elevator and fuel ratio in, as deviations from trim; speed, angles and a mode out."""

    author = "ahv"
    description = "Flexible vehicle with slosh in Python"

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        from oracle import Vehicle as Oracle

        self.vehicle = Oracle()
        self.x, self.control = self.vehicle.trim()
        self.delta_e = self.phi = 0.0
        self.show()
        for name in ("delta_e", "phi"):
            self.register_variable(Real(name, causality=Fmi2Causality.input))
        for name in ("V", "gamma", "alpha", "q", "eta1"):
            self.register_variable(Real(name, causality=Fmi2Causality.output))

    def show(self):
        """Outputs of the present state."""
        self.V, _, self.gamma, self.alpha, self.q, self.eta1 = map(float, self.x[:6])

    def do_step(self, current_time, step_size):
        """One communication step."""
        u = self.control + np.array([self.delta_e, self.phi])
        run = solve_ivp(
            self.vehicle.rhs,
            (0.0, step_size),
            self.x,
            "DOP853",
            args=(u,),
            rtol=TOLERANCE,
            atol=TOLERANCE * NOMINAL,
        )
        self.x = run.y[:, -1]
        self.show()
        return run.success
