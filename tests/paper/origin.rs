//! Where the printed digits come from, and what no vehicle under eqs (3)-(4) can have.

use super::printed::{
    FLEXIBLE, INERTIA, Seen, ends, floats, moved, pairs, printed, published, real_parts, seen, size,
};
use crate::model::{AERO_SETS, assert_close, data, deviation, options};
use ahv::data::AeroSet::{Parker2007, Xu2015};
use ahv::vehicle::{Configuration, H, V, Vehicle, VehicleDefinition, VehicleOptions};

/// "about 1 %": the published fits with the inertia that the paper's short period asks for.
const RIGID_COLUMN: f64 = 0.012;

/// 55 ft, m.
const PRINTED_MASS_CENTRE: f64 = 16.764;

#[test]
fn paper_table2_rigid_short_period_asks_for_an_inertia_that_is_not_printed() {
    let printed = printed("rigid");
    let rigid = moved(Configuration::Rigid, INERTIA, 1.0, 0.0);
    assert_close("mass centre", rigid.vehicle.airframe.mass_centre, PRINTED_MASS_CENTRE, 1e-4);
    let found = ends(&rigid.linear.poles());
    assert_close("unstable pole", found[0], printed.short_period[0], RIGID_COLUMN);
    assert_close("stable pole", found[1], printed.short_period[1], RIGID_COLUMN);
    let zeros = size(ends(&rigid.linear.zeros()));
    assert_close("geometric mean of the zeros", zeros, size(printed.zeros), RIGID_COLUMN);
    for inertia in [2.224e5, data().parker2007.inertia.i_yy_kg_m2_per_m.value] {
        let poles = ends(&moved(Configuration::Rigid, inertia, 1.0, 0.0).linear.poles());
        assert!(deviation(poles[0], printed.short_period[0], 1.0) > 0.4, "{inertia}");
    }
}

/// Rigid vehicles of all sets, also with coefficients that no set has.
fn rigid_vehicles() -> impl Iterator<Item = Seen> {
    // Lift, drag, moment by incidence, elevator, thrust.
    let factors = [
        [1.0, 1.0, 1.0, 1.0, 1.0],
        [1.3, 0.8, 1.2, 1.1, 1.2],
        [0.8, 1.2, 0.7, 1.2, 1.4],
        [1.1, 0.7, 1.6, 1.5, 0.9],
    ];
    AERO_SETS.into_iter().flat_map(move |aero| {
        factors.map(|[lift, drag, moment_alpha, elevator, thrust]| {
            let mut options = VehicleOptions { aero, ..options(Configuration::Rigid) };
            let own = options.factors;
            options.factors = ahv::vehicle::Factors {
                lift,
                drag,
                moment_alpha,
                elevator,
                thrust,
                inertia: 2.0 - lift,
                ..own
            };
            Seen::new(VehicleDefinition::new(&data(), &options))
        })
    })
}

#[test]
fn paper_table3_rigid_zeros_cannot_be_unequal() {
    // Eqs (3)-(4) of a rigid body have no q-dependence: its zeros are 0 and an exact +- pair, for
    // any coefficients, as long as the output is the gamma of (3).
    for Seen { linear, .. } in rigid_vehicles() {
        let zeros = linear.zeros();
        assert_eq!(zeros.len(), 3);
        let sum: f64 = zeros.iter().map(|zero| zero.re).sum();
        let largest = zeros[2].norm();
        assert!(sum.abs() < 1e-11 * largest, "{zeros:?}");
        assert!(zeros[0].norm() < 1e-11 * largest, "{zeros:?}");
    }
}

/// Part of theta in the output, or of q in the equation of gamma, s.
const OUTPUT: f64 = 0.0044;

