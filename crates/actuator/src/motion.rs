//! The actuator with its limits: pieces of motion, each in closed form.
//!
//! Between limits it answers freely. At the rate limit its rate is constant until the command pushes no further; at a
//! position stop it rests until the command turns back. What happens at an upper limit is written once: a lower one is its
//! mirror image.

use crate::model::{Actuator, Error, Order};
use crate::passage::{Limit, SIDES, first_passage};
use crate::response::{Motion, ROUNDINGS, Ramp, Response};

/// What the actuator does.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Regime {
    Free,
    Held(Limit),
}

/// How a piece ends, and when, s.
type End = Option<(f64, Regime)>;

/// A lightly damped actuator that rings into its limits until it rests has fewer pieces of motion.
const MOST_PIECES: usize = 10_000;

impl Actuator {
    /// The motion after `h` (s) under a command.
    ///
    /// # Errors
    /// [`Error::Pieces`].
    pub fn advance(&self, mut motion: Motion, command: Ramp, h: f64) -> Result<Motion, Error> {
        let mut regime = self.regime(&mut motion, command);
        let mut elapsed = 0.0;
        for _ in 0..MOST_PIECES {
            let (now, rest) = (command.after(elapsed), h - elapsed);
            // What is left is rounding.
            if rest <= f64::EPSILON * h {
                return Ok(motion);
            }
            let end = match regime {
                Regime::Free => self.free(&mut motion, now, rest),
                Regime::Held(Limit::Rate(side)) => self.at_rate_limit(&mut motion, now, rest, side),
                Regime::Held(Limit::Stop(side)) => self.at_stop(&mut motion, now, rest, side),
            };
            let Some((after, next)) = end else { return Ok(motion) };
            elapsed += after;
            regime = match next {
                Regime::Held(Limit::Stop(_)) => self.regime(&mut motion, command.after(elapsed)),
                next => next,
            };
        }
        Err(Error::Pieces { step: h, most: MOST_PIECES })
    }

    /// Largest position on a side, mirrored.
    pub(crate) fn stop(&self, side: f64) -> f64 {
        if side > 0.0 { self.position_max } else { -self.position_min }
    }

    /// What the actuator does under a command; at a stop it loses its speed.
    fn regime(&self, motion: &mut Motion, command: Ramp) -> Regime {
        if self.kind == Order::First {
            let rate = self.bandwidth * (command.value - motion.position);
            motion.rate = rate.clamp(-self.rate_limit, self.rate_limit);
        }
        for side in SIDES {
            let (position, rate) = (side * motion.position, side * motion.rate);
            let Ramp { value, slope } = command.mirrored(side);
            // A command that is level with the actuator but for rounding pushes as its slope will.
            let pushes = |lead: f64, size: f64, slope: f64| {
                let rounding = ROUNDINGS * f64::EPSILON * size;
                lead > rounding || (lead >= -rounding && slope >= 0.0)
            };
            let size = value.abs() + position.abs();
            // The rate of first order is that of the command: rounding may have turned it.
            if position >= self.stop(side) && (rate >= 0.0 || self.kind == Order::First) {
                motion.rate = side * rate.min(0.0);
                if pushes(value - position, size, slope) {
                    return Regime::Held(Limit::Stop(side));
                }
            }
            let limit = self.rate_limit;
            let reserve = self.lag() * limit;
            if rate >= limit && pushes(value - position - reserve, size + reserve, slope - limit) {
                return Regime::Held(Limit::Rate(side));
            }
        }
        Regime::Free
    }

    /// At a stop it loses its speed towards it.
    fn stop_at_stops(&self, motion: &mut Motion) {
        for side in SIDES {
            if side * motion.position >= self.stop(side) {
                motion.rate = side * (side * motion.rate).min(0.0);
            }
        }
    }

    /// At rest at a stop, until the command turns back.
    fn at_stop(&self, motion: &mut Motion, command: Ramp, h: f64, side: f64) -> End {
        let (stop, command) = (self.stop(side), command.mirrored(side));
        *motion = Motion { position: side * stop, rate: 0.0 };
        let way = stop - command.value;
        let turns = command.slope < 0.0 && command.after(h).value < stop;
        turns.then(|| (quotient(way, command.slope, h), Regime::Free))
    }

    /// At the largest rate, until the command pushes no further or the position stops.
    fn at_rate_limit(&self, motion: &mut Motion, command: Ramp, h: f64, side: f64) -> End {
        let (rate, command) = (self.rate_limit, command.mirrored(side));
        let start = side * motion.position;
        // The command pushes while it leads by more than a ramp of this rate lags behind.
        let lead = command.value - start - self.lag() * rate;
        let falls = rate - command.slope;
        let (mut moves, mut end) = (h, None);
        if lead <= falls * h {
            moves = quotient(lead, falls, h);
            end = Some((moves, Regime::Free));
        }
        let mut position = start + rate * moves;
        if position >= self.stop(side) {
            position = self.stop(side);
            end = Some(((position - start) / rate, Regime::Held(Limit::Stop(side))));
        }
        *motion = Motion { position: side * position, rate: side * rate };
        end
    }

    /// Between the limits, until the first one is reached.
    fn free(&self, motion: &mut Motion, command: Ramp, h: f64) -> End {
        let response = Response::new(self, *motion, command);
        let end = first_passage(self, *motion, &response, h);
        let [position, rate, _] = response.at(end.map_or(h, |(t, _)| t));
        motion.position = position.clamp(self.position_min, self.position_max);
        motion.rate = rate.clamp(-self.rate_limit, self.rate_limit);
        match end {
            Some((_, Limit::Rate(side))) => motion.rate = side * self.rate_limit,
            Some((_, Limit::Stop(side))) => motion.position = side * self.stop(side),
            None => self.stop_at_stops(motion),
        }
        end.map(|(t, limit)| (t, Regime::Held(limit)))
    }
}

/// The time (s) from 0 to `h` in which a way is covered. Compilers may divide before they know that they have to: the divisor
/// is large enough in any case.
fn quotient(way: f64, rate: f64, h: f64) -> f64 {
    let (way, rate) = if rate < 0.0 { (-way, -rate) } else { (way, rate) };
    let way = way.max(0.0);
    way / rate.max(way / h).max(f64::MIN_POSITIVE)
}
