//! The one way into an instance: legal order before the call; afterwards, whatever happened, a
//! status and a message.

use crate::failure::{Failure, Outcome};
use crate::instance::Instance;
use crate::model::Model;
use crate::v2::calls::{Call, Phase};
use crate::v2::sys::Status;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs `body`; if it panics, `failed` makes the result from the panic's text.
///
/// The process-wide panic hook stays as it is: it belongs to the program that loaded the FMU.
pub fn guarded<T>(body: impl FnOnce() -> T, failed: impl FnOnce(String) -> T) -> T {
    // Nothing that a panic may have left half-changed is used again: the state becomes fatal.
    catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| failed(text_of(payload)))
}

fn text_of(payload: Box<dyn Any + Send>) -> String {
    match payload.downcast::<String>() {
        Ok(text) => *text,
        Err(payload) => payload
            .downcast::<&'static str>()
            .map_or_else(|_| "no further information".to_string(), |text| text.to_string()),
    }
}

/// Makes one call on an instance.
pub fn run<M: Model>(
    instance: &mut Instance<M>,
    call: &Call,
    body: impl FnOnce(&mut Instance<M>) -> Outcome,
) -> Status {
    let phase = instance.phase();
    let (status, text) = if phase == Phase::Fatal {
        (Status::Fatal, "after an internal error only fmi2FreeInstance is allowed".to_string())
    } else {
        let outcome = if call.allowed_in(phase) {
            guarded(|| body(instance).map_err(Ok), |panic| Err(Err(panic)))
        } else {
            Err(Ok(Failure::IllegalCall { phase, allowed: call.allowed }))
        };
        match outcome {
            Ok(()) => return Status::Ok,
            Err(Ok(failure)) => {
                let status = failure.status();
                instance.log.push(status, || format!("{}: {failure}", call.name));
                return status;
            }
            Err(Err(panic)) => (Status::Fatal, format!("internal error: {panic}")),
        }
    };
    instance.ruin();
    instance.log.push(status, || format!("{}: {text}", call.name));
    status
}
