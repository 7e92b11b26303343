//! Random sequences of legal and illegal calls with sound and unsound arguments.
//!
//! `AHV_FUZZ=<number of sequences>` tries another number than `cargo test` does.

#![allow(unsafe_code)]

mod common;

use ahv::dynamics::{NOMINAL, STATES};
use ahv::fmi::lifecycle::{CALLS, Call, Phase};
use ahv::fmi::sys::{
    Boolean, Component, EventInfo, FmiString, FmuState, Status, StatusKind, ValueReference,
};
use ahv::variables::{Kind, TABLE, Variable};
use common::{Api, Random, Slave};
use std::collections::BTreeSet;
use std::ffi::CStr;
use std::fmt::Debug;
use std::io::{Write, stderr};
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

const SEQUENCES: u64 = 2_000;
const CALLS_PER_SEQUENCE: u64 = 40;
/// One argument in so many is unsound, of each kind of fault.
const RARELY: u64 = 24;
/// No sequence takes so long: the longest are steps of 1e300 s, until the vehicle leaves the envelope.
const HANGING: Duration = Duration::from_secs(600);

#[rustfmt::skip]
const NUMBERS: [f64; 16] = [
    0.0, -0.0, 1.0, -1.0, 0.01, -0.01, 0.2, 0.5, 7.5, 8.0, 26000.0, 1e300, f64::MIN_POSITIVE,
    f64::NAN, f64::INFINITY, f64::NEG_INFINITY,
];
const LOG_EVENTS: &CStr = c"logEvents";
/// What stands where a function has not written: no value of any variable.
const BLANK: f64 = -1.234e-77;
const BLANK_INTEGER: i32 = -77_777;

/// An array as a careless master passes it: sound, NULL or misaligned, with a guard at its end.
struct Array<T> {
    items: Vec<T>,
    pointer: *mut T,
    sound: bool,
}

impl<T: Copy> Array<T> {
    fn new(random: &mut Random, mut items: Vec<T>, guard: T) -> Self {
        let empty = items.is_empty();
        // No slack behind the guard: a memory checker sees what goes beyond.
        items.reserve_exact(1);
        items.push(guard);
        let start = items.as_mut_ptr();
        let pointer = match random.below(RARELY) {
            0 => null_mut(),
            1 if align_of::<T>() > 1 => start.cast::<u8>().wrapping_add(1).cast(),
            _ => start,
        };
        Self { sound: empty || pointer == start, items, pointer }
    }

    /// So many random elements.
    fn of(random: &mut Random, count: usize, element: fn(&mut Random) -> T) -> Self {
        let items = (0..count).map(|_| element(random)).collect();
        let guard = element(random);
        Self::new(random, items, guard)
    }
}

/// A saved state: what it has to restore.
#[derive(Clone)]
struct Saved {
    state: FmuState,
    phase: Phase,
    has_experiment: bool,
    bytes: Vec<u8>,
}

/// An instance, the state in which it has to be, and FMU states with theirs.
struct Player<'a> {
    slave: Slave<'a>,
    /// For model exchange, not for co-simulation.
    exchange: bool,
    /// The instance, or NULL, for the next call.
    c: Component,
    phase: Phase,
    has_experiment: bool,
    saved: Vec<Saved>,
    /// Whether the last call had an argument that has to be refused.
    unsound: bool,
}

fn real(variable: &Variable) -> bool {
    matches!(variable.kind, Kind::Real(_))
}

fn integer(variable: &Variable) -> bool {
    matches!(variable.kind, Kind::Enumeration(..))
}

fn boolean(variable: &Variable) -> bool {
    matches!(variable.kind, Kind::Boolean)
}

type Kinds = fn(&Variable) -> bool;

impl<'a> Player<'a> {
    fn new(api: &'a Api, exchange: bool) -> Self {
        let slave = if exchange { Slave::exchange(api) } else { Slave::new(api) };
        let c = slave.c;
        let (phase, has_experiment) = (Phase::Instantiated, false);
        Self { slave, exchange, c, phase, has_experiment, saved: Vec::new(), unsound: false }
    }

