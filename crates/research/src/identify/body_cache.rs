//! Cache of bodies. Of a coefficient set only inertia and mass centre change the structure, whose modes take most
//! of the time.

use ahv::data::Inertia;
use ahv::error::Error;
use ahv::vehicle::{Body, Configuration, VehicleDefinition};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Enough for a Jacobian: three columns, at a point and steps to both sides in two numbers.
const KEPT: usize = 16;

/// Configuration, and bit patterns of inertia and mass centre.
type Key = (Configuration, u64, Option<u64>);

/// The latest bodies. All vehicles must agree in everything else that determines the structure.
#[derive(Default)]
pub struct BodyCache(Mutex<VecDeque<(Key, Arc<Body>)>>);

impl BodyCache {
    /// The body, from the cache or by [`Body::new`].
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
