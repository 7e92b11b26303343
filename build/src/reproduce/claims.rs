//! What the paper concludes from figs 6 to 8, claim by claim.

use super::roots::Name;
use super::sweep::{Branch, Sweep};
use super::verdict::Verdict;
use nalgebra::Complex;
use serde::Serialize;

/// Relative change, against the start, below which something "hardly moves".
const HARDLY: f64 = 0.02;
/// Above this, a change is more than slight, and at least substantial.
const SUBSTANTIAL: f64 = 0.1;
/// Twice substantial and more: no longer "slight" in any reading.
const SLIGHT: f64 = 0.2;
/// The sloshing frequencies of claims (g) to (j), rad/s.
const NEAR: f64 = 5.0;
const FAST: f64 = 20.0;

/// What the claims are tested on.
pub struct Evidence<'a> {
    pub fuel: &'a Sweep,
    pub damping: &'a Sweep,
    pub frequency: &'a Sweep,
}

/// A number at the start and at the end of the way that a claim speaks of, rad/s.
#[derive(Debug, Clone, Serialize)]
pub struct Measure {
    pub what: String,
    pub start: f64,
    pub end: f64,
    /// (end - start)/|start|.
    pub change: f64,
}

#[derive(Debug, Clone, Serialize)]
pub struct Outcome {
    #[serde(flatten)]
    pub verdict: Verdict,
    pub measures: Vec<Measure>,
}

