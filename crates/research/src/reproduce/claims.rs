//! The conclusions of the paper from figs 6 to 8, claim by claim.

mod criteria;

use super::inertia_laws::Laws;
use super::sweep::Sweep;
use super::verdict::Verdict;
pub use criteria::{HARDLY, SLIGHT};
use serde::Serialize;

/// Results on which the claims are tested.
pub struct Evidence<'a> {
    pub fuel: &'a Sweep,
    pub damping: &'a Sweep,
    pub frequency: &'a Sweep,
    pub laws: &'a Laws,
}

/// A number at the start and at the end of the range of a claim, rad/s.
#[derive(Debug, Clone, Serialize)]
pub struct Measure {
    pub what: String,
    pub start: f64,
    pub end: f64,
    /// (end - start)/|start|.
    pub change: f64,
    /// Whether at every step it is on the same side of its start as at the end.
    pub steady: bool,
}

#[derive(Debug, Clone, Serialize)]
pub struct Outcome {
    #[serde(flatten)]
    pub verdict: Verdict,
    pub measures: Vec<Measure>,
    /// A qualification of the verdict.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

pub struct Claim {
    pub id: char,
    /// Place in the paper.
    pub source: &'static str,
    pub text: &'static str,
    pub test: fn(&Evidence) -> Outcome,
}

/// A claim with its outcome.
#[derive(Debug, Clone, Serialize)]
pub struct Tested {
    pub id: char,
    pub source: &'static str,
    pub text: &'static str,
    #[serde(flatten)]
    pub outcome: Outcome,
}

const FUEL: &str = "fig. 6: less propellant";
const DAMPER: &str = "fig. 7: slosh damping 0.05 to 0.3, half fuel";
const SPRING: &str = "fig. 8: slosh frequency rising, half fuel";

/// The ten claims.
pub const CLAIMS: [Claim; 10] = [
    Claim {
        id: 'a',
        source: FUEL,
        text: "The vibration frequencies rise.",
        test: criteria::frequencies_rise,
    },
    Claim {
        id: 'b',
        source: FUEL,
        text: "The unstable short-period pole moves slightly to the right.",
        test: criteria::pole_moves_right,
    },
    Claim {
        id: 'c',
        source: FUEL,
        text: "The right-half-plane zero moves away from the imaginary axis.",
        test: |evidence| criteria::zero_moves_away(evidence.fuel),
    },
    Claim {
        id: 'd',
        source: DAMPER,
        text: "The flexible mode settles faster.",
        test: criteria::settles_faster,
    },
    Claim {
        id: 'e',
        source: DAMPER,
        text: "The right-half-plane zero moves away from the imaginary axis.",
        test: |evidence| criteria::zero_moves_away(evidence.damping),
    },
    Claim {
        id: 'f',
        source: DAMPER,
        text: "The other modes hardly move.",
        test: criteria::others_stay,
    },
    Claim {
        id: 'g',
        source: SPRING,
        text: "Near 5 rad/s the short-period poles move towards the axis.",
        test: criteria::poles_approach,
    },
    Claim {
        id: 'h',
        source: SPRING,
        text: "Beyond it they change little.",
        test: criteria::poles_stay,
    },
    Claim {
        id: 'i',
        source: SPRING,
        text: "From 20 rad/s on, the poles of the first flexible mode move to the left.",
        test: criteria::flexible_moves_left,
    },
    Claim {
        id: 'j',
        source: SPRING,
        text: "The right-half-plane zero moves towards the imaginary axis.",
        test: criteria::zero_approaches,
    },
];

/// Tests all claims.
pub fn test(evidence: &Evidence) -> Vec<Tested> {
    CLAIMS
        .iter()
        .map(|claim| Tested {
            id: claim.id,
            source: claim.source,
            text: claim.text,
            outcome: (claim.test)(evidence),
        })
        .collect()
}
