//! README.md and the documentation agree with the code: variables, limits, methods.

use ahv::flight::{INPUT_ORDER, Setup};
use ahv::variables::TABLE;
use ahv_tool::documentation;
use ahv_tool::models::VEHICLE;
use fmi_model::standard::Standard;
use fmi_model::{Kind, Role, Variable};
use std::fs;
use std::mem::discriminant;
use std::path::Path;

fn read(file: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    fs::read_to_string(root.join(file)).unwrap()
}

/// A page as one line.
fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn reference(name: &str) -> usize {
    let found = TABLE.iter().position(|variable| variable.name == name);
    found.unwrap_or_else(|| panic!("README.md names `{name}`: no such variable"))
}

/// The variables that a cell names; `a` ... `b` are those of their kind between them in the table.
fn named(cell: &str) -> Vec<&'static Variable<Setup>> {
    let mut references: Vec<usize> = Vec::new();
    let words: Vec<_> = cell.split('`').collect();
    for pair in words.chunks(2) {
        let &[before, name] = pair else { continue };
        let last = reference(name);
        let first = match references.last() {
            Some(first) if before.contains("...") => first + 1,
            _ => last,
        };
        let kind = |at: &usize| discriminant(&TABLE[*at].role) == discriminant(&TABLE[last].role);
        references.extend((first..=last).filter(kind));
    }
    references.into_iter().map(|reference| &TABLE[reference]).collect()
}

#[test]
fn the_table_in_the_readme_names_what_can_be_set_and_read_and_nothing_else() {
    let readme = read("README.md");
    let (_, table) = readme.split_once("| variable | | |").unwrap();
    let mut seen = Vec::new();
    for row in table.lines().skip(2).take_while(|line| line.starts_with('|')) {
        let cells: Vec<_> = row.split('|').map(str::trim).collect();
        for variable in named(cells[1]) {
            let fits = match variable.role {
                Role::Input(_) => cells[2].starts_with("input"),
                Role::Output(_) | Role::OutputState(_) => cells[2].starts_with("output"),
                Role::Parameter { .. } => cells[2].starts_with("parameter"),
                Role::Calculated(_) => cells[2] == "calculated",
                Role::LocalState(_) | Role::Derivative(_) => false,
            };
            assert!(fits, "{} is no {}: {:?}", variable.name, cells[2], variable.role);
            if let Kind::Enumeration(_, items) = variable.kind_in(&Setup::new().unwrap())
                && cells[1].matches('`').count() == 2
            {
                let items: Vec<_> =
                    items.iter().map(|(name, n, _)| format!("{n} {name}")).collect();
                assert!(cells[3].contains(&items.join(", ")), "{}: {items:?}", variable.name);
            }
            seen.push(variable.name);
        }
    }
    let said = |variable: &&Variable<Setup>| {
        matches!(
            variable.role,
            Role::Input(_) | Role::Output(_) | Role::OutputState(_) | Role::Parameter { .. }
        )
    };
    for variable in TABLE.iter().filter(said) {
        assert!(seen.contains(&variable.name), "README.md does not name {}", variable.name);
    }
}

#[test]
fn the_readme_states_the_limits_and_the_flight_of_the_code() {
    let readme = flat(&read("README.md"));
    let setup = Setup::new().unwrap();
    let start = |name: &str| TABLE[reference(name)].start(&setup).unwrap();
    let level = format!("level at Mach {} and {:.1} km", start("mach0"), start("altitude0") / 1e3);
    let stations = "`imu_station` (55 ft) and `probe_station` (the nose)".to_string();
    assert!((start("imu_station") - 55.0 * 0.3048).abs() < 1e-6 && start("probe_station") == 0.0);
    let mut flight = setup.fly().unwrap();
    let mut shown = |name: &str| TABLE[reference(name)].value(&setup, &mut flight).unwrap();
    let trim = shown("delta_e_trim").to_degrees();
    let mut hertz = |name: &str| shown(name) / std::f64::consts::TAU;
    let rings = format!(
        "ring at {:.1}, {:.1} and {:.0} Hz, the propellant sloshes at {:.1} Hz",
        hertz("omega1"),
        hertz("omega2"),
        hertz("omega3"),
        hertz("omega_slosh1")
    );
    let vehicle = flight.vehicle();
    let envelope = &vehicle.aero.envelope;
    let round =
        |[least, most]: [f64; 2], unit: f64| format!("{:.0} to {:.0}", least * unit, most * unit);
    let degrees = 1f64.to_degrees();
    let region = format!(
        "(Mach {}, {} km, alpha {} deg)",
        round(envelope.mach, 1.0),
        round(envelope.altitude, 1e-3),
        round(envelope.alpha, degrees)
    );
    let [elevator, fuel] = vehicle.limits;
    let saturation = format!("after saturation ({:.0} deg; 0 to {fuel})", elevator * degrees);
    let left = format!(
        "The elevator trims at {trim:.1} of {:.0} deg: {:.1} deg are left downwards",
        elevator * degrees,
        elevator * degrees - trim
    );
    let states =
        TABLE.iter().filter(|variable| matches!(variable.role, Role::Derivative(_))).count();
    let states = format!("Model Exchange: {states} states");
    for stated in [level, stations, region, saturation, left, rings, states] {
        assert!(readme.contains(&stated), "README.md does not say: {stated}");
    }
}

#[test]
fn the_documentation_names_the_orders_of_the_code() {
    let page = flat(
        &documentation::html(&(VEHICLE.content)().unwrap(), Standard::Fmi2, &["Linux".to_string()])
            .unwrap(),
    );
    let stated = format!("derivatives (orders 1 to {INPUT_ORDER})");
    assert!(page.contains(&stated), "index.html does not say: {stated}");
}

#[test]
fn the_ensemble_varies_what_its_page_says() {
    let (page, script) =
        (read("examples/ensemble/README.md"), read("examples/ensemble/vehicles.py"));
    let (_, varied) = script.split_once("VARIED = {").unwrap();
    let (varied, _) = varied.split_once('}').unwrap();
    let ranges: Vec<_> = varied.lines().filter_map(|line| line.trim().split_once(": ")).collect();
    assert!(ranges.len() > 5);
    for (name, range) in ranges {
        let name = name.trim_matches('"');
        reference(name);
        let (least, most) = range.trim_matches(['(', ')', ',']).split_once(", ").unwrap();
        let number = |text: &str| text.parse::<f64>().unwrap();
        let stated = match name {
            "aero" => format!("| `{name}` | the three sets |"),
            _ => format!("| `{name}` | {} to {}", number(least), number(most)),
        };
        assert!(page.contains(&stated), "examples/ensemble/README.md does not say: {stated}");
    }
}
