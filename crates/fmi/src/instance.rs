//! One instance: its parameters, its simulation and its life.

use crate::failure::{Failure, Outcome};
use crate::log::Log;
use crate::model::{Model, Simulation};
use crate::pending::Pending;
use crate::phase::Phase;
use crate::short::short;
use crate::status::Status;
use core::fmt;

/// Largest step (s), rate of an input or change that is taken: what is made of it does not overflow.
pub const LARGEST: f64 = 1e30;

/// What the master said about the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Experiment {
    /// Start time, s.
    pub start: f64,
    /// Stop time (s), infinite if there is none.
    pub stop: f64,
    /// Relative tolerance that the simulation works with.
    pub tolerance: f64,
}

/// What an instance remembers besides parameters and simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Life {
    /// State in the standards' tables.
    pub phase: Phase,
    /// What the master said about the run, once it did.
    pub experiment: Option<Experiment>,
    /// Whether a step ended early and the simulation should end.
    pub ended: bool,
}

impl Life {
    const NEW: Self = Self { phase: Phase::Instantiated, experiment: None, ended: false };
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
pub struct Instance<M: Model> {
    pub(crate) interface: Interface,
    /// As it was when instantiated: what a reset goes back to.
    pub(crate) pristine: M,
    pub(crate) model: M,
    /// Inputs that were set before the simulation started.
    pub(crate) pending: Pending,
    pub(crate) simulation: Option<M::Simulation>,
    pub(crate) life: Life,
    /// Where the present step began, as numbers of the simulation.
    pub(crate) start_of_step: Vec<f64>,
    logging_on: bool,
    /// Messages for the master.
    pub log: Log,
}

impl fmt::Display for Interface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::ModelExchange => "Model Exchange",
            Self::CoSimulation => "Co-Simulation",
        })
    }
}

impl<M: Model> Instance<M> {
    /// A new instance of the built-in model.
    ///
    /// # Errors
    /// Those of [`Model::new`] and [`Instance::of`].
    pub fn new(interface: Interface, logging_on: bool) -> Result<Self, Failure> {
        Self::of(M::new()?, interface, logging_on)
    }

    /// A new instance of this model.
    ///
    /// # Errors
    /// [`Failure::NotProvided`] of a model that does not know the interface.
    pub fn of(pristine: M, interface: Interface, logging_on: bool) -> Result<Self, Failure> {
        if interface == Interface::ModelExchange {
            Self::exchange()?;
        }
        Ok(Self {
            interface,
            model: pristine.clone(),
            pristine,
            pending: Pending::new::<M>(),
            simulation: None,
            life: Life::NEW,
            start_of_step: Vec::new(),
            logging_on,
            log: Log::new(logging_on),
        })
    }

    /// Whether the master integrates, and is at it.
    pub(crate) fn exchanging(&self) -> bool {
        matches!(self.life.phase, Phase::EventMode | Phase::ContinuousTimeMode)
    }

    /// Whether parameters can still be set.
    pub(crate) fn before_start(&self) -> bool {
        matches!(self.life.phase, Phase::Instantiated | Phase::InitializationMode)
    }

    /// State in the standards' tables.
    pub fn phase(&self) -> Phase {
        self.life.phase
    }

    /// Ends the run: the master can reset, or restore an FMU state. A run that has not started has no values.
    pub(crate) fn fail(&mut self) {
        if self.before_start() {
            self.simulation = None;
        }
        self.life.phase = Phase::Error;
    }

    /// Makes the instance unusable.
    pub fn ruin(&mut self) {
        self.life.phase = Phase::Fatal;
    }

    /// Present time, s.
    pub fn time(&self) -> f64 {
        match (&self.simulation, &self.life.experiment) {
            (Some(simulation), _) => simulation.time(),
            (None, Some(experiment)) => experiment.start,
            (None, None) => 0.0,
        }
    }

    /// The simulation; it starts here if it has not started yet, or if a parameter changed since.
    pub(crate) fn running(&mut self) -> Result<&mut M::Simulation, Failure> {
        Ok(self.with_model()?.1)
    }

