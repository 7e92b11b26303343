//! Elastic terms of eq. (4) by strip theory: local incidence, integrated over the body.
//!
//! No published set of flexible coefficients was found, so they are derived from the rigid-body
//! coefficients and the mode shapes. Two strips of uniform load meet at the end of the fore-body; their
//! loads reproduce the published lift *and* moment at every incidence, so the rigid body stays exactly as
//! published. The elevator is a third surface, at the station given by its published lift and moment.
//!
//! The mean translation and rotation of a mode ([`RigidMotion`]) change the incidence of the whole body
//! in the published fits. Bending, the rest of the mode, changes the local incidence, as does pitch rate:
//!
//! ```text
//! eps(x) = -w'(x) - w-dot(x)/V + q (x - x_cg)/V          x aft, w up
//! ```
//!
//! Strips and elevator respond with their lift slope at one reference incidence.
//!
//! Eq. (4) has no terms in the pitch rate. Those of strip theory, in lift, drag, moment, thrust and modal
//! forces, are multiplied by `pitch_rate`: 0 as printed, 1 for strip theory.
//!
//! The printed N_i lack the thrust. It is included here: its couple z_T T balances the aerodynamic
//! moment, and a modal load with only one of the two would not be in equilibrium.

use super::curve_fits::{
    Aero, DRAG, ELASTIC_ROWS, Elastic, INCIDENCE, INFLOW, LIFT, MODAL_FORCE, MOMENT, PerMode,
};
use crate::data::Geometry;
#[cfg(doc)]
use crate::structure::RigidMotion;
use crate::structure::{Beam, MODES, Modes, Point, Shape};

/// A surface with lift due to local incidence.
struct LiftingSurface {
    /// Lift coefficient of the undeformed body as a polynomial in the incidence.
    load: [f64; 3],
    /// Its slope at the reference incidence, per rad.
    slope: f64,
    /// Averages of the mode shapes.
    mean: SurfaceMeans,
}

/// Averages over a surface of x, mode shapes phi_i, their slopes phi_i', and products.
#[derive(Debug, Clone, Copy, Default)]
struct SurfaceMeans {
    x: f64,
    xx: f64,
    phi: [f64; MODES],
    slope: [f64; MODES],
    x_phi: [f64; MODES],
    x_slope: [f64; MODES],
    phi_phi: [[f64; MODES]; MODES],
    phi_slope: [[f64; MODES]; MODES],
}

impl SurfaceMeans {
    /// Averages over points whose weights add up to `total`; x from the nose.
    fn over(points: impl Iterator<Item = Point>, total: f64, shapes: &[Shape]) -> Self {
        let mut mean = Self::default();
        let (mut phi, mut slope) = ([0.0; MODES], [0.0; MODES]);
        for point in points {
            let (weight, x) = (point.weight / total, point.x);
            for (i, shape) in shapes.iter().enumerate() {
                [phi[i], slope[i]] = shape.at(&point);
            }
            mean.x += weight * x;
            mean.xx += weight * x * x;
            // Zeros of modes that do not exist included: loops of fixed length are unrolled.
            for i in 0..MODES {
                mean.phi[i] += weight * phi[i];
                mean.slope[i] += weight * slope[i];
                mean.x_phi[i] += weight * x * phi[i];
                mean.x_slope[i] += weight * x * slope[i];
                for k in 0..MODES {
                    mean.phi_phi[i][k] += weight * phi[i] * phi[k];
                    mean.phi_slope[i][k] += weight * phi[i] * slope[k];
                }
            }
        }
        mean
    }

    /// The same with x from `centre`.
    fn about(mut self, centre: f64) -> Self {
        self.xx -= centre * (2.0 * self.x - centre);
        self.x -= centre;
        for i in 0..MODES {
            self.x_phi[i] -= centre * self.phi[i];
            self.x_slope[i] -= centre * self.slope[i];
        }
        self
    }
}

/// A distribution of incidence over a surface: its averages with the weights 1, x and each shape.
#[derive(Debug, Clone, Copy, Default)]
struct IncidenceField {
    one: f64,
    x: f64,
    phi: PerMode,
}

