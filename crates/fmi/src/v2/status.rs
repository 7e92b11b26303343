//! Status of steps (section 4.2.3): they are synchronous, so most of it does not exist.

use crate::failure::{Failure, Outcome};
use crate::instance::Instance;
use crate::model::Model;
use crate::v2::sys::StatusKind;

impl<M: Model> Instance<M> {
    /// `fmi2CancelStep`: never legal, as no step is ever pending.
    ///
    /// # Errors
    /// [`Failure::NotProvided`].
    pub fn cancel_step(&mut self) -> Outcome {
        Err(Failure::NotProvided { capability: "asynchronous steps" })
    }

    /// `fmi2GetRealStatus`: the end of the last step, or the instant at which it ended early.
    ///
    /// # Errors
    /// [`Failure::NoStatus`].
    pub fn real_status(&self, kind: StatusKind) -> Result<f64, Failure> {
        if kind == StatusKind::LAST_SUCCESSFUL_TIME {
            return Ok(self.time());
        }
        Err(no_status(kind, "fmi2Real"))
    }

    /// `fmi2GetBooleanStatus`: whether the simulation should end.
    ///
    /// # Errors
    /// [`Failure::NoStatus`].
    pub fn boolean_status(&self, kind: StatusKind) -> Result<bool, Failure> {
        if kind == StatusKind::TERMINATED {
            return Ok(self.ended());
        }
        Err(no_status(kind, "fmi2Boolean"))
    }
}

/// Why a kind of status is not available, and where else it is.
pub(crate) fn no_status(kind: StatusKind, asked: &'static str) -> Failure {
    let elsewhere = match kind {
        StatusKind::LAST_SUCCESSFUL_TIME => "call fmi2GetRealStatus",
        StatusKind::TERMINATED => "call fmi2GetBooleanStatus",
        StatusKind::DO_STEP_STATUS | StatusKind::PENDING_STATUS => "no step is ever pending",
        _ => "there are 0 to 3",
    };
    Failure::NoStatus { kind: kind.0, asked, elsewhere }
}
