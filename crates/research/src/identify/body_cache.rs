//! BodyCache by what an identification may move of them: of the numbers of a coefficient set only inertia
//! and mass centre change the structure, and its modes cost more than all the rest.

use ahv::data::Inertia;
use ahv::error::Error;
use ahv::vehicle::{Body, Configuration, VehicleDefinition};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Enough for a Jacobian: three columns, at a point and a step to either side in two numbers.
const KEPT: usize = 16;

/// Configuration, and the bits of inertia and mass centre.
type Key = (Configuration, u64, Option<u64>);

/// The latest bodies. All builds must agree in everything else that shapes a structure.
#[derive(Default)]
pub struct BodyCache(Mutex<VecDeque<(Key, Arc<Body>)>>);

impl BodyCache {
    /// [`Body::new`], unless it is known.
    pub fn of(&self, definition: &VehicleDefinition) -> Result<Arc<Body>, Error> {
        let Inertia { i_yy_kg_m2_per_m, mass_centre_shift_m, .. } = &definition.aero.inertia;
        let shift = mass_centre_shift_m.as_ref().map(|shift| shift.value.to_bits());
        let key = (definition.options.configuration, i_yy_kg_m2_per_m.value.to_bits(), shift);
        let latest = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, body)) = latest().iter().find(|(known, _)| *known == key) {
            return Ok(body.clone());
        }
        let body = Arc::new(Body::new(definition)?);
        let mut latest = latest();
        latest.truncate(KEPT - 1);
        latest.push_front((key, body.clone()));
        Ok(body)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ahv::data::Data;
    use ahv::flight::Parameters;

    #[test]
    fn a_body_is_that_of_its_inertia_and_mass_centre() {
        let data = Data::embedded().unwrap();
        let bodies = BodyCache::default();
        let mut definition = VehicleDefinition::new(&data, &Parameters::new(&data).options);
        for _ in 0..2 * KEPT {
            let fresh = Body::new(&definition).unwrap();
            for _ in 0..2 {
                let body = bodies.of(&definition).unwrap();
                assert_eq!(body.displacements(), fresh.displacements());
                assert_eq!(body.properties, fresh.properties);
            }
            definition.aero.inertia.i_yy_kg_m2_per_m.value *= 1.001;
            definition.aero.inertia.mass_centre_shift_m.as_mut().unwrap().value += 0.01;
        }
        assert_eq!(bodies.0.lock().unwrap().len(), KEPT);
    }
}
