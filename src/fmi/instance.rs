//! One instance: its experiment, its steps and its status.

use crate::error::Error;
use crate::flight::{DEFAULT_TOLERANCE, Flight};
use crate::fmi::clock::same_instant;
use crate::fmi::failure::{Failure, Outcome};
use crate::fmi::lifecycle::Phase;
use crate::fmi::log::Log;
use crate::fmi::snapshot::FmuState;
use crate::fmi::sys::{Status, StatusKind};
use crate::short::short;
use crate::vehicle::CONTROLS;

/// Tolerances that the integrator is given: below the first, rounding errors of double precision
/// decide, above the second the error estimate means nothing. A master's wish is moved into this
/// range, as a setup that works must not warn.
pub const TOLERANCES: [f64; 2] = [1e-12, 1e-2];

/// Largest step (s), rate of an input or change that is taken: what is made of it does not overflow.
pub const LARGEST: f64 = 1e30;

/// What an instance remembers besides the flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Life {
    /// State in the standard's table.
    pub phase: Phase,
    /// Stop time (s), infinite if there is none, once `fmi2SetupExperiment` was called.
    pub stop: Option<f64>,
    /// Whether a step ended early and the simulation should end.
    pub ended: bool,
}

impl Life {
    const NEW: Self = Self { phase: Phase::Instantiated, stop: None, ended: false };
}

/// What a master uses an instance for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interface {
    /// The master integrates.
    ModelExchange,
    /// The instance integrates.
    CoSimulation,
}

/// An instance of the FMU.
#[derive(Debug)]
pub struct Instance {
    interface: Interface,
    /// As it was when instantiated: what a reset goes back to.
    pub(super) pristine: Flight,
    pub(super) flight: Flight,
    pub(super) life: Life,
    logging_on: bool,
    /// Whether it was said that a control is beyond its limit.
    pub(super) limit_said: [bool; CONTROLS],
    /// Messages for the master.
    pub log: Log,
}

impl Instance {
    /// A new instance.
    ///
    /// # Errors
    /// [`Error::Data`] if the data files built in are not those of a vehicle.
    pub fn new(interface: Interface, logging_on: bool) -> Result<Self, Error> {
        let pristine = Flight::new()?;
        let flight = pristine.clone();
        let log = Log::new(logging_on);
        Ok(Self {
            interface,
            pristine,
            flight,
            life: Life::NEW,
            logging_on,
            limit_said: [false; CONTROLS],
            log,
        })
    }

    /// Whether the master integrates, and is at it.
    pub(super) fn exchanging(&self) -> bool {
        matches!(self.life.phase, Phase::EventMode | Phase::ContinuousTimeMode)
    }

    /// State in the standard's table.
    pub fn phase(&self) -> Phase {
        self.life.phase
    }

    /// Makes the instance unusable.
    pub fn ruin(&mut self) {
        self.life.phase = Phase::Fatal;
    }

    /// `fmi2SetDebugLogging`.
    ///
    /// # Errors
    /// [`Failure::UnknownCategory`].
    pub fn set_debug_logging(&mut self, on: bool, categories: &[String]) -> Outcome {
        self.log.switch(on, categories)
    }

