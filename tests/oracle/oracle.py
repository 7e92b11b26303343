"""Flight, trim, linearisation and simulation of the vehicle, for the test oracle.

SI units, rad, per metre of vehicle width. It reads the same data files as the model and shares no
code with it. States: V m/s, h m, gamma rad, alpha rad, q rad/s, then eta_i (m) and its rate (m/s)
of the flexible modes 1 to 3 and of the slosh modes 1 and 2: 5, 11 or 15 states.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eig, matrix_balance
from scipy.optimize import root

from oracle_aero import TINY, Elastic, atmosphere, gravity, poly
from oracle_structure import EVEN_MASS_BEAM, RIGID, SLOSH_BEAM, Beam, Modes, load

DATA_DIR = Path(__file__).resolve().parents[2] / "src" / "data"
NAMES = ("rigid", "even mass beam", "slosh beam")
FINITE_ZERO = 1e4  # rad/s: generalised eigenvalues beyond are the infinite ones


@dataclass(frozen=True)
class Linear:
    """x' = A x + B u, y = C x + D u about a trim; u = (delta_e rad, phi), y = (V, gamma)."""

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray


class Vehicle:
    """The vehicle in one configuration (1 Rigid, 2 EvenMassBeam, 3 SloshBeam).

    slosh_damping is a ratio, slosh_frequency is in rad/s (0: from the tank), altitude0 in m,
    gamma0 in rad; None takes the default of the data. `elements` overrides the data's beam mesh,
    `aero` names the coefficient set.
    Attributes: mass kg/m, x_cg m, i_yy kg m^2/m, omega rad/s, modal_mass kg/m, damping matrix D
    1/s, rel [tank, mode], floor m/s^2 (the floors of the tanks on each mode),
    modes (shapes at the nodes), beam, elastic (the terms of eq. (4)).
    """

    def __init__(
        self,
        configuration: int = SLOSH_BEAM,
        fuel_fraction: float = 1.0,
        slosh_damping: float | None = None,
        slosh_frequency: float = 0.0,
        mach0: float | None = None,
        altitude0: float | None = None,
        gamma0: float = 0.0,
        data_dir: Path | str = DATA_DIR,
        elements: int | None = None,
        aero: str = "xu2015",
    ) -> None:
        folder = Path(data_dir)
        self.data, self.earth = load(folder / "vehicle.toml"), load(folder / "earth.toml")
        self.aero = load(folder / "aero" / f"{aero}.toml")
        default = self.data["default"]
        self.configuration, self.gamma0 = configuration, gamma0
        self.mach0 = default["mach"] if mach0 is None else mach0
        self.altitude0 = default["altitude_m"] if altitude0 is None else altitude0
        self.slosh_damping = default["slosh_damping"] if slosh_damping is None else slosh_damping
        self.v0 = self.mach0 * float(atmosphere(self.earth, self.altitude0)[1])
        curve = self.v0**2 / (self.earth["earth"]["radius_m"] + self.altitude0)
        self.g_eff = (float(gravity(self.earth, self.altitude0)) - curve) * np.cos(gamma0)

        def beam(fuel: float) -> Beam:
            z = self.slosh_damping
            return Beam(self.data, configuration, fuel, z, slosh_frequency, self.g_eff, elements)

        self.beam, full = beam(fuel_fraction), beam(1.0)
        self.mass, self.x_cg = self.beam.mass, self.beam.x_cg
        inertia = self.aero["inertia"]
        self.i_yy = inertia["i_yy_kg_m2_per_m"] * self.beam.inertia / full.inertia
        count = {RIGID: 0, EVEN_MASS_BEAM: 3, SLOSH_BEAM: 5}[configuration]
        self.modes_count, self.states = count, 5 + 2 * count
        nodes, none = len(self.beam.nodes), np.zeros(0)
        shape = np.zeros((nodes, 0))
        self.modes = Modes(none, none, shape, shape, np.zeros((0, 0)))
        if count:
            self.modes = self.beam.modes(count)
        self.omega, self.modal_mass = self.modes.omega, self.modes.mass
        self.rel = np.zeros((2, count))
        self.rel[: len(self.beam.tanks)] = self.modes.rel
        self.damping = self._damping(inertia["structural_damping"])
        self.elastic = Elastic(self.data["geometry"], self.aero, self.beam, self.modes)
        self.floor = self._floor()
        self._trim: tuple[np.ndarray, np.ndarray] | None = None

    def _damping(self, structural: Sequence[float]) -> np.ndarray:
        """Modal damping matrix D in 1/s: tank dampers, and the structure by its strain energy."""
        tanks, mass, omega = self.beam.tanks, self.modal_mass, self.omega
        rel = self.rel[: len(tanks)]
        c, k = np.array([t.damping for t in tanks]), np.array([t.stiffness for t in tanks])
        in_beam = 1.0 - k @ rel**2 / (omega**2 * mass)
        tank_part = (rel.T * c) @ rel / mass[:, None]
        # Flexible modes have ratios of their own; slosh modes take that of the first.
        ratio = np.concatenate([structural, [structural[0]] * 2])[: len(omega)]
        return tank_part + np.diag(2.0 * ratio * omega * in_beam)

    def _floor(self) -> np.ndarray:
        """Modal acceleration in m/s^2 of the floors of the tanks, which carry the liquid at rest.

        The weight m1_j g_eff of a sloshing mass rests on the floor, not on the spring: a constant
        force upwards on the mass and downwards on the node of its tank. Its power in mode i is
        m1_j g_eff rel[j, i] eta_i'. The pair adds up to nothing on the rigid body.
        """
        weight = np.array([tank.slosh_mass * self.g_eff for tank in self.beam.tanks])
        return weight @ self.rel[: len(weight)] / self.modal_mass

    @staticmethod
    def stream(x: np.ndarray, u: np.ndarray) -> tuple[Any, Any]:
        """Speed through the air in m/s, and the angle of that path above the horizon in rad."""
        ahead, up = x[0] * np.cos(x[2]), x[0] * np.sin(x[2]) - sum(u[2:])
        return np.sqrt(ahead**2 + up**2), np.arctan(up / ahead)

    def forces(self, x: np.ndarray, u: np.ndarray) -> dict[str, Any]:
        """Lift, drag, thrust N/m, moment N, modal forces N/m of eq. (4), qbar Pa and Mach.

        Lift and drag across and along the path through the air.
        """
        (v, path), q = self.stream(x, u), x[4]
        alpha = x[2] + x[3] - path
        eta, rate = x[5::2], x[6::2] / v
        ref, e = self.aero["reference"], self.elastic
        density, sound = atmosphere(self.earth, x[1])
        qbar = 0.5 * density * v**2
        load = qbar * ref["area_m2_per_m"]
        # What the fuel adds to lift, drag and moment: the pressure of the plume on the aft-body.
        fits = (self.aero.get(key, {}) for key in ("lift_phi", "drag_phi", "moment_phi"))
        l_phi, d_phi, m_phi = (u[1] * poly(fit, alpha) for fit in fits)
        c_l = poly(self.aero["lift"], alpha, u[0]) + l_phi + e.cl_eta @ eta + e.cl_rate @ rate
        c_d = poly(self.aero["drag"], alpha, u[0]) + d_phi + e.cd_eta @ eta + e.cd_rate @ rate
        c_m = poly(self.aero["moment"], alpha, u[0]) + m_phi + e.cm_eta @ eta + e.cm_rate @ rate
        inlet = alpha + e.ct_eta @ eta + e.ct_rate @ rate
        c_t = poly(self.aero["thrust"], inlet) + u[1] * poly(self.aero["thrust_phi"], inlet)
        normal = c_l * np.cos(alpha) + c_d * np.sin(alpha)
        shift = self.x_cg - ref["moment_centre_m"]
        moment = load * (ref["chord_m"] * c_m + shift * normal + ref["thrust_arm_m"] * c_t)
        elevator = poly(self.aero["lift"], 0.0, u[0]) - poly(self.aero["lift"], 0.0)
        modal = e.n_0 + e.n_alpha * alpha + e.n_alpha2 * alpha**2
        modal = modal + e.n_elevator * elevator + e.n_plume * l_phi
        modal = modal + e.n_eta @ eta + e.n_rate @ rate + e.n_q * (q / v)
        engine = load * c_t * (e.lifted * np.sin(alpha) + e.turned)
        return {
            "alpha": alpha,
            "lift": load * c_l,
            "drag": load * c_d,
            "thrust": load * c_t,
            "moment": moment,
            "modal": load * modal + engine,
            "qbar": qbar,
            "mach": v / sound,
        }

    def rhs(self, t: float, x: np.ndarray, u: np.ndarray) -> np.ndarray:
        """State derivative, eq. (3); complex-step safe.

        u = effective (delta_e rad, phi), and the vertical velocity of the air in m/s if it moves.
        """
        v, h, gamma, alpha, q = x[:5]
        f, g = self.forces(x, u), gravity(self.earth, h)
        eta, rate = x[5::2], x[6::2]
        _, path = self.stream(x, u)
        ahead = -f["drag"] * np.cos(path) - f["lift"] * np.sin(path)
        up = f["lift"] * np.cos(path) - f["drag"] * np.sin(path)
        lift = up * np.cos(gamma) - ahead * np.sin(gamma)
        drag = -ahead * np.cos(gamma) - up * np.sin(gamma)
        turn = (lift + f["thrust"] * np.sin(alpha)) / (self.mass * v)
        turn = turn - (g / v - v / (self.earth["earth"]["radius_m"] + h)) * np.cos(gamma)
        dx = np.empty(self.states, dtype=np.result_type(x, u, float))
        dx[0] = (f["thrust"] * np.cos(alpha) - drag) / self.mass - g * np.sin(gamma)
        dx[1], dx[2], dx[3], dx[4] = v * np.sin(gamma), turn, q - turn, f["moment"] / self.i_yy
        dx[5::2] = rate
        modal = f["modal"] / self.modal_mass + self.floor
        dx[6::2] = modal - self.omega**2 * eta - self.damping @ rate
        return dx

    def outputs(self, x: np.ndarray, u: np.ndarray) -> dict[str, Any]:
        """Outputs at one state: theta rad, slosh m, forces N/m, moment N, mach, qbar Pa, n_z."""
        f = self.forces(x, u)
        slosh = self.rel @ x[5::2]
        normal = f["lift"] * np.cos(f["alpha"]) + f["drag"] * np.sin(f["alpha"])
        weight = self.mass * self.earth["earth"]["gravity_m_per_s2"]
        kept = {key: value for key, value in f.items() if key not in ("modal", "alpha")}
        return kept | {
            "theta": x[3] + x[2],
            "slosh_1": slosh[0],
            "slosh_2": slosh[1],
            "n_z": normal / weight,
        }

    def trim(self) -> tuple[np.ndarray, np.ndarray]:
        """State and effective control of the trimmed flight at mach0, altitude0, gamma0."""
        if self._trim is not None:
            return self._trim
        count, rows = self.modes_count, [0, 2, 4, *range(6, self.states, 2)]

        def unpack(z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            x = np.zeros(self.states, dtype=z.dtype)
            x[0], x[1], x[2], x[3], x[5::2] = self.v0, self.altitude0, self.gamma0, z[0], z[3:]
            return x, z[1:3]

        def residual(z: np.ndarray) -> np.ndarray:
            return self.rhs(0.0, *unpack(z))[rows]

        z = root(residual, np.concatenate([[0.03, 0.2, 0.3], np.zeros(count)]), tol=1e-10).x
        for _ in range(4):
            slope = [residual(z + 1j * TINY * unit).imag / TINY for unit in np.eye(len(z))]
            z = z - np.linalg.solve(np.transpose(slope), residual(z))
        if not np.all(abs(residual(z)) < 1e-9):
            raise ArithmeticError("no trim")
        self._trim = unpack(z)
        return self._trim

    def linearise(self, x: np.ndarray | None = None, u: np.ndarray | None = None) -> Linear:
        """A, B, C, D by complex step about (x, u), by default the trim."""
        if x is None or u is None:
            x, u = self.trim()
        a = [self.rhs(0.0, x + 1j * TINY * unit, u).imag / TINY for unit in np.eye(len(x))]
        b = [self.rhs(0.0, x, u + 1j * TINY * unit).imag / TINY for unit in np.eye(2)]
        return Linear(np.transpose(a), np.transpose(b), np.eye(len(x))[[0, 2]], np.zeros((2, 2)))

    def poles(self) -> np.ndarray:
        """Eigenvalues of A in rad/s, by decreasing real part."""
        found = np.linalg.eigvals(self.linearise().a)
        return found[np.lexsort((found.imag, -found.real))]

    def zeros(self) -> np.ndarray:
        """Finite invariant zeros from (delta_e, phi) to (V, gamma): the Rosenbrock pencil."""
        m = self.linearise()
        a, (scale, _) = matrix_balance(m.a, permute=False, separate=True)
        b, c = m.b / scale[:, None], m.c * scale
        b, c = b / np.linalg.norm(b, axis=0), c / np.linalg.norm(c, axis=1)[:, None]
        left = np.block([[a, b], [c, np.zeros((2, 2))]])
        right = np.diag([1.0] * len(a) + [0.0, 0.0])
        found = eig(left, right, right=False)
        found = found[np.isfinite(found) & (abs(found) < FINITE_ZERO)]
        return found[np.lexsort((found.imag, -found.real))]

    def effective(self, u: Sequence[float], absolute: bool = False) -> np.ndarray:
        """Effective (delta_e, phi): trim + input, or the input itself, clipped; then any gust."""
        limit, top = (self.data["actuation"][k] for k in ("delta_e_limit_rad", "phi_limit"))
        asked = np.asarray(u[:2], dtype=float) + (0.0 if absolute else self.trim()[1])
        return np.append(np.clip(asked, [-limit, 0.0], [limit, top]), u[2:])

    def simulate(
        self,
        t_end: float,
        dt: float,
        u_of_step: Callable[[int], Sequence[float]],
        x0: np.ndarray | None = None,
        absolute: bool = False,
    ) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
        """Trajectory from x0 (default: trim) at t = 0, dt, ..., t_end: times, states, outputs.

        u_of_step(k) is the input held over [k dt, (k+1) dt]. Every step restarts the integrator.
        The outputs at the end of a step still belong to that step's input.
        """
        steps = round(t_end / dt)
        x = np.array(self.trim()[0] if x0 is None else x0, dtype=float)
        size = np.concatenate([[self.v0, self.altitude0], np.full(self.states - 2, 1e-2)])
        states, history = [x], [self.outputs(x, self.effective(u_of_step(0), absolute))]
        for k in range(steps):
            u = self.effective(u_of_step(k), absolute)
            span = (k * dt, (k + 1) * dt)
            options = {"rtol": 1e-12, "atol": 1e-14 * size, "t_eval": span[1:]}
            run = solve_ivp(self.rhs, span, x, "DOP853", args=(u,), **options)
            if not run.success:
                raise ArithmeticError(run.message)
            x = run.y[:, -1]
            states.append(x)
            history.append(self.outputs(x, u))
        table = {key: np.array([row[key] for row in history]) for key in history[0]}
        return dt * np.arange(steps + 1), np.array(states), table


def report(vehicle: Vehicle) -> str:
    """Frequencies, trim, poles and zeros as text."""
    x, u = vehicle.trim()
    alpha, delta = np.degrees(x[3]), np.degrees(u[0])
    return "\n".join(
        [
            NAMES[vehicle.configuration - 1],
            f"  mass           {vehicle.mass:.9f} kg/m, x_cg {vehicle.x_cg:.12f} m",
            f"  I_yy           {vehicle.i_yy:.6f} kg m^2/m, g_eff {vehicle.g_eff:.12f} m/s^2",
            f"  omega [rad/s]  {vehicle.omega}",
            f"  modal mass     {vehicle.modal_mass}",
            f"  trim           alpha {alpha:.9f} deg, delta_e {delta:.9f} deg, phi {u[1]:.12f}",
            f"  trim eta [m]   {x[5::2]}",
            f"  poles [rad/s]  {vehicle.poles()}",
            f"  zeros [rad/s]  {vehicle.zeros()}",
        ]
    )


if __name__ == "__main__":
    np.set_printoptions(precision=10, linewidth=110)
    for number in (RIGID, EVEN_MASS_BEAM, SLOSH_BEAM):
        print(report(Vehicle(number)))
