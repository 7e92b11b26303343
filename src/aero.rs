//! Run-time curve fits: eq. (4).

use crate::envelope::Envelope;
use crate::modes::MODES;
use crate::params::{AeroData, PolynomialData};
use crate::scalar::Scalar;

/// c0 + c1 a + c2 a^2 + c3 a^3 + d1 d + d2 d^2 + d3 d^3 + e a d in incidence a and elevator deflection d, rad.
#[derive(Debug, Clone, Copy, Default)]
pub struct Polynomial {
    /// Coefficients of a^0 to a^3.
    pub alpha: [f64; 4],
    /// Coefficients of d to d^3.
    pub delta_e: [f64; 3],
    /// Coefficient of a d.
    pub cross: f64,
}

impl Polynomial {
    fn new(data: &PolynomialData) -> Self {
        let value =
            |entry: &Option<crate::params::Quantity>| entry.as_ref().map_or(0.0, |q| q.value);
        Self {
            alpha: [
                value(&data.constant),
                value(&data.alpha),
                value(&data.alpha2),
                value(&data.alpha3),
            ],
            delta_e: [value(&data.delta_e), value(&data.delta_e2), value(&data.delta_e3)],
            cross: value(&data.alpha_delta_e),
        }
    }

    /// The part that depends on the incidence.
    #[inline]
    pub fn body<S: Scalar>(&self, alpha: S) -> S {
        let [c0, c1, c2, c3] = self.alpha;
        ((alpha * c3 + c2) * alpha + c1) * alpha + c0
    }

    /// Whole polynomial.
    #[inline]
    pub fn at<S: Scalar>(&self, alpha: S, delta_e: S) -> S {
        let [d1, d2, d3] = self.delta_e;
        self.body(alpha) + ((delta_e * d3 + d2) * delta_e + alpha * self.cross + d1) * delta_e
    }

    /// The elevator's own part, odd in the deflection, over its slope at zero, rad.
    #[inline]
    pub fn elevator<S: Scalar>(&self, delta_e: S) -> S {
        let [d1, _, d3] = self.delta_e;
        let bend = if d3 == 0.0 { 0.0 } else { d3 / d1 };
        (delta_e * delta_e * bend + 1.0) * delta_e
    }

    /// d/da of the whole polynomial, per rad.
    pub fn slope(&self, alpha: f64, delta_e: f64) -> f64 {
        let [_, c1, c2, c3] = self.alpha;
        (3.0 * c3 * alpha + 2.0 * c2) * alpha + c1 + self.cross * delta_e
    }
}

/// How one coefficient answers the modal coordinates, flexible modes first, then slosh modes: per
/// metre of eta, and per metre of eta-dot over V. In pairs, as in the state.
#[derive(Debug, Clone, Copy, Default)]
pub struct ElasticTerm<C = f64> {
    /// d/d eta and d/d(eta-dot/V), 1/m.
    pub per: [[C; 2]; MODES],
}

/// One number for each mode, flexible modes first, then slosh modes.
pub type PerMode<C = f64> = [C; MODES];

/// Generalised forces on the modes: aerodynamic terms over qbar S, thrust terms over the thrust; mode
/// shapes are dimensionless, and both are divided by the modal mass.
#[derive(Debug, Clone, Copy, Default)]
pub struct ModalForces<C = f64> {
    /// N^0, N^alpha, N^alpha2: the rigid body's load, as a polynomial in the incidence.
    pub alpha: [PerMode<C>; 3],
    /// N^delta_e, per rad; the modal force is to this as the elevator's lift to its slope at zero.
    pub delta_e: PerMode<C>,
    /// Of the lift that the plume adds, C_L,phi phi.
    pub plume: PerMode<C>,
    /// By each mode k: N^eta_k, 1/m, and what there is per eta-dot_k/V, 1/m.
    pub elastic: [[PerMode<C>; 2]; MODES],
    /// Per q/V, m.
    pub pitch_rate: PerMode<C>,
    /// Of the thrust's part across the body, T sin alpha, which acts at the mass centre.
    pub thrust_across: PerMode<C>,
    /// Of the thrust's couple, T z_T, which acts at the nacelle.
    pub thrust_couple: PerMode<C>,
}

/// Elastic terms of eq. (4) for one set of modes.
#[derive(Debug, Clone, Copy, Default)]
pub struct Elastic<C = f64> {
    /// C_L^eta.
    pub lift: ElasticTerm<C>,
    /// C_D^eta.
    pub drag: ElasticTerm<C>,
    /// C_M^eta about the moment centre.
    pub moment: ElasticTerm<C>,
    /// Incidence of the engine's inflow, rad.
    pub inflow: ElasticTerm<C>,
    /// N_i.
    pub force: ModalForces<C>,
}

/// A coefficient set, without its elastic terms.
#[derive(Debug, Clone, Copy)]
pub struct Aero {
    /// Reference area per metre of width, m.
    pub area: f64,
    /// Reference chord, m.
    pub chord: f64,
    /// Station of the moment centre, m from the nose.
    pub moment_centre: f64,
    /// Thrust arm z_T, m.
    pub thrust_arm: f64,
    /// Incidence of the elastic derivatives, rad.
    pub elastic_alpha: f64,
    /// Factor on all elastic terms.
    pub elastic_scale: f64,
    /// Elevator deflection of the elastic derivatives, rad.
    pub elastic_delta_e: f64,
    /// C_L.
    pub lift: Polynomial,
    /// C_D.
    pub drag: Polynomial,
    /// C_M about the moment centre, without thrust.
    pub moment: Polynomial,
    /// C_T at phi = 0.
    pub thrust: Polynomial,
    /// dC_T/dphi.
    pub thrust_phi: Polynomial,
    /// dC_L/dphi, in the incidence.
    pub lift_phi: Polynomial,
    /// dC_D/dphi.
    pub drag_phi: Polynomial,
    /// dC_M/dphi, without thrust.
    pub moment_phi: Polynomial,
    /// Where all this holds.
    pub envelope: Envelope,
}

impl Aero {
    /// The run-time form of a data file.
    pub fn new(data: &AeroData) -> Self {
        let optional = |fit: &Option<PolynomialData>| {
            fit.as_ref().map_or_else(Polynomial::default, Polynomial::new)
        };
        Self {
            area: data.reference.area_m2_per_m.value,
            chord: data.reference.chord_m.value,
            moment_centre: data.reference.moment_centre_m.value,
            thrust_arm: data.reference.thrust_arm_m.value,
            elastic_alpha: data.reference.elastic_alpha_rad.value,
            elastic_scale: data.reference.elastic_scale.value,
            elastic_delta_e: data.reference.elastic_delta_e_rad.as_ref().map_or(0.0, |q| q.value),
            lift: Polynomial::new(&data.lift),
            drag: Polynomial::new(&data.drag),
            moment: Polynomial::new(&data.moment),
            thrust: Polynomial::new(&data.thrust),
            thrust_phi: Polynomial::new(&data.thrust_phi),
            lift_phi: optional(&data.lift_phi),
            drag_phi: optional(&data.drag_phi),
            moment_phi: optional(&data.moment_phi),
            envelope: Envelope {
                alpha: data.envelope.alpha_rad.value,
                mach: data.envelope.mach.value,
                altitude: data.envelope.altitude_m.value,
            },
        }
    }
}
