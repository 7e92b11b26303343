//! Coefficients of eq. (4): sums over all modes, for all coefficients at once.
//!
//! The order of operations does not depend on the processor, so the bits do not either; AVX computes four
//! coefficients at a time. The functions are not inlined: among code that stores pairs the compiler would
//! vectorise in pairs only.

use crate::air::curve_fits::{
    Aero, DRAG, ELASTIC_ROWS, Elastic, FITS, INCIDENCE, INFLOW, LIFT, MODAL_FORCE, MOMENT, PerMode,
};
use crate::solve::{Over, Scalar};
use crate::vehicle::{Control, Q, State, eta, eta_dot};
use multiversion::multiversion;

/// sum_i += factor per_i.
#[inline(always)]
pub(super) fn add<C: Copy, S: Scalar + Over<C>, const N: usize>(
    sum: &mut [S; N],
    factor: S,
    per: &[C; N],
) {
    for i in 0..N {
        sum[i] = sum[i] + factor * per[i];
    }
}

/// Coefficients of eq. (4) and the angles they depend on.
pub struct Coefficients<S> {
    /// C_L, C_D, C_M and C_T.
    pub body: [S; FITS],
    /// Lift coefficient due to the plume.
    pub plume: S,
    /// Effective elevator deflection, delta_e + k delta_e^3, rad.
    pub elevator: S,
    /// Incidence of the body, rad: that of the mean axes plus its rotation by sloshing liquid.
    pub incidence: S,
    /// Incidence of the engine's inflow, rad.
    pub inflow: S,
    /// N_i due to bending and pitch rate, per qbar S and modal mass, 1/kg.
    pub forces: PerMode<S>,
}

/// Coefficients at a state; incidence `alpha` (rad) and 1/airspeed (s/m) are those of the relative wind.
#[multiversion(targets("x86_64+avx"))]
pub fn coefficients<C: Copy, S: Scalar + Over<C>>(
    aero: &Aero,
    terms: &Elastic<C>,
    x: &State<S>,
    u: &Control<S>,
    [alpha, per_speed]: [S; 2],
) -> Coefficients<S> {
    let mut elastic = [S::constant(0.0); ELASTIC_ROWS];
    for (k, [per_eta, per_rate]) in terms.per.iter().enumerate() {
        add(&mut elastic, x[eta(k)], per_eta);
        add(&mut elastic, x[eta_dot(k)] * per_speed, per_rate);
    }
    add(&mut elastic, x[Q] * per_speed, &terms.pitch_rate);
    let ([delta_e, phi], body) = (*u, alpha + elastic[INCIDENCE]);
    let inflow = body + elastic[INFLOW];
    let incidence = [body, body, body, inflow];
    let own = [elastic[LIFT], elastic[DRAG], elastic[MOMENT], S::constant(0.0)];
    let fuel: [S; FITS] =
        std::array::from_fn(|row| phi * aero.fits_phi.row(row).body(incidence[row]));
    let coefficients = std::array::from_fn(|row| {
        aero.fits.row(row).at(incidence[row], delta_e) + fuel[row] + own[row]
    });
    let elevator = (delta_e * delta_e * aero.elevator_bend + 1.0) * delta_e;
    Coefficients {
        body: coefficients,
        plume: fuel[LIFT],
        elevator,
        incidence: body,
        inflow,
        forces: std::array::from_fn(|i| elastic[MODAL_FORCE + i]),
    }
}
