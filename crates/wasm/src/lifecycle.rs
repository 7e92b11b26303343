//! From instantiation to the end, and the FMU state.

use crate::bindings::fmi::fmi3::types::{DiscreteStatesInfo, Status};
use crate::handle::Handle;
use fmi_model::instance::Instance;
use fmi_model::model::Model;
use fmi_model::v3::calls;

impl<M: Model> Handle<M> {
    pub(crate) fn set_debug_logging(&self, logging_on: bool, categories: Vec<String>) -> Status {
        self.call(&calls::SET_DEBUG_LOGGING, |instance| {
            instance.set_debug_logging(logging_on, &categories)
        })
    }

    pub(crate) fn enter_initialization_mode(
        &self,
        tolerance: Option<f64>,
        start_time: f64,
        stop_time: Option<f64>,
    ) -> Status {
        self.call(&calls::ENTER_INITIALIZATION_MODE, |instance| {
            instance.setup_experiment(tolerance, start_time, stop_time)?;
            instance.enter_initialization_mode()
        })
    }

    pub(crate) fn exit_initialization_mode(&self) -> Status {
        self.call(&calls::EXIT_INITIALIZATION_MODE, Instance::exit_initialization_mode)
    }

    pub(crate) fn enter_event_mode(&self) -> Status {
        self.call(&calls::ENTER_EVENT_MODE, Instance::enter_event_mode)
    }

    pub(crate) fn update_discrete_states(&self) -> Result<DiscreteStatesInfo, Status> {
        self.ask(&calls::UPDATE_DISCRETE_STATES, |instance| {
            Ok(DiscreteStatesInfo {
                new_discrete_states_needed: false,
                terminate_simulation: instance.ended(),
                nominals_of_continuous_states_changed: false,
                values_of_continuous_states_changed: false,
                next_event_time_defined: false,
                next_event_time: 0.0,
            })
        })
    }

    pub(crate) fn terminate(&self) -> Status {
        self.call(&calls::TERMINATE, Instance::terminate)
    }

    pub(crate) fn reset(&self) -> Status {
        self.call(&calls::RESET, Instance::reset)
    }

    pub(crate) fn get_fmu_state(&self) -> Result<Vec<u8>, Status> {
        self.ask(&calls::GET_FMU_STATE, |instance| instance.state()?.encode())
    }

    pub(crate) fn set_fmu_state(&self, state: Vec<u8>) -> Status {
        self.call(&calls::SET_FMU_STATE, |instance| {
            let state = instance.deserialize(&state)?;
            instance.set_state(&state)
        })
    }
}