#[test]
fn paper_table3_a_q_term_in_lift_or_theta_in_the_output_makes_rigid_zeros_unequal() {
    let printed = printed("rigid");
    let Seen { vehicle, trim, linear } = moved(Configuration::Rigid, INERTIA, 1.0, 0.0);
    let assert_zeros = |what: &str, found: [f64; 2]| {
        found.into_iter().zip(printed.zeros).for_each(|(f, p)| assert_close(what, f, p, 0.005));
    };

    let mut output = linear.clone();
    output.c[(1, 2)] -= OUTPUT;
    output.c[(1, 3)] -= OUTPUT;
    assert_zeros("output", ends(&output.zeros()));

    let mut lift = linear.clone();
    lift.a[(2, 4)] -= OUTPUT;
    lift.a[(3, 4)] += OUTPUT;
    assert_zeros("lift", ends(&lift.zeros()));
    for (found, printed) in ends(&lift.poles()).into_iter().zip(printed.short_period) {
        assert_close("short period with lift by q", found, printed, RIGID_COLUMN + 0.003);
    }
    // As a coefficient: gamma' = C_Lq (cbar q/2V) qbar S/(m V).
    let (speed, height) = (trim.state[V], trim.state[H]);
    let pressure = 0.5 * vehicle.atmosphere.air(height).density * speed * speed;
    let reference = &data().parker2007.reference;
    let force = pressure * reference.area_m2_per_m.value * reference.chord_m.value;
    let coefficient = -OUTPUT * 2.0 * vehicle.airframe.mass * speed * speed / force;
    assert_close("C_Lq", coefficient, -270.0, 0.01);

    let mut damped = linear;
    damped.a[(4, 4)] -= 1.79;
    assert_zeros("pitch damping", ends(&damped.zeros()));
    let [unstable, _] = ends(&damped.poles());
    assert!(deviation(unstable, printed.short_period[0], 1.0) > 0.2, "{unstable}");
}

#[test]
fn paper_table2_phugoid_cannot_be_printed_as_it_is() {
    // Level flight in an exponential atmosphere oscillates with sqrt(g (1 - V^2/(g r))/h_s): about
    // 0.037 rad/s at Mach 8, not 0.0238. No coefficient of the air is in it.
    let printed = floats(&published()["table2"]["rigid"]["long_term"])[1];
    for Seen { vehicle, linear, .. } in rigid_vehicles() {
        let poles = linear.poles();
        let phugoid = poles.iter().find(|pole| pole.im > 0.0).unwrap().im;
        let (h, v) = (25_900.0, 8.0 * vehicle.atmosphere.air(25_900.0).sound_speed);
        let (gravity, distance) = vehicle.atmosphere.gravity(h);
        let step = 10.0;
        let density = |h: f64| vehicle.atmosphere.air(h).density;
        let scale_height = 2.0 * step * density(h) / (density(h - step) - density(h + step));
        let expected = ((gravity - v * v / distance) / scale_height).sqrt();
        assert_close("phugoid", phugoid, expected, 0.03);
        assert!(deviation(printed, phugoid, 1.0e-9) > 0.3);
    }
}

#[test]
fn paper_table2_rigid_height_pole_must_be_zero() {
    // All forces of eq. (4) go with dynamic pressure, so there is a line of steady flights.
    let printed = published()["table2"]["rigid"]["height"].as_float().unwrap();
    for Seen { linear, .. } in rigid_vehicles() {
        let poles = linear.poles();
        assert!(poles[0].norm() < 1e-4 * printed.abs(), "{}", poles[0]);
    }
}

fn product(pair: [f64; 2]) -> f64 {
    -pair[0] * pair[1]
}

