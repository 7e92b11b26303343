//! What depends on what: the unknowns of the ModelStructure, by rows of the table.

use crate::kinds::Dependencies;
use crate::model::Model;
use crate::table::{known_rows, states};
use crate::variable::{Role, Variable};

/// An unknown and what it depends on.
pub struct Unknown {
    /// Its row.
    pub row: usize,
    /// Rows of what it depends on, ascending.
    pub dependencies: Vec<usize>,
    /// How, unless that is not said.
    pub kinds: Option<Vec<&'static str>>,
}

/// The outputs.
pub fn outputs<M: Model>() -> impl Iterator<Item = Unknown> {
    let is_output = |role| matches!(role, Role::Output(_) | Role::OutputState(_));
    rows::<M>(is_output).map(|(row, variable)| unknown(row, variable))
}

/// The derivatives of the states.
pub fn derivatives<M: Model>() -> impl Iterator<Item = Unknown> {
    let is_derivative = |role| matches!(role, Role::Derivative(_));
    rows::<M>(is_derivative).map(|(row, variable)| unknown(row, variable))
}

/// What the initialisation computes.
pub fn initial_unknowns<M: Model>() -> impl Iterator<Item = Unknown> {
    let is_unknown = |role| !matches!(role, Role::Input(_) | Role::Parameter { .. });
    rows::<M>(is_unknown).map(|(row, variable)| initial_unknown(row, variable))
}

fn rows<M: Model>(
    wanted: fn(Role<M>) -> bool,
) -> impl Iterator<Item = (usize, &'static Variable<M>)> {
    M::VARIABLES.iter().enumerate().filter(move |(_, variable)| wanted(variable.role))
}

/// An output or derivative: on which states and inputs it depends, and how.
fn unknown<M: Model>(row: usize, variable: &Variable<M>) -> Unknown {
    let dependencies = variable.dependencies;
    let kinds = [
        (dependencies.dependent, "dependent"),
        (dependencies.fixed, "fixed"),
        (dependencies.constant, "constant"),
    ];
    let mut known: Vec<(usize, &str)> = known_rows::<M>()
        .into_iter()
        .enumerate()
        .filter_map(|(bit, row)| {
            let (_, kind) = kinds.into_iter().find(|(mask, _)| mask & (1 << bit) != 0)?;
            Some((row, kind))
        })
        .collect();
    known.sort_unstable();
    let (dependencies, kinds) = known.into_iter().unzip();
    Unknown { row, dependencies, kinds: Some(kinds) }
}

/// At initialisation the states are unknowns too, and what is known are parameters and inputs. The
/// initial state comes from parameters alone, so an input matters only to what depends on it
/// directly; to say more would make a master see algebraic loops that are not there.
fn initial_unknown<M: Model>(row: usize, variable: &Variable<M>) -> Unknown {
    let Dependencies { dependent, fixed, constant } = variable.dependencies;
    let inputs = (dependent | fixed | constant) >> states::<M>();
    let known = M::VARIABLES.iter().enumerate().filter_map(|(row, known)| match known.role {
        Role::Input(input) => (inputs & (1 << input) != 0).then_some(row),
        Role::Parameter { .. } => Some(row),
        _ => None,
    });
    Unknown { row, dependencies: known.collect(), kinds: None }
}

/// A list as an attribute.
pub fn list(items: impl IntoIterator<Item = impl ToString>) -> String {
    items.into_iter().map(|item| item.to_string()).collect::<Vec<_>>().join(" ")
}
