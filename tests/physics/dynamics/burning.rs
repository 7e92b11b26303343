//! Free vibration while fuel burns, without air, against the whole structure in a basis that stays.

use crate::model::{data, options};
use ahv::structure::{Beam, MODES, Modes, Oscillator};
use ahv::vehicle::{Configuration, Vehicle, VehicleOptions, structure};
use nalgebra::{DMatrix, DVector};

/// Share of full tanks burnt per second: three hundred times what the engine takes.
const BURN_PER_S: f64 = 0.05;
const DURATION_S: f64 = 4.0;
/// The third mode turns by a tenth of a radian, and RK4 loses 1e-5 of its amplitude.
const STEP_S: f64 = 1e-3;
/// Levels whose modes are in the basis that stays.
const BASIS: [f64; 4] = [1.0, 0.93, 0.86, 0.8];
/// A vector of which orthogonalisation leaves less than this, relative, adds nothing.
const NOTHING_LEFT: f64 = 1e-5;
/// Of the vibration's amplitude. What is left are the modes that are not kept and terms of second
/// order, at three hundred times the real flow.
const WITH_TURNING: f64 = 6e-4;
/// Without the turning of the modes the error is larger by far.
const WITHOUT_TURNING: f64 = 1e-2;

fn mass_times(beam: &Beam, oscillators: &[Oscillator], v: &[f64]) -> Vec<f64> {
    let n = beam.unknowns();
    let mut product = vec![0.0; v.len()];
    beam.mass_times(&v[..n], &mut product[..n]);
    for (j, o) in oscillators.iter().enumerate() {
        product[n + j] = o.mass * v[n + j];
    }
    product
}

