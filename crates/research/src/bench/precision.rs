//! Work-precision diagram: error after one second against computing time, for an elevator doublet.

use super::Effort;
use super::report::Report;
use super::timing::{Spread, seconds};
use super::{other_integrators, rust_crates};
use crate::methods::{EXACT, FLIGHT_S, Law, Problem, RKF78, error, work_for};
use ahv::flight::{DEFAULT_TOLERANCE, Flight, Setup, method};
use ahv::vehicle::{DELTA_E, State};
use ahv_tool::python::python;
use anyhow::Result;
use serde::Serialize;

/// Prefix of the names of our method.
pub const OURS: &str = "ours";
/// Tolerances of the figure.
pub const TOLERANCES: [&str; 5] = ["1e-4", "1e-6", "1e-8", "1e-10", "1e-12"];
/// Communication steps of the flight: 10 ms, or only where the input jumps.
const STEPS: [usize; 2] = [100, 4];

/// One method at one tolerance.
#[derive(Debug, Clone, Serialize)]
pub struct Point {
    pub method: String,
    pub tolerance: String,
    /// Seconds per flight of one second.
    pub seconds: Spread,
    /// Right-hand sides.
    pub calls: usize,
    /// Largest error of a state over the sum of nominal value and magnitude.
    pub error: f64,
}

/// A flight as in `cargo ahv fly`, without the C functions.
pub fn fly(flight: &mut Flight, steps: usize, law: &Law) -> Result<State, ahv::error::Error> {
    for step in 0..steps {
        flight.set_input(DELTA_E, law.elevator(step, steps, flight.state()));
        flight.advance(FLIGHT_S * (step + 1) as f64 / steps as f64)?;
    }
    Ok(*flight.state())
}

/// Flights with our method at all tolerances, then with other crates.
fn flights(effort: &Effort, setup: &Setup, steps: usize, law: Law) -> Result<Vec<Point>> {
    let default = setup.fly()?;
    let (vehicle, trim) = (default.vehicle(), default.trim());
    let problem = Problem::new(vehicle, trim, steps, law);
    let (exact, _) = problem.fly(&mut &RKF78, EXACT);
    let mut points = Vec::new();
    for tolerance in TOLERANCES {
        let mut flight = setup.start(0.0, tolerance.parse()?)?;
        let start = flight.snapshot();
        let reached = fly(&mut flight, steps, &law)?;
        let mut again = || {
            flight.rewind(&start);
            fly(&mut flight, steps, &law)
        };
        let seconds = seconds(effort, &mut again);
        points.push(Point {
            method: format!("{OURS}, steps of {} ms", 1e3 * FLIGHT_S / steps as f64),
            tolerance: tolerance.to_string(),
            seconds,
            calls: problem.fly(&mut method(vehicle, trim), tolerance.parse()?).1,
            error: error(&reached, &exact),
        });
    }
    for (name, method) in rust_crates::CRATES {
        for tolerance in TOLERANCES {
            let limit = tolerance.parse()?;
            let fly = || {
                problem.each(|system, interval, x| {
                    rust_crates::step(*method, system, interval, x, limit)
                })
            };
            let (reached, calls) = fly()?;
            points.push(Point {
                method: format!("{name}, {} ms steps", 1e3 * FLIGHT_S / steps as f64),
                tolerance: tolerance.to_string(),
                seconds: seconds(effort, fly),
                calls,
                error: error(&reached, &exact),
            });
        }
    }
    Ok(points)
}

pub fn measure(effort: &Effort, report: &mut Report) -> Result<()> {
    let setup = Setup::new()?;
    let flight = setup.fly()?;
    let (vehicle, trim) = (flight.vehicle(), flight.trim());
    let exact = Problem::new(vehicle, trim, STEPS[1], Law::OPEN).fly(&mut &RKF78, EXACT).0;
    let closed = Law::closed(trim);
    report.versions.extend(rust_crates::versions()?);
    compare("closed loop, 1 s", &flights(effort, &setup, STEPS[0], closed)?, report);
    let mut points = flights(effort, &setup, STEPS[0], Law::OPEN)?;
    compare("1 s", &points, report);
    // Other integrators restart where the elevator jumps, as steps of a quarter do.
    let mut rare = flights(effort, &setup, STEPS[1], Law::OPEN)?;
    // A program that is not installed is skipped; one that fails is an error.
    match other_integrators::sundials() {
        Ok(program) => {
            report.version("dpkg-query", &["-W", "-f=SUNDIALS ${Version}", "libsundials-dev"]);
            rare.extend(other_integrators::under_sundials(&program, effort, &exact)?);
        }
        Err(why) => report.left_out("SUNDIALS", &why),
    }
    match python() {
        Ok(python) => {
            report.python_versions(&python, &["numpy", "scipy"]);
            rare.extend(other_integrators::under_scipy(&python, effort)?);
        }
        Err(why) => report.left_out("SciPy", &why),
    }
    compare("1 s", &rare, report);
    points.extend(rare);
    report.points = points;
    Ok(())
}

/// A line for each method at the default tolerance, with its time for an error of that size compared with the first
/// method of `points`, which is ours.
fn compare(what: &str, points: &[Point], report: &mut Report) {
    let default = |point: &&Point| point.tolerance.parse() == Ok(DEFAULT_TOLERANCE);
    let mut methods: Vec<_> = points.iter().map(|point| &point.method).collect();
    methods.dedup();
    let mut ours = None;
    for method in methods {
        let own: Vec<_> = points.iter().filter(|point| point.method == *method).collect();
        let time = time_for(&own, DEFAULT_TOLERANCE);
        for point in own.iter().copied().filter(default) {
            let mut note = format!("{} right-hand sides, error {:.0e}", point.calls, point.error);
            if let Some(seconds) = time {
                note += &format!("; for {DEFAULT_TOLERANCE:.0e} {:.0} us", 1e6 * seconds);
                match ours {
                    Some(ours) => note += &format!(", {:.1} x ours", seconds / ours),
                    None => ours = Some(seconds),
                }
            } else {
                note += "; never that accurate";
            }
            let what = format!("{what} at {}, {method}", point.tolerance);
            report.line(what, point.seconds.scaled(1e6), "us", note);
        }
    }
}

/// Seconds for an error. Uses shortest times, as other processes only add time.
fn time_for(points: &[&Point], error: f64) -> Option<f64> {
    let points: Vec<_> = points.iter().map(|point| [point.error, point.seconds.least]).collect();
    work_for(&points, error)
}
