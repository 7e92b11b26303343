//! Where a free motion first passes a limit.
//!
//! The rate is monotonic between zeros of the acceleration, which are known; the position is monotonic where the rate keeps
//! its sign. On such an interval a limit is passed if it is exceeded at the end.

use crate::model::Actuator;
use crate::response::{Motion, Response};
use crate::root::root;

/// A limit on the upper (1) or lower (-1) side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// Of the rate.
    Rate(f64),
    /// Of the position.
    Stop(f64),
}

/// The upper side, then the lower.
pub const SIDES: [f64; 2] = [1.0, -1.0];

/// A limit, and whether the motion has been within it. What starts at a limit without being held there moves away from it,
/// and does not pass it before.
type Watched = (Limit, bool);

/// The first limit that a motion with this start passes within `h`, and when, s.
pub fn first_passage(
    actuator: &Actuator,
    start: Motion,
    response: &Response,
    h: f64,
) -> Option<(f64, Limit)> {
    // Exactly where it starts: rounding decides nothing.
    let at_start = [start.position, start.rate, 0.0];
    let watch = |limit| (limit, excess(actuator, limit, at_start) < 0.0);
    let mut rates = SIDES.map(|side| watch(Limit::Rate(side)));
    let mut stops = SIDES.map(|side| watch(Limit::Stop(side)));
    let (mut from, mut rate) = (0.0, start.rate);
    for to in response.monotonic(h) {
        let passed = passage(actuator, &mut rates, response, from, to);
        let to = passed.map_or(to, |(t, _)| t);
        let [_, rate_then, _] = response.at(to);
        // The position turns where the rate is zero.
        let turn = (rate * rate_then < 0.0).then(|| {
            root(from, to, |t| {
                let [_, rate, acceleration] = response.at(t);
                [rate, acceleration]
            })
        });
        for t in turn.into_iter().chain([to]) {
            let stopped = passage(actuator, &mut stops, response, from, t);
            if stopped.is_some() {
                return stopped;
            }
            from = t;
        }
        if passed.is_some() {
            return passed;
        }
        rate = rate_then;
    }
    None
}

/// The limit that is passed on an interval on which the limited quantity is monotonic, and when, s.
fn passage(
    actuator: &Actuator,
    watched: &mut [Watched; 2],
    response: &Response,
    from: f64,
    to: f64,
) -> Option<(f64, Limit)> {
    let excess_at = |limit, t| excess(actuator, limit, response.at(t));
    for (limit, within) in watched {
        let then = excess_at(*limit, to);
        if *within && then > 0.0 {
            let slope = |t| match (*limit, response.at(t)) {
                (Limit::Rate(side), [_, _, acceleration]) => side * acceleration,
                (Limit::Stop(side), [_, rate, _]) => side * rate,
            };
            return Some((root(from, to, |t| [excess_at(*limit, t), slope(t)]), *limit));
        }
        *within |= then < 0.0;
    }
    None
}

/// By how much a limit is exceeded.
fn excess(actuator: &Actuator, limit: Limit, [position, rate, _]: [f64; 3]) -> f64 {
    match limit {
        Limit::Rate(side) => side * rate - actuator.rate_limit,
        Limit::Stop(side) => side * position - actuator.stop(side),
    }
}
