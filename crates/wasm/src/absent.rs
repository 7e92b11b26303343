//! Functions for what no model has: an empty list of variables is read and set, any other is refused.

use crate::bindings::fmi::fmi3::types::Status;
use crate::calls::Call;
use crate::handle::Handle;
use crate::values::expect_one_each;
use fmi_model::Kind;
use fmi_model::failure::Failure;
use fmi_model::model::Model;

impl<M: Model> Handle<M> {
    /// Reads variables of a type that no variable has.
    pub(crate) fn get_absent<T>(
        &self,
        call: &Call,
        asked: &'static str,
        references: &[u32],
    ) -> Result<Vec<T>, Status> {
        self.ask(call, |_| {
            let refused = references.first().map(|&reference| wrong_type::<M>(reference, asked));
            refused.map_or(Ok(Vec::new()), Err)
        })
    }

    /// Sets so many variables of a type that no variable has.
    pub(crate) fn set_absent(
        &self,
        call: &Call,
        asked: &'static str,
        references: &[u32],
        values: usize,
    ) -> Status {
        self.call(call, |_| {
            expect_one_each("nValues", references, values)?;
            let refused = references.first().map(|&reference| wrong_type::<M>(reference, asked));
            refused.map_or(Ok(()), Err)
        })
    }
}

/// What functions of a capability come to that the model description does not promise.
pub(crate) fn not_provided<T>(says: &'static str) -> Result<T, Failure> {
    Err(Failure::NotProvided { capability: says })
}

fn wrong_type<M: Model>(reference: u32, asked: &'static str) -> Failure {
    let Some(variable) = M::VARIABLES.get(reference as usize) else {
        return Failure::UnknownReference { reference, count: M::VARIABLES.len() };
    };
    let has = match variable.kind {
        Kind::Real(_) => "Float64",
        Kind::Enumeration(..) => "Enumeration (Int64)",
        Kind::Boolean => "Boolean",
    };
    Failure::WrongType { variable: variable.name, reference, asked, has }
}