#[test]
fn paper_table2_the_jump_from_rigid_to_even_is_a_mass_centre_further_aft() {
    let even = Configuration::EvenMassBeam;
    let [rigid_printed, even_printed] = ["rigid", "even"].map(printed);
    // The product of the poles doubles, that of the zeros stays.
    let jump = product(even_printed.short_period) / product(rigid_printed.short_period);
    assert!(
        jump > 2.0
            && deviation(product(even_printed.zeros), product(rigid_printed.zeros), 1.0) < 0.06
    );
    let products = |seen: Seen| {
        let linear = seen.linear;
        (product(ends(&linear.poles())), product(ends(&linear.zeros())))
    };
    // An inertia scales both alike.
    let (poles, zeros) = products(moved(Configuration::Rigid, INERTIA, 1.0, 0.0));
    let (half_poles, half_zeros) = products(moved(Configuration::Rigid, 0.5 * INERTIA, 1.0, 0.0));
    assert_close("both alike", half_poles / poles, half_zeros / zeros, 0.01);
    // Elastic terms of any size do not reach it.
    for scale in [1.0, 2.0, 5.0, 10.0, 20.0] {
        let [unstable, _] = ends(&moved(even, INERTIA, scale, 0.0).linear.poles());
        assert!(unstable < 3.3, "elastic terms times {scale}: {unstable}");
    }
    // A mass centre further aft does, at the same inertia, and hardly moves the zeros.
    let (poles, zeros) = products(moved(even, INERTIA, 1.0, 0.0));
    let (aft_poles, aft_zeros) = products(moved(even, INERTIA, 1.0, 2.75));
    assert!(aft_poles / poles > 1.9, "{poles} to {aft_poles}");
    assert_close("zeros", aft_zeros, zeros, 0.09);
    for (found, printed) in
        [(aft_poles, even_printed.short_period), (aft_zeros, even_printed.zeros)]
    {
        assert_close("product", found, product(printed), 0.06);
    }
}

#[test]
fn paper_table3_zeros_are_those_of_the_gamma_of_the_body() {
    // The poles of the even column stand on the frequencies without air, to every printed digit; its
    // zeros stand a fifth and more above them.
    let without_air = floats(&published()["table1"]["even"]);
    let even = printed("even");
    for (mode, omega) in without_air.into_iter().enumerate() {
        assert_close("pole", even.poles[mode][1], omega, 1e-4);
        assert!(even.pairs[mode][1] > 1.2 * omega);
    }
    // Those of the mean axes stand near their poles; those of the body go where they are printed.
    for (column, configuration) in FLEXIBLE {
        let seen = seen(Xu2015, configuration);
        let poles = pairs(&seen.linear.poles());
        let [mean, body] = [seen.mean_axes(), seen.linear].map(|linear| pairs(&linear.zeros()));
        let printed = printed(column);
        for (mode, pole) in poles.iter().enumerate() {
            let what = format!("{column}, mode {}", mode + 1);
            assert_close(&what, mean[mode].im, pole.im, 0.05);
            let near = |zero: f64| deviation(zero, printed.pairs[mode][1], 1.0);
            // In the slosh column the first printed zero is below its pole.
            if (column, mode) != ("slosh", 0) {
                assert!(near(body[mode].im) < near(mean[mode].im), "{what}");
            }
        }
    }
    // Nothing identified is needed for the first: the published set at the mass centre.
    let published = seen(Parker2007, Configuration::EvenMassBeam);
    let first =
        |zeros: Vec<nalgebra::Complex<f64>>| zeros.iter().map(|z| z.im).find(|im| *im > 15.0);
    assert!(first(published.mean_axes().zeros()).unwrap() < 20.0);
    assert!(first(published.linear.zeros()).unwrap() > 22.0);
}

#[test]
fn paper_claim_b_rests_on_how_the_inertia_falls() {
    // As that of the densities, the unstable pole moves to the right, and much; held, to the left.
    let data = data();
    let at =
        |fuel_fraction: f64| VehicleOptions { fuel_fraction, ..options(Configuration::SloshBeam) };
    let pole = |options: &VehicleOptions| {
        let linear = Seen::new(VehicleDefinition::new(&data, options)).linear;
        real_parts(&linear.poles())[0]
    };
    let inertia = |options: &VehicleOptions| Vehicle::new(&data, options).unwrap().airframe.inertia;
    let (full, empty) = (at(1.0), at(0.0));
    let mut held = empty;
    held.factors.inertia *= inertia(&full) / inertia(&empty);
    assert_close("held", inertia(&held), inertia(&full), 1e-9);
    assert!(pole(&empty) > 1.2 * pole(&full));
    assert!(pole(&held) < pole(&full));
}
