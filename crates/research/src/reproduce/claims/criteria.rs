//! The criterion of each claim. A claimed direction holds if, at every step of the sweep, every root concerned
//! is on the claimed side of its start; the size of the change is stated but not judged. Only the words
//! "slightly", "little" and "hardly" have limits.

use super::{Evidence, Measure, Outcome};
use crate::reproduce::inertia_laws::{Law, Laws};
use crate::reproduce::markdown::percent;
use crate::reproduce::roots::Name;
use crate::reproduce::sweep::{Branch, Sweep};
use crate::reproduce::verdict::Verdict;
use nalgebra::Complex;

/// Relative change from the start below which something "hardly moves".
pub const HARDLY: f64 = 0.02;
/// Relative change above which something no longer changes "little".
const SUBSTANTIAL: f64 = 0.1;
/// Relative change above which something no longer moves "slightly".
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

/// Whether all values are on the same side of the first as the last one.
fn steady(values: &[f64]) -> bool {
    let [start, rest @ ..] = values else { return true };
    let end = rest.last().unwrap_or(start);
    rest.iter().all(|value| (value - start) * (end - start) > 0.0)
}

fn measure(what: &str, branch: &Branch, part: Part, steps: [usize; 2]) -> Measure {
    let values: Vec<f64> =
        branch.values[steps[0]..=steps[1]].iter().map(|value| part(*value)).collect();
    measured(format!("{}: {what}", branch.name), &values)
}

fn measured(what: String, values: &[f64]) -> Measure {
    let (start, end) = (values[0], values[values.len() - 1]);
    let change = if start == 0.0 { 0.0 } else { (end - start) / start.abs() };
    Measure { what, start, end, change, steady: steady(values) }
}

fn whole(sweep: &Sweep) -> [usize; 2] {
    [0, sweep.steps.len() - 1]
}

/// Measures of poles between two steps.
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

/// A claim that numbers grow (`sign` 1) or shrink (-1).
fn direction(measures: &[Measure], sign: f64, otherwise: &str) -> Verdict {
    let mut changes: Vec<f64> = measures.iter().map(|measure| measure.change).collect();
    changes.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let (Some(least), Some(most)) = (changes.first(), changes.last()) else {
        return not("there is no such pole or zero at the start of the range");
    };
    let against = changes.iter().rfind(|change| sign * **change <= 0.0);
    if let Some(change) = against {
        return not(format!("{otherwise}, by {:.1} %", 100.0 * change.abs()));
    }
    if measures.iter().any(|measure| !measure.steady) {
        return sign_only("at the end; in between it is on the other side of its start");
    }
    let (least, most) = (percent(*least), percent(*most));
    let by = if least == most { most } else { format!("{least} to {most}") };
    Verdict::Reproduced { within_percent: None, by: Some(by) }
}

fn largest(measures: &[Measure]) -> Option<&Measure> {
    measures.iter().max_by(|a, b| a.change.abs().total_cmp(&b.change.abs()))
}

pub fn frequencies_rise(evidence: &Evidence) -> Outcome {
    let names = [0, 1, 2].map(Name::Flexible);
    let measures = poles(evidence.fuel, &names, "frequency", IM, whole(evidence.fuel));
    let verdict = direction(&measures, 1.0, "a frequency falls");
    Outcome { verdict, measures, note: None }
}

pub fn pole_moves_right(evidence: &Evidence) -> Outcome {
    let names = [Name::UnstableShortPeriod];
    let mut measures = poles(evidence.fuel, &names, "pole", RE, whole(evidence.fuel));
    let verdict = match measures.first().map(|measure| measure.change) {
        Some(change) if change > SLIGHT => {
            sign_only(format!("by {}, more than slightly", percent(change)))
        }
        _ => direction(&measures, 1.0, "it moves to the left"),
    };
    let Laws { laws, .. } = evidence.laws;
    let of = |law: &Law| measured(format!("the same, {}", law.name), &law.poles);
    // The first law is that of the sweep.
    measures.extend(laws.iter().skip(1).map(of));
    Outcome { verdict, measures, note: Some(laws_in_words(evidence.laws)) }
}

