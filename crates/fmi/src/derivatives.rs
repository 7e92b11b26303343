//! Derivatives: of everything by states and inputs, of inputs within a step, of outputs by time.

use crate::failure::{Failure, Outcome};
use crate::instance::{Instance, LARGEST};
use crate::model::{InputDerivatives, Model, Simulation, Tangent};
use crate::table::{self, MOST_KNOWNS};
use crate::values::{REAL, variable};
use crate::variable::{Role, SampleOf, Variable};

/// Highest derivative of an output, of a model with directional derivatives:
/// `maxOutputDerivativeOrder`.
pub const OUTPUT_ORDER: usize = 1;

/// The change of an output, state or derivative.
fn change<M: Model>(role: &Role<M>, sample: &SampleOf<M>, states: &[f64]) -> Option<f64> {
    Some(match *role {
        Role::Output(get) => get(sample),
        Role::OutputState(number) | Role::LocalState(number) => states[number],
        Role::Derivative(number) => <M::Simulation as Simulation>::derivatives(sample)[number],
        Role::Input(_) | Role::Parameter { .. } | Role::Calculated(_) => return None,
    })
}

impl<M: Model> Instance<M> {
    fn tangent() -> Result<Tangent<M::Simulation>, Failure> {
        let missing = Failure::NotProvided { capability: "directional derivatives" };
        M::Simulation::TANGENT.ok_or(missing)
    }

    /// `fmi2GetDirectionalDerivative`: changes of `unknowns` for the changes `seed` of `knowns`.
    ///
    /// Unknowns are states, outputs and derivatives; knowns are states and inputs. A reference that
    /// stands twice among the knowns counts twice.
    ///
    /// # Errors
    /// [`Failure::NotProvided`], [`Failure::UnknownReference`], [`Failure::WrongType`], [`Failure::NoDerivative`],
    /// [`Failure::Seed`]; [`Failure::Model`] if the model cannot be evaluated,
    /// [`Failure::NotFinite`]. No value is written then.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        write: impl FnMut(usize, f64),
    ) -> Outcome {
        let tangent = Self::tangent()?;
        let states = table::states::<M>();
        // States, then inputs.
        let mut changes = [0.0; MOST_KNOWNS];
        for (&reference, &change) in knowns.iter().zip(seed) {
            let known = variable::<M>(reference, &REAL)?;
            check_change(known, change)?;
            match known.role {
                Role::OutputState(i) | Role::LocalState(i) => changes[i] += change,
                Role::Input(i) => changes[states + i] += change,
                _ => {
                    return Err(no_derivative(
                        known,
                        "cannot be a known: only states and inputs can",
                    ));
                }
            }
        }
        for &reference in unknowns {
            let unknown = variable::<M>(reference, &REAL)?;
            if matches!(unknown.role, Role::Input(_) | Role::Parameter { .. } | Role::Calculated(_))
            {
                return Err(no_derivative(
                    unknown,
                    "cannot be an unknown: only states, outputs and rates can",
                ));
            }
        }
        if unknowns.is_empty() {
            return Ok(());
        }
        let (states, inputs) = changes[..states + table::inputs::<M>()].split_at(states);
        let sample = tangent(self.running()?, states, inputs)?;
        write_changes::<M>(unknowns, &sample, states, write)
    }

    /// `fmi3GetAdjointDerivative`: what the changes `seed` of `unknowns` amount to for each of `knowns`, a column of
    /// the Jacobian at a time.
    ///
    /// # Errors
    /// Those of [`Instance::directional_derivative`].
    pub fn adjoint_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        mut write: impl FnMut(usize, f64),
    ) -> Outcome {
        Self::tangent()?;
        for (&reference, &change) in unknowns.iter().zip(seed) {
            check_change(variable::<M>(reference, &REAL)?, change)?;
        }
        let mut sums = [0.0; MOST_KNOWNS];
        let mut columns = knowns.chunks(MOST_KNOWNS).enumerate();
        columns.try_for_each(|(chunk, knowns)| {
            for (sum, known) in sums.iter_mut().zip(knowns) {
                *sum = 0.0;
                let add = |i: usize, change: f64| *sum += seed[i] * change;
                self.directional_derivative(unknowns, &[*known], &[1.0], add)?;
            }
            for (i, (&known, &value)) in knowns.iter().zip(&sums).enumerate() {
                if !value.is_finite() {
                    let variable = variable::<M>(known, &REAL)?.name;
                    return Err(Failure::NotFinite { variable, value });
                }
                write(chunk * MOST_KNOWNS + i, value);
            }
            Ok(())
        })
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
        let Some(InputDerivatives { highest, set, .. }) = M::Simulation::INPUT_DERIVATIVES else {
            return Err(Failure::NotProvided { capability: "inputs that move within a step" });
        };
        let triple = |i: usize| {
            let (variable, value) = (variable::<M>(inputs[i], &REAL)?, values[i]);
            let Role::Input(number) = variable.role else {
                return Err(no_derivative(
                    variable,
                    "cannot be given a derivative: only inputs can",
                ));
            };
            check_change(variable, value)?;
            Ok((number, order(variable, orders[i], highest)?, value))
        };
        for i in 0..inputs.len() {
            triple(i)?;
        }
        for i in 0..inputs.len() {
            let (number, order, value) = triple(i)?;
            if self.before_start() {
                self.pending.set_derivative(number, order, highest, value);
            }
            if let Some(simulation) = &mut self.simulation {
                set(simulation, number, order, value);
            }
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
        write: impl FnMut(usize, f64),
    ) -> Outcome {
        let tangent = Self::tangent()?;
        if outputs.is_empty() {
            return Ok(());
        }
        for (&reference, &asked) in outputs.iter().zip(orders) {
            let output = variable::<M>(reference, &REAL)?;
            if !matches!(output.role, Role::Output(_) | Role::OutputState(_)) {
                return Err(no_derivative(output, "has no derivative: only outputs have"));
            }
            order(output, asked, OUTPUT_ORDER)?;
        }
        let simulation = self.running()?;
        let (mut states, mut inputs) = ([0.0; MOST_KNOWNS], [0.0; MOST_KNOWNS]);
        let (states, inputs) =
            (&mut states[..table::states::<M>()], &mut inputs[..table::inputs::<M>()]);
        states.copy_from_slice(M::Simulation::derivatives(simulation.evaluate()?));
        if let Some(moving) = &M::Simulation::INPUT_DERIVATIVES {
            inputs.copy_from_slice((moving.first)(simulation));
        }
        let sample = tangent(simulation, states, inputs)?;
        write_changes::<M>(outputs, &sample, states, write)
    }
}

