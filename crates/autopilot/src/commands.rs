//! The manoeuvre: commands over time, linear between breakpoints.

use crate::error::Error;
use crate::gains::{mix, place};
use crate::law::WANTED;

/// Breakpoints that the parameters hold.
pub const BREAKPOINTS: usize = 8;

/// One breakpoint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Breakpoint {
    /// Time after the start, s; zero in all but the first: unused.
    pub time_s: f64,
    /// Change of V (m/s) and value of gamma (rad).
    pub wanted: [f64; WANTED],
}

impl Breakpoint {
    /// Level flight.
    pub const LEVEL: Self = Self { time_s: 0.0, wanted: [0.0; WANTED] };
}

/// Breakpoints in use, by growing time; of two at one time the later one holds from then on.
#[derive(Debug, Clone)]
pub struct Commands {
    points: [Breakpoint; BREAKPOINTS],
    count: usize,
}

impl Commands {
    /// The commands of these breakpoints.
    ///
    /// # Errors
    /// [`Error::Breakpoint`].
    pub fn new(given: &[Breakpoint; BREAKPOINTS]) -> Result<Self, Error> {
        let (mut points, mut count) = ([given[0]; BREAKPOINTS], 1);
        for (i, point) in given.iter().enumerate().skip(1).filter(|(_, point)| point.time_s != 0.0)
        {
            let before_s = points[count - 1].time_s;
            if point.time_s < before_s {
                return Err(Error::Breakpoint { number: i + 1, time_s: point.time_s, before_s });
            }
            points[count] = *point;
            count += 1;
        }
        Ok(Self { points, count })
    }

    /// The commands at a time after the start, s; before the first breakpoint and after the last as there.
    pub fn at(&self, time_s: f64) -> [f64; WANTED] {
        let (before, next, part) = place(&self.points[..self.count], |point| point.time_s, time_s);
        let mut wanted = before.wanted;
        mix(&mut wanted, &next.wanted, part);
        wanted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn commands(times_s: &[f64]) -> Result<Commands, Error> {
        let mut points = [Breakpoint::LEVEL; BREAKPOINTS];
        for (i, (point, &time_s)) in points.iter_mut().zip(times_s).enumerate() {
            *point = Breakpoint { time_s, wanted: [i as f64, -(i as f64)] };
        }
        Commands::new(&points)
    }

    #[test]
    fn commands_are_linear_between_breakpoints_and_constant_outside() {
        let commands = commands(&[1.0, 3.0, 0.0, 4.0]).unwrap();
        for (time_s, wanted) in
            [(0.0, 0.0), (1.0, 0.0), (2.0, 0.5), (3.0, 1.0), (3.5, 2.0), (4.0, 3.0), (1e9, 3.0)]
        {
            assert_eq!(commands.at(time_s), [wanted, -wanted], "{time_s} s");
        }
    }

    #[test]
    fn of_two_breakpoints_at_one_time_the_later_one_holds_from_then_on() {
        let commands = commands(&[0.0, 2.0, 2.0, 4.0]).unwrap();
        assert_eq!([1.0, 2.0, 3.0].map(|time_s| commands.at(time_s)[0]), [0.5, 2.0, 2.5]);
    }

    #[test]
    fn breakpoints_that_go_back_in_time_are_refused() {
        let refused = commands(&[0.0, 5.0, 4.0]).unwrap_err();
        assert_eq!(refused, Error::Breakpoint { number: 3, time_s: 4.0, before_s: 5.0 });
        assert!(commands(&[5.0, 4.0]).is_err());
    }
}
