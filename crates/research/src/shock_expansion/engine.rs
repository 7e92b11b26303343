//! The engine: inlet shock, diffuser, burner, nozzle, one-dimensional and without friction.
//!
//! The mass of the fuel, at most 3 % of that of the air, is neglected; its heat is not.

use super::stream::{Medium, Stream};
use crate::gas::GasError;
use ahv::data::EngineData;

/// Duct and fuel.
#[derive(Debug, Clone, Copy)]
pub struct Engine {
    /// Height of the duct at inlet and exit, m.
    pub height: f64,
    /// Exit area over burner area.
    pub nozzle_area_ratio: f64,
    /// Heat per mass of air at equivalence ratio 1, J/kg.
    pub heat: f64,
}

impl Engine {
    /// The engine of the data file.
    pub fn new(data: &EngineData) -> Self {
        Self {
            height: data.duct_height_m.value,
            nozzle_area_ratio: data.nozzle_area_ratio.value,
            heat: data.stoichiometric_ratio.value
                * data.combustion_efficiency.value
                * data.heating_value_j_per_kg.value,
        }
    }

    /// The stream in the exit plane.
    ///
    /// `inflow` is the stream along the fore-body, `turn` (rad) brings it parallel to the axis,
    /// `mass_flow` (kg/(s m)) is captured by the lip, `phi` the fuel equivalence ratio. The
    /// diffuser connects the stream behind the inlet shock, whose height follows from the mass flow, to the
    /// burner.
    ///
    /// # Errors
    /// [`GasError`] if the inlet shock is detached, or the diffuser or the burner choked.
    pub fn exhaust(
        &self,
        medium: &Medium,
        inflow: &Stream,
        turn: f64,
        mass_flow: f64,
        phi: f64,
    ) -> Result<Stream, GasError> {
        let inside = medium.turned(inflow, turn)?;
        let height = mass_flow / medium.mass_flux(&inside);
        let burner = self.height / self.nozzle_area_ratio;
        let compressed = medium.through(&inside, burner / height)?;
        let total = compressed.temperature * medium.gas.total_temperature(compressed.mach);
        let rise = 1.0 + phi * self.heat / (medium.heat_capacity() * total);
        let hot = medium.heated(&compressed, rise)?;
        medium.through(&hot, self.nozzle_area_ratio)
    }
}
