//! Directional derivatives, derivatives of inputs and outputs.

use crate::bindings::fmi::fmi3::types::Status;
use crate::handle::Handle;
use crate::values::expect_one_each;
use fmi_model::instance::Interface;
use fmi_model::model::Model;
use fmi_model::phase::Call;
use fmi_model::v3::calls;

/// The interface has this function, although FMI 3.0 has none of the kind.
const SET_INPUT_DERIVATIVES: Call = Call {
    name: "set-input-derivatives",
    interface: Some(Interface::CoSimulation),
    ..calls::SET_FLOAT64
};

/// Value references and orders; an order that no `i32` holds is refused like the largest one.
fn split(requests: &[(u32, u32)]) -> (Vec<u32>, Vec<i32>) {
    let order = |order: u32| i32::try_from(order).unwrap_or(i32::MAX);
    requests.iter().map(|&(reference, nth)| (reference, order(nth))).unzip()
}

impl<M: Model> Handle<M> {
    pub(crate) fn get_directional_derivative(
        &self,
        unknowns: Vec<u32>,
        knowns: Vec<u32>,
        seed: Vec<f64>,
    ) -> Result<Vec<f64>, Status> {
        self.ask(&calls::GET_DIRECTIONAL_DERIVATIVE, |instance| {
            expect_one_each("nSeed", &knowns, seed.len())?;
            let mut changes = Vec::with_capacity(unknowns.len());
            instance.directional_derivative(&unknowns, &knowns, &seed, |_, change| {
                changes.push(change);
            })?;
            Ok(changes)
        })
    }

    pub(crate) fn get_adjoint_derivative(
        &self,
        unknowns: Vec<u32>,
        knowns: Vec<u32>,
        seed: Vec<f64>,
    ) -> Result<Vec<f64>, Status> {
        self.ask(&calls::GET_ADJOINT_DERIVATIVE, |instance| {
            expect_one_each("nSeed", &unknowns, seed.len())?;
            let mut sums = Vec::with_capacity(knowns.len());
            instance.adjoint_derivative(&unknowns, &knowns, &seed, |_, sum| sums.push(sum))?;
            Ok(sums)
        })
    }

    pub(crate) fn set_input_derivatives(
        &self,
        requests: Vec<(u32, u32)>,
        values: Vec<f64>,
    ) -> Status {
        self.call(&SET_INPUT_DERIVATIVES, |instance| {
            expect_one_each("nValues", &requests, values.len())?;
            let (inputs, orders) = split(&requests);
            instance.set_input_derivatives(&inputs, &orders, &values)
        })
    }

    pub(crate) fn get_output_derivatives(
        &self,
        requests: Vec<(u32, u32)>,
    ) -> Result<Vec<f64>, Status> {
        self.ask(&calls::GET_OUTPUT_DERIVATIVES, |instance| {
            let (outputs, orders) = split(&requests);
            let mut rates = Vec::with_capacity(outputs.len());
            instance.output_derivatives(&outputs, &orders, |_, rate| rates.push(rate))?;
            Ok(rates)
        })
    }
}