    /// `fmi2SetupExperiment`; undefined arguments are `None`.
    ///
    /// # Errors
    /// [`Failure::Argument`].
    pub fn setup_experiment(
        &mut self,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Outcome {
        let refuse = |argument, value, expected: &str| {
            Err(Failure::Argument { argument, value, expected: expected.to_string() })
        };
        if let Some(value) = tolerance
            && !(value > 0.0 && value.is_finite())
        {
            return refuse("tolerance", value, "a positive number is needed");
        }
        if !start.is_finite() {
            return refuse("startTime", start, "a finite number is needed");
        }
        let stop = stop.unwrap_or(f64::INFINITY);
        if stop.is_nan() || stop < start {
            return refuse("stopTime", stop, "it must not lie before the start time");
        }
        let [least, largest] = TOLERANCES;
        let tolerance = tolerance.unwrap_or(DEFAULT_TOLERANCE).clamp(least, largest);
        self.flight.set_experiment(start, tolerance);
        self.life.stop = Some(stop);
        self.log.push(Status::Ok, || {
            let start = short(start);
            format!("fmi2SetupExperiment: start at {start} s, relative tolerance {tolerance:e}")
        });
        Ok(())
    }

    /// `fmi2EnterInitializationMode`.
    ///
    /// # Errors
    /// [`Failure::NoExperiment`].
    pub fn enter_initialization_mode(&mut self) -> Outcome {
        self.life.stop.ok_or(Failure::NoExperiment)?;
        self.life.phase = Phase::InitializationMode;
        Ok(())
    }

    /// `fmi2ExitInitializationMode`: finds the initial state.
    ///
    /// # Errors
    /// [`Failure::Initialisation`], for example without a trim; the state is then error.
    pub fn exit_initialization_mode(&mut self) -> Outcome {
        if let Err(error) = self.flight.evaluate() {
            self.life.phase = Phase::Error;
            return Err(Failure::Initialisation(error));
        }
        self.life.phase = match self.interface {
            Interface::ModelExchange => Phase::EventMode,
            Interface::CoSimulation => Phase::StepComplete,
        };
        if let Some(trim) = self.flight.trim() {
            let (alpha, [delta_e, phi]) = (self.flight.state()[3], trim.control);
            self.log.push(Status::Ok, || {
                format!(
                    "fmi2ExitInitializationMode: start with alpha = {alpha} rad, \
                     delta_e = {delta_e} rad, phi = {phi}"
                )
            });
        }
        self.say_ignored();
        self.say_limits("fmi2ExitInitializationMode");
        Ok(())
    }

    /// `fmi2Terminate`: nothing is left to do, values can still be read.
    ///
    /// # Errors
    /// None.
    pub fn terminate(&mut self) -> Outcome {
        self.life.phase = Phase::Terminated;
        Ok(())
    }

    /// `fmi2Reset`: as just instantiated, with the logging of then.
    ///
    /// # Errors
    /// None.
    pub fn reset(&mut self) -> Outcome {
        self.flight = self.pristine.clone();
        self.life = Life::NEW;
        self.limit_said = [false; CONTROLS];
        self.log.switch(false, &[])?;
        self.log.switch(self.logging_on, &[])
    }

    /// `fmi2DoStep`. Rounding in `point` is accepted; the step then starts at the instance's own
    /// time, and ends exactly at `point + step`: the clock follows the master's, and what one point was
    /// rounded by is not in the next.
    ///
    /// # Errors
    /// [`Failure::Argument`], [`Failure::CommunicationPoint`] and [`Failure::PastStop`] change
    /// nothing. After [`Failure::Incomplete`] time and state are those of the last valid instant.
    pub fn do_step(&mut self, point: f64, step: f64) -> Outcome {
        let time = self.flight.time();
        if !(step > 0.0 && step <= LARGEST) {
            return Err(Failure::Argument {
                argument: "communicationStepSize",
                value: step,
                expected: format!("a positive number up to {LARGEST:e} is needed"),
            });
        }
        if !(point.is_finite() && same_instant(point, time, step)) {
            return Err(Failure::CommunicationPoint { asked: point, step, time });
        }
        let end = point + step;
        if end < time {
            return Err(Failure::CommunicationPoint { asked: point, step, time });
        }
        if let Some(stop) = self.life.stop
            && end > stop
            && !same_instant(end, stop, step)
        {
            return Err(Failure::PastStop { end, stop });
        }
        // A step below the resolution of time ends where it starts.
        if end == time {
            return Ok(());
        }
        if cfg!(feature = "idle") {
            self.flight.set_time(end);
            return Ok(());
        }
        match self.flight.advance(end) {
            Ok(()) => {
                self.say_limits("fmi2DoStep");
                Ok(())
            }
            // A part of the step was flown, so the status is discard. The integrator chose its own
            // steps down to the last valid instant: a shorter communication step gets no further,
            // so the instance asks for the end of the simulation in both cases.
            // One that took too many is the exception.
            Err(
                error @ (Error::Envelope { .. }
                | Error::Fuel { .. }
                | Error::StepSize { .. }
                | Error::TooLong { .. }),
            ) => {
                self.life.phase = Phase::StepFailed;
                self.life.ended = !matches!(error, Error::TooLong { .. });
                Err(Failure::Incomplete(error))
            }
            Err(error) => {
                self.life.phase = Phase::Error;
                Err(Failure::Initialisation(error))
            }
        }
    }

    /// `fmi2CancelStep`: never legal, as no step is ever pending.
    ///
    /// # Errors
    /// [`Failure::NotProvided`].
    pub fn cancel_step(&mut self) -> Outcome {
        Err(Failure::NotProvided { capability: "canRunAsynchronuously = false" })
    }

    /// `fmi2GetRealStatus`: the end of the last step, or the instant at which it ended early.
    ///
    /// # Errors
    /// [`Failure::NoStatus`].
    pub fn real_status(&self, kind: StatusKind) -> Result<f64, Failure> {
        if kind == StatusKind::LAST_SUCCESSFUL_TIME {
            return Ok(self.flight.time());
        }
        Err(Failure::NoStatus { kind, asked: "fmi2Real" })
    }

    /// `fmi2GetBooleanStatus`: whether the simulation should end.
    ///
    /// # Errors
    /// [`Failure::NoStatus`].
    pub fn boolean_status(&self, kind: StatusKind) -> Result<bool, Failure> {
        if kind == StatusKind::TERMINATED {
            return Ok(self.life.ended);
        }
        Err(Failure::NoStatus { kind, asked: "fmi2Boolean" })
    }

    /// `fmi2GetFMUstate`.
    pub fn state(&self) -> FmuState {
        FmuState { flight: self.flight.snapshot(), life: self.life }
    }

    /// `fmi2SetFMUstate`.
    ///
    /// # Errors
    /// [`Failure::OtherInterface`]; [`Failure::Model`] if the flight cannot be rebuilt.
    pub fn set_state(&mut self, state: &FmuState) -> Outcome {
        let other = match self.interface {
            Interface::ModelExchange => [Phase::StepComplete, Phase::StepFailed],
            Interface::CoSimulation => [Phase::EventMode, Phase::ContinuousTimeMode],
        };
        if other.contains(&state.life.phase) {
            return Err(Failure::OtherInterface { phase: state.life.phase });
        }
        self.flight.rewind(&state.flight)?;
        self.life = state.life;
        Ok(())
    }

    /// `fmi2SerializeFMUstate`.
    pub fn serialize(&self, state: &FmuState) -> Vec<u8> {
        state.encode(&self.pristine)
    }

    /// `fmi2DeSerializeFMUstate`.
    ///
    /// # Errors
    /// [`Failure::Bytes`].
    pub fn deserialize(&self, bytes: &[u8]) -> Result<FmuState, Failure> {
        FmuState::decode(bytes, &self.pristine)
    }
}