impl IncidenceField {
    fn plus(self, factor: f64, other: Self) -> Self {
        Self {
            one: self.one + factor * other.one,
            x: self.x + factor * other.x,
            phi: std::array::from_fn(|i| self.phi[i] + factor * other.phi[i]),
        }
    }
}

impl SurfaceMeans {
    /// 1.
    fn unit(&self) -> IncidenceField {
        IncidenceField { one: 1.0, x: self.x, phi: self.phi }
    }

    /// x.
    fn station(&self) -> IncidenceField {
        IncidenceField { one: self.x, x: self.xx, phi: self.x_phi }
    }

    /// phi_k.
    fn deflection(&self, k: usize) -> IncidenceField {
        IncidenceField { one: self.phi[k], x: self.x_phi[k], phi: self.phi_phi.map(|row| row[k]) }
    }

    /// phi_k'.
    fn slope(&self, k: usize) -> IncidenceField {
        IncidenceField {
            one: self.slope[k],
            x: self.x_slope[k],
            phi: self.phi_slope.map(|row| row[k]),
        }
    }
}

/// Averages over the two strips: everything that needs integration along the beam.
#[derive(Debug, Clone)]
pub struct StripIntegrals {
    fore: SurfaceMeans,
    aft: SurfaceMeans,
    /// Middle of the nacelle.
    engine: Point,
    /// Mean translation and rotation of the body in each mode.
    moved: [[f64; 2]; MODES],
    /// Station of that translation, m from the nose.
    body_centre: f64,
}

impl StripIntegrals {
    /// Strips ahead of and behind the end of the fore-body.
    pub fn new(beam: &Beam, modes: &Modes, geometry: &Geometry) -> Self {
        let cut = geometry.fore_body_m.value;
        let strip =
            |from, to| SurfaceMeans::over(beam.gauss_points(from, to), to - from, &modes.shape);
        let motion = beam.rigid_motion();
        let mut moved = [[0.0; 2]; MODES];
        for (part, shape) in moved.iter_mut().zip(&modes.shape) {
            *part = motion.part(&shape.w, &shape.slope);
        }
        Self {
            fore: strip(0.0, cut),
            aft: strip(cut, beam.length_m()),
            engine: beam.point(cut + 0.5 * geometry.nacelle_m.value),
            moved,
            body_centre: motion.centre_m,
        }
    }
}

/// The two strips and the elevator.
fn surfaces(
    aero: &Aero,
    beam: &Beam,
    shapes: &[Shape],
    strips: &StripIntegrals,
) -> [LiftingSurface; 3] {
    let at = aero.elastic_delta_e;
    let [elevator_lift, elevator_moment] = [LIFT, MOMENT]
        .map(|row| aero.fits.row(row))
        .map(|fit| fit.delta_e[0] + 3.0 * fit.delta_e[2] * at * at);
    // Lift and nose-up moment of the body without the elevator, per power of the incidence.
    let body: [[f64; 2]; 3] = std::array::from_fn(|power| {
        let own = f64::from(power == 1);
        [
            aero.fits.alpha[power][LIFT] - own * elevator_lift,
            aero.fits.alpha[power][MOMENT] - own * elevator_moment,
        ]
    });
    let [fore, aft] = [strips.fore, strips.aft].map(|strip| strip.about(aero.moment_centre));
    // c_1 + c_2 = C_L and -(x_1 c_1 + x_2 c_2) = chord C_M.
    let split = body.map(|[lift, moment]| {
        let first = (lift * aft.x + moment * aero.chord) / (aft.x - fore.x);
        [first, lift - first]
    });
    let mut place = beam.point(aero.moment_centre - aero.chord * elevator_moment / elevator_lift);
    place.weight = 1.0;
    let elevator = SurfaceMeans::over([place].into_iter(), 1.0, shapes).about(aero.moment_centre);

    let surface = |load: [f64; 3], mean: SurfaceMeans| LiftingSurface {
        load,
        slope: load[1] + 2.0 * load[2] * aero.elastic_alpha,
        mean,
    };
    [
        surface(split.map(|[first, _]| first), fore),
        surface(split.map(|[_, second]| second), aft),
        surface([0.0, elevator_lift, 0.0], elevator),
    ]
}

