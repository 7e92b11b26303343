//! One instance as the host holds it.

use crate::bindings::fmi::fmi3::callbacks::log_message;
use crate::bindings::fmi::fmi3::types::Status;
use crate::calls::Call;
use fmi_model::failure::{Failure, Outcome};
use fmi_model::guard;
use fmi_model::instance::{Instance, Interface};
use fmi_model::instantiate::Request;
use fmi_model::log::Message;
use fmi_model::model::Model;
use fmi_model::v2::sys;
use std::cell::RefCell;

/// An instance and its name; the host drops it.
#[derive(Debug)]
pub struct Handle<M: Model> {
    name: String,
    instance: RefCell<Instance<M>>,
}

impl<M: Model> Handle<M> {
    /// `fmi3InstantiateCoSimulation` and `fmi3InstantiateModelExchange`; the host is told why there is
    /// none.
    pub fn instantiate(
        interface: Interface,
        name: String,
        token: &str,
        resource_path: &str,
        logging_on: bool,
    ) -> Option<Self> {
        let request = Request {
            name: &name,
            interface,
            token_argument: "instantiationToken",
            token,
            resources: (!resource_path.is_empty()).then(|| resource_path.into()),
            logging_on,
        };
        match Instance::instantiate(request) {
            Ok(instance) => Some(Self { name, instance: RefCell::new(instance) }),
            Err(problem) => {
                refuse(&name, &problem.to_string());
                None
            }
        }
    }

    /// Makes one call on the instance; its messages go out when nothing borrows the instance any more.
    pub fn call(&self, call: &Call, body: impl FnOnce(&mut Instance<M>) -> Outcome) -> Status {
        let (status, messages) = {
            let mut instance = self.instance.borrow_mut();
            (guard::run(&mut instance, call, body), instance.log.take())
        };
        for message in &messages {
            let category = message.category.name().to_string_lossy();
            log_message(&self.name, status_of(message.status), &category, &text(message));
        }
        status_of(status)
    }

    /// The same for a call with an answer.
    pub fn ask<T>(
        &self,
        call: &Call,
        body: impl FnOnce(&mut Instance<M>) -> Result<T, Failure>,
    ) -> Result<T, Status> {
        let mut answer = None;
        let status = self.call(call, |instance| {
            answer = Some(body(instance)?);
            Ok(())
        });
        answer.ok_or(status)
    }
}

/// Tells the host why there is no instance.
pub fn refuse(name: &str, text: &str) {
    log_message(name, Status::Error, "logStatusError", &format!("fmi3Instantiate: {text}"));
}

fn status_of(status: sys::Status) -> Status {
    match status {
        sys::Status::Ok => Status::Ok,
        sys::Status::Warning => Status::Warning,
        sys::Status::Discard => Status::Discard,
        sys::Status::Error => Status::Error,
        _ => Status::Fatal,
    }
}

/// A text that no `printf` reads.
fn text(message: &Message) -> String {
    message.text.to_string_lossy().replace("%%", "%")
}
