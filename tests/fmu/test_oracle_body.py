"""The oracle's body, sensors and parameters against mechanics of their own."""

from __future__ import annotations

from collections.abc import Callable
from decimal import localcontext

import numpy as np
import pytest
from scipy.linalg import eigh

from harness import CONFIGURATIONS, EVEN_MASS_BEAM, RIGID, SLOSH_BEAM
from oracle import Vehicle
from oracle_aero import TINY, gravity, poly, slope
from oracle_burn import Burning
from oracle_factors import FACTORS
from oracle_modes import DIGITS

SHIFT = 0.4  # m
BODIES = [
    {"configuration": EVEN_MASS_BEAM, "mass_centre_shift": SHIFT},
    {"configuration": SLOSH_BEAM},
    {"configuration": SLOSH_BEAM, "fuel_fraction": 0.5, "mass_centre_shift": SHIFT},
    {"configuration": SLOSH_BEAM, "aero": "parker2007", "mass_centre_shift": -SHIFT},
]


def heavy(oracle: Vehicle) -> tuple[np.ndarray, np.ndarray]:
    """Heave and pitch about the mass centre, [unknown, 2], and M' times them."""
    with localcontext(prec=DIGITS):
        _, inertia, free = oracle.beam.structure()
        load = inertia.times(free)
    free, load = free.astype(float), load.astype(float)
    turn = np.array([[1.0, -oracle.x_cg], [0.0, 1.0]])
    return free @ turn, load @ turn


def motions(oracle: Vehicle) -> np.ndarray:
    """Unknowns of the structure by mode."""
    return Burning._displacements(oracle)


@pytest.mark.parametrize("parameters", BODIES)
def test_verif_the_body_has_the_wanted_mass_centre_and_inertia(
    vehicle: Callable[..., Vehicle], parameters: dict
) -> None:
    """Quadratic forms of M' with heave and pitch about the mass centre: m, 0 and I."""
    oracle = vehicle(**parameters)
    free, load = heavy(oracle)
    found, mass = free.T @ load, oracle.beam.mass
    assert found[0, 0] == pytest.approx(mass, rel=1e-12)
    assert found[1, 1] == pytest.approx(oracle.i_yy, rel=1e-11)
    assert abs(found[0, 1]) < 1e-11 * mass * oracle.beam.nodes[-1]
    shift = parameters.get("mass_centre_shift", 0.0)
    shift += oracle.aero["inertia"].get("mass_centre_shift_m", 0.0)
    assert oracle.x_cg == pytest.approx(oracle.beam.x_own + shift, rel=1e-14)


@pytest.mark.parametrize("parameters", BODIES)
def test_verif_modes_neither_heave_nor_pitch(
    vehicle: Callable[..., Vehicle], parameters: dict
) -> None:
    """Modes carry neither momentum nor moment of momentum, and are orthogonal to each other."""
    oracle = vehicle(**parameters)
    _, load = heavy(oracle)
    modes = motions(oracle)
    for name, own in zip(("mass", "i_yy"), (load[:, 0], load[:, 1]), strict=True):
        size = np.sqrt(oracle.modal_mass * getattr(oracle, name))
        assert np.abs(own @ modes / size).max() < 1e-11
    product = modes.T @ Burning._product(oracle, modes)
    size = np.sqrt(np.outer(oracle.modal_mass, oracle.modal_mass))
    assert np.abs(product / size - np.eye(len(product))).max() < 1e-11


