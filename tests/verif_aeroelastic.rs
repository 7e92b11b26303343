//! The derived elastic terms: a "mode" that moves the body rigidly is an incidence of the whole body and
//! nothing else; what bends it, and the pitch rate, are sums over strips and elevator, by hand.
#![allow(missing_docs)]

mod model;

use ahv::aero::{
    ANSWERS, Aero, DRAG, Elastic, FORCE, INCIDENCE, INFLOW, LIFT, MOMENT, ModalForces, PerMode,
};
use ahv::aeroelastic::{Strips, derive};
use ahv::beam::Beam;
use ahv::dynamics::{GUSTS, RIGID, Vehicle};
use ahv::factors::Factors;
use ahv::hermite::Shape;
use ahv::modes::{MODES, Modes};
use ahv::vehicle::{AeroSet, Build, Configuration, Data, structure};
use model::{AERO_SETS, assert_close, build, data, vehicle, vehicle_with};

/// Sums over 2,000 quadrature points.
const ROUNDING: f64 = 1e-12;
/// Closed integrals against sums over 500 elements, of terms a hundred times as large as what is left.
const BY_HAND: f64 = 1e-10;
/// Mass centre against the moment centre, m aft.
const SHIFTS: [f64; 3] = [0.0, 2.5, -1.2];
/// The made-up modes.
const HEAVE: usize = 0;
const PITCH: usize = 1;
const BEND: usize = 2;

/// Powers of the station, m from the nose.
#[derive(Clone)]
struct Powers(Vec<f64>);

impl Powers {
    fn times(&self, other: &Self) -> Self {
        let mut product = vec![0.0; self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (k, b) in other.0.iter().enumerate() {
                product[i + k] += a * b;
            }
        }
        Self(product)
    }

    fn minus(&self, factor: f64, other: &Self) -> Self {
        let length = self.0.len().max(other.0.len());
        let at = |powers: &[f64], i: usize| powers.get(i).copied().unwrap_or(0.0);
        Self((0..length).map(|i| at(&self.0, i) - factor * at(&other.0, i)).collect())
    }

    fn slope(&self) -> Self {
        Self((1..self.0.len()).map(|i| i as f64 * self.0[i]).chain([0.0]).collect())
    }

    fn at(&self, x: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    /// Average over an interval, or what is at a place.
    fn mean(&self, [from, to]: [f64; 2]) -> f64 {
        if from == to {
            return self.at(from);
        }
        let whole = Self([0.0].into_iter().chain(self.0.clone()).collect());
        let whole = Self(whole.0.iter().enumerate().map(|(i, c)| c / i.max(1) as f64).collect());
        (whole.at(to) - whole.at(from)) / (to - from)
    }
}

fn from(place: f64) -> Powers {
    Powers(vec![-place, 1.0])
}

fn unit() -> Powers {
    Powers(vec![1.0])
}

/// Elastic terms of three made-up modes of unit modal mass: heave, nose-down pitch about the moment
/// centre (w up, slope dw/dx = 1) and a parabola, which also moves the body.
struct Case {
    data: Data,
    aero: Aero,
    elastic: Elastic,
    shapes: [Powers; 3],
    /// Station of the mass centre.
    centre: f64,
}

fn case(set: AeroSet, shift: f64, pitch_rate: f64) -> Case {
    let data = data();
    let aero = Aero::new(data.aero(set));
    let beam = Beam::even(&data.vehicle, 1.0);
    let arm = from(aero.moment_centre);
    let square = Powers(arm.times(&arm).0.iter().map(|c| c / 100.0).collect());
    let shapes = [unit(), arm, square];
    let shape = |powers: &Powers| {
        let nodes = || (0..=beam.elements()).map(|i| beam.station(i));
        let slope = powers.slope();
        Shape {
            w: nodes().map(|x| powers.at(x)).collect(),
            slope: nodes().map(|x| slope.at(x)).collect(),
        }
    };
    let shape = shapes.iter().map(shape).collect();
    let modes = Modes { count: 3, modal_mass: [1.0; MODES], shape, ..Modes::default() };
    let centre = aero.moment_centre + shift;
    let strips = Strips::new(&beam, &modes, &data.vehicle.geometry);
    let elastic = derive(&aero, &beam, &modes, &strips, centre, pitch_rate);
    Case { data, aero, elastic, shapes, centre }
}

impl Case {
    fn slope(&self, row: usize) -> f64 {
        let aero = &self.aero;
        aero.fits.row(row).slope(aero.elastic_alpha, aero.elastic_delta_e)
    }

