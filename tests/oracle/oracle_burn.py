"""The vehicle while its fuel burns, for the test oracle.

The modes are the eigenmodes of the fuel on board, as solved at a few levels and joined by one
polynomial each: near full tanks their frequencies stay apart. In modal coordinates that move with
the modes, M' u'' + K u = F is

    eta'' + 2 f' B eta' + D eta' + omega^2 eta = N,   B = phi^T M' (d phi / d f) / mu,

but for terms of second order in the flow f'. So eta is not the FMU's, whose basis turns another
way; everything else is.
"""

from __future__ import annotations

from copy import copy
from decimal import localcontext
from typing import Any

import numpy as np

from oracle import Vehicle
from oracle_aero import atmosphere
from oracle_modes import DIGITS, to_decimal

LEVELS = 6
# Part of the fuel below the start in which a flight may end.
REACH = 0.04
OF_VEHICLE = (
    *("mass", "x_cg", "i_yy", "omega", "modal_mass", "damping", "floor", "rel"),
    *("imu", "probe"),
)
OF_ELASTIC = (
    *("heave", "pitch", "cl_eta", "cl_rate", "cl_q", "cd_eta", "cd_rate", "cd_q"),
    *("cm_eta", "cm_rate", "cm_q", "ct_eta", "ct_rate", "ct_q"),
    *("n_0", "n_alpha", "n_alpha2", "n_elevator", "n_plume", "n_eta", "n_rate", "n_q"),
    *("lifted", "turned"),
)


class Burning(Vehicle):
    """A vehicle whose last state is the fuel that can be drained, kg/m; `given` as for Vehicle.

    It knows the fuel from its start down to 1 - REACH of it.
    """

    def __init__(self, fuel_fraction: float = 1.0, **given: Any) -> None:
        super().__init__(fuel_fraction=fuel_fraction, **given)
        mass = self.data["mass"]
        drained = mass["propellant_fraction"] * (1.0 - mass["residual_fraction"])
        full = Vehicle(**(given | {"configuration": 1, "fuel_fraction": 1.0})).mass
        self.fuel = full * drained * fuel_fraction
        self.states += 1
        places = 0.5 - 0.5 * np.cos(np.pi * np.arange(LEVELS) / (LEVELS - 1))
        parts = REACH * places
        levels = [Vehicle(fuel_fraction=fuel_fraction * (1 - part), **given) for part in parts]
        self._start = levels[0]

        fit = np.linalg.inv(np.vander(places, increasing=True))
        # Displacements of the beam and the sloshing masses by mode, and how they change.
        shapes = [self._displacements(v) for v in levels]
        slopes = np.arange(1, LEVELS)[:, None, None] * np.tensordot(fit[1:], shapes, 1)
        turning = []
        for vehicle, shape, place in zip(levels, shapes, places, strict=True):
            change = np.tensordot(place ** np.arange(LEVELS - 1), slopes, 1)
            product = shape.T @ self._product(vehicle, change) / vehicle.modal_mass[:, None]
            turning.append(product / (-REACH * self.fuel))
        self._table = {"turning": np.tensordot(fit, turning, 1)}
        for name in (*OF_VEHICLE, *OF_ELASTIC):
            values = [getattr(v.elastic if name in OF_ELASTIC else v, name) for v in levels]
            self._table[name] = np.tensordot(fit, values, 1)

    @staticmethod
    def _displacements(vehicle: Vehicle) -> np.ndarray:
        """Unknowns of the structure by mode, in the order of its matrices."""
        modes, beam = vehicle.modes, vehicle.beam
        _, _, first, slosh = beam.matrices()
        found = np.zeros((2 * len(beam.nodes) + len(slosh), len(modes.omega)))
        found[first], found[first + 1] = modes.w, modes.slope
        found[slosh] = modes.w[beam.slosh_nodes] + modes.rel
        return found

    @staticmethod
    def _product(vehicle: Vehicle, block: np.ndarray) -> np.ndarray:
        """Mass matrix M' times a block of displacements."""
        with localcontext(prec=DIGITS):
            _, inertia, _ = vehicle.beam.structure()
            return inertia.times(to_decimal(block)).astype(float)

    def at(self, fuel: Any) -> tuple[Vehicle, np.ndarray]:
        """The vehicle with this fuel on board, kg/m, and B, m/kg; complex-step safe."""
        place = (1.0 - fuel / self.fuel) / REACH
        powers = place ** np.arange(LEVELS)
        found = copy(self._start)
        found.elastic = copy(self._start.elastic)
        for name in OF_VEHICLE:
            setattr(found, name, np.tensordot(powers, self._table[name], 1))
        for name in OF_ELASTIC:
            setattr(found.elastic, name, np.tensordot(powers, self._table[name], 1))
        return found, np.tensordot(powers, self._table["turning"], 1)

    def fuel_flow(self, vehicle: Vehicle, x: np.ndarray, u: np.ndarray) -> Any:
        """Fuel in kg/(m s) for the air that passes the lip, behind the bow shock.

        Shock of a slender wedge in hypersonic similarity; `turn` in rad is that of the stream from
        its path to the fore-body, as the engine's inflow has it.
        """
        outline, engine, air = self.data["outline"], self.data["engine"], self.earth["air"]
        v, _ = self.stream(x, u)
        turn = vehicle.incidences(x, u)[2] + outline["lower_angle_rad"]
        density, sound = atmosphere(self.earth, x[1])
        gamma, mach = air["heat_capacity_ratio"], v / sound
        k = (gamma + 1.0) / 4.0 * mach * turn
        across = (k + np.sqrt(1.0 + k**2)) ** 2
        compression = (gamma + 1.0) * across / ((gamma - 1.0) * across + 2.0)
        slowed = 1.0 - 2.0 * (across - 1.0) / ((gamma + 1.0) * mach**2)
        height = engine["duct_height_m"] * np.cos(outline["lower_angle_rad"])
        swallowed = density * v * compression * slowed * height / np.cos(turn)
        return engine["stoichiometric_ratio"] * u[1] * swallowed

    def rhs(self, t: float, x: np.ndarray, u: np.ndarray) -> np.ndarray:
        """State derivative; the fuel is the last state."""
        now, turning = self.at(x[-1])
        moving = x[:-1]
        rates = np.append(now.rhs(t, moving, u), -self.fuel_flow(now, moving, u))
        rates[6:-1:2] -= 2.0 * rates[-1] * (turning @ moving[6::2])
        return rates

    def outputs(self, x: np.ndarray, u: np.ndarray) -> dict[str, Any]:
        """Those of the vehicle with the fuel on board.

        What the IMU feels of the modes' acceleration leaves out 2 f' B eta': the displacement is
        phi eta, and phi turns by as much.
        """
        return self.at(x[-1])[0].outputs(x[:-1], u)

    def trim(self) -> tuple[np.ndarray, np.ndarray]:
        """Level flight with the fuel of the start: the flow is left out of the balance."""
        x, u = self._start.trim()
        return np.append(x, self.fuel), u
