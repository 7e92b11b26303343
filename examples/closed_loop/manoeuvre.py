"""The manoeuvre as an FMU, made by PythonFMU: commands of manoeuvre.csv, linear between rows."""

from pathlib import Path

import numpy as np
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Manoeuvre(Fmi2Slave):
    """Outputs are the commands for the next step."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.rows = np.genfromtxt(Path(self.resources) / "manoeuvre.csv", delimiter=",", names=True)
        for name in self.rows.dtype.names[1:]:
            setattr(self, name, 0.0)
            self.register_variable(Real(name, causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        """Values at the end of the step."""
        for name in self.rows.dtype.names[1:]:
            value = np.interp(current_time + step_size, self.rows["time_s"], self.rows[name])
            setattr(self, name, float(value))
        return True
