//! Parameters and table of variables.

use crate::response::Motion;
use crate::simulation::Running;
use fmi_model::{About, Dependencies, Items, Kind, Model, ModelError, Remedy, Unit, Variable};

/// Order of the dynamics: values of `kind`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// y'' = bandwidth^2 (u - y) - 2 damping bandwidth y'.
    Second = 1,
    /// y' = bandwidth (u - y).
    First = 2,
}

const ORDERS: Items = &[
    ("SecondOrder", Order::Second as i32, "Second-order dynamics with bandwidth and damping"),
    ("FirstOrder", Order::First as i32, "First-order lag with the time constant 1/bandwidth"),
];

/// An actuator: its parameters. Position, command and limits have the same unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Actuator {
    /// Order of the dynamics.
    pub kind: Order,
    /// Natural frequency or, of first order, bandwidth, rad/s.
    pub bandwidth: f64,
    /// Damping ratio.
    pub damping: f64,
    /// Largest rate, 1/s.
    pub rate_limit: f64,
    /// Lower stop.
    pub position_min: f64,
    /// Upper stop.
    pub position_max: f64,
    /// Delay of the command, s.
    pub delay: f64,
    /// Initial position.
    pub y0: f64,
}

/// Why an actuator cannot start or go on.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Error {
    /// No position is left.
    #[error(
        "position_min = {min} and position_max = {max} are refused: position_min has to be less than \
         position_max"
    )]
    Stops {
        /// `position_min`.
        min: f64,
        /// `position_max`.
        max: f64,
    },
    /// A start beyond a stop.
    #[error(
        "y0 = {y0} is refused: the actuator starts between its stops position_min = {min} and \
         position_max = {max}; change y0 or the stop"
    )]
    Start {
        /// `y0`.
        y0: f64,
        /// `position_min`.
        min: f64,
        /// `position_max`.
        max: f64,
    },
    /// More changes of the command within the delay than are kept.
    #[error(
        "delay = {delay} s is too long for steps of {} s: at most {most} changes of u are kept on \
         their way; take steps of {} s and longer, or a shorter delay",
        // Without the digits that sums of steps are rounded to.
        *step as f32,
        (delay / (*most - 2) as f64) as f32
    )]
    DelayFull {
        /// `delay`, s.
        delay: f64,
        /// Length of the step, s.
        step: f64,
        /// How many changes are kept.
        most: usize,
    },
    /// A step in which limits are reached and left again and again.
    #[error(
        "a step of {step} s is refused: u makes the actuator reach and leave its limits more than \
         {most} times within it; take a shorter step"
    )]
    Pieces {
        /// Length of the step, s.
        step: f64,
        /// Most pieces of motion in a step.
        most: usize,
    },
}

impl ModelError for Error {
    fn remedy(&self) -> Remedy {
        match self {
            Self::Pieces { .. } => Remedy::ShorterStep,
            _ => Remedy::Reset,
        }
    }
}

const BANDWIDTH: &Unit = &Unit::new("rad/s", Some("AngularFrequency"), [0, 0, -1, 1]);
/// Positions and rates up to this.
pub const LARGEST_POSITION: f64 = 1e9;
const POSITIONS: [f64; 2] = [-LARGEST_POSITION, LARGEST_POSITION];

impl Model for Actuator {
    type Simulation = Running;
    type Error = Error;

    const ABOUT: About = About {
        description: "Actuator of first or second order with rate limit, position stops and delay",
        author: "The ahv authors",
        license: env!("CARGO_PKG_LICENSE"),
        tool: concat!("cargo ahv ", env!("CARGO_PKG_VERSION")),
        events: "Parameters without effect, the first command beyond a stop",
        ..About::new("ahv_actuator", env!("CARGO_PKG_VERSION"))
    };
    #[rustfmt::skip]
    const VARIABLES: &'static [Variable<Self>] = &[
        Variable::input(0, "u", Unit::NONE, "Commanded position").within(POSITIONS),
        Variable::output("y", Unit::NONE, "Position", Dependencies::NONE, |motion: &Motion| motion.position),
        Variable::output("rate", Unit::NONE, "Rate of the position, units of y per second", Dependencies::NONE, |motion: &Motion| motion.rate),
        Variable::parameter("kind", Kind::Enumeration("ActuatorKind", ORDERS), "Order of the dynamics", |a: &Self| f64::from(a.kind as i32), |a, v| a.kind = if v == 2.0 { Order::First } else { Order::Second }),
        Variable::parameter("bandwidth", Kind::Real(BANDWIDTH), "Natural frequency; of first order 1/time constant", |a: &Self| a.bandwidth, |a, v| a.bandwidth = v).within([1e-3, 1e6]),
        Variable::parameter("damping", Kind::Real(Unit::ONE), "Damping ratio, of second order", |a: &Self| a.damping, |a, v| a.damping = v).within([0.01, 100.0]),
        Variable::parameter("rate_limit", Kind::Real(Unit::NONE), "Largest rate, units of y per second", |a: &Self| a.rate_limit, |a, v| a.rate_limit = v).within([1e-9, LARGEST_POSITION]),
        Variable::parameter("position_min", Kind::Real(Unit::NONE), "Lower stop", |a: &Self| a.position_min, |a, v| a.position_min = v).within(POSITIONS),
        Variable::parameter("position_max", Kind::Real(Unit::NONE), "Upper stop", |a: &Self| a.position_max, |a, v| a.position_max = v).within(POSITIONS),
        Variable::parameter("delay", Kind::Real(Unit::SECOND), "Pure delay of the command", |a: &Self| a.delay, |a, v| a.delay = v).within([0.0, 1e3]),
        Variable::parameter("y0", Kind::Real(Unit::NONE), "Initial position, at rest; also the command before the start", |a: &Self| a.y0, |a, v| a.y0 = v).within(POSITIONS),
    ];

    fn new() -> Result<Self, Error> {
        Ok(Self::DEFAULT)
    }

    fn start(&self, time: f64, _tolerance: f64) -> Result<Running, Error> {
        let Self { position_min: min, position_max: max, y0, .. } = *self;
        if min >= max {
            return Err(Error::Stops { min, max });
        }
        if !(min..=max).contains(&y0) {
            return Err(Error::Start { y0, min, max });
        }
        Ok(Running::new(self, time))
    }

    fn started(&self, default: &Self, _simulation: &Running, say: &mut dyn FnMut(String)) {
        if self.kind == Order::First && self.damping != default.damping {
            say("damping has no effect: kind = 2 (FirstOrder) is not damped".to_string());
        }
    }
}

impl Actuator {
    /// An elevator actuator as studies of hypersonic vehicles assume it: 50 rad/s, damping ratio 0.7; 2 rad/s and 1 rad
    /// are generous limits.
    pub const DEFAULT: Self = Self {
        kind: Order::Second,
        bandwidth: 50.0,
        damping: 0.7,
        rate_limit: 2.0,
        position_min: -1.0,
        position_max: 1.0,
        delay: 0.0,
        y0: 0.0,
    };

    /// By how long the position lags behind a ramp, s.
    pub(crate) fn lag(&self) -> f64 {
        match self.kind {
            Order::Second => 2.0 * self.damping / self.bandwidth,
            Order::First => 1.0 / self.bandwidth,
        }
    }
}
