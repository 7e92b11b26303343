//! The beam's statics, masses and shape functions against closed forms.

use super::reference::{tanked, uniform, vehicle};
use ahv::structure::{Beam, Oscillator, Shape};
use proptest::prelude::*;

/// Sums over 500 elements, each rounded to 1e-16.
const SUMS: f64 = 1e-13;
/// Twice integrated, hence rounded a few times more often.
const INTEGRATED: f64 = 1e-12;

#[track_caller]
fn close(value: f64, truth: f64, tolerance: f64) {
    assert!((value - truth).abs() <= tolerance * truth.abs(), "{value:e} is not {truth:e}");
}

/// Holds the nose of a cantilever: the load that balances `force` and `moment` on the last node.
fn on_the_tip(beam: &Beam, force: f64, moment: f64) -> Vec<f64> {
    let mut load = vec![0.0; beam.unknowns()];
    let tip = beam.unknowns() - 2;
    load[tip] = force;
    load[tip + 1] = moment;
    load[0] = -force;
    load[1] = -moment - force * beam.length_m();
    load
}

fn deflect(beam: &Beam, load: &[f64]) -> Vec<f64> {
    let mut displacement = vec![0.0; beam.unknowns()];
    beam.deflect(load, &mut displacement);
    displacement
}

#[test]
fn verif_cantilever_bends_as_in_the_textbook() {
    let (length, ei, force, moment) = (30.0, 2e8, 5e3, -7e4);
    let beam = uniform(500, length, ei, 1.0);
    let displacement = deflect(&beam, &on_the_tip(&beam, force, moment));
    for node in [1, 137, 250, 500] {
        let x = beam.station(node);
        let w = force * x * x * (3.0 * length - x) / (6.0 * ei) + moment * x * x / (2.0 * ei);
        let slope = force * x * (2.0 * length - x) / (2.0 * ei) + moment * x / ei;
        close(displacement[2 * node], w, INTEGRATED);
        close(displacement[2 * node + 1], slope, INTEGRATED);
    }
}

/// The inner half is four times as stiff: `w_tip = P a^3 / 3 EI_o + ...` by superposition.
#[test]
fn verif_stepped_cantilever_bends_as_by_superposition() {
    let (length, inner, outer, force) = (8.0, 4e6, 1e6, 300.0);
    let mut beam = uniform(64, length, inner, 1.0);
    beam.stiffness[32..].fill(outer);
    let tip = deflect(&beam, &on_the_tip(&beam, force, 0.0))[2 * 64];
    let half = length / 2.0;
    let w_joint = force * half.powi(3) * (1.0 / 3.0 + 1.0 / 2.0) / inner;
    let slope_joint = force * half * half * (1.0 / 2.0 + 1.0) / inner;
    let truth = w_joint + slope_joint * half + force * half.powi(3) / (3.0 * outer);
    close(tip, truth, INTEGRATED);
}

#[test]
fn verif_mass_books_close_at_every_filling() {
    let data = vehicle();
    let (fore, aft) = (data.mass.fore_beam_kg_per_m2.value, data.mass.aft_beam_kg_per_m2.value);
    let (joint, length) = (data.mass.beam_joint_m.value, data.geometry.length_m.value);
    let full = fore * joint + aft * (length - joint);
    let (p, residual) = (data.mass.propellant_fraction.value, data.mass.residual_fraction.value);
    for fuel in [0.0, 0.5, 1.0] {
        let truth = full * (1.0 - p + p * (residual + (1.0 - residual) * fuel));
        close(Beam::even(&data, fuel).mass_properties(&[]).mass, truth, SUMS);
        let (beam, oscillators) = tanked(fuel, 0.0);
        close(beam.mass_properties(&oscillators).mass, truth, SUMS);
    }
}

