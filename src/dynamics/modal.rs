//! Modal equation of motion; not inlined, for the reason given in [`super::coefficients`].
//!
//! ```text
//! eta'' = N + floor - D eta' - diag(K) eta
//! ```
//!
//! The off-diagonal part of K, present only while fuel burns, is added in `burning`.

use super::coefficients::add;
use super::loads::Airflow;
use crate::solve::{Over, Scalar};
use crate::structure::MODES;
use crate::vehicle::{Airframe, State, eta, eta_dot};
use multiversion::multiversion;

/// Second derivatives of the modal coordinates.
#[multiversion(targets("x86_64+avx"))]
pub fn accelerations<C: Copy, S: Scalar + Over<C>>(
    airframe: &Airframe<C>,
    airflow: &Airflow<S>,
    x: &State<S>,
) -> [S; MODES] {
    let (of, n) = (&airflow.coefficients, &airframe.elastic.force);
    let (alpha, thrust) = (of.incidence, airflow.loads.thrust);
    // Per qbar S.
    let mut air = n.alpha[0].map(S::of);
    add(&mut air, alpha, &n.alpha[1]);
    add(&mut air, alpha * alpha, &n.alpha[2]);
    add(&mut air, of.elevator, &n.delta_e);
    add(&mut air, of.plume, &n.plume);
    let mut sum = airframe.floor.map(S::of);
    add(&mut sum, thrust * airflow.wind.incidence_sin_cos.0, &n.thrust_across);
    add(&mut sum, thrust, &n.thrust_couple);
    for i in 0..MODES {
        let stiffness = x[eta(i)] * airframe.stiffness[i][i];
        sum[i] = sum[i] + airflow.force * (air[i] + of.forces[i]) - stiffness;
    }
    for (k, column) in airframe.damping.iter().enumerate() {
        add(&mut sum, -x[eta_dot(k)], column);
    }
    sum
}
