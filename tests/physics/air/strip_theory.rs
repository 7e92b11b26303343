//! What the air answers to bending and to the pitch rate: sums over two strips and the elevator, by hand.

use super::made_up::{BEND, BY_HAND, HEAVE, PITCH, Powers, ROUNDING, case, cases, from, unit};
use crate::model::AERO_SETS;
use ahv::air::curve_fits::{ELASTIC_ROWS, INCIDENCE, INFLOW, LIFT, MODAL_FORCE, MOMENT};
use ahv::data::AeroSet;

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
        assert_eq!(case.elastic.pitch_rate, [0.0; ELASTIC_ROWS], "{name}: eq. (4) has no q");
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
            row if row == MODAL_FORCE + HEAVE => here.slope(LIFT),
            row if row == MODAL_FORCE + PITCH => -here.aero.chord * here.slope(MOMENT),
            row if row < MODAL_FORCE => here.slope(row),
            row => here.answer(&unit())[row],
        };
        for d in [2.5, -1.2] {
            let there = case(set, d, 1.0);
            let difference = std::array::from_fn(|row| {
                there.elastic.pitch_rate[row] - here.elastic.pitch_rate[row]
            });
            let expected: [f64; ELASTIC_ROWS] = std::array::from_fn(|row| -d * uniform(row));
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
            let mut rows: [f64; ELASTIC_ROWS] = std::array::from_fn(|row| {
                -scale * bending[row] - pitch_rate * rotation * turning[row]
            });
            rows[INCIDENCE] = -rigid.at(case.centre);
            case.assert_rows(&name, &case.elastic.per[BEND][1], &rows, BY_HAND);
        }
    }
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