#[test]
fn verif_even_mass_centre_and_inertia_are_those_of_two_rods() {
    let data = vehicle();
    let (fore, aft) = (data.mass.fore_beam_kg_per_m2.value, data.mass.aft_beam_kg_per_m2.value);
    let (joint, length) = (data.mass.beam_joint_m.value, data.geometry.length_m.value);
    let rods = [(fore, 0.0, joint), (aft, joint, length)];
    let sum = |f: &dyn Fn(f64, f64, f64) -> f64| -> f64 {
        rods.iter().map(|&(density, from, to)| f(density, from, to)).sum()
    };
    let mass = sum(&|density, from, to| density * (to - from));
    let centre = sum(&|density, from, to| density * (to * to - from * from) / 2.0) / mass;
    let inertia =
        sum(&|density, from, to| density * ((to - centre).powi(3) - (from - centre).powi(3)) / 3.0);
    let properties = Beam::even(&data, 1.0).mass_properties(&[]);
    close(properties.mass, mass, SUMS);
    close(properties.centre_m, centre, SUMS);
    close(properties.inertia, inertia, SUMS);
}

/// The frozen liquid keeps its mass and its centre wherever the tank's ends fall.
#[test]
fn verif_frozen_liquid_stays_in_its_tank() {
    let data = vehicle();
    let dry = {
        let mut dry = data.clone();
        dry.mass.propellant_fraction.value = 0.0;
        Beam::even(&dry, 0.0).mass_properties(&[])
    };
    let settings = ahv::structure::tanks::SloshSettings {
        damping_ratio: 0.0,
        frequency_rad_per_s: 1.0,
        gravity_m_per_s2: 9.0,
    };
    let mut tanks = ahv::structure::tanks::SloshingTank::pair(&data, 0.7, &settings).unwrap();
    tanks[0].centre_m += 0.0123;
    tanks[0].length_m *= 0.973;
    let properties = Beam::slosh(&data, &tanks).mass_properties(&[]);
    let structure = dry.mass * (1.0 - data.mass.propellant_fraction.value);
    let frozen = tanks.map(|tank| tank.frozen_mass);
    close(properties.mass, structure + frozen[0] + frozen[1], SUMS);
    // Averages over the elements that a tank's ends cut move its mass centre a little.
    let truth =
        structure * dry.centre_m + frozen[0] * tanks[0].centre_m + frozen[1] * tanks[1].centre_m;
    close(properties.mass * properties.centre_m, truth, 1e-4);
}

/// `r^T M r` of heave and pitch are mass and inertia: the consistent matrix is exact for them.
#[test]
fn verif_mass_matrix_is_exact_for_rigid_motion() {
    let (beam, _) = tanked(0.6, 0.0);
    let properties = beam.mass_properties(&[]);
    let motion = |heave: f64, pitch: f64| -> Vec<f64> {
        let arm = |node: usize| beam.station(node) - properties.centre_m;
        (0..=beam.elements()).flat_map(|i| [heave + pitch * arm(i), pitch]).collect()
    };
    let energy = |a: &[f64], b: &[f64]| -> f64 {
        let mut product = vec![0.0; beam.unknowns()];
        beam.mass_times(b, &mut product);
        a.iter().zip(&product).map(|(x, y)| x * y).sum()
    };
    let (heave, pitch) = (motion(1.0, 0.0), motion(0.0, 1.0));
    close(energy(&heave, &heave), properties.mass, SUMS);
    close(energy(&pitch, &pitch), properties.inertia, SUMS);
    let coupling = energy(&heave, &pitch);
    assert!(coupling.abs() < SUMS * properties.mass * beam.length_m(), "{coupling:e}");
}

#[test]
fn verif_mass_product_is_that_of_the_element_matrices() {
    let (beam, _) = tanked(0.3, 0.0);
    let u: Vec<f64> = (0..beam.unknowns()).map(|i| ((i * i) as f64).sin()).collect();
    let mut truth = vec![0.0; u.len()];
    for e in 0..beam.elements() {
        for (i, row) in beam.element_mass(e).iter().enumerate() {
            truth[2 * e + i] += row.iter().zip(&u[2 * e..]).map(|(m, u)| m * u).sum::<f64>();
        }
    }
    let mut product = vec![0.0; u.len()];
    beam.mass_times(&u, &mut product);
    let largest = truth.iter().fold(0.0, |m: f64, t| m.max(t.abs()));
    for (value, truth) in product.iter().zip(&truth) {
        assert!((value - truth).abs() <= 1e-14 * largest, "{value:e} is not {truth:e}");
    }
}

