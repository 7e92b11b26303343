"""Margins of the sampled loop, from the eigenvalues of the closed and of the broken loop.

With L the loop broken at one actuator, 1 + L(z) = det(z - closed) / det(z - broken): the poles of
both give the Nyquist curve at any frequency. The QR algorithm finds the exact eigenvalues of a
matrix within rounding of the given one, so that determinants are exact up to rounding where single
eigenvalues are not, as those of nearly defective matrices. Points of the result are checked
by a direct solution nevertheless.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from law import Law
from models import Plant

# Frequencies between which crossings are looked for: per decade, and about each pole, in its half
# widths (equal arcs of the circle that it adds to the curve), but not on an undamped one.
PER_DECADE, SLOWEST = 40, 1e-3
ABOUT, NARROW = np.tan(np.linspace(-0.47, 0.47, 16) * np.pi), 1e-6
# A crossing is found by dividing its interval so often into so many, and then by the secant.
DIVISIONS, PIECES = 2, 32
# Largest difference between the curve and a direct solution, over 1 + |L|; 0.01 deg are 2e-4.
WRONG = 5e-5
GAIN, PHASE, DISTANCE = range(3)


class Inexact(ArithmeticError):
    """Rounding has falsified the curve."""


class Margins(NamedTuple):
    """Margins of the loop broken at one actuator, with the other loop closed.

    `gain_down_db`, `gain_up_db`: the loop gain may change by so much; `phase_deg`; `distance`:
    least distance of the Nyquist curve from -1. All are NaN if the loop is unstable.
    `growth_per_s`: real part of the rightmost pole; `least_damping` of the poles that swing.
    """

    gain_down_db: float
    gain_up_db: float
    phase_deg: float
    distance: float
    growth_per_s: float
    least_damping: float


def cell(row: dict[str, float | str]) -> str:
    """Gain margins, dB, and phase margin, deg; or the rate of divergence."""
    if row["growth_per_s"] >= 0.0:
        return f"unstable, {row['growth_per_s']:+.2f}/s"
    return f"{row['gain_down_db']:.1f} {row['gain_up_db']:+.1f} dB, {row['phase_deg']:.0f}°"


def linear(law: Law) -> Plant:
    """The law from V, gamma, q to delta_e, phi, about level flight and within the limits."""
    n = len(law.A)
    a = np.block(
        [
            [law.A - law.B @ law.K - law.L @ law.C, -law.B @ law.Ki],
            [np.zeros((2, n)), np.eye(2)],
        ]
    )
    b = np.vstack([law.L, law.period_s * np.eye(3)[:2]])
    c = -np.hstack([law.K, law.Ki])
    return Plant(a, b, c)


class Broken(NamedTuple):
    """Plant and autopilot with the commands cut: x+ = A x + B u, u = C x closes the loop."""

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    period_s: float

    def closed(self, gain: np.ndarray) -> np.ndarray:
        """Matrix of the loop with the commands multiplied by `gain`, shape (2,)."""
        return self.A + self.B * gain @ self.C


def loop(plant: Plant, law: Law) -> Broken:
    """The sampled loop, in which a command acts one period late."""
    pilot, n = linear(law), len(plant.A)
    a = np.block([[plant.A, np.zeros((n, len(pilot.A)))], [pilot.B @ plant.C, pilot.A]])
    b = np.vstack([plant.B, np.zeros((len(pilot.A), 2))])
    return Broken(a, b, np.hstack([np.zeros((2, n)), pilot.C]), law.period_s)


def poles(plant: Plant, law: Law, gain: np.ndarray | None = None) -> np.ndarray:
    """Poles of the closed loop, rad/s; commands multiplied by `gain`, shape (2,)."""
    matrix = loop(plant, law).closed(np.ones(2) if gain is None else gain)
    return np.log(np.linalg.eigvals(matrix).astype(complex)) / law.period_s


class Curve:
    """Nyquist curve of the loop broken at one actuator, over the frequency in rad/s."""

    def __init__(self, whole: Broken, actuator: int) -> None:
        self.period_s, gain = whole.period_s, np.ones(2)
        closed = whole.closed(gain)
        gain[actuator] = 0.0
        self.broken = whole.closed(gain)
        self.cut = closed - self.broken
        self.zeros, self.poles = (np.linalg.eigvals(m)[:, None] for m in (closed, self.broken))

    def rates(self) -> np.ndarray:
        """Frequencies between which the curve has one crossing of a kind or none."""
        fastest = np.pi / self.period_s
        count = round(PER_DECADE * np.log10(fastest / SLOWEST))
        own = np.log(np.vstack([self.zeros, self.poles]).astype(complex)) / self.period_s
        own = own[own.imag >= 0.0][:, None]
        near = (own.imag + np.maximum(np.abs(own.real), NARROW * own.imag) * ABOUT).ravel()
        near = near[(near > SLOWEST) & (near < fastest)]
        return np.unique(np.concatenate([np.geomspace(SLOWEST, fastest, count), near]))

    def at(self, rates: np.ndarray) -> np.ndarray:
        """1 + L."""
        z = np.exp(1j * self.period_s * rates)
        return np.prod(z - self.zeros, axis=0) / np.prod(z - self.poles, axis=0)

    def values(self, rates: np.ndarray) -> np.ndarray:
        """What is zero at a crossing of the unit circle, of the real axis, and nearest to -1."""
        z = np.exp(1j * self.period_s * rates)
        from_zeros, from_poles = z - self.zeros, z - self.poles
        from_one = np.prod(from_zeros, axis=0) / np.prod(from_poles, axis=0)
        slope = z * ((1 / from_zeros).sum(axis=0) - (1 / from_poles).sum(axis=0))
        return np.array([np.log(np.abs(from_one - 1)), from_one.imag, -slope.imag])

    def crossings(self) -> tuple[np.ndarray, np.ndarray]:
        """Kind and frequency of each; half the sampling rate, where L is real, is one."""
        rates = self.rates()
        positive = self.values(rates) > 0.0
        kinds, places = np.nonzero(positive[:, 1:] != positive[:, :-1])
        each, low, high = range(len(kinds)), rates[places], rates[places + 1]
        for _ in range(DIVISIONS):
            between = np.linspace(low, high, PIECES + 1)
            values = self.values(between.ravel()).reshape(3, *between.shape)[kinds, :, each].T
            k = np.argmax((values[1:] > 0.0) != (values[:-1] > 0.0), axis=0)
            (low, high), (under, over) = ((a[k, each], a[k + 1, each]) for a in (between, values))
        found = low - under * (high - low) / (over - under)
        return np.append(kinds, PHASE), np.append(found, rates[-1])

    def check(self, rates: np.ndarray) -> None:
        """Raise Inexact where the curve differs from det(1 - (z - broken)^-1 cut)."""
        z = np.exp(1j * self.period_s * rates)
        one = np.eye(len(self.broken))
        matrix = np.linalg.solve(z[:, None, None] * one - self.broken, self.cut)
        exact, ours = np.linalg.det(one - matrix), self.at(rates)
        wrong = np.abs(ours - exact) / (1 + np.abs(exact))
        if not (wrong < WRONG).all():
            raise Inexact(f"margins: the Nyquist curve is wrong by {wrong.max():.1e}")


def margins(plant: Plant, law: Law, actuator: int = 0) -> Margins:
    """Margins at delta_e (0) or phi (1)."""
    return margins_of(loop(plant, law), actuator)


def margins_of(whole: Broken, actuator: int = 0) -> Margins:
    """The same of any loop."""
    curve = Curve(whole, actuator)
    ends = np.log(curve.zeros.ravel().astype(complex)) / whole.period_s
    swing = ends[np.abs(ends.imag) > 0.5]
    growth, damping = ends.real.max(), min(-swing.real / np.abs(swing), default=1.0)
    if growth >= 0.0:
        return Margins(*[np.nan] * 4, float(growth), float(damping))
    kinds, rates = curve.crossings()
    from_one = curve.at(rates)
    broken = from_one - 1
    is_turned = (kinds == PHASE) & (broken.real < 0.0)
    decibels = -20 * np.log10(np.abs(broken))
    # Each margin is the least of its column.
    columns = [
        np.where(is_turned & (decibels < 0.0), -decibels, np.inf),
        np.where(is_turned & (decibels > 0.0), decibels, np.inf),
        np.where(kinds == GAIN, np.degrees(np.abs(np.angle(-broken))), np.inf),
        np.where(kinds == DISTANCE, np.abs(from_one), np.inf),
    ]
    curve.check(rates[[column.argmin() for column in columns]])
    down, up, phase, distance = (float(column.min()) for column in columns)
    return Margins(-down, up, phase, distance, float(growth), float(damping))
