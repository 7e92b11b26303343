//! Writes the ModelStructure: what depends on what.

use super::xml::Xml;
use crate::kinds::Dependencies;
use crate::model::Model;
use crate::table::{known_rows, states};
use crate::variable::{Role, Variable};
use std::io;

/// Index of a row in the ModelStructure, which counts from one.
pub fn index(row: usize) -> usize {
    row + 1
}

pub fn model_structure<M: Model>(xml: &mut Xml) -> io::Result<()> {
    let is_output = |role| matches!(role, Role::Output(_) | Role::OutputState(_));
    let is_derivative = |role| matches!(role, Role::Derivative(_));
    let is_unknown = |role| !matches!(role, Role::Input(_) | Role::Parameter { .. });
    unknowns::<M>(xml, "Outputs", is_output, unknown)?;
    unknowns::<M>(xml, "Derivatives", is_derivative, unknown)?;
    unknowns::<M>(xml, "InitialUnknowns", is_unknown, initial_unknown)
}

/// A list of the variables with the wanted roles; the schema has no empty ones.
fn unknowns<M: Model>(
    xml: &mut Xml,
    name: &str,
    wanted: fn(Role<M>) -> bool,
    write: fn(&mut Xml, usize, &Variable<M>) -> io::Result<()>,
) -> io::Result<()> {
    let rows = M::VARIABLES.iter().enumerate();
    let mut rows = rows.filter(|(_, variable)| wanted(variable.role)).peekable();
    if rows.peek().is_none() {
        return Ok(());
    }
    xml.parent(name, &[], |xml| rows.try_for_each(|(row, variable)| write(xml, row, variable)))
}

/// An output or derivative: on which states and inputs it depends, and how.
fn unknown<M: Model>(xml: &mut Xml, row: usize, variable: &Variable<M>) -> io::Result<()> {
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
            Some((index(row), kind))
        })
        .collect();
    known.sort_unstable();
    let attributes = [
        ("index", index(row).to_string()),
        ("dependencies", list(known.iter().map(|(index, _)| index))),
        ("dependenciesKind", list(known.iter().map(|(_, kind)| kind))),
    ];
    xml.leaf("Unknown", &attributes)
}

/// At initialisation the states are unknowns too, and what is known are parameters and inputs. The
/// initial state comes from parameters alone, so an input matters only to what depends on it
/// directly; to say more would make a master see algebraic loops that are not there.
fn initial_unknown<M: Model>(xml: &mut Xml, row: usize, variable: &Variable<M>) -> io::Result<()> {
    let Dependencies { dependent, fixed, constant } = variable.dependencies;
    let inputs = (dependent | fixed | constant) >> states::<M>();
    let known = M::VARIABLES.iter().enumerate().filter_map(|(row, known)| match known.role {
        Role::Input(input) => (inputs & (1 << input) != 0).then(|| index(row)),
        Role::Parameter { .. } => Some(index(row)),
        _ => None,
    });
    let attributes = [("index", index(row).to_string()), ("dependencies", list(known))];
    xml.leaf("Unknown", &attributes)
}

fn list(items: impl Iterator<Item = impl ToString>) -> String {
    items.map(|item| item.to_string()).collect::<Vec<_>>().join(" ")
}
