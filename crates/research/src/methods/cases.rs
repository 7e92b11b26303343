//! Flights on which methods are compared.

use super::problem::{Law, Problem};
use ahv::data::AeroSet;
use ahv::dynamics::trim::Trim;
use ahv::flight::Parameters;
use ahv::vehicle::{ALPHA, Configuration, DELTA_E, FUEL, GAMMA, NOMINAL, Q, State, Vehicle};
use ahv_tool::cli::Set;
use ahv_tool::own_vehicle::OwnVehicle;
use ahv_tool::trim::setup;
use anyhow::Result;

/// A flight, before its vehicle is built.
pub struct Plan {
    name: &'static str,
    change: fn(&mut Parameters),
    /// Changes the trimmed start.
    disturb: fn(&mut State),
    /// Elevator off trim, rad.
    elevator: f64,
    closed: bool,
    flight_s: f64,
    steps: usize,
    /// Velocity of the air in the first quarter, m/s.
    gust: f64,
}

const FROM_TRIM: Plan = Plan {
    name: "from trim",
    change: |_| (),
    disturb: |_| (),
    elevator: 0.0,
    closed: false,
    flight_s: 1.0,
    steps: 100,
    gust: 0.0,
};
/// As far from trim as the sloshing liquid allows.
const FAR: Plan = Plan {
    name: "far from trim, gusts, closed loop",
    disturb: |x| disturb(x, [0.02, 0.02, 0.1], 0.3),
    closed: true,
    flight_s: 2.0,
    steps: 200,
    gust: 3.0,
    ..FROM_TRIM
};
const FARTHER: Plan = Plan {
    name: "EvenMassBeam, farther from trim, strong gusts, closed loop",
    change: |p| p.options.configuration = Configuration::EvenMassBeam,
    disturb: |x| disturb(x, [0.05, 0.06, 0.2], 1.0),
    gust: 10.0,
    ..FAR
};
const RELEASED: Plan = Plan {
    name: "released off trim",
    disturb: |x| disturb(x, [0.0; 3], 1.0),
    flight_s: 0.4,
    steps: 40,
    ..FROM_TRIM
};
const ELEVATOR: Plan = Plan {
    name: "released, elevator 1 deg off trim",
    elevator: 0.0175,
    flight_s: 0.3,
    steps: 3,
    ..RELEASED
};

/// The flights.
pub const CASES: [Plan; 13] = [
    FROM_TRIM,
    Plan { steps: 10, ..FROM_TRIM },
    Plan { steps: 4, ..FROM_TRIM },
    Plan { name: "from trim, closed loop", closed: true, flight_s: 2.0, steps: 200, ..FROM_TRIM },
    FAR,
    Plan {
        name: "far from trim, parker2007",
        change: |p| p.options.aero = AeroSet::Parker2007,
        ..FAR
    },
    Plan {
        name: "far from trim, shock_expansion",
        change: |p| p.options.aero = AeroSet::ShockExpansion,
        ..FAR
    },
    Plan {
        name: "sloshing at 4 rad/s, gusts, closed loop",
        change: |p| p.options.slosh_frequency = 4.0,
        disturb: |x| disturb(x, [0.0, 0.01, 0.03], 0.1),
        flight_s: 1.0,
        steps: 100,
        gust: 1.0,
        ..FAR
    },
    FARTHER,
    Plan { flight_s: 5.0, steps: 500, ..FARTHER },
    RELEASED,
    ELEVATOR,
    Plan { steps: 1, ..ELEVATOR },
];

/// Adds to gamma, alpha and q (rad, rad/s), and a share of their nominal values to alpha, q and the modes.
fn disturb(x: &mut State, [gamma, alpha, q]: [f64; 3], share: f64) {
    for i in ALPHA..FUEL {
        x[i] += share * NOMINAL[i];
    }
    x[GAMMA] += gamma;
    x[ALPHA] += alpha;
    x[Q] += q;
}

/// A flight.
pub struct Case {
    plan: &'static Plan,
    pub vehicle: Vehicle,
    pub trim: Trim,
}

impl Case {
    /// With the parameters set on the command line.
    pub fn new(plan: &'static Plan, set: &Set) -> Result<Self> {
        let mut setup = setup(&OwnVehicle::default(), set)?;
        (plan.change)(&mut setup.parameters);
        let flight = setup.fly()?;
        Ok(Self { plan, vehicle: flight.vehicle().clone(), trim: *flight.trim() })
    }

    pub fn title(&self) -> String {
        let Plan { name, flight_s, steps, .. } = self.plan;
        format!("{name}: {flight_s} s in communication steps of {} s", flight_s / *steps as f64)
    }

    pub fn problem(&self) -> Problem<'_> {
        let Plan { disturb, elevator, closed, flight_s, steps, gust, .. } = *self.plan;
        let law = if closed { Law::closed(&self.trim) } else { Law::OPEN };
        let mut problem = Problem::new(&self.vehicle, &self.trim, steps, law);
        disturb(&mut problem.start);
        // States that the configuration lacks stay at zero.
        problem.start[self.vehicle.states().min(FUEL)..FUEL].fill(0.0);
        problem.control[DELTA_E] += elevator;
        Problem { flight_s, gust: [gust, 0.5 * gust], ..problem }
    }
}
