//! Functions of Co-Simulation.

use crate::absent::not_provided;
use crate::bindings::exports::fmi::fmi3::co_simulation::{
    CoSimulationInstance, DoStepResult, GuestCoSimulationInstance,
};
use crate::bindings::fmi::fmi3::types::{
    DiscreteStatesInfo, IntervalFraction, IntervalQualifier, Status, VariableDependency,
};
use crate::calls;
use crate::handle::{Handle, refuse};
use crate::shared::shared_functions;
use fmi_model::instance::Interface;
use fmi_model::model::Model;

impl<M: Model> GuestCoSimulationInstance for Handle<M> {
    fn instantiate_co_simulation(
        instance_name: String,
        instantiation_token: String,
        resource_path: String,
        _visible: bool,
        logging_on: bool,
        event_mode_used: bool,
        _early_return_allowed: bool,
        _required_intermediate_variables: Vec<u32>,
    ) -> Option<CoSimulationInstance> {
        if event_mode_used {
            refuse(&instance_name, "eventModeUsed: the model description says hasEventMode = false");
            return None;
        }
        Self::instantiate(
            Interface::CoSimulation,
            instance_name,
            &instantiation_token,
            &resource_path,
            logging_on,
        )
        .map(CoSimulationInstance::new)
    }

    shared_functions!();

    fn set_input_derivatives(&self, requests: Vec<(u32, u32)>, values: Vec<f64>) -> Status {
        self.set_input_derivatives(requests, values)
    }

    /// What ends early is discarded: the interface has no place for the reason, which is in the log, nor
    /// for the last valid instant, which is the value of `time`.
    fn do_step(
        &self,
        current_communication_point: f64,
        communication_step_size: f64,
        _no_set_fmu_state_prior_to_current_point: bool,
    ) -> Result<DoStepResult, Status> {
        self.ask(&calls::DO_STEP, |instance| {
            instance.do_step(current_communication_point, communication_step_size)?;
            Ok(DoStepResult {
                last_successful_time: instance.time(),
                event_handling_needed: false,
                terminate_simulation: false,
                early_return: false,
            })
        })
    }
}