    /// Value references: half of the arrays have fitting ones only, the others whatever comes.
    fn references(random: &mut Random, kinds: Kinds, settable: bool) -> Vec<ValueReference> {
        let fit = |i: &u32| {
            let variable = &TABLE[*i as usize];
            kinds(variable) && (!settable || variable.settable())
        };
        let fitting: Vec<_> = (0..TABLE.len() as u32).filter(fit).collect();
        let any = random.below(2) == 0;
        let one = |random: &mut Random| match any {
            true => random.below(TABLE.len() as u64 + 2) as u32,
            false => random.pick(&fitting),
        };
        (0..random.below(4)).map(|_| one(random)).collect()
    }

    /// The number of elements that the master states: now and then -1, cast to `size_t`.
    fn claim(&mut self, random: &mut Random, count: usize) -> usize {
        let absurd = random.below(RARELY) == 0;
        self.unsound |= absurd;
        if absurd { usize::MAX } else { count }
    }

    /// A getter: all values are written or none, and nothing behind them.
    fn read<T: Copy + PartialEq + Debug>(
        &mut self,
        random: &mut Random,
        kinds: Kinds,
        blank: T,
        call: impl FnOnce(Component, *const ValueReference, usize, *mut T) -> Status,
    ) -> (Status, Vec<T>) {
        let references = Self::references(random, kinds, false);
        let count = references.len();
        let references = Array::new(random, references, 0);
        let values = Array::new(random, vec![blank; count], blank);
        self.unsound = !(references.sound && values.sound);
        let claim = self.claim(random, count);
        let status = call(self.c, references.pointer, claim, values.pointer);
        let written = values.items.iter().filter(|&&value| value != blank).count();
        assert_eq!(written, if status == Status::Ok { count } else { 0 }, "{:?}", values.items);
        assert_eq!(values.items[count], blank);
        (status, values.items[..written].to_vec())
    }

    /// A setter: what it accepts is what the getter gives.
    fn write<T: Copy + PartialEq + Debug>(
        &mut self,
        random: &mut Random,
        kinds: Kinds,
        element: fn(&mut Random) -> T,
        set: impl FnOnce(Component, *const ValueReference, usize, *const T) -> Status,
        get: impl Fn(Component, *const ValueReference, usize, *mut T) -> Status,
    ) -> Status {
        let references = Self::references(random, kinds, true);
        let count = references.len();
        let references = Array::new(random, references, 0);
        let values = Array::of(random, count, element);
        let given = values.items.clone();
        self.unsound = !(references.sound && values.sound);
        let claim = self.claim(random, count);
        let status = set(self.c, references.pointer, claim, values.pointer);
        if status == Status::Ok && self.phase != Phase::Instantiated {
            for (i, reference) in references.items[..count].iter().enumerate() {
                let last = (0..count).rfind(|&k| references.items[k] == *reference).unwrap_or(i);
                let mut found = given[last];
                assert_eq!(get(self.c, reference, 1, &mut found), Status::Ok);
                assert_eq!(found, given[last], "{}", TABLE[*reference as usize].name);
            }
        }
        status
    }

    /// A getter of one number for each state.
    fn read_states(
        &mut self,
        random: &mut Random,
        call: impl FnOnce(Component, *mut f64, usize) -> Status,
    ) -> Status {
        let count = STATES - usize::from(random.below(8) == 0);
        let values = Array::new(random, vec![BLANK; count], BLANK);
        self.unsound = !values.sound || count != STATES;
        let status = call(self.c, values.pointer, count);
        let written = values.items.iter().filter(|&&value| value != BLANK).count();
        assert_eq!(written, if status == Status::Ok { count } else { 0 }, "{:?}", values.items);
        assert!(values.items.iter().all(|value| value.is_finite()), "{:?}", values.items);
        status
    }

    /// A place for one value, or NULL.
    fn place<T: Copy>(&mut self, random: &mut Random, value: T) -> Array<T> {
        let place = Array::new(random, vec![value], value);
        self.unsound |= !place.sound;
        place
    }

    /// One of the saved states, or NULL.
    fn any_saved(&mut self, random: &mut Random) -> Option<Saved> {
        let null = self.saved.is_empty() || random.below(RARELY) == 0;
        self.unsound |= null;
        (!null).then(|| self.saved[random.below(self.saved.len() as u64) as usize].clone())
    }

    fn bytes(&self) -> Vec<u8> {
        let state = self.slave.save();
        let bytes = self.slave.bytes(state);
        self.slave.free(state);
        bytes
    }

