"""The autopilot as an FMU, made by PythonFMU: measurements and references in, commands out."""

from pathlib import Path

import numpy as np
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real
from pythonfmu.enums import Fmi2Status

from law import Autopilot as Pilot
from law import Law

MEASURED = ("V", "gamma", "q")
WANTED = ("V_change", "gamma_wanted")
COMMANDS = ("delta_e", "phi")


class Autopilot(Fmi2Slave):
    """The communication step must be the period of the design; any other is refused."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.pilot = Pilot(Law.load(Path(self.resources) / "law.json"))
        for name in (*MEASURED, *WANTED):
            setattr(self, name, 0.0)
            self.register_variable(Real(name, causality=Fmi2Causality.input, start=0.0))
        for name in (*COMMANDS, "missed", "saturated"):
            setattr(self, name, 0.0)
            self.register_variable(
                Real(
                    name,
                    causality=Fmi2Causality.output,
                    variability=Fmi2Variability.continuous
                    if name in COMMANDS
                    else Fmi2Variability.discrete,
                )
            )

    def do_step(self, current_time, step_size):
        """One period of the law."""
        period = self.pilot.law.period_s
        if abs(step_size - period) > 1e-6 * period:
            self.log(f"designed for steps of {period} s, not {step_size} s", Fmi2Status.error)
            return False
        measured = np.array([getattr(self, name) for name in MEASURED])
        wanted = np.array([getattr(self, name) for name in WANTED])
        self.delta_e, self.phi = map(float, self.pilot.step(measured, wanted))
        self.missed, self.saturated = float(self.pilot.missed), float(self.pilot.saturated)
        return True
