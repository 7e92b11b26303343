//! A running simulation.

use crate::command::{Change, Commands, MOST};
use crate::model::{Actuator, Error, LARGEST_POSITION};
use crate::response::{Motion, Ramp};
use fmi_model::instance::LARGEST;
use fmi_model::{InputDerivatives, Saving, Simulation};

/// An actuator in motion.
#[derive(Debug)]
pub struct Running {
    actuator: Actuator,
    time: f64,
    u: [f64; 1],
    /// Slope of the command within the next step, 1/s.
    slope: [f64; 1],
    motion: Motion,
    commands: Commands,
    /// Whether the user knows that a command lies beyond a stop.
    told: bool,
}

impl Running {
    /// At rest at the initial position.
    pub(crate) fn new(actuator: &Actuator, time: f64) -> Self {
        Self {
            actuator: actuator.clone(),
            time,
            u: [0.0],
            slope: [0.0],
            motion: Motion { position: actuator.y0, rate: 0.0 },
            commands: Commands::new(actuator.delay, time, actuator.y0),
            told: false,
        }
    }
}

/// Numbers of a state besides the changes: time, input, its slope, position, rate, how many changes.
const NUMBERS: usize = 6;
const NUMBERS_OF_CHANGE: usize = 3;
/// A command that moves as fast and for as long as is taken stays below this.
const LARGEST_COMMAND: f64 = LARGEST * LARGEST * LARGEST;

impl Simulation for Running {
    type Sample = Motion;
    type Error = Error;

    const INPUT_DERIVATIVES: Option<InputDerivatives<Self>> = Some(InputDerivatives {
        highest: 1,
        set: |running, number, _, value| running.slope[number] = value,
        first: |running| &running.slope,
    });
    const SAVING: Option<Saving<Self>> = Some(Saving {
        count: NUMBERS + MOST * NUMBERS_OF_CHANGE,
        save: |running, numbers| {
            let Self { time, u: [u], slope: [slope], motion, commands, .. } = running;
            let changes = &commands.changes;
            let Motion { position, rate } = *motion;
            numbers.extend([*time, *u, *slope, position, rate, changes.len() as f64]);
            for Change { time, ramp } in changes {
                numbers.extend([*time, ramp.value, ramp.slope]);
            }
            let gap = MOST - changes.len();
            numbers.extend(std::iter::repeat_n(0.0, gap * NUMBERS_OF_CHANGE));
        },
        check: |numbers| {
            let [time, u, slope, position, rate, count] = numbers[..NUMBERS] else { return false };
            let kept = 1.0..=MOST as f64;
            if !(numbers.iter().all(|number| number.is_finite())
                && u.abs() <= LARGEST_COMMAND
                && slope.abs() <= LARGEST
                && position.abs() <= LARGEST_POSITION
                && rate.abs() <= LARGEST_POSITION
                && kept.contains(&count)
                && count == count.trunc())
            {
                return false;
            }
            let (changes, unused) = numbers[NUMBERS..].split_at(count as usize * NUMBERS_OF_CHANGE);
            let times = || changes.iter().step_by(NUMBERS_OF_CHANGE).chain([&time]);
            let ramps = changes.chunks_exact(NUMBERS_OF_CHANGE).flat_map(|change| &change[1..]);
            times().is_sorted()
                && ramps.into_iter().all(|number| number.abs() <= LARGEST_COMMAND)
                && unused.iter().all(|&number| number == 0.0)
        },
        load: |running, numbers| {
            let Actuator { position_min, position_max, rate_limit, .. } = running.actuator;
            running.time = numbers[0];
            running.u = [numbers[1]];
            running.slope = [numbers[2]];
            running.motion = Motion {
                position: numbers[3].clamp(position_min, position_max),
                rate: numbers[4].clamp(-rate_limit, rate_limit),
            };
            let changes = numbers[NUMBERS..].chunks_exact(NUMBERS_OF_CHANGE);
            running.commands.changes.clear();
            running.commands.changes.extend(changes.take(numbers[5] as usize).map(|change| {
                Change { time: change[0], ramp: Ramp { value: change[1], slope: change[2] } }
            }));
        },
    });

    fn time(&self) -> f64 {
        self.time
    }

    fn inputs(&self) -> &[f64] {
        &self.u
    }

    fn set_input(&mut self, number: usize, value: f64) {
        self.u[number] = value;
    }

    fn evaluate(&mut self) -> Result<&Motion, Error> {
        Ok(&self.motion)
    }

    fn advance(&mut self, end: f64) -> Result<(), Error> {
        let given = Ramp { value: self.u[0], slope: self.slope[0] };
        let step = end - self.time;
        self.commands.give(self.time, given, step)?;
        let mut motion = self.motion;
        for (command, h) in self.commands.arriving(self.time, end) {
            motion = self.actuator.advance(motion, command, h)?;
        }
        self.motion = motion;
        self.commands.forget(end);
        self.time = end;
        self.u = [given.after(step).value];
        self.slope = [0.0];
        Ok(())
    }

    fn advise(&mut self, say: &mut dyn FnMut(String)) {
        let Actuator { position_min, position_max, .. } = self.actuator;
        let [u] = self.u;
        if self.told || (position_min..=position_max).contains(&u) {
            return;
        }
        self.told = true;
        let (stop, limit) = match u > position_max {
            true => ("position_max", position_max),
            false => ("position_min", position_min),
        };
        say(format!("u = {u} lies beyond {stop} = {limit}: the actuator will rest at its stop"));
    }
}