def test_verif_the_body_is_the_beam_and_two_terms(vehicle: Callable[..., Vehicle]) -> None:
    """M' = M + delta (h r^T + r h^T) + j r r^T with mean translation h and mean rotation r."""
    oracle = vehicle(**BODIES[2], elements=60)
    beam = oracle.beam
    _, mass, first, slosh = beam.matrices()
    size = 2 * len(beam.nodes) + len(slosh)
    own = np.zeros((size, size))
    for (row, column), value in mass.items():
        own[row, column] = own[column, row] = float(value)
    m_b, x_b, i_b = beam.body()
    one, turn = np.zeros(size), np.zeros(size)
    one[first], turn[first], turn[first + 1] = 1.0, beam.nodes - x_b, 1.0
    h, r = own @ one / m_b, own @ turn / i_b
    d, shift = beam.x_own - x_b, oracle.x_cg - beam.x_own
    j = oracle.i_yy - beam.inertia + beam.mass * ((d + shift) ** 2 - d**2)
    delta = beam.mass * shift
    wanted = own + delta * (np.outer(h, r) + np.outer(r, h)) + j * np.outer(r, r)
    block = np.random.default_rng(1).normal(size=(size, 3))
    product = wanted @ block
    error = np.abs(Burning._product(oracle, block) - product).max()
    assert error < 1e-12 * np.abs(product).max()
    # These projections also give mean displacement and slope of the modes.
    modes, (heave, pitch) = motions(oracle), (oracle.elastic.heave, oracle.elastic.pitch)
    np.testing.assert_allclose(pitch, r @ modes, rtol=1e-9, atol=1e-13)
    np.testing.assert_allclose(heave, h @ modes + pitch * (oracle.x_cg - x_b), atol=1e-12)
    # The modes are those of the full matrices, within double precision.
    stiff = np.zeros((size, size))
    for (row, column), value in beam.matrices()[0].items():
        stiff[row, column] = stiff[column, row] = float(value)
    exact = np.sqrt(eigh(stiff, wanted, eigvals_only=True, subset_by_index=[2, 6]))
    np.testing.assert_allclose(np.sort(oracle.omega), exact, rtol=1e-6)


def test_verif_a_beam_alone_keeps_its_modes(vehicle: Callable[..., Vehicle]) -> None:
    """Wherever its mass centre is put and however hard it is to turn."""
    plain = vehicle(EVEN_MASS_BEAM)
    other = vehicle(EVEN_MASS_BEAM, mass_centre_shift=SHIFT, inertia_factor=3.0)
    np.testing.assert_allclose(other.omega, plain.omega, rtol=1e-13)
    np.testing.assert_allclose(other.modal_mass, plain.modal_mass, rtol=1e-12)
    assert np.abs([other.elastic.pitch, other.elastic.heave]).max() < 1e-14


def test_a_body_that_cannot_be_is_refused() -> None:
    with pytest.raises(ValueError, match="no body of"):
        Vehicle(SLOSH_BEAM, elements=60, inertia_factor=0.1)


@pytest.mark.parametrize("pitch_rate_factor", [0.0, 1.0])
@pytest.mark.parametrize("fuel_fraction", [1.0, 0.5])
def test_verif_a_stiff_beam_is_a_body_with_two_masses_on_springs(
    vehicle: Callable[..., Vehicle], fuel_fraction: float, pitch_rate_factor: float
) -> None:
    """Short period and slosh poles of heave, pitch and two masses moving in their tanks.

    Liquid at rest makes one body of all, with m and I about x_c; the forces act on the body alone,
    as its own incidence and pitch rate say. Speed and height stay. The mass centre is put where
    moments are given, for which the modes are loaded with the lift and not with the normal force.
    What bending is left falls as the stiffness grows: 6e-6 rad/s here, ten times less at ten times.
    """
    oracle = vehicle(
        fuel_fraction=fuel_fraction,
        pitch_rate_factor=pitch_rate_factor,
        stiffness_factor=1e4,
        mass_centre_shift=16.764 - vehicle(fuel_fraction=fuel_fraction).x_cg,
    )
    (x, u), m, i_yy = oracle.trim(), oracle.mass, oracle.i_yy
    flexible = [0, 1, *range(5, 11)]
    a = np.delete(np.delete(oracle.linearise().a, flexible, 0), flexible, 1)

    v, aero, ref, e = x[0], oracle.aero, oracle.aero["reference"], oracle.elastic
    alpha, body, inflow, _ = oracle.incidences(x, u)
    forces = oracle.forces(x, u)
    load = forces["qbar"] * ref["area_m2_per_m"]
    # Forces by incidence of the body, its q/V, and the incidence of the mean axes.
    c_t = slope(aero["thrust"], inflow, 0.0) + u[1] * slope(aero["thrust_phi"], inflow, 0.0)
    thrust = load * c_t * np.array([1.0, e.ct_q, 0.0])
    lift = load * np.array([slope(aero["lift"], body, u[0]), e.cl_q, 0.0])
    lift = lift + np.sin(alpha) * thrust + [0.0, 0.0, forces["thrust"] * np.cos(alpha)]
    turn = load * ref["chord_m"] * np.array([slope(aero["moment"], body, u[0]), e.cm_q, 0.0])
    turn = turn + ref["thrust_arm_m"] * thrust

    # Heave of the body at x_c, its pitch (nose up), and the masses relative to their tanks.
    point, where = oracle.beam.points()
    arm = where - oracle.x_cg
    inertia = np.diag([m, i_yy, *point])
    inertia[0, 2:] = inertia[2:, 0] = point
    inertia[1, 2:] = inertia[2:, 1] = -point * arm
    # Unknowns: four rates, pitch and the displacements of the masses; heave has no effect.
    rates, places = np.eye(7)[:4], np.vstack([np.zeros(7), np.eye(7)[4:]])
    mean_heave = rates[0] + point @ rates[2:] / m
    mean_pitch = places[1] - point * arm @ places[2:] / i_yy
    seen = np.array([places[1] - rates[0] / v, rates[1] / v, mean_pitch - mean_heave / v])
    tanks = oracle.beam.tanks
    springs = [-t.stiffness * places[2 + k] - t.damping * rates[2 + k] for k, t in enumerate(tanks)]
    change = np.linalg.solve(inertia, np.vstack([lift @ seen, turn @ seen, *springs]))
    small = np.vstack([change, rates[1:]])

    ours, theirs = (np.sort_complex(np.linalg.eigvals(matrix)) for matrix in (a, small))
    assert ours.real.max() > 3.0
    np.testing.assert_allclose(ours, theirs, atol=1e-5)


