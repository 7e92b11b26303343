//! Reading and setting variables of the types that a model can have.

use crate::bindings::fmi::fmi3::types::Status;
use crate::calls;
use crate::handle::Handle;
use fmi_model::failure::{Failure, Outcome};
use fmi_model::model::Model;

/// Value reference of the independent variable, which is in no table.
const TIME: u32 = 2_147_483_647;

impl<M: Model> Handle<M> {
    pub(crate) fn get_float64(&self, references: Vec<u32>) -> Result<Vec<f64>, Status> {
        self.ask(&calls::GET_FLOAT64, |instance| {
            let others: Vec<_> = references.iter().copied().filter(|&other| other != TIME).collect();
            let mut values = Vec::with_capacity(references.len());
            instance.get_real(&others, |_, value| values.push(value))?;
            for (i, _) in references.iter().enumerate().filter(|(_, reference)| **reference == TIME) {
                values.insert(i, instance.time());
            }
            Ok(values)
        })
    }

    pub(crate) fn get_int64(&self, references: Vec<u32>) -> Result<Vec<i64>, Status> {
        self.ask(&calls::GET_INT64, |instance| {
            let mut values = Vec::with_capacity(references.len());
            instance.get_integer(&references, |_, value| values.push(value.into()))?;
            Ok(values)
        })
    }

    pub(crate) fn get_boolean(&self, references: Vec<u32>) -> Result<Vec<bool>, Status> {
        self.ask(&calls::GET_BOOLEAN, |instance| {
            let mut values = Vec::with_capacity(references.len());
            instance.get_boolean(&references, |_, value| values.push(value))?;
            Ok(values)
        })
    }

    pub(crate) fn set_float64(&self, references: Vec<u32>, values: Vec<f64>) -> Status {
        self.call(&calls::SET_FLOAT64, |instance| {
            expect_one_each("nValues", &references, values.len())?;
            instance.set_real(&references, &values)
        })
    }

    pub(crate) fn set_int64(&self, references: Vec<u32>, values: Vec<i64>) -> Status {
        self.call(&calls::SET_INT64, |instance| {
            expect_one_each("nValues", &references, values.len())?;
            // No enumeration has so large a value: the nearest one is refused too.
            let nearest = |&value: &i64| value.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
            let values: Vec<_> = values.iter().map(nearest).collect();
            instance.set_integer(&references, &values)
        })
    }

    pub(crate) fn set_boolean(&self, references: Vec<u32>, values: Vec<bool>) -> Status {
        self.call(&calls::SET_BOOLEAN, |instance| {
            expect_one_each("nValues", &references, values.len())?;
            let values: Vec<_> = values.into_iter().map(i32::from).collect();
            instance.set_boolean(&references, &values)
        })
    }
}

/// Whether there is a value for each reference.
pub(crate) fn expect_one_each<T>(
    argument: &'static str,
    references: &[T],
    count: usize,
) -> Outcome {
    if count == references.len() {
        return Ok(());
    }
    let expected = format!("{} are needed", references.len());
    Err(Failure::Argument { argument, value: count as f64, expected })
}
