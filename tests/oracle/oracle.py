"""Flight, trim, linearisation and simulation of the vehicle, for the test oracle.

SI units, rad, per metre of vehicle width. It reads the same data files as the model and shares no
code with it. States: V m/s, h m, gamma rad, alpha rad, q rad/s, then eta_i (m) and its rate (m/s)
of the flexible modes 1 to 3 and of the slosh modes 1 and 2: 5, 11 or 15 states.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

import oracle_choking
from oracle_aero import TINY, Elastic, atmosphere, gravity, poly
from oracle_factors import applied, chosen
from oracle_linear import Linear, in_order, invariant_zeros, linear
from oracle_sensors import readings
from oracle_structure import EVEN_MASS_BEAM, RIGID, SLOSH_BEAM, Beam, Modes, load
from oracle_tanks import modal_damping, modal_floor

DATA_DIR = Path(__file__).resolve().parents[2] / "src" / "data"
FLEXIBLE = 3  # modes with names of their own; slosh modes follow


class Vehicle:
    """The vehicle in one configuration (1 Rigid, 2 EvenMassBeam, 3 SloshBeam).

    slosh_damping is a ratio, slosh_frequency is in rad/s (0: from the tank), altitude0 in m,
    gamma0 in rad; None takes the default of the data. `elements` overrides the data's beam mesh,
    `aero` names the coefficient set, the stations are in m. `more`: factors, mass_centre_shift,
    pitch_rate_factor and offsets of the start by the FMU's names.
    Attributes: mass kg/m, x_cg m, i_yy kg m^2/m, omega rad/s, modal_mass kg/m, damping matrix D
    1/s, rel [tank, mode], floor m/s^2 (the floors of the tanks on each mode), imu and probe
    ([0] shape, [1] slope 1/m of each mode), modes (shapes at the nodes), beam, elastic (the terms
    of eq. (4)), and data, earth, aero with the factors in them.
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
        *,
        imu_station: float = 16.764,
        probe_station: float = 0.0,
        **more: float,
    ) -> None:
        folder, (factors, self.offsets) = Path(data_dir), chosen(more)
        files = ("vehicle.toml", "earth.toml", f"aero/{aero}.toml")
        tables = [load(folder / name) for name in files]
        self.data, self.earth, self.aero = applied(*tables, factors)
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
        inertia = self.aero["inertia"]
        self.mass, self.x_cg = self.beam.mass, self.beam.x_own + factors["mass_centre_shift"]
        if configuration != RIGID:
            self.x_cg += inertia.get("mass_centre_shift_m", 0.0)
        self.i_yy = inertia["i_yy_kg_m2_per_m"] * self.beam.inertia / full.inertia
        self.beam.prescribe(self.x_cg, self.i_yy)
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
        self.damping = modal_damping(self.beam.tanks, self.modes, inertia["structural_damping"])
        pitch_rate = factors["pitch_rate_factor"]
        self.elastic = Elastic(
            self.data["geometry"], self.aero, self.beam, self.modes, self.x_cg, pitch_rate
        )
        self.floor = modal_floor(self.beam.tanks, self.modes, self.g_eff)
        self.imu_station, self.probe_station = imu_station, probe_station
        at = self.beam.shapes(self.modes, np.array([imu_station, probe_station]))
        self.imu, self.probe = np.swapaxes(at, 0, 1)
        self._trim: tuple[np.ndarray, np.ndarray] | None = None

    @staticmethod
    def stream(x: np.ndarray, u: np.ndarray) -> tuple[Any, Any]:
        """Speed through the air in m/s, and the angle of that path above the horizon in rad.

        u[2] is the vertical velocity of the air in m/s, upwards; u[3] the horizontal, tail wind.
        """
        rise, follow = (u[k] if len(u) > k else 0.0 for k in (2, 3))
        ahead, up = x[0] * np.cos(x[2]) - follow, x[0] * np.sin(x[2]) - rise
        return np.sqrt(ahead**2 + up**2), np.arctan(up / ahead)

    def incidences(self, x: np.ndarray, u: np.ndarray) -> tuple[Any, Any, Any, Any]:
        """Incidence of the mean axes, of the body and of the engine's inflow in rad; q/V in 1/m.

        What a slosh mode moves the body by is a motion of the body like any other. q/V is the
        body's too.
        """
        (v, path), e = self.stream(x, u), self.elastic
        eta, rate = x[5::2], x[6::2] / v
        alpha = x[2] + x[3] - path
        body, turn = alpha - e.pitch @ eta - e.heave @ rate, x[4] / v - e.pitch @ rate
        return alpha, body, body + e.ct_eta @ eta + e.ct_rate @ rate + e.ct_q * turn, turn

    def forces(self, x: np.ndarray, u: np.ndarray) -> dict[str, Any]:
        """Lift, drag, thrust N/m, moment N, modal forces N/m of eq. (4), qbar Pa and Mach.

        Lift and drag across and along the path through the air.
        """
        v, _ = self.stream(x, u)
        alpha, body, inflow, turn = self.incidences(x, u)
        eta, rate = x[5::2], x[6::2] / v
        ref, e = self.aero["reference"], self.elastic
        density, sound = atmosphere(self.earth, x[1])
        qbar = 0.5 * density * v**2
        load = qbar * ref["area_m2_per_m"]
        # What the fuel adds to lift, drag and moment: the pressure of the plume on the aft-body.
        fits = (self.aero.get(key, {}) for key in ("lift_phi", "drag_phi", "moment_phi"))
        l_phi, d_phi, m_phi = (u[1] * poly(fit, body) for fit in fits)
        c_l = poly(self.aero["lift"], body, u[0]) + l_phi
        c_l = c_l + e.cl_eta @ eta + e.cl_rate @ rate + e.cl_q * turn
        c_d = poly(self.aero["drag"], body, u[0]) + d_phi
        c_d = c_d + e.cd_eta @ eta + e.cd_rate @ rate + e.cd_q * turn
        c_m = poly(self.aero["moment"], body, u[0]) + m_phi
        c_m = c_m + e.cm_eta @ eta + e.cm_rate @ rate + e.cm_q * turn
        c_t = poly(self.aero["thrust"], inflow) + u[1] * poly(self.aero["thrust_phi"], inflow)
        normal = c_l * np.cos(alpha) + c_d * np.sin(alpha)
        shift = self.x_cg - ref["moment_centre_m"]
        moment = load * (ref["chord_m"] * c_m + shift * normal + ref["thrust_arm_m"] * c_t)
        elevator = poly(self.aero["lift"], 0.0, u[0]) - poly(self.aero["lift"], 0.0)
        modal = e.n_0 + e.n_alpha * body + e.n_alpha2 * body**2
        modal = modal + e.n_elevator * elevator + e.n_plume * l_phi
        modal = modal + e.n_eta @ eta + e.n_rate @ rate + e.n_q * turn
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

        u = effective (delta_e rad, phi), and the velocity of the air in m/s if it moves.
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
        """Outputs at one state: theta rad, slosh m, forces N/m, moment N, mach, qbar Pa, n_z; and
        those of the sensors.
        """
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
            "choking_margin": self.choking_margin(x, u),
            **readings(self, x, u, f),
        }

    def choking_margin(self, x: np.ndarray, u: np.ndarray) -> Any:
        """Fuel ratio that can still be added before the burner chokes."""
        (v, _), inflow = self.stream(x, u), self.incidences(x, u)[2]
        sound, gamma = atmosphere(self.earth, x[1])[1], self.earth["air"]["heat_capacity_ratio"]
        return oracle_choking.margin(self.data, gamma, v / sound, sound, inflow, u[1])

    def imu_shapes(self) -> dict[str, float]:
        """Shape and slope (1/m) of the flexible modes at the IMU, 0 where there is no mode."""
        found = np.zeros((2, FLEXIBLE))
        found[:, : min(FLEXIBLE, self.modes_count)] = self.imu[:, :FLEXIBLE]
        names = [f"{kind}{i + 1}_imu" for kind in ("shape", "slope") for i in range(FLEXIBLE)]
        return dict(zip(names, found.ravel().tolist(), strict=True))

    def offset(self, x: np.ndarray) -> np.ndarray:
        """The state x, moved by the offsets of the start.

        Those of the sloshing masses are of the displacement against their tanks: coordinates of
        the slosh modes follow from it and from what the flexible modes move.
        """
        x, by = np.array(x, dtype=float), self.offsets
        x[3:5] += by["alpha_offset"], by["q_offset"]
        for first, dot in ((5, ""), (6, "_dot")):
            flexible = min(FLEXIBLE, self.modes_count)
            move = np.array([by[f"eta{i + 1}{dot}_offset"] for i in range(flexible)])
            if self.configuration == SLOSH_BEAM:
                slosh = [by[f"slosh{j}{dot}_offset"] for j in (1, 2)]
                rest = slosh - self.rel[:, :FLEXIBLE] @ move
                move = np.append(move, np.linalg.solve(self.rel[:, FLEXIBLE:], rest))
            x[first : 5 + 2 * self.modes_count : 2] += move
        return x

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

    def linearise(
        self,
        x: np.ndarray | None = None,
        u: np.ndarray | None = None,
        outputs: Sequence[str] = ("V", "gamma"),
    ) -> Linear:
        """A, B, C, D by complex step about (x, u), by default the trim."""
        if x is None or u is None:
            x, u = self.trim()
        return linear(self, x, u, outputs)

    def poles(self) -> np.ndarray:
        """Eigenvalues of A in rad/s, by decreasing real part."""
        return in_order(np.linalg.eigvals(self.linearise().a))

    def zeros(self, output: str = "gamma") -> np.ndarray:
        """Finite invariant zeros in rad/s from (delta_e, phi) to V and this output."""
        return invariant_zeros(self.linearise(outputs=("V", output)))

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
        """Trajectory from x0 at t = 0, dt, ..., t_end: times, states, outputs.

        Without x0 it begins at the trim, moved by the offsets.
        u_of_step(k) is the input held over [k dt, (k+1) dt]. Every step restarts the integrator.
        The outputs at the end of a step still belong to that step's input.
        """
        steps = round(t_end / dt)
        x = np.array(self.offset(self.trim()[0]) if x0 is None else x0, dtype=float)
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
