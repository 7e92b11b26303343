"""Mass, tanks and free-free modes of the beam, for the test oracle.

SI units, per metre of vehicle width; x runs aft from the nose, w is positive upwards.
The stiffness and mass matrices are the textbook Hermite ones, assembled as they stand, in decimal
arithmetic: see oracle_modes.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from decimal import Decimal, localcontext
from pathlib import Path
from typing import Any

import numpy as np
from numpy.polynomial import Legendre

from oracle_modes import DIGITS, lowest

RIGID, EVEN_MASS_BEAM, SLOSH_BEAM = 1, 2, 3
GUARD_VECTORS = 6  # beyond the wanted modes, for the inverse iteration


def load(path: Path) -> Any:
    """Read a data file and keep only the `value` of each entry."""

    def plain(node: Any) -> Any:
        if isinstance(node, dict):
            return node["value"] if "value" in node else {k: plain(v) for k, v in node.items()}
        return [plain(item) for item in node] if isinstance(node, list) else node

    return plain(tomllib.loads(path.read_text(encoding="utf-8")))


@dataclass(frozen=True)
class Tank:
    """One tank: masses in kg/m, lengths in m, stiffness in N/m per m, damping in N s/m per m."""

    centre: float
    length: float
    slosh_mass: float
    frozen_mass: float
    omega: float
    stiffness: float
    damping: float


def tanks(
    data: Any, total_mass: float, fuel: float, damping: float, frequency: float, g_eff: float
) -> list[Tank]:
    """Sloshing and frozen liquid of each tank (Graham and Rodriguez 1952, first mode).

    total_mass kg/m of the full vehicle, damping ratio, frequency rad/s (0: geometry), g_eff m/s^2.
    """
    residual = data["mass"]["residual_fraction"]
    level = residual + (1.0 - residual) * fuel
    found = []
    for tank in data["tank"]:
        mass = tank["share"] * data["mass"]["propellant_fraction"] * total_mass * level
        bay = tank["bay_length_m"]
        ratio = tank["depth_full_m"] * level / bay
        slosh = mass * 8.0 * np.tanh(np.pi * ratio) / (np.pi**3 * ratio)
        omega = np.sqrt(g_eff * np.pi / bay * np.tanh(np.pi * ratio))
        omega = frequency if frequency > 0.0 else omega
        found.append(
            Tank(
                tank["centre_m"],
                tank["length_m"],
                float(slosh),
                float(mass - slosh),
                float(omega),
                float(slosh * omega**2),
                float(2.0 * damping * slosh * omega),
            )
        )
    return found


def overlap(nodes: np.ndarray, start: float, end: float) -> np.ndarray:
    """Length in m that each element shares with [start, end]."""
    return np.clip(np.minimum(nodes[1:], end) - np.maximum(nodes[:-1], start), 0.0, None)


class Beam:
    """Distributed and point masses of one configuration at one fuel fraction, and the modes.

    Attributes: nodes m, density kg/m^2 and stiffness N m^2/m per element, tanks (SloshBeam only),
    slosh_nodes, mass kg/m, x_cg m, inertia kg m^2/m about x_cg.
    """

    def __init__(
        self,
        data: Any,
        configuration: int,
        fuel: float,
        damping: float,
        frequency: float,
        g_eff: float,
        elements: int | None = None,
    ) -> None:
        self.data = data
        mass, length = data["mass"], data["geometry"]["length_m"]
        count = elements if elements is not None else int(data["beam"]["elements"])
        self.nodes = np.arange(count + 1) * length / count
        self.step = length / count
        middles = self.nodes[:-1] + self.step / 2.0
        self.stiffness = np.interp(
            middles, data["beam"]["stiffness_station_m"], data["beam"]["stiffness_n_m2_per_m"]
        )
        fore, aft = mass["fore_beam_kg_per_m2"], mass["aft_beam_kg_per_m2"]
        joint = mass["beam_joint_m"]
        total = fore * joint + aft * (length - joint)
        full = fore * overlap(self.nodes, 0.0, joint) + aft * overlap(self.nodes, joint, length)
        full /= self.step
        propellant, residual = mass["propellant_fraction"], mass["residual_fraction"]
        level = residual + (1.0 - residual) * fuel
        self.tanks: list[Tank] = []
        if configuration == SLOSH_BEAM:
            self.tanks = tanks(data, total, fuel, damping, frequency, g_eff)
            self.density = (1.0 - propellant) * full
            for tank in self.tanks:
                start, end = tank.centre - tank.length / 2.0, tank.centre + tank.length / 2.0
                if start < -1e-9 or end > length + 1e-9:
                    raise ValueError("a tank reaches beyond the vehicle")
                share = overlap(self.nodes, start, end) / self.step
                self.density = self.density + tank.frozen_mass / tank.length * share
        else:
            self.density = full * (1.0 - propellant + propellant * level)
        self.slosh_nodes = [int(np.argmin(abs(self.nodes - t.centre))) for t in self.tanks]

        # The Hermite functions reproduce w = 1 and w = x exactly, hence the plain integrals.
        point = np.array([tank.slosh_mass for tank in self.tanks])
        where = self.nodes[self.slosh_nodes]
        line = self.density * self.step
        self.mass = float(line.sum() + point.sum())
        self.x_cg = float((line @ middles + point @ where) / self.mass)
        arm = (middles - self.x_cg) ** 2 + self.step**2 / 12.0
        self.inertia = float(line @ arm + point @ (where - self.x_cg) ** 2)

    def matrices(self) -> tuple[dict, dict, np.ndarray, list[int]]:
        """Lower triangles of K and M as {(row, column): Decimal}; place of w per node; of w_s.

        The unknowns of a node are w, theta and, at a tank's node, the tank's w_s.
        """
        extra = np.zeros(len(self.nodes), dtype=int)
        own = []
        for node in self.slosh_nodes:
            own.append(2 + int(extra[node]))
            extra[node] += 1
        first = 2 * np.arange(len(self.nodes)) + np.concatenate([[0], np.cumsum(extra)[:-1]])
        slosh = [
            int(first[node]) + place for node, place in zip(self.slosh_nodes, own, strict=True)
        ]
        h = Decimal(self.step)
        bending = [
            [12, 6 * h, -12, 6 * h],
            [6 * h, 4 * h * h, -6 * h, 2 * h * h],
            [-12, -6 * h, 12, -6 * h],
            [6 * h, 2 * h * h, -6 * h, 4 * h * h],
        ]
        inertia = [
            [156, 22 * h, 54, -13 * h],
            [22 * h, 4 * h * h, 13 * h, -3 * h * h],
            [54, 13 * h, 156, -22 * h],
            [-13 * h, -3 * h * h, -22 * h, 4 * h * h],
        ]
        stiff: dict[tuple[int, int], Decimal] = {}
        mass: dict[tuple[int, int], Decimal] = {}

        def add(target: dict, row: int, column: int, value: Decimal) -> None:
            if row >= column:
                target[row, column] = target.get((row, column), Decimal(0)) + value

        for e, (rho, ei) in enumerate(zip(self.density, self.stiffness, strict=True)):
            at = [int(first[e]), int(first[e]) + 1, int(first[e + 1]), int(first[e + 1]) + 1]
            k, m = Decimal(float(ei)) / h**3, Decimal(float(rho)) * h / 420
            for i in range(4):
                for j in range(4):
                    add(stiff, at[i], at[j], k * bending[i][j])
                    add(mass, at[i], at[j], m * inertia[i][j])
        for tank, node, row in zip(self.tanks, self.slosh_nodes, slosh, strict=True):
            spring = Decimal(tank.stiffness)
            add(stiff, row, row, spring)
            add(stiff, int(first[node]), int(first[node]), spring)
            add(stiff, row, int(first[node]), -spring)
            add(mass, row, row, Decimal(tank.slosh_mass))
        return stiff, mass, first, slosh

    def modes(self, count: int) -> Modes:
        """The `count` lowest elastic modes, in the order and scaling of the equations."""
        with localcontext() as context:
            context.prec = DIGITS
            stiff, mass, first, slosh = self.matrices()
        size = 2 * len(self.nodes) + len(slosh)
        start = self._start(size, count + 2 + GUARD_VECTORS, first, slosh)
        values, vectors = lowest(stiff, mass, start, count + 2)
        omega = np.sqrt(values[2:])
        shape = np.stack([vectors[first, 2:], vectors[first + 1, 2:]])
        moved = vectors[slosh, 2:]
        rel = moved - shape[0][self.slosh_nodes]
        point = np.array([tank.slosh_mass for tank in self.tanks])
        share = point @ moved**2  # the vectors come with unit modal mass
        order = np.arange(count)
        if self.tanks:
            last = np.sort(np.argsort(share)[-2:])
            order = np.concatenate([np.setdiff1d(order, last), last])
        omega, shape, rel = omega[order], shape[:, :, order], rel[:, order]
        flexible = count - 2 if self.tanks else count
        scale = shape[0, 0].copy()
        for i in range(flexible, count):
            scale[i] = rel[np.argmax(abs(rel[:, i])), i]
        return Modes(omega, scale**-2.0, shape[0] / scale, shape[1] / scale, rel / scale)

    def _start(self, size: int, count: int, first: np.ndarray, slosh: list[int]) -> np.ndarray:
        """Start block: Legendre polynomials along the beam, and each sloshing mass alone."""
        block = np.zeros((size, count))
        length = float(self.nodes[-1])
        for k in range(count - len(slosh)):
            polynomial = Legendre.basis(k, domain=[0.0, length])
            block[first, k] = polynomial(self.nodes)
            block[first + 1, k] = polynomial.deriv()(self.nodes)
            block[slosh, k] = polynomial(self.nodes[self.slosh_nodes])
        for k, row in enumerate(slosh):
            block[row, count - 1 - k] = 1.0
        return block


@dataclass(frozen=True)
class Modes:
    """Modes: omega rad/s, mass kg/m, w and slope at the nodes [node, mode], rel [tank, mode]."""

    omega: np.ndarray
    mass: np.ndarray
    w: np.ndarray
    slope: np.ndarray
    rel: np.ndarray
