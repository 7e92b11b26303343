//! The calls of FMI 2.0: one row for each function, with what is known of its result.

use super::player::{Array, BLANK, BLANK_INTEGER, Player, Saved, boolean, integer, real};
use super::shared::{LOG_EVENTS, NUMBERS, call, function, same_plays};
use super::{Game, Play};
use crate::master::Slave;
use crate::master::v2::Api;
use fmi_model::instance::Interface;
use fmi_model::phase::Phase;
use fmi_model::v2::sys::{Boolean, EventInfo, Status, StatusKind};
use fmi_model::{Model, Simulation, table};
use std::ffi::{c_char, c_void};
use std::ptr::{null, null_mut};

impl<M: Model> Game for Api<M> {
    const ONWARD: u64 = 4;

    fn plays() -> Vec<(&'static str, Play<Self>)> {
        let mut plays = own_plays();
        plays.extend(states());
        plays
    }
    fn onward(player: &Player<Self>) -> &'static str {
        match player.phase {
            Phase::Instantiated if !player.has_experiment => "fmi2SetupExperiment",
            Phase::Instantiated => "fmi2EnterInitializationMode",
            Phase::InitializationMode => "fmi2ExitInitializationMode",
            Phase::StepComplete => "fmi2DoStep",
            Phase::EventMode => "fmi2EnterContinuousTimeMode",
            Phase::ContinuousTimeMode => "fmi2SetContinuousStates",
            _ => "fmi2Reset",
        }
    }
    fn instance(api: &Self, interface: Interface, _seed: u64) -> Slave<'_, Self> {
        Slave::with(api, interface, false)
    }
}

fn states<M: Model>() -> Vec<(&'static str, Play<Api<M>>)> {
    same_plays! {
        "fmi2SetDebugLogging" "fmi2ExitInitializationMode" "fmi2Terminate" "fmi2Reset" "fmi2GetFMUstate" "fmi2SetFMUstate" "fmi2FreeFMUstate" "fmi2SerializedFMUstateSize" "fmi2SerializeFMUstate" "fmi2DeSerializeFMUstate" "fmi2EnterEventMode" "fmi2EnterContinuousTimeMode" "fmi2SetTime" "fmi2SetContinuousStates" "fmi2GetDerivatives" "fmi2GetContinuousStates" "fmi2GetNominalsOfContinuousStates" "fmi2GetEventIndicators"
    }
}

