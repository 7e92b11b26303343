"""The interface that masters rely on, written by hand: names, causality, variability, type, unit.

Scripts, controllers and diagrams of users refer to these names and numbers. Entries are added,
never changed or removed.
"""

from __future__ import annotations

from typing import NamedTuple


class Entry(NamedTuple):
    """One variable; `unit` and `display` are None where they do not apply."""

    name: str
    causality: str
    variability: str
    type: str
    unit: str | None = None
    display: str | None = None


def reals(names: str, causality: str, variability: str, unit: str) -> list[Entry]:
    """Real variables that differ only by name; angles are shown in degrees."""
    display = "deg" if unit == "rad" else None
    rows = names.split()
    return [Entry(name, causality, variability, "Real", unit, display) for name in rows]


CONTRACT = [
    *reals("delta_e", "input", "continuous", "rad"),
    *reals("phi", "input", "continuous", "1"),
    *reals("w_gust u_gust", "input", "continuous", "m/s"),
    *reals("V", "output", "continuous", "m/s"),
    *reals("gamma alpha theta delta_e_effective", "output", "continuous", "rad"),
    *reals("theta_imu gamma_imu alpha_probe", "output", "continuous", "rad"),
    *reals("eta1 eta2 eta3 h slosh1 slosh2", "output", "continuous", "m"),
    *reals("lift drag thrust", "output", "continuous", "N/m"),
    *reals("moment", "output", "continuous", "N"),
    *reals("mach n_z phi_effective", "output", "continuous", "1"),
    *reals("n_z_imu n_x_imu choking_margin", "output", "continuous", "1"),
    *reals("qbar", "output", "continuous", "Pa"),
    *reals("fuel_mass", "output", "continuous", "kg/m"),
    *reals("der(fuel_mass)", "local", "continuous", "kg/(m.s)"),
    Entry("q", "output", "continuous", "Real", "rad/s", "deg/s"),
    Entry("q_imu", "output", "continuous", "Real", "rad/s", "deg/s"),
    Entry("configuration", "parameter", "fixed", "Enumeration"),
    Entry("aero", "parameter", "fixed", "Enumeration"),
    Entry("input_mode", "parameter", "fixed", "Enumeration"),
    Entry("trim", "parameter", "fixed", "Boolean"),
    Entry("fuel_burn", "parameter", "fixed", "Boolean"),
    *reals("fuel_fraction slosh_damping mach0", "parameter", "fixed", "1"),
    *reals("slosh_frequency", "parameter", "fixed", "rad/s"),
    *reals("altitude0 eta10 eta20 eta30", "parameter", "fixed", "m"),
    *reals("gamma0 alpha0", "parameter", "fixed", "rad"),
    Entry("q0", "parameter", "fixed", "Real", "rad/s", "deg/s"),
    *reals("imu_station probe_station mass_centre_shift", "parameter", "fixed", "m"),
    *reals("mass_factor inertia_factor density_factor", "parameter", "fixed", "1"),
    *reals("lift_factor drag_factor moment_alpha_factor", "parameter", "fixed", "1"),
    *reals("elevator_factor thrust_factor elastic_factor", "parameter", "fixed", "1"),
    *reals("stiffness_factor structural_damping_factor", "parameter", "fixed", "1"),
    *reals("pitch_rate_factor", "parameter", "fixed", "1"),
    *reals("alpha_offset", "parameter", "fixed", "rad"),
    Entry("q_offset", "parameter", "fixed", "Real", "rad/s", "deg/s"),
    *reals("eta1_offset eta2_offset eta3_offset", "parameter", "fixed", "m"),
    *reals("slosh1_offset slosh2_offset", "parameter", "fixed", "m"),
    *reals("eta1_dot_offset eta2_dot_offset eta3_dot_offset", "parameter", "fixed", "m/s"),
    *reals("slosh1_dot_offset slosh2_dot_offset", "parameter", "fixed", "m/s"),
    *reals("alpha_trim delta_e_trim", "calculatedParameter", "fixed", "rad"),
    *reals("phi_trim", "calculatedParameter", "fixed", "1"),
    *reals("shape1_imu shape2_imu shape3_imu", "calculatedParameter", "fixed", "1"),
    *reals("slope1_imu slope2_imu slope3_imu", "calculatedParameter", "fixed", "rad/m"),
    *reals("mass_centre", "calculatedParameter", "fixed", "m"),
    *reals("pitch_inertia", "calculatedParameter", "fixed", "kg.m"),
    *reals(
        "omega1 omega2 omega3 omega_slosh1 omega_slosh2", "calculatedParameter", "fixed", "rad/s"
    ),
    *reals(
        "eta1_dot eta2_dot eta3_dot eta_slosh1_dot eta_slosh2_dot", "local", "continuous", "m/s"
    ),
    *reals("eta_slosh1 eta_slosh2", "local", "continuous", "m"),
    *reals("der(V)", "local", "continuous", "m/s2"),
    *reals(
        "der(h) der(eta1) der(eta2) der(eta3) der(eta_slosh1) der(eta_slosh2)",
        *("local", "continuous", "m/s"),
    ),
    Entry("der(gamma)", "local", "continuous", "Real", "rad/s", "deg/s"),
    Entry("der(alpha)", "local", "continuous", "Real", "rad/s", "deg/s"),
    *reals("der(q)", "local", "continuous", "rad/s2"),
    *reals(
        "der(eta1_dot) der(eta2_dot) der(eta3_dot) der(eta_slosh1_dot) der(eta_slosh2_dot)",
        *("local", "continuous", "m/s2"),
    ),
]

