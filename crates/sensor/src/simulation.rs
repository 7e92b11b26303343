//! A running simulation.
//!
//! A sample is taken at its instant with the input of that instant: while the time is there, y follows the input, as a
//! master may set it after the step that led there; once the time moves on, y is held.

use crate::model::{Error, Failure, MOST_PERIODS, Sensor};
use crate::noise::normal;
use fmi_model::clock::{Samples, same_instant};
use fmi_model::instance::LARGEST;
use fmi_model::{InputDerivatives, Saving, Simulation};

/// A sensor at work.
#[derive(Debug)]
pub struct Running {
    sensor: Sensor,
    start: f64,
    time: f64,
    u: [f64; 1],
    /// Slope of the input within the next step, 1/s.
    slope: [f64; 1],
    /// What the lag has made of the input; before the first step it has settled.
    lagged: Option<f64>,
    /// Number of the last sample that is held, -1 before the first, and its value.
    taken: f64,
    held: f64,
    /// Reading at which the sensor got stuck.
    stuck: Option<f64>,
    y: f64,
    /// Whether the user knows of the failure.
    told: bool,
}

/// After so many time constants nothing is left.
const DECAYED: f64 = 750.0;
/// Without a sampling period, this step (s) says which instants are the same.
const STEP: f64 = 1e-3;
/// Whole numbers end here: a larger one of any quantum is a multiple of it.
const WHOLE: f64 = 1.0 / f64::EPSILON;

impl Running {
    /// Settled.
    pub(crate) fn new(sensor: &Sensor, start: f64) -> Self {
        Self {
            sensor: sensor.clone(),
            start,
            time: start,
            u: [0.0],
            slope: [0.0],
            lagged: None,
            taken: -1.0,
            held: 0.0,
            stuck: None,
            y: 0.0,
            told: false,
        }
    }

    /// The input after the lag, at a time (s) from now on: closed form for a linear input.
    fn lagged(&self, time: f64) -> f64 {
        let (lag, h) = (self.sensor.lag, time - self.time);
        if lag == 0.0 {
            return self.u[0] + self.slope[0] * h;
        }
        let before = self.lagged.unwrap_or(self.u[0]);
        let moved = -libm::expm1(-h / lag.max(h / DECAYED));
        before + (self.u[0] - before) * moved + self.slope[0] * (h - lag * moved)
    }

    /// What the sensor makes of the lagged input.
    fn reading(&self, lagged: f64, noise: f64) -> f64 {
        let Sensor { scale, bias, quantum, .. } = self.sensor;
        let value = scale * lagged + bias + noise;
        let coarse = value.abs() < WHOLE * quantum;
        // Compilers may divide before they know that they have to.
        let quantum = if coarse { quantum } else { 1.0 };
        // Plus zero: minus zero reads as zero.
        if coarse { quantum * (value / quantum).round() + 0.0 } else { value }
    }

    /// Number of the last sample that is due at a time (s), and whether the time is its instant.
    fn due(&self, time: f64) -> (f64, bool) {
        let number = self.samples().number(time);
        let last = number.floor();
        (last, number == last)
    }

    fn samples(&self) -> Samples {
        Samples { start: self.start, period: self.sensor.period }
    }

    /// The sample of this number, taken between now and a time, s.
    fn sample(&self, sample: f64, time: f64) -> f64 {
        let Sensor { noise, seed, .. } = self.sensor;
        let noise = if noise > 0.0 { noise * normal(seed, sample as u64) } else { 0.0 };
        self.reading(self.lagged(self.samples().instant(sample).max(self.time).min(time)), noise)
    }

    /// The reading at a time (s) from now on, of a sensor that does not fail.
    fn sound(&self, time: f64) -> f64 {
        if self.sensor.period == 0.0 {
            return self.reading(self.lagged(time), 0.0);
        }
        let (last, _) = self.due(time);
        if last > self.taken { self.sample(last, time) } else { self.held }
    }

