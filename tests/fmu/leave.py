"""Leave the envelope with several step sizes; print the status of each last step.

A program of its own, so that a step that never returns can be stopped. Argument: directory of the
unzipped FMU.
"""

import sys
from pathlib import Path

import numpy as np

from harness import OK, Package

FLIGHTS = 300

folder = Path(sys.argv[1])
package = Package(folder, folder)
generator = np.random.default_rng(1976)
for _ in range(FLIGHTS):
    given = {"alpha0": 0.02, "q0": float(generator.choice([-5.0, 5.0]))}
    with package.flight(configuration=1, trim=False, delta_e=0.2, phi=0.3, **given) as flight:
        flight.step(float(generator.uniform(0.0, 1e-3)))
        size = float(10.0 ** generator.uniform(-3.0, 0.0))
        status = OK
        while status == OK:
            status = flight.step_status(size)
        print(status)
