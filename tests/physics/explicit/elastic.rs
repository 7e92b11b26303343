//! Short period of the bending body: `M u'' + C u' + K u = 0` over all nodes, with the air in C and K.
//!
//! Speed and altitude are held, which moves a pole by the square of the phugoid's frequency over its own:
//! 1e-4. Incidence, its local changes and the surfaces they act on are those of `src/air/strip_theory.rs`,
//! here as distributed loads on the nodes.

use super::air::{fit, fit_phi, real, surfaces};
use super::beam::{Beam, Place};
use super::flight::Explicit;
use ahv::data::{AeroData, VehicleData};
use nalgebra::{DMatrix, DVector};

pub struct Elastic {
    mass: DMatrix<f64>,
    damping: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    /// Pitch.
    start: DVector<f64>,
}

/// What depends on displacements and their rates.
#[derive(Clone)]
struct Row([DVector<f64>; 2]);

impl Row {
    fn plus(&self, factor: f64, other: &Self) -> Self {
        Self([0, 1].map(|k| &self.0[k] + &other.0[k] * factor))
    }
}

const STEP: f64 = 1e-30;
/// Steps of inverse iteration.
const FIXED: usize = 3;
/// Steps that move the pole; they converge quadratically.
const MOVED: usize = 4;

impl Elastic {
    /// About steady flight at an incidence of the body with its controls.
    pub fn new(
        explicit: &Explicit,
        beam: &Beam,
        (data, set): (&VehicleData, &AeroData),
        [alpha, delta_e, phi]: [f64; 3],
        pitch_rate: f64,
    ) -> Self {
        let (speed, force) = explicit.dynamic_force(set);
        let (centre, reference) = (explicit.books.total.centre, &set.reference);
        let about = reference.moment_centre_m.value;
        let none = || DVector::zeros(beam.unknowns());
        let (h, r) = (&beam.heave, &beam.turn);
        let at_centre = h + r * (centre - beam.centre);
        // Pitch is nose up, slope nose down.
        let incidence = Row([-r.clone(), -at_centre / speed]);
        let q = Row([none(), -r.clone()]);
        let local = |place: &Place| {
            let bent = &place.slope - r;
            let bending = &place.w - h - r * (place.x - beam.centre);
            let scale = -reference.elastic_scale.value;
            let row = Row([bent * scale, bending * (scale / speed)]);
            row.plus(pitch_rate * (place.x - centre) / speed, &q)
        };

        let [mut stiffness, mut damping] = beam.springs();
        // A load on the displacement `on`, in the air of `row`.
        let mut load = |on: &DVector<f64>, row: &Row, factor: f64| {
            stiffness.ger(-factor, on, &row.0[0], 1.0);
            damping.ger(-factor, on, &row.0[1], 1.0);
        };
        for surface in surfaces(data, set) {
            let length = if surface.to > surface.from { surface.to - surface.from } else { 1.0 };
            let slope = surface.load[1] + 2.0 * surface.load[2] * alpha;
            for place in beam.places(surface.from, surface.to) {
                let share = force * place.weight / length;
                load(&place.w, &incidence, share * slope);
                load(&place.w, &local(&place), share * surface.slope);
            }
        }
        // Drag across the body and what fuel adds act at the moment centre.
        let by_alpha = |f: &dyn Fn(nalgebra::Complex<f64>) -> nalgebra::Complex<f64>| {
            f(nalgebra::Complex::new(alpha, STEP)).im / STEP
        };
        let (delta_e, fuel, zero) = (real(delta_e), real(phi), real(0.0));
        let across = by_alpha(&|a| {
            (fit(&set.drag, a, delta_e) + fuel * fit_phi(&set.drag_phi, a)) * a.sin()
                + fuel * fit_phi(&set.lift_phi, a)
        });
        let couple = by_alpha(&|a| fuel * fit_phi(&set.moment_phi, a)) * reference.chord_m.value;
        let thrust =
            by_alpha(&|a| fit(&set.thrust, a, zero) + fuel * fit(&set.thrust_phi, a, zero));
        let at = beam.place(about, 0.0);
        load(&at.w, &incidence, force * across);
        load(&at.slope, &incidence, -force * couple);
        // The thrust's couple turns the nacelle; the engine swallows what the fore-body has turned.
        let cut = data.geometry.fore_body_m.value;
        let mut inflow = incidence.clone();
        for place in beam.places(0.0, cut) {
            inflow = inflow.plus(place.weight / cut, &local(&place));
        }
        let nacelle = beam.place(cut + 0.5 * data.geometry.nacelle_m.value, 0.0);
        load(&nacelle.slope, &inflow, -force * thrust * reference.thrust_arm_m.value);
        Self { mass: beam.mass(), damping, stiffness, start: beam.rigid(0.0, 1.0, centre) }
    }

    /// The pole next to a real start, by successive linear problems; the first of them find its shape.
    pub fn pole(&self, start: f64) -> f64 {
        let mut pole = start;
        let mut shape = self.start.clone();
        for step in 0..FIXED + MOVED {
            let matrix = &self.mass * (pole * pole) + &self.damping * pole + &self.stiffness;
            let slope = &self.mass * (2.0 * pole) + &self.damping;
            let next = matrix.lu().solve(&(slope * &shape)).expect("not a pole to the last digit");
            let largest = next.iamax();
            // At a pole's shape: shape = (pole - nearest pole) next.
            if step >= FIXED {
                pole -= shape[largest] / next[largest];
            }
            shape = &next / next[largest];
        }
        pole
    }
}
