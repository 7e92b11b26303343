//! The response in closed form, without limits and with each of them.

#[path = "../../fmi/tests/flight/mod.rs"]
mod flight;

use ahv_actuator::Actuator;
use ahv_actuator::response::{Motion, Ramp};
use flight::{get, input, set, started, step_to, y};
use fmi_model::instance::Instance;

const ROUNDING: f64 = 4e-15;

fn assert_near(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(error <= ROUNDING * expected.abs().max(1.0), "{found} for {expected}: {error:e}");
}

/// Bandwidth 50 rad/s, position 0.125, rate -1 / s, command 0.5 + 2 t: damping ratio, time (s), position and rate of a
/// matrix exponential with 60 digits.
#[rustfmt::skip]
#[expect(clippy::excessive_precision, reason = "all digits of the reference")]
const RESPONSES: [(f64, f64, f64, f64); 27] = [
    (0.01, 0.0001, 0.12490469358377878936, -0.9061175846933041923),
    (0.01, 0.01, 0.16203474640180502319, 8.3200098439529903991),
    (0.01, 0.3, 1.3080108535696062705, 14.458987398371661092),
    (0.7, 0.0001, 0.12490502700372291204, -0.89956480939615455015),
    (0.7, 0.01, 0.15567220026436796006, 6.2448044434333167245),
    (0.7, 0.3, 1.0440129443507128725, 1.999354885404406464),
    (0.999999, 0.0001, 0.12490517148711057853, -0.89673008948439439104),
    (0.999999, 0.01, 0.15341427037574237589, 5.5633697170794560083),
    (0.999999, 0.3, 1.0199983609466055713, 2.0000805240964424351),
    (0.999999999999, 0.0001, 0.12490517148759170597, -0.89673008004970581431),
    (0.999999999999, 0.01, 0.15341426328578779831, 5.5633676258138126595),
    (0.999999999999, 0.3, 1.0199982808290388734, 2.0000805287858674163),
    (1.0, 0.0001, 0.12490517148759170645, -0.89673008004969637982),
    (1.0, 0.01, 0.15341426328578070851, 5.5633676258117214386),
    (1.0, 0.3, 1.0199982808289587575, 2.0000805287858721057),
    (1.000000000001, 0.0001, 0.12490517148759170693, -0.89673008004968694429),
    (1.000000000001, 0.01, 0.15341426328577361791, 5.5633676258096299856),
    (1.000000000001, 0.3, 1.0199982808288786328, 2.0000805287858767956),
    (1.000001, 0.0001, 0.12490517148807283437, -0.89673007061499846556),
    (1.000001, 0.01, 0.15341425619582181552, 5.563365534545115185),
    (1.000001, 0.3, 1.0199982007113085697, 2.0000805334754075816),
    (3.0, 0.0001, 0.12490612731423432995, -0.87805120612821947848),
    (3.0, 0.01, 0.14340322626665936183, 2.9462510407760270769),
    (3.0, 0.3, 0.84858363407280409653, 2.0979369363539312379),
    (100.0, 0.0001, 0.12494023772690013135, -0.30859338173347260592),
    (100.0, 0.01, 0.12585173028580031977, 0.098489528478258406004),
    (100.0, 0.3, 0.17392934636595793712, 0.23147344913935462984),
];

#[test]
fn verif_no_digits_are_lost_near_critical_damping() {
    for (damping, t, position, rate) in RESPONSES {
        let actuator = Actuator {
            damping,
            rate_limit: 1e9,
            position_min: -1e9,
            position_max: 1e9,
            ..Actuator::DEFAULT
        };
        let start = Motion { position: 0.125, rate: -1.0 };
        let end = actuator.advance(start, Ramp { value: 0.5, slope: 2.0 }, t).unwrap();
        assert_near(end.position, position);
        // A rate is 50 times as large as a position.
        assert_near(end.rate / 50.0, rate / 50.0);
    }
}

fn actuator(values: &[(&str, f64)]) -> Instance<Actuator> {
    started(values)
}

const FIRST_ORDER: (&str, f64) = ("kind", 2.0);

