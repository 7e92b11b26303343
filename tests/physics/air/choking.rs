//! How much fuel the burner can take: printed limits, continuity, slopes, edges. Its agreement with the
//! first-principles engine is tested beside that, in crates/research.

use crate::model::{data, other_engine};
use ahv::air::{Atmosphere, Choking};
use ahv::solve::Dual;
use proptest::prelude::*;

const ALTITUDE: f64 = 25_900.0;

fn choking() -> Choking {
    let data = data();
    Choking::new(&data.vehicle, &data.earth)
}

#[test]
fn verif_the_limit_falls_with_the_incidence_to_known_values() {
    let sound_speed = Atmosphere::new(&data().earth).sound_speed(ALTITUDE);
    for (degrees, printed) in [(0.0_f64, "0.697"), (2.0, "0.655"), (5.0, "0.576")] {
        let got = choking().margin(8.0, degrees.to_radians(), sound_speed, 0.0);
        assert_eq!(format!("{got:.3}"), printed, "Mach 8, {degrees} deg");
    }
}

#[test]
fn verif_the_margin_is_continuous() {
    // The slopes stay below these, in units of the Mach number; a jump would exceed what they make
    // of a step.
    const PER_RADIAN: f64 = 3.5;
    const PER_MACH: f64 = 0.1;
    const STEPS: u32 = 1500;
    let choking = choking();
    let at = |mach: f64, inflow: f64| choking.margin(mach, inflow, 300.0, 0.0);
    let steady = |bound: f64, value: &dyn Fn(f64) -> f64| {
        let values: Vec<_> = (0..=STEPS).map(|i| value(f64::from(i) / f64::from(STEPS))).collect();
        let jump = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        assert!(jump < bound / f64::from(STEPS), "{jump}");
    };
    for mach in (1..=300).map(|tenths| 0.1 * f64::from(tenths)) {
        steady(0.6 * PER_RADIAN * mach, &|share| at(mach, -0.2 + 0.6 * share));
        steady(0.1 * PER_MACH * (mach + 0.1), &|share| at(mach + 0.1 * share, 0.02));
        // The diffuser chokes before the shocks are detached, and there the burner takes nothing.
        let (mut low, mut high) = (-0.2, 1.5);
        while 0.5 * (low + high) > low && 0.5 * (low + high) < high {
            let middle = 0.5 * (low + high);
            if at(mach, middle) > 0.0 { low = middle } else { high = middle }
        }
        assert!(at(mach, low) < 1e-7, "Mach {mach}: {} at {low} rad", at(mach, low));
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod flags {
    use std::arch::asm;

    /// Invalid operation, division by zero, overflow.
    const BAD: u32 = 0b1101;

    fn state() -> u32 {
        let mut state = 0_u32;
        // SAFETY: stores four bytes where there is room for them.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut state) };
        state
    }

    /// Which of the exceptions a calculation raises.
    pub fn raised<T>(run: impl FnOnce() -> T) -> u32 {
        let clear = state() & !0b11_1111;
        // SAFETY: the state of this thread, without its flags.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const clear) };
        std::hint::black_box(run());
        state() & BAD
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod flags {
    pub fn raised<T>(run: impl FnOnce() -> T) -> u32 {
        run();
        0
    }
}

/// Mach number, inflow, speed of sound, equivalence ratio.
fn seeded([mach, inflow, sound, phi]: [f64; 4]) -> [Dual<4>; 4] {
    [
        Dual::variable(mach, 0),
        Dual::variable(inflow, 1),
        Dual::variable(sound, 2),
        Dual::variable(phi, 3),
    ]
}

/// Value and slopes are numbers, within bounds, without a flag raised.
fn assert_sound(choking: &Choking, at: [f64; 4]) {
    let mut got = Dual::default();
    let raised = flags::raised(|| {
        let [mach, inflow, sound, phi] = std::hint::black_box(seeded(at));
        got = choking.margin(mach, inflow, sound, phi);
        let [mach, inflow, sound, phi] = std::hint::black_box(at);
        assert_eq!(got.re, choking.margin(mach, inflow, sound, phi), "{at:?}");
    });
    assert_eq!(raised, 0, "flags at {at:?}");
    // No stream takes a rise of its stagnation temperature beyond that of an infinite Mach number.
    let total = at[2] * at[2] * (1.0 + 0.2 * at[0] * at[0]) / 0.4;
    let heat = 0.0291 * 0.9 * 1.2e8;
    let most = total / heat / (1.4 * 1.4 - 1.0);
    assert!(got.re >= -at[3] && got.re <= most - at[3], "{got:?} at {at:?}");
    assert!(got.eps.iter().all(|slope| slope.is_finite()), "{got:?} at {at:?}");
    assert_eq!(got.eps[3], -1.0);
}

#[test]
fn verif_corners_and_edges_are_numbers_without_a_flag() {
    let choking = choking();
    let lower = data().vehicle.outline.lower_angle_rad.value;
    let half_turn = std::f64::consts::FRAC_PI_2 - lower;
    // A turn that is nearly none, one that is nearly the largest, one across the stream.
    let mut inflows = vec![-1.5, -lower, -lower + 1e-300, -lower + 1e-17, -lower + 1e-9, 0.0];
    inflows.extend([half_turn - 1e-16, half_turn, half_turn + 1e-16, 1.5, 5e-324, -0.0]);
    inflows.extend((0..400).map(|i| -lower + 0.002 * f64::from(i)));
    let mut machs = vec![0.1, 1.0 - 1e-16, 1.0, 1.0 + 2.3e-16, 1.0 + 1e-9, 1.0001, 1.3, 30.0];
    machs.extend((0..60).map(|i| 0.5 * f64::from(i) + 0.3));
    for &mach in &machs {
        for &inflow in &inflows {
            for phi in [0.0, 1.5] {
                assert_sound(&choking, [mach, inflow, 295.0, phi]);
            }
        }
    }
    if cfg!(target_arch = "x86_64") {
        assert_ne!(flags::raised(|| std::hint::black_box(0.0) / std::hint::black_box(0.0)), 0);
    }
}

#[test]
fn verif_no_number_in_is_no_flow() {
    for [mach, inflow] in [[f64::NAN, 0.0], [8.0, f64::NAN], [f64::NAN; 2]] {
        assert_eq!(choking().margin(mach, inflow, 300.0, 0.25), -0.25);
    }
}

/// The margin's slopes against central differences: what is left is their error.
fn assert_slopes(at: [f64; 4], tolerance: f64) {
    let choking = choking();
    let [mach, inflow, sound, phi] = seeded(at);
    let slopes = choking.margin(mach, inflow, sound, phi).eps;
    for (direction, step) in [1e-4, 1e-6, 1e-2, 1e-4].into_iter().enumerate() {
        let moved = |by: f64| {
            let mut at = at;
            at[direction] += by;
            choking.margin(at[0], at[1], at[2], at[3])
        };
        let difference = (moved(step) - moved(-step)) / (2.0 * step);
        let off = (slopes[direction] - difference).abs();
        assert!(
            off <= tolerance * (1e-3 + difference.abs()),
            "direction {direction} at {at:?}: {} against {difference}",
            slopes[direction]
        );
    }
}

proptest! {
    #[test]
    fn property_slopes_are_those_of_differences(
        mach in 6.0..10.5f64, inflow in -0.087..0.1745f64, sound in 280.0..320.0f64, phi in 0.0..1.5f64,
    ) {
        assert_slopes([mach, inflow, sound, phi], 1e-6);
    }

    #[test]
    fn property_slopes_are_those_of_differences_with_the_lip_below_the_shock(
        mach in 17.0..30.0f64, inflow in -0.087..0.1f64, sound in 280.0..320.0f64, phi in 0.0..1.5f64,
    ) {
        assert_slopes([mach, inflow, sound, phi], 1e-6);
    }

    #[test]
    fn property_slopes_without_flow_are_those_of_the_fuel(
        mach in 0.1..1.3f64, inflow in -1.5..1.5f64, phi in 0.0..1.5f64,
    ) {
        let [mach, inflow, sound, phi] = seeded([mach, inflow, 300.0, phi]);
        let got = choking().margin(mach, inflow, sound, phi);
        prop_assert_eq!(got, -phi);
    }

    #[test]
    fn property_other_vehicles_and_gases_raise_no_flag(
        lower in 0.02..0.3f64, duct in 0.3..3.0f64, contraction in 1.0..10.0f64,
        gamma in 1.2..1.66f64, mach in 3.0..25.0f64, turn in 1e-4..0.3f64,
    ) {
        let data = other_engine(lower, duct, contraction, gamma);
        let choking = Choking::new(&data.vehicle, &data.earth);
        let raised = flags::raised(|| choking.margin(mach, turn - lower, 300.0, 0.0));
        prop_assert_eq!(raised, 0);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]
    #[test]
    fn property_it_is_a_number_within_bounds_without_a_flag(
        mach in 0.1..30.0f64, inflow in -1.5..1.5f64, sound in 250.0..340.0f64, phi in 0.0..1.5f64,
    ) {
        assert_sound(&choking(), [mach, inflow, sound, phi]);
    }
}
