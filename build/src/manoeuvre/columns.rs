//! The header of an input file: variable and unit of each column.

use crate::model_description::{Causality, ModelDescription, Variable};
use crate::settings::suggest;
use anyhow::{Result, bail};

/// Content of a column.
pub enum Role<'a> {
    Time,
    /// Value of the FMU = (number - offset) / factor.
    Input {
        variable: &'a Variable,
        factor: f64,
        offset: f64,
    },
    /// Another variable of the FMU, such as an output in a recorded flight, or a column without a name.
    Ignored,
}

pub struct Column<'a> {
    pub name: String,
    pub role: Role<'a>,
}

/// An example of a header, for messages.
pub fn example(model: &ModelDescription) -> String {
    let inputs = model.with(Causality::Input).map(|input| format!(",{}", input.name));
    format!("time{}", inputs.collect::<String>())
}

/// Parses a header; `at` is its place in messages.
pub fn columns<'t, 'a>(
    titles: impl Iterator<Item = &'t str>,
    at: &str,
    model: &'a ModelDescription,
) -> Result<Vec<Column<'a>>> {
    let titles: Vec<_> = titles.collect();
    if titles.iter().any(|title| title.replace(',', ".").parse::<f64>().is_ok()) {
        bail!(
            "{at}: numbers instead of column names; add a header line such as `{}`, without `#`",
            example(model)
        );
    }
    let mut columns: Vec<Column> = Vec::new();
    for title in titles {
        let column = column(title, at, model)?;
        if !column.name.is_empty() && columns.iter().any(|known| known.name == column.name) {
            bail!("{at}: there are two columns {}", column.name);
        }
        columns.push(column);
    }
    // A delimiter at the end of the line adds a column without a name.
    while columns.last().is_some_and(|column| column.name.is_empty()) {
        columns.pop();
    }
    if !columns.iter().any(|column| matches!(column.role, Role::Time)) {
        bail!(
            "{at}: there is no column `time`; a header is expected, such as `{}`, with commas, \
             semicolons or tabs",
            example(model)
        );
    }
    Ok(columns)
}

fn column<'a>(title: &str, at: &str, model: &'a ModelDescription) -> Result<Column<'a>> {
    let (name, unit) = match title.strip_suffix(']').and_then(|title| title.split_once('[')) {
        Some((name, unit)) => (name.trim(), Some(unit.trim())),
        None => (title, None),
    };
    let found = |role| Ok(Column { name: name.to_string(), role });
    if name.eq_ignore_ascii_case("time") {
        return match unit {
            None | Some("s") => Ok(Column { name: "time".to_string(), role: Role::Time }),
            Some(unit) => bail!("{at}, column {name}: unit `{unit}` is unknown; s is expected"),
        };
    }
    if name.is_empty() {
        return found(Role::Ignored);
    }
    let Some(variable) = model.find(name) else {
        let inputs = model.with(Causality::Input).map(|input| input.name.as_str());
        bail!("{at}: there is no input `{name}`; {}", suggest(name, inputs));
    };
    match variable.causality {
        Causality::Input => {}
        Causality::Parameter => bail!(
            "{at}: {name} is a parameter, which does not change in flight; remove the column and \
             use --set {name}=VALUE"
        ),
        _ => return found(Role::Ignored),
    }
    let display = model.display(variable);
    let (factor, offset) = match unit {
        None => (1.0, 0.0),
        Some(unit) if unit == variable.unit() => (1.0, 0.0),
        Some(unit) if unit == display.name => (display.factor, display.offset),
        Some(unit) => {
            let other = match display.name == variable.unit() {
                true => String::new(),
                false => format!(" or {}", display.name),
            };
            bail!(
                "{at}, column {name}: unit `{unit}` is unknown; {}{other} is expected",
                variable.unit()
            )
        }
    };
    found(Role::Input { variable, factor, offset })
}
