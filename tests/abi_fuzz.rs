//! Random sequences of legal and illegal calls with sound and unsound arguments.
//!
//! `AHV_FUZZ=<number of sequences>` tries more than the normal run does.

#![allow(unsafe_code)]

mod common;

use ahv::dynamics::NOMINAL;
use ahv::fmi::lifecycle::{CALLS, Phase};
use ahv::fmi::sys::{EventInfo, FmuState, Status, StatusKind};
use ahv::variables::TABLE;
use common::{Api, Random, Slave};
use std::ptr::null_mut;

const SEQUENCES: u64 = 2000;
const CALLS_PER_SEQUENCE: u64 = 60;

#[rustfmt::skip]
const NUMBERS: [f64; 16] = [
    0.0, -0.0, 1.0, -1.0, 0.01, -0.01, 0.2, 0.5, 7.5, 8.0, 26000.0, 1e300, f64::MIN_POSITIVE,
    f64::NAN, f64::INFINITY, f64::NEG_INFINITY,
];

/// An instance, the state in which it has to be, and FMU states with theirs.
struct Player<'a> {
    slave: Slave<'a>,
    exchange: bool,
    phase: Phase,
    has_experiment: bool,
    saved: Vec<(FmuState, Phase, bool)>,
}

impl Player<'_> {
    /// Makes one call. What is known of its result is checked here.
    fn play(&mut self, name: &str, random: &mut Random) -> Status {
        let (api, c) = (self.slave.api, self.slave.c);
        let count = random.below(4) as usize;
        let references: Vec<u32> =
            (0..count).map(|_| random.below(TABLE.len() as u64 + 2) as u32).collect();
        let mut numbers: Vec<f64> = (0..count).map(|_| random.pick(&NUMBERS)).collect();
        let mut integers: Vec<i32> = (0..count).map(|_| random.below(5) as i32 - 1).collect();
        let (vr, real, integer) =
            (references.as_ptr(), numbers.as_mut_ptr(), integers.as_mut_ptr());
        let kind = StatusKind(random.below(6) as u32);
        let saved = (!self.saved.is_empty()).then(|| random.pick(&self.saved));
        let state = saved.map_or(null_mut(), |(state, ..)| state);
        // SAFETY: a live instance, arrays of the lengths given, NULL or live states.
        unsafe {
            match name {
                "fmi2SetDebugLogging" => {
                    let category = random.pick(&[c"logEvents".as_ptr(), c"%n".as_ptr()]);
                    let on = random.below(2) as i32;
                    (api.set_debug_logging)(c, on, random.below(2) as usize, &category)
                }
                "fmi2SetupExperiment" => {
                    let [tolerance, start, stop] = [(); 3].map(|_| random.pick(&NUMBERS));
                    let plain = random.below(2) == 0;
                    let status = if plain {
                        self.slave.setup()
                    } else {
                        self.slave.setup_with(Some(tolerance), start, Some(stop))
                    };
                    self.has_experiment |= status == Status::Ok;
                    status
                }
                "fmi2EnterInitializationMode" => self.slave.enter(),
                "fmi2ExitInitializationMode" => self.slave.exit(),
                "fmi2Terminate" => self.slave.terminate(),
                "fmi2Reset" => self.slave.reset(),
                "fmi2GetReal" => {
                    let status = (api.get_real)(c, vr, count, real);
                    if status == Status::Ok {
                        assert!(numbers.iter().all(|value| value.is_finite()), "{references:?}");
                    }
                    status
                }
                "fmi2GetInteger" => (api.get_integer)(c, vr, count, integer),
                "fmi2GetBoolean" => (api.get_boolean)(c, vr, count, integer),
                "fmi2GetString" => (api.get_string)(c, vr, 0, null_mut()),
                "fmi2SetReal" => (api.set_real)(c, vr, count, real),
                "fmi2SetInteger" => (api.set_integer)(c, vr, count, integer),
                "fmi2SetBoolean" => (api.set_boolean)(c, vr, count, integer),
                "fmi2SetString" => (api.set_string)(c, vr, 0, null_mut()),
                "fmi2GetFMUstate" => {
                    let mut state = null_mut();
                    let status = (api.get_state)(c, &mut state);
                    if status == Status::Ok {
                        self.saved.push((state, self.phase, self.has_experiment));
                    }
                    status
                }
                "fmi2SetFMUstate" => {
                    let status = (api.set_state)(c, state);
                    if let (Status::Ok, Some((_, phase, has_experiment))) = (status, saved) {
                        (self.phase, self.has_experiment) = (phase, has_experiment);
                    }
                    status
                }
                "fmi2FreeFMUstate" => {
                    let (mut state, ..) =
                        self.saved.pop().unwrap_or((null_mut(), self.phase, false));
                    let status = (api.free_state)(c, &mut state);
                    assert!(state.is_null());
                    status
                }
                "fmi2SerializedFMUstateSize" => (api.state_size)(c, state, &mut 0),
                "fmi2SerializeFMUstate" | "fmi2DeSerializeFMUstate" => {
                    if state.is_null() {
                        return (api.state_size)(c, state, &mut 0);
                    }
                    let mut bytes = self.slave.bytes(state);
                    let damaged = random.below(2) == 0;
                    if damaged {
                        let place = random.below(bytes.len() as u64) as usize;
                        bytes[place] ^= 1 << random.below(8);
                    }
                    let (status, again) = self.slave.state_of(&bytes);
                    assert_eq!(status, if damaged { Status::Error } else { Status::Ok });
                    assert_eq!((api.free_state)(c, &mut { again }), Status::Ok);
                    status
                }
                "fmi2GetDirectionalDerivative" => {
                    let mut change = [0.0; 3];
                    (api.directional_derivative)(c, vr, count, vr, count, real, change.as_mut_ptr())
                }
                "fmi2EnterEventMode" => (api.enter_event_mode)(c),
                "fmi2NewDiscreteStates" => {
                    let mut event = EventInfo::default();
                    (api.new_discrete_states)(c, if count == 0 { null_mut() } else { &mut event })
                }
                "fmi2EnterContinuousTimeMode" => (api.enter_continuous_time_mode)(c),
                "fmi2CompletedIntegratorStep" => {
                    (api.completed_integrator_step)(c, 1, &mut 0, &mut 0)
                }
                "fmi2SetTime" => (api.set_time)(c, random.pick(&NUMBERS)),
                "fmi2SetContinuousStates" => {
                    let mut states = NOMINAL;
                    states[random.below(15) as usize] = random.pick(&NUMBERS);
                    (api.set_continuous_states)(c, states.as_ptr(), 14 + random.below(2) as usize)
                }
                "fmi2GetDerivatives" | "fmi2GetContinuousStates" => {
                    let mut values = [0.0; 15];
                    let get = if name == "fmi2GetDerivatives" {
                        api.get_derivatives
                    } else {
                        api.get_continuous_states
                    };
                    let status = get(c, values.as_mut_ptr(), 15);
                    assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
                    status
                }
                "fmi2GetNominalsOfContinuousStates" => {
                    let mut values = [0.0; 15];
                    (api.get_nominals_of_continuous_states)(c, values.as_mut_ptr(), count)
                }
                "fmi2GetEventIndicators" => (api.get_event_indicators)(c, null_mut(), count),
                "fmi2SetRealInputDerivatives" => {
                    (api.set_input_derivatives)(c, vr, count, integer, real)
                }
                "fmi2GetRealOutputDerivatives" => {
                    (api.get_output_derivatives)(c, vr, count, integer, real)
                }
                "fmi2DoStep" => {
                    let sound = self.phase == Phase::StepComplete && random.below(4) > 0;
                    let time = if sound { self.slave.last_successful_time() } else { 0.0 };
                    let point = if sound { time } else { random.pick(&NUMBERS) };
                    let step = if sound { 0.05 } else { random.pick(&NUMBERS[..13]) };
                    (api.do_step)(c, point, step, random.below(2) as i32)
                }
                "fmi2CancelStep" => (api.cancel_step)(c),
                "fmi2GetStatus" => (api.get_status)(c, kind, null_mut()),
                "fmi2GetRealStatus" => (api.get_real_status)(c, kind, &mut 0.0),
                "fmi2GetIntegerStatus" => (api.get_integer_status)(c, kind, null_mut()),
                "fmi2GetBooleanStatus" => (api.get_boolean_status)(c, kind, &mut 0),
                "fmi2GetStringStatus" => (api.get_string_status)(c, kind, null_mut()),
                other => panic!("{other} is not played"),
            }
        }
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
        if name == "fmi2Reset" {
            self.has_experiment = false;
        }
    }
}