/// Station at which the lift due to fuel acts, m from the nose; none without such lift.
fn plume_station(aero: &Aero) -> Option<f64> {
    let [lift, moment] = [LIFT, MOMENT].map(|row| aero.fits_phi.row(row).body(aero.elastic_alpha));
    // A compiler may execute a division before the condition that guards it.
    let divisor = if lift == 0.0 { 1.0 } else { lift };
    (lift != 0.0).then_some(aero.moment_centre - aero.chord * moment / divisor)
}

/// Elastic terms of eq. (4) for the given modes; modal forces are divided by the modal mass.
///
/// `mass_centre`: station, m from the nose; `pitch_rate`: factor on the terms in the pitch rate.
pub fn elastic_derivatives(
    aero: &Aero,
    beam: &Beam,
    modes: &Modes,
    strips: &StripIntegrals,
    mass_centre: f64,
    pitch_rate: f64,
) -> Elastic {
    let centre = beam.point(mass_centre);
    let plume = plume_station(aero).map(|x| beam.point(x.clamp(0.0, beam.length_m())));
    let surfaces = surfaces(aero, beam, &modes.shape, strips);
    let [drag_slope, lift_slope] =
        [DRAG, LIFT].map(|row| aero.fits.row(row).slope(aero.elastic_alpha, aero.elastic_delta_e));
    let per_mass: PerMode = std::array::from_fn(|i| modes.per_modal_mass(i));
    // Row by row, the response to a distribution of incidence.
    let response = |field: &dyn Fn(&SurfaceMeans) -> IncidenceField| {
        let start = IncidenceField::default();
        let sum = surfaces.iter().fold(start, |sum, s| sum.plus(s.slope, field(&s.mean)));
        let mut rows = [0.0; ELASTIC_ROWS];
        rows[LIFT] = sum.one;
        // Drag slope over lift slope is that of the whole body.
        rows[DRAG] = drag_slope / lift_slope * sum.one;
        rows[MOMENT] = -sum.x / aero.chord;
        // The engine's inflow follows the fore-body.
        rows[INFLOW] = field(&surfaces[0].mean).one;
        for i in 0..MODES {
            rows[MODAL_FORCE + i] = sum.phi[i] * per_mass[i];
        }
        rows
    };

    let mut elastic = Elastic::default();
    let shift = mass_centre - aero.moment_centre;
    elastic.pitch_rate =
        response(&|m| m.station().plus(-shift, m.unit())).map(|row| pitch_rate * row);
    for k in 0..modes.shape.len() {
        let [translation, rotation] = strips.moved[k];
        // Rigid part of the mode at the moment centre.
        let at_centre = translation + rotation * (aero.moment_centre - strips.body_centre);
        let slope_response = response(&|m| m.slope(k).plus(-rotation, m.unit()));
        let deflection_response =
            response(&|m| m.deflection(k).plus(-at_centre, m.unit()).plus(-rotation, m.station()));
        let [per_eta, per_rate] = &mut elastic.per[k];
        *per_eta = slope_response.map(|row| -aero.elastic_scale * row);
        per_eta[INCIDENCE] = -rotation;
        *per_rate = std::array::from_fn(|row| {
            -aero.elastic_scale * deflection_response[row] - rotation * elastic.pitch_rate[row]
        });
        per_rate[INCIDENCE] = -(at_centre + rotation * shift);
    }
    for i in 0..modes.shape.len() {
        let per_mass = per_mass[i];
        let load = |power: usize| {
            surfaces.iter().map(|s| s.load[power] * s.mean.phi[i]).sum::<f64>() * per_mass
        };
        let shape = &modes.shape[i];
        let force = &mut elastic.force;
        for (power, alpha) in force.alpha.iter_mut().enumerate() {
            alpha[i] = load(power);
        }
        force.delta_e[i] = aero.fits.delta_e[0][LIFT] * surfaces[2].mean.phi[i] * per_mass;
        force.thrust_across[i] = shape.w_at(&centre) * per_mass;
        force.plume[i] = plume.map_or(0.0, |place| shape.w_at(&place) * per_mass);
        // A nose-up couple does positive work on a negative slope.
        force.thrust_couple[i] = -aero.thrust_arm * shape.slope_at(&strips.engine) * per_mass;
    }
    elastic
}
