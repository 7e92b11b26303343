//! Verdicts on numbers and claims of the paper.

use serde::Serialize;

/// Kind of number, which determines the error limit for "reproduced", per cent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// Table 1, from which the structure is identified.
    Identified,
    /// Imaginary parts of poles and zeros.
    Frequency,
    /// Real poles and zeros.
    Real,
    /// Real parts of pairs.
    Damping,
}

impl Aim {
    pub const ALL: [Self; 4] = [Self::Identified, Self::Frequency, Self::Real, Self::Damping];

    pub fn percent(self) -> f64 {
        match self {
            Self::Identified => 0.1,
            Self::Frequency => 2.0,
            Self::Real => 5.0,
            Self::Damping => 10.0,
        }
    }

    pub fn of_what(self) -> &'static str {
        match self {
            Self::Identified => "natural frequencies of Table 1",
            Self::Frequency => "imaginary parts",
            Self::Real => "real poles and zeros",
            Self::Damping => "real parts of pairs",
        }
    }
}

/// A number is near if its error is within this factor of its limit.
pub const NEAR: f64 = 2.0;
/// Smaller values are zeros with rounding errors, rad/s.
const ZERO: f64 = 1e-6;

#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "verdict", rename_all = "snake_case")]
pub enum Verdict {
    /// A number within this many per cent, or a claim.
    Reproduced {
        within_percent: Option<f64>,
        /// Size of the claimed change.
        #[serde(skip_serializing_if = "Option::is_none")]
        by: Option<String>,
    },
    /// Within [`NEAR`] times its limit.
    Near {
        within_percent: f64,
        because: String,
    },
    /// Right direction, other size.
    SignOnly {
        because: String,
    },
    NotReproduced {
        because: String,
    },
    /// No vehicle under eqs (3)-(4) has this number, as a test of the erratum proves.
    Impossible {
        erratum: u8,
    },
}

impl Verdict {
    pub const CLAIMED: Self = Self::Reproduced { within_percent: None, by: None };

    /// Compares a number; `because` is the reason of a difference. `signed` is false for frequencies, whose sign
    /// has no meaning.
    pub fn of(paper: f64, ours: Option<f64>, aim: Aim, signed: bool, because: &str) -> Self {
        let because = because.to_string();
        let Some(ours) = ours else { return Self::NotReproduced { because } };
        if paper == 0.0 && ours.abs() < ZERO {
            return Self::within(0.0);
        }
        let percent = difference(paper, ours).map_or(f64::INFINITY, |d| 100.0 * d.abs());
        let (limit, near) = (aim.percent(), NEAR * aim.percent());
        if percent <= limit {
            Self::within(limit)
        } else if percent <= near {
            Self::Near { within_percent: near, because }
        } else if signed && ours * paper > 0.0 && ours.abs() > ZERO {
            Self::SignOnly { because }
        } else {
            Self::NotReproduced { because }
        }
    }

    fn within(percent: f64) -> Self {
        Self::Reproduced { within_percent: Some(percent), by: None }
    }

    /// Text with a symbol in front, which is recognisable without colour.
    pub fn text(&self) -> String {
        match self {
            Self::Reproduced { by: Some(size), .. } => format!("✓ reproduced, by {size}"),
            Self::Reproduced { within_percent: None, .. } => "✓ reproduced".into(),
            Self::Reproduced { within_percent: Some(0.0), .. } => "✓ reproduced: both 0".into(),
            Self::Reproduced { within_percent: Some(limit), .. } => {
                format!("✓ reproduced within {limit} %")
            }
            Self::Near { within_percent, because } => {
                format!("≈ near, within {within_percent} %: {because}")
            }
            Self::SignOnly { because } => format!("◐ in sign only: {because}"),
            Self::NotReproduced { because } => format!("✗ not reproduced: {because}"),
            Self::Impossible { erratum } => {
                format!("∅ not by eqs (3)-(4): erratum {erratum}")
            }
        }
    }

    /// The reason, if the verdict has one.
    pub fn because(&self) -> Option<&str> {
        match self {
            Self::Near { because, .. }
            | Self::SignOnly { because }
            | Self::NotReproduced { because } => Some(because),
            _ => None,
        }
    }

    /// Column in a count of verdicts.
    pub fn rank(&self) -> usize {
        match self {
            Self::Reproduced { .. } => 0,
            Self::Near { .. } => 1,
            Self::SignOnly { .. } => 2,
            Self::NotReproduced { .. } => 3,
            Self::Impossible { .. } => 4,
        }
    }
}

/// Names of the ranks.
pub const RANKS: [&str; 5] =
    ["✓ reproduced", "≈ near", "◐ in sign only", "✗ not reproduced", "∅ not by eqs (3)-(4)"];

/// ours/paper - 1: positive if ours is larger in size, below -1 if the sign differs; `None` where the
/// paper prints 0.
pub fn difference(paper: f64, ours: f64) -> Option<f64> {
    (paper != 0.0).then(|| ours / paper - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rank(paper: f64, ours: f64, signed: bool) -> usize {
        Verdict::of(paper, Some(ours), Aim::Real, signed, "").rank()
    }

    #[test]
    fn verdicts_follow_size_and_sign() {
        let within = Verdict::within;
        assert_eq!(Verdict::of(19.72, Some(19.721), Aim::Identified, false, ""), within(0.1));
        assert_eq!(Verdict::of(-2.0, Some(-2.09), Aim::Real, true, ""), within(5.0));
        assert_eq!(Verdict::of(0.0, Some(1e-9), Aim::Real, true, ""), within(0.0));
        assert_eq!(rank(1.0, 1.049, true), 0);
        assert_eq!(rank(1.0, 1.051, true), 1, "beyond its aim");
        assert_eq!(rank(1.0, 1.101, true), 2, "beyond twice its aim");
        assert_eq!(rank(3.173, -3.173, true), 3);
        assert_eq!(rank(0.0238, 0.0376, false), 3, "frequencies are positive by definition");
        assert_eq!(rank(-2e-4, -1e-12, true), 3, "rounding has no sign");
        assert_eq!(rank(0.0, 0.5, true), 3);
        assert_eq!(Verdict::of(1.0, None, Aim::Real, true, "").rank(), 3);
    }

    #[test]
    fn differences_compare_sizes() {
        assert_eq!(difference(-2.0, -3.0), Some(0.5));
        assert_eq!(difference(-2.0, 2.0), Some(-2.0));
        assert_eq!(difference(0.0, 1.0), None);
    }
}