    /// Where each surface is and its lift slope: two strips with lift slope and moment slope of the
    /// published body, and the elevator where its lift makes the published moment.
    fn surfaces(&self) -> [([f64; 2], f64); 3] {
        let (aero, geometry) = (&self.aero, &self.data.vehicle.geometry);
        let at = aero.elastic_delta_e;
        let [elevator, elevator_moment] = [LIFT, MOMENT].map(|row| {
            let [d1, _, d3] = aero.fits.row(row).delta_e;
            d1 + 3.0 * d3 * at * at
        });
        let (lift, moment) = (self.slope(LIFT) - elevator, self.slope(MOMENT) - elevator_moment);
        let (cut, length) = (geometry.fore_body_m.value, geometry.length_m.value);
        let [x1, x2] = [0.5 * cut, 0.5 * (cut + length)].map(|x| x - aero.moment_centre);
        // Cramer's rule.
        let [fore, aft] = [lift * x2 + moment * aero.chord, -moment * aero.chord - lift * x1];
        let place = aero.moment_centre - aero.chord * elevator_moment / elevator;
        [
            ([0.0, cut], fore / (x2 - x1)),
            ([cut, length], aft / (x2 - x1)),
            ([place, place], elevator),
        ]
    }

    /// What the air answers to a field of incidence.
    fn answer(&self, field: &Powers) -> [f64; ANSWERS] {
        let surfaces = self.surfaces();
        let sum = |of: &Powers| -> f64 {
            surfaces.iter().map(|(span, slope)| slope * field.times(of).mean(*span)).sum()
        };
        let mut rows = [0.0; ANSWERS];
        rows[LIFT] = sum(&unit());
        rows[DRAG] = self.slope(DRAG) / self.slope(LIFT) * rows[LIFT];
        rows[MOMENT] = -sum(&from(self.aero.moment_centre)) / self.aero.chord;
        rows[INFLOW] = field.mean(surfaces[0].0);
        for (i, shape) in self.shapes.iter().enumerate() {
            rows[FORCE + i] = sum(shape);
        }
        rows
    }

    /// What is large where rows cancel.
    fn sizes(&self) -> [f64; ANSWERS] {
        let length = self.data.vehicle.geometry.length_m.value;
        let uniform = self.answer(&unit());
        let far = self.answer(&from(-length));
        std::array::from_fn(|row| uniform[row].abs().max(far[row].abs()).max(1.0))
    }

