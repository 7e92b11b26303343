"""Mass, tanks and free-free modes of the beam, for the test oracle.

SI units, per metre of vehicle width; x runs aft from the nose, w is positive upwards.
The stiffness and mass matrices are the textbook Hermite ones, assembled as they stand, in decimal
arithmetic: see oracle_modes. The body is the beam with its frozen liquid, without sloshing masses.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from decimal import Decimal, localcontext
from pathlib import Path
from typing import Any

import numpy as np
from numpy.polynomial import Legendre

from oracle_modes import DIGITS, Inertia, lowest, to_decimal
from oracle_tanks import Tank, tanks

RIGID, EVEN_MASS_BEAM, SLOSH_BEAM = 1, 2, 3
GUARD_VECTORS = 6  # beyond the wanted modes, for the inverse iteration


def load(path: Path) -> Any:
    """Read a data file and keep only the `value` of each entry."""

    def plain(node: Any) -> Any:
        if isinstance(node, dict):
            return node["value"] if "value" in node else {k: plain(v) for k, v in node.items()}
        return [plain(item) for item in node] if isinstance(node, list) else node

    return plain(tomllib.loads(path.read_text(encoding="utf-8")))


def overlap(nodes: np.ndarray, start: float, end: float) -> np.ndarray:
    """Length in m that each element shares with [start, end]."""
    return np.clip(np.minimum(nodes[1:], end) - np.maximum(nodes[:-1], start), 0.0, None)


class Beam:
    """Distributed and point masses of one configuration at one fuel fraction, and the modes.

    Attributes: nodes m, density kg/m^2 and stiffness N m^2/m per element, tanks (SloshBeam only),
    slosh_nodes; of the densities mass kg/m, x_own m and inertia kg m^2/m about x_own; wanted, the
    mass centre m and the inertia about it that `prescribe` sets.
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
        mass, centre, spread = self.body()
        point, where = self.points()
        self.mass = float(mass + point.sum())
        self.x_own = float((mass * centre + point @ where) / self.mass)
        own = spread + mass * (centre - self.x_own) ** 2
        self.inertia = float(own + point @ (where - self.x_own) ** 2)
        self.wanted: tuple[float, float] | None = None

    def body(self) -> tuple[float, float, float]:
        """Mass kg/m, mass centre m and inertia kg m^2/m about it, of the body by its density."""
        line, middles = self.density * self.step, self.nodes[:-1] + self.step / 2.0
        mass = float(line.sum())
        centre = float(line @ middles / mass)
        return mass, centre, float(line @ ((middles - centre) ** 2 + self.step**2 / 12.0))

    def points(self) -> tuple[np.ndarray, np.ndarray]:
        """Sloshing masses in kg/m and their stations in m."""
        return np.array([tank.slosh_mass for tank in self.tanks]), self.nodes[self.slosh_nodes]

    def prescribe(self, centre: float, inertia: float) -> None:
        """Mass centre in m and inertia in kg m^2/m about it, of body and sloshing masses together.

        The body makes up for what the densities give.
        """
        mass, x_b, _ = self.body()
        point, where = self.points()
        first = self.mass * (centre - x_b) - point @ (where - x_b)
        second = inertia + self.mass * (centre - x_b) ** 2 - point @ (where - x_b) ** 2
        if second <= 0.0 or mass * second <= first**2:
            raise ValueError(
                f"no body of {mass:.6g} kg/m has the first moment {first:.6g} kg and the inertia "
                f"{second:.6g} kg m about {x_b:.6g} m"
            )
        self.wanted = centre, inertia

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

    def structure(self) -> tuple[dict, Inertia, np.ndarray]:
        """K, M' and heave and pitch of everything [unknown, 2]; all Decimal."""
        stiff, mass, first, slosh = self.matrices()
        step, zero, one = Decimal(self.step), Decimal(0), Decimal(1)
        body = np.full((2 * len(self.nodes) + len(slosh), 2), zero, dtype=object)
        body[first, 0] = body[first + 1, 1] = one
        body[first, 1] = [step * node for node in range(len(self.nodes))]
        free = body.copy()
        free[slosh] = free[first[self.slosh_nodes]]
        rigid = None
        if self.wanted is not None:
            # Mass, first and second moment about the nose: of everything, less those that slosh.
            total, centre, inertia = to_decimal(np.array([self.mass, *self.wanted]))
            moments = [total, total * centre, inertia + total * centre**2]
            for tank, row in zip(self.tanks, slosh, strict=True):
                point, x = Decimal(tank.slosh_mass), free[row, 1]
                moments = [m - point * x**k for k, m in enumerate(moments)]
            rigid = np.array([moments[:2], moments[1:]], dtype=object)
        return stiff, Inertia(mass, body, rigid), free

    def modes(self, count: int) -> Modes:
        """The `count` lowest elastic modes; solved once for all vehicles with this structure."""
        arrays = (self.nodes, self.density, self.stiffness, self.slosh_nodes, *self.points())
        springs = tuple(tank.stiffness for tank in self.tanks)
        key = (count, self.wanted, springs, *(np.asarray(array).tobytes() for array in arrays))
        if key not in _SOLVED:
            _SOLVED[key] = self._solve(count)
        return _SOLVED[key]

    def _solve(self, count: int) -> Modes:
        """Modes in the order and scaling of the equations."""
        _, _, first, slosh = self.matrices()
        size = 2 * len(self.nodes) + len(slosh)
        start = self._start(size, count + GUARD_VECTORS, first, slosh)
        with localcontext(prec=DIGITS):
            stiff, inertia, free = self.structure()
            values, vectors = lowest(stiff, inertia, free, start, count)
        omega = np.sqrt(values)
        shape = np.stack([vectors[first], vectors[first + 1]])
        moved = vectors[slosh]
        rel = moved - shape[0][self.slosh_nodes]
        share = self.points()[0] @ moved**2  # the vectors come with unit modal mass
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
        """Start block: bent Legendre polynomials of the beam, and each sloshing mass alone."""
        block = np.zeros((size, count))
        length = float(self.nodes[-1])
        for k in range(count - len(slosh)):
            polynomial = Legendre.basis(k + 2, domain=[0.0, length])
            block[first, k] = polynomial(self.nodes)
            block[first + 1, k] = polynomial.deriv()(self.nodes)
            block[slosh, k] = polynomial(self.nodes[self.slosh_nodes])
        for k, row in enumerate(slosh):
            block[row, count - 1 - k] = 1.0
        return block

    def shapes(self, modes: Modes, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mode shapes phi_i(x) and slopes phi_i'(x) in 1/m by the Hermite functions; [x, mode]."""
        e = np.clip((x / self.step).astype(int), 0, len(self.density) - 1)
        s = ((x - self.nodes[e]) / self.step)[:, None]
        w1, w2 = modes.w[e], modes.w[e + 1]
        t1, t2 = modes.slope[e] * self.step, modes.slope[e + 1] * self.step
        w = w1 + s * (t1 + s * (3 * (w2 - w1) - 2 * t1 - t2 + s * (2 * (w1 - w2) + t1 + t2)))
        rate = t1 + s * (6 * (w2 - w1) - 4 * t1 - 2 * t2 + s * (6 * (w1 - w2) + 3 * (t1 + t2)))
        return w, rate / self.step

    def mean(self, modes: Modes, x: float) -> tuple[np.ndarray, np.ndarray]:
        """By mode, the body's mean displacement at x and its mean slope in 1/m, as momenta say."""
        gauss, weight = np.polynomial.legendre.leggauss(4)
        spots = (self.nodes[:-1, None] + self.step * (1.0 + gauss) / 2.0).ravel()
        line = np.outer(self.density, self.step * weight / 2.0).ravel()
        w, _ = self.shapes(modes, spots)
        mass, centre, inertia = self.body()
        slope = (line * (spots - centre)) @ w / inertia
        return line @ w / mass + slope * (x - centre), slope


@dataclass(frozen=True)
class Modes:
    """Modes: omega rad/s, mass kg/m, w and slope at the nodes [node, mode], rel [tank, mode]."""

    omega: np.ndarray
    mass: np.ndarray
    w: np.ndarray
    slope: np.ndarray
    rel: np.ndarray


_SOLVED: dict[tuple, Modes] = {}
