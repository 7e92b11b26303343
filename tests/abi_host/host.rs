//! A master whose calls are watched.

use crate::common::fmi2::{Api, Slave};
use crate::common::reference;
use crate::watch::Watch;
use ahv::flight::Setup;
use ahv::variables::TABLE;
use ahv::vehicle::{STATES, State};
use fmi_model::instance::Interface;
use fmi_model::v2::sys::{EventInfo, FmuState, Status, StatusKind};
use fmi_model::{Kind, Role};
use std::ptr::{null, null_mut};

/// An instance, and what its calls are watched with.
pub struct Host<'a> {
    pub slave: Slave<'a>,
    watch: &'a mut Watch,
    /// What is being tried, for the report.
    pub scene: String,
}

/// A call of a function of the library on the instance.
macro_rules! call {
    ($host:ident.$function:ident $name:literal ($($argument:expr),*)) => {{
        let (function, c) = ($host.slave.api.$function, $host.slave.c);
        // SAFETY: the instance lives, the arrays have the lengths given.
        $host.watch.call($name, &$host.scene, || unsafe { function(c, $($argument),*) })
    }};
}

/// Value references of the variables whose role fits.
pub fn references(fits: impl Fn(Role<Setup>) -> bool) -> Vec<u32> {
    (0..TABLE.len() as u32).filter(|&i| fits(TABLE[i as usize].role)).collect()
}

impl<'a> Host<'a> {
    pub fn new(api: &'a Api, watch: &'a mut Watch, interface: Interface, scene: &str) -> Self {
        let slave = watch.call("fmi2Instantiate", scene, || Slave::with(api, interface, false));
        Self { slave, watch, scene: scene.into() }
    }

    pub fn set(&mut self, name: &str, value: f64) -> Status {
        let vr = reference(name);
        self.scene = format!("{} {name}={value}", self.scene);
        call!(self.set_real "fmi2SetReal" (&vr, 1, &value))
    }

    pub fn set_integer(&mut self, name: &str, value: i32) -> Status {
        let vr = reference(name);
        self.scene = format!("{} {name}={value}", self.scene);
        call!(self.set_integer "fmi2SetInteger" (&vr, 1, &value))
    }

    pub fn set_boolean(&mut self, name: &str, value: i32) -> Status {
        let vr = reference(name);
        self.scene = format!("{} {name}={value}", self.scene);
        call!(self.set_boolean "fmi2SetBoolean" (&vr, 1, &value))
    }

    pub fn setup(&mut self, tolerance: f64, start: f64, stop: f64) -> Status {
        call!(self.setup_experiment "fmi2SetupExperiment" (1, tolerance, start, 1, stop))
    }

    /// Up to the end of initialization; whether there is an initial state.
    pub fn start(&mut self) -> bool {
        assert_eq!(self.setup(1e-8, 0.0, f64::MAX), Status::Ok);
        self.initialise()
    }

    /// From the experiment to the end of initialization.
    pub fn initialise(&mut self) -> bool {
        call!(self.enter_initialization_mode "fmi2EnterInitializationMode" ());
        call!(self.exit_initialization_mode "fmi2ExitInitializationMode" ()) == Status::Ok
    }

    pub fn step(&mut self, point: f64, step: f64) -> Status {
        call!(self.do_step "fmi2DoStep" (point, step, 0))
    }

    /// Where the instance is.
    pub fn time(&mut self) -> f64 {
        let (mut time, kind) = (f64::NAN, StatusKind::LAST_SUCCESSFUL_TIME);
        call!(self.get_real_status "fmi2GetRealStatus" (kind, &mut time));
        time
    }

    /// Reads all variables.
    pub fn read(&mut self) {
        let of = |kind: fn(&Kind) -> bool| -> Vec<u32> {
            (0..TABLE.len() as u32).filter(|&i| kind(&TABLE[i as usize].kind)).collect()
        };
        let reals = of(|kind| matches!(kind, Kind::Real(_)));
        let mut values = vec![0.0; reals.len()];
        call!(self.get_real "fmi2GetReal" (reals.as_ptr(), reals.len(), values.as_mut_ptr()));
        let (integers, booleans) = (
            of(|kind| matches!(kind, Kind::Enumeration(..))),
            of(|kind| matches!(kind, Kind::Boolean)),
        );
        let mut values = vec![0; TABLE.len()];
        call!(self.get_integer "fmi2GetInteger"
            (integers.as_ptr(), integers.len(), values.as_mut_ptr()));
        call!(self.get_boolean "fmi2GetBoolean"
            (booleans.as_ptr(), booleans.len(), values.as_mut_ptr()));
    }

