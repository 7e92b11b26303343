"""The oracle against textbook results and other software: who checks the checker."""

from __future__ import annotations

from collections.abc import Callable

import control
import numpy as np
import pytest

from harness import AERO_SETS, EVEN_MASS_BEAM, RIGID, SLOSH_BEAM
from oracle import DATA_DIR, Vehicle
from oracle_aero import Elastic, atmosphere, poly, slope
from oracle_structure import Beam, Modes, load

# US Standard Atmosphere 1976, table 4: geopotential base, temperature in K, pressure in Pa.
LAYERS = [
    (11000.0, 216.65, 22632.06),
    (20000.0, 216.65, 5474.889),
    (32000.0, 228.65, 868.0187),
    (47000.0, 270.65, 110.9063),
    (51000.0, 270.65, 66.93887),
    (71000.0, 214.65, 3.956420),
]
# Roots of cos(x) cosh(x) = 1.
FREE_FREE = np.array([4.730040744862704, 7.853204624095838, 10.995607838001671])


def far(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Largest distance of `ours` to the nearest of `theirs`."""
    return max(float(np.min(np.abs(theirs - value)) / max(1.0, abs(value))) for value in ours)


@pytest.mark.parametrize(("height", "temperature", "pressure"), LAYERS)
def test_verif_atmosphere_is_the_1976_standard(
    height: float, temperature: float, pressure: float
) -> None:
    """Pressure and temperature at the bases of the layers, as tabulated."""
    earth = load(DATA_DIR / "earth.toml")
    radius, gas = earth["earth"]["radius_m"], earth["air"]["gas_constant_j_per_kg_k"]
    density, sound = atmosphere(earth, radius * height / (radius - height))
    assert density * gas * temperature == pytest.approx(pressure, rel=2e-6)
    assert sound == pytest.approx(np.sqrt(1.4 * gas * temperature), rel=1e-9)


def test_verif_uniform_beam_has_the_analytic_modes() -> None:
    """Free-free frequencies and the modal mass m/4 at unit tip deflection."""
    data = load(DATA_DIR / "vehicle.toml")
    beam = Beam(data, EVEN_MASS_BEAM, 1.0, 0.05, 0.0, 8.8, 60)
    beam.stiffness[:], beam.density[:] = 2e8, 400.0
    length = beam.nodes[-1]
    modes = beam.modes(3)
    exact = (FREE_FREE / length) ** 2 * np.sqrt(2e8 / 400.0)
    np.testing.assert_allclose(modes.omega, exact, rtol=1e-5)
    np.testing.assert_allclose(modes.mass, 400.0 * length / 4.0, rtol=1e-5)


@pytest.mark.parametrize("aero_set", AERO_SETS)
@pytest.mark.parametrize("configuration", [RIGID, SLOSH_BEAM])
def test_verif_rigid_motion_as_a_mode_is_incidence_of_the_body(
    vehicle: Callable[..., Vehicle], configuration: int, aero_set: str
) -> None:
    """Rotation and heave as modes do not bend the body: they change its incidence.

    The load on the heave mode is the lift, and that on the rotation is minus the moment, also of
    what pitching adds. Loads are compared where the derivatives are taken: there the places of
    elevator and plume are exact.
    """
    oracle = vehicle(configuration, aero=aero_set)
    nodes, aero, x_cg = oracle.beam.nodes, oracle.aero, oracle.x_cg
    one = np.ones_like(nodes)
    w, turn = np.stack([nodes - x_cg, one], 1), np.stack([one, 0.0 * one], 1)
    fake = Modes(np.ones(2), np.ones(2), w, turn, np.zeros((0, 2)))
    terms = Elastic(oracle.data["geometry"], aero, oracle.beam, fake, x_cg, pitch_rate=1.0)
    np.testing.assert_allclose(terms.pitch, [1.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(terms.heave, [0.0, 1.0], atol=1e-12)
    for name in ("cl", "cd", "cm", "ct", "n"):
        for kind in ("eta", "rate"):
            assert np.abs(getattr(terms, f"{name}_{kind}")).max() < 1e-11
    reference = aero["reference"]
    at = (reference["elastic_alpha_rad"], reference.get("elastic_delta_e_rad", 0.0))
    shift, chord, alpha = x_cg - reference["moment_centre_m"], reference["chord_m"], 0.02
    body = terms.n_0 + terms.n_alpha * alpha + terms.n_alpha2 * alpha**2
    elevator = terms.n_elevator * slope(aero["lift"], *at, "delta_e")
    loads = [
        (body, *(poly(aero[key], alpha) for key in ("lift", "moment"))),
        (elevator, *(slope(aero[key], *at, "delta_e") for key in ("lift", "moment"))),
        (terms.n_q, terms.cl_q, terms.cm_q),
    ]
    if "lift_phi" in aero:
        c_l, c_m = (poly(aero[key], at[0]) for key in ("lift_phi", "moment_phi"))
        loads.append((terms.n_plume * c_l, c_l, c_m))
    for modal, c_l, c_m in loads:
        assert modal[1] == pytest.approx(c_l, rel=1e-12)
        assert modal[0] == pytest.approx(-(chord * c_m + shift * c_l), rel=1e-12)
    # With a pitch rate each strip has the incidence of its middle.
    first, joint, length = 0.0, oracle.data["geometry"]["fore_body_m"], nodes[-1]
    middles = np.array([(first + joint) / 2.0, (joint + length) / 2.0, terms.x_e]) - x_cg
    slopes = [*terms.strip_slope, slope(aero["lift"], *at, "delta_e")]
    assert terms.cl_q == pytest.approx(slopes @ middles, rel=1e-12)
    assert terms.ct_q == pytest.approx(middles[0], rel=1e-12)


@pytest.mark.parametrize("configuration", [RIGID, EVEN_MASS_BEAM, SLOSH_BEAM])
def test_verif_poles_and_zeros_equal_python_control(
    vehicle: Callable[..., Vehicle], configuration: int
) -> None:
    """Poles, and the zeros from (delta_e, phi) to V and gamma, here and at the IMU."""
    oracle = vehicle(configuration)
    model = oracle.linearise()
    system = control.ss(model.a, model.b, model.c, model.d)
    poles, zeros = control.poles(system), control.zeros(system)
    assert len(oracle.poles()) == len(poles)
    # The double zero at the origin splits by the square root of the rounding error.
    assert far(oracle.poles(), poles) < 1e-7
    assert len(oracle.zeros()) == oracle.states - 2
    assert far(oracle.zeros(), zeros) < 1e-4
    model = oracle.linearise(outputs=("V", "gamma_imu"))
    assert len(model.c) == 2 and not model.d.any()
    zeros = control.zeros(control.ss(model.a, model.b, model.c, model.d))
    assert far(oracle.zeros("gamma_imu"), zeros) < 1e-4


@pytest.mark.parametrize("configuration", [EVEN_MASS_BEAM, SLOSH_BEAM])
def test_verif_damping_takes_energy(vehicle: Callable[..., Vehicle], configuration: int) -> None:
    """The modal damping matrix, in energy coordinates, is symmetric and positive definite."""
    oracle = vehicle(configuration)
    power = oracle.modal_mass[:, None] * oracle.damping
    np.testing.assert_allclose(power, power.T, rtol=1e-9, atol=1e-9 * np.abs(power).max())
    assert np.linalg.eigvalsh((power + power.T) / 2.0).min() > 0.0


def test_verif_liquid_at_rest_lies_on_the_floor(vehicle: Callable[..., Vehicle]) -> None:
    """In trim the springs carry no weight of the sloshing masses, and the beam is at rest.

    Without the floors each mass would hang g_eff/omega^2 below its tank; without the thrust's work
    on the modes it would lag behind a beam that seems to spin. What is left are the modes that are
    not kept, and the small part of the drag across the body.
    """
    for parameters in ({}, {"fuel_fraction": 0.5}):
        oracle = vehicle(**({"configuration": SLOSH_BEAM} | parameters))
        outputs = oracle.outputs(*oracle.trim())
        for key in ("slosh_1", "slosh_2"):
            assert abs(outputs[key]) < 1e-3
