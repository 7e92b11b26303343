//! Reading and setting variables: a call with several references does all or nothing.

use crate::dynamics::{STATES, State};
use crate::flight::{INPUT_ORDER, INPUTS};
use crate::fmi::failure::{Failure, Outcome};
use crate::fmi::instance::Instance;
use crate::fmi::lifecycle::Phase;
use crate::variables::{Kind, Role, TABLE, Variable};

/// Highest derivative of an output: `maxOutputDerivativeOrder`.
pub const OUTPUT_ORDER: usize = 1;

/// The standard's names of the types of values.
const REAL: &str = "Real";
const INTEGER: &str = "Integer or Enumeration";
const BOOLEAN: &str = "Boolean";
const STRING: &str = "String";

fn type_of(variable: &Variable) -> &'static str {
    match variable.kind {
        Kind::Real(_) => REAL,
        Kind::Enumeration(..) => INTEGER,
        Kind::Boolean => BOOLEAN,
    }
}

/// The variable behind a value reference, if it is of the type asked for.
fn variable(reference: u32, asked: &'static str) -> Result<&'static Variable, Failure> {
    let Some(variable) = TABLE.get(reference as usize) else {
        return Err(Failure::UnknownReference { reference, last: TABLE.len() - 1 });
    };
    let has = type_of(variable);
    if has == asked {
        Ok(variable)
    } else {
        Err(Failure::WrongType { variable: variable.name, reference, asked, has })
    }
}

impl Instance {
    /// `fmi2GetReal`; `write` gets the position in the array and the value.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`]; [`Failure::Model`] if the model
    /// cannot be evaluated, [`Failure::NotFinite`]. No value is written then.
    pub fn get_real(&mut self, references: &[u32], write: impl FnMut(usize, f64)) -> Outcome {
        self.read(references, REAL, write)
    }

    /// `fmi2GetInteger`, also for enumerations.
    ///
    /// # Errors
    /// Those of [`Instance::get_real`].
    pub fn get_integer(
        &mut self,
        references: &[u32],
        mut write: impl FnMut(usize, i32),
    ) -> Outcome {
        self.read(references, INTEGER, |i, value| write(i, value as i32))
    }

    /// `fmi2GetBoolean`.
    ///
    /// # Errors
    /// Those of [`Instance::get_real`].
    pub fn get_boolean(
        &mut self,
        references: &[u32],
        mut write: impl FnMut(usize, bool),
    ) -> Outcome {
        self.read(references, BOOLEAN, |i, value| write(i, value != 0.0))
    }

    /// `fmi2GetString` and `fmi2SetString`: there are no such variables.
    ///
    /// # Errors
    /// Those of [`Instance::get_real`].
    pub fn strings(&self, references: &[u32]) -> Outcome {
        references.iter().try_for_each(|&reference| variable(reference, STRING).map(drop))
    }

    /// Outputs are computed when read, so they fit inputs set since the last step. The standard
    /// forbids masters to ask for that in co-simulation; some do, and consistent values harm nobody.
    fn read(
        &mut self,
        references: &[u32],
        asked: &'static str,
        mut write: impl FnMut(usize, f64),
    ) -> Outcome {
        let mut computed = false;
        for &reference in references {
            let role = variable(reference, asked)?.role;
            computed |= !matches!(role, Role::Input(_) | Role::Parameter);
        }
        if computed {
            self.flight.evaluate()?;
        }
        for &reference in references {
            let variable = variable(reference, asked)?;
            let value = variable.get(&self.flight);
            if !value.is_finite() {
                return Err(Failure::NotFinite { variable: variable.name, value });
            }
        }
        for (i, &reference) in references.iter().enumerate() {
            write(i, variable(reference, asked)?.get(&self.flight));
        }
        Ok(())
    }

    /// `fmi2SetReal`.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`], [`Failure::TooLate`];
    /// [`Failure::Model`] if a value is refused. No value is set then.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Outcome {
        self.write(references, REAL, |i| values[i])
    }

    /// `fmi2SetInteger`, also for enumerations.
    ///
    /// # Errors
    /// Those of [`Instance::set_real`].
    pub fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Outcome {
        self.write(references, INTEGER, |i| values[i].into())
    }

    /// `fmi2SetBoolean`.
    ///
    /// # Errors
    /// Those of [`Instance::set_real`].
    pub fn set_boolean(&mut self, references: &[u32], values: &[i32]) -> Outcome {
        self.write(references, BOOLEAN, |i| values[i].into())
    }

    /// Inputs are accepted before initialisation too: the standard says no, but several masters set
    /// all start values there.
    fn write(
        &mut self,
        references: &[u32],
        asked: &'static str,
        value: impl Fn(usize) -> f64,
    ) -> Outcome {
        let before = matches!(self.phase(), Phase::Instantiated | Phase::InitializationMode);
        for (i, &reference) in references.iter().enumerate() {
            let variable = variable(reference, asked)?;
            if variable.role == Role::Parameter && !before {
                return Err(Failure::TooLate { variable: variable.name, value: value(i) });
            }
            variable.check(value(i))?;
        }
        for (i, &reference) in references.iter().enumerate() {
            variable(reference, asked)?.set(&mut self.flight, value(i))?;
        }
        self.say_limit("fmi2SetReal");
        Ok(())
    }

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
            if !change.is_finite() {
                return Err(Failure::Seed { variable: known.name, value: change });
            }
            match known.role {
                Role::OutputState(i) | Role::LocalState(i) => state[i] += change,
                Role::Input(i) => input[i] += change,
                _ => return Err(no_derivative(known, "as known: states and inputs are")),
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
                return Err(no_derivative(unknown, "as unknown: states, outputs and rates are"));
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
                return Err(no_derivative(variable, "with a derivative: inputs are"));
            };
            if !value.is_finite() {
                return Err(Failure::Seed { variable: variable.name, value });
            }
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
                return Err(no_derivative(output, "with a derivative: outputs are"));
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

fn no_derivative(variable: &Variable, served: &'static str) -> Failure {
    Failure::NoDerivative { variable: variable.name, served }
}

/// An order of derivation, if it is served.
fn order(variable: &Variable, asked: i32, highest: usize) -> Result<usize, Failure> {
    let refused = Failure::Order { variable: variable.name, order: asked, highest };
    usize::try_from(asked).ok().filter(|order| (1..=highest).contains(order)).ok_or(refused)
}
