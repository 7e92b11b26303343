"""What the test oracle says of each configuration, as text."""

from __future__ import annotations

import numpy as np

from oracle import Vehicle
from oracle_structure import EVEN_MASS_BEAM, RIGID, SLOSH_BEAM

NAMES = ("rigid", "even mass beam", "slosh beam")


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
            f"  of gamma_imu   {vehicle.zeros('gamma_imu')}",
        ]
    )


if __name__ == "__main__":
    np.set_printoptions(precision=10, linewidth=110)
    for number in (RIGID, EVEN_MASS_BEAM, SLOSH_BEAM):
        print(report(Vehicle(number)))
