//! Sampling in time.
//!
//! At every multiple of the period after the start the law takes a sample: it reads the inputs, and what it
//! commands acts from the next multiple on. A communication step may be longer or shorter than a period.

use crate::commands::Commands;
use crate::error::Error;
use crate::law::{COMMANDS, MEASURED, WANTED};
use crate::pilot::{Memory, Pilot};
use crate::saved;
use fmi_model::clock::Samples;
use fmi_model::{InputDerivatives, Saving, Simulation};

/// V (m/s), gamma (rad), q (rad/s), fuel (kg/m); change of V (m/s), gamma (rad).
pub(crate) const INPUTS: usize = MEASURED + 1 + WANTED;
pub(crate) const FUEL: usize = MEASURED;

/// Samples within one communication step at most.
const MOST_SAMPLES: f64 = 1e6;
/// Multiples of a period up to this number are exact, with room to add one.
const MOST_PERIODS: f64 = 1e15;

/// delta_e (rad), phi; counts of missed measurements and saturated samples.
pub type Outputs = [f64; COMMANDS + 2];

/// The running autopilot.
#[derive(Debug)]
pub struct Running {
    pub(crate) pilot: Pilot,
    commands: Commands,
    pub(crate) memory: Memory,
    period_s: f64,
    pub(crate) start_s: f64,
    pub(crate) time_s: f64,
    pub(crate) inputs: [f64; INPUTS],
    /// Rates of the inputs, 1/s.
    pub(crate) rates: [f64; INPUTS],
    /// Whether the rates are for the next step; after it they tell how the inputs moved.
    pub(crate) ahead: bool,
    /// Command in force.
    pub(crate) command: [f64; COMMANDS],
    outputs: Outputs,
    /// Time of the last measurement that was not believed (s), for the log.
    unbelieved_s: Option<f64>,
    told: bool,
}

impl Running {
    /// In level flight.
    pub fn new(pilot: Pilot, commands: Commands, period_s: f64, start_s: f64) -> Self {
        Self {
            pilot,
            commands,
            memory: Memory::LEVEL,
            period_s,
            start_s,
            time_s: start_s,
            inputs: [0.0; INPUTS],
            rates: [0.0; INPUTS],
            ahead: false,
            command: [0.0; COMMANDS],
            outputs: [0.0; COMMANDS + 2],
            unbelieved_s: None,
            told: false,
        }
    }

    /// Sampling period, s.
    pub fn period_s(&self) -> f64 {
        self.period_s
    }

    fn samples(&self) -> Samples {
        Samples { start: self.start_s, period: self.period_s }
    }

    /// One sample at a time, s.
    fn sample(&mut self, time_s: f64) {
        let after_s = (time_s - self.time_s).max(0.0);
        let inputs: [f64; INPUTS] = std::array::from_fn(|i| match self.ahead {
            true => self.inputs[i] + self.rates[i] * after_s,
            false => self.inputs[i],
        });
        let measured = std::array::from_fn(|i| inputs[i]);
        let manoeuvre = self.commands.at(time_s - self.start_s);
        let wanted = std::array::from_fn(|i| manoeuvre[i] + inputs[MEASURED + 1 + i]);
        if self.pilot.believes(&measured) != [true; MEASURED] {
            self.unbelieved_s.get_or_insert(time_s);
        }
        self.pilot.schedule(inputs[FUEL]);
        self.pilot.sample(&mut self.memory, &measured, wanted);
    }
}

impl Simulation for Running {
    type Sample = Outputs;
    type Error = Error;

    const INPUT_DERIVATIVES: Option<InputDerivatives<Self>> = Some(InputDerivatives {
        highest: 1,
        set: |running, input, _, rate| {
            if !running.ahead {
                (running.rates, running.ahead) = ([0.0; INPUTS], true);
            }
            running.rates[input] = rate;
        },
        first: |running| &running.rates,
    });
    const SAVING: Option<Saving<Self>> = Some(Saving {
        count: saved::COUNT,
        save: saved::save,
        check: saved::check,
        load: saved::load,
    });

    fn time(&self) -> f64 {
        self.time_s
    }

    fn inputs(&self) -> &[f64] {
        &self.inputs
    }

    fn set_input(&mut self, number: usize, value: f64) {
        self.inputs[number] = value;
        if !self.ahead {
            self.rates[number] = 0.0;
        }
    }

    fn evaluate(&mut self) -> Result<&Outputs, Error> {
        let [delta_e, phi] = self.command;
        self.outputs = [delta_e, phi, self.memory.missed, self.memory.saturated];
        Ok(&self.outputs)
    }

    fn advance(&mut self, end_s: f64) -> Result<(), Error> {
        let samples = self.samples();
        let (from, to) = (samples.number(self.time_s), samples.number(end_s));
        let (first, end) = (from.ceil(), to.ceil());
        if !(end - first <= MOST_SAMPLES && end <= MOST_PERIODS) {
            return Err(Error::Step { end_s, period_s: self.period_s });
        }
        let mut number = first;
        while number < end {
            self.command = self.memory.command;
            self.sample(samples.instant(number));
            number += 1.0;
        }
        if to == end {
            self.command = self.memory.command;
        }
        if self.ahead {
            let step_s = end_s - self.time_s;
            self.inputs
                .iter_mut()
                .zip(self.rates)
                .for_each(|(input, rate)| *input += rate * step_s);
        } else {
            self.rates = [0.0; INPUTS];
        }
        self.ahead = false;
        self.time_s = end_s;
        Ok(())
    }

    fn advise(&mut self, say: &mut dyn FnMut(String)) {
        if let Some(time_s) = self.unbelieved_s.filter(|_| !self.told) {
            self.told = true;
            say(format!(
                "a measurement is not believed, first at t = {time_s} s: V must exceed half of level \
                 flight's and all must be finite; what the model expects takes its place, and `missed` counts"
            ));
        }
    }
}
