//! What a call can be refused for. The text is what a user reads in the master's log.

use crate::instance::Interface;
use crate::instance::LARGEST;
use crate::model::{ModelError, Remedy};
use crate::short::short;
use crate::standard::Standard;
use crate::status::Status;
use crate::variable::Refused;

/// What a call of the standard comes to.
pub type Outcome = Result<(), Failure>;

/// Why a call did not do what it was asked. The instance is then as it was, but for a step that the
/// model did not complete and an initialisation that failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure {
    /// Out of order.
    #[error("not allowed in state {phase}; allowed in: {allowed}")]
    IllegalCall {
        /// Name of the instance's state.
        phase: &'static str,
        /// Names of the states in which the call is legal.
        allowed: String,
    },
    /// A function that the other interface has.
    #[error("not a function of {interface}")]
    WrongInterface {
        /// What the instance is for.
        interface: Interface,
    },
    /// `fmi2EnterInitializationMode` without `fmi2SetupExperiment`.
    #[error("call fmi2SetupExperiment first, it gives the start time")]
    NoExperiment,
    /// A pointer that has to lead somewhere is NULL, or misaligned, or its length is absurd.
    #[error("argument {argument} is NULL or does not point to {place}")]
    BadPointer {
        /// Name of the argument in the standard.
        argument: &'static str,
        /// What it should point to.
        place: &'static str,
    },
    /// An argument has a value that makes no sense.
    #[error("{argument} = {} is refused: {expected}", short(*value))]
    Argument {
        /// Name of the argument in the standard.
        argument: &'static str,
        /// The refused value.
        value: f64,
        /// What would be accepted.
        expected: String,
    },
    /// No such variable.
    #[error("value reference {reference} is unknown: {}", last(*count))]
    UnknownReference {
        /// The refused value reference.
        reference: u32,
        /// How many variables there are.
        count: usize,
    },
    /// The variable has another type.
    #[error("{variable} (value reference {reference}) is no {asked}, its type is {has}")]
    WrongType {
        /// Name of the variable.
        variable: &'static str,
        /// Its value reference.
        reference: u32,
        /// Type that the called function works on.
        asked: &'static str,
        /// Type of the variable.
        has: &'static str,
    },
    /// A fixed parameter after initialisation.
    #[error(
        "{variable} = {} is refused: a fixed parameter can only be set before the end of \
         the initialization mode",
        short(*value)
    )]
    TooLate {
        /// Name of the parameter.
        variable: &'static str,
        /// The refused value.
        value: f64,
    },
    /// A derivative with respect to, or of, what is not served.
    #[error("{variable} {served}")]
    NoDerivative {
        /// Name of the variable.
        variable: &'static str,
        /// What it cannot be, and what can.
        served: &'static str,
    },
    /// A derivative of an order that is not served.
    #[error("derivative {order} of {variable} is not served: orders are 1 to {highest}")]
    Order {
        /// Name of the variable.
        variable: &'static str,
        /// The refused order.
        order: i32,
        /// The highest order there is.
        highest: usize,
    },
    /// A direction or derivative that is no number, or too large a one.
    #[error(
        "change of {variable} = {} is refused: a finite number is needed, of a size up to \
         {LARGEST:e}",
        short(*value)
    )]
    Seed {
        /// Name of the variable.
        variable: &'static str,
        /// The refused value.
        value: f64,
    },
    /// A trial state that is no number.
    #[error(
        "{variable} = {} is refused: a state is a finite number; take a shorter step",
        short(*value)
    )]
    State {
        /// Name of the state.
        variable: &'static str,
        /// The refused value.
        value: f64,
    },
    /// The model gives no number for a variable: it is never handed on.
    #[error("{variable} = {value}: the model has no finite value here")]
    NotFinite {
        /// Name of the variable.
        variable: &'static str,
        /// What was computed.
        value: f64,
    },
    /// The communication point is not where the last step ended.
    #[error(
        "currentCommunicationPoint = {} s and communicationStepSize = {} s do not continue from the \
         instance's time {} s; a step begins where the last one ended",
        short(*asked), short(*step), short(*time)
    )]
    CommunicationPoint {
        /// Communication point given.
        asked: f64,
        /// Step given.
        step: f64,
        /// Time of the instance.
        time: f64,
    },
    /// A step past the stop time.
    #[error(
        "the step ends at {} s, past the stop time {} s of the experiment",
        short(*end), short(*stop)
    )]
    PastStop {
        /// End of the step.
        end: f64,
        /// Stop time.
        stop: f64,
    },
    /// A variable that no one sets.
    #[error(
        "{variable} = {} is refused: only inputs and parameters can be set, and states while the \
         master integrates",
        short(*value)
    )]
    NotSettable {
        /// Name of the variable.
        variable: &'static str,
        /// The refused value.
        value: f64,
    },
    /// A variable that has no value yet.
    #[error(
        "{variable} has no value yet: only inputs and parameters have one before initialization"
    )]
    NoValueYet {
        /// Name of the variable.
        variable: &'static str,
    },
    /// A value of a run that failed before it had any.
    #[error("there is no value: an error ended the run before it started; reset the instance")]
    NeverStarted,
    /// A value that the variable cannot take.
    #[error(transparent)]
    Refused(#[from] Refused),
    /// The model cannot do it.
    #[error("{text}")]
    Model {
        /// What is wrong, in the model's words.
        text: String,
        /// What the master can do.
        remedy: Remedy,
    },
    /// Status information that synchronous steps do not have, or not of this type.
    #[error("status kind {kind} is not available as {asked}: {elsewhere}")]
    NoStatus {
        /// Number of what was asked for.
        kind: u32,
        /// Type that the called function gives.
        asked: &'static str,
        /// Where it is instead.
        elsewhere: &'static str,
    },
    /// An optional capability that this FMU does not have.
    #[error("the model description does not promise {capability}")]
    NotProvided {
        /// What is missing.
        capability: &'static str,
    },
    /// A log category that the model description does not list.
    #[error("log category \"{category}\" is unknown; there are: {known}")]
    UnknownCategory {
        /// The refused category.
        category: String,
        /// The categories there are.
        known: String,
    },
    /// A state that an instance for the other interface was in.
    #[error(
        "the FMU state is one of {interface}: it cannot go on where Co-Simulation and Model Exchange \
         differ"
    )]
    OtherInterface {
        /// What the instance that it was taken of is for.
        interface: Interface,
    },
    /// Bytes that are no FMU state of this model.
    #[error("these {length} bytes are no FMU state of this model: {problem}; nothing was changed")]
    Bytes {
        /// How many bytes were given.
        length: usize,
        /// What is wrong with them.
        problem: String,
    },
}