/// Functions that move the lifecycle on, so that sequences get beyond their first states.
const ONWARD: [&str; 6] = [
    "fmi2SetupExperiment",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2EnterContinuousTimeMode",
    "fmi2DoStep",
    "fmi2DoStep",
];

#[test]
fn random_calls_never_crash_never_warn_and_follow_the_table_of_legal_calls() {
    let api = Api::load();
    let wanted = std::env::var("AHV_FUZZ").ok().map(|text| text.parse().expect("AHV_FUZZ"));
    let mut met = std::collections::BTreeSet::new();
    for seed in 0..wanted.unwrap_or(SEQUENCES) {
        let mut random = Random(seed);
        let exchange = seed % 2 == 1;
        let mut player = Player {
            slave: if exchange { Slave::exchange(&api) } else { Slave::new(&api) },
            exchange,
            phase: Phase::Instantiated,
            has_experiment: false,
            saved: Vec::new(),
        };
        for _ in 0..CALLS_PER_SEQUENCE {
            let call = if random.below(2) == 0 {
                let name = random.pick(&ONWARD);
                CALLS.iter().find(|call| call.name == name).unwrap()
            } else {
                &CALLS[random.below(CALLS.len() as u64) as usize]
            };
            let before = player.phase;
            let mut allowed = call.allowed_in(before);
            if call.name == "fmi2EnterInitializationMode" {
                allowed &= player.has_experiment;
            }
            player.slave.log();
            let status = player.play(call.name, &mut random);
            let log = player.slave.log();
            let scene = || format!("seed {seed}: {} in {before}: {status:?} {log:?}", call.name);
            assert!(matches!(status, Status::Ok | Status::Discard | Status::Error), "{}", scene());
            assert!(allowed || status == Status::Error, "{}", scene());
            assert_eq!(
                log.iter().any(|r| r.status == Status::Error),
                status == Status::Error,
                "{}",
                scene()
            );
            if allowed {
                player.advance(call.name, status);
            }
            met.insert(player.phase as u8);
        }
        for (state, ..) in std::mem::take(&mut player.saved) {
            player.slave.free(state);
        }
    }
    assert_eq!(met.len(), 8, "all states that can be reached were: {met:?}");
}
