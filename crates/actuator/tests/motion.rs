//! The motion between and at the limits, against closed forms and a crude integrator.

use ahv_actuator::response::{Motion, Ramp};
use ahv_actuator::{Actuator, Order};
use proptest::prelude::*;

/// A crude integrator of the limited actuator: the classical Runge-Kutta method with many small steps, and limits imposed
/// after each.
fn crude(actuator: &Actuator, mut motion: Motion, command: Ramp, h: f64, steps: u32) -> Motion {
    let Actuator { bandwidth: w, damping, rate_limit, position_min, position_max, .. } = *actuator;
    let dt = h / f64::from(steps);
    let limited = |v: f64| v.clamp(-rate_limit, rate_limit);
    let slope = |t: f64, [p, v]: [f64; 2]| {
        let u = command.value + command.slope * t;
        match actuator.kind {
            Order::Second => {
                let a = w * w * (u - p) - 2.0 * damping * w * v;
                let held = (v >= rate_limit && a > 0.0) || (v <= -rate_limit && a < 0.0);
                [limited(v), if held { 0.0 } else { a }]
            }
            Order::First => [limited(w * (u - p)), 0.0],
        }
    };
    let mut x = [motion.position, motion.rate];
    for i in 0..steps {
        let t = f64::from(i) * dt;
        let go = |k: [f64; 2], by: f64| [x[0] + by * k[0], x[1] + by * k[1]];
        let k1 = slope(t, x);
        let k2 = slope(t + dt / 2.0, go(k1, dt / 2.0));
        let k3 = slope(t + dt / 2.0, go(k2, dt / 2.0));
        let k4 = slope(t + dt, go(k3, dt));
        for j in 0..2 {
            x[j] += dt / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
        }
        x[1] = limited(x[1]);
        if actuator.kind == Order::First {
            x[1] = slope(t + dt, x)[0];
        }
        for (stop, side) in [(position_max, 1.0), (position_min, -1.0)] {
            if side * (x[0] - stop) >= 0.0 {
                x = [stop, if side * x[1] > 0.0 { 0.0 } else { x[1] }];
            }
        }
    }
    motion.position = x[0];
    motion.rate = x[1];
    motion
}

prop_compose! {
    fn actuators()(
        first in any::<bool>(),
        bandwidth in 1.0..100.0,
        damping in prop_oneof![0.01..1.0, 1.0..5.0, Just(1.0), Just(1.0 - 1e-9), Just(1.0 + 1e-9)],
        rate_limit in prop_oneof![0.1..5.0, Just(1e6)],
        position_max in prop_oneof![0.1..1.0, Just(1e6)],
        position_min in prop_oneof![-1.0..-0.1, Just(-1e6)],
        y0 in -0.1..0.1,
    ) -> Actuator {
        let kind = if first { Order::First } else { Order::Second };
        Actuator { kind, bandwidth, damping, rate_limit, position_min, position_max, delay: 0.0, y0 }
    }
}

prop_compose! {
    /// Numbers that coincide: commands on the stops, slopes at the rate limit, critical damping.
    fn coincident()(
        first in any::<bool>(),
        bandwidth in prop_oneof![Just(1.0), Just(50.0), Just(1e-3), Just(1e6)],
        damping in prop_oneof![Just(0.01), Just(0.5), Just(1.0), Just(2.0), Just(100.0)],
        rate_limit in prop_oneof![Just(1.0), Just(0.1), Just(1e-9), Just(1e9)],
        position_max in prop_oneof![Just(1.0), Just(0.1), Just(1e9)],
        position_min in prop_oneof![Just(-1.0), Just(0.0), Just(-1e9)],
        y0 in prop_oneof![Just(0.0), Just(0.1)],
    ) -> Actuator {
        let kind = if first { Order::First } else { Order::Second };
        Actuator { kind, bandwidth, damping, rate_limit, position_min, position_max, delay: 0.0, y0 }
    }
}

/// Values and slopes that coincide with limits, and absurd ones.
fn coincident_ramps() -> impl Strategy<Value = (Ramp, f64)> {
    let number = prop_oneof![
        Just(0.0),
        Just(0.1),
        Just(1.0),
        Just(-0.1),
        Just(-1.0),
        Just(1e9),
        Just(-1e9),
        Just(1e-300),
        Just(1e30),
        Just(-1e30),
    ];
    let length = prop_oneof![Just(1e-12), Just(0.1), Just(1.0), Just(1e3), Just(1e30)];
    (number.clone(), number, length).prop_map(|(value, slope, h)| (Ramp { value, slope }, h))
}

prop_compose! {
    fn ramps()(value in -2.0..2.0, slope in prop_oneof![Just(0.0), -10.0..10.0]) -> Ramp {
        Ramp { value, slope }
    }
}

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn verif_limits_are_those_of_a_crude_integrator(
        actuator in actuators(),
        commands in prop::collection::vec((ramps(), 0.01..0.5_f64), 1..4),
    ) {
        let mut ours = Motion { position: actuator.y0, rate: 0.0 };
        let mut theirs = ours;
        for (command, h) in commands {
            let scale = actuator.bandwidth * h;
            ours = actuator.advance(ours, command, h).unwrap();
            theirs = crude(&actuator, theirs, command, h, 20_000);
            let error = (ours.position - theirs.position).abs();
            prop_assert!(error < 1e-5 * (2.0 + 10.0 * scale), "{ours:?} {theirs:?}");
        }
    }
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn verif_splitting_a_step_changes_rounding_alone(
        actuator in actuators(),
        commands in prop::collection::vec((ramps(), 0.01..2.0_f64), 1..4),
        parts in prop::collection::vec(0.01..1.0_f64, 1..8),
    ) {
        let mut whole = Motion { position: actuator.y0, rate: 0.0 };
        let mut split = whole;
        for (command, h) in commands {
            whole = actuator.advance(whole, command, h).unwrap();
            let mut t = 0.0;
            let sum: f64 = parts.iter().sum();
            for (i, part) in parts.iter().enumerate() {
                let end = if i + 1 == parts.len() { h } else { t + part / sum * h };
                split = actuator.advance(split, command.after(t), end - t).unwrap();
                t = end;
            }
            let position = whole.position - split.position;
            let rate = (whole.rate - split.rate) / actuator.bandwidth;
            prop_assert!(position.abs().max(rate.abs()) < 1e-11, "{whole:?} {split:?}");
        }
    }

    #[test]
    fn any_command_leaves_the_actuator_within_its_limits(
        actuator in coincident(),
        commands in prop::collection::vec(coincident_ramps(), 1..6),
    ) {
        let mut motion = Motion { position: actuator.y0, rate: 0.0 };
        // Rounding of commands or of time is then more than the actuator moves by.
        let absurd = commands.iter().any(|&(command, h)| {
            h.max(command.value.abs()).max(command.slope.abs()) > 1e20
        });
        for (command, h) in commands {
            match actuator.advance(motion, command, h) {
                Ok(next) => motion = next,
                Err(_) => prop_assert!(absurd),
            }
            let Motion { position, rate } = motion;
            let stops = actuator.position_min..=actuator.position_max;
            prop_assert!(stops.contains(&position) && rate.abs() <= actuator.rate_limit, "{motion:?}");
        }
    }
}