impl<E: ModelError> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Model { text: error.to_string(), remedy: error.remedy() }
    }
}

impl Failure {
    /// The same without a remedy: at the end of initialisation there is no step to shorten.
    pub(crate) fn without_remedy(self) -> Self {
        match self {
            Self::Model { text, .. } => Self::Model { text, remedy: Remedy::Reset },
            other => other,
        }
    }

    /// What the function returns.
    ///
    /// In FMI 2.0 a refused value is an error and nothing milder: a master must not go on with a value that
    /// was not taken. In FMI 3.0 an error ends the run, and `fmi3Discard` says that nothing has changed
    /// (section 2.2.4), so it is the answer to a value that the model refuses or does not have.
    pub fn status(&self, standard: Standard) -> Status {
        match (standard, self) {
            (_, Self::Model { remedy: Remedy::End | Remedy::ShorterStep, .. })
            | (Standard::Fmi2, Self::NoStatus { .. })
            | (
                Standard::Fmi3,
                Self::Refused(_) | Self::State { .. } | Self::Seed { .. } | Self::NotFinite { .. },
            ) => Status::Discard,
            _ => Status::Error,
        }
    }
}

/// The largest value reference of so many.
fn last(count: usize) -> String {
    match count.checked_sub(1) {
        Some(last) => format!("the last one is {last}"),
        None => "the model has no variables".to_string(),
    }
}
