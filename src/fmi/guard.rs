//! The one way into an instance: legal order before the call; afterwards, whatever happened, a
//! status and a message.

use crate::fmi::failure::{Failure, Outcome};
use crate::fmi::instance::Instance;
use crate::fmi::lifecycle::{Call, Phase};
use crate::fmi::sys::Status;
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
pub fn run(
    instance: &mut Instance,
    call: &Call,
    body: impl FnOnce(&mut Instance) -> Outcome,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi::instance::Interface;
    use crate::fmi::lifecycle::{CALLS, RESET};
    use std::panic::resume_unwind;

    // `resume_unwind` panics without the hook, so the test output stays clean.
    fn panicking(text: &'static str) -> impl FnOnce(&mut Instance) -> Outcome {
        move |_| resume_unwind(Box::new(text.to_string()))
    }

    #[test]
    fn a_panic_becomes_fatal_is_logged_without_debug_logging_and_leaves_only_freeing() {
        let mut instance = Instance::new(Interface::CoSimulation, false).unwrap();
        assert_eq!(run(&mut instance, &RESET, panicking("100% lost")), Status::Fatal);
        let messages = instance.log.take();
        assert_eq!(messages.len(), 1);
        assert_eq!(messages[0].status, Status::Fatal);
        assert_eq!(messages[0].category.name(), c"logStatusFatal");
        assert_eq!(messages[0].text.as_c_str(), c"fmi2Reset: internal error: 100%% lost");
        for call in CALLS {
            let status = run(&mut instance, call, |_| unreachable!("{} ran", call.name));
            assert_eq!(status, Status::Fatal, "{}", call.name);
        }
    }

    #[test]
    fn every_kind_of_panic_payload_is_caught() {
        let text = |payload: Box<dyn Any + Send>| guarded(|| resume_unwind(payload), |text| text);
        assert_eq!(text(Box::new("static")), "static");
        assert_eq!(text(Box::new("owned".to_string())), "owned");
        assert_eq!(text(Box::new(7)), "no further information");
    }

    #[test]
    fn a_panic_in_one_instance_leaves_the_others_alone() {
        let (mut ruined, mut other) = (
            Instance::new(Interface::CoSimulation, false).unwrap(),
            Instance::new(Interface::CoSimulation, false).unwrap(),
        );
        assert_eq!(run(&mut ruined, &RESET, panicking("")), Status::Fatal);
        assert_eq!(run(&mut other, &RESET, |instance| instance.reset()), Status::Ok);
    }
}