    /// The state after a call that the standard allows.
    fn advance(&mut self, name: &str, status: Status) {
        self.phase = match (name, status) {
            ("fmi2EnterInitializationMode", Status::Ok) => Phase::InitializationMode,
            ("fmi2ExitInitializationMode", Status::Ok) if self.exchange => Phase::EventMode,
            ("fmi2ExitInitializationMode", Status::Ok) => Phase::StepComplete,
            ("fmi2EnterEventMode", Status::Ok) => Phase::EventMode,
            ("fmi2EnterContinuousTimeMode", Status::Ok) => Phase::ContinuousTimeMode,
            ("fmi2ExitInitializationMode", _) => Phase::Error,
            ("fmi2DoStep", Status::Discard) => Phase::StepFailed,
            ("fmi2Terminate", Status::Ok) => Phase::Terminated,
            ("fmi2Reset", Status::Ok) => Phase::Instantiated,
            _ => self.phase,
        };
        match (name, status) {
            ("fmi2Reset", _) => self.has_experiment = false,
            ("fmi2SetupExperiment", Status::Ok) => self.has_experiment = true,
            _ => {}
        }
    }
}

/// Makes one call. What is known of its result is checked there.
type Play = fn(&mut Player<'_>, &mut Random) -> Status;

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
const PLAYS: [(&str, Play); 40] = [
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
    ("fmi2GetString", |p, r| p.read(r, boolean, c"".as_ptr(), function!(p.get_string, c v n x)).0),
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
        let known = Player::references(r, real, false);
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
        p.unsound |= !sound;
        status
    }),
    ("fmi2EnterEventMode", |p, _| call!(p.enter_event_mode())),
    ("fmi2NewDiscreteStates", |p, r| {
        let place = p.place(r, EventInfo { new_discrete_states_needed: 7, ..Default::default() });
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
        let mut states = NOMINAL.to_vec();
        states[r.below(STATES as u64) as usize] = r.pick(&NUMBERS);
        states.truncate(STATES - usize::from(r.below(8) == 0));
        let count = states.len();
        let states = Array::new(r, states, 0.0);
        p.unsound = !states.sound || count != STATES;
        call!(p.set_continuous_states(states.pointer, count))
    }),
    ("fmi2GetDerivatives", |p, r| p.read_states(r, function!(p.get_derivatives, c x n))),
    ("fmi2GetContinuousStates", |p, r| p.read_states(r, function!(p.get_continuous_states, c x n))),
    ("fmi2GetNominalsOfContinuousStates", |p, r| {
        p.read_states(r, function!(p.get_nominals_of_continuous_states, c x n))
    }),
    ("fmi2GetEventIndicators", |p, r| {
        let count = r.below(2) as usize;
        p.unsound = count > 0;
        call!(p.get_event_indicators(null_mut(), count))
    }),
    ("fmi2SetRealInputDerivatives", |p, r| {
        let references = Player::references(r, real, true);
        let count = references.len();
        let references = Array::new(r, references, 0);
        let orders = Array::of(r, count, |r| r.below(4) as i32 - 1);
        let values = Array::of(r, count, |r| r.pick(&NUMBERS));
        p.unsound = !(references.sound && orders.sound && values.sound);
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
];

/// The function that moves the lifecycle on, so that sequences get beyond their first states.
fn onward(player: &Player) -> &'static str {
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

/// Functions that leave the instance as it is, whatever they return. In initialization mode a
/// getter may compute the initial state.
fn only_looks(name: &str, phase: Phase) -> bool {
    (name.starts_with("fmi2Get") && phase != Phase::InitializationMode)
        || name.starts_with("fmi2Serialize")
        || ["fmi2DeSerializeFMUstate", "fmi2FreeFMUstate", "fmi2SetDebugLogging"].contains(&name)
}

/// What came out of all calls.
#[derive(Debug, Default)]
struct Tally {
    done: u64,
    discarded: u64,
    refused: u64,
    phases: BTreeSet<u8>,
}

fn call_named(name: &str) -> &'static Call {
    CALLS.iter().find(|call| call.name == name).expect(name)
}

