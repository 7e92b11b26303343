//! The coefficient sets of a report.

use ahv::data::AeroSet;
use ahv::flight::Setup;
use anyhow::{Result, bail};
use fmi_model::{Kind, table::find};

/// A coefficient set of eq. (4).
#[derive(Debug, Clone, Copy)]
pub struct Set {
    pub name: &'static str,
    /// Description in the table of variables.
    pub description: &'static str,
    pub aero: AeroSet,
}

/// All sets of the FMU, from its table of variables.
fn all(setup: &Setup) -> Result<Vec<Set>> {
    let Some(variable) = find::<Setup>("aero") else { bail!("the FMU has no parameter `aero`") };
    let Kind::Enumeration(_, items) = variable.kind_in(setup) else {
        bail!("`aero` is no enumeration")
    };
    items
        .iter()
        .map(|&(name, value, description)| {
            let mut setup = setup.clone();
            variable.set(&mut setup, f64::from(value))?;
            Ok(Set { name, description, aero: setup.parameters.options.aero })
        })
        .collect()
}

/// The sets with these names; without names, the default of the FMU.
pub fn chosen(names: &[String]) -> Result<Vec<Set>> {
    let setup = Setup::new()?;
    let sets = all(&setup)?;
    if names.is_empty() {
        let default = setup.parameters.options.aero;
        return Ok(sets.into_iter().filter(|set| set.aero == default).collect());
    }
    if names.iter().any(|name| name == "all") {
        return Ok(sets);
    }
    let mut chosen: Vec<Set> = Vec::new();
    for name in names {
        let Some(set) = sets.iter().find(|set| set.name == name) else {
            let known: Vec<_> = sets.iter().map(|set| set.name).collect();
            bail!("--aero {name}: there is no such set; choose from {}, all", known.join(", "));
        };
        if chosen.iter().all(|known| known.name != set.name) {
            chosen.push(*set);
        }
    }
    Ok(chosen)
}
