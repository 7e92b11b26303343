//! Uncertainty: factors on the data of a vehicle.

use crate::data::{AeroData, EarthData, PolynomialData, Quantity, VehicleData};

/// Factors on quantities of the data files, nominally 1, and two offsets, nominally 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Factors {
    /// Densities of the beam, hence mass and propellant; not the pitch inertia.
    pub mass: f64,
    /// Pitch inertia.
    pub inertia: f64,
    /// Density of the air.
    pub density: f64,
    /// C_L without the elevator.
    pub lift: f64,
    /// C_D without the elevator.
    pub drag: f64,
    /// C_M due to incidence.
    pub moment_alpha: f64,
    /// Lift, drag and moment of the elevator.
    pub elevator: f64,
    /// C_T.
    pub thrust: f64,
    /// Aerodynamic response to bending.
    pub elastic: f64,
    /// Bending stiffness EI.
    pub stiffness: f64,
    /// Damping ratios of the structure.
    pub structural_damping: f64,
    /// Added to the mass centre's station, m.
    pub mass_centre_shift_m: f64,
    /// Factor on the terms of strip theory in the pitch rate; eq. (4) has none.
    pub pitch_rate: f64,
}

impl Default for Factors {
    fn default() -> Self {
        Self {
            mass: 1.0,
            inertia: 1.0,
            density: 1.0,
            lift: 1.0,
            drag: 1.0,
            moment_alpha: 1.0,
            elevator: 1.0,
            thrust: 1.0,
            elastic: 1.0,
            stiffness: 1.0,
            structural_damping: 1.0,
            mass_centre_shift_m: 0.0,
            pitch_rate: 0.0,
        }
    }
}

fn scale<'a>(factor: f64, quantities: impl IntoIterator<Item = &'a mut Quantity>) {
    quantities.into_iter().for_each(|quantity| quantity.value *= factor);
}

fn scale_body(factor: f64, fit: &mut PolynomialData) {
    let PolynomialData { constant, alpha, alpha2, alpha3, .. } = fit;
    scale(factor, [constant, alpha, alpha2, alpha3].into_iter().flatten());
}

fn scale_elevator(factor: f64, fit: &mut PolynomialData) {
    let PolynomialData { delta_e, delta_e2, delta_e3, alpha_delta_e, .. } = fit;
    scale(factor, [delta_e, delta_e2, delta_e3, alpha_delta_e].into_iter().flatten());
}

impl Factors {
    /// Vehicle data with these factors.
    pub fn vehicle(&self, data: &VehicleData) -> VehicleData {
        let mut data = data.clone();
        scale(self.mass, [&mut data.mass.fore_beam_kg_per_m2, &mut data.mass.aft_beam_kg_per_m2]);
        data.beam.stiffness_n_m2_per_m.value.iter_mut().for_each(|ei| *ei *= self.stiffness);
        data
    }

    /// Air data with these factors.
    pub fn earth(&self, data: &EarthData) -> EarthData {
        let mut data = data.clone();
        // Density is proportional to pressure at constant temperature.
        scale(self.density, [&mut data.air.sea_level_pressure_pa]);
        data
    }

    /// Coefficient set with these factors.
    pub fn aero(&self, data: &AeroData) -> AeroData {
        let mut data = data.clone();
        scale_body(self.lift, &mut data.lift);
        scale_body(self.drag, &mut data.drag);
        scale(
            self.moment_alpha,
            [&mut data.moment.alpha, &mut data.moment.alpha2].into_iter().flatten(),
        );
        let of_fuel = [(self.lift, &mut data.lift_phi), (self.drag, &mut data.drag_phi)];
        for (factor, fit) in of_fuel {
            fit.iter_mut().for_each(|fit| scale_body(factor, fit));
        }
        for fit in [&mut data.lift, &mut data.drag, &mut data.moment] {
            scale_elevator(self.elevator, fit);
        }
        for fit in [&mut data.thrust, &mut data.thrust_phi] {
            scale_body(self.thrust, fit);
        }
        scale(self.elastic, [&mut data.reference.elastic_scale]);
        scale(self.inertia, [&mut data.inertia.i_yy_kg_m2_per_m]);
        for ratio in &mut data.inertia.structural_damping.value {
            *ratio *= self.structural_damping;
        }
        data
    }
}
