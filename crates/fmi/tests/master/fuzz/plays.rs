//! The calls: one row for each function, with what is known of its result.

use super::super::Random;
use super::player::{Array, BLANK, BLANK_INTEGER, Player, Saved, boolean, integer, real};
use fmi_model::phase::Phase;
use fmi_model::v2::sys::{Boolean, EventInfo, FmiString, FmuState, Status, StatusKind};
use fmi_model::{Model, Simulation, table};
use std::ffi::CStr;
use std::ptr::{null, null_mut};

#[rustfmt::skip]
const NUMBERS: [f64; 16] = [
    0.0, -0.0, 1.0, -1.0, 0.01, -0.01, 0.2, 0.5, 7.5, 8.0, 26000.0, 1e300, f64::MIN_POSITIVE,
    f64::NAN, f64::INFINITY, f64::NEG_INFINITY,
];
const LOG_EVENTS: &CStr = c"logEvents";

/// Makes one call. What is known of its result is checked there.
pub type Play<M> = fn(&mut Player<'_, M>, &mut Random) -> Status;

/// A row that calls a function of the library with `c` and the arguments given.
macro_rules! call {
    ($player:ident . $function:ident ( $($argument:expr),* )) => {{
        let function = $player.slave.api.$function;
        // SAFETY: NULL or a live instance; arrays of the lengths given; NULL or live states.
        unsafe { function($player.c, $($argument),*) }
    }};
}

/// A function of the library, to be called with all arguments.
macro_rules! function {
    ($player:ident . $function:ident, $($argument:ident)*) => {{
        let function = $player.slave.api.$function;
        // SAFETY: see `call!`.
        move |$($argument),*| unsafe { function($($argument),*) }
    }};
}

/// Every function that works on an instance: one row each.
pub fn plays<M: Model>() -> [(&'static str, Play<M>); 40] {
    [
        ("fmi2SetDebugLogging", |p, r| {
            let offered = [LOG_EVENTS.as_ptr(), LOG_EVENTS.as_ptr(), c"%n".as_ptr(), null()];
            let picks: Vec<_> = (0..r.below(3)).map(|_| r.below(4) as usize).collect();
            let names: Vec<FmiString> = picks.iter().map(|&pick| offered[pick]).collect();
            let count = names.len();
            let all_known = picks.iter().all(|&pick| pick < 2);
            let names = Array::new(r, names, null());
            p.unsound = !(names.sound && all_known);
            let claim = p.claim(r, count);
            call!(p.set_debug_logging(r.below(2) as Boolean, claim, names.pointer))
        }),
        ("fmi2SetupExperiment", |p, r| {
            let [tolerance, start, stop] = [(); 3].map(|()| r.pick(&NUMBERS));
            let plain = r.below(2) == 0;
            let start = if plain { 0.0 } else { start };
            let given = Boolean::from(!plain);
            call!(p.setup_experiment(given, tolerance, start, given, stop))
        }),
        ("fmi2EnterInitializationMode", |p, _| call!(p.enter_initialization_mode())),
        ("fmi2ExitInitializationMode", |p, _| call!(p.exit_initialization_mode())),
        ("fmi2Terminate", |p, _| call!(p.terminate())),
        ("fmi2Reset", |p, _| call!(p.reset())),
        ("fmi2GetReal", |p, r| {
            let (status, values) = p.read(r, real, BLANK, function!(p.get_real, c v n x));
            assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
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
            p.write(r, real, |r| r.pick(&NUMBERS), set, get)
        }),
        ("fmi2SetInteger", |p, r| {
            let (set, get) = (function!(p.set_integer, c v n x), function!(p.get_integer, c v n x));
            p.write(r, integer, |r| r.below(5) as i32 - 1, set, get)
        }),
        ("fmi2SetBoolean", |p, r| {
            let (set, get) = (function!(p.set_boolean, c v n x), function!(p.get_boolean, c v n x));
            p.write(r, boolean, |r| r.below(4) as i32 - 1, set, get)
        }),
        ("fmi2SetString", |p, r| {
            let (set, get) = (function!(p.set_string, c v n x), function!(p.get_string, c v n x));
            p.write(r, boolean, |_| c"".as_ptr(), set, get)
        }),
        ("fmi2GetFMUstate", |p, r| {
            p.unsound = M::Simulation::SAVING.is_none();
            let place = p.place::<FmuState>(r, null_mut());
            let status = call!(p.get_state(place.pointer));
            let state = place.items[0];
            assert_eq!(state.is_null(), status != Status::Ok);
            if !state.is_null() {
                let (phase, has_experiment) = (p.phase, p.has_experiment);
                let bytes = p.slave.bytes(state);
                p.saved.push(Saved { state, phase, has_experiment, bytes });
            }
            status
        }),
        ("fmi2SetFMUstate", |p, r| {
            let saved = p.any_saved(r);
            let status = call!(p.set_state(saved.as_ref().map_or(null_mut(), |saved| saved.state)));
            if let (Status::Ok, Some(saved)) = (status, saved) {
                (p.phase, p.has_experiment) = (saved.phase, saved.has_experiment);
                assert!(p.bytes() == saved.bytes);
            }
            status
        }),
        ("fmi2FreeFMUstate", |p, r| {
            let state = p.saved.last().map_or(null_mut(), |saved| saved.state);
            let place = Array::new(r, vec![state], null_mut());
            p.unsound = !place.sound && !place.pointer.is_null();
            let status = call!(p.free_state(place.pointer));
            assert!(place.items[0] == state || place.items[0].is_null());
            if place.items[0].is_null() {
                p.saved.pop();
            }
            status
        }),
        ("fmi2SerializedFMUstateSize", |p, r| {
            let saved = p.any_saved(r);
            let state = saved.map_or(null_mut(), |saved| saved.state);
            let place = p.place(r, 0);
            call!(p.state_size(state, place.pointer))
        }),
        ("fmi2SerializeFMUstate", |p, r| {
            let saved = p.any_saved(r);
            let (state, expected) =
                saved.map_or((null_mut(), vec![]), |saved| (saved.state, saved.bytes));
            let size = if r.below(4) == 0 { r.below(2000) as usize } else { expected.len() };
            let room = Array::new(r, vec![0; size], 7);
            p.unsound |= !room.sound || size != expected.len();
            let status = call!(p.serialize(state, room.pointer, size));
            let written: Vec<u8> = room.items.iter().map(|&byte| byte as u8).collect();
            match status {
                Status::Ok => assert!(written[..size] == expected),
                _ => assert!(written[..size].iter().all(|&byte| byte == 0)),
            }
            assert_eq!(written[size], 7);
            status
        }),
        ("fmi2DeSerializeFMUstate", |p, r| {
            let mut bytes = p.any_saved(r).map_or_else(Vec::new, |saved| saved.bytes);
            match r.below(4) {
                0 => bytes.truncate(r.below(bytes.len() as u64 + 1) as usize),
                1 if !bytes.is_empty() => {
                    let place = r.below(bytes.len() as u64) as usize;
                    bytes[place] ^= 1 << r.below(8);
                }
                _ => {}
            }
            p.unsound = p.saved.iter().all(|saved| saved.bytes != bytes);
            let size = bytes.len();
            let bytes = Array::new(r, bytes.into_iter().map(|byte| byte as _).collect(), 0);
            p.unsound |= !bytes.sound;
            let place = p.place::<FmuState>(r, null_mut());
            let status = call!(p.deserialize(bytes.pointer, size, place.pointer));
            assert_eq!(place.items[0].is_null(), status != Status::Ok);
            p.slave.free(place.items[0]);
            status
        }),
        ("fmi2GetDirectionalDerivative", |p, r| {
            let known = Player::<M>::references(r, real, false);
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
        ("fmi2EnterEventMode", |p, _| call!(p.enter_event_mode())),
        ("fmi2NewDiscreteStates", |p, r| {
            let place =
                p.place(r, EventInfo { new_discrete_states_needed: 7, ..Default::default() });
            let status = call!(p.new_discrete_states(place.pointer));
            assert_eq!(place.items[0].new_discrete_states_needed == 7, status != Status::Ok);
            status
        }),
        ("fmi2EnterContinuousTimeMode", |p, _| call!(p.enter_continuous_time_mode())),
        ("fmi2CompletedIntegratorStep", |p, r| {
            let places = [(); 2].map(|()| p.place(r, BLANK_INTEGER));
            let [event, end] = [&places[0], &places[1]].map(|place| place.pointer);
            let status = call!(p.completed_integrator_step(r.below(2) as Boolean, event, end));
            for place in places {
                assert_eq!(place.items[0] == BLANK_INTEGER, status != Status::Ok);
            }
            status
        }),
        ("fmi2SetTime", |p, r| call!(p.set_time(r.pick(&NUMBERS)))),
        ("fmi2SetContinuousStates", |p, r| {
            let all = table::states::<M>();
            let nominal = |i| table::state::<M>(i).nominal.unwrap_or(1.0);
            let mut states: Vec<_> = (0..all).map(nominal).collect();
            if all > 0 {
                states[r.below(all as u64) as usize] = r.pick(&NUMBERS);
            }
            states.truncate(all.saturating_sub(usize::from(r.below(8) == 0)));
            let count = states.len();
            let states = Array::new(r, states, 0.0);
            p.unsound = !states.sound || count != all;
            call!(p.set_continuous_states(states.pointer, count))
        }),
        ("fmi2GetDerivatives", |p, r| p.read_states(r, function!(p.get_derivatives, c x n))),
        ("fmi2GetContinuousStates", |p, r| {
            p.read_states(r, function!(p.get_continuous_states, c x n))
        }),
        ("fmi2GetNominalsOfContinuousStates", |p, r| {
            p.read_states(r, function!(p.get_nominals_of_continuous_states, c x n))
        }),
        ("fmi2GetEventIndicators", |p, r| {
            let count = r.below(2) as usize;
            p.unsound = count > 0;
            call!(p.get_event_indicators(null_mut(), count))
        }),
        ("fmi2SetRealInputDerivatives", |p, r| {
            let references = Player::<M>::references(r, real, true);
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
                true => (p.slave.last_successful_time(), 0.05),
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
