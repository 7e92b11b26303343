//! What a call can be refused for. The text is what a user reads in the master's log.

use crate::instance::LARGEST;
use crate::model::{ModelError, Remedy};
use crate::short::short;
use crate::v2::calls::{PHASES, Phase};
use crate::v2::sys::{Status, StatusKind};
use crate::variable::Refused;

/// What a call of the standard comes to.
pub type Outcome = Result<(), Failure>;

/// Why a call did not do what it was asked. The instance is then as it was, but for a step that the
/// model did not complete and an initialisation that failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure {
    /// Out of order.
    #[error("not allowed in state {phase}; allowed in: {}", names(*allowed))]
    IllegalCall {
        /// State of the instance.
        phase: Phase,
        /// Bits of the states in which the call is legal.
        allowed: u16,
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
    #[error("{variable} (value reference {reference}) is no {asked}, it is a {has}")]
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
        "the step ends at {} s, past the stop time {} s of fmi2SetupExperiment",
        short(*end), short(*stop)
    )]
    PastStop {
        /// End of the step.
        end: f64,
        /// Stop time.
        stop: f64,
    },
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
    #[error("status kind {} is not available as {asked}: {}", kind.0, elsewhere(*kind))]
    NoStatus {
        /// What was asked for.
        kind: StatusKind,
        /// Type that the called function gives.
        asked: &'static str,
    },
    /// An optional capability that this FMU does not have.
    #[error("not provided: the model description says {capability}")]
    NotProvided {
        /// Attribute of the model description.
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
        "the FMU state is one of {phase}: it cannot go on where co-simulation and model exchange \
         differ"
    )]
    OtherInterface {
        /// State of the instance that it was taken of.
        phase: Phase,
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

    /// What the function returns. Argument errors are errors and nothing milder: a master must not
    /// go on with a value that was not taken.
    pub fn status(&self) -> Status {
        match self {
            Self::Model { remedy: Remedy::End | Remedy::ShorterStep, .. } => Status::Discard,
            Self::NoStatus { .. } => Status::Discard,
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

/// Why a kind of status is not available, and where else it is.
fn elsewhere(kind: StatusKind) -> &'static str {
    match kind {
        StatusKind::LAST_SUCCESSFUL_TIME => "call fmi2GetRealStatus",
        StatusKind::TERMINATED => "call fmi2GetBooleanStatus",
        StatusKind::DO_STEP_STATUS | StatusKind::PENDING_STATUS => "no step is ever pending",
        _ => "there are 0 to 3",
    }
}

fn names(allowed: u16) -> String {
    let names: Vec<_> = PHASES
        .iter()
        .filter(|phase| allowed & phase.bit() != 0)
        .map(|phase| phase.to_string())
        .collect();
    names.join(", ")
}
