//! Offsets of the initial state: each moves what it is named after, and nothing else.

use crate::model::{AERO_SETS, CONFIGURATIONS, data, setup};
use ahv::error::{Error, StartCause};
use ahv::flight::{Flight, INPUTS};
use ahv::fmu::Message;
use ahv::vehicle::{Configuration, RIGID_STATES};

/// Of sums over five modes.
const ROUNDING: f64 = 1e-12;
/// Offsets with what they move, and sizes that all fit into the tanks and the envelope at once.
const OFFSETS: [(&str, &str, f64); 12] = [
    ("alpha_offset", "alpha", 0.01),
    ("q_offset", "q", -0.05),
    ("eta1_offset", "eta1", 0.03),
    ("eta2_offset", "eta2", -0.02),
    ("eta3_offset", "eta3", 0.01),
    ("eta1_dot_offset", "eta1_dot", -0.7),
    ("eta2_dot_offset", "eta2_dot", 0.5),
    ("eta3_dot_offset", "eta3_dot", 1.3),
    ("slosh1_offset", "slosh1", 0.2),
    ("slosh2_offset", "slosh2", -0.1),
    ("slosh1_dot_offset", "slosh1_dot", 0.4),
    ("slosh2_dot_offset", "slosh2_dot", -0.6),
];
/// What all of them move, and what none does; the rates of slosh have no variable of their own.
const SHOWN: [&str; 15] = [
    "alpha",
    "q",
    "eta1",
    "eta2",
    "eta3",
    "eta1_dot",
    "eta2_dot",
    "eta3_dot",
    "slosh1",
    "slosh2",
    "V",
    "h",
    "gamma",
    "fuel_mass",
    "alpha_trim",
];

/// A flight at its start.
fn flight(settings: &[(&str, f64)]) -> Flight {
    setup(settings).fly().unwrap_or_else(|error| panic!("{settings:?}: {error}"))
}

fn shown(flight: &mut Flight, name: &str) -> f64 {
    let Some(slosh) = name.strip_suffix("_dot").filter(|slosh| slosh.starts_with("slosh")) else {
        return crate::model::shown(flight, name);
    };
    let rates = flight.evaluate().unwrap().derivatives;
    let rates = flight.tangent(&rates, &[0.0; INPUTS]).unwrap();
    rates.outputs.slosh[if slosh == "slosh1" { 0 } else { 1 }]
}

/// All vehicles, in trim and from start values.
fn starts() -> Vec<Vec<(&'static str, f64)>> {
    let mut starts = Vec::new();
    for configuration in CONFIGURATIONS {
        for aero in AERO_SETS {
            for fuel_fraction in [1.0, 0.4] {
                let vehicle = [
                    ("configuration", f64::from(configuration as i32)),
                    ("aero", f64::from(aero as i32)),
                    ("fuel_fraction", fuel_fraction),
                ];
                let values = [("alpha0", 0.02), ("q0", 0.1), ("eta10", 0.01), ("eta30", -0.004)];
                starts.push(vehicle.to_vec());
                starts.push([&vehicle[..], &[("trim", 0.0)], &values].concat());
            }
        }
    }
    starts
}

/// Whether a configuration has what is moved.
fn has(start: &[(&str, f64)], moved: &str) -> bool {
    let configuration = start[0].1;
    match moved {
        name if name.starts_with("slosh") => configuration == 3.0,
        name if name.starts_with("eta") => configuration > 1.0,
        _ => true,
    }
}

#[test]
fn verif_an_offset_moves_what_it_names_and_nothing_else() {
    for start in starts() {
        let mut plain = flight(&start);
        for (offset, moved, size) in OFFSETS {
            let mut flight = flight(&[&start[..], &[(offset, size)]].concat());
            for name in SHOWN.into_iter().chain(["slosh1_dot", "slosh2_dot"]) {
                let expected = if name == moved && has(&start, moved) { size } else { 0.0 };
                let change = shown(&mut flight, name) - shown(&mut plain, name);
                let off = (change - expected).abs();
                assert!(off < ROUNDING, "{start:?}, {offset}: {name} by {change}: {off:.1e}");
            }
        }
    }
}

