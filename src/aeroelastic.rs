//! Where the elastic terms of eq. (4) come from: local incidence, integrated over the body.
//!
//! No set of flexible coefficients is published, so they follow from the published rigid ones and
//! the mode shapes. The body is cut at the end of the fore-body into two strips of uniform load;
//! the elevator is a third surface, where the published lift and moment per deflection put it.
//! The loads of the two strips are those that give the published lift *and* moment at every
//! incidence, so the rigid body stays exactly as published.
//!
//! A mode changes the local incidence by eps(x) = -phi'(x) eta - phi(x) eta-dot/V (x aft, w up),
//! a pitch rate by q (x - x_cg)/V. Strip and elevator answer with their lift slope at one
//! reference incidence. The pitch rate enters the modal forces only: the published rigid part has
//! no q-derivatives, and eq. (4) has none.

use crate::aero::{Aero, Elastic, ElasticTerm, ModalForce};
use crate::beam::Beam;
use crate::hermite::{Point, Shape};
use crate::modes::Modes;

/// A part of the body that answers to local incidence.
struct Surface {
    /// Places with weights that add up to one.
    points: Vec<Point>,
    /// Lift coefficient as a polynomial in the incidence, of the undeformed body.
    load: [f64; 3],
    /// Its slope at the reference incidence, per rad.
    slope: f64,
}

impl Surface {
    fn mean(&self, f: impl Fn(&Point) -> f64) -> f64 {
        self.points.iter().map(|point| point.weight * f(point)).sum()
    }
}

fn strip(beam: &Beam, [from, to]: [f64; 2], load: [f64; 3], alpha: f64) -> Surface {
    let mut points: Vec<Point> = beam.gauss_points(from, to).collect();
    for point in &mut points {
        point.weight /= to - from;
    }
    Surface { points, load, slope: load[1] + 2.0 * load[2] * alpha }
}

/// The two strips and the elevator.
fn surfaces(aero: &Aero, beam: &Beam, fore_body: f64) -> [Surface; 3] {
    let [elevator_lift, elevator_moment] = [aero.lift.delta_e[0], aero.moment.delta_e[0]];
    let alpha = aero.elastic_alpha;
    // Lift and nose-up moment of the body without the elevator, per power of the incidence.
    let body: [[f64; 2]; 3] = std::array::from_fn(|power| {
        let own = f64::from(power == 1);
        [
            aero.lift.alpha[power] - own * elevator_lift,
            aero.moment.alpha[power] - own * elevator_moment,
        ]
    });
    let ends = [[0.0, fore_body], [fore_body, beam.length_m()]];
    let [fore_arm, aft_arm] = ends.map(|[from, to]| 0.5 * (from + to) - aero.moment_centre);
    // c_1 + c_2 = C_L and -(fore_arm c_1 + aft_arm c_2) = chord C_M.
    let split = body.map(|[lift, moment]| {
        let fore = (lift * aft_arm + moment * aero.chord) / (aft_arm - fore_arm);
        [fore, lift - fore]
    });
    let mut elevator =
        beam.point(aero.moment_centre - aero.chord * elevator_moment / elevator_lift);
    elevator.weight = 1.0;
    [
        strip(beam, ends[0], split.map(|[fore, _]| fore), alpha),
        strip(beam, ends[1], split.map(|[_, aft]| aft), alpha),
        Surface { points: vec![elevator], load: [0.0, elevator_lift, 0.0], slope: elevator_lift },
    ]
}

/// Elastic terms of eq. (4) for the given modes; modal forces are divided by the modal mass.
///
/// `fore_body` (m) is the length of the fore-body, `mass_centre` its station from the nose (m).
pub fn derive(
    aero: &Aero,
    beam: &Beam,
    modes: &Modes,
    fore_body: f64,
    mass_centre: f64,
) -> Elastic {
    let surfaces = surfaces(aero, beam, fore_body);
    let sum = |f: &dyn Fn(&Surface) -> f64| surfaces.iter().map(f).sum::<f64>();
    let arm = |point: &Point| (point.x - aero.moment_centre) / aero.chord;
    let drag_per_lift = aero.drag.slope(aero.elastic_alpha) / aero.lift.slope(aero.elastic_alpha);

    let mut elastic = Elastic::default();
    for (i, shape) in modes.shape.iter().enumerate() {
        elastic.lift.eta[i] = -sum(&|s| s.slope * s.mean(|p| shape.slope_at(p)));
        elastic.lift.rate[i] = -sum(&|s| s.slope * s.mean(|p| shape.w_at(p)));
        elastic.moment.eta[i] = sum(&|s| s.slope * s.mean(|p| arm(p) * shape.slope_at(p)));
        elastic.moment.rate[i] = sum(&|s| s.slope * s.mean(|p| arm(p) * shape.w_at(p)));
        // A strip's drag due to incidence is in the ratio of the whole body's to its lift.
        elastic.drag.eta[i] = drag_per_lift * elastic.lift.eta[i];
        elastic.drag.rate[i] = drag_per_lift * elastic.lift.rate[i];
        // The engine swallows what the fore-body has turned.
        elastic.inflow.eta[i] = -surfaces[0].mean(|p| shape.slope_at(p));
        elastic.inflow.rate[i] = -surfaces[0].mean(|p| shape.w_at(p));
        elastic.force[i] = force(
            &surfaces,
            shape,
            &modes.shape,
            aero.lift.delta_e[0],
            mass_centre,
            modes.modal_mass[i],
        );
    }
    elastic
}

/// Generalised force on one mode, over qbar S and the modal mass.
fn force(
    surfaces: &[Surface; 3],
    shape: &Shape,
    shapes: &[Shape],
    elevator_lift: f64,
    mass_centre: f64,
    modal_mass: f64,
) -> ModalForce {
    let sum = |f: &dyn Fn(&Surface) -> f64| surfaces.iter().map(f).sum::<f64>() / modal_mass;
    let w = |point: &Point| shape.w_at(point);
    let mut elastic = ElasticTerm::default();
    for (k, other) in shapes.iter().enumerate() {
        elastic.eta[k] = -sum(&|s| s.slope * s.mean(|p| w(p) * other.slope_at(p)));
        elastic.rate[k] = -sum(&|s| s.slope * s.mean(|p| w(p) * other.w_at(p)));
    }
    ModalForce {
        alpha: std::array::from_fn(|power| sum(&|s| s.load[power] * s.mean(w))),
        delta_e: elevator_lift * surfaces[2].mean(w) / modal_mass,
        elastic,
        pitch_rate: sum(&|s| s.slope * s.mean(|p| w(p) * (p.x - mass_centre))),
    }
}
