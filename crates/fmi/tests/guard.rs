//! Panics and illegal calls become a status and a message.
#![allow(missing_docs)]

use dahlquist::Dahlquist;
use fmi_model::failure::Outcome;
use fmi_model::guard::{guarded, run};
use fmi_model::instance::{Instance, Interface};
use fmi_model::standard::Standard;
use fmi_model::v2::calls::{CALLS, RESET};
use fmi_model::v2::sys::Status;
use std::any::Any;
use std::panic::resume_unwind;

// `resume_unwind` panics without the hook, so the test output stays clean.
fn panicking(text: &'static str) -> impl FnOnce(&mut Instance<Dahlquist>) -> Outcome {
    move |_| resume_unwind(Box::new(text.to_string()))
}

#[test]
fn a_panic_becomes_fatal_is_logged_without_debug_logging_and_leaves_only_freeing() {
    let mut instance = Instance::<Dahlquist>::new(Interface::CoSimulation, false).unwrap();
    assert_eq!(run(&mut instance, &RESET, panicking("100% lost")), Status::Fatal);
    let messages = instance.log.take();
    assert_eq!(messages.len(), 1);
    assert_eq!(messages[0].status, Status::Fatal);
    assert_eq!(messages[0].category.name(), c"logStatusFatal");
    assert_eq!(messages[0].text, "fmi2Reset: internal error: 100% lost");
    assert_eq!(
        messages[0].escaped(Standard::Fmi2).as_c_str(),
        c"fmi2Reset: internal error: 100%% lost"
    );
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
        Instance::<Dahlquist>::new(Interface::CoSimulation, false).unwrap(),
        Instance::<Dahlquist>::new(Interface::CoSimulation, false).unwrap(),
    );
    assert_eq!(run(&mut ruined, &RESET, panicking("")), Status::Fatal);
    assert_eq!(run(&mut other, &RESET, |instance| instance.reset()), Status::Ok);
}