#[test]
fn verif_offsets_add_up() {
    for start in starts() {
        let mut plain = flight(&start);
        let all: Vec<_> = OFFSETS.iter().map(|(offset, _, size)| (*offset, *size)).collect();
        let mut flight = flight(&[&start[..], &all].concat());
        for (_, moved, size) in OFFSETS {
            let expected = if has(&start, moved) { size } else { 0.0 };
            let change = shown(&mut flight, moved) - shown(&mut plain, moved);
            assert!((change - expected).abs() < ROUNDING, "{start:?}: {moved} by {change}");
        }
        assert_eq!(flight.trim(), plain.trim(), "{start:?}: offsets leave the trim as it is");
    }
}

#[test]
fn verif_without_offsets_the_start_is_the_trim_bit_for_bit() {
    for start in starts() {
        let flight = flight(&start);
        assert_eq!(*flight.state(), flight.trim().state);
        assert!(flight.state()[RIGID_STATES..].iter().any(|eta| *eta != 0.0));
    }
}

/// The refusal of a start: what leads there, and the text.
fn refused(settings: &[(&str, f64)]) -> (StartCause, String) {
    match setup(settings).fly().unwrap_err() {
        error @ Error::StartOutside { cause, .. } => (cause, Message(error).to_string()),
        error => panic!("{settings:?}: {error}"),
    }
}

fn range([min, max]: [f64; 2]) -> String {
    format!("[{min:.6}, {max:.6}]")
}

#[test]
fn verif_an_offset_out_of_the_envelope_is_refused_by_name_value_and_range() {
    let data = data();
    for start in starts() {
        let set = AERO_SETS.into_iter().find(|set| f64::from(*set as i32) == start[1].1).unwrap();
        for value in [0.3, -0.2] {
            let settings = [&start[..], &[("alpha_offset", value)]].concat();
            let (cause, told) = refused(&settings);
            assert_eq!(cause, StartCause::IncidenceOffset(value), "{settings:?}");
            let limits = range(data.aero(set).envelope.alpha_rad.value);
            assert!(told.starts_with(&format!("alpha_offset = {value} ")), "{told}");
            assert!(told.contains(&limits) && told.contains("makes alpha "), "{told}");
        }
    }
}

#[test]
fn verif_an_offset_beyond_the_liquids_depth_is_refused_by_name_value_and_range() {
    let data = data();
    let residual = data.vehicle.mass.residual_fraction.value;
    for fuel_fraction in [1.0, 0.4, 0.05] {
        let filling = residual + (1.0 - residual) * fuel_fraction;
        for trim in [1.0, 0.0] {
            for (tank, name) in ["slosh1", "slosh2"].into_iter().enumerate() {
                let depth = data.vehicle.tank[tank].depth_full_m.value * filling;
                let at = |offset: f64| {
                    let offset = (["slosh1_offset", "slosh2_offset"][tank], offset);
                    let configuration = f64::from(Configuration::SloshBeam as i32);
                    vec![
                        ("configuration", configuration),
                        ("fuel_fraction", fuel_fraction),
                        ("trim", trim),
                        offset,
                    ]
                };
                let rest = shown(&mut flight(&at(0.0)), name);
                for side in [1.0, -1.0] {
                    let edge = side * depth - rest;
                    let inside = shown(&mut flight(&at(edge - 1e-9 * side)), name);
                    assert!((inside - side * depth).abs() < 1e-8, "{inside}");
                    let value = edge + 1e-9 * side;
                    let (cause, told) = refused(&at(value));
                    assert_eq!(cause, StartCause::SloshOffset(tank, value));
                    let limits = range([-depth, depth]);
                    assert!(told.starts_with(&format!("{name}_offset = ")), "{told}");
                    assert!(
                        told.contains(&limits) && told.contains(&format!("makes {name} ")),
                        "{told}"
                    );
                }
            }
        }
    }
}
