//! Functions of Co-Simulation.

use crate::bindings::exports::fmi::fmi3::co_simulation::{
    CoSimulationInstance, DoStepResult, GuestCoSimulationInstance,
};
use crate::bindings::fmi::fmi3::types::{
    DiscreteStatesInfo, IntervalFraction, IntervalQualifier, Status, VariableDependency,
};
use crate::handle::{Handle, refuse};
use crate::shared::shared_functions;
use fmi_model::failure::Failure;
use fmi_model::instance::Interface;
use fmi_model::model::Model;
use fmi_model::v3::{calls, types};

impl<M: Model> GuestCoSimulationInstance for Handle<M> {
    fn instantiate_co_simulation(
        instance_name: String,
        instantiation_token: String,
        resource_path: String,
        _visible: bool,
        logging_on: bool,
        event_mode_used: bool,
        early_return_allowed: bool,
        _required_intermediate_variables: Vec<u32>,
    ) -> Option<CoSimulationInstance> {
        if event_mode_used {
            let problem = "eventModeUsed is true, but there are no events: the model description says \
                           hasEventMode = false";
            return refuse(Interface::CoSimulation, &instance_name, problem);
        }
        let mut handle = Self::instantiate(
            Interface::CoSimulation,
            instance_name,
            &instantiation_token,
            &resource_path,
            logging_on,
        )?;
        handle.early_return_allowed = early_return_allowed;
        Some(CoSimulationInstance::new(handle))
    }

    shared_functions!();

    fn set_input_derivatives(&self, requests: Vec<(u32, u32)>, values: Vec<f64>) -> Status {
        self.set_input_derivatives(requests, values)
    }

    fn do_step(
        &self,
        current_communication_point: f64,
        communication_step_size: f64,
        _no_set_fmu_state_prior_to_current_point: bool,
    ) -> Result<DoStepResult, Status> {
        let end = current_communication_point + communication_step_size;
        self.ask(&calls::DO_STEP, |instance| {
            instance.whole_step(current_communication_point, communication_step_size)?;
            let last_successful_time = instance.time();
            Ok(DoStepResult {
                last_successful_time,
                event_handling_needed: false,
                terminate_simulation: instance.ended(),
                early_return: self.early_return_allowed && last_successful_time < end,
            })
        })
    }
}
