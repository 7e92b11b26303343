//! Derivatives: of everything by states and inputs, of inputs within a step, of outputs by time.

use crate::flight::{INPUT_ORDER, INPUTS};
use crate::fmi::failure::{Failure, Outcome};
use crate::fmi::instance::{Instance, LARGEST};
use crate::fmi::values::{REAL, variable};
use crate::variables::{Role, Variable};
use crate::vehicle::{STATES, State};

/// Highest derivative of an output: `maxOutputDerivativeOrder`.
pub const OUTPUT_ORDER: usize = 1;

impl Instance {
    /// `fmi2GetDirectionalDerivative`: changes of `unknowns` for the changes `seed` of `knowns`.
    ///
    /// Unknowns are states, outputs and derivatives; knowns are states and inputs. Exact, by dual
    /// numbers; a reference that stands twice among the knowns counts twice.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`], [`Failure::NoDerivative`],
    /// [`Failure::Seed`]; [`Failure::Model`] if the model cannot be evaluated,
    /// [`Failure::NotFinite`]. No value is written then.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        write: impl FnMut(usize, f64),
    ) -> Outcome {
        let (mut state, mut input) = ([0.0; STATES], [0.0; INPUTS]);
        for (&reference, &change) in knowns.iter().zip(seed) {
            let known = variable(reference, REAL)?;
            check_change(known, change)?;
            match known.role {
                Role::OutputState(i) | Role::LocalState(i) => state[i] += change,
                Role::Input(i) => input[i] += change,
                _ => {
                    return Err(no_derivative(
                        known,
                        "cannot be a known: only states and inputs can",
                    ));
                }
            }
        }
        self.tangent(unknowns, &state, &input, write)
    }

    /// Hands out what changes along a change of state and inputs.
    fn tangent(
        &mut self,
        unknowns: &[u32],
        state: &State,
        input: &[f64; INPUTS],
        mut write: impl FnMut(usize, f64),
    ) -> Outcome {
        if unknowns.is_empty() {
            return Ok(());
        }
        for &reference in unknowns {
            let unknown = variable(reference, REAL)?;
            if matches!(unknown.role, Role::Input(_) | Role::Parameter | Role::Calculated) {
                return Err(no_derivative(
                    unknown,
                    "cannot be an unknown: only states, outputs and rates can",
                ));
            }
        }
        let tangent = self.flight.tangent(state, input)?;
        for &reference in unknowns {
            let unknown = variable(reference, REAL)?;
            let value = unknown.get(&tangent);
            if !value.is_finite() {
                return Err(Failure::NotFinite { variable: unknown.name, value });
            }
        }
        for (i, &reference) in unknowns.iter().enumerate() {
            write(i, variable(reference, REAL)?.get(&tangent));
        }
        Ok(())
    }

    /// `fmi2SetRealInputDerivatives`: how the inputs go on from their present values within the next
    /// step, and only there. It may come before or after `fmi2SetReal`.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`], [`Failure::NoDerivative`],
    /// [`Failure::Order`], [`Failure::Seed`]. No derivative is set then.
    pub fn set_input_derivatives(
        &mut self,
        inputs: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Outcome {
        let triple = |i: usize| {
            let (variable, value) = (variable(inputs[i], REAL)?, values[i]);
            let Role::Input(input) = variable.role else {
                return Err(no_derivative(
                    variable,
                    "cannot be given a derivative: only inputs can",
                ));
            };
            check_change(variable, value)?;
            Ok((input, order(variable, orders[i], INPUT_ORDER)?, value))
        };
        for i in 0..inputs.len() {
            triple(i)?;
        }
        for i in 0..inputs.len() {
            let (input, order, value) = triple(i)?;
            self.flight.set_input_derivative(input, order, value);
        }
        Ok(())
    }

    /// `fmi2GetRealOutputDerivatives`: first derivatives by time, exact; inputs go on as they moved at
    /// the end of the last step.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`], [`Failure::NoDerivative`],
    /// [`Failure::Order`]; [`Failure::Model`] if the model cannot be evaluated,
    /// [`Failure::NotFinite`]. No value is written then.
    pub fn output_derivatives(
        &mut self,
        outputs: &[u32],
        orders: &[i32],
        mut write: impl FnMut(usize, f64),
    ) -> Outcome {
        if outputs.is_empty() {
            return Ok(());
        }
        let rates = self.flight.rates()?;
        for (&reference, &asked) in outputs.iter().zip(orders) {
            let output = variable(reference, REAL)?;
            if !matches!(output.role, Role::Output | Role::OutputState(_)) {
                return Err(no_derivative(output, "has no derivative: only outputs have"));
            }
            order(output, asked, OUTPUT_ORDER)?;
            let value = output.get(&rates);
            if !value.is_finite() {
                return Err(Failure::NotFinite { variable: output.name, value });
            }
        }
        for (i, &reference) in outputs.iter().enumerate() {
            write(i, variable(reference, REAL)?.get(&rates));
        }
        Ok(())
    }
}

/// Whether a variable can change by so much.
fn check_change(variable: &Variable, value: f64) -> Outcome {
    let refused = Failure::Seed { variable: variable.name, value };
    (value.abs() <= LARGEST).then_some(()).ok_or(refused)
}

fn no_derivative(variable: &Variable, served: &'static str) -> Failure {
    Failure::NoDerivative { variable: variable.name, served }
}

/// An order of derivation, if it is served.
fn order(variable: &Variable, asked: i32, highest: usize) -> Result<usize, Failure> {
    let refused = Failure::Order { variable: variable.name, order: asked, highest };
    usize::try_from(asked).ok().filter(|order| (1..=highest).contains(order)).ok_or(refused)
}
