//! Elastic derivatives from the panels, to assess [`ahv::air::strip_theory`].

use super::stream::Stream;
use super::{AirLoads, Attitude, ShockExpansion};
use crate::gas::GasError;
use ahv::air::curve_fits::{Aero, DRAG, Elastic, LIFT, MODAL_FORCE, MOMENT};
use ahv::structure::{Beam, Modes};

/// Modal coordinate (m), and its rate over the speed, of the central differences: bends of 1e-4
/// rad, so that truncation and rounding both stay below 1e-6.
const STEP: f64 = 1e-4;

impl ShockExpansion {
    /// Elastic terms of lift, drag, moment and modal forces around an attitude, in the units of
    /// [`ahv::air::strip_theory::derive`].
    ///
    /// # Errors
    /// [`GasError`] where the flow does not exist.
    pub fn elastic(
        &self,
        ahead: &Stream,
        attitude: &Attitude,
        aero: &Aero,
        beam: &Beam,
        modes: &Modes,
    ) -> Result<Elastic, GasError> {
        let qbar = self.medium.gas.dynamic_pressure(ahead.mach) * ahead.pressure;
        let per_step = 1.0 / (2.0 * STEP * qbar * aero.area);
        let mut elastic = Elastic::default();
        for (k, shape) in modes.shape.iter().enumerate() {
            let slope = |x: f64| -shape.slope_at(&beam.point(x));
            let rate = |x: f64| -shape.w_at(&beam.point(x));
            let both = [&slope as &dyn Fn(f64) -> f64, &rate];
            for (which, incidence) in both.into_iter().enumerate() {
                let at = |step: f64| self.loads(ahead, attitude, &|x| step * incidence(x));
                let (up, down) = (at(STEP)?, at(-STEP)?);
                let change = |f: &dyn Fn(&AirLoads) -> f64| (f(&up) - f(&down)) * per_step;
                let moment = |run: &AirLoads| run.moment(aero.moment_centre, self.moment_height);
                let answers = &mut elastic.per[k][which];
                answers[LIFT] = change(&AirLoads::lift);
                answers[DRAG] = change(&AirLoads::drag);
                answers[MOMENT] = change(&moment) / aero.chord;
                for (i, mode) in modes.shape.iter().enumerate() {
                    let work = |run: &AirLoads| run.generalised(|x| mode.w_at(&beam.point(x)));
                    answers[MODAL_FORCE + i] = change(&work) / modes.modal_mass[i];
                }
            }
        }
        Ok(elastic)
    }
}

/// Rows of [`deviation`].
pub const COMPARED: [&str; 6] =
    ["C_L per eta", "C_M per eta", "N per eta", "C_L per rate", "C_M per rate", "N per rate"];

/// Relative difference of elastic terms: norm of the difference over that of `other`, over the first `modes`; rows
/// as in [`COMPARED`].
pub fn deviation(elastic: &Elastic, other: &Elastic, modes: usize) -> [f64; 6] {
    let terms = |elastic: &Elastic| {
        let of = |first: usize, rows: usize, which: usize| -> Vec<f64> {
            let per = elastic.per[..modes].iter();
            per.flat_map(|per| &per[which][first..first + rows]).copied().collect()
        };
        let three =
            |which| [of(LIFT, 1, which), of(MOMENT, 1, which), of(MODAL_FORCE, modes, which)];
        [three(0), three(1)].concat()
    };
    let (all, others) = (terms(elastic), terms(other));
    std::array::from_fn(|row| {
        let squares = |f: &dyn Fn(f64, f64) -> f64| {
            all[row].iter().zip(&others[row]).map(|(a, b)| f(*a, *b)).sum::<f64>()
        };
        (squares(&|a, b| (a - b) * (a - b)) / squares(&|_, b| b * b)).sqrt()
    })
}
