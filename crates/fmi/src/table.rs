//! The table of what a master sees: value reference = row.
//!
//! XML, getters, setters, documentation and dependencies are loops over its rows.

use crate::model::Model;
use crate::variable::{Role, Variable};

/// Most states and inputs together: each has a bit in [`Dependencies`](crate::Dependencies).
pub const MOST_KNOWNS: usize = 64;

/// The variable with this name.
pub fn find<M: Model>(name: &str) -> Option<&'static Variable<M>> {
    M::VARIABLES.iter().find(|variable| variable.name == name)
}

/// Number of states.
pub const fn states<M: Model>() -> usize {
    let (mut row, mut count) = (0, 0);
    while row < M::VARIABLES.len() {
        if matches!(M::VARIABLES[row].role, Role::OutputState(_) | Role::LocalState(_)) {
            count += 1;
        }
        row += 1;
    }
    count
}

/// Number of inputs.
pub const fn inputs<M: Model>() -> usize {
    let (mut row, mut count) = (0, 0);
    while row < M::VARIABLES.len() {
        if matches!(M::VARIABLES[row].role, Role::Input(_)) {
            count += 1;
        }
        row += 1;
    }
    count
}

/// The row of a state.
///
/// # Panics
/// There is no such state: [`check`] refuses tables with gaps.
pub fn state<M: Model>(number: usize) -> &'static Variable<M> {
    let is =
        |role: &Role<M>| matches!(*role, Role::OutputState(i) | Role::LocalState(i) if i == number);
    M::VARIABLES.iter().find(|variable| is(&variable.role)).expect("the table has all states")
}

/// Rows of the variables that [`Dependencies`](crate::Dependencies) number: the states, then the inputs.
pub fn known_rows<M: Model>() -> Vec<usize> {
    let mut rows = vec![0; states::<M>() + inputs::<M>()];
    for (row, variable) in M::VARIABLES.iter().enumerate() {
        match variable.role {
            Role::OutputState(i) | Role::LocalState(i) => rows[i] = row,
            Role::Input(i) => rows[states::<M>() + i] = row,
            _ => {}
        }
    }
    rows
}

/// Stops the compiler at a table that no master could use: a name twice, states or inputs that are not
/// numbered from zero on, a derivative without its state, more than [`MOST_KNOWNS`].
pub const fn check<M: Model>() {
    let table = M::VARIABLES;
    let (states, inputs) = (states::<M>(), inputs::<M>());
    assert!(states + inputs <= MOST_KNOWNS, "too many states and inputs");
    let (mut seen_states, mut seen_inputs, mut row) = (0_u64, 0_u64, 0);
    while row < table.len() {
        let mut other = row + 1;
        while other < table.len() {
            assert!(!same(table[row].name, table[other].name), "two variables have the same name");
            other += 1;
        }
        match table[row].role {
            Role::OutputState(i) | Role::LocalState(i) => {
                assert!(i < states && seen_states & 1 << i == 0, "states are numbered from 0 on");
                seen_states |= 1 << i;
            }
            Role::Input(i) => {
                assert!(i < inputs && seen_inputs & 1 << i == 0, "inputs are numbered from 0 on");
                seen_inputs |= 1 << i;
            }
            Role::Derivative(i) => assert!(i < states, "a derivative belongs to a state"),
            _ => {}
        }
        row += 1;
    }
}

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    if a.len() != b.len() {
        return false;
    }
    let mut i = 0;
    while i < a.len() {
        if a[i] != b[i] {
            return false;
        }
        i += 1;
    }
    true
}