def velocity(oracle: Vehicle, x: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Velocity of the IMU's place, level and up, by the state alone."""
    attitude = x[2] + x[3]
    heave, climb = oracle.imu[0] @ x[5::2], oracle.imu[0] @ x[6::2]
    along, across = -x[4] * heave, x[4] * (oracle.x_cg - oracle.imu_station) + climb
    level = x[0] * np.cos(x[2]) + along * np.cos(attitude) - across * np.sin(attitude)
    return np.array(
        [level, x[0] * np.sin(x[2]) + along * np.sin(attitude) + across * np.cos(attitude)]
    )


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_the_imu_feels_how_its_place_accelerates(
    vehicle: Callable[..., Vehicle], configuration: int
) -> None:
    """Its specific force is its acceleration minus gravity; its path follows its velocity.

    Far from trim, along the flow. What the round earth bends the path by is added as in eq. (3).
    """
    oracle = vehicle(configuration, imu_station=5.0)
    x, u = oracle.trim()
    generator = np.random.default_rng(4)
    x = x + generator.normal(size=len(x)) * 0.05
    u = np.append(u, [2.0, -3.0])
    flow = oracle.rhs(0.0, x, u)
    rate = velocity(oracle, x + 1j * TINY * flow, u).imag / TINY
    down = float(gravity(oracle.earth, x[1]))
    curve = x[0] ** 2 / (oracle.earth["earth"]["radius_m"] + x[1]) * np.cos(x[2])
    rate += [curve * np.sin(x[2]), down - curve * np.cos(x[2])]
    found, (shape, lag) = oracle.outputs(x, u), oracle.imu
    nose = x[2] + x[3] - lag @ x[5::2]
    turn = np.array([[np.cos(nose), np.sin(nose)], [-np.sin(nose), np.cos(nose)]])
    expected = turn @ rate / oracle.earth["earth"]["gravity_m_per_s2"]
    np.testing.assert_allclose([found["n_x_imu"], found["n_z_imu"]], expected, rtol=1e-10)
    path = velocity(oracle, x, u)
    assert found["gamma_imu"] == pytest.approx(np.arctan2(path[1], path[0]), rel=1e-12)
    assert found["theta_imu"] == pytest.approx(nose, rel=1e-12)
    moved = oracle.outputs(x + 1j * TINY * flow, u)["theta_imu"].imag / TINY
    assert found["q_imu"] == pytest.approx(moved, rel=1e-12)
    named = oracle.imu_shapes()
    assert [named[f"shape{i}_imu"] for i in (1, 2, 3)][: len(shape)] == list(shape[:3])


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_the_probe_sees_what_the_air_does_where_it_is(
    vehicle: Callable[..., Vehicle], configuration: int
) -> None:
    """Rising air is incidence, a tail wind takes speed, and pitching takes the nose upwards."""
    oracle = vehicle(configuration)
    x, u = (part.copy() for part in oracle.trim())
    still = oracle.outputs(x, u)["alpha_probe"]
    bent = oracle.probe[1] @ x[5::2]
    assert still == pytest.approx(x[3] - bent, abs=1e-14)
    w = 12.0
    lifted = oracle.outputs(x, np.append(u, [w, 0.0]))["alpha_probe"]
    assert lifted - still == pytest.approx(np.arctan(w / x[0]), rel=1e-12)
    follow = oracle.outputs(x, np.append(u, [0.0, 0.25 * x[0]]))
    assert follow["alpha_probe"] == pytest.approx(still, abs=1e-14)
    calm = oracle.outputs(x, u)
    assert follow["qbar"] == pytest.approx(0.5625 * calm["qbar"], rel=1e-12)
    # A pitch rate about the mass centre reduces the incidence at the nose.
    x[4] = 0.1
    rising = 0.1 * (oracle.x_cg - oracle.probe_station) / x[0]
    assert oracle.outputs(x, u)["alpha_probe"] - still == pytest.approx(-rising, rel=1e-2)


def test_factors_reach_what_they_name(vehicle: Callable[..., Vehicle]) -> None:
    """Each by its own consequence, and none in the data of another vehicle."""
    plain = vehicle(RIGID)
    (x, u), nominal = plain.trim(), plain.outputs(*plain.trim())

    def ratio(name: str, factor: str) -> float:
        return vehicle(RIGID, **{factor: 1.25}).outputs(x, u)[name] / nominal[name]

    assert vehicle(RIGID, mass_factor=1.25).mass == pytest.approx(1.25 * plain.mass)
    assert vehicle(RIGID, mass_factor=1.25).i_yy == pytest.approx(plain.i_yy)
    assert vehicle(RIGID, inertia_factor=1.25).i_yy == pytest.approx(1.25 * plain.i_yy)
    assert vehicle(RIGID, mass_centre_shift=SHIFT).x_cg == pytest.approx(plain.x_cg + SHIFT)
    assert ratio("qbar", "density_factor") == pytest.approx(1.25)
    assert ratio("mach", "density_factor") == pytest.approx(1.0)
    assert ratio("thrust", "thrust_factor") == pytest.approx(1.25)
    load = nominal["qbar"] * plain.aero["reference"]["area_m2_per_m"]
    for name in ("lift", "drag"):
        part = load * (poly(plain.aero[name], x[3], u[0]) - poly(plain.aero[name], x[3]))
        elevator = part / nominal[name]
        assert ratio(name, "elevator_factor") == pytest.approx(1.0 + 0.25 * elevator)
        assert ratio(name, f"{name}_factor") == pytest.approx(1.25 - 0.25 * elevator)
    beam = vehicle(EVEN_MASS_BEAM)
    stiff = vehicle(EVEN_MASS_BEAM, stiffness_factor=1.25)
    np.testing.assert_allclose(stiff.omega, np.sqrt(1.25) * beam.omega, rtol=1e-12)
    damped = vehicle(EVEN_MASS_BEAM, structural_damping_factor=1.25)
    np.testing.assert_allclose(damped.damping, 1.25 * beam.damping)
    bent = vehicle(EVEN_MASS_BEAM, elastic_factor=1.25)
    np.testing.assert_allclose(bent.elastic.n_eta, 1.25 * beam.elastic.n_eta)
    assert vehicle(RIGID, **FACTORS).outputs(x, u) == nominal
    with pytest.raises(TypeError, match="no such parameter: masss_factor"):
        Vehicle(RIGID, masss_factor=2.0)


def test_offsets_move_the_start(vehicle: Callable[..., Vehicle]) -> None:
    """The sloshing masses' against their tanks, whatever the flexible modes do."""
    given = {"alpha_offset": 0.01, "eta2_offset": 0.02, "slosh1_offset": 0.03}
    oracle = vehicle(**given, q_offset=-0.02, eta1_dot_offset=0.1, slosh2_dot_offset=-0.2)
    trim, control = oracle.trim()
    _, states, outputs = oracle.simulate(0.0, 0.01, lambda k: (0.0, 0.0))
    move = states[0] - trim
    np.testing.assert_allclose(move[:5], [0.0, 0.0, 0.0, 0.01, -0.02], atol=1e-15)
    np.testing.assert_allclose(move[5:11], [0.0, 0.1, 0.02, 0.0, 0.0, 0.0], atol=1e-15)
    rest = oracle.outputs(trim, control)
    assert outputs["slosh_1"][0] - rest["slosh_1"] == pytest.approx(0.03, rel=1e-12)
    assert outputs["slosh_2"][0] == pytest.approx(rest["slosh_2"], abs=1e-15)
    np.testing.assert_allclose(oracle.rel @ move[6::2], [0.0, -0.2], atol=1e-14)
