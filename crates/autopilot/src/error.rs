//! What the autopilot refuses: the file or variable, the value, the limit and what to do.

use fmi_model::{ModelError, Remedy};
use std::path::PathBuf;

/// Why there is no autopilot.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// The file of the law cannot be read.
    #[error("{} cannot be read: {why}; examples/closed_loop/design.py writes it", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        why: String,
    },
    /// The file is not what `design.py` writes.
    #[error("law.json: {why}; examples/closed_loop/design.py writes it")]
    Format {
        /// What is wrong, and where.
        why: String,
    },
    /// A value of the file that no law can have.
    #[error("law.json: design {design}: {key} {problem}")]
    Design {
        /// Number of the design, from 1 on.
        design: usize,
        /// The key.
        key: &'static str,
        /// Value, limit.
        problem: String,
    },
    /// No design has the period.
    #[error(
        "period = {period_s} s is refused: law.json has designs for {}; \
         examples/closed_loop/design.py --period {period_s} writes another",
        list(known_s)
    )]
    Period {
        /// The parameter, s.
        period_s: f64,
        /// Periods of the designs, s.
        known_s: Vec<f64>,
    },
    /// A step with too many samples, or at a time that cannot tell samples apart.
    #[error(
        "a step to t = {end_s} s is refused: it has more than a million samples of {period_s} s, or t is too \
         large to tell them apart; make the step shorter"
    )]
    Step {
        /// End of the step, s.
        end_s: f64,
        /// Sampling period, s.
        period_s: f64,
    },
    /// Breakpoints that go back in time.
    #[error(
        "command{number}_time = {time_s} s is refused: it must not be before the time of the breakpoint \
         before, {before_s} s, or must be 0 if the breakpoint is unused"
    )]
    Breakpoint {
        /// Number of the breakpoint.
        number: usize,
        /// Its time, s.
        time_s: f64,
        /// That of the one before, s.
        before_s: f64,
    },
    /// A trim outside the limits of the commands.
    #[error("{variable} = {value} is refused: the commands are limited to [{low}, {high}]")]
    Trim {
        /// Name of the parameter.
        variable: &'static str,
        /// Its value, rad or 1.
        value: f64,
        /// Smallest command, rad or 1.
        low: f64,
        /// Largest command, rad or 1.
        high: f64,
    },
}

impl ModelError for Error {
    fn remedy(&self) -> Remedy {
        match self {
            Self::Step { .. } => Remedy::ShorterStep,
            _ => Remedy::Reset,
        }
    }
}

fn list(periods_s: &[f64]) -> String {
    let texts: Vec<_> = periods_s.iter().map(|period| format!("{period} s")).collect();
    texts.join(", ")
}
