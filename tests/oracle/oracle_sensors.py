"""What sensors on the bending body read, for the test oracle.

Axes of the body: forward and up, turned by theta from the horizon; x_cg is their origin.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from oracle import Vehicle


def readings(vehicle: Vehicle, x: np.ndarray, u: np.ndarray, f: dict[str, Any]) -> dict[str, Any]:
    """Attitude rad, rates rad/s, path rad and load g of the IMU, and the probe's incidence rad.

    f are the forces at (x, u). Accelerations of the modes are those of their equations.
    """
    (v, _, gamma, alpha, q), eta, rate = x[:5], x[5::2], x[6::2]
    change = vehicle.rhs(0.0, x, u)
    spin, (w, slope) = change[4], vehicle.imu
    arm = vehicle.x_cg - vehicle.imu_station
    lag, heave = slope @ eta, w @ eta
    climb, lift_off = w @ rate, w @ change[6::2]
    ahead = v * np.cos(alpha) - q * heave
    up = -v * np.sin(alpha) + q * arm + climb

    # Specific force of the mass centre, then of the sensor's place, then along the sensor's axes.
    sine, cosine = np.sin(f["alpha"]), np.cos(f["alpha"])
    forward = (f["thrust"] + f["lift"] * sine - f["drag"] * cosine) / vehicle.mass
    normal = (f["lift"] * cosine + f["drag"] * sine) / vehicle.mass
    forward = forward - q**2 * arm - spin * heave - 2.0 * q * climb
    normal = normal + spin * arm - q**2 * heave + lift_off
    weight = vehicle.earth["earth"]["gravity_m_per_s2"]

    speed, _ = vehicle.stream(x, u)
    w_p, slope_p = vehicle.probe
    met = speed * cosine - q * (w_p @ eta)
    rising = -speed * sine + q * (vehicle.x_cg - vehicle.probe_station) + w_p @ rate
    return {
        "theta_imu": gamma + alpha - lag,
        "q_imu": q - slope @ rate,
        "gamma_imu": gamma + alpha + np.arctan(up / ahead),
        "n_z_imu": (normal * np.cos(lag) + forward * np.sin(lag)) / weight,
        "n_x_imu": (forward * np.cos(lag) - normal * np.sin(lag)) / weight,
        "alpha_probe": np.arctan(-rising / met) - slope_p @ eta,
    }
