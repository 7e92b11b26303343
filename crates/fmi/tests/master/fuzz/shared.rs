//! What both versions have in common: numbers, and the calls of functions with the same C types.

use std::ffi::CStr;

#[rustfmt::skip]
pub const NUMBERS: [f64; 16] = [
    0.0, -0.0, 1.0, -1.0, 0.01, -0.01, 0.2, 0.5, 7.5, 8.0, 26000.0, 1e300, f64::MIN_POSITIVE,
    f64::NAN, f64::INFINITY, f64::NEG_INFINITY,
];
pub const LOG_EVENTS: &CStr = c"logEvents";

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
pub(super) use {call, function};

/// Rows for the functions that both versions have, by their names.
macro_rules! same_plays {
    (
        $logging:literal $exit:literal $terminate:literal $reset:literal
        $get_state:literal $set_state:literal $free_state:literal
        $state_size:literal $serialize:literal $deserialize:literal
        $event_mode:literal $continuous_time_mode:literal $time:literal
        $set_states:literal $rates:literal $states:literal $nominals:literal $indicators:literal
    ) => {
        vec![
            ($logging, |p, r| {
                let offered = [LOG_EVENTS.as_ptr(), LOG_EVENTS.as_ptr(), c"%n".as_ptr(), null()];
                let picks: Vec<_> = (0..r.below(3)).map(|_| r.below(4) as usize).collect();
                let names: Vec<*const c_char> = picks.iter().map(|&pick| offered[pick]).collect();
                let count = names.len();
                let all_known = picks.iter().all(|&pick| pick < 2);
                let names = Array::new(r, names, null());
                p.unsound = !(names.sound && all_known);
                let claim = p.claim(r, count);
                call!(p.set_debug_logging((r.below(2) == 1).into(), claim, names.pointer))
            }),
            ($exit, |p, _| call!(p.exit_initialization_mode())),
            ($terminate, |p, _| call!(p.terminate())),
            ($reset, |p, _| call!(p.reset())),
            ($get_state, |p, r| {
                p.unsound = <M as Model>::Simulation::SAVING.is_none();
                let place = p.place::<*mut c_void>(r, null_mut());
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
            ($set_state, |p, r| {
                let saved = p.any_saved(r);
                let status = call!(p.set_state(saved.as_ref().map_or(null_mut(), |saved| saved.state)));
                if let (Status::Ok, Some(saved)) = (status, saved) {
                    (p.phase, p.has_experiment) = (saved.phase, saved.has_experiment);
                    assert!(p.slave.present() == saved.bytes);
                }
                status
            }),
            ($free_state, |p, r| {
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
            ($state_size, |p, r| {
                let saved = p.any_saved(r);
                let state = saved.map_or(null_mut(), |saved| saved.state);
                let place = p.place(r, 0);
                call!(p.state_size(state, place.pointer))
            }),
            ($serialize, |p, r| {
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
            ($deserialize, |p, r| {
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
                let place = p.place::<*mut c_void>(r, null_mut());
                let status = call!(p.deserialize(bytes.pointer, size, place.pointer));
                assert_eq!(place.items[0].is_null(), status != Status::Ok);
                if !place.items[0].is_null() {
                    p.slave.free(place.items[0]);
                }
                status
            }),
            ($event_mode, |p, _| call!(p.enter_event_mode())),
            ($continuous_time_mode, |p, _| call!(p.enter_continuous_time_mode())),
            ($time, |p, r| call!(p.set_time(r.pick(&NUMBERS)))),
            ($set_states, |p, r| {
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
            ($rates, |p, r| p.read_states(r, function!(p.get_derivatives, c x n))),
            ($states, |p, r| {
                p.read_states(r, function!(p.get_continuous_states, c x n))
            }),
            ($nominals, |p, r| {
                p.read_states(r, function!(p.get_nominals_of_continuous_states, c x n))
            }),
            ($indicators, |p, r| {
                let count = r.below(2) as usize;
                p.unsound = count > 0;
                call!(p.get_event_indicators(null_mut(), count))
            }),
        ]
    };
}
pub(super) use same_plays;
