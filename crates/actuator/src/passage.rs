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

/// The first limit that a motion with this start passes within `h`, and when, s.
pub fn first_passage(
    actuator: &Actuator,
    start: Motion,
    response: &Response,
    h: f64,
) -> Option<(f64, Limit)> {
    let passage =
        |limit: fn(f64) -> Limit, from, to| passage(actuator, SIDES.map(limit), response, from, to);
    let (mut from, mut rate) = (0.0, start.rate);
    for to in response.monotonic(h) {
        let passed = passage(Limit::Rate, from, to);
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
            let stopped = passage(Limit::Stop, from, t);
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

/// The limit that is passed on an interval on which the limited quantity is monotonic, and when, s. What starts at a limit
/// without being held there moves away from it; so one that is exceeded by rounding is not passed.
fn passage(
    actuator: &Actuator,
    limits: [Limit; 2],
    response: &Response,
    from: f64,
    to: f64,
) -> Option<(f64, Limit)> {
    let [position, rate] = response.rounding(to);
    limits.into_iter().find_map(|limit| {
        let excess_and_slope = |t| {
            let [position, rate, acceleration] = response.at(t);
            match limit {
                Limit::Rate(side) => [side * rate - actuator.rate_limit, side * acceleration],
                Limit::Stop(side) => [side * position - actuator.stop(side), side * rate],
            }
        };
        let rounding = if let Limit::Rate(_) = limit { rate } else { position };
        let passed = excess_and_slope(to)[0] > rounding;
        passed.then(|| (root(from, to, excess_and_slope), limit))
    })
}
