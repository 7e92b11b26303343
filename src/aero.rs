//! Run-time curve fits: eq. (4).

use crate::envelope::Envelope;
use crate::modes::MODES;
use crate::params::{AeroData, PolynomialData};
use crate::scalar::Scalar;

/// c0 + c1 a + c2 a^2 + c3 a^3 + d1 d + d2 d^2 in incidence a and elevator deflection d, rad.
#[derive(Debug, Clone, Copy, Default)]
pub struct Polynomial {
    /// Coefficients of a^0 to a^3.
    pub alpha: [f64; 4],
    /// Coefficients of d and d^2.
    pub delta_e: [f64; 2],
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
            delta_e: [value(&data.delta_e), value(&data.delta_e2)],
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
        let [d1, d2] = self.delta_e;
        self.body(alpha) + (delta_e * d2 + d1) * delta_e
    }

    /// d/da of the body part, per rad.
    pub fn slope(&self, alpha: f64) -> f64 {
        let [_, c1, c2, c3] = self.alpha;
        (3.0 * c3 * alpha + 2.0 * c2) * alpha + c1
    }
}

/// How one coefficient answers the modal coordinates: per metre of eta, and per metre of
/// eta-dot over V. Flexible modes first, then slosh modes.
#[derive(Debug, Clone, Copy, Default)]
pub struct ElasticTerm {
    /// d/d eta, 1/m.
    pub eta: [f64; MODES],
    /// d/d(eta-dot/V), 1/m.
    pub rate: [f64; MODES],
}

/// Generalised aerodynamic force of one mode over qbar S, m (mode shapes are dimensionless).
#[derive(Debug, Clone, Copy, Default)]
pub struct ModalForce {
    /// N^0, N^alpha, N^alpha2: the rigid body's load, as a polynomial in the incidence.
    pub alpha: [f64; 3],
    /// N^delta_e, per rad.
    pub delta_e: f64,
    /// N^eta and its rate term.
    pub elastic: ElasticTerm,
    /// Per q/V, m.
    pub pitch_rate: f64,
}

/// Elastic terms of eq. (4) for one set of modes.
#[derive(Debug, Clone, Copy, Default)]
pub struct Elastic {
    /// C_L^eta.
    pub lift: ElasticTerm,
    /// C_D^eta.
    pub drag: ElasticTerm,
    /// C_M^eta about the moment centre.
    pub moment: ElasticTerm,
    /// Incidence of the engine's inflow, rad.
    pub inflow: ElasticTerm,
    /// N_i.
    pub force: [ModalForce; MODES],
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
    /// Where all this holds.
    pub envelope: Envelope,
}

impl Aero {
    /// The run-time form of a data file.
    pub fn new(data: &AeroData) -> Self {
        Self {
            area: data.reference.area_m2_per_m.value,
            chord: data.reference.chord_m.value,
            moment_centre: data.reference.moment_centre_m.value,
            thrust_arm: data.reference.thrust_arm_m.value,
            elastic_alpha: data.reference.elastic_alpha_rad.value,
            elastic_scale: data.reference.elastic_scale.value,
            lift: Polynomial::new(&data.lift),
            drag: Polynomial::new(&data.drag),
            moment: Polynomial::new(&data.moment),
            thrust: Polynomial::new(&data.thrust),
            thrust_phi: Polynomial::new(&data.thrust_phi),
            envelope: Envelope {
                alpha: data.envelope.alpha_rad.value,
                mach: data.envelope.mach.value,
                altitude: data.envelope.altitude_m.value,
            },
        }
    }
}
