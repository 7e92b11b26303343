//! The unit that a key's name promises; the file must give the same.

use toml::{Table, Value};

/// Unit of a suffix; keys without one are plain numbers.
const SUFFIXES: [(&str, &str); 18] = [
    ("_kg_m2_per_m", "kg m^2/m"),
    ("_n_m2_per_m", "N m^2/m"),
    ("_kg_per_m2", "kg/m^2"),
    ("_j_per_kg_k", "J/(kg K)"),
    ("_rad_per_s", "rad/s"),
    ("_j_per_kg", "J/kg"),
    ("_m_per_s2", "m/s^2"),
    ("_m2_per_m", "m^2/m"),
    ("_k_per_m", "K/m"),
    ("_rad", "rad"),
    ("_pa", "Pa"),
    ("_k", "K"),
    ("_m", "m"),
    ("alpha3", "1/rad^3"),
    ("delta_e3", "1/rad^3"),
    ("alpha_delta_e", "1/rad^2"),
    ("2", "1/rad^2"),
    ("", "1"),
];
/// Coefficients of eq. (4) that are slopes.
const SLOPES: [&str; 2] = ["alpha", "delta_e"];

fn promised(key: &str) -> &'static str {
    if SLOPES.contains(&key) {
        return "1/rad";
    }
    SUFFIXES.iter().find(|(suffix, _)| key.ends_with(suffix)).map_or("1", |(_, unit)| unit)
}

/// The first number of a file whose unit is not the one that its key promises: its path, and what
/// is wrong. What is no number with a unit at all is left to the types of the file.
pub(super) fn wrong(table: &Table) -> Option<(String, String)> {
    table.iter().find_map(|(key, value)| match value {
        Value::Table(number) if number.contains_key("value") => {
            let unit = number.get("unit").and_then(Value::as_str)?;
            let problem = || format!("the unit is {unit}, must be {}", promised(key));
            (unit != promised(key)).then(|| (key.clone(), problem()))
        }
        Value::Table(inner) => below(key, inner),
        Value::Array(rows) => rows.iter().filter_map(Value::as_table).find_map(|row| {
            let name = row.get("name").and_then(Value::as_str).unwrap_or_default();
            below(&format!("{key}.{name}"), row)
        }),
        _ => None,
    })
}

fn below(key: &str, table: &Table) -> Option<(String, String)> {
    wrong(table).map(|(path, problem)| (format!("{key}.{path}"), problem))
}
