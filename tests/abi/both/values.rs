//! Reading and setting variables.

use super::{Api, Slave};
use crate::common::reference;
use crate::master::Api as _;
use ahv::variables::TABLE;
use fmi_model::status::Status;
use fmi_model::{Kind, Role};

/// Unknowns, knowns, seed, what is returned, and words of the reason.
type Refused<'a> = (&'a [u32], &'a [u32], &'a [f64], Status, &'a str);

/// What is returned for a value that cannot be taken.
const REFUSED: Status = Api::REFUSED;

#[test]
fn a_refused_value_names_variable_and_value_and_nothing_of_the_call_is_set() {
    let api = Api::load();
    let slave = Slave::new(&api);
    let (good, after) = (reference("alpha0"), reference("q0"));
    assert_eq!(slave.set("alpha0", 0.01), Status::Ok);
    let refused = [
        ("delta_e", f64::NAN, REFUSED, "delta_e = NaN"),
        ("phi", f64::INFINITY, REFUSED, "phi = inf"),
        ("mach0", f64::NEG_INFINITY, REFUSED, "mach0 = -inf"),
        ("fuel_fraction", 1.5, REFUSED, "fuel_fraction = 1.5"),
        ("V", 2000.0, Status::Error, "V = 2000"),
        ("alpha_trim", 0.0, Status::Error, "alpha_trim = 0"),
    ];
    for (name, value, status, reason) in refused {
        let references = [good, reference(name), after];
        slave
            .refuses(status, &[reason], |slave| slave.set_reals(&references, &[0.02, value, 0.02]));
    }
    let unknown = ["value reference 4294967295 is unknown"];
    slave
        .refuses(Status::Error, &unknown, |slave| slave.set_reals(&[good, u32::MAX], &[0.03, 0.0]));
    slave.refuses(REFUSED, &["input_mode = 3"], |slave| slave.set_enumeration("input_mode", 3));
    assert_eq!(slave.begin(), Status::Ok);
    assert_eq!(slave.get("alpha0"), 0.01);
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
    assert_eq!(slave.set_enumeration("configuration", 1), Status::Ok);
    assert_eq!(slave.begin(), Status::Ok);
    let before = slave.get("alpha");
    assert_eq!(slave.set("mach0", 7.5), Status::Ok);
    assert_ne!(slave.get("alpha"), before, "outputs follow parameters during initialisation");
    set_all(&slave);
    assert_eq!(slave.exit(), Status::Ok);
    assert_eq!(slave.get("alpha"), before);
    slave.refuses(Status::Error, &["mach0 = 8"], |slave| slave.set("mach0", 8.0));
    slave.refuses(Status::Error, &["trim = 0"], |slave| slave.set_boolean("trim", false));
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
    let rates = ["der(q)", "der(alpha)"].map(reference);
    let both = ["q", "delta_e"].map(reference);
    let untouched = 123.0;
    let call = |unknowns: &[u32], knowns: &[u32], seed: &[f64]| {
        let mut change = vec![untouched; unknowns.len()];
        (api.directional(slave.c, unknowns, knowns, seed, &mut change), change)
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

    let (alpha_trim, fuel) = (reference("alpha_trim"), reference("fuel_fraction"));
    let refused: [Refused; 4] = [
        (&[rates[0], alpha_trim], &both, &[1.0; 2], Status::Error, "alpha_trim"),
        (&rates, &[both[0], fuel], &[1.0; 2], Status::Error, "fuel_fraction"),
        (&rates, &both, &[1.0, f64::NAN], REFUSED, "delta_e"),
        (&[rates[0], 10_000], &both, &[1.0; 2], Status::Error, "10000"),
    ];
    for (unknowns, knowns, seed, status, named) in refused {
        slave.refuses(status, &[named], |_| {
            let (status, change) = call(unknowns, knowns, seed);
            assert_eq!(change, vec![untouched; 2], "{named}");
            status
        });
    }
}
