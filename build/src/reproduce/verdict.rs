//! What can be said of a number or a claim of the paper.

use serde::Serialize;

/// Limits, per cent, that "reproduced within" is quoted in; what is beyond the last is not
/// reproduced. The paper prints three to five digits and omits half of its data.
const WITHIN: [f64; 6] = [0.1, 0.5, 1.0, 2.0, 5.0, 10.0];
/// Below this, rad/s, a value is a zero that rounding has touched.
const ZERO: f64 = 1e-6;

#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "verdict", rename_all = "snake_case")]
pub enum Verdict {
    /// A number within so many per cent, or a claim as it stands.
    Reproduced {
        within_percent: Option<f64>,
    },
    /// Right direction, other size.
    SignOnly {
        because: String,
    },
    NotReproduced {
        because: String,
    },
    /// No vehicle under the printed equations can have this number.
    Impossible {
        erratum: u8,
    },
}

impl Verdict {
    pub const CLAIMED: Self = Self::Reproduced { within_percent: None };

    /// Compares a number; `because` explains what is off. `signed` says that the sign means
    /// something: that of a frequency does not.
    pub fn of(paper: f64, ours: Option<f64>, signed: bool, because: &str) -> Self {
        let because = because.to_string();
        let Some(ours) = ours else { return Self::NotReproduced { because } };
        if paper == 0.0 && ours.abs() < ZERO {
            return Self::Reproduced { within_percent: Some(0.0) };
        }
        let percent = difference(paper, ours).map_or(f64::INFINITY, |d| 100.0 * d.abs());
        match WITHIN.into_iter().find(|limit| percent <= *limit) {
            Some(limit) => Self::Reproduced { within_percent: Some(limit) },
            None if signed && ours * paper > 0.0 && ours.abs() > ZERO => Self::SignOnly { because },
            None => Self::NotReproduced { because },
        }
    }

    /// In words. The mark in front lets the eye find its way, also without colour.
    pub fn text(&self) -> String {
        match self {
            Self::Reproduced { within_percent: None } => "✓ reproduced".into(),
            Self::Reproduced { within_percent: Some(0.0) } => "✓ reproduced: both 0".into(),
            Self::Reproduced { within_percent: Some(limit) } => {
                format!("✓ reproduced within {limit} %")
            }
            Self::SignOnly { because } => format!("◐ in sign only: {because}"),
            Self::NotReproduced { because } => format!("✗ not reproduced: {because}"),
            Self::Impossible { erratum } => {
                format!("∅ cannot come from the equations: erratum {erratum}")
            }
        }
    }

    /// Why not, if it is a matter of reasons.
    pub fn because(&self) -> Option<&str> {
        match self {
            Self::SignOnly { because } | Self::NotReproduced { because } => Some(because),
            _ => None,
        }
    }

    /// Column in a count of verdicts.
    pub fn rank(&self) -> usize {
        match self {
            Self::Reproduced { .. } => 0,
            Self::SignOnly { .. } => 1,
            Self::NotReproduced { .. } => 2,
            Self::Impossible { .. } => 3,
        }
    }
}

/// Names of the ranks.
pub const RANKS: [&str; 4] =
    ["✓ reproduced", "◐ in sign only", "✗ not reproduced", "∅ impossible: erratum"];

/// ours/paper - 1: positive if ours is larger in size, below -1 if the sign differs; none where the
/// paper prints 0.
pub fn difference(paper: f64, ours: f64) -> Option<f64> {
    (paper != 0.0).then(|| ours / paper - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rank(paper: f64, ours: f64, signed: bool) -> usize {
        Verdict::of(paper, Some(ours), signed, "").rank()
    }

    #[test]
    fn verdicts_follow_size_and_sign() {
        let within = |limit| Verdict::Reproduced { within_percent: Some(limit) };
        assert_eq!(Verdict::of(19.72, Some(19.721), true, ""), within(0.1));
        assert_eq!(Verdict::of(-2.0, Some(-2.09), true, ""), within(5.0));
        assert_eq!(Verdict::of(0.0, Some(1e-9), true, ""), within(0.0));
        assert_eq!(rank(3.173, 1.7, true), 1);
        assert_eq!(rank(3.173, -3.173, true), 2);
        assert_eq!(rank(0.0238, 0.0376, false), 2, "frequencies are positive by definition");
        assert_eq!(rank(-2e-4, -1e-12, true), 2, "rounding has no sign");
        assert_eq!(rank(0.0, 0.5, true), 2);
        assert_eq!(Verdict::of(1.0, None, true, "").rank(), 2);
    }

    #[test]
    fn differences_compare_sizes() {
        assert_eq!(difference(-2.0, -3.0), Some(0.5));
        assert_eq!(difference(-2.0, 2.0), Some(-2.0));
        assert_eq!(difference(0.0, 1.0), None);
    }
}
