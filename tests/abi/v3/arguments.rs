//! Arguments of FMI 3.0: types, counts, pointers, the independent variable.

use crate::common::fmi3::{Api, Slave};
use crate::common::reference;
use crate::master::Api as _;
use crate::master::v3::{TIME, UNKNOWN};
use ahv::variables::TABLE;
use fmi_model::Kind;
use fmi_model::v3::sys::{Boolean, Status};
use std::ptr::{null, null_mut};

const ERROR: Status = Status::Error;

#[test]
fn every_variable_is_read_by_the_function_of_its_type_and_refused_by_the_others() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let saved = slave.save();
    for (vr, variable) in (0..).zip(&TABLE) {
        let (c, vr) = (slave.c, &raw const vr);
        // SAFETY: room for one value each.
        let statuses = unsafe {
            [
                (api.get_float64)(c, vr, 1, &mut 0.0, 1),
                (api.get_int64)(c, vr, 1, &mut 0, 1),
                (api.get_boolean)(c, vr, 1, &mut { UNKNOWN }, 1),
                (api.get_float32)(c, vr, 1, &mut 0.0, 1),
                (api.get_int8)(c, vr, 1, &mut 0, 1),
                (api.get_uint8)(c, vr, 1, &mut 0, 1),
                (api.get_int16)(c, vr, 1, &mut 0, 1),
                (api.get_uint16)(c, vr, 1, &mut 0, 1),
                (api.get_int32)(c, vr, 1, &mut 0, 1),
                (api.get_uint32)(c, vr, 1, &mut 0, 1),
                (api.get_uint64)(c, vr, 1, &mut 0, 1),
                (api.get_string)(c, vr, 1, &mut null(), 1),
                (api.set_string)(c, vr, 1, &null(), 1),
                (api.get_binary)(c, vr, 1, &mut 0, &mut null(), 1),
                (api.get_clock)(c, vr, 1, &mut { UNKNOWN }),
            ]
        };
        let right = match variable.kind {
            Kind::Real(_) => 0,
            Kind::Enumeration(..) => 1,
            Kind::Boolean => 2,
            Kind::Integer => 8,
        };
        assert_eq!(slave.load(saved), Status::Ok);
        // The first refusal ends the run, after which values can still be read.
        for (i, status) in statuses.into_iter().enumerate() {
            let expected = if i == right { Status::Ok } else { ERROR };
            assert_eq!(status, expected, "{} {i}", variable.name);
        }
    }
    let log = slave.log();
    let says = |text: &str| log.iter().any(|record| record.message.contains(text));
    assert!(says("configuration (value reference") && says("its type is Enumeration (Int64)"));
    slave.free(saved);
}

#[test]
fn there_are_as_many_values_as_variables_and_the_arrays_are_there() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let (vr, odd) = (reference("V"), [0_u8; 17]);
    let odd = odd.as_ptr().wrapping_add(usize::from(odd.as_ptr().cast::<u32>().is_aligned()));
    let mut room = [f64::NAN; 2];
    let to = room.as_mut_ptr();
    // SAFETY: NULL, misalignment and wrong lengths are what is tested: none is dereferenced.
    let refuses = |words: &[&str], call: &dyn Fn(&Api, *mut std::ffi::c_void) -> Status| {
        slave.refuses(ERROR, words, |slave| call(slave.api, slave.c));
    };
    let counts = ["nValues = 2 is refused", "so 1 values are needed"];
    unsafe {
        refuses(&counts, &|api, c| (api.get_float64)(c, &vr, 1, to, 2));
        refuses(&counts, &|api, c| (api.set_float64)(c, &vr, 1, to, 2));
        refuses(&["nValues = 2"], &|api, c| (api.get_int8)(c, &vr, 1, null_mut(), 2));
        refuses(&["nValues = 1"], &|api, c| (api.get_uint64)(c, null(), 0, null_mut(), 1));
        refuses(&["nValues = 0"], &|api, c| (api.get_float64)(c, &vr, 1, to, 0));
        refuses(&["valueReferences is NULL"], &|api, c| (api.get_float64)(c, null(), 1, to, 1));
        refuses(&["values is NULL"], &|api, c| (api.get_float64)(c, &vr, 1, null_mut(), 1));
        refuses(&["values is NULL"], &|api, c| (api.set_float64)(c, &vr, 1, null(), 1));
        let most = usize::MAX;
        refuses(&["valueReferences"], &|api, c| (api.set_float64)(c, &vr, most, to, most));
        refuses(&["valueReferences"], &|api, c| (api.set_float64)(c, odd.cast(), 1, to, 1));
        refuses(&["size is NULL"], &|api, c| {
            let saved = slave.save();
            let status = (api.state_size)(c, saved, null_mut());
            (api.free_state)(c, &mut { saved });
            status
        });
        refuses(&["FMUState is NULL"], &|api, c| (api.set_state)(c, null_mut()));
        refuses(&["FMUState is NULL"], &|api, c| (api.get_state)(c, null_mut()));
        refuses(&["categories is NULL"], &|api, c| {
            (api.set_debug_logging)(c, Boolean::TRUE, 1, null())
        });
        refuses(&["these 2 bytes are no FMU state"], &|api, c| {
            (api.deserialize)(c, [0, 1].as_ptr(), 2, &mut null_mut())
        });
        let no = Boolean::FALSE;
        refuses(&["earlyReturn is NULL"], &|api, c| {
            let (mut event, mut end) = (UNKNOWN, UNKNOWN);
            let step = api.do_step;
            let status = step(c, 0.0, 0.1, no, &mut event, &mut end, null_mut(), &mut 0.0);
            assert_eq!([event, end], [UNKNOWN; 2]);
            status
        });
        assert_eq!((api.get_float64)(slave.c, null(), 0, null_mut(), 0), Status::Ok);
        assert_eq!((api.get_string)(slave.c, null(), 0, null_mut(), 0), Status::Ok);
        assert_eq!((api.free_state)(slave.c, null_mut()), Status::Ok);
        assert_eq!((api.free_state)(slave.c, &mut null_mut()), Status::Ok);
    }
    assert!(room.iter().all(|value| value.is_nan()), "nothing is written");
}

