"""The limited actuator of crates/actuator as differential equations, integrated by SciPy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp

TOLERANCE = 1e-12
SIDES = (1.0, -1.0)
# free, rate or stop, and the side that a limit is on.
Form = tuple[str, float]


@dataclass
class Actuator:
    """An actuator in motion; an event stops the integrator wherever the equations change."""

    bandwidth: float = 50.0
    damping: float = 0.7
    rate_limit: float = 2.0
    position_min: float = -1.0
    position_max: float = 1.0
    kind: str = "SecondOrder"
    position: float = 0.0
    rate: float = 0.0
    # Limits that were met.
    met: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.first = self.kind == "FirstOrder"

    def velocity(self, x: np.ndarray, u: float) -> float:
        """Rate of the position without limits."""
        return self.bandwidth * (u - x[0]) if self.first else x[1]

    def push(self, x: np.ndarray, u: float, side: float) -> float:
        """Positive if the command pushes the rate beyond its limit on a side."""
        if self.first:
            return side * self.velocity(x, u) - self.rate_limit
        return side * self.bandwidth * (u - x[0]) - 2.0 * self.damping * self.rate_limit

    def beyond(self, x: np.ndarray, side: float) -> float:
        """Positive if the position is beyond its stop on a side."""
        return side * x[0] - (self.position_max if side > 0 else -self.position_min)

    def form(self, x: np.ndarray, u: float) -> Form:
        """What the equations are at the start of a command or at a stop."""
        for side in SIDES:
            if self.beyond(x, side) >= 0 and side * self.velocity(x, u) >= 0:
                x[1] = 0.0
                if side * (u - x[0]) > 0:
                    return "stop", side
            fast = side * self.velocity(x, u) >= self.rate_limit
            if fast and self.push(x, u, side) > 0:
                return "rate", side
        return "free", 0.0

    def slopes(self, form: Form, x: np.ndarray, u: float) -> list[float]:
        """Right-hand side."""
        held, side = form
        if held != "free":
            return [side * self.rate_limit if held == "rate" else 0.0, 0.0]
        pull = self.bandwidth * (u - x[0])
        if self.first:
            return [pull, 0.0]
        return [x[1], self.bandwidth * (pull - 2.0 * self.damping * x[1])]

    def exits(self, form: Form) -> list[tuple[Callable[[np.ndarray, float], float], Form]]:
        """What rises through zero where the form changes, and the next form."""
        held, side = form
        free = ("free", 0.0)
        if held == "stop":
            return [(lambda x, u: side * (x[0] - u), free)]
        stops = [(lambda x, _, s=s: self.beyond(x, s), ("stop", s)) for s in SIDES]
        if held == "rate":
            return [(lambda x, u: -self.push(x, u, side), free), *stops]
        rates = [
            (lambda x, u, s=s: s * self.velocity(x, u) - self.rate_limit, ("rate", s))
            for s in SIDES
        ]
        return [*rates, *stops]

    def advance(self, value: float, slope: float, h: float) -> None:
        """Follow value + slope t for a time."""
        t, x = 0.0, np.array([self.position, self.rate])
        form = self.form(x, value)
        while t < h:
            if form[0] == "rate":
                x[1] = form[1] * self.rate_limit
            self.met.add(form[0])
            exits = self.exits(form)
            events = [lambda t, x, f=f: f(x, value + slope * t) for f, _ in exits]
            for event in events:
                event.terminal, event.direction = True, 1.0
            answer = solve_ivp(
                lambda t, x, form=form: self.slopes(form, x, value + slope * t),
                (t, h),
                x,
                method="DOP853",
                events=events,
                rtol=TOLERANCE,
                atol=TOLERANCE,
                max_step=0.1 / self.bandwidth,
            )
            t, x = answer.t[-1], answer.y[:, -1]
            if answer.status == 1:
                form = next(
                    after
                    for (_, after), met in zip(exits, answer.t_events, strict=True)
                    if len(met)
                )
                if form[0] == "stop":
                    x[0] = self.position_max if form[1] > 0 else self.position_min
                    form = self.form(x, value + slope * t)
        self.position, self.rate = x