fn stiffness_times(beam: &Beam, oscillators: &[Oscillator], v: &[f64]) -> Vec<f64> {
    let n = beam.unknowns();
    let mut product = vec![0.0; v.len()];
    for element in 0..beam.elements() {
        for (i, row) in beam.element_stiffness(element).iter().enumerate() {
            let local = &v[2 * element..2 * element + 4];
            product[2 * element + i] += row.iter().zip(local).map(|(k, v)| k * v).sum::<f64>();
        }
    }
    for (j, o) in oscillators.iter().enumerate() {
        let force = o.stiffness * (v[n + j] - v[2 * o.node]);
        product[n + j] += force;
        product[2 * o.node] -= force;
    }
    product
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn matrix(left: &[Vec<f64>], right: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(left.len(), right.len(), |i, k| dot(&left[i], &right[k]))
}

/// Structure and modes at a level.
fn level(fuel_fraction: f64) -> (Beam, Vec<Oscillator>, Modes) {
    let options = VehicleOptions { fuel_fraction, ..options(Configuration::SloshBeam) };
    let (beam, oscillators) = structure(&data(), &options).unwrap();
    let modes = Modes::solve(&beam, &oscillators).unwrap();
    (beam, oscillators, modes)
}

/// Heave, pitch and the modes of several levels, orthonormal in the mass of the start.
fn lasting_basis() -> Vec<Vec<f64>> {
    let (beam, oscillators, _) = level(1.0);
    let rigid = |w: &dyn Fn(f64) -> f64, slope: f64| -> Vec<f64> {
        let nodes = (0..=beam.elements()).flat_map(|node| [w(beam.station(node)), slope]);
        nodes.chain(oscillators.iter().map(|o| w(beam.station(o.node)))).collect()
    };
    let mut candidates = vec![rigid(&|_| 1.0, 0.0), rigid(&|x| x, 1.0)];
    for fuel_fraction in BASIS {
        let (_, oscillators, modes) = level(fuel_fraction);
        candidates.extend(modes.displacements(&oscillators));
    }
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut vector in candidates {
        let norm = |v: &[f64]| dot(v, &mass_times(&beam, &oscillators, v)).sqrt();
        let before = norm(&vector);
        for _ in 0..2 {
            for known in &basis {
                let along = dot(known, &mass_times(&beam, &oscillators, &vector));
                vector.iter_mut().zip(known).for_each(|(v, known)| *v -= along * known);
            }
        }
        let left = norm(&vector);
        if left > NOTHING_LEFT * before {
            vector.iter_mut().for_each(|v| *v /= left);
            basis.push(vector);
        }
    }
    basis
}

/// Integrates `x'' = acceleration(half step, x, x')` by RK4.
fn vibrate<const N: usize>(
    mut x: [DVector<f64>; 2],
    acceleration: impl Fn(usize, &[DVector<f64>; 2]) -> DVector<f64>,
    keep: [usize; N],
) -> [[DVector<f64>; 2]; N] {
    let mut kept = std::array::from_fn(|_| x.clone());
    for step in 0..steps() {
        let rates = |half: usize, x: &[DVector<f64>; 2]| [x[1].clone(), acceleration(half, x)];
        let moved = |k: &[DVector<f64>; 2], h: f64| [0, 1].map(|i| &x[i] + &k[i] * h);
        let a = rates(2 * step, &x);
        let b = rates(2 * step + 1, &moved(&a, 0.5 * STEP_S));
        let c = rates(2 * step + 1, &moved(&b, 0.5 * STEP_S));
        let d = rates(2 * step + 2, &moved(&c, STEP_S));
        x = [0, 1].map(|i| &x[i] + (&a[i] + (&b[i] + &c[i]) * 2.0 + &d[i]) * (STEP_S / 6.0));
        for (at, kept) in keep.into_iter().zip(&mut kept) {
            if at == step + 1 {
                *kept = x.clone();
            }
        }
    }
    kept
}

fn steps() -> usize {
    (DURATION_S / STEP_S).round() as usize
}

fn fraction(half_step: usize) -> f64 {
    1.0 - BURN_PER_S * 0.5 * STEP_S * half_step as f64
}

#[test]
fn verif_modes_that_turn_vibrate_as_the_whole_structure_does() {
    let options = VehicleOptions { fuel_burn: true, ..options(Configuration::SloshBeam) };
    let vehicle = Vehicle::new(&data(), &options).unwrap();
    let burn = vehicle.fuel_table.as_ref().unwrap();
    let start = [0.3, 0.05, 0.01, 0.4, -0.3];

    // The whole structure: mass and springs change, the basis does not.
    let basis = lasting_basis();
    let (beam, oscillators, modes) = level(1.0);
    let load = |v: &Vec<f64>| mass_times(&beam, &oscillators, v);
    let momenta: Vec<_> = basis.iter().map(load).collect();
    let shapes = modes.displacements(&oscillators);
    let x = matrix(&momenta, &shapes) * DVector::from_column_slice(&start);
    let operators: Vec<DMatrix<f64>> = (0..=2 * steps())
        .map(|half| {
            let level = VehicleOptions { fuel_fraction: fraction(half), ..options };
            let (beam, oscillators) = structure(&data(), &level).unwrap();
            let [mass, stiffness] = [mass_times, stiffness_times].map(|times| {
                let products: Vec<_> =
                    basis.iter().map(|v| times(&beam, &oscillators, v)).collect();
                matrix(&basis, &products)
            });
            mass.cholesky().unwrap().solve(&stiffness)
        })
        .collect();
    let rest = DVector::zeros(basis.len());
    let keep: [usize; 8] = std::array::from_fn(|i| (i + 1) * steps() / 8);
    let whole = vibrate([x, rest], |half, x| -(&operators[half] * &x[0]), keep);

    // Five modes that turn, and the same as if they did not.
    let flow = -vehicle.fuel * BURN_PER_S;
    let [turning, fixed] = [2.0 * flow, 0.0].map(|factor| {
        let airframes: Vec<_> =
            (0..=2 * steps()).map(|half| burn.airframe(vehicle.fuel * fraction(half))).collect();
        let start = [DVector::from_column_slice(&start), DVector::zeros(MODES)];
        let acceleration = |half: usize, x: &[DVector<f64>; 2]| {
            let airframe = &airframes[half];
            DVector::from_fn(MODES, |i, _| {
                let terms = (0..MODES).map(|k| {
                    airframe.stiffness[i][k] * x[0][k] + factor * airframe.turning[i][k] * x[1][k]
                });
                -terms.sum::<f64>()
            })
        };
        vibrate(start, acceleration, keep)
    });

    let (mut with, mut without) = (0.0_f64, 0.0_f64);
    for (n, at) in keep.into_iter().enumerate() {
        let (beam, others, modes) = level(fraction(2 * at));
        let reference = level(1.0);
        let modes = modes.aligned_to(&beam, &others, (&reference.2, &reference.1)).unwrap();
        let displacement = basis.iter().zip(whole[n][0].iter()).fold(
            vec![0.0; basis[0].len()],
            |mut sum, (v, factor)| {
                sum.iter_mut().zip(v).for_each(|(sum, v)| *sum += factor * v);
                sum
            },
        );
        let eta = modes.products(&beam, &others, &[displacement]).map(|row| row[0]);
        for i in 0..MODES {
            let size = start[i].abs();
            with = with.max((turning[n][0][i] - eta[i]).abs() / size);
            without = without.max((fixed[n][0][i] - eta[i]).abs() / size);
        }
    }
    assert!(with < WITH_TURNING, "{with:.1e}");
    assert!(without > WITHOUT_TURNING, "{without:.1e}");
}