#[test]
fn verif_sloshing_masses_count_at_their_nodes() {
    let beam = uniform(10, 5.0, 1.0, 4.0);
    let point = Oscillator { node: 10, mass: 20.0, stiffness: 1.0, damping: 0.0 };
    let properties = beam.mass_properties(&[point]);
    close(properties.mass, 40.0, SUMS);
    close(properties.centre_m, 3.75, SUMS);
    close(properties.inertia, 20.0 * 25.0 / 12.0 + 2.0 * 20.0 * 1.25 * 1.25, SUMS);
}

#[test]
fn verif_nearest_node_is_nearest() {
    let beam = uniform(10, 5.0, 1.0, 1.0);
    let nodes = [0.0, 0.24, 0.26, 4.9, 5.0, 7.0].map(|x| beam.nearest_node(x));
    assert_eq!(nodes, [0, 0, 1, 10, 10, 10]);
}

fn cubic(beam: &Beam) -> (Shape, impl Fn(f64) -> f64, impl Fn(f64) -> f64) {
    let w = |x: f64| 0.3 - 0.7 * x + 0.2 * x * x - 0.05 * x * x * x;
    let slope = |x: f64| -0.7 + 0.4 * x - 0.15 * x * x;
    let nodes: Vec<f64> = (0..=beam.elements()).map(|i| beam.station(i)).collect();
    let shape = Shape {
        w: nodes.iter().map(|x| w(*x)).collect(),
        slope: nodes.iter().map(|x| slope(*x)).collect(),
    };
    (shape, w, slope)
}

#[test]
fn verif_hermite_functions_reproduce_cubics() {
    let beam = uniform(7, 6.0, 1.0, 1.0);
    let (shape, w, slope) = cubic(&beam);
    for x in [0.0, 0.1, 6.0 / 7.0, 2.345, 5.9999, 6.0] {
        let point = beam.point(x);
        close(shape.w_at(&point), w(x), INTEGRATED);
        close(shape.slope_at(&point), slope(x), INTEGRATED);
    }
}

/// Degree 7: two cubics and one more power of x, over limits inside elements.
#[test]
fn verif_integrals_of_products_are_exact() {
    let beam = uniform(7, 6.0, 1.0, 1.0);
    let (shape, _, _) = cubic(&beam);
    let coefficients = [0.3, -0.7, 0.2, -0.05];
    for (from, to) in [(0.0, 6.0), (0.123, 5.01), (1.0, 1.2), (6.0 / 7.0, 18.0 / 7.0)] {
        let mut truth = 0.0;
        for (i, a) in coefficients.iter().enumerate() {
            for (k, b) in coefficients.iter().enumerate() {
                let power = (i + k + 2) as i32;
                truth += a * b * (f64::powi(to, power) - f64::powi(from, power)) / power as f64;
            }
        }
        let integral = beam.integrate(from, to, |point| shape.w_at(point).powi(2) * point.x);
        close(integral, truth, INTEGRATED);
        close(beam.integrate(from, to, |_| 1.0), to - from, INTEGRATED);
    }
}

proptest! {
    /// `K deflect(f) = f` for any beam and any balanced load, with K from the element matrices.
    #[test]
    fn verif_statics_inverts_the_stiffness(
        stiffness in prop::collection::vec(1e6..1e9_f64, 12),
        mut load in prop::collection::vec(-1e4..1e4_f64, 26),
    ) {
        let mut beam = uniform(12, 9.0, 1.0, 1.0);
        beam.stiffness = stiffness;
        let force: f64 = load[2..].iter().step_by(2).sum();
        let moment: f64 = (1..13).map(|i| load[2 * i] * beam.station(i) + load[2 * i + 1]).sum();
        load[0] = -force;
        load[1] = -moment;
        let u = deflect(&beam, &load);
        let mut answer = vec![0.0; u.len()];
        let mut size = 0.0_f64;
        for e in 0..beam.elements() {
            for (i, row) in beam.element_stiffness(e).iter().enumerate() {
                for (k, u) in row.iter().zip(&u[2 * e..]) {
                    answer[2 * e + i] += k * u;
                    size = size.max((k * u).abs());
                }
            }
        }
        for (value, truth) in answer.iter().zip(&load) {
            prop_assert!((value - truth).abs() <= 1e-13 * size, "{value:e} is not {truth:e}");
        }
    }
}
