"""A controller in Python in a loop of plain FMPy calls: a start for your own.

Vehicle, elevator actuator and three sensors are FMUs; a PI controller of gamma within which is one
of the pitch rate climbs, and a third holds the speed.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

try:
    import numpy as np
    from fmpy import extract, read_model_description
    from fmpy.fmi1 import FMICallException
    from fmpy.fmi2 import FMU2Slave

    import command_line
    from law import part_beside
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

STEP_S = 0.01
DEG = np.pi / 180
STUCK = 2
# Climb at one degree, entered from 5 s to 25 s.
CLIMB_S, CLIMB = [5.0, 25.0], [0.0, 1.0 * DEG]


class Fmu:
    """An FMU of FMI 2.0, initialised with these parameters; its real variables by name."""

    def __init__(self, path: Path, name: str, **parameters: float) -> None:
        description = read_model_description(str(path))
        self._variables = {v.name: v for v in description.modelVariables}
        self._fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=extract(str(path)),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self._fmu.instantiate()
        self._fmu.setupExperiment()
        for parameter, value in parameters.items():
            self[parameter] = value
        self._fmu.enterInitializationMode()
        self._fmu.exitInitializationMode()

    def __getitem__(self, name: str) -> float:
        (value,) = self._fmu.getReal([self._variables[name].valueReference])
        return value

    def __setitem__(self, name: str, value: float) -> None:
        variable = self._variables[name]
        is_choice = variable.type == "Enumeration"
        call = self._fmu.setInteger if is_choice else self._fmu.setReal
        call([variable.valueReference], [value])

    def step(self, time_s: float) -> None:
        """One communication step."""
        self._fmu.doStep(time_s, STEP_S)


class Controller:
    """PI control of gamma, which asks for a pitch rate; of the pitch rate; and of the speed."""

    def __init__(self, level_m_per_s: float) -> None:
        self._level_m_per_s = level_m_per_s
        self._gamma = self._q = self._speed = 0.0

    def __call__(self, v: float, gamma: float, q: float, wanted: float) -> tuple[float, float]:
        """Elevator, rad, and fuel ratio, as deviations from trim."""
        error = wanted - gamma
        self._gamma += STEP_S * error
        error = q - (0.2 * error + 0.01 * self._gamma)
        self._q += STEP_S * error
        slow = self._level_m_per_s - v
        self._speed += STEP_S * slow
        # Trailing edge down, the positive elevator, pitches the nose down.
        return error + 8.0 * self._q, float(np.clip(0.02 * slow + 0.001 * self._speed, -0.3, 0.25))


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--stop", type=command_line.duration, default=60.0, help="s")
    parser.add_argument("--stuck", type=float, help="the sensor of q sticks at this time, s")
    options = parser.parse_args()
    sensor, actuator = (part_beside(options.fmu, part) for part in ("sensor", "actuator"))
    command_line.need(options.fmu, sensor, actuator)
    failures = {} if options.stuck is None else {"failure": STUCK, "failure_time": options.stuck}
    try:
        vehicle = Fmu(options.fmu, "vehicle")
        elevator = Fmu(actuator, "elevator", bandwidth=60.0, rate_limit=100.0 * DEG)
        sensors = {"V": Fmu(sensor, "V"), "gamma": Fmu(sensor, "gamma")}
        sensors["q"] = Fmu(sensor, "q", **failures)
        controller = Controller(vehicle["V"])
        print("time, s  wanted  gamma, deg  V, m/s  elevator, deg")
        for k in range(round(options.stop / STEP_S) + 1):
            time_s = k * STEP_S
            wanted = float(np.interp(time_s, CLIMB_S, CLIMB))
            if k % round(5.0 / STEP_S) == 0:
                print(
                    f"{time_s:7.1f} {wanted / DEG:7.3f} {vehicle['gamma'] / DEG:11.3f} "
                    f"{vehicle['V']:7.1f} {vehicle['delta_e_effective'] / DEG:14.2f}",
                    flush=True,
                )
            for name, measured in sensors.items():
                measured["u"] = vehicle[name]
            # The controller takes no time: what it reads now commands the step that begins now.
            readings = (measured["y"] for measured in sensors.values())
            elevator["u"], vehicle["phi"] = controller(*readings, wanted)
            vehicle["delta_e"] = elevator["y"]
            for part in (*sensors.values(), elevator, vehicle):
                part.step(time_s)
    except FMICallException as failure:
        sys.exit(f"error: {failure} The message of the FMU is above.")


if __name__ == "__main__":
    main()
