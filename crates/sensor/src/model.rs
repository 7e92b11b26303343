//! Parameters and table of variables.

use crate::simulation::Running;
use fmi_model::{About, Dependencies, Items, Kind, Model, ModelError, Unit, Variable};

/// How the sensor fails: values of `failure`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Failure {
    /// It does not.
    None = 1,
    /// The output stays as it is at the failure.
    Stuck = 2,
    /// The output is zero.
    Zero = 3,
    /// `failure_value` is added to the output.
    Offset = 4,
    /// The output is `failure_value`.
    HardOver = 5,
    /// The output is NaN.
    NotANumber = 6,
}

impl Failure {
    const ALL: [Self; 6] =
        [Self::None, Self::Stuck, Self::Zero, Self::Offset, Self::HardOver, Self::NotANumber];

    /// That of a number in the table.
    fn numbered(number: f64) -> Self {
        Self::ALL.into_iter().find(|&failure| number == failure as i32 as f64).unwrap_or(Self::None)
    }
}

const FAILURES: Items = &[
    ("None", Failure::None as i32, "The sensor does not fail"),
    ("Stuck", Failure::Stuck as i32, "y stays as it is at failure_time"),
    ("Zero", Failure::Zero as i32, "y is zero"),
    ("Offset", Failure::Offset as i32, "failure_value is added to y"),
    ("HardOver", Failure::HardOver as i32, "y is failure_value"),
    ("NotANumber", Failure::NotANumber as i32, "y is NaN, as of a measurement that is not there"),
];

/// A sensor: its parameters. Input, output, bias, noise and quantum have the same unit if `scale` has none.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Time constant of the lag, s; 0: none.
    pub lag: f64,
    /// Scale factor.
    pub scale: f64,
    /// Added to the scaled input.
    pub bias: f64,
    /// Sampling period, s; 0: the sensor is continuous.
    pub period: f64,
    /// Standard deviation of the noise of a sample.
    pub noise: f64,
    /// Which noise.
    pub seed: i32,
    /// Distance between the values that the output takes; 0: it takes all.
    pub quantum: f64,
    /// How the sensor fails.
    pub failure: Failure,
    /// When, s.
    pub failure_time: f64,
    /// Offset or value of the failure.
    pub failure_value: f64,
}

/// Why a sensor cannot start or go on.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Error {
    /// Noise without a sampling period.
    #[error(
        "noise = {noise} with period = 0 is refused: noise is drawn for each sample; set period to \
         the sampling period, or noise to 0"
    )]
    ContinuousNoise {
        /// `noise`.
        noise: f64,
    },
    /// A period that no clock resolves.
    #[error("period = {period} s is refused: 0 for a continuous sensor, or {SHORTEST} s and more")]
    Period {
        /// `period`, s.
        period: f64,
    },
    /// Too many periods to count.
    #[error(
        "the step to {time} s is refused: more than {MOST_PERIODS:e} sampling periods of {period} s \
         have passed by then; choose a longer period"
    )]
    Time {
        /// End of the step, s.
        time: f64,
        /// `period`, s.
        period: f64,
    },
}

impl ModelError for Error {}

/// Shortest sampling period, s.
const SHORTEST: f64 = 1e-9;
/// Multiples of a period up to this number are exact.
pub const MOST_PERIODS: f64 = 1e15;
const ANY: [f64; 2] = [-1e9, 1e9];
const POSITIVE: [f64; 2] = [0.0, 1e9];

impl Model for Sensor {
    type Simulation = Running;
    type Error = Error;