    /// Whether the failure is now.
    fn fails_at(&self, time: f64) -> bool {
        let Sensor { period, failure_time, .. } = self.sensor;
        let step = if period > 0.0 { period } else { STEP };
        same_instant(failure_time, time, step)
    }

    /// Whether the sensor has failed.
    fn failed(&self) -> bool {
        let Sensor { failure, failure_time, .. } = self.sensor;
        failure != Failure::None && (failure_time <= self.time || self.fails_at(self.time))
    }
}

/// Numbers of a state.
const NUMBERS: usize = 10;
/// An input that moves as fast and for as long as is taken, and what is made of it, stays below this.
const LARGEST_VALUE: f64 = LARGEST * LARGEST * LARGEST;

impl Simulation for Running {
    type Sample = f64;
    type Error = Error;

    const INPUT_DERIVATIVES: Option<InputDerivatives<Self>> = Some(InputDerivatives {
        highest: 1,
        set: |running, number, _, value| running.slope[number] = value,
        first: |running| &running.slope,
    });
    const SAVING: Option<Saving<Self>> = Some(Saving {
        count: NUMBERS,
        save: |running, numbers| {
            let Self { start, time, u: [u], slope: [slope], taken, held, .. } = *running;
            numbers.extend([start, time, u, slope, taken, held]);
            for known in [running.lagged, running.stuck] {
                numbers.extend([f64::from(known.is_some()), known.unwrap_or(0.0)]);
            }
        },
        check: |numbers| {
            let [start, time, _, slope, taken, _, lagged, _, stuck, _] = *numbers else {
                return false;
            };
            [start, time].iter().all(|time| time.is_finite())
                && numbers[2..].iter().all(|number| number.abs() <= LARGEST_VALUE)
                && start <= time
                && slope.abs() <= LARGEST
                && (-1.0..=MOST_PERIODS).contains(&taken)
                && taken == taken.trunc()
                && [lagged, stuck].iter().all(|flag| [0.0, 1.0].contains(flag))
        },
        load: |running, numbers| {
            let known = |i: usize| (numbers[i] != 0.0).then_some(numbers[i + 1]);
            (running.start, running.time) = (numbers[0], numbers[1]);
            (running.u, running.slope) = ([numbers[2]], [numbers[3]]);
            (running.taken, running.held) = (numbers[4], numbers[5]);
            (running.lagged, running.stuck) = (known(6), known(8));
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

    fn evaluate(&mut self) -> Result<&f64, Error> {
        let sound = self.sound(self.time);
        let Sensor { failure, failure_value, .. } = self.sensor;
        self.y = match failure {
            _ if !self.failed() => sound,
            Failure::None => sound,
            Failure::Stuck => self.stuck.unwrap_or(sound),
            Failure::Zero => 0.0,
            Failure::Offset => sound + failure_value,
            Failure::HardOver => failure_value,
            Failure::NotANumber => f64::NAN,
        };
        Ok(&self.y)
    }

    fn advance(&mut self, end: f64) -> Result<(), Error> {
        let Sensor { period, failure, failure_time, .. } = self.sensor;
        if period > 0.0 && end - self.start > MOST_PERIODS * period {
            return Err(Error::Time { time: end, period });
        }
        let passes = failure_time < end && !self.fails_at(end);
        if failure == Failure::Stuck && self.stuck.is_none() && passes {
            self.stuck = Some(self.sound(failure_time.max(self.time)));
        }
        if period > 0.0 {
            // What is due at the end is taken later, with the input of then.
            let (last, now) = self.due(end);
            let last = if now { last - 1.0 } else { last };
            if last > self.taken {
                (self.taken, self.held) = (last, self.sample(last, end));
            }
        }
        self.lagged = Some(self.lagged(end));
        self.u[0] += self.slope[0] * (end - self.time);
        self.slope = [0.0];
        self.time = end;
        Ok(())
    }

    fn advise(&mut self, say: &mut dyn FnMut(String)) {
        let Sensor { failure, failure_time, .. } = self.sensor;
        if self.failed() && !self.told {
            self.told = true;
            say(format!("the sensor fails from {failure_time} s on: {failure:?}"));
        }
    }
}
