//! The calls of FMI 3.0: one row for each function, with what is known of its result.

mod values;

use super::player::{Array, BLANK, Player, Saved, real};
use super::shared::{LOG_EVENTS, NUMBERS, call, function, same_plays};
use super::{Game, Play, play_one};
use crate::master::v3::{Api, UNKNOWN};
use crate::master::{Random, Slave};
use fmi_model::instance::Interface;
use fmi_model::phase::Phase;
use fmi_model::v3::sys::{Boolean, Status};
use fmi_model::{Model, Role, Simulation, table};
use std::ffi::{c_char, c_void};
use std::ptr::{null, null_mut};
use std::rc::Rc;
use values::{clocks, miscount, values};

impl<M: Model> Game for Api<M> {
    const ONWARD: u64 = 2;

    fn plays() -> Vec<(&'static str, Play<Self>)> {
        let mut plays = states();
        plays.extend(values());
        plays.extend(clocks());
        plays.extend(own_plays());
        plays
    }
    fn onward(player: &Player<Self>) -> &'static str {
        match player.phase {
            Phase::Instantiated => "fmi3EnterInitializationMode",
            Phase::InitializationMode => "fmi3ExitInitializationMode",
            Phase::StepComplete => "fmi3DoStep",
            Phase::EventMode => "fmi3EnterContinuousTimeMode",
            Phase::ContinuousTimeMode => "fmi3SetContinuousStates",
            Phase::IntermediateUpdateMode => "fmi3GetFloat64",
            _ => "fmi3Reset",
        }
    }
    fn instance(api: &Self, interface: Interface, seed: u64) -> Slave<'_, Self> {
        match interface {
            // A quarter of them are asked for inputs.
            Interface::CoSimulation if seed % 8 > 1 => {
                let inputs = inputs::<M>();
                let moves = <M as Model>::Simulation::INTERNAL_STEP.is_some() && seed % 8 > 5;
                Slave::open(api, seed % 16 > 7, if moves { &inputs } else { &[] })
            }
            _ => Slave::with(api, interface, false),
        }
    }
}

/// Value references of all inputs.
fn inputs<M: Model>() -> Vec<u32> {
    let is_input = |&i: &u32| matches!(M::VARIABLES[i as usize].role, Role::Input(_));
    (0..M::VARIABLES.len() as u32).filter(is_input).collect()
}

fn states<M: Model>() -> Vec<(&'static str, Play<Api<M>>)> {
    same_plays! {
        "fmi3SetDebugLogging" "fmi3ExitInitializationMode" "fmi3Terminate" "fmi3Reset"
        "fmi3GetFMUState" "fmi3SetFMUState" "fmi3FreeFMUState"
        "fmi3SerializedFMUStateSize" "fmi3SerializeFMUState" "fmi3DeserializeFMUState"
        "fmi3EnterEventMode" "fmi3EnterContinuousTimeMode" "fmi3SetTime" "fmi3SetContinuousStates"
        "fmi3GetContinuousStateDerivatives" "fmi3GetContinuousStates"
        "fmi3GetNominalsOfContinuousStates" "fmi3GetEventIndicators"
    }
}

/// A call that this model always refuses.
fn absent<M: Model>(
    p: &mut Player<Api<M>>,
    call: impl FnOnce(&Player<Api<M>>) -> Status,
) -> Status {
    p.unsound = true;
    call(p)
}

/// A sum over the rows or columns of the Jacobian; the counts may be those of other arrays.
macro_rules! partial {
    ($p:ident $r:ident $function:ident $adjoint:literal) => {{
        let known = Player::<Api<M>>::references($r, real, false);
        let (count, off) = (known.len(), miscount($r));
        let known = Array::new($r, known, 0);
        // As many as either side may need.
        let seed = Array::of($r, 4, |r| r.pick(&NUMBERS));
        let function = $p.slave.api.$function;
        let ((known, sound), (seed, seeded)) =
            ((known.pointer, known.sound), (seed.pointer, seed.sound));
        // SAFETY: see `call!`.
        let (status, _) = $p.read($r, real, BLANK, |c, v, n, x| unsafe {
            match $adjoint {
                // What is read is the side that is summed up for: the knowns.
                true => function(c, known, count, v, n, seed, count + off, x, n),
                false => function(c, v, n, known, count, seed, count + off, x, n),
            }
        });
        $p.unsound |= off > 0 || !(sound && (seeded || count == 0));
        $p.unsound |= <M as Model>::Simulation::TANGENT.is_none();
        status
    }};
}