pub struct Claim {
    pub id: char,
    /// Where the paper says it.
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
        test: frequencies_rise,
    },
    Claim {
        id: 'b',
        source: FUEL,
        text: "The unstable short-period pole moves slightly to the right.",
        test: pole_moves_right,
    },
    Claim {
        id: 'c',
        source: FUEL,
        text: "The right-half-plane zero moves away from the imaginary axis.",
        test: |evidence| zero_moves_away(evidence.fuel),
    },
    Claim {
        id: 'd',
        source: DAMPER,
        text: "The flexible mode settles faster.",
        test: settles_faster,
    },
    Claim {
        id: 'e',
        source: DAMPER,
        text: "The right-half-plane zero moves away from the imaginary axis.",
        test: |evidence| zero_moves_away(evidence.damping),
    },
    Claim { id: 'f', source: DAMPER, text: "The other modes hardly move.", test: others_stay },
    Claim {
        id: 'g',
        source: SPRING,
        text: "Near 5 rad/s the short-period poles move towards the axis.",
        test: poles_approach,
    },
    Claim { id: 'h', source: SPRING, text: "Beyond it they change little.", test: poles_stay },
    Claim {
        id: 'i',
        source: SPRING,
        text: "From 20 rad/s on, the poles of the first flexible mode move to the left.",
        test: flexible_moves_left,
    },
    Claim {
        id: 'j',
        source: SPRING,
        text: "The right-half-plane zero moves towards the imaginary axis.",
        test: zero_approaches,
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

const SHORT_PERIOD: [Name; 2] = [Name::UnstableShortPeriod, Name::StableShortPeriod];

type Part = fn(Complex<f64>) -> f64;
const RE: Part = |value| value.re;
const IM: Part = |value| value.im;
/// Distance from the imaginary axis.
const OFF: Part = |value| value.re.abs();

fn measure(what: &str, branch: &Branch, part: Part, steps: [usize; 2]) -> Measure {
    let [start, end] = steps.map(|step| part(branch.values[step]));
    let change = if start == 0.0 { 0.0 } else { (end - start) / start.abs() };
    Measure { what: format!("{}: {what}", branch.name), start, end, change }
}

fn whole(sweep: &Sweep) -> [usize; 2] {
    [0, sweep.steps.len() - 1]
}

fn percent(change: f64) -> String {
    format!("{:+.1} %", 100.0 * change)
}

/// The poles of some names, over some steps.
fn poles(sweep: &Sweep, names: &[Name], what: &str, part: Part, steps: [usize; 2]) -> Vec<Measure> {
    let branches = names.iter().filter_map(|name| sweep.pole(*name));
    branches.map(|branch| measure(what, branch, part, steps)).collect()
}

fn not(because: impl Into<String>) -> Verdict {
    Verdict::NotReproduced { because: because.into() }
}

fn sign_only(because: impl Into<String>) -> Verdict {
    Verdict::SignOnly { because: because.into() }
}

/// A claim of a direction: `change` is positive if it is met, and has to be more than `least`.
fn direction(change: Option<f64>, least: f64, otherwise: &str) -> Verdict {
    match change {
        None => not("there is no such pole or zero at the start of the way"),
        Some(change) if change >= least => Verdict::CLAIMED,
        Some(change) if change > 0.0 => sign_only(format!("by {} only", percent(change))),
        Some(change) => not(format!("{otherwise}, by {:.1} %", 100.0 * change.abs())),
    }
}

fn smallest(measures: &[Measure], sign: f64) -> Option<f64> {
    measures.iter().map(|m| sign * m.change).min_by(f64::total_cmp)
}

fn largest(measures: &[Measure]) -> Option<&Measure> {
    measures.iter().max_by(|a, b| a.change.abs().total_cmp(&b.change.abs()))
}

fn frequencies_rise(evidence: &Evidence) -> Outcome {
    let names = [0, 1, 2].map(Name::Flexible);
    let measures = poles(evidence.fuel, &names, "frequency", IM, whole(evidence.fuel));
    let verdict = direction(smallest(&measures, 1.0), HARDLY, "a frequency falls");
    Outcome { verdict, measures }
}

fn pole_moves_right(evidence: &Evidence) -> Outcome {
    let names = [Name::UnstableShortPeriod];
    let measures = poles(evidence.fuel, &names, "pole", RE, whole(evidence.fuel));
    let change = smallest(&measures, 1.0);
    let verdict = match change {
        Some(change) if change > SLIGHT => {
            sign_only(format!("by {}, more than slightly", percent(change)))
        }
        change => direction(change, 0.0, "it moves to the left"),
    };
    Outcome { verdict, measures }
}

fn zero_moves_away(sweep: &Sweep) -> Outcome {
    let mut measures = Vec::new();
    for name in [Name::RightZero, Name::LeftZero] {
        measures.extend(sweep.zero(name).map(|b| measure("off the axis", b, OFF, whole(sweep))));
    }
    let change = measures.first().map(|m| m.change);
    let verdict = direction(change, HARDLY, "it moves towards the axis");
    // The paper may mean the complex zeros by "the zero": they are shown, and not judged.
    for name in [Name::Slosh(0), Name::Slosh(1), Name::Flexible(0)] {
        let branch = sweep.zero(name);
        measures.extend(branch.map(|b| measure("zero off the axis", b, OFF, whole(sweep))));
    }
    Outcome { verdict, measures }
}

fn settles_faster(evidence: &Evidence) -> Outcome {
    let names = [0, 1, 2].map(Name::Flexible);
    let measures = poles(evidence.damping, &names, "rate of decay", OFF, whole(evidence.damping));
    let first = measures.first().map(|m| m.change);
    let verdict = direction(first, HARDLY, "it settles more slowly");
    Outcome { verdict, measures }
}

fn others_stay(evidence: &Evidence) -> Outcome {
    let sweep = evidence.damping;
    let names =
        [SHORT_PERIOD[0], SHORT_PERIOD[1], Name::Phugoid, Name::Flexible(1), Name::Flexible(2)];
    let measures = poles(sweep, &names, "distance from the origin", |v| v.norm(), whole(sweep));
    Outcome { verdict: little(&measures), measures }
}

fn poles_approach(evidence: &Evidence) -> Outcome {
    let sweep = evidence.frequency;
    let near = sweep.step_at(NEAR);
    let measures = poles(sweep, &SHORT_PERIOD, "off the axis, 2 to 5 rad/s", OFF, [0, near]);
    let verdict = match smallest(&measures, -1.0) {
        Some(change) if change < 0.0 => {
            let farthest = largest(&measures).map_or(0.0, |m| m.change);
            not(format!(
                "they move away from it, by {:.1} % at most: real poles have no frequency to \
                 meet that of the liquid",
                100.0 * farthest.abs()
            ))
        }
        change => direction(change, HARDLY, "the poles move away"),
    };
    Outcome { verdict, measures }
}

fn poles_stay(evidence: &Evidence) -> Outcome {
    let sweep = evidence.frequency;
    let steps = [sweep.step_at(NEAR), sweep.steps.len() - 1];
    let measures = poles(sweep, &SHORT_PERIOD, "off the axis, from 5 rad/s on", OFF, steps);
    Outcome { verdict: little(&measures), measures }
}

fn little(measures: &[Measure]) -> Verdict {
    match largest(measures) {
        None => not("there are no such poles"),
        Some(m) if m.change.abs() <= HARDLY => Verdict::CLAIMED,
        Some(m) if m.change.abs() <= SUBSTANTIAL => {
            sign_only(format!("little, but {} changes by {}", m.what, percent(m.change)))
        }
        Some(m) => not(format!("{} changes by {}", m.what, percent(m.change))),
    }
}

fn flexible_moves_left(evidence: &Evidence) -> Outcome {
    let sweep = evidence.frequency;
    let steps = [sweep.step_at(FAST), sweep.steps.len() - 1];
    let names = [Name::Flexible(0)];
    let mut measures = poles(sweep, &names, "rate of decay, from 20 rad/s on", OFF, steps);
    let verdict = direction(smallest(&measures, 1.0), HARDLY, "they move to the right");
    let before = [0, sweep.step_at(FAST)];
    measures.extend(poles(sweep, &names, "rate of decay, 2 to 20 rad/s", OFF, before));
    if let Some(branch) = sweep.pole(Name::Flexible(0)) {
        let [start, end] = steps.map(|step| branch.slosh[step]);
        let change = (end - start) / start;
        measures.push(Measure { what: "share of slosh in its energy".into(), start, end, change });
    }
    Outcome { verdict, measures }
}

fn zero_approaches(evidence: &Evidence) -> Outcome {
    let sweep = evidence.frequency;
    let Some(zero) = sweep.zero(Name::RightZero) else {
        return Outcome { verdict: direction(None, 0.0, ""), measures: Vec::new() };
    };
    let measures = vec![
        measure("whole way", zero, OFF, whole(sweep)),
        measure("from 20 rad/s on", zero, OFF, [sweep.step_at(FAST), sweep.steps.len() - 1]),
    ];
    // Both: a zero that comes back at the end does not narrow the band there.
    let verdict = match measures[1].change < 0.0 {
        true => direction(Some(-measures[0].change), HARDLY, "it moves away"),
        false => not(format!("from 20 rad/s on it moves away, by {}", percent(measures[1].change))),
    };
    Outcome { verdict, measures }
}
