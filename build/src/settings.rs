//! Parameters given as `name=value`, checked against the model description.

use crate::model_description::{Causality, Kind, ModelDescription, Real, Variable};
use ahv::short::short;
use anyhow::{Result, bail};

/// A parameter and its new value; Booleans as 0 and 1, enumerations as their number.
#[derive(Debug)]
pub struct Setting<'a> {
    pub variable: &'a Variable,
    pub value: f64,
    /// As it was typed.
    pub text: &'a str,
}

/// Reads all `--set` options.
pub fn parse<'a>(model: &'a ModelDescription, texts: &'a [String]) -> Result<Vec<Setting<'a>>> {
    let mut settings: Vec<Setting> = Vec::new();
    for text in texts {
        let new = parse_one(model, text)?;
        let same = |known: &&Setting| known.variable.name == new.variable.name;
        if let Some(known) = settings.iter().find(same) {
            bail!("--set {text}: {} is already set by --set {}", new.variable.name, known.text);
        }
        settings.push(new);
    }
    Ok(settings)
}

fn parse_one<'a>(model: &'a ModelDescription, text: &'a str) -> Result<Setting<'a>> {
    let Some((name, value)) = text.split_once('=') else {
        bail!("--set {text}: name=value is expected, for example --set mach0=8");
    };
    let (name, value) = (name.trim(), value.trim());
    let parameters = || model.with(Causality::Parameter).map(|variable| variable.name.as_str());
    let Some(variable) = model.find(name) else {
        bail!("--set {text}: there is no variable `{name}`; {}", suggest(name, parameters()));
    };
    match variable.causality {
        Causality::Parameter => {}
        Causality::Input => {
            bail!("--set {text}: {name} is an input; its values over time come from --input")
        }
        _ => bail!(
            "--set {text}: {name} is a result and cannot be set; {}",
            suggest(name, parameters())
        ),
    }
    match number(model, variable, value) {
        Ok(value) => Ok(Setting { variable, value, text }),
        Err(expected) => bail!("--set {text}: {name} = {value} is refused; {expected}"),
    }
}

/// The value as a number, or a description of accepted values.
fn number(model: &ModelDescription, variable: &Variable, text: &str) -> Result<f64, String> {
    match &variable.kind {
        Kind::Real(real) => real_number(model, variable, real, text),
        Kind::Boolean => match text.to_ascii_lowercase().as_str() {
            "true" | "1" => Ok(1.0),
            "false" | "0" => Ok(0.0),
            _ => Err("true or false is expected".into()),
        },
        Kind::Integer => text.parse::<i32>().map(f64::from).map_err(|e| e.to_string()),
        Kind::Enumeration(_) => {
            let items = model.items(variable);
            let found = items.iter().find(|item| {
                item.name.eq_ignore_ascii_case(text) || item.value.to_string() == text
            });
            let names: Vec<_> =
                items.iter().map(|item| format!("{} ({})", item.name, item.value)).collect();
            match found {
                Some(item) => Ok(f64::from(item.value)),
                None => Err(format!("choose one of {}", names.join(", "))),
            }
        }
        Kind::Other => Err("text cannot be set".into()),
    }
}

fn real_number(
    model: &ModelDescription,
    variable: &Variable,
    real: &Real,
    text: &str,
) -> Result<f64, String> {
    let display = model.display(variable);
    let unit = variable.unit();
    // A unit may follow the number: the variable's unit or its display unit.
    let (digits, shown) = match text.strip_suffix(display.name.as_str()) {
        Some(digits) if display.name != "1" && display.name != unit => (digits, true),
        _ => (text.strip_suffix(unit).filter(|_| unit != "1").unwrap_or(text), false),
    };
    let expected = || {
        let units =
            if display.name == unit { String::new() } else { format!(" or {}", display.name) };
        let unit = if unit == "1" { String::new() } else { format!(", in {unit}{units}") };
        format!("a finite number is expected{unit}")
    };
    let number: f64 = digits.trim().parse().map_err(|_| expected())?;
    let value = if shown { (number - display.offset) / display.factor } else { number };
    if !value.is_finite() {
        return Err(expected());
    }
    let (min, max) = (real.min.unwrap_or(f64::MIN), real.max.unwrap_or(f64::MAX));
    if !(min..=max).contains(&value) {
        let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
        return Err(format!("the range is [{}, {}]{unit}", short(min), short(max)));
    }
    Ok(value)
}

/// The nearest names, or all of them.
pub fn suggest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<_> = known.collect();
    let alike = |other: &&&str| {
        let (a, b) = (name.to_ascii_lowercase(), other.to_ascii_lowercase());
        strsim::jaro_winkler(&a, &b) > 0.8
    };
    let mut near: Vec<_> = known.iter().filter(alike).copied().collect();
    near.sort_by(|a, b| strsim::jaro_winkler(name, b).total_cmp(&strsim::jaro_winkler(name, a)));
    near.truncate(3);
    match near.as_slice() {
        [] => format!("choose from {}", known.join(", ")),
        near => format!("did you mean {}?", near.join(" or ")),
    }
}
