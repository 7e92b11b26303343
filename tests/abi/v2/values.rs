//! Arguments of FMI 2.0: instantiation, types, NULL.

use crate::common::fmi2::{Api, Slave};
use crate::common::reference;
use crate::master::v2::callbacks;
use crate::master::{Api as _, Sink};
use ahv::variables::TABLE;
use fmi_model::v2::sys::{CallbackFunctions, Component, FmiString, Status, Type};
use fmi_model::{Kind, identity::guid};
use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

#[test]
fn the_versions_are_those_of_the_standard() {
    let api = Api::load();
    // SAFETY: both return static C strings.
    unsafe {
        assert_eq!(CStr::from_ptr((api.get_version)()), c"2.0");
        assert_eq!(CStr::from_ptr((api.get_types_platform)()), c"default");
    }
}

fn instantiate(
    api: &Api,
    name: FmiString,
    kind: Type,
    guid: FmiString,
    resources: FmiString,
    functions: *const CallbackFunctions,
) -> Component {
    // SAFETY: the arguments are NULL or valid.
    unsafe { (api.instantiate)(name, kind, guid, resources, functions, 0, 0) }
}

#[test]
fn instantiation_says_why_it_fails_and_accepts_any_resource_location() {
    let api = Api::load();
    let sink = Sink::default();
    let functions = callbacks(&sink);
    let own = CString::new(guid::<ahv::flight::Setup>()).unwrap();
    let (name, own) = (c"one".as_ptr(), own.as_ptr());
    let cs = Type::CO_SIMULATION;
    let cases = [
        (null(), cs, own, "", "instanceName is NULL"),
        (c"".as_ptr(), cs, own, "", "instance name must not be empty"),
        (c" \t".as_ptr(), cs, own, " \t", "instance name must not be empty"),
        (name, Type(2), own, "one", "fmuType = 2 does not exist"),
        (name, Type(77), own, "one", "fmuType = 77 does not exist"),
        (name, cs, null(), "one", "fmuGUID is NULL"),
        (name, cs, c"{100%-#1}".as_ptr(), "one", "fmuGUID is {100%%-##1}"),
    ];
    for (name, kind, guid, logged, reason) in cases {
        let c = instantiate(&api, name, kind, guid, null(), &functions);
        let mut log = std::mem::take(&mut *sink.lock().unwrap());
        assert!(c.is_null() && log.len() == 1, "{reason}");
        let record = log.remove(0);
        assert_eq!(record.name, logged);
        assert_eq!((record.status, record.category.as_str()), (Status::Error, "logStatusError"));
        assert!(record.message.contains(reason), "{}", record.message);
        let mute = CallbackFunctions { logger: None, ..functions };
        assert!(instantiate(&api, name, kind, guid, null(), &mute).is_null());
    }
    assert!(instantiate(&api, name, cs, own, null(), null()).is_null());
    let places = [null(), c"".as_ptr(), c"file:///C:/a b/%zz".as_ptr(), c"\xff".as_ptr()];
    for place in places {
        let c = instantiate(&api, name, cs, own, place, &functions);
        assert!(!c.is_null());
        // SAFETY: a live instance, freed once.
        unsafe { (api.free_instance)(c) };
    }
    assert!(sink.lock().unwrap().is_empty());
}

#[test]
fn null_instances_are_refused_and_freeing_null_is_ignored() {
    let api = Api::load();
    let none = null_mut();
    // SAFETY: NULL is what is tested.
    unsafe {
        (api.free_instance)(none);
        assert_eq!((api.do_step)(none, 0.0, 0.1, 0), Status::Error);
        assert_eq!((api.reset)(none), Status::Error);
        assert_eq!((api.get_real)(none, &0, 1, &mut 0.0), Status::Error);
        assert_eq!((api.free_state)(none, null_mut()), Status::Error);
        assert_eq!(
            (api.get_boolean_status)(none, fmi_model::v2::sys::StatusKind(3), null_mut()),
            Status::Error
        );
    }
}

#[test]
fn null_arrays_and_absurd_lengths_are_refused_and_empty_ones_need_no_array() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let (c, vr) = (slave.c, reference("V"));
    let odd = std::ptr::from_ref(&[0_u8; 16]).cast::<u8>().wrapping_add(1);
    // SAFETY: NULL, misalignment and absurd lengths are what is tested: none is dereferenced.
    unsafe {
        assert_eq!((api.get_real)(c, null(), 1, &mut 0.0), Status::Error);
        assert!(slave.message().message.contains("vr is NULL"));
        assert_eq!((api.get_real)(c, &vr, 1, null_mut()), Status::Error);
        assert!(slave.message().message.contains("value is NULL"));
        assert_eq!((api.set_real)(c, &vr, usize::MAX, &0.0), Status::Error);
        assert_eq!((api.set_real)(c, &vr, 1, null()), Status::Error);
        if !odd.cast::<u32>().is_aligned() {
            assert_eq!((api.set_real)(c, odd.cast(), 1, &0.0), Status::Error);
        }
        assert_eq!((api.get_real)(c, null(), 0, null_mut()), Status::Ok);
        assert_eq!((api.get_string)(c, null(), 0, null_mut()), Status::Ok);
        assert_eq!(
            (api.get_real_status)(c, fmi_model::v2::sys::StatusKind(2), null_mut()),
            Status::Error
        );
        assert_eq!((api.set_debug_logging)(c, 1, 1, null()), Status::Error);
        assert_eq!((api.set_debug_logging)(c, 1, 1, &null()), Status::Error);
        assert_eq!((api.get_state)(c, null_mut()), Status::Error);
        assert_eq!((api.set_state)(c, null_mut()), Status::Error);
        assert_eq!((api.free_state)(c, null_mut()), Status::Ok);
        assert_eq!((api.free_state)(c, &mut null_mut()), Status::Ok);
        assert_eq!((api.state_size)(c, null_mut(), &mut 0), Status::Error);
        assert_eq!((api.deserialize)(c, null(), 100, &mut null_mut()), Status::Error);
    }
}

#[test]
fn every_variable_is_read_by_the_function_of_its_type_and_refused_by_the_others() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    for (vr, variable) in (0..).zip(&TABLE) {
        let c = slave.c;
        // SAFETY: room for one value each.
        let statuses = unsafe {
            [
                (api.get_real)(c, &vr, 1, &mut 0.0),
                (api.get_integer)(c, &vr, 1, &mut 0),
                (api.get_boolean)(c, &vr, 1, &mut 0),
                (api.get_string)(c, &vr, 1, &mut null()),
                (api.set_string)(c, &vr, 1, &null()),
            ]
        };
        let right = match variable.kind {
            Kind::Real(_) => 0,
            Kind::Integer | Kind::Enumeration(..) => 1,
            Kind::Boolean => 2,
        };
        for (i, status) in statuses.into_iter().enumerate() {
            let expected = if i == right { Status::Ok } else { Status::Error };
            assert_eq!(status, expected, "{} {i}", variable.name);
        }
    }
    let log = slave.log();
    assert!(log.iter().any(|record| record.message.contains("configuration (value reference")));
    let (status, values) = slave.reals(&[reference("V"), TABLE.len() as u32]);
    assert_eq!(status, Status::Error);
    assert!(values[0].is_nan(), "nothing is written by a refused call");
}

#[test]
fn a_boolean_is_0_or_1() {
    let api = Api::load();
    let slave = Slave::new(&api);
    // SAFETY: arrays of one element.
    let set = |slave: &Slave| unsafe { (api.set_boolean)(slave.c, &reference("trim"), 1, &2) };
    slave.refuses(Status::Error, &["trim = 2"], set);
}