fn play_sequence(api: &Api, seed: u64, tally: &mut Tally) {
    let mut random = Random(seed);
    let mut player = Player::new(api, seed % 2 == 1);
    let mut before = player.bytes();
    for _ in 0..CALLS_PER_SEQUENCE {
        let name = match random.below(4) {
            0 => onward(&player),
            _ => random.pick(&PLAYS).0,
        };
        let (_, play) = PLAYS.iter().find(|(known, _)| *known == name).unwrap();
        let phase = player.phase;
        let no_instance = random.below(RARELY) == 0;
        player.c = if no_instance { null_mut() } else { player.slave.c };
        player.unsound = false;
        let mut allowed = call_named(name).allowed_in(phase) && !no_instance;
        if name == "fmi2EnterInitializationMode" {
            allowed &= player.has_experiment;
        }
        player.slave.log();
        let status = play(&mut player, &mut random);
        let log = player.slave.log();
        let legal = allowed && !player.unsound;
        let scene = || format!("seed {seed}: {name} in {phase}: {status:?} {log:?}");
        match status {
            Status::Ok => tally.done += 1,
            Status::Discard => tally.discarded += 1,
            Status::Error => tally.refused += 1,
            _ => panic!("{}", scene()),
        }
        assert!(legal || status != Status::Ok, "{}", scene());
        assert!(allowed || status == Status::Error, "{}", scene());
        let complaint = log.iter().any(|record| record.status == Status::Error);
        assert_eq!(complaint, status == Status::Error && !no_instance, "{}", scene());
        if allowed {
            player.advance(name, status);
        }
        tally.phases.insert(player.phase as u8);
        let after = player.bytes();
        let fails = name == "fmi2ExitInitializationMode" && allowed;
        if only_looks(name, phase) || status == Status::Error && !fails {
            assert!(before == after, "{} changed something", scene());
        }
        before = after;
    }
    for saved in std::mem::take(&mut player.saved) {
        player.slave.free(saved.state);
    }
}

/// Ends the process if a sequence does not end: a call that hangs would take the test with it.
fn watch<T>(running: &[ScopedJoinHandle<T>], playing: &[AtomicU64]) {
    let mut known: Vec<_> = playing.iter().map(|_| (0, Instant::now())).collect();
    while running.iter().any(|thread| !thread.is_finished()) {
        thread::sleep(Duration::from_millis(50));
        for ((thread, playing), (seed, since)) in running.iter().zip(playing).zip(&mut known) {
            let now = playing.load(Relaxed);
            if now != *seed || thread.is_finished() {
                (*seed, *since) = (now, Instant::now());
            } else if since.elapsed() > HANGING {
                // The test's own output is lost at an exit.
                let _ = writeln!(stderr(), "seed {seed} has not ended for {HANGING:?}");
                std::process::exit(1);
            }
        }
    }
}

#[test]
fn every_function_is_played() {
    let played: BTreeSet<_> = PLAYS.iter().map(|(name, _)| *name).collect();
    let known: BTreeSet<_> = CALLS.iter().map(|call| call.name).collect();
    assert_eq!(played, known);
}

#[test]
fn random_calls_never_crash_and_follow_the_table_of_legal_calls() {
    let api = Api::load();
    let wanted = std::env::var("AHV_FUZZ").ok().map(|text| text.parse().expect("AHV_FUZZ"));
    let sequences = wanted.unwrap_or(SEQUENCES);
    let threads = thread::available_parallelism().map_or(1, usize::from) as u64;
    let playing: Vec<_> = (0..threads).map(AtomicU64::new).collect();
    let tallies: Vec<Tally> = thread::scope(|scope| {
        let running: Vec<_> = playing
            .iter()
            .zip(0..)
            .map(|(playing, first)| {
                let api = &api;
                scope.spawn(move || {
                    let mut tally = Tally::default();
                    for seed in (first..sequences).step_by(threads as usize) {
                        playing.store(seed, Relaxed);
                        play_sequence(api, seed, &mut tally);
                    }
                    tally
                })
            })
            .collect();
        watch(&running, &playing);
        running.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    let sum = |part: fn(&Tally) -> u64| tallies.iter().map(part).sum::<u64>();
    let (done, discarded, refused) = (sum(|t| t.done), sum(|t| t.discarded), sum(|t| t.refused));
    println!("{sequences} sequences: {done} calls done, {discarded} discarded, {refused} refused");
    assert_eq!(done + discarded + refused, sequences * CALLS_PER_SEQUENCE);
    let phases: BTreeSet<u8> = tallies.into_iter().flat_map(|tally| tally.phases).collect();
    let enough = sequences >= 1000;
    assert!(phases.len() == 8 || !enough, "all states that can be reached were: {phases:?}");
}