#[test]
fn verif_a_first_order_actuator_lags() {
    let mut lag = actuator(&[FIRST_ORDER, ("bandwidth", 10.0), ("rate_limit", 1e3), ("u", 0.5)]);
    step_to(&mut lag, 0.2);
    assert_near(y(&mut lag), 0.5 * (1.0 - (-2.0_f64).exp()));
    assert_near(get(&mut lag, "rate"), 5.0 * (-2.0_f64).exp());
}

/// At the limit until the rate of the lag is the limit, at 0.8.
#[test]
fn verif_the_rate_limit_holds_until_the_lag_asks_for_less() {
    for steps in [1, 2, 7, 100] {
        let mut lag =
            actuator(&[FIRST_ORDER, ("bandwidth", 10.0), ("rate_limit", 2.0), ("u", 1.0)]);
        for i in 1..=steps {
            step_to(&mut lag, 0.3 * f64::from(i) / f64::from(steps));
        }
        assert_near(y(&mut lag), 0.6);
        assert_eq!(get(&mut lag, "rate"), 2.0);
        for i in 1..=steps {
            step_to(&mut lag, 0.3 + 0.2 * f64::from(i) / f64::from(steps));
        }
        assert_near(y(&mut lag), 1.0 - 0.2 * (-1.0_f64).exp());
    }
}

/// 2 (1 - exp(-10 t)) is 1 at ln 2 / 10; back at 1 the command leads the way.
#[test]
fn verif_a_stop_holds_until_the_command_turns_back() {
    let free = [FIRST_ORDER, ("bandwidth", 10.0), ("rate_limit", 1e3), ("u", 2.0)];
    let mut lag = actuator(&free);
    step_to(&mut lag, 0.06);
    assert_near(y(&mut lag), 2.0 * (1.0 - (-0.6_f64).exp()));
    step_to(&mut lag, 0.07);
    assert_eq!((y(&mut lag), get(&mut lag, "rate")), (1.0, 0.0));
    // From 2 to 0 within 0.5 s: it leaves the stop after 0.25 s, and follows a ramp of -4 / s.
    input(&mut lag, 2.0, -4.0);
    step_to(&mut lag, 0.57);
    assert_near(y(&mut lag), 1.0 - 4.0 * (0.25 - 0.1 * (1.0 - (-2.5_f64).exp())));
}

/// From rest to the rate limit in the time in which omega exp(-zeta omega t) sin(omega_d t) / sqrt(1 - zeta^2) gets there.
#[test]
fn verif_a_second_order_actuator_is_as_fast_as_its_limit_and_no_faster() {
    let mut limited =
        actuator(&[("bandwidth", 10.0), ("damping", 0.6), ("u", 0.8), ("rate_limit", 1.0)]);
    step_to(&mut limited, 0.016);
    let rate = 0.8 * 10.0 / 0.8 * (-6.0_f64 * 0.016).exp() * (8.0_f64 * 0.016).sin();
    assert!(rate > 1.0, "it is at its limit by then");
    assert_eq!(get(&mut limited, "rate"), 1.0);
    let before = y(&mut limited);
    step_to(&mut limited, 0.416);
    assert_near(y(&mut limited), before + 0.4);
    // It is held until 10 (0.8 - y) = 2 * 0.6 * 1: to y = 0.68.
    let free = 0.68 - y(&mut limited);
    step_to(&mut limited, 0.416 + free);
    assert_near(y(&mut limited), 0.68);
    let mut expected = Motion { position: 0.68, rate: 1.0 };
    let unlimited =
        Actuator { bandwidth: 10.0, damping: 0.6, rate_limit: 1e9, ..Actuator::DEFAULT };
    expected = unlimited.advance(expected, Ramp { value: 0.8, slope: 0.0 }, 0.1).unwrap();
    step_to(&mut limited, 0.516 + free);
    assert_near(y(&mut limited), expected.position);
}

