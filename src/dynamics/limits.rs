//! Where the model holds, and where it has numbers at all.

use super::stream::Stream;
use super::{Airframe, Control, FUEL, Gust, NOMINAL, STATES, State, Vehicle};
use crate::envelope::{Limited, tightest};
use crate::modes::SLOSH;

/// Outputs that show the displacement of the liquid in the fore and aft tank.
const SLOSH_NAMES: [&str; SLOSH] = ["slosh1", "slosh2"];

/// Names of the states in the variable table.
pub const STATE_NAMES: [&str; STATES] = [
    "V",
    "h",
    "gamma",
    "alpha",
    "q",
    "eta1",
    "eta1_dot",
    "eta2",
    "eta2_dot",
    "eta3",
    "eta3_dot",
    "eta_slosh1",
    "eta_slosh1_dot",
    "eta_slosh2",
    "eta_slosh2_dot",
    "fuel_mass",
];

/// Size of a state, over its typical size, up to which no term of the equations overflows.
const FAR: f64 = 1e6;
/// Least and largest value of each state for which the equations have numbers: far beyond those for
/// which they hold, as integrators look there. Faster than any gust, so that the air always comes from
/// ahead, and above the earth's centre.
const NUMBERS: [State; 2] = {
    let (mut least, mut largest) = ([0.0; STATES], [0.0; STATES]);
    let mut i = 0;
    while i < STATES {
        largest[i] = FAR * NOMINAL[i];
        least[i] = -largest[i];
        i += 1;
    }
    least[0] = 0.5 * NOMINAL[0];
    least[1] = -100.0 * NOMINAL[1];
    [least, largest]
};

/// Whether the equations have numbers at a state.
#[inline(always)]
pub fn has_numbers(x: &State) -> bool {
    let [least, largest] = &NUMBERS;
    let mut inside = true;
    for i in 0..STATES {
        inside &= (x[i] >= least[i]) & (x[i] <= largest[i]);
    }
    inside
}

/// The first quantity of a state for which the equations have no numbers.
pub fn numberless(x: &State) -> Option<Limited> {
    let [least, largest] = &NUMBERS;
    (0..STATES)
        .map(|i| Limited { variable: STATE_NAMES[i], value: x[i], limits: [least[i], largest[i]] })
        .find(|limited| limited.margin() < 0.0)
}

impl Vehicle {
    /// The state as moving air meets it: speed through the air for V, incidence to it for alpha. Still
    /// air leaves it bit for bit as it is.
    pub fn as_met(x: &State, gust: Gust) -> State {
        let Stream { speed, incidence, .. } = Stream::new(x, gust);
        let mut met = *x;
        (met[0], met[3]) = (speed, incidence);
        met
    }

    /// Calls `f` with the airframe at a state.
    fn at_level<T>(&self, x: &State, f: impl FnOnce(&Airframe) -> T) -> T {
        match &self.burn {
            None => f(&self.airframe),
            Some(burn) => f(&burn.airframe(x[FUEL])),
        }
    }

    /// How far the liquid in each tank is from where it would leave its depth.
    fn sloshing(&self, x: &State) -> [Limited; SLOSH] {
        self.at_level(x, |airframe| {
            let moved = airframe.sloshing(x);
            std::array::from_fn(|tank| Limited {
                variable: SLOSH_NAMES[tank],
                value: moved[tank],
                limits: [-airframe.depth[tank], airframe.depth[tank]],
            })
        })
    }

    /// How far the burner is from thermal choking, if the fits end there.
    fn choking(&self, x: &State, u: &Control, gust: Gust) -> Option<Limited> {
        let least = self.aero.envelope.choking_margin?;
        let value = self.at_level(x, |airframe| {
            let met = self.met(airframe, x, u, gust);
            self.choking_margin(&met, u)
        });
        Some(Limited { variable: "choking_margin", value, limits: [least, f64::INFINITY] })
    }

    /// Whether the model holds at a state: within the ranges of the curve fits, with the liquid inside
    /// its depth, and with fuel if it burns.
    pub fn holds(&self, x: &State, u: &Control, gust: Gust) -> bool {
        let met = Self::as_met(x, gust);
        self.aero.envelope.holds(&self.atmosphere, &met)
            && !self.out_of_fuel(x)
            && (self.modes <= crate::modes::FLEXIBLE
                || self.sloshing(x).iter().all(|limited| limited.margin() >= 0.0))
            && self.choking(x, u, gust).is_none_or(|limited| limited.margin() >= 0.0)
    }

    /// The quantity that is outside its limits or, inside all, next to them.
    pub fn tightest(&self, x: &State, u: &Control, gust: Gust) -> Limited {
        let met = Self::as_met(x, gust);
        let sloshing = (self.modes > crate::modes::FLEXIBLE).then(|| self.sloshing(x));
        let others = sloshing.into_iter().flatten().chain(self.choking(x, u, gust));
        tightest(self.aero.envelope.tightest(&self.atmosphere, &met), others)
    }
}
