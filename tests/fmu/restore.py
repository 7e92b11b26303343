"""Continue a flight from its serialised state in a new process; print the bits of the final state.

Arguments: directory of the unzipped FMU, file with the state, time of the state, number of steps.
"""

import sys
from pathlib import Path

from harness import Package

folder, state, time, steps = sys.argv[1:]
with Package(Path(folder), Path(folder)).instance() as flight:
    flight.fmu.setFMUstate(flight.fmu.deSerializeFMUstate(Path(state).read_bytes()))
    flight.time = float(time)
    for k in range(int(steps)):
        flight.set(delta_e=0.001 * (k % 3))
        flight.step(0.01)
    print(flight.bits().hex())