#[test]
fn an_actuator_that_overshoots_into_its_stop_loses_its_speed() {
    let mut ringing = actuator(&[("damping", 0.1), ("rate_limit", 1e3), ("u", 0.9)]);
    // The first overshoot is to 1.55.
    let ends = (1..=400).map(|i| 0.001 * f64::from(i));
    let positions: Vec<f64> = ends
        .map(|end| {
            step_to(&mut ringing, end);
            y(&mut ringing)
        })
        .collect();
    let highest = positions.iter().copied().fold(0.0, f64::max);
    assert!(highest > 0.97 && highest <= 1.0, "{highest}");
    // From rest at the stop it swings about 0.9 with an amplitude of 0.1.
    let lowest = positions[60..].iter().copied().fold(1.0, f64::min);
    let overshoot = (-0.1 * std::f64::consts::PI / (1.0_f64 - 0.01).sqrt()).exp();
    assert!((lowest - (0.9 - 0.1 * overshoot)).abs() < 1e-4, "{lowest}");
}

#[test]
fn a_command_that_is_at_the_stop_but_for_rounding_pushes_as_it_moves() {
    for (kind, side) in [(1.0, 1.0), (2.0, 1.0), (1.0, -1.0), (2.0, -1.0)] {
        for slope in (1..100).map(|i| 0.07 * f64::from(i)) {
            let mut stopped = actuator(&[("kind", kind), ("y0", side), ("rate_limit", 1e3)]);
            input(&mut stopped, side * (1.0 - 0.5 * f64::EPSILON), side * slope);
            step_to(&mut stopped, 0.1);
            assert_eq!((y(&mut stopped), get(&mut stopped, "rate")), (side, 0.0), "{kind} {slope}");
        }
    }
}

/// Below its limit for so short a time that it moves by less than rounding.
#[test]
fn verif_a_limit_that_is_left_for_a_moment_holds() {
    for (kind, lag) in [(1.0, 0.028), (2.0, 0.02)] {
        for (side, digits) in
            [1.0, -1.0].into_iter().flat_map(|side| (6..17).map(move |n| (side, n)))
        {
            let lead = -0.1_f64.powi(digits);
            let scene = format!("kind {kind}, side {side}, lead {lead:e}");
            let mut fast = actuator(&[
                ("kind", kind),
                ("position_max", 10.0),
                ("position_min", -10.0),
                ("u", 5.0 * side),
            ]);
            step_to(&mut fast, 0.1);
            let before = side * y(&mut fast);
            input(&mut fast, side * (before + lag * 2.0 + lead), side * 4.0);
            step_to(&mut fast, 0.6);
            let (position, rate) = (side * y(&mut fast), side * get(&mut fast, "rate"));
            assert!(
                (position - before - 1.0).abs() < 1e-10 && rate == 2.0,
                "{scene}: {position}, {rate}"
            );

            // It is back there after two or three of these times.
            for length in [4.0, 1e3, 0.5 / -lead] {
                let mut stopped = actuator(&[("kind", kind), ("y0", side), ("rate_limit", 1e3)]);
                input(&mut stopped, side * (1.0 + lead), side * 4.0);
                step_to(&mut stopped, -lead / 4.0 * length);
                let (position, rate) = (y(&mut stopped), get(&mut stopped, "rate"));
                assert_eq!((position, rate), (side, 0.0), "{scene}, length {length}");
            }
        }
    }
}

#[test]
fn a_resting_actuator_stays_at_rest_with_the_same_bits() {
    for kind in [1.0, 2.0] {
        let mut resting = actuator(&[("kind", kind), ("y0", 0.3), ("u", 0.3)]);
        for end in [0.01, 1.0, 100.0, 1e9] {
            step_to(&mut resting, end);
            assert_eq!((y(&mut resting), get(&mut resting, "rate")), (0.3, 0.0));
        }
    }
}

#[test]
fn the_output_does_not_depend_on_the_input_of_the_instant() {
    let mut moving = actuator(&[("u", 0.3)]);
    step_to(&mut moving, 0.01);
    let before = (y(&mut moving), get(&mut moving, "rate"));
    set(&mut moving, &[("u", -1.0)]).unwrap();
    assert_eq!((y(&mut moving), get(&mut moving, "rate")), before);
}
