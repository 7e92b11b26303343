"""Effect of communication step and extrapolation of signals on the closed loop.

A continuous LQG autopilot, integrated exactly within each step, is coupled to the FMU by a small
master with constant steps, or with step-size control that can reject steps.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import NamedTuple

try:
    import control as ct
    import matplotlib
    import numpy as np
    from fmpy import extract
    from fmpy.fmi1 import FMICallException
    from scipy.linalg import expm

    import command_line
    import design
    from flight import Vehicle
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import NullFormatter

HOLD, COMMANDS, BOTH = "held", "commands move", "both move"
STEPS_S = [0.08, 0.04, 0.02, 0.01, 0.005, 0.0025]
REFERENCE_S = 0.00125
# Step command of gamma, rad, which makes the step-size control work.
GAMMA = 0.5 * design.DEG
# Limits on the change of the step size, and the usual safety factor.
SHRINK, STRETCH, SAFETY = 0.2, 2.0, 0.9


class Pilot:
    """x' = A x + B [y; reference], u = C x, with y linear within a step."""

    def __init__(self, folder: str) -> None:
        full = design.model(folder)
        names = design.STATES[design.SLOSH]
        kept, n = [full.states.index(name) for name in names], len(names)
        a, b, c = full.A[np.ix_(kept, kept)], full.B[kept], full.C[:, kept]
        weight = np.r_[np.zeros(n), 1 / (design.ERROR * design.VANISH_S) ** 2]
        weight[:2] = 1 / design.ERROR**2
        plant = ct.ss(a, b, c, 0)
        gain, _, _ = ct.lqr(
            plant, np.diag(weight), np.diag(1 / design.EFFORT**2), integral_action=c[:2]
        )
        # White noise with the power of the sampled noise of the design.
        noise = b @ np.diag(design.INPUT_NOISE**2) @ b.T * design.PERIOD_S
        for name, deviation in design.STATE_NOISE.items():
            i = names.index(name)
            noise[i, i] += deviation**2 / design.PERIOD_S
        kalman, _, _ = ct.lqe(
            a, np.eye(n), c, noise, np.diag(design.SENSOR_NOISE**2) * design.PERIOD_S
        )
        k, ki = gain[:, :n], gain[:, n:]
        shift = k[:, 1] * GAMMA
        self.A = np.block([[a - b @ k - kalman @ c, -b @ ki], [np.zeros((2, n + 2))]])
        self.B = np.vstack([kalman, np.eye(3)[:2]])
        self.C = -np.hstack([k, ki])
        self.constant = np.r_[b @ shift, 0.0, -GAMMA]
        self.shift, self.level = shift, np.array([full.trim[name] for name in full.outputs])
        self.x = np.zeros(n + 2)
        self._known: dict[float, np.ndarray] = {}

    def step(self, measured: np.ndarray, rates: np.ndarray, size_s: float) -> None:
        """Integrate exactly over a step; `measured` varies by `rates` per second."""
        size = len(self.x)
        if size_s not in self._known:
            # Van Loan: x, a constant input and its slope in one matrix exponential.
            whole = np.zeros((3 * size, 3 * size))
            whole[:size, :size] = self.A
            whole[:size, size : 2 * size] = whole[size : 2 * size, 2 * size :] = np.eye(size)
            self._known[size_s] = expm(whole * size_s)[:size]
        drive = self.B @ (measured - self.level) + self.constant
        self.x = self._known[size_s] @ np.r_[self.x, drive, self.B @ rates]

    def command(self, measured: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return u and its rate."""
        rate = self.A @ self.x + self.B @ (measured - self.level) + self.constant
        return self.C @ self.x + self.shift, self.C @ rate


def advance(vehicle: Vehicle, pilot: Pilot, size_s: float, coupling: str) -> None:
    """One communication step of vehicle and autopilot, in parallel."""
    measured = vehicle.read()
    rates = vehicle.rates() if coupling == BOTH else np.zeros(3)
    command, slope = pilot.command(measured)
    vehicle.command(command, None if coupling == HOLD else slope)
    vehicle.step(size_s)
    pilot.step(measured, rates, size_s)


def fixed(folder: str, size_s: float, coupling: str, stop_s: float) -> np.ndarray:
    """Rows of time and measurements with constant steps; None if the loop diverges."""
    pilot, rows = Pilot(folder), []
    with Vehicle(folder) as vehicle:
        try:
            for _ in range(round(stop_s / size_s)):
                advance(vehicle, pilot, size_s, coupling)
                rows.append([vehicle.time, *vehicle.read()])
        except FMICallException:
            return np.empty((0, 4))
    return np.array(rows)


class Adaptive(NamedTuple):
    """Rows at the ends of accepted steps, and the number of rejected steps."""

    rows: np.ndarray
    rejected: int


def adaptive(folder: str, tolerance: np.ndarray, stop_s: float) -> Adaptive:
    """Steps for which one step and two half steps differ by less than `tolerance`.

    Vehicle and autopilot go back to their saved states: once after the long step, and again if
    the halves disagree with it.
    """
    pilot, rows, rejected, size = Pilot(folder), [], 0, 0.01
    with Vehicle(folder) as vehicle:
        while vehicle.time < stop_s - 1e-9:
            size = min(size, stop_s - vehicle.time)
            before, x = vehicle.save(), pilot.x
            advance(vehicle, pilot, size, BOTH)
            long = vehicle.read()
            vehicle.restore(before)
            pilot.x = x
            for _ in range(2):
                advance(vehicle, pilot, 0.5 * size, BOTH)
            error = np.abs((vehicle.read() - long) / tolerance).max()
            if error <= 1.0:
                rows.append([vehicle.time, *vehicle.read()])
            else:
                rejected += 1
                vehicle.restore(before)
                pilot.x = x
            vehicle.forget(before)
            # The local error is of third order.
            size *= np.clip(SAFETY * max(error, 1e-9) ** (-1 / 3), SHRINK, STRETCH)
    return Adaptive(np.array(rows), rejected)


def error(rows: np.ndarray, exact: np.ndarray) -> float:
    """Largest error of gamma, relative to the command."""
    if not len(rows):
        return np.inf
    return float(np.abs(rows[:, 2] - np.interp(rows[:, 0], *exact[:, [0, 2]].T)).max() / GAMMA)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--stop", type=command_line.duration, default=8.0, help="duration, s")
    parser.add_argument("--output", type=Path, default=Path("target/closed_loop"))
    options = parser.parse_args()
    command_line.need(options.fmu)
    command_line.make(options.output)
    folder, stop_s = extract(str(options.fmu)), options.stop
    exact = fixed(folder, REFERENCE_S, BOTH, stop_s)
    figure, axis = plt.subplots(figsize=(6.5, 4), layout="constrained")
    print(f"error of gamma, of {GAMMA / design.DEG:g} deg:\nstep, s   ", *STEPS_S, sep="  ")
    for coupling, style in ((HOLD, "C0o-"), (COMMANDS, "C1s-"), (BOTH, "C2^-")):
        errors = [error(fixed(folder, size, coupling, stop_s), exact) for size in STEPS_S]
        print(f"{coupling:13}", *[f"{wrong:.1e}" for wrong in errors])
        axis.loglog(STEPS_S, errors, style, label=coupling)
    tolerance = np.array([1e-3, 1e-6, 1e-6])
    varied = adaptive(folder, tolerance, stop_s)
    wrong, count = error(varied.rows, exact), len(varied.rows)
    sizes = np.diff(varied.rows[:, 0], prepend=0.0)
    print(
        f"variable step: {count} steps of {sizes.min():.4f} to {sizes.max():.4f} s, "
        f"{varied.rejected} rejected, error {wrong:.1e}"
    )
    axis.loglog(stop_s / count, wrong, "k*", ms=12, label="variable step, mean")
    axis.set_xticks(STEPS_S, [f"{1e3 * size:g}" for size in STEPS_S])
    axis.xaxis.set_minor_formatter(NullFormatter())
    axis.set_xlabel("communication step, ms")
    axis.set_ylabel("error of $\\gamma$ over the step wanted")
    axis.grid(alpha=0.3, which="both")
    axis.legend(fontsize=8)
    figure.savefig(options.output / "coupling.png", dpi=110)
    plt.close(figure)


if __name__ == "__main__":
    main()