/// Hands out all changes, or none if one is not finite.
fn write_changes<M: Model>(
    references: &[u32],
    sample: &SampleOf<M>,
    states: &[f64],
    mut write: impl FnMut(usize, f64),
) -> Outcome {
    let read = |reference| {
        let variable = variable::<M>(reference, &REAL)?;
        let value = change(&variable.role, sample, states).unwrap_or(f64::NAN);
        let refused = Failure::NotFinite { variable: variable.name, value };
        value.is_finite().then_some(value).ok_or(refused)
    };
    for &reference in references {
        read(reference)?;
    }
    for (i, &reference) in references.iter().enumerate() {
        write(i, read(reference)?);
    }
    Ok(())
}

/// Whether a variable can change by so much.
fn check_change<M: Model>(variable: &Variable<M>, value: f64) -> Outcome {
    let refused = Failure::Seed { variable: variable.name, value };
    (value.abs() <= LARGEST).then_some(()).ok_or(refused)
}

fn no_derivative<M: Model>(variable: &Variable<M>, served: &'static str) -> Failure {
    Failure::NoDerivative { variable: variable.name, served }
}

/// An order of derivation, if it is served.
fn order<M: Model>(variable: &Variable<M>, asked: i32, highest: usize) -> Result<usize, Failure> {
    let refused = Failure::Order { variable: variable.name, order: asked, highest };
    usize::try_from(asked).ok().filter(|order| (1..=highest).contains(order)).ok_or(refused)
}
