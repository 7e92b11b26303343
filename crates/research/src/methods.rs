//! `cargo ahv methods`: right-hand sides and instructions that integration methods need for an error, in flights near
//! trim and far from it.

mod cases;
mod double_double;
mod extrapolation;
mod problem;
mod tableaus;

pub use problem::{Counted, EXACT, FLIGHT_S, Law, Problem, error};
pub use tableaus::RKF78;

use crate::bench::instructions::count;
use crate::cli::Compare;
use ahv::flight::method;
use ahv::solve::{DOP853, Outcome};
use ahv::vehicle::State;
use ahv_tool::table::{row, table};
use ahv_tool::workspace::{target, works};
use anyhow::Result;
use cases::{CASES, Case};
use extrapolation::Extrapolation;
use std::hint::black_box;
use tableaus::DOPRI5;

/// Tolerances from which the work for an error is interpolated: ten to the power of minus these.
const DIGITS: std::ops::RangeInclusive<i32> = 3..=14;
/// Errors of the table: ten to the power of minus these.
const ERRORS: [i32; 5] = [6, 8, 10, 11, 12];
/// Tolerance of the flights whose instructions are counted, and their case.
const PROBED: (f64, usize) = (1e-12, 4);

/// Flies a case with a tolerance: final state and right-hand sides, unless rounding exceeds the tolerance.
type Fly = fn(&Case, f64) -> Result<(State, usize), Outcome>;

const METHODS: [(&str, Fly); 5] = [
    ("DOPRI5", |case, tolerance| case.problem().try_fly(&mut &DOPRI5, tolerance)),
    ("RKF78", |case, tolerance| case.problem().try_fly(&mut &RKF78, tolerance)),
    ("DOP853", |case, tolerance| case.problem().try_fly(&mut &DOP853, tolerance)),
    ("extrapolation", |case, tolerance| case.problem().try_fly(&mut Extrapolation::<6>, tolerance)),
    ("exponential", |case, tolerance| {
        case.problem().try_fly(&mut method(&case.vehicle, &case.trim), tolerance)
    }),
];

/// Prints the right-hand sides of each method for a range of errors.
pub fn run(options: &Compare) -> Result<()> {
    let cases = CASES.iter().map(|plan| Case::new(plan, &options.set));
    let cases: Vec<Case> = cases.collect::<Result<_>>()?;
    if let Some(probe) = &options.probe {
        return self::probe(probe, options.calls, &cases);
    }
    outln!(
        "Right-hand sides for an error: the largest of a state at the end over the sum of its nominal value and"
    )?;
    outln!("magnitude, against a flight in twice the precision\n")?;
    for case in &cases {
        let exact = case.problem().exact()?;
        let mut rows = vec![row(["error"])];
        rows[0].extend(METHODS.map(|(name, _)| name.to_string()));
        rows.extend(ERRORS.map(|digits| vec![format!("1e-{digits}")]));
        for (_, fly) in &METHODS {
            let points = points(*fly, case, &exact);
            for (row, digits) in rows[1..].iter_mut().zip(ERRORS) {
                let work = work_for(&points, libm::pow(10.0, -f64::from(digits)));
                row.push(work.map_or("-".to_string(), |calls| format!("{calls:.0}")));
            }
        }
        outln!("{}\n{}", case.title(), table(&rows))?;
    }
    if !works("valgrind", &["--version"]) {
        return outln!("valgrind is not installed: no instructions");
    }
    std::fs::create_dir_all(target().join("bench"))?;
    let (tolerance, number) = PROBED;
    let mut rows =
        vec![row(["method", "instructions of a right-hand side, with those of the method"])];
    for (name, fly) in METHODS {
        let calls = fly(&cases[number], tolerance).map_or(0, |(_, calls)| calls);
        let total = |flights: &str| {
            let mut arguments = vec!["methods", "--probe", name, "--calls", flights];
            arguments.extend(options.set.settings.iter().flat_map(|set| ["--set", set.as_str()]));
            count(&std::env::current_exe()?, &arguments)
        };
        let each = (total("2")? - total("1")?) / calls as f64;
        rows.push(vec![name.to_string(), format!("{each:.0}")]);
    }
    outln!("{} at a tolerance of {tolerance:.0e}\n{}", cases[number].title(), table(&rows))?;
    Ok(())
}

/// Flies some times with a method, under callgrind.
fn probe(name: &str, flights: usize, cases: &[Case]) -> Result<()> {
    let (tolerance, number) = PROBED;
    for (_, fly) in METHODS.iter().filter(|(method, _)| *method == name) {
        (0..flights).for_each(|_| {
            let _ = black_box(fly(&cases[number], tolerance));
        });
    }
    Ok(())
}

/// Errors and right-hand sides for all tolerances.
fn points(fly: Fly, case: &Case, exact: &State) -> Vec<[f64; 2]> {
    DIGITS
        .filter_map(|digits| fly(case, libm::pow(10.0, -f64::from(digits))).ok())
        .map(|(x, calls)| [error(&x, exact), calls as f64])
        .collect()
}

/// Work for an error, interpolated between points [error, work] with logarithmic scales; that of the first
/// point for larger errors.
pub fn work_for(points: &[[f64; 2]], error: f64) -> Option<f64> {
    let first = points.first()?;
    if first[0] <= error {
        return Some(first[1]);
    }
    points.windows(2).find(|pair| pair[1][0] <= error).map(|pair| {
        let [[x0, y0], [x1, y1]] = [pair[0], pair[1]].map(|point| point.map(libm::log));
        libm::exp(y0 + (y1 - y0) * (libm::log(error) - x0) / (x1 - x0))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ahv_tool::cli::Set;

    #[test]
    fn the_work_for_an_error_is_read_between_the_points() {
        let points = [[1e-2, 1.0], [1e-4, 4.0]];
        assert!((work_for(&points, 1e-3).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(work_for(&points, 1.0), Some(1.0));
        assert_eq!(work_for(&points, 1e-9), None);
    }

    #[test]
    fn verif_the_exponential_method_needs_less_than_two_thirds_of_the_work_of_dop853_everywhere() {
        let fly = |name| METHODS.iter().find(|(method, _)| *method == name).unwrap().1;
        for plan in &CASES {
            let case = Case::new(plan, &Set { settings: Vec::new() }).unwrap();
            let exact = case.problem().exact().unwrap();
            let [ours, theirs] =
                ["exponential", "DOP853"].map(|name| points(fly(name), &case, &exact));
            for digits in [6, 8, 10, 12] {
                let error = 10.0_f64.powi(-digits);
                let [ours, theirs] = [&ours, &theirs].map(|points| work_for(points, error));
                // DOP853 is not that accurate in every flight.
                let theirs = theirs.unwrap_or(f64::INFINITY);
                let ours = ours.unwrap_or_else(|| panic!("{}: {error:e}", case.title()));
                assert!(1.5 * ours < theirs, "{}, {error:e}: {ours}, {theirs}", case.title());
            }
        }
    }
}
