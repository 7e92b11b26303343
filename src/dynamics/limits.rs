//! Where the model holds, where it has numbers at all, and what its actuators can do.

use super::relative_wind::RelativeWind;
use crate::air::tightest;
use crate::error::{LimitedKind, LimitedQuantity};
use crate::structure::{FLEXIBLE, SLOSH};
use crate::vehicle::{
    Airframe, Control, FUEL, Gust, H, MAX_GUST_M_PER_S, STATES, State, V, Vehicle,
};

/// Size up to which a state, in its unit, leaves every term of the equations finite: a power of two.
const FAR: f64 = (1_u64 << 33) as f64;
/// Slowest speed, m/s, for which the equations have numbers: faster than any gust, so that the air
/// comes from ahead.
const SLOWEST: f64 = 500.0;
/// Lowest altitude likewise, m: above the earth's centre.
const LOWEST: f64 = -1e6;

/// Whether a trial state of our own integrator is so small that nothing overflows. Of one that is too
/// large, over `FAR` and by two, the exponent has its highest bit.
#[inline(always)]
pub fn is_finite(x: &State) -> bool {
    const HIGHEST: u64 = 1 << 62;
    let bits = x.iter().fold(0, |bits, value| bits | (value * (2.0 / FAR)).to_bits());
    bits & HIGHEST == 0
}

/// The first state for which the equations have no numbers. An integrator from outside may look far
/// beyond the region in which they hold.
pub fn out_of_domain(x: &State) -> Option<LimitedQuantity> {
    let least = |i: usize| match i {
        V => SLOWEST,
        H => LOWEST,
        _ => -FAR,
    };
    (0..STATES)
        .map(|i| LimitedQuantity {
            kind: LimitedKind::State(i),
            value: x[i],
            limits: [least(i), FAR],
        })
        .find(|limited| limited.margin() < 0.0)
}

impl Vehicle {
    /// Smallest and largest elevator deflection (rad) and fuel equivalence ratio.
    pub fn control_ranges(&self) -> Control<[f64; 2]> {
        let [delta_e, phi] = self.limits;
        [[-delta_e, delta_e], [0.0, phi]]
    }

    /// Controls cut to what the actuators can do.
    pub fn saturate(&self, [delta_e, phi]: Control) -> Control {
        let [[least, largest], [lean, rich]] = self.control_ranges();
        [delta_e.clamp(least, largest), phi.clamp(lean, rich)]
    }

    /// A gust cut to the fastest.
    pub fn limit_gust(wanted: Gust) -> Gust {
        wanted.map(|speed| speed.clamp(-MAX_GUST_M_PER_S, MAX_GUST_M_PER_S))
    }

    /// Whether fuel burns and none is left; a mass that is not a number counts as none.
    pub fn out_of_fuel(&self, x: &State) -> bool {
        self.fuel_table.is_some() && (x[FUEL] < 0.0 || x[FUEL].is_nan())
    }

    /// Altitude, speed through the air and incidence to it.
    fn flight_condition(x: &State, gust: Gust) -> [f64; 3] {
        let RelativeWind { speed, incidence, .. } = RelativeWind::new(x, gust);
        [x[H], speed, incidence]
    }

    /// Calls `f` with the airframe at a state.
    fn at_level<T>(&self, x: &State, f: impl FnOnce(&Airframe) -> T) -> T {
        match &self.fuel_table {
            None => f(&self.airframe),
            Some(fuel_table) => f(&fuel_table.airframe(x[FUEL])),
        }
    }

    /// How far the liquid in each tank is from where it would leave its depth.
    fn sloshing(&self, x: &State) -> [LimitedQuantity; SLOSH] {
        self.at_level(x, |airframe| {
            let moved = airframe.sloshing(x);
            std::array::from_fn(|tank| LimitedQuantity {
                kind: LimitedKind::Slosh(tank),
                value: moved[tank],
                limits: [-airframe.depth[tank], airframe.depth[tank]],
            })
        })
    }

    /// How far the burner is from thermal choking, if the fits end there.
    fn choking(&self, x: &State, u: &Control, gust: Gust) -> Option<LimitedQuantity> {
        let least = self.aero.envelope.choking_margin?;
        let value = self.at_level(x, |airframe| {
            let airflow = self.airflow(airframe, x, u, gust);
            self.choking_margin(&airflow, u)
        });
        Some(LimitedQuantity {
            kind: LimitedKind::ChokingMargin,
            value,
            limits: [least, f64::INFINITY],
        })
    }

    /// Whether the model holds at a state: within the ranges of the curve fits, with the liquid inside
    /// its depth, and with fuel if it burns.
    pub fn holds(&self, x: &State, u: &Control, gust: Gust) -> bool {
        let condition = Self::flight_condition(x, gust);
        self.aero.envelope.holds(&self.atmosphere, condition)
            && !self.out_of_fuel(x)
            && (self.modes <= FLEXIBLE
                || self.sloshing(x).iter().all(|limited| limited.margin() >= 0.0))
            && self.choking(x, u, gust).is_none_or(|limited| limited.margin() >= 0.0)
    }

    /// All quantities that have limits.
    pub fn limited_quantities(
        &self,
        x: &State,
        u: &Control,
        gust: Gust,
    ) -> impl Iterator<Item = LimitedQuantity> {
        let condition = Self::flight_condition(x, gust);
        let sloshing = (self.modes > FLEXIBLE).then(|| self.sloshing(x));
        let others = sloshing.into_iter().flatten().chain(self.choking(x, u, gust));
        self.aero.envelope.limited_quantities(&self.atmosphere, condition).into_iter().chain(others)
    }

    /// The quantity that is outside its limits or, inside all, next to them.
    pub fn tightest(&self, x: &State, u: &Control, gust: Gust) -> LimitedQuantity {
        tightest(self.limited_quantities(x, u, gust))
    }
}
