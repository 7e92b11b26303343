"""The control law: a Kalman filter, state feedback and two integrators, in numpy.

Used by the FMU (autopilot.py), the margins (margins.py) and the ensemble.
"""

from __future__ import annotations

import json
import zipfile
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Self

import numpy as np

# Absolute limits of the commands delta_e, rad, and phi. More fuel would choke the burner, and its
# pitching moment would exceed that of the elevator.
LOW, HIGH = np.array([-np.pi / 9, 0.0]), np.array([np.pi / 9, 0.65])
# The speed error is limited to this, m/s; a larger one would saturate the elevator.
SPEED_ERROR = 10.0
# A speed below this share of level flight's is not believed.
SLOWEST = 0.5
# Where the FMU ahv_autopilot has its designs.
LAW = "resources/law.json"
# Sampling period of the law, and communication step of the masters.
PERIOD_S = 0.01


class BadLaw(Exception):
    """The file of an autopilot is none, or its law cannot be read."""


@dataclass
class Law:
    """Numbers of the law: n states of the design model, inputs delta_e and phi.

    Between two communication points t_k and t_k + `period_s` the FMU is given what was measured at
    t_k and answers with the command for t_k + `period_s`: a filter in predictor form knows that.
    """

    period_s: float
    A: np.ndarray  # (n, n) discrete design model
    B: np.ndarray  # (n, 2)
    C: np.ndarray  # (3, n) measured: V m/s, gamma rad, q rad/s
    K: np.ndarray  # (2, n) state feedback
    Ki: np.ndarray  # (2, 2) on the integrals of the errors of V, m, and gamma, rad s
    L: np.ndarray  # (n, 3) Kalman filter
    level: np.ndarray  # (3,) measurements in level flight
    trim: np.ndarray  # (2,) delta_e, rad, and phi in level flight
    fuel_fraction: float = 1.0  # of the vehicle that it is designed for
    fuel_mass_kg_per_m: float = 0.0
    # Absolute limits of the commands, and the limit of the speed error, m/s.
    lowest: np.ndarray = field(default_factory=LOW.copy)
    highest: np.ndarray = field(default_factory=HIGH.copy)
    speed_error_m_per_s: float = SPEED_ERROR

    def __post_init__(self) -> None:
        n, shape = len(self.A), {"level": (3,), "trim": (2,), "lowest": (2,), "highest": (2,)}
        shape |= {"A": (n, n), "B": (n, 2), "C": (3, n), "K": (2, n), "Ki": (2, 2), "L": (n, 3)}
        for name, needed in shape.items():
            if (given := np.shape(getattr(self, name))) != needed:
                raise ValueError(f"{name} has the shape {given}; {needed} is needed")

    @property
    def low(self) -> np.ndarray:
        """Smallest commands, as deviations from trim, rad and 1; shape (2,)."""
        return self.lowest - self.trim

    @property
    def high(self) -> np.ndarray:
        """Largest commands, likewise."""
        return self.highest - self.trim

    def at(self, level: np.ndarray, trim: np.ndarray) -> Self:
        """The same law about another level flight with these V, gamma, q and delta_e, phi."""
        return replace(self, level=level, trim=trim)

    def save(self, path: Path) -> None:
        """Write the law as JSON, as a schedule of one design."""
        save_schedule(path, [self])

    @classmethod
    def load(cls, path: Path) -> Law:
        """Read the first design that `save` or `save_schedule` wrote."""
        return load_schedule(path.read_text(encoding="utf-8"))[0]

    @classmethod
    def within(cls, autopilot: Path) -> Law:
        """The design that the FMU ahv_autopilot flies by default, for full tanks; or BadLaw."""
        try:
            with zipfile.ZipFile(autopilot) as archive:
                if LAW not in archive.namelist():
                    raise BadLaw(f"{autopilot} is not the FMU ahv_autopilot: it has no {LAW}")
                laws = load_schedule(archive.read(LAW).decode("utf-8"))
        except (zipfile.BadZipFile, KeyError, IndexError, TypeError, ValueError) as failure:
            raise BadLaw(f"{autopilot}: {failure}") from failure
        own = [law for law in laws if law.period_s == laws[0].period_s]
        return max(own, key=lambda law: law.fuel_fraction)


def part_beside(vehicle: Path, part: str) -> Path:
    """Where `cargo ahv package` puts the FMU of a part, as `autopilot`, beside the vehicle's."""
    return vehicle.with_name(vehicle.name.replace("ahv", f"ahv_{part}", 1))


def autopilot_beside(vehicle: Path) -> Path:
    """The same of the autopilot."""
    return part_beside(vehicle, "autopilot")


def load_schedule(text: str) -> list[Law]:
    """Read the designs that `save_schedule` wrote."""
    return [
        Law(**{k: np.array(v) if isinstance(v, list) else v for k, v in values.items()})
        for values in json.loads(text)["designs"]
    ]


def save_schedule(path: Path, laws: Iterable[Law]) -> None:
    """Write designs, one a line, as JSON: `resources/law.json` of the FMU ahv_autopilot."""
    lines = [
        json.dumps({k: v.tolist() if isinstance(v, np.ndarray) else v for k, v in values.items()})
        for values in map(asdict, laws)
    ]
    path.write_text('{"designs": [\n' + ",\n".join(lines) + "\n]}\n", encoding="utf-8")


@dataclass
class Autopilot:
    """The running law. `missed` and `saturated` count samples: one measured is invalid; clipped."""

    law: Law
    estimate: np.ndarray = field(init=False)
    integral: np.ndarray = field(init=False)
    command: np.ndarray = field(init=False)
    missed: int = 0
    saturated: int = 0

    def __post_init__(self) -> None:
        law = self.law
        self.estimate = np.zeros(len(law.A))
        self.integral, self.command = np.zeros(2), np.zeros(2)
        # Stacked, so that a step needs few products: an ensemble has millions of steps.
        self._filter = np.hstack([law.A - law.L @ law.C, law.B, law.L])
        self._feedback = -np.hstack([law.K, law.Ki])

    def step(self, measured: np.ndarray, wanted: np.ndarray) -> np.ndarray:
        """Command for the next communication point.

        `measured`: V, gamma, q now; `wanted`: change of V and value of gamma. A measurement that is
        not finite, or a speed of no flight, is not believed: what is expected takes its place.
        """
        law, known = self.law, (self.estimate, self.command)
        speed = law.speed_error_m_per_s
        deviation = measured - law.level
        error = deviation[:2] - wanted
        error[0] = min(max(error[0], -speed), speed)
        lost = ~np.isfinite(measured)
        lost[0] |= not measured[0] > SLOWEST * law.level[0]
        if lost.any():
            self.missed += 1
            deviation[lost], error[lost[:2]] = (law.C @ self.estimate)[lost], 0.0
        predicted = self._filter @ np.concatenate((*known, deviation))
        integral = self.integral + law.period_s * error
        away = np.concatenate((predicted, integral))
        # V and gamma are the first two states of every design model.
        away[:2] -= wanted
        away[0] = min(max(away[0], -speed), speed)
        free = self._feedback @ away
        command = np.minimum(np.maximum(free, law.low), law.high)
        if (command == free).all():
            # Anti-windup: otherwise the integrators are held.
            self.integral = integral
        else:
            self.saturated += 1
        self.estimate, self.command = predicted, command
        return command