# Exponents of the base units: kg, m, s, rad.
UNITS = {
    "1": (0, 0, 0, 0),
    "m": (0, 1, 0, 0),
    "m/s": (0, 1, -1, 0),
    "m/s2": (0, 1, -2, 0),
    "rad": (0, 0, 0, 1),
    "rad/m": (0, -1, 0, 1),
    "rad/s": (0, 0, -1, 1),
    "rad/s2": (0, 0, -2, 1),
    "N/m": (1, 0, -2, 0),
    "N": (1, 1, -2, 0),
    "Pa": (1, -1, -2, 0),
    "kg/m": (1, -1, 0, 0),
    "kg/(m.s)": (1, -1, -1, 0),
    "kg.m": (1, 1, 0, 0),
}

# Numbers of values never change.
ENUMERATIONS = {
    "configuration": {"Rigid": 1, "EvenMassBeam": 2, "SloshBeam": 3},
    "aero": {"xu2015": 1, "parker2007": 2, "shock_expansion": 3},
    "input_mode": {"DeviationFromTrim": 1, "Absolute": 2},
}
COMPLETE = ("configuration", "input_mode")

FACTORS = (
    *("mass", "inertia", "density", "lift", "drag", "moment_alpha", "elevator", "thrust"),
    *("elastic", "stiffness", "structural_damping"),
)
OFFSETS = (
    *("alpha", "q", "eta1", "eta2", "eta3", "eta1_dot", "eta2_dot", "eta3_dot"),
    *("slosh1", "slosh2", "slosh1_dot", "slosh2_dot"),
)
START = {
    **{"delta_e": 0.0, "phi": 0.0, "configuration": 3, "aero": 1, "input_mode": 1, "trim": True},
    **{"w_gust": 0.0, "fuel_fraction": 1.0, "slosh_damping": 0.05, "slosh_frequency": 0.0},
    **{"mach0": 8.0, "altitude0": 25900.0, "gamma0": 0.0, "fuel_burn": False},
    **{"imu_station": 16.764, "probe_station": 0.0, "u_gust": 0.0},
    **{f"{name}_factor": 1.0 for name in FACTORS},
    **{"mass_centre_shift": 0.0, "pitch_rate_factor": 0.0},
    **{f"{name}_offset": 0.0 for name in OFFSETS},
}
EXPERIMENT = {"startTime": 0.0, "stopTime": 2.0, "stepSize": 2e-4, "tolerance": 1e-8}
