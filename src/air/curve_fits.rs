//! Curve fits of eq. (4).

use super::envelope::Envelope;
use crate::data::{AeroData, PolynomialData};
use crate::solve::Scalar;
use crate::structure::MODES;

/// c0 + c1 a + c2 a^2 + c3 a^3 + d1 d + d2 d^2 + d3 d^3 + e a d, with incidence a and elevator deflection
/// d in rad.
#[derive(Debug, Clone, Copy, Default)]
pub struct Polynomial<C = f64> {
    /// Coefficients of a^0 to a^3.
    pub alpha: [C; 4],
    /// Coefficients of d to d^3.
    pub delta_e: [C; 3],
    /// Coefficient of a d.
    pub cross: C,
}

/// Row of [`Aero::fits`] and of [`Elastic::per`]: C_L.
pub const LIFT: usize = 0;
/// Row of both: C_D.
pub const DRAG: usize = 1;
/// Row of both: C_M about the moment centre, without thrust.
pub const MOMENT: usize = 2;
/// Row of [`Aero::fits`]: C_T, a function of the incidence of the engine's inflow.
pub const THRUST: usize = 3;
/// Rows of [`Aero::fits`].
pub const FITS: usize = 4;

/// One polynomial per row, coefficient by coefficient, for vector instructions.
pub type Fits = Polynomial<[f64; FITS]>;

impl Polynomial {
    fn new(data: &PolynomialData) -> Self {
        let value = |entry: &Option<crate::data::Quantity>| entry.as_ref().map_or(0.0, |q| q.value);
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

    /// The terms without elevator deflection.
    #[inline(always)]
    pub fn body<S: Scalar>(&self, alpha: S) -> S {
        let [c0, c1, c2, c3] = self.alpha;
        ((alpha * c3 + c2) * alpha + c1) * alpha + c0
    }

    /// The polynomial.
    #[inline(always)]
    pub fn at<S: Scalar>(&self, alpha: S, delta_e: S) -> S {
        let [d1, d2, d3] = self.delta_e;
        self.body(alpha) + ((delta_e * d3 + d2) * delta_e + alpha * self.cross + d1) * delta_e
    }

    /// d/da of the polynomial, per rad.
    pub fn slope(&self, alpha: f64, delta_e: f64) -> f64 {
        let [_, c1, c2, c3] = self.alpha;
        (3.0 * c3 * alpha + 2.0 * c2) * alpha + c1 + self.cross * delta_e
    }
}

impl Fits {
    fn of(rows: [Polynomial; FITS]) -> Self {
        Self {
            alpha: std::array::from_fn(|power| rows.map(|row| row.alpha[power])),
            delta_e: std::array::from_fn(|power| rows.map(|row| row.delta_e[power])),
            cross: rows.map(|row| row.cross),
        }
    }

    /// The polynomial of a row.
    #[inline(always)]
    pub fn row(&self, row: usize) -> Polynomial {
        Polynomial {
            alpha: self.alpha.map(|power| power[row]),
            delta_e: self.delta_e.map(|power| power[row]),
            cross: self.cross[row],
        }
    }
}

/// One number for each mode, flexible modes first, then slosh modes.
pub type PerMode<C = f64> = [C; MODES];

/// Generalised forces on the modes, divided by the modal mass: aerodynamic terms per qbar S, thrust terms
/// per thrust. Mode shapes are dimensionless.
#[derive(Debug, Clone, Copy, Default)]
pub struct ModalForces<C = f64> {
    /// N^0, N^alpha, N^alpha2: load of the rigid body, polynomial in the incidence.
    pub alpha: [PerMode<C>; 3],
    /// N^delta_e, per rad of [`Aero::elevator_bend`]'s effective deflection.
    pub delta_e: PerMode<C>,
    /// Force of the plume's lift, per C_L,phi phi.
    pub plume: PerMode<C>,
    /// Force of the thrust normal to the flight path, T sin alpha, at the mass centre.
    pub thrust_across: PerMode<C>,
    /// Force of the thrust's couple, T z_T, at the nacelle.
    pub thrust_couple: PerMode<C>,
}

/// Row of [`Elastic::per`]: incidence of the engine's inflow relative to that of the body, rad.
pub const INFLOW: usize = THRUST;
/// Row of [`Elastic::per`]: N_i of the first mode; the other modes follow.
pub const MODAL_FORCE: usize = FITS;
/// Row of [`Elastic::per`]: incidence of the body, rad.
pub const INCIDENCE: usize = MODAL_FORCE + MODES;
/// Rows of [`Elastic::per`].
pub const ELASTIC_ROWS: usize = INCIDENCE + 1;

/// Elastic terms of eq. (4) for one set of modes.
#[derive(Debug, Clone, Copy, Default)]
pub struct Elastic<C = f64> {
    /// Derivatives with respect to eta, per m, and to eta-dot/V of each mode. Rows: C_L, C_D, C_M about
    /// the moment centre, incidence of the engine's inflow relative to that of the body, N_i per qbar S
    /// and modal mass (1/kg), incidence of the body.
    pub per: [[[C; ELASTIC_ROWS]; 2]; MODES],
    /// Derivatives with respect to q/V, m; the same rows.
    pub pitch_rate: [C; ELASTIC_ROWS],
    /// Terms of N_i without eta, eta-dot and q.
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
    /// Factor on the derivatives with respect to bending.
    pub elastic_scale: f64,
    /// Elevator deflection of the elastic derivatives, rad.
    pub elastic_delta_e: f64,
    /// C_L, C_D, C_M and C_T without fuel.
    pub fits: Fits,
    /// Derivatives of `fits` with respect to the fuel equivalence ratio.
    pub fits_phi: Fits,
    /// Ratio k of the cubic to the linear term of the elevator's lift, 1/rad^2: the effective deflection is
    /// delta_e + k delta_e^3.
    pub elevator_bend: f64,
    /// Range of validity.
    pub envelope: Envelope,
}

impl Aero {
    /// From a data file.
    pub fn new(data: &AeroData) -> Self {
        let optional = |fit: &Option<PolynomialData>| {
            fit.as_ref().map_or_else(Polynomial::default, Polynomial::new)
        };
        let fits = [&data.lift, &data.drag, &data.moment, &data.thrust].map(Polynomial::new);
        let fits = Fits::of(fits);
        let [d1, _, d3] = fits.row(LIFT).delta_e;
        Self {
            area: data.reference.area_m2_per_m.value,
            chord: data.reference.chord_m.value,
            moment_centre: data.reference.moment_centre_m.value,
            thrust_arm: data.reference.thrust_arm_m.value,
            elastic_alpha: data.reference.elastic_alpha_rad.value,
            elastic_scale: data.reference.elastic_scale.value,
            elastic_delta_e: data.reference.elastic_delta_e_rad.as_ref().map_or(0.0, |q| q.value),
            fits,
            fits_phi: Fits::of([
                optional(&data.lift_phi),
                optional(&data.drag_phi),
                optional(&data.moment_phi),
                Polynomial::new(&data.thrust_phi),
            ]),
            elevator_bend: d3 / if d3 == 0.0 { 1.0 } else { d1 },
            envelope: Envelope {
                alpha: data.envelope.alpha_rad.value,
                mach: data.envelope.mach.value,
                altitude: data.envelope.altitude_m.value,
                choking_margin: data.envelope.choking_margin.as_ref().map(|q| q.value),
            },
        }
    }
}
