"""Atmosphere, gravity, curve fits and the elastic terms of eq. (4), for the test oracle.

SI units, rad, per metre of vehicle width. The functions accept complex arguments, for the
complex-step derivative; branches look at the real part.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from oracle_structure import Beam, Modes

TINY = 1e-30  # complex step


def poly(terms: dict[str, float], alpha: Any, delta: Any = 0.0) -> Any:
    """Polynomial in alpha and delta (rad) with the coefficients of a data file."""
    in_alpha = [terms.get(key, 0.0) for key in ("constant", "alpha", "alpha2", "alpha3")]
    in_delta = [terms.get(key, 0.0) for key in ("delta_e", "delta_e2", "delta_e3")]
    found = sum(c * alpha**k for k, c in enumerate(in_alpha))
    found = found + sum(c * delta**k for k, c in enumerate(in_delta, 1))
    return found + terms.get("alpha_delta_e", 0.0) * alpha * delta


def slope(terms: dict[str, float], alpha: float, delta: float, along: str = "alpha") -> float:
    """Derivative of a curve fit by alpha or by delta_e, 1/rad, by complex step."""
    step = (1j * TINY, 0.0) if along == "alpha" else (0.0, 1j * TINY)
    return float(np.imag(poly(terms, alpha + step[0], delta + step[1])) / TINY)


def gravity(data: Any, h: Any) -> Any:
    """Gravity in m/s^2 at the geometric altitude h in m."""
    earth = data["earth"]
    return earth["gravity_m_per_s2"] * (earth["radius_m"] / (earth["radius_m"] + h)) ** 2


def atmosphere(data: Any, h: Any) -> tuple[Any, Any]:
    """Density in kg/m^3 and speed of sound in m/s of the 1976 standard at h in m."""
    air, earth = data["air"], data["earth"]
    gas, g0 = air["gas_constant_j_per_kg_k"], earth["gravity_m_per_s2"]
    height = earth["radius_m"] * h / (earth["radius_m"] + h)
    p, t = air["sea_level_pressure_pa"], air["sea_level_temperature_k"]
    bases, lapses = air["layer_base_m"], air["layer_lapse_k_per_m"]
    for base, lapse, top in zip(bases, lapses, [*bases[1:], np.inf], strict=True):
        rise = (height if np.real(height) < top else top) - base
        warm = t + lapse * rise
        if lapse:
            p = p * (warm / t) ** (-g0 / (gas * lapse))
        else:
            p = p * np.exp(-g0 * rise / (gas * t))
        t = warm
        if np.real(height) < top:
            break
    return p / (gas * t), np.sqrt(air["heat_capacity_ratio"] * gas * t)


class Elastic:
    """What bending and pitching add to the forces of the body, from two strips and the elevator.

    The body's own motion in the modes, a change of its incidence: heave (m of the body at the mass
    centre, by mode) and pitch (its slope in 1/m, nose down).
    Per m of eta or, for the rates, per rad of eta_dot/V: cl_eta, cl_rate (and cd, cm, ct: the
    engine's inflow); per rad of q/V times 1 m: cl_q and so on. Modal forces per qbar S: n_0,
    n_alpha, n_alpha2, n_eta[i, j], n_rate[i, j], n_q; per qbar S and C_L of the elevator alone
    n_elevator, of the plume n_plume. Modal forces per thrust: lifted * sin(alpha) + turned.
    Also x_e m, strip[power of alpha, strip], strip_slope 1/rad and kappa.
    """

    def __init__(
        self,
        geometry: Any,
        aero: Any,
        beam: Beam,
        modes: Modes,
        x_cg: float,
        pitch_rate: float = 0.0,
    ) -> None:
        """Terms for the `geometry` table of the vehicle and one aerodynamic data file.

        x_cg in m is the mass centre; pitch_rate the part of strip theory's answer to pitching.
        """
        ref, lift, drag, moment = (aero[k] for k in ("reference", "lift", "drag", "moment"))
        chord, x_r = ref["chord_m"], ref["moment_centre_m"]
        a_r, d_r = ref["elastic_alpha_rad"], ref.get("elastic_delta_e_rad", 0.0)
        edges = (0.0, geometry["fore_body_m"], geometry["length_m"])
        lengths = np.diff(edges)
        arms = (np.add(edges[1:], edges[:-1])) / 2.0 - x_r
        cl_d, cm_d = (slope(fit, a_r, d_r, "delta_e") for fit in (lift, moment))
        x_e = self.x_e = x_r - chord * cm_d / cl_d
        # Quadratics of the strip loads c_1, c_2: [power of alpha, strip].
        known = np.array(
            [[t.get(key, 0.0) for key in ("constant", "alpha", "alpha2")] for t in (lift, moment)]
        )
        known[:, 1] -= cl_d, cm_d
        self.strip = np.linalg.solve(np.array([[1.0, 1.0], -arms / chord]), known).T
        self.strip_slope = self.strip[1] + 2.0 * a_r * self.strip[2]

        # Quadrature, exact for the polynomials of each element: points, weights / strip length.
        gauss, weight = np.polynomial.legendre.leggauss(6)
        every = np.union1d(beam.nodes, edges[1])
        marks = [every[every <= edges[1]], every[every >= edges[1]]]
        spots = [((m[1:] + m[:-1])[:, None] + np.diff(m)[:, None] * gauss) / 2.0 for m in marks]
        parts = [
            np.diff(m)[:, None] * weight / (2.0 * w) for m, w in zip(marks, lengths, strict=True)
        ]
        first = spots[0].size
        x = np.concatenate([s.ravel() for s in spots] + [[x_e]])
        mean = np.concatenate([p.ravel() for p in parts] + [[1.0]])
        w, rate = beam.shapes(modes, x)
        strip_of = np.repeat([0, 1, 2], [first, spots[1].size, 1])

        def applied(loads: Sequence[float]) -> np.ndarray:
            """Weights of a load: its two strips' values and the elevator's."""
            return mean * np.asarray(loads)[strip_of]

        # Local incidence beyond the body's, at each point: what bending makes of it is scaled.
        self.heave, self.pitch = beam.mean(modes, x_cg)
        scale = ref["elastic_scale"]
        bent = -scale * (rate - self.pitch)
        moving = -scale * (w - self.heave - np.outer(x - x_cg, self.pitch))
        pitching = pitch_rate * (x - x_cg)

        local = applied((*self.strip_slope, cl_d))  # load per unit of local incidence
        turning = local * (x_r - x) / chord
        fore = applied((1.0, 0.0, 0.0))
        self.cl_eta, self.cl_rate, self.cl_q = local @ bent, local @ moving, local @ pitching
        self.cm_eta, self.cm_rate, self.cm_q = turning @ bent, turning @ moving, turning @ pitching
        self.ct_eta, self.ct_rate, self.ct_q = fore @ bent, fore @ moving, fore @ pitching
        kappa = self.kappa = slope(drag, a_r, d_r) / slope(lift, a_r, d_r)
        lifts = (self.cl_eta, self.cl_rate, self.cl_q)
        self.cd_eta, self.cd_rate, self.cd_q = (kappa * part for part in lifts)
        self.n_0 = applied((*self.strip[0], 0.0)) @ w
        self.n_alpha = applied((*self.strip[1], cl_d)) @ w
        self.n_alpha2 = applied((*self.strip[2], 0.0)) @ w
        self.n_elevator = applied((0.0, 0.0, 1.0)) @ w
        # One force for all the lift that the fuel adds, where its moment at a_r puts it.
        plume = [poly(aero.get(key, {}), a_r) for key in ("lift_phi", "moment_phi")]
        x_p = self.x_p = x_r - chord * plume[1] / plume[0] if plume[0] else None
        self.n_plume = np.zeros(w.shape[1])
        if x_p is not None:
            self.n_plume = beam.shapes(modes, np.array([x_p]))[0][0]
        push = w.T * local
        self.n_eta, self.n_rate, self.n_q = push @ bent, push @ moving, push @ pitching
        # The thrust's virtual work: T sin(alpha) lifts the mass centre, T z_T turns the nacelle.
        engine = geometry["fore_body_m"] + geometry["nacelle_m"] / 2.0
        self.lifted = beam.shapes(modes, np.array([x_cg]))[0][0]
        self.turned = -ref["thrust_arm_m"] * beam.shapes(modes, np.array([engine]))[1][0]
