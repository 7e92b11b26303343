//! Range of validity of the model, domain of its equations, limits of its actuators.

use super::relative_wind::RelativeWind;
use crate::air::tightest;
use crate::error::{LimitedKind, LimitedQuantity};
use crate::structure::{FLEXIBLE, SLOSH};
use crate::vehicle::{
    Airframe, Control, FUEL, Gust, H, MAX_GUST_M_PER_S, STATES, State, V, Vehicle,
};

/// Largest magnitude of a state, in its unit, for which every term of the equations is finite: a power of
/// two.
const MAX_STATE: f64 = (1_u64 << 33) as f64;
/// Lowest speed in the domain of the equations, m/s: above any gust, so that the air comes from ahead.
const MIN_SPEED_M_PER_S: f64 = 500.0;
/// Lowest altitude in the domain of the equations, m: above the earth's centre.
const MIN_ALTITUDE_M: f64 = -1e6;

/// Whether all components are below `MAX_STATE`, so that nothing overflows. The test is one bit: the
/// highest bit of the exponent of 2 x / `MAX_STATE` is set for a magnitude of 2 and above.
#[inline(always)]
pub fn is_finite(x: &State) -> bool {
    const HIGHEST_EXPONENT_BIT: u64 = 1 << 62;
    let bits = x.iter().fold(0, |bits, value| bits | (value * (2.0 / MAX_STATE)).to_bits());
    bits & HIGHEST_EXPONENT_BIT == 0
}

/// The first state outside the domain of the equations, which an external integrator may reach.
pub fn out_of_domain(x: &State) -> Option<LimitedQuantity> {
    let least = |i: usize| match i {
        V => MIN_SPEED_M_PER_S,
        H => MIN_ALTITUDE_M,
        _ => -MAX_STATE,
    };
    (0..STATES)
        .map(|i| LimitedQuantity {
            kind: LimitedKind::State(i),
            value: x[i],
            limits: [least(i), MAX_STATE],
        })
        .find(|limited| limited.margin() < 0.0)
}

impl Vehicle {
    /// Smallest and largest elevator deflection (rad) and fuel equivalence ratio.
    pub fn control_ranges(&self) -> Control<[f64; 2]> {
        let [delta_e, phi] = self.limits;
        [[-delta_e, delta_e], [0.0, phi]]
    }

    /// Controls limited to the range of the actuators.
    pub fn saturate(&self, [delta_e, phi]: Control) -> Control {
        let [[least, largest], [lean, rich]] = self.control_ranges();
        [delta_e.clamp(least, largest), phi.clamp(lean, rich)]
    }

    /// A gust limited to [`MAX_GUST_M_PER_S`].
    pub fn limit_gust(wanted: Gust) -> Gust {
        wanted.map(|speed| speed.clamp(-MAX_GUST_M_PER_S, MAX_GUST_M_PER_S))
    }

    /// Whether fuel burns and the tanks are empty, also for NaN.
    pub fn out_of_fuel(&self, x: &State) -> bool {
        self.fuel_table.is_some() && (x[FUEL] < 0.0 || x[FUEL].is_nan())
    }

    /// Altitude, airspeed and incidence.
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

    /// Displacement of the liquid in each tank, limited by its depth.
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

    /// Margin of the burner to thermal choking, if the fits are limited by it.
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

    /// Whether the model is valid: curve fits within their ranges, liquid within its depth, fuel left if
    /// it burns.
    pub fn holds(&self, x: &State, u: &Control, gust: Gust) -> bool {
        let condition = Self::flight_condition(x, gust);
        self.aero.envelope.holds(&self.atmosphere, condition)
            && !self.out_of_fuel(x)
            && (self.modes <= FLEXIBLE
                || self.sloshing(x).iter().all(|limited| limited.margin() >= 0.0))
            && self.choking(x, u, gust).is_none_or(|limited| limited.margin() >= 0.0)
    }

    /// All limited quantities.
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

    /// The limited quantity with the smallest margin.
    pub fn tightest(&self, x: &State, u: &Control, gust: Gust) -> LimitedQuantity {
        tightest(self.limited_quantities(x, u, gust))
    }
}