    const ABOUT: About = About {
        description: "Sensor with lag, scale factor, bias, noise, sampling, quantisation and failures",
        author: "The ahv authors",
        license: env!("CARGO_PKG_LICENSE"),
        tool: concat!("cargo ahv ", env!("CARGO_PKG_VERSION")),
        events: "Parameters without effect, the failure",
        ..About::new("ahv_sensor", env!("CARGO_PKG_VERSION"))
    };
    #[rustfmt::skip]
    const VARIABLES: &'static [Variable<Self>] = &[
        Variable::input(0, "u", Unit::NONE, "Measured quantity").within(ANY),
        Variable::output("y", Unit::NONE, "Reading; NaN only after the failure NotANumber", Dependencies::dependent(1), |y: &f64| *y).accepting_non_finite(),
        Variable::parameter("lag", Kind::Real(Unit::SECOND), "Time constant of the first-order lag; 0: none", |s: &Self| s.lag, |s, v| s.lag = v).within([0.0, 1e6]),
        Variable::parameter("scale", Kind::Real(Unit::NONE), "Scale factor", |s: &Self| s.scale, |s, v| s.scale = v).within(ANY),
        Variable::parameter("bias", Kind::Real(Unit::NONE), "Bias, added to the scaled quantity", |s: &Self| s.bias, |s, v| s.bias = v).within(ANY),
        Variable::parameter("period", Kind::Real(Unit::SECOND), "Sampling period: samples are taken at its multiples after the start, and held; 0: continuous", |s: &Self| s.period, |s, v| s.period = v).within([0.0, 1e6]),
        Variable::parameter("noise", Kind::Real(Unit::NONE), "Standard deviation of the white, normally distributed noise of a sample", |s: &Self| s.noise, |s, v| s.noise = v).within(POSITIVE),
        Variable::parameter("seed", Kind::Integer, "Selects the noise: give each sensor its own", |s: &Self| f64::from(s.seed), |s, v| s.seed = v as i32),
        Variable::parameter("quantum", Kind::Real(Unit::NONE), "Resolution: y is a multiple of it; 0: any value", |s: &Self| s.quantum, |s, v| s.quantum = v).within(POSITIVE),
        Variable::parameter("failure", Kind::Enumeration("SensorFailure", FAILURES), "How the sensor fails", |s: &Self| f64::from(s.failure as i32), |s, v| s.failure = Failure::numbered(v)),
        Variable::parameter("failure_time", Kind::Real(Unit::SECOND), "When it fails", |s: &Self| s.failure_time, |s, v| s.failure_time = v).within(ANY),
        Variable::parameter("failure_value", Kind::Real(Unit::NONE), "Offset, or value of a hard-over failure", |s: &Self| s.failure_value, |s, v| s.failure_value = v).within(ANY),
    ];

    fn new() -> Result<Self, Error> {
        Ok(Self::IDEAL)
    }

    fn start(&self, time: f64, _tolerance: f64) -> Result<Running, Error> {
        let Self { noise, period, .. } = *self;
        if period > 0.0 && period < SHORTEST {
            return Err(Error::Period { period });
        }
        if noise > 0.0 && period == 0.0 {
            return Err(Error::ContinuousNoise { noise });
        }
        Ok(Running::new(self, time))
    }

    fn started(&self, default: &Self, _simulation: &Running, say: &mut dyn FnMut(String)) {
        let without_failure = self.failure == Failure::None;
        let valued = matches!(self.failure, Failure::Offset | Failure::HardOver);
        let ignored = [
            ("seed", self.noise == 0.0 && self.seed != default.seed, "noise = 0"),
            (
                "failure_time",
                without_failure && self.failure_time != default.failure_time,
                "failure = 1 (None)",
            ),
            (
                "failure_value",
                !valued && self.failure_value != default.failure_value,
                "failure is neither 4 (Offset) nor 5 (HardOver)",
            ),
        ];
        for (name, _, why) in ignored.into_iter().filter(|&(_, ignored, _)| ignored) {
            say(format!("{name} has no effect: {why}"));
        }
    }
}

impl Sensor {
    /// One whose reading is the quantity.
    pub const IDEAL: Self = Self {
        lag: 0.0,
        scale: 1.0,
        bias: 0.0,
        period: 0.0,
        noise: 0.0,
        seed: 0,
        quantum: 0.0,
        failure: Failure::None,
        failure_time: 0.0,
        failure_value: 0.0,
    };
}
