//! Partial derivatives by rows and by columns, and derivatives of outputs by time.

use crate::common::fmi3::{Api, Slave};
use crate::common::{configurations, fmi2, reference};
use crate::master::Api as _;
use ahv::variables::TABLE;
use fmi_model::Role;
use fmi_model::status::Status;

/// Unknowns, knowns, seed, what is returned, and words of the reason.
type Refused<'a> = (&'a [u32], &'a [u32], &'a [f64], Status, &'a str);

/// Sums over a column of the Jacobian are made in another order than those of this test.
const ROUNDING: f64 = 1e-13;

fn adjoint(slave: &Slave, unknowns: &[u32], knowns: &[u32], seed: &[f64]) -> (Status, Vec<f64>) {
    let mut sums = vec![f64::NAN; knowns.len()];
    let ((y, x), function) = ((unknowns, knowns), slave.api.adjoint_derivative);
    let (seed, seeds, to) = (seed.as_ptr(), seed.len(), sums.as_mut_ptr());
    // SAFETY: a live instance, arrays of the lengths given.
    let status = unsafe {
        function(slave.c, y.as_ptr(), y.len(), x.as_ptr(), x.len(), seed, seeds, to, x.len())
    };
    (status, sums)
}

fn references(fits: fn(Role<ahv::flight::Setup>) -> bool) -> Vec<u32> {
    (0..TABLE.len() as u32).filter(|&i| fits(TABLE[i as usize].role)).collect()
}

#[test]
fn an_adjoint_derivative_is_the_transposed_jacobian_times_its_seed() {
    let api = Api::load();
    let unknowns = references(|role| {
        matches!(role, Role::Output(_) | Role::OutputState(_) | Role::Derivative(_))
    });
    let knowns = references(|role| {
        matches!(role, Role::OutputState(_) | Role::LocalState(_) | Role::Input(_))
    });
    // Of a size that gives each row a share of the sum.
    let seed: Vec<_> = (0..unknowns.len()).map(|i| 1.0 / (1.0 + i as f64)).collect();
    for configuration in configurations() {
        let slave = Slave::flying_as(&api, configuration);
        assert_eq!(slave.step(0.0, 0.1), Status::Ok);
        let (status, sums) = adjoint(&slave, &unknowns, &knowns, &seed);
        assert_eq!(status, Status::Ok);
        let mut moved = 0;
        for (&known, sum) in knowns.iter().zip(sums) {
            let mut column = vec![f64::NAN; unknowns.len()];
            let status = api.directional(slave.c, &unknowns, &[known], &[1.0], &mut column);
            assert_eq!(status, Status::Ok);
            let shares: Vec<_> = column.iter().zip(&seed).map(|(one, seed)| one * seed).collect();
            let (expected, size): (f64, f64) =
                (shares.iter().sum(), shares.iter().map(|share| share.abs()).sum());
            let name = TABLE[known as usize].name;
            assert!((sum - expected).abs() <= ROUNDING * size, "{name}: {sum} {expected}");
            moved += usize::from(size > 0.0);
        }
        assert!(moved > knowns.len() / 2, "{moved} of {}", knowns.len());
    }
}

#[test]
fn an_adjoint_derivative_writes_all_or_nothing_and_names_what_it_refuses() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let [rate, q, alpha, parameter] = ["der(q)", "q", "alpha", "mach0"].map(reference);
    let refused: [Refused; 6] = [
        (&[rate, parameter], &[q], &[1.0; 2], Status::Error, "mach0 cannot be an unknown"),
        (&[rate], &[q, parameter], &[1.0], Status::Error, "mach0 cannot be a known"),
        (&[rate], &[q, 9999], &[1.0], Status::Error, "9999 is unknown"),
        (&[rate], &[q], &[f64::NAN], Status::Discard, "change of der(q) = NaN"),
        (&[rate, alpha], &[q], &[1.0], Status::Error, "nSeed = 1 is refused"),
        (&[rate], &[q, alpha], &[1.0; 2], Status::Error, "nSeed = 2 is refused"),
    ];
    for (unknowns, knowns, seed, expected, words) in refused {
        slave.refuses(expected, &[words], |slave| {
            let (status, sums) = adjoint(slave, unknowns, knowns, seed);
            assert!(sums.iter().all(|sum| sum.is_nan()), "{words}: {sums:?}");
            status
        });
    }
    assert_eq!(adjoint(&slave, &[], &[q], &[]), (Status::Ok, vec![0.0]));
    assert_eq!(adjoint(&slave, &[rate], &[], &[1.0]).0, Status::Ok);
}

#[test]
fn derivatives_of_outputs_are_those_of_fmi2_to_the_bit() {
    let (api, other) = (Api::load(), fmi2::Api::load());
    for configuration in configurations() {
        let (slave, twin) =
            (Slave::flying_as(&api, configuration), fmi2::Slave::flying_as(&other, configuration));
        assert_eq!(
            (slave.set("delta_e", 0.01), twin.set("delta_e", 0.01)),
            (Status::Ok, Status::Ok)
        );
        assert_eq!((slave.step(0.0, 0.1), twin.step(0.0, 0.1)), (Status::Ok, Status::Ok));
        for name in ["V", "alpha", "q", "eta1", "lift", "moment", "n_z"] {
            let ((one, ours), (two, theirs)) =
                (slave.output_derivative(name, 1), twin.output_derivative(name, 1));
            assert_eq!((one, two), (Status::Ok, Status::Ok), "{name}");
            assert_eq!(ours.to_bits(), theirs.to_bits(), "{name}");
        }
    }
    let slave = Slave::flying(&api);
    for (name, order, words) in
        [("V", 2, "orders are 1 to 1"), ("V", 0, "orders are 1 to 1"), ("mach0", 1, "mach0")]
    {
        slave.refuses(Status::Error, &[words], |slave| slave.output_derivative(name, order).0);
    }
}