fn own_plays<M: Model>() -> Vec<(&'static str, Play<Api<M>>)> {
    vec![
        ("fmi2SetupExperiment", |p, r| {
            let [tolerance, start, stop] = [(); 3].map(|()| r.pick(&NUMBERS));
            let plain = r.below(2) == 0;
            let start = if plain { 0.0 } else { start };
            let given = Boolean::from(!plain);
            call!(p.setup_experiment(given, tolerance, start, given, stop))
        }),
        ("fmi2EnterInitializationMode", |p, _| call!(p.enter_initialization_mode())),
        ("fmi2GetReal", |p, r| {
            let (status, values) = p.read(r, real, BLANK, function!(p.get_real, c v n x));
            let any = |i: u32| M::VARIABLES[i as usize].accepts_non_finite;
            assert!(values.iter().all(|(i, value)| value.is_finite() || any(*i)), "{values:?}");
            status
        }),
        ("fmi2GetInteger", |p, r| {
            p.read(r, integer, BLANK_INTEGER, function!(p.get_integer, c v n x)).0
        }),
        ("fmi2GetBoolean", |p, r| {
            p.read(r, boolean, BLANK_INTEGER, function!(p.get_boolean, c v n x)).0
        }),
        ("fmi2GetString", |p, r| {
            p.read(r, boolean, c"".as_ptr(), function!(p.get_string, c v n x)).0
        }),
        ("fmi2SetReal", |p, r| {
            let (set, get) = (function!(p.set_real, c v n x), function!(p.get_real, c v n x));
            p.write(r, real, |r| r.pick(&NUMBERS), |x| x, set, get)
        }),
        ("fmi2SetInteger", |p, r| {
            let (set, get) = (function!(p.set_integer, c v n x), function!(p.get_integer, c v n x));
            p.write(r, integer, |r| r.below(5) as i32 - 1, |x| x, set, get)
        }),
        ("fmi2SetBoolean", |p, r| {
            let (set, get) = (function!(p.set_boolean, c v n x), function!(p.get_boolean, c v n x));
            p.write(r, boolean, |r| r.below(4) as i32 - 1, |x| x, set, get)
        }),
        ("fmi2SetString", |p, r| {
            let (set, get) = (function!(p.set_string, c v n x), function!(p.get_string, c v n x));
            p.write(r, boolean, |_| c"".as_ptr(), |x| x, set, get)
        }),
        ("fmi2GetDirectionalDerivative", |p, r| {
            let known = Player::<Api<M>>::references(r, real, false);
            let count = known.len();
            let known = Array::new(r, known, 0);
            let seed = Array::of(r, count, |r| r.pick(&NUMBERS));
            let function = p.slave.api.directional_derivative;
            let arrays = (known.pointer, seed.pointer);
            let sound = known.sound && seed.sound;
            // SAFETY: see `call!`.
            let (status, _) = p.read(r, real, BLANK, |c, v, n, x| unsafe {
                function(c, v, n, arrays.0, count, arrays.1, x)
            });
            p.unsound |= !sound || M::Simulation::TANGENT.is_none();
            status
        }),
        ("fmi2NewDiscreteStates", |p, r| {
            let place =
                p.place(r, EventInfo { new_discrete_states_needed: 7, ..Default::default() });
            let status = call!(p.new_discrete_states(place.pointer));
            assert_eq!(place.items[0].new_discrete_states_needed == 7, status != Status::Ok);
            status
        }),
        ("fmi2CompletedIntegratorStep", |p, r| {
            let places = [(); 2].map(|()| p.place(r, BLANK_INTEGER));
            let [event, end] = [&places[0], &places[1]].map(|place| place.pointer);
            let status = call!(p.completed_integrator_step(r.below(2) as Boolean, event, end));
            for place in places {
                assert_eq!(place.items[0] == BLANK_INTEGER, status != Status::Ok);
            }
            status
        }),
        ("fmi2SetRealInputDerivatives", |p, r| {
            let references = Player::<Api<M>>::references(r, real, true);
            let count = references.len();
            let references = Array::new(r, references, 0);
            let orders = Array::of(r, count, |r| r.below(4) as i32 - 1);
            let values = Array::of(r, count, |r| r.pick(&NUMBERS));
            p.unsound = !(references.sound && orders.sound && values.sound)
                || M::Simulation::INPUT_DERIVATIVES.is_none();
            let claim = p.claim(r, count);
            let pointers = (references.pointer, orders.pointer, values.pointer);
            call!(p.set_input_derivatives(pointers.0, claim, pointers.1, pointers.2))
        }),
        ("fmi2GetRealOutputDerivatives", |p, r| {
            let orders = Array::of(r, 4, |r| r.below(4) as i32 - 1);
            let function = p.slave.api.get_output_derivatives;
            let order = orders.pointer;
            let (status, _) = p.read(r, real, BLANK, |c, v, n, x| {
                // SAFETY: see `call!`; four orders are enough.
                unsafe { function(c, v, n, order, x) }
            });
            p.unsound |= M::Simulation::TANGENT.is_none();
            status
        }),
        ("fmi2DoStep", |p, r| {
            let sound = p.phase == Phase::StepComplete && r.below(4) > 0;
            let (point, step) = match sound {
                true => (p.slave.time(), 0.05),
                false => (r.pick(&NUMBERS), r.pick(&NUMBERS[..13])),
            };
            call!(p.do_step(point, step, r.below(2) as Boolean))
        }),
        ("fmi2CancelStep", |p, _| call!(p.cancel_step())),
        ("fmi2GetStatus", |p, r| {
            let place = p.place(r, Status::Ok);
            call!(p.get_status(StatusKind(r.below(6) as u32), place.pointer))
        }),
        ("fmi2GetRealStatus", |p, r| {
            let place = p.place(r, BLANK);
            let status = call!(p.get_real_status(StatusKind(r.below(6) as u32), place.pointer));
            assert_eq!(place.items[0] == BLANK, status != Status::Ok);
            status
        }),
        ("fmi2GetIntegerStatus", |p, r| {
            let place = p.place(r, BLANK_INTEGER);
            call!(p.get_integer_status(StatusKind(r.below(6) as u32), place.pointer))
        }),
        ("fmi2GetBooleanStatus", |p, r| {
            let place = p.place(r, BLANK_INTEGER);
            let status = call!(p.get_boolean_status(StatusKind(r.below(6) as u32), place.pointer));
            assert_eq!(place.items[0] == BLANK_INTEGER, status != Status::Ok);
            status
        }),
        ("fmi2GetStringStatus", |p, r| {
            let place = p.place(r, null());
            call!(p.get_string_status(StatusKind(r.below(6) as u32), place.pointer))
        }),
    ]
}
