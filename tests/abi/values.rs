//! Reading and setting variables, and instantiation, through the shared library.

use crate::common::{Api, Sink, Slave, callbacks, reference};
use ahv::variables::TABLE;
use fmi_model::v2::sys::{CallbackFunctions, Component, FmiString, Status, Type};
use fmi_model::{Kind, Role, identity::guid};
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
fn a_refused_value_names_variable_and_value_and_nothing_of_the_call_is_set() {
    let api = Api::load();
    let slave = Slave::new(&api);
    let (good, after) = (reference("alpha0"), reference("q0"));
    assert_eq!(slave.set("alpha0", 0.01), Status::Ok);
    let refused = [
        ("delta_e", f64::NAN, "delta_e = NaN"),
        ("phi", f64::INFINITY, "phi = inf"),
        ("mach0", f64::NEG_INFINITY, "mach0 = -inf"),
        ("fuel_fraction", 1.5, "fuel_fraction = 1.5"),
        ("V", 2000.0, "V = 2000"),
        ("alpha_trim", 0.0, "alpha_trim = 0"),
    ];
    let before = slave.save();
    for (name, value, reason) in refused {
        let references = [good, reference(name), after];
        assert_eq!(slave.set_reals(&references, &[0.02, value, 0.02]), Status::Error, "{name}");
        let record = slave.message();
        assert_eq!(record.category, "logStatusError");
        assert!(record.message.contains(reason), "{}", record.message);
        let now = slave.save();
        assert_eq!(slave.bytes(before), slave.bytes(now), "{name}");
        slave.free(now);
    }
    slave.free(before);
    let unknown = [good, u32::MAX];
    assert_eq!(slave.set_reals(&unknown, &[0.03, 0.0]), Status::Error);
    assert!(slave.message().message.contains("value reference 4294967295 is unknown"));
    assert_eq!(slave.set_integer("input_mode", 3), Status::Error);
    assert!(slave.message().message.contains("input_mode = 3"));
    assert_eq!(slave.set_boolean("trim", 2), Status::Error);
    assert!(slave.message().message.contains("trim = 2"));
    assert_eq!(slave.setup(), Status::Ok);
    assert_eq!(slave.enter(), Status::Ok);
    assert_eq!(slave.get("alpha0"), 0.01);
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
fn parameters_can_be_set_until_initialisation_ends_and_inputs_always() {
    let api = Api::load();
    let slave = Slave::new(&api);
    let settable = |role| matches!(role, Role::Parameter { .. } | Role::Input(_));
    let set_all = |slave: &Slave| {
        for (vr, variable) in (0..).zip(&TABLE).filter(|(_, variable)| settable(variable.role)) {
            // A factor cannot be zero.
            let zero = variable.range.is_none_or(|[min, max]| (min..=max).contains(&0.0));
            let value = match variable.name {
                "mach0" => 8.0,
                _ if zero => 0.0,
                _ => 1.0,
            };
            if matches!(variable.kind, Kind::Real(_)) && variable.name != "altitude0" {
                assert_eq!(slave.set_reals(&[vr], &[value]), Status::Ok, "{}", variable.name);
            }
        }
    };
    set_all(&slave);
    assert_eq!(slave.set_integer("configuration", 1), Status::Ok);
    assert_eq!(slave.setup(), Status::Ok);
    assert_eq!(slave.enter(), Status::Ok);
    let before = slave.get("alpha");
    assert_eq!(slave.set("mach0", 7.5), Status::Ok);
    assert_ne!(slave.get("alpha"), before, "outputs follow parameters during initialisation");
    set_all(&slave);
    assert_eq!(slave.exit(), Status::Ok);
    assert_eq!(slave.get("alpha"), before);
    assert_eq!(slave.set("mach0", 8.0), Status::Error);
    assert!(slave.message().message.contains("mach0 = 8"));
    assert_eq!(slave.set_boolean("trim", 0), Status::Error);
    assert_eq!(slave.set("delta_e", 0.01), Status::Ok);
}

#[test]
fn values_read_after_setting_an_input_fit_that_input_without_a_step() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let before = (slave.get("moment"), slave.get("delta_e_effective"), slave.get("der(q)"));
    assert_eq!(slave.set("delta_e", 0.01), Status::Ok);
    assert!((slave.get("delta_e_effective") - before.1 - 0.01).abs() < 1e-15);
    assert!(slave.get("moment") != before.0 && slave.get("der(q)") != before.2);
    assert_eq!(slave.set("delta_e", 0.0), Status::Ok);
    assert_eq!(slave.get("moment"), before.0);
}

#[test]
fn directional_derivatives_write_all_or_nothing_and_name_what_they_refuse() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let c = slave.c;
    let rates = ["der(q)", "der(alpha)"].map(reference);
    let both = ["q", "delta_e"].map(reference);
    let untouched = 123.0;
    let call = |unknowns: &[u32], knowns: &[u32], seed: &[f64]| {
        let mut change = vec![untouched; unknowns.len()];
        let (n, k) = (unknowns.len(), knowns.len());
        let (unknowns, knowns) = (unknowns.as_ptr(), knowns.as_ptr());
        let out = change.as_mut_ptr();
        // SAFETY: arrays of the lengths given.
        let status =
            unsafe { (api.directional_derivative)(c, unknowns, n, knowns, k, seed.as_ptr(), out) };
        (status, change)
    };
    let (status, [pitch, incidence]) = {
        let (status, change) = call(&rates, &both[..1], &[1.0]);
        (status, [change[0], change[1]])
    };
    assert_eq!((status, incidence), (Status::Ok, 1.0), "alpha' = q - gamma'");
    let (_, elevator) = call(&rates, &both[1..], &[1.0]);
    let (_, sum) = call(&rates, &both, &[2.0, 3.0]);
    let expected = 2.0 * pitch + 3.0 * elevator[0];
    assert!((sum[0] - expected).abs() <= 1e-14 * expected.abs());

    let refused = [
        (call(&[rates[0], reference("alpha_trim")], &both, &[1.0; 2]), "alpha_trim"),
        (call(&rates, &[both[0], reference("fuel_fraction")], &[1.0; 2]), "fuel_fraction"),
        (call(&rates, &both, &[1.0, f64::NAN]), "delta_e"),
        (call(&[rates[0], 10_000], &both, &[1.0; 2]), "10000"),
    ];
    let mut messages = slave.log().into_iter();
    for ((status, change), named) in refused {
        assert_eq!((status, change), (Status::Error, vec![untouched; 2]), "{named}");
        let record = messages.next().unwrap();
        assert!(record.message.contains(named), "{record:?}");
    }
}