    /// All derivatives by states and inputs, along a step of this size.
    pub fn directional_derivatives(&mut self, seed: f64) {
        let unknowns = references(|role| {
            matches!(role, Role::Output(_) | Role::OutputState(_) | Role::Derivative(_))
        });
        let knowns = references(|role| {
            matches!(role, Role::OutputState(_) | Role::LocalState(_) | Role::Input(_))
        });
        let (mut change, count) = (vec![0.0; unknowns.len()], unknowns.len());
        for known in knowns {
            call!(self.directional_derivative "fmi2GetDirectionalDerivative"
                (unknowns.as_ptr(), count, &known, 1, &seed, change.as_mut_ptr()));
        }
    }

    /// How an input goes on within the next step.
    pub fn lead(&mut self, name: &str, order: i32, value: f64) -> Status {
        let vr = reference(name);
        call!(self.set_input_derivatives "fmi2SetRealInputDerivatives" (&vr, 1, &order, &value))
    }

    pub fn output_rates(&mut self) {
        let outputs = references(|role| matches!(role, Role::Output(_) | Role::OutputState(_)));
        let (orders, mut rates) = (vec![1; outputs.len()], vec![0.0; outputs.len()]);
        call!(self.get_output_derivatives "fmi2GetRealOutputDerivatives"
            (outputs.as_ptr(), outputs.len(), orders.as_ptr(), rates.as_mut_ptr()));
    }

    /// To bytes, from bytes, and back into the instance.
    pub fn round_trip(&mut self) {
        let (mut state, mut copy, mut size): (FmuState, FmuState, _) = (null_mut(), null_mut(), 0);
        call!(self.get_state "fmi2GetFMUstate" (&mut state));
        call!(self.state_size "fmi2SerializedFMUstateSize" (state, &mut size));
        let mut bytes = vec![0; size];
        call!(self.serialize "fmi2SerializeFMUstate" (state, bytes.as_mut_ptr(), size));
        call!(self.deserialize "fmi2DeSerializeFMUstate" (bytes.as_ptr(), size, &mut copy));
        assert_eq!(call!(self.set_state "fmi2SetFMUstate" (copy)), Status::Ok, "{}", self.scene);
        for mut state in [state, copy] {
            call!(self.free_state "fmi2FreeFMUstate" (&mut state));
        }
    }

    pub fn enter_continuous_time_mode(&mut self) {
        let mut event = EventInfo::default();
        call!(self.new_discrete_states "fmi2NewDiscreteStates" (&mut event));
        call!(self.enter_continuous_time_mode "fmi2EnterContinuousTimeMode" ());
    }

    pub fn enter_event_mode(&mut self) {
        call!(self.enter_event_mode "fmi2EnterEventMode" ());
    }

    pub fn states(&mut self) -> State {
        let mut x = [0.0; STATES];
        call!(self.get_continuous_states "fmi2GetContinuousStates" (x.as_mut_ptr(), STATES));
        x
    }

    pub fn set_states(&mut self, x: &State) {
        call!(self.set_continuous_states "fmi2SetContinuousStates" (x.as_ptr(), STATES));
    }

    pub fn set_time(&mut self, time: f64) {
        call!(self.set_time "fmi2SetTime" (time));
    }

    pub fn rates(&mut self) -> State {
        let mut rates = [0.0; STATES];
        call!(self.get_derivatives "fmi2GetDerivatives" (rates.as_mut_ptr(), STATES));
        rates
    }

    /// Ends an integrator's step; whether the simulation should end.
    pub fn completed(&mut self) -> bool {
        let (mut event, mut end) = (0, 0);
        call!(self.completed_integrator_step "fmi2CompletedIntegratorStep"
            (1, &mut event, &mut end));
        end != 0
    }

    /// Everything that tells little, and the end.
    pub fn finish(self) {
        let mut nominals = [0.0; STATES];
        call!(self.get_nominals_of_continuous_states "fmi2GetNominalsOfContinuousStates"
            (nominals.as_mut_ptr(), STATES));
        call!(self.get_event_indicators "fmi2GetEventIndicators" (null_mut(), 0));
        call!(self.set_debug_logging "fmi2SetDebugLogging" (0, 0, null()));
        call!(self.get_string "fmi2GetString" (null(), 0, null_mut()));
        call!(self.set_string "fmi2SetString" (null(), 0, null()));
        call!(self.cancel_step "fmi2CancelStep" ());
        let (kind, mut status, mut integer) = (StatusKind(0), Status::Ok, 0);
        call!(self.get_status "fmi2GetStatus" (kind, &mut status));
        call!(self.get_integer_status "fmi2GetIntegerStatus" (kind, &mut integer));
        call!(self.get_boolean_status "fmi2GetBooleanStatus" (kind, &mut integer));
        let mut text = null();
        call!(self.get_string_status "fmi2GetStringStatus" (kind, &mut text));
        call!(self.terminate "fmi2Terminate" ());
        call!(self.reset "fmi2Reset" ());
        let Self { slave, watch, scene } = self;
        watch.call("fmi2FreeInstance", &scene, || drop(slave));
    }
}
