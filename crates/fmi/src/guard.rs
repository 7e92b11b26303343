//! The one way into an instance: legal order before the call; afterwards, whatever happened, a
//! status and a message.

use crate::failure::{Failure, Outcome};
use crate::instance::{Instance, Interface};
use crate::model::Model;
use crate::phase::{Call, Phase};
use crate::standard::Standard;
use crate::status::Status;
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
    instance.log.begin(call.name);
    let text = if phase == Phase::Fatal {
        "after an internal error the instance can only be freed".to_string()
    } else {
        let outcome = match legal(call, phase, instance.interface) {
            Ok(()) => guarded(|| body(instance).map_err(Ok), |panic| Err(Err(panic))),
            Err(failure) => Err(Ok(failure)),
        };
        match outcome {
            Ok(()) => return Status::Ok,
            Err(Ok(failure)) => {
                let status = failure.status(call.standard);
                if status == Status::Error && call.standard == Standard::Fmi3 {
                    // Section 2.3.1 of FMI 3.0: any error ends the run.
                    instance.fail();
                }
                instance.log.push(status, || failure.to_string());
                return status;
            }
            Err(Err(panic)) => format!("internal error: {panic}"),
        }
    };
    instance.ruin();
    instance.log.push(Status::Fatal, || text);
    Status::Fatal
}

fn legal(call: &Call, phase: Phase, interface: Interface) -> Outcome {
    if call.interface.is_some_and(|only| only != interface) {
        return Err(Failure::WrongInterface { interface });
    }
    if call.allowed_in(phase) {
        return Ok(());
    }
    let (phase, allowed) = (phase.name(call.standard), call.allowed_names());
    Err(Failure::IllegalCall { phase, allowed })
}
