//! One instance as the host holds it.

use crate::bindings::fmi::fmi3::callbacks::log_message;
use crate::bindings::fmi::fmi3::types::Status;
use fmi_model::failure::{Failure, Outcome};
use fmi_model::guard;
use fmi_model::instance::{Instance, Interface};
use fmi_model::instantiate::Request;
use fmi_model::model::{Model, Resources};
use fmi_model::phase::Call;
use fmi_model::standard::Standard;
use fmi_model::status;
use std::cell::RefCell;

/// An instance and its name; the host drops it.
#[derive(Debug)]
pub struct Handle<M: Model> {
    name: String,
    instance: RefCell<Instance<M>>,
    /// Whether a step may say that it ended early.
    pub(crate) early_return_allowed: bool,
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
        // A component reads no files: of data that can be replaced it has the built-in ones.
        let has_folder =
            !resource_path.is_empty() && !matches!(M::RESOURCES, Resources::Replaceable(_));
        let request = Request {
            name: &name,
            interface,
            token_argument: "instantiationToken",
            token,
            resources: has_folder.then(|| resource_path.into()),
            logging_on,
        };
        match Instance::instantiate(request) {
            Ok(instance) => {
                let instance = RefCell::new(instance);
                Some(Self { name, instance, early_return_allowed: false })
            }
            Err(problem) => refuse(interface, &name, &problem.to_string()),
        }
    }

    /// Makes one call on the instance; its messages go out when nothing borrows the instance any more.
    pub fn call(&self, call: &Call, body: impl FnOnce(&mut Instance<M>) -> Outcome) -> Status {
        let mut body = Some(body);
        self.run(call, &mut |instance| body.take().map_or(Ok(()), |body| body(instance)))
    }

    /// Not generic over the body, which makes the component a fifth smaller.
    fn run(&self, call: &Call, body: &mut dyn FnMut(&mut Instance<M>) -> Outcome) -> Status {
        let (status, messages) = {
            let mut instance = self.instance.borrow_mut();
            (guard::run(&mut instance, call, body), instance.log.take())
        };
        for message in &messages {
            let category = message.category.name().to_string_lossy();
            let text = message.escaped(Standard::Fmi3);
            log_message(&self.name, status_of(message.status), &category, &text.to_string_lossy());
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

/// No instance: tells the host why.
pub fn refuse<T>(interface: Interface, name: &str, problem: &str) -> Option<T> {
    let call = match interface {
        Interface::CoSimulation => "fmi3InstantiateCoSimulation",
        Interface::ModelExchange => "fmi3InstantiateModelExchange",
    };
    log_message(name, Status::Error, "logStatusError", &format!("{call}: {problem}"));
    None
}

fn status_of(status: status::Status) -> Status {
    match status {
        status::Status::Ok => Status::Ok,
        status::Status::Warning => Status::Warning,
        status::Status::Discard => Status::Discard,
        status::Status::Error => Status::Error,
        status::Status::Fatal => Status::Fatal,
    }
}
