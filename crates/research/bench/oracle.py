"""SciPy's integrators on the test oracle: one second with an elevator doublet.

Usage: oracle.py REPEATS TOLERANCE...
Prints for each method and tolerance a line: method;tolerance;median s;least s;largest s;
right-hand sides;error. The error is that of `cargo ahv bench`, against a run at 1e-13. Each jump of
the input starts the integration anew.
"""

import statistics
import sys
import time
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tests" / "oracle"))
from oracle import Vehicle

DOUBLET = (0.0, 0.01, -0.01, 0.0)
# As in src/vehicle/state.rs.
NOMINAL = np.array(
    [1e3, 1e4, 0.01, 0.01, 0.01, 1e-3, 0.01, 1e-3, 0.01, 1e-4, 0.005, 0.01, 0.05, 0.01, 0.05]
)
EXACT = 1e-13


def fly(vehicle, method, tolerance):
    """Final state and number of right-hand sides."""
    x, control = vehicle.trim()
    calls = 0
    for quarter, elevator in enumerate(DOUBLET):
        u = control + np.array([elevator, 0.0])
        span = (quarter / len(DOUBLET), (quarter + 1) / len(DOUBLET))
        run = solve_ivp(
            vehicle.rhs, span, x, method, args=(u,), rtol=tolerance, atol=tolerance * NOMINAL
        )
        x, calls = run.y[:, -1], calls + run.nfev
    return x, calls


def main():
    repeats, tolerances = int(sys.argv[1]), sys.argv[2:]
    vehicle = Vehicle()
    exact, _ = fly(vehicle, "DOP853", EXACT)
    for method in ("DOP853", "LSODA"):
        for tolerance in tolerances:
            times = []
            for _ in range(repeats):
                start = time.perf_counter()
                x, calls = fly(vehicle, method, float(tolerance))
                times.append(time.perf_counter() - start)
            error = np.max(abs(x - exact) / (NOMINAL + abs(exact)))
            numbers = (statistics.median(times), min(times), max(times))
            spread = ";".join(f"{number:.9g}" for number in numbers)
            print(f"SciPy {method};{tolerance};{spread};{calls};{error:.9g}", flush=True)


if __name__ == "__main__":
    main()
