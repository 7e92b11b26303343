//! Making and freeing instances (section 2.3.1).

use super::entry::Environment;
use crate::abi::{self, input, string};
use crate::failure::Failure;
use crate::instance::{Instance as Of, Interface};
use crate::instantiate::Request;
use crate::location;
use crate::model::{Model, Simulation};
use crate::v3::sys::{
    Boolean, ClockUpdateCallback, FmiString, Instance, InstanceEnvironment,
    IntermediateUpdateCallback, LogMessageCallback, PreemptionCallback, ValueReference,
};
use crate::variable::Role;

/// What all interfaces need.
struct Arguments {
    name: FmiString,
    token: FmiString,
    resources: FmiString,
    logging_on: Boolean,
}

/// A new instance.
///
/// # Safety
/// The arguments are NULL or C strings.
unsafe fn make<M: Model>(arguments: &Arguments, interface: Interface) -> Result<Of<M>, String> {
    // SAFETY: by this function's contract.
    let text = |argument, pointer| {
        unsafe { string(argument, pointer) }.map_err(|failure: Failure| failure.to_string())
    };
    let name = text("instanceName", arguments.name)?;
    let token = text("instantiationToken", arguments.token)?;
    // A path; some masters pass a URI, as in FMI 2.0.
    let resources = match arguments.resources.is_null() {
        true => None,
        false => location::folder(&text("resourcePath", arguments.resources)?),
    };
    let request = Request {
        name: &name,
        interface,
        token_argument: "instantiationToken",
        token: &token,
        resources,
        logging_on: arguments.logging_on.is_true(),
    };
    Of::instantiate(request).map_err(|problem| problem.to_string())
}

/// Whether there is an input among these, all of which the master may set or read within a step.
fn moves_inputs<M: Model>(references: &[ValueReference]) -> Result<bool, String> {
    let mut input = false;
    for &reference in references {
        let role = M::VARIABLES.get(reference as usize).map(|variable| variable.role);
        let exchanged =
            matches!(role, Some(Role::Input(_) | Role::Output(_) | Role::OutputState(_)));
        if !(exchanged && M::Simulation::INTERNAL_STEP.is_some()) {
            return Err(format!(
                "requiredIntermediateVariables names the value reference {reference}, which has no \
                 intermediateUpdate in the model description"
            ));
        }
        input |= matches!(role, Some(Role::Input(_)));
    }
    Ok(input)
}

pub unsafe fn fmi3InstantiateModelExchange<M: Model>(
    instanceName: FmiString,
    instantiationToken: FmiString,
    resourcePath: FmiString,
    _visible: Boolean,
    loggingOn: Boolean,
    instanceEnvironment: InstanceEnvironment,
    logMessage: Option<LogMessageCallback>,
) -> Instance {
    let environment = Environment {
        pointer: instanceEnvironment,
        log: logMessage,
        update: None,
        early_return_allowed: false,
        moves_inputs: false,
    };
    let arguments = Arguments {
        name: instanceName,
        token: instantiationToken,
        resources: resourcePath,
        logging_on: loggingOn,
    };
    // SAFETY: the master passes NULL or C strings, and callbacks of the standard.
    unsafe {
        abi::create("fmi3InstantiateModelExchange", instanceName, environment, || {
            make::<M>(&arguments, Interface::ModelExchange)
        })
    }
}

pub unsafe fn fmi3InstantiateCoSimulation<M: Model>(
    instanceName: FmiString,
    instantiationToken: FmiString,
    resourcePath: FmiString,
    _visible: Boolean,
    loggingOn: Boolean,
    eventModeUsed: Boolean,
    earlyReturnAllowed: Boolean,
    requiredIntermediateVariables: *const ValueReference,
    nRequiredIntermediateVariables: usize,
    instanceEnvironment: InstanceEnvironment,
    logMessage: Option<LogMessageCallback>,
    intermediateUpdate: Option<IntermediateUpdateCallback>,
) -> Instance {
    let mut environment = Environment {
        pointer: instanceEnvironment,
        log: logMessage,
        update: intermediateUpdate,
        early_return_allowed: earlyReturnAllowed.is_true(),
        moves_inputs: false,
    };
    let arguments = Arguments {
        name: instanceName,
        token: instantiationToken,
        resources: resourcePath,
        logging_on: loggingOn,
    };
    // SAFETY: the master passes an array of the length it states.
    let references = unsafe {
        let argument = "requiredIntermediateVariables";
        input(argument, requiredIntermediateVariables, nRequiredIntermediateVariables)
    };
    let moves = references
        .map_err(|failure| failure.to_string())
        .and_then(|references| moves_inputs::<M>(references));
    environment.moves_inputs = moves == Ok(true);
    // SAFETY: the master passes NULL or C strings, and callbacks of the standard.
    unsafe {
        abi::create("fmi3InstantiateCoSimulation", instanceName, environment, || {
            if eventModeUsed.is_true() {
                return Err(
                    "eventModeUsed is true, but there are no events: the model description \
                            says hasEventMode = false"
                        .to_string(),
                );
            }
            moves?;
            make::<M>(&arguments, Interface::CoSimulation)
        })
    }
}

pub unsafe fn fmi3InstantiateScheduledExecution<M: Model>(
    instanceName: FmiString,
    _instantiationToken: FmiString,
    _resourcePath: FmiString,
    _visible: Boolean,
    _loggingOn: Boolean,
    instanceEnvironment: InstanceEnvironment,
    logMessage: Option<LogMessageCallback>,
    _clockUpdate: Option<ClockUpdateCallback>,
    _lockPreemption: Option<PreemptionCallback>,
    _unlockPreemption: Option<PreemptionCallback>,
) -> Instance {
    let environment = Environment {
        pointer: instanceEnvironment,
        log: logMessage,
        update: None,
        early_return_allowed: false,
        moves_inputs: false,
    };
    // SAFETY: the master passes NULL or a C string, and callbacks of the standard.
    unsafe {
        abi::create::<M, _>("fmi3InstantiateScheduledExecution", instanceName, environment, || {
            Err("the model description has no ScheduledExecution".to_string())
        })
    }
}

pub unsafe fn fmi3FreeInstance<M: Model>(instance: Instance) {
    // SAFETY: the master passes what it got from an instantiation, once.
    unsafe { abi::free::<M, Environment>(instance) }
}