fn own_plays<M: Model>() -> Vec<(&'static str, Play<Api<M>>)> {
    vec![
        ("fmi3EnterInitializationMode", |p, r| {
            let [tolerance, start, stop] = [(); 3].map(|()| r.pick(&NUMBERS));
            let plain = r.below(4) > 0;
            let start = if plain { 0.0 } else { start };
            let given = (!plain).into();
            call!(p.enter_initialization_mode(given, tolerance, start, given, stop))
        }),
        ("fmi3GetNumberOfVariableDependencies", |p, r| {
            let place = p.place(r, 7);
            absent(p, |p| call!(p.get_number_of_variable_dependencies(0, place.pointer)))
        }),
        ("fmi3GetVariableDependencies", |p, _| {
            let (at, kinds) = (null_mut(), null_mut());
            absent(p, |p| call!(p.get_variable_dependencies(0, at, null_mut(), at, kinds, 1)))
        }),
        ("fmi3GetDirectionalDerivative", |p, r| partial!(p r directional_derivative false)),
        ("fmi3GetAdjointDerivative", |p, r| partial!(p r adjoint_derivative true)),
        ("fmi3EnterConfigurationMode", |p, _| absent(p, |p| call!(p.enter_configuration_mode()))),
        ("fmi3ExitConfigurationMode", |p, _| absent(p, |p| call!(p.exit_configuration_mode()))),
        ("fmi3EvaluateDiscreteStates", |p, _| absent(p, |p| call!(p.evaluate_discrete_states()))),
        ("fmi3EnterStepMode", |p, _| absent(p, |p| call!(p.enter_step_mode()))),
        ("fmi3ActivateModelPartition", |p, r| {
            let time = r.pick(&NUMBERS);
            absent(p, |p| call!(p.activate_model_partition(0, time)))
        }),
        ("fmi3UpdateDiscreteStates", |p, r| {
            let flags = [(); 5].map(|()| p.place(r, UNKNOWN));
            let (time, [a, b, c, d, e]) = (p.place(r, BLANK), flags.each_ref().map(|f| f.pointer));
            let status = call!(p.update_discrete_states(a, b, c, d, e, time.pointer));
            let blank = flags.iter().filter(|flag| flag.items[0] == UNKNOWN).count();
            assert_eq!(blank, if status == Status::Ok { 0 } else { 5 });
            assert_eq!(time.items[0] == BLANK, status != Status::Ok);
            status
        }),
        ("fmi3CompletedIntegratorStep", |p, r| {
            let flags = [(); 2].map(|()| p.place(r, UNKNOWN));
            let [event, end] = flags.each_ref().map(|flag| flag.pointer);
            let status = call!(p.completed_integrator_step(Boolean(r.below(3) as u8), event, end));
            for flag in flags {
                assert_eq!(flag.items[0] == UNKNOWN, status != Status::Ok);
            }
            status
        }),
        ("fmi3GetNumberOfEventIndicators", |p, r| {
            let place = p.place(r, 77);
            let status = call!(p.get_number_of_event_indicators(place.pointer));
            assert_eq!(place.items[0], if status == Status::Ok { 0 } else { 77 });
            status
        }),
        ("fmi3GetNumberOfContinuousStates", |p, r| {
            let place = p.place(r, 77);
            let status = call!(p.get_number_of_continuous_states(place.pointer));
            assert_eq!(
                place.items[0],
                if status == Status::Ok { table::states::<M>() } else { 77 }
            );
            status
        }),
        ("fmi3GetOutputDerivatives", |p, r| {
            let (orders, off) = (Array::of(r, 4, |r| r.below(4) as i32 - 1), miscount(r));
            let (function, order) = (p.slave.api.get_output_derivatives, orders.pointer);
            // SAFETY: see `call!`; four orders are enough.
            let (status, _) = p.read(r, real, BLANK, |c, v, n, x| unsafe {
                function(c, v, n, order, x, n.wrapping_add(off))
            });
            p.unsound |= off > 0 || <M as Model>::Simulation::TANGENT.is_none();
            status
        }),
        ("fmi3DoStep", |p, r| {
            let sound = p.phase == Phase::StepComplete && r.below(4) > 0;
            let (point, step) = match sound {
                true => (p.slave.time(), r.pick(&[0.05, 0.05, 0.5, 30.0])),
                false => (r.pick(&NUMBERS), r.pick(&NUMBERS[..13])),
            };
            if sound && !p.c.is_null() && !p.within && r.below(2) == 0 {
                return look_in(p, r, point, step);
            }
            let flags = [(); 3].map(|()| p.place(r, UNKNOWN));
            let (time, [event, end, early]) =
                (p.place(r, BLANK), flags.each_ref().map(|f| f.pointer));
            let no = Boolean(r.below(3) as u8);
            let status = call!(p.do_step(point, step, no, event, end, early, time.pointer));
            let answers = flags.map(|flag| flag.items[0]);
            let blank = answers.iter().filter(|answer| **answer == UNKNOWN).count();
            assert_eq!(blank, if status == Status::Ok { 0 } else { 3 });
            assert_eq!(time.items[0] == BLANK, status != Status::Ok);
            p.ended = answers[1] == Boolean::TRUE;
            status
        }),
    ]
}

/// A step within which anything is called, and an early return asked for at any time.
fn look_in<M: Model>(p: &mut Player<Api<M>>, r: &mut Random, point: f64, step: f64) -> Status {
    let slave = Rc::clone(&p.slave);
    let (c, phase) = (p.c, p.phase);
    (p.within, p.phase) = (true, Phase::IntermediateUpdateMode);
    let mut looked = false;
    let answers = slave.step_with(point, step, |moment| {
        assert!(point <= moment.time && moment.time <= point + step);
        for _ in 0..r.below(3) {
            let name = match r.below(2) {
                0 => r.pick(&["fmi3GetFloat64", "fmi3SetFloat64", "fmi3GetOutputDerivatives"]),
                _ => r.pick(&Api::<M>::plays()).0,
            };
            looked = true;
            play_one(p, r, name);
        }
        let times = [moment.time, moment.time + 0.01, point + step];
        match r.below(4) {
            0 => Some(r.pick(&NUMBERS)),
            1 => Some(r.pick(&times)),
            _ => None,
        }
    });
    // What the calls within said was theirs.
    let misbehaved = p.phase != Phase::IntermediateUpdateMode;
    (p.within, p.c, p.looked, p.unsound) = (false, c, looked, misbehaved);
    p.phase = phase;
    p.ended = answers.end;
    assert!(!misbehaved || answers.status == Status::Error, "an error within a step ends it");
    assert!(!answers.event && (!answers.early || answers.time < point + step));
    answers.status
}