    fn assert_rows(
        &self,
        what: &str,
        rows: &[f64; ANSWERS],
        expected: &[f64; ANSWERS],
        limit: f64,
    ) {
        for (row, size) in self.sizes().into_iter().enumerate() {
            let off = (rows[row] - expected[row]) / size;
            assert!(off.abs() < limit, "{what}, row {row}: {rows:?}, not {expected:?}: {off:.1e}");
        }
    }
}

fn cases(pitch_rate: f64) -> impl Iterator<Item = (String, Case)> {
    AERO_SETS.into_iter().flat_map(move |set| {
        SHIFTS.map(|shift| (format!("{set:?}, {shift} m"), case(set, shift, pitch_rate)))
    })
}

#[test]
fn verif_a_rigid_motion_is_an_incidence_of_the_body_and_nothing_else() {
    for (name, case) in cases(0.0) {
        // Heave velocity, and nose-down pitch: the mass centre behind the moment centre goes up.
        let shift = case.centre - case.aero.moment_centre;
        for (mode, incidence) in [(HEAVE, [0.0, -1.0]), (PITCH, [-1.0, -shift])] {
            for (rows, incidence) in case.elastic.per[mode].iter().zip(incidence) {
                let mut expected = [0.0; ANSWERS];
                expected[INCIDENCE] = incidence;
                case.assert_rows(&name, rows, &expected, ROUNDING);
            }
        }
    }
}

#[test]
fn verif_rigid_motions_act_in_the_published_fits_as_incidence_does() {
    for set in AERO_SETS {
        let mut vehicle = vehicle_with(set, Configuration::SloshBeam);
        let shift = 0.7;
        let case = case(set, shift, 0.0);
        vehicle.airframe.elastic = case.elastic;
        // The thrust across the body goes with the incidence of the axes, not of the body.
        vehicle.airframe.elastic.force.thrust_across = [0.0; MODES];
        vehicle.airframe.stiffness = [[0.0; MODES]; MODES];
        vehicle.airframe.damping = [[0.0; MODES]; MODES];
        let mut x = build(Configuration::Rigid).condition.start(&vehicle.atmosphere);
        (x[2], x[3], x[4]) = (0.01, 0.03, 0.02);
        let (turned, up, nose_down) = (0.011, 4.0, 0.6);
        let mut moved = x;
        moved[RIGID + 2 * PITCH] = turned;
        moved[RIGID + 2 * HEAVE + 1] = up;
        moved[RIGID + 2 * PITCH + 1] = nose_down;
        let mut inclined = x;
        inclined[3] -= turned + (up + nose_down * shift) / x[0];
        let shown = [&moved, &inclined].map(|x| {
            let (rates, outputs) = vehicle.both(x, &[0.1, 0.4], [0.0; GUSTS]);
            let loads = outputs.loads;
            let arm = vehicle.airframe.mass_centre - vehicle.aero.moment_centre;
            let modal = [0, 1, 2].map(|mode| rates[RIGID + 2 * mode + 1]);
            ([loads.lift, loads.drag, loads.thrust, loads.moment - loads.normal * arm], modal)
        });
        for (a, b) in shown[0].0.into_iter().zip(shown[1].0) {
            assert_close(&format!("{set:?}: {shown:?}"), a, b, BY_HAND);
        }
        for (a, b) in shown[0].1.into_iter().zip(shown[1].1) {
            assert_close(&format!("{set:?}: {shown:?}"), a, b, BY_HAND);
        }
    }
}

#[test]
fn verif_pitch_rate_rows_are_sums_over_the_strips() {
    for part in [1.0, 0.4] {
        for (name, case) in cases(part) {
            let expected = case.answer(&from(case.centre)).map(|row| part * row);
            case.assert_rows(&name, &case.elastic.pitch_rate, &expected, ROUNDING);
            // A lifted nose raises the incidence behind the mass centre, where lift pitches it down.
            assert!(expected[MOMENT] < 0.0, "{name}: {expected:?}");
        }
    }
    for (name, case) in cases(0.0) {
        assert_eq!(case.elastic.pitch_rate, [0.0; ANSWERS], "{name}: eq. (4) has no q");
    }
}

#[test]
fn verif_pitch_rate_and_pitching_shape_are_the_same_motion() {
    // q > 0 lifts the nose: w = -(x - x_cg), so a rate of the nose-down shape is -q.
    for (name, case) in cases(1.0) {
        let expected = case.elastic.pitch_rate.map(|row| -row);
        let mut rows = case.elastic.per[PITCH][1];
        rows[INCIDENCE] = 0.0;
        case.assert_rows(&name, &rows, &expected, ROUNDING);
    }
}

#[test]
fn verif_a_mass_centre_moved_aft_meets_less_incidence_from_a_lifted_nose() {
    // By q/V times the way, everywhere: the other sign would double what is asked for here.
    for set in AERO_SETS {
        let here = case(set, 0.0, 1.0);
        let uniform = |row: usize| match row {
            INFLOW => 1.0,
            INCIDENCE => 0.0,
            row if row == FORCE + HEAVE => here.slope(LIFT),
            row if row == FORCE + PITCH => -here.aero.chord * here.slope(MOMENT),
            row if row < FORCE => here.slope(row),
            row => here.answer(&unit())[row],
        };
        for d in [2.5, -1.2] {
            let there = case(set, d, 1.0);
            let difference = std::array::from_fn(|row| {
                there.elastic.pitch_rate[row] - here.elastic.pitch_rate[row]
            });
            let expected: [f64; ANSWERS] = std::array::from_fn(|row| -d * uniform(row));
            here.assert_rows(&format!("{set:?}, {d} m"), &difference, &expected, ROUNDING);
            assert!(expected[LIFT].abs() > 4.0, "{expected:?}");
        }
    }
}

#[test]
fn verif_bending_is_what_a_shape_has_beyond_its_rigid_motion() {
    for pitch_rate in [0.0, 1.0] {
        for (name, case) in cases(pitch_rate) {
            let mass = &case.data.vehicle.mass;
            let (joint, length) =
                (mass.beam_joint_m.value, case.data.vehicle.geometry.length_m.value);
            // Integral by the density; its part ahead of the joint and behind it.
            let by_mass = |of: &Powers| {
                mass.fore_beam_kg_per_m2.value * joint * of.mean([0.0, joint])
                    + mass.aft_beam_kg_per_m2.value * (length - joint) * of.mean([joint, length])
            };
            let centre = by_mass(&from(0.0)) / by_mass(&unit());
            let arm = from(centre);
            let shape = &case.shapes[BEND];
            let translation = by_mass(shape) / by_mass(&unit());
            let rotation = by_mass(&shape.times(&arm)) / by_mass(&arm.times(&arm));
            let rigid = unit().minus(-rotation / translation, &arm);
            let rigid = Powers(rigid.0.iter().map(|c| c * translation).collect());

            let scale = case.aero.elastic_scale;
            let mut bent = case.answer(&shape.slope().minus(rotation, &unit())).map(|r| -scale * r);
            bent[INCIDENCE] = -rotation;
            case.assert_rows(&name, &case.elastic.per[BEND][0], &bent, BY_HAND);

            let bending = case.answer(&shape.minus(1.0, &rigid));
            let turning = case.answer(&from(case.centre));
            let mut rows: [f64; ANSWERS] = std::array::from_fn(|row| {
                -scale * bending[row] - pitch_rate * rotation * turning[row]
            });
            rows[INCIDENCE] = -rigid.at(case.centre);
            case.assert_rows(&name, &case.elastic.per[BEND][1], &rows, BY_HAND);
        }
    }
}

#[test]
fn verif_slope_of_a_fit_counts_the_elevator() {
    // C_D of shock_expansion has a term in alpha delta_e, as large as the slope without it.
    let drag = Aero::new(&data().shock_expansion).fits.row(DRAG);
    let (alpha, delta_e, step) = (0.03, 0.16, 1e-4);
    let quotient = (drag.at(alpha + step, delta_e) - drag.at(alpha - step, delta_e)) / (2.0 * step);
    assert!(drag.cross != 0.0);
    assert_close("dC_D/d alpha", drag.slope(alpha, delta_e), quotient, 1e-9);
}

#[test]
fn verif_loads_add_up_to_the_published_lift_and_moment() {
    let Case { aero, elastic, .. } = case(AeroSet::Parker2007, 0.0, 0.0);
    let ([heave, pitch], force) = ([HEAVE, PITCH], elastic.force);
    for power in 0..3 {
        // Work on a heave is lift; work on a nose-down pitch is minus the nose-up moment.
        let [lift, moment] =
            [aero.fits.alpha[power][LIFT], -aero.chord * aero.fits.alpha[power][MOMENT]];
        assert!((force.alpha[power][heave] - lift).abs() < ROUNDING, "lift, power {power}");
        assert!(
            (force.alpha[power][pitch] - moment).abs() < 100.0 * ROUNDING,
            "moment, power {power}"
        );
    }
    assert_close("elevator lift", force.delta_e[heave], aero.fits.delta_e[0][LIFT], ROUNDING);
    assert_close(
        "elevator moment",
        force.delta_e[pitch],
        -aero.chord * aero.fits.delta_e[0][MOMENT],
        ROUNDING,
    );
}

#[test]
fn verif_thrust_works_on_rigid_motions_as_on_the_rigid_body() {
    let Case { aero, elastic, .. } = case(AeroSet::Parker2007, 0.0, 0.0);
    let ([heave, pitch], force) = ([HEAVE, PITCH], elastic.force);
    assert_close("lift of the thrust", force.thrust_across[heave], 1.0, ROUNDING);
    assert_close("couple", force.thrust_couple[pitch], -aero.thrust_arm, ROUNDING);
    assert!(
        force.thrust_couple[heave].abs() < ROUNDING && force.thrust_across[pitch].abs() < ROUNDING
    );
}

#[test]
fn verif_liquid_at_rest_lies_on_the_floor() {
    // In steady flight every force on a sloshing mass is balanced without its spring. What is left
    // is what the modes beyond the kept ones would carry.
    for fuel_fraction in [0.0, 0.5, 1.0] {
        let build = Build { fuel_fraction, ..build(Configuration::SloshBeam) };
        let vehicle = Vehicle::new(&data(), &build).unwrap();
        let trim = ahv::trim::trim(&vehicle, &build.condition).unwrap();
        let slosh = vehicle.both(&trim.state, &trim.control, [0.0; GUSTS]).1.slosh;
        assert!(slosh.iter().all(|s| s.abs() < 2e-3), "fuel {fuel_fraction}: {slosh:?} m");
    }
}

#[test]
fn verif_the_air_damps_every_mode() {
    // Every surface has a positive lift slope, so by strip theory alone (pitch rate included, bending not
    // scaled) the matrix mu_i N_rate is negative: no flutter from quasi-steady damping.
    let data = data();
    for set in AERO_SETS {
        for configuration in [Configuration::EvenMassBeam, Configuration::SloshBeam] {
            let elastic = 1.0 / data.aero(set).reference.elastic_scale.value;
            let factors = Factors { pitch_rate: 1.0, elastic, ..Factors::default() };
            let build = Build { aero: set, factors, ..build(configuration) };
            let vehicle = Vehicle::new(&data, &build).unwrap();
            let (beam, oscillators) = structure(&data, &build).unwrap();
            let mass = Modes::solve(&beam, &oscillators).unwrap().modal_mass;
            let whole = whole_rates(&vehicle);
            let damping = nalgebra::DMatrix::from_fn(vehicle.modes, vehicle.modes, |i, k| {
                0.5 * (whole[k][i] * mass[i] + whole[i][k] * mass[k])
            });
            let eigenvalues = damping.symmetric_eigenvalues();
            // Three surfaces make a semidefinite matrix of any rank; rounding may lift a zero.
            let name = format!("{set:?} {configuration:?}: {eigenvalues}");
            assert!(eigenvalues.max() < 1e-12 * -eigenvalues.min(), "{name}");
        }
    }
}

/// What the rate of each mode does to the force on each, rigid part included.
fn whole_rates(vehicle: &Vehicle) -> [PerMode; MODES] {
    let Elastic { per, force: ModalForces { alpha, .. }, .. } = vehicle.airframe.elastic;
    per.map(|[_, rate]| {
        std::array::from_fn(|i| {
            let slope = alpha[1][i] + 2.0 * alpha[2][i] * vehicle.aero.elastic_alpha;
            rate[FORCE + i] + rate[INCIDENCE] * slope
        })
    })
}

#[test]
fn verif_two_strips_are_plausible() {
    // The fore-body carries more of the lift slope than the rest; both push the right way, as
    // tangent-wedge theory demands (0.9 per rad of fore-body area at Mach 8).
    let case = case(AeroSet::Parker2007, 0.0, 1.0);
    let [(span, first), (_, second), _] = case.surfaces();
    let per_area = first * case.aero.area / (span[1] - span[0]);
    assert!((0.7..1.2).contains(&per_area), "{per_area} per rad");
    assert!(second > 0.0 && first > second, "{first} and {second}");
}

#[test]
fn verif_the_full_build_scales_inertia_with_fuel() {
    let full = vehicle(Configuration::SloshBeam);
    let build = Build { fuel_fraction: 0.0, ..build(Configuration::SloshBeam) };
    let empty = Vehicle::new(&data(), &build).unwrap();
    let dry = 1.0 - data().vehicle.mass.propellant_fraction.value;
    assert!(
        empty.airframe.mass < 0.36 * full.airframe.mass
            && empty.airframe.mass > dry * full.airframe.mass
    );
    assert!(
        empty.airframe.inertia < 0.6 * full.airframe.inertia
            && empty.airframe.inertia > 0.3 * full.airframe.inertia
    );
    let of_set = data().xu2015.inertia.i_yy_kg_m2_per_m.value;
    // A sum of what the densities give and what the body takes beyond.
    assert_close("full", full.airframe.inertia, of_set, ROUNDING);
}
