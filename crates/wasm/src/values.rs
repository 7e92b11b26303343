//! Reading and setting variables; no variable has most of the types.

use crate::bindings::fmi::fmi3::types::Status;
use crate::handle::Handle;
use fmi_model::failure::{Failure, Outcome};
use fmi_model::model::Model;
use fmi_model::phase::Call;
use fmi_model::values::Type;

impl<M: Model> Handle<M> {
    /// Reads variables of a type.
    pub(crate) fn get(
        &self,
        call: &Call,
        asked: &Type,
        references: &[u32],
    ) -> Result<Vec<f64>, Status> {
        self.ask(call, |instance| {
            let mut values = Vec::with_capacity(references.len());
            instance.get(asked, references, |_, value| values.push(value))?;
            Ok(values)
        })
    }

    /// Sets variables of a type.
    pub(crate) fn set(
        &self,
        call: &Call,
        asked: &Type,
        references: &[u32],
        values: &[f64],
    ) -> Status {
        self.call(call, |instance| {
            expect_one_each("nValues", references, values.len())?;
            instance.set(asked, references, &|i| values[i])
        })
    }
}

/// Whether there is a value for each reference: all variables are scalars.
pub(crate) fn expect_one_each<T>(
    argument: &'static str,
    references: &[T],
    given: usize,
) -> Outcome {
    let needed = references.len();
    if given == needed {
        return Ok(());
    }
    let expected = format!("all variables are scalars, so {needed} values are needed");
    Err(Failure::Argument { argument, value: given as f64, expected })
}
