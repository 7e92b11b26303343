//! Functions of Model Exchange.

use crate::bindings::exports::fmi::fmi3::model_exchange::{
    CompletedStepResult, GuestModelExchangeInstance, ModelExchangeInstance,
};
use crate::bindings::fmi::fmi3::types::{
    DiscreteStatesInfo, IntervalFraction, IntervalQualifier, Status, VariableDependency,
};
use crate::handle::Handle;
use crate::shared::shared_functions;
use fmi_model::exchange::EVENT_INDICATORS;
use fmi_model::failure::Failure;
use fmi_model::instance::{Instance, Interface};
use fmi_model::model::Model;
use fmi_model::table;
use fmi_model::v3::{calls, types};

impl<M: Model> GuestModelExchangeInstance for Handle<M> {
    fn instantiate_model_exchange(
        instance_name: String,
        instantiation_token: String,
        resource_path: String,
        _visible: bool,
        logging_on: bool,
    ) -> Option<ModelExchangeInstance> {
        Self::instantiate(
            Interface::ModelExchange,
            instance_name,
            &instantiation_token,
            &resource_path,
            logging_on,
        )
        .map(ModelExchangeInstance::new)
    }

    shared_functions!();

    fn enter_continuous_time_mode(&self) -> Status {
        self.call(&calls::ENTER_CONTINUOUS_TIME_MODE, Instance::enter_continuous_time_mode)
    }

    fn set_time(&self, time: f64) -> Status {
        self.call(&calls::SET_TIME, |instance| instance.set_time(time))
    }

    fn set_continuous_states(&self, continuous_states: Vec<f64>) -> Status {
        self.call(&calls::SET_CONTINUOUS_STATES, |instance| {
            instance.set_continuous_states(&continuous_states)
        })
    }

    fn get_continuous_state_derivatives(&self) -> Result<Vec<f64>, Status> {
        self.ask(&calls::GET_CONTINUOUS_STATE_DERIVATIVES, |instance| {
            let mut derivatives = Vec::new();
            instance.derivatives(table::states::<M>(), |present| derivatives.extend(present))?;
            Ok(derivatives)
        })
    }

    fn get_event_indicators(&self) -> Result<Vec<f64>, Status> {
        self.ask(&calls::GET_EVENT_INDICATORS, |instance| {
            instance.event_indicators(EVENT_INDICATORS)?;
            Ok(vec![0.0; EVENT_INDICATORS])
        })
    }

    fn get_continuous_states(&self) -> Result<Vec<f64>, Status> {
        self.ask(&calls::GET_CONTINUOUS_STATES, |instance| {
            let mut states = Vec::new();
            instance.continuous_states(table::states::<M>(), |present| states.extend(present))?;
            Ok(states)
        })
    }

    fn get_nominals_of_continuous_states(&self) -> Result<Vec<f64>, Status> {
        self.ask(&calls::GET_NOMINALS_OF_CONTINUOUS_STATES, |instance| {
            let mut nominals = vec![0.0; table::states::<M>()];
            instance.nominals(nominals.len(), |i, nominal| nominals[i] = nominal)?;
            Ok(nominals)
        })
    }

    fn get_number_of_event_indicators(&self) -> Result<u64, Status> {
        self.ask(&calls::GET_NUMBER_OF_EVENT_INDICATORS, |_| Ok(EVENT_INDICATORS as u64))
    }

    fn get_number_of_continuous_states(&self) -> Result<u64, Status> {
        self.ask(&calls::GET_NUMBER_OF_CONTINUOUS_STATES, |_| Ok(table::states::<M>() as u64))
    }

    fn completed_integrator_step(
        &self,
        _no_set_fmu_state_prior_to_current_point: bool,
    ) -> Result<CompletedStepResult, Status> {
        self.ask(&calls::COMPLETED_INTEGRATOR_STEP, |instance| {
            let terminate_simulation = instance.completed_integrator_step()?;
            Ok(CompletedStepResult { enter_event_mode: false, terminate_simulation })
        })
    }
}
