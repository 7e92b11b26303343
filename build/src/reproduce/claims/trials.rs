//! How each claim is tested: direction first, then size.

use super::{Evidence, Measure, Outcome};
use crate::reproduce::markdown::percent;
use crate::reproduce::roots::Name;
use crate::reproduce::sweep::{Branch, Sweep};
use crate::reproduce::verdict::Verdict;
use nalgebra::Complex;

/// Relative change, against the start, below which something "hardly moves".
pub const HARDLY: f64 = 0.02;
/// Above this, a change is more than slight, and at least substantial.
const SUBSTANTIAL: f64 = 0.1;
/// Twice substantial and more: no longer "slight" in any reading.
pub const SLIGHT: f64 = 0.2;
/// The sloshing frequencies of claims (g) to (j), rad/s.
const NEAR: f64 = 5.0;
const FAST: f64 = 20.0;

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

pub fn frequencies_rise(evidence: &Evidence) -> Outcome {
    let names = [0, 1, 2].map(Name::Flexible);
    let measures = poles(evidence.fuel, &names, "frequency", IM, whole(evidence.fuel));
    let verdict = direction(smallest(&measures, 1.0), HARDLY, "a frequency falls");
    Outcome { verdict, measures, note: None }
}

pub fn pole_moves_right(evidence: &Evidence) -> Outcome {
    let names = [Name::UnstableShortPeriod];
    let measures = poles(evidence.fuel, &names, "pole", RE, whole(evidence.fuel));
    let change = smallest(&measures, 1.0);
    let verdict = match change {
        Some(change) if change > SLIGHT => {
            sign_only(format!("by {}, more than slightly", percent(change)))
        }
        change => direction(change, 0.0, "it moves to the left"),
    };
    Outcome { verdict, measures, note: None }
}

pub fn zero_moves_away(sweep: &Sweep) -> Outcome {
    let mut measures = Vec::new();
    for name in [Name::RightZero, Name::LeftZero] {
        measures.extend(sweep.zero(name).map(|b| measure("off the axis", b, OFF, whole(sweep))));
    }
    let change = measures.first().map(|m| m.change);
    let verdict = direction(change, HARDLY, "it moves towards the axis");
    // The paper may mean the complex zeros by "the zero": they are shown, and not judged.
    let first = measures.len();
    for name in [Name::Slosh(0), Name::Slosh(1), Name::Flexible(0)] {
        let branch = sweep.zero(name);
        measures.extend(branch.map(|b| measure("zero off the axis", b, OFF, whole(sweep))));
    }
    let away = measures.len() > first && measures[first..].iter().all(|m| m.change > HARDLY);
    let note = (verdict != Verdict::CLAIMED && away).then(|| {
        let all: Vec<_> = measures[first..].iter().map(|m| percent(m.change)).collect();
        format!(
            "If the complex zeros of slosh and first flexible mode are meant, it holds: they move \
             away from the axis by {}.",
            all.join(", ")
        )
    });
    Outcome { verdict, measures, note }
}

pub fn settles_faster(evidence: &Evidence) -> Outcome {
    let names = [0, 1, 2].map(Name::Flexible);
    let measures = poles(evidence.damping, &names, "rate of decay", OFF, whole(evidence.damping));
    let first = measures.first().map(|m| m.change);
    let verdict = direction(first, HARDLY, "it settles more slowly");
    Outcome { verdict, measures, note: None }
}

pub fn others_stay(evidence: &Evidence) -> Outcome {
    let sweep = evidence.damping;
    let names =
        [SHORT_PERIOD[0], SHORT_PERIOD[1], Name::Phugoid, Name::Flexible(1), Name::Flexible(2)];
    let measures = poles(sweep, &names, "distance from the origin", |v| v.norm(), whole(sweep));
    Outcome { verdict: little(&measures), measures, note: None }
}

pub fn poles_approach(evidence: &Evidence) -> Outcome {
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
    Outcome { verdict, measures, note: None }
}

pub fn poles_stay(evidence: &Evidence) -> Outcome {
    let sweep = evidence.frequency;
    let steps = [sweep.step_at(NEAR), sweep.steps.len() - 1];
    let measures = poles(sweep, &SHORT_PERIOD, "off the axis, from 5 rad/s on", OFF, steps);
    Outcome { verdict: little(&measures), measures, note: None }
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

pub fn flexible_moves_left(evidence: &Evidence) -> Outcome {
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
    let note = beam_at_the_end(sweep).map(|beam| {
        let now = measure("rate of decay of the branch that ends as beam", beam, OFF, steps);
        let note = format!(
            "The branch is followed through the exchange of modes and ends mostly liquid. The \
             branch that starts as {} ends mostly beam, {:.0} % liquid, and its rate of decay \
             changes by {} over the same range: the claim is true of the branch, not of \
             whichever mode bends the beam most.",
            beam.name,
            100.0 * beam.slosh[steps[1]],
            percent(now.change)
        );
        measures.push(now);
        note
    });
    Outcome { verdict, measures, note }
}

/// The slosh branch that is more beam at the end of a sweep than the first flexible one.
fn beam_at_the_end(sweep: &Sweep) -> Option<&Branch> {
    let last = sweep.steps.len() - 1;
    let liquid = |branch: &Branch| branch.slosh.get(last).copied().unwrap_or(1.0);
    let flexible = liquid(sweep.pole(Name::Flexible(0))?);
    let slosh = [0, 1].into_iter().filter_map(|i| sweep.pole(Name::Slosh(i)));
    slosh.filter(|b| liquid(b) < flexible).min_by(|a, b| liquid(a).total_cmp(&liquid(b)))
}

pub fn zero_approaches(evidence: &Evidence) -> Outcome {
    let sweep = evidence.frequency;
    let Some(zero) = sweep.zero(Name::RightZero) else {
        return Outcome { verdict: direction(None, 0.0, ""), measures: Vec::new(), note: None };
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
    Outcome { verdict, measures, note: None }
}