#[test]
fn any_byte_but_zero_is_true() {
    let api = Api::load();
    let slave = Slave::new(&api);
    let vr = reference("trim");
    for byte in [0, 1, 2, 128, 255] {
        // SAFETY: arrays of one element.
        let status = unsafe { (api.set_boolean)(slave.c, &vr, 1, &Boolean(byte), 1) };
        assert_eq!(status, Status::Ok);
        let mut read = UNKNOWN;
        // SAFETY: likewise.
        let status = unsafe { (api.get_boolean)(slave.c, &vr, 1, &mut read, 1) };
        assert_eq!((status, read), (Status::Ok, Boolean::from(byte > 0)), "{byte}");
    }
}

#[test]
fn time_is_a_variable_that_only_steps_and_a_master_that_integrates_move() {
    let api = Api::load();
    let slave = Slave::new(&api);
    assert_eq!(slave.set_enumeration("configuration", 1), Status::Ok);
    assert_eq!(slave.begin_with(None, 2.5, Some(4.0)), Status::Ok);
    assert_eq!(slave.time(), 2.5);
    assert_eq!(slave.exit(), Status::Ok);
    assert_eq!(slave.step(2.5, 0.125), Status::Ok);
    assert_eq!(slave.reals(&[TIME, reference("V")]).1[0], 2.625, "beside others");
    slave.refuses(ERROR, &["time can only be read"], |slave| slave.set_reals(&[TIME], &[0.0]));
    slave.refuses(ERROR, &["2147483647"], |slave| {
        api.directional(slave.c, &[reference("der(q)")], &[TIME], &[1.0], &mut [0.0])
    });
    // SAFETY: room for one value.
    let as_integer = |slave: &Slave| unsafe { (api.get_int64)(slave.c, &TIME, 1, &mut 0, 1) };
    slave.refuses(ERROR, &["time (value reference 2147483647) is no Int64"], as_integer);
    let exchange = Slave::exchange(&api);
    exchange.start();
    assert_eq!(api.enter_continuous_time_mode(exchange.c), Status::Ok);
    assert_eq!(api.set_time(exchange.c, 0.375), Status::Ok);
    assert_eq!(exchange.time(), 0.375);
}

#[test]
fn a_fixed_configuration_knows_neither_clocks_nor_discrete_states_nor_elements() {
    let api = Api::load();
    let slave = Slave::exchange(&api);
    slave.start();
    let vr = reference("V");
    // SAFETY: room for one value each.
    unsafe {
        slave.refuses(ERROR, &["is no Clock"], |slave| {
            (api.get_clock)(slave.c, &vr, 1, &mut { UNKNOWN })
        });
        slave.refuses(ERROR, &["does not promise discrete states"], |slave| {
            (api.evaluate_discrete_states)(slave.c)
        });
        slave.refuses(ERROR, &["single elements: the variables are scalars"], |slave| {
            (api.get_number_of_variable_dependencies)(slave.c, vr, &mut 0)
        });
        slave.refuses(ERROR, &["fmi3EnterConfigurationMode: not allowed"], |slave| {
            (api.enter_configuration_mode)(slave.c)
        });
        slave.refuses(ERROR, &["fmi3DoStep: not a function of Model Exchange"], |slave| {
            slave.step(0.0, 0.1)
        });
        let (mut states, mut indicators) = (77, 77);
        assert_eq!((api.get_number_of_continuous_states)(slave.c, &mut states), Status::Ok);
        assert_eq!((api.get_number_of_event_indicators)(slave.c, &mut indicators), Status::Ok);
        assert_eq!((states, indicators), (ahv::vehicle::STATES, 0));
    }
}