fn laws_in_words(of: &Laws) -> String {
    let each: Vec<_> =
        of.laws.iter().map(|law| format!("{}: {}", law.name, percent(law.change()))).collect();
    let share = |ratio: f64| format!("{:.0} %", 100.0 * ratio);
    let needs = match (of.still, of.slight) {
        (Some(still), Some(slight)) => format!(
            "\"Slightly to the right\" requires an inertia of the empty vehicle of {} to {} of the full one",
            share(slight),
            share(still)
        ),
        _ => "No inertia moves it slightly to the right".into(),
    };
    format!(
        "The result depends on how inertia and mass centre vary with fuel: {}. {needs}; the densities give {}, and \
         the paper does not say what it uses.",
        each.join("; "),
        share(of.empty_over_full)
    )
}

pub fn zero_moves_away(sweep: &Sweep) -> Outcome {
    let mut measures = Vec::new();
    for name in [Name::RightZero, Name::LeftZero] {
        measures.extend(sweep.zero(name).map(|b| measure("off the axis", b, OFF, whole(sweep))));
    }
    let right = &measures[..measures.len().min(1)];
    let verdict = direction(right, 1.0, "it moves towards the axis");
    // "The zero" of the paper may mean the complex zeros: they are shown but not judged.
    let first = measures.len();
    for name in [Name::Slosh(0), Name::Slosh(1), Name::Flexible(0)] {
        let branch = sweep.zero(name);
        measures.extend(branch.map(|b| measure("zero off the axis", b, OFF, whole(sweep))));
    }
    let complex = &measures[first..];
    let away = direction(complex, 1.0, "");
    let missed = matches!(verdict, Verdict::NotReproduced { .. });
    let note = match away {
        Verdict::Reproduced { by: Some(by), .. } if missed => Some(format!(
            "The claim holds for the complex zeros of slosh and first flexible mode: they move away from \
             the axis, by {by}."
        )),
        _ => None,
    };
    Outcome { verdict, measures, note }
}

pub fn settles_faster(evidence: &Evidence) -> Outcome {
    let names = [0, 1, 2].map(Name::Flexible);
    let measures = poles(evidence.damping, &names, "rate of decay", OFF, whole(evidence.damping));
    let first = &measures[..measures.len().min(1)];
    let verdict = direction(first, 1.0, "it settles more slowly");
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
    let mut measures = poles(sweep, &SHORT_PERIOD, "off the axis, 2 to 5 rad/s", OFF, [0, near]);
    let to_there = direction(&measures, -1.0, "they move away from it");
    measures.extend(poles(sweep, &SHORT_PERIOD, "off the axis, whole range", OFF, whole(sweep)));
    // Both: poles that come back after 5 rad/s do not move gradually towards the axis.
    let verdict = match direction(&measures, -1.0, "they move away from it") {
        Verdict::Reproduced { .. } => to_there,
        other => other,
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
    let verdict = direction(&measures, 1.0, "they move to the right");
    let before = [0, sweep.step_at(FAST)];
    measures.extend(poles(sweep, &names, "rate of decay, 2 to 20 rad/s", OFF, before));
    if let Some(branch) = sweep.pole(Name::Flexible(0)) {
        let share = &branch.slosh[steps[0]..=steps[1]];
        measures.push(measured("share of slosh in its energy".into(), share));
    }
    let note = beam_at_the_end(sweep).map(|beam| {
        let now = measure("rate of decay of the branch that ends mostly beam", beam, OFF, steps);
        let note = format!(
            "The branch is tracked through the veering of the modes and ends mostly liquid. The \
             branch that starts as {} ends mostly beam, {:.0} % liquid, and its rate of decay \
             changes by {} over the same range: the claim holds for the branch, not for \
             the mode that bends the beam most.",
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
    let fast = [sweep.step_at(FAST), sweep.steps.len() - 1];
    let ways = [("whole range", whole(sweep)), ("from 20 rad/s on", fast)];
    let zero = sweep.zero(Name::RightZero);
    let measures: Vec<_> = ways
        .into_iter()
        .filter_map(|(what, steps)| Some(measure(what, zero?, OFF, steps)))
        .collect();
    // Both: a zero that comes back at the end does not narrow the band there.
    let verdict = direction(&measures, -1.0, "it moves away");
    Outcome { verdict, measures, note: None }
}