    /// Parameters and simulation.
    pub(crate) fn with_model(&mut self) -> Result<(&M, &mut M::Simulation), Failure> {
        let simulation = match &mut self.simulation {
            Some(simulation) => simulation,
            None if self.life.phase == Phase::Error => return Err(Failure::NeverStarted),
            slot @ None => {
                let mut simulation = start(&self.model, self.life.experiment)?;
                self.pending.hand_over(&mut simulation);
                slot.insert(simulation)
            }
        };
        Ok((&self.model, simulation))
    }

    /// `fmi2SetDebugLogging`, `fmi3SetDebugLogging`.
    ///
    /// # Errors
    /// [`Failure::UnknownCategory`].
    pub fn set_debug_logging(&mut self, on: bool, categories: &[String]) -> Outcome {
        self.log.switch(on, categories)
    }

    /// `fmi2SetupExperiment`, and the arguments of `fmi3EnterInitializationMode`; undefined ones are `None`.
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
        let [least, largest] = M::TOLERANCES;
        let tolerance = tolerance.unwrap_or(M::DEFAULT_TOLERANCE).clamp(least, largest);
        self.life.experiment = Some(Experiment { start, stop, tolerance });
        self.simulation = None;
        self.log.push(Status::Ok, || {
            let start = short(start);
            format!("start at {start} s, relative tolerance {tolerance:e}")
        });
        Ok(())
    }

    /// Enters the initialization mode.
    ///
    /// # Errors
    /// [`Failure::NoExperiment`].
    pub fn enter_initialization_mode(&mut self) -> Outcome {
        self.life.experiment.ok_or(Failure::NoExperiment)?;
        self.life.phase = Phase::InitializationMode;
        Ok(())
    }

    /// Leaves the initialization mode: finds the initial state.
    ///
    /// # Errors
    /// Those of [`Model::start`]; the state is then error.
    pub fn exit_initialization_mode(&mut self) -> Outcome {
        let started = self.running().and_then(|simulation| {
            simulation.evaluate()?;
            Ok(())
        });
        if let Err(failure) = started {
            self.life.phase = Phase::Error;
            return Err(failure.without_remedy());
        }
        self.life.phase = match self.interface {
            Interface::ModelExchange => Phase::EventMode,
            Interface::CoSimulation => Phase::StepComplete,
        };
        if self.log.wants(Status::Ok)
            && let Some(simulation) = &self.simulation
        {
            let log = &mut self.log;
            self.model
                .started(&self.pristine, simulation, &mut |text| log.push(Status::Ok, || text));
        }
        self.advise();
        Ok(())
    }

    /// Says what works but is probably not meant.
    pub(crate) fn advise(&mut self) {
        if self.log.wants(Status::Ok)
            && let Some(simulation) = &mut self.simulation
        {
            simulation.advise(&mut |text| self.log.push(Status::Ok, || text));
        }
    }

    /// Terminates: nothing is left to do, values can still be read.
    ///
    /// # Errors
    /// None.
    pub fn terminate(&mut self) -> Outcome {
        self.life.phase = Phase::Terminated;
        Ok(())
    }

    /// Resets: as just instantiated, with the logging of then.
    ///
    /// # Errors
    /// None.
    pub fn reset(&mut self) -> Outcome {
        self.model = self.pristine.clone();
        self.pending = Pending::new::<M>();
        self.simulation = None;
        self.life = Life::NEW;
        self.log.switch(false, &[])?;
        self.log.switch(self.logging_on, &[])
    }
}

/// A simulation of the model in an experiment, with inputs at zero.
pub(crate) fn start<M: Model>(
    model: &M,
    experiment: Option<Experiment>,
) -> Result<M::Simulation, Failure> {
    let (start, tolerance) = match experiment {
        Some(experiment) => (experiment.start, experiment.tolerance),
        None => (0.0, M::DEFAULT_TOLERANCE),
    };
    Ok(model.start(start, tolerance)?)
}
