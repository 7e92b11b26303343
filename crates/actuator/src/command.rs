//! The command on its way to the actuator: a pure delay.

use crate::model::Error;
use crate::response::Ramp;
use std::collections::VecDeque;

/// Most changes of the command that are on their way.
pub const MOST: usize = 256;

/// From an instant (s) on the command moves like this.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// When it was given.
    pub time: f64,
    /// What it is from then on.
    pub ramp: Ramp,
}

/// What was commanded, and what of it arrives when.
#[derive(Debug)]
pub struct Commands {
    delay: f64,
    /// The one that is followed now, then those on their way.
    pub changes: VecDeque<Change>,
}

impl Commands {
    /// A command that has been there for ever.
    pub fn new(delay: f64, time: f64, value: f64) -> Self {
        // Room for all, so that no step allocates.
        let mut changes = VecDeque::with_capacity(MOST);
        let ramp = Ramp { value, slope: 0.0 };
        changes.push_back(Change { time: time - delay, ramp });
        Self { delay, changes }
    }

    /// Takes the command of a step (s) from an instant (s) on; a repeated step replaces it.
    ///
    /// # Errors
    /// [`Error::DelayFull`]; nothing is changed.
    pub fn give(&mut self, time: f64, ramp: Ramp, step: f64) -> Result<(), Error> {
        let (count, most) = (self.changes.len(), MOST);
        match self.changes.back_mut() {
            Some(last) if ramp.slope == 0.0 && last.ramp == ramp => {}
            Some(last) if last.time == time => last.ramp = ramp,
            _ if count == most => {
                return Err(Error::DelayFull { delay: self.delay, step, most });
            }
            _ => self.changes.push_back(Change { time, ramp }),
        }
        Ok(())
    }

    /// The commands that arrive between two instants (s), and how long each is followed, s.
    pub fn arriving(&self, from: f64, to: f64) -> impl Iterator<Item = (Ramp, f64)> {
        let ends = self.changes.iter().skip(1).map(|next| next.time + self.delay);
        self.changes.iter().zip(ends.chain([f64::INFINITY])).filter_map(move |(change, end)| {
            let arrival = change.time + self.delay;
            let (start, end) = (arrival.max(from), end.min(to));
            (start < end).then(|| (change.ramp.after(start - arrival), end - start))
        })
    }

    /// Forgets what is no longer followed at an instant, s.
    pub fn forget(&mut self, time: f64) {
        while self.changes.get(1).is_some_and(|next| next.time + self.delay <= time) {
            self.changes.pop_front();
        }
    }
}
