//! `cargo ahv modes`: prints the kept modes.

use crate::cli;
use crate::table::{number, row, table};
use crate::trim::{configuration, setup};
use ahv::data::Data;
use ahv::fmu::Message;
use ahv::structure::{FLEXIBLE, Modes};
use ahv::vehicle::{VehicleOptions, structure};
use anyhow::Result;
use serde_json::json;
use std::f64::consts::TAU;

/// The eigenproblem and its frequencies as JSON.
pub fn eigenproblem_json(data: &Data, options: &VehicleOptions) -> Result<serde_json::Value> {
    let (beam, oscillators) = structure(data, options)?;
    let masses: Vec<_> = oscillators
        .iter()
        .map(|o| json!({ "node": o.node, "mass": o.mass, "stiffness": o.stiffness }))
        .collect();
    Ok(json!({
        "element_m": beam.element_m,
        "stiffness": beam.stiffness,
        "density": beam.density,
        "oscillators": masses,
        "omega_rad_per_s": Modes::solve(&beam, &oscillators)?.omega_rad_per_s,
    }))
}

/// Name of a mode; flexible modes come first, then slosh modes.
pub fn name(mode: usize) -> String {
    match mode.checked_sub(FLEXIBLE) {
        None => format!("{} flexible", ordinal(mode)),
        Some(slosh) => format!("{} slosh", ordinal(slosh)),
    }
}

/// Ordinal of an index: 1st for 0.
pub fn ordinal(index: usize) -> &'static str {
    ["1st", "2nd", "3rd"].get(index).copied().unwrap_or("next")
}

pub fn run(options: &cli::Modes) -> Result<()> {
    let cli::Modes { analyse: options, elements } = options;
    let setup = setup(&options.own_vehicle, &options.set)?;
    let flight = setup.fly().map_err(Message)?;
    let vehicle = flight.vehicle();
    let count = vehicle.modes;
    let modes = match count {
        0 => Modes::default(),
        _ => {
            let (beam, oscillators) = structure(setup.data(), &setup.parameters.options)?;
            Modes::solve(&beam, &oscillators)?
        }
    };
    if *elements {
        outln!("{}", eigenproblem_json(setup.data(), &setup.parameters.options)?)?;
        return Ok(());
    }
    let omega = &modes.omega_rad_per_s;
    let ratio = |i: usize| vehicle.airframe.damping[i][i] / (2.0 * omega[i]);
    let damping = |i: usize| -> Vec<f64> {
        vehicle.airframe.damping[..count].iter().map(|slowed| slowed[i]).collect()
    };
    let slosh = |i: usize| modes.slosh_displacement.map(|tank| tank[i]);
    if options.json {
        let list: Vec<_> = (0..count)
            .map(|i| {
                json!({
                    "name": name(i),
                    "omega_rad_per_s": omega[i],
                    "modal_mass_kg_per_m": modes.modal_mass[i],
                    "damping_ratio": ratio(i),
                    "damping_per_s": damping(i),
                    "slosh_displacement": slosh(i),
                    "beam_energy_share": modes.beam_energy_share[i],
                })
            })
            .collect();
        outln!("{:#}", json!({ "configuration": configuration(&setup), "modes": list }))?;
        return Ok(());
    }
    outln!("Modes, {}", configuration(&setup))?;
    if count == 0 {
        outln!("  none: the vehicle is rigid")?;
        return Ok(());
    }
    let mut rows = vec![row([
        "mode",
        "rad/s",
        "Hz",
        "modal mass, kg/m",
        "damping ratio",
        "fore slosh",
        "aft slosh",
        "beam energy",
    ])];
    for (i, &omega) in omega.iter().enumerate().take(count) {
        let mut cells = vec![name(i)];
        cells.extend([omega, omega / TAU, modes.modal_mass[i], ratio(i)].map(number));
        cells.extend(slosh(i).map(number));
        cells.push(format!("{:.2} %", 100.0 * modes.beam_energy_share[i]));
        rows.push(cells);
    }
    out!("{}", table(&rows))?;
    outln!(
        "  slosh: displacement of the sloshing mass relative to its tank, per unit of the mode"
    )?;
    outln!(
        "  beam energy: share of the strain energy in the beam; the rest is in the slosh springs"
    )?;
    outln!("\nDamping matrix, 1/s")?;
    let mut rows = vec![std::iter::once(String::new()).chain((0..count).map(name)).collect()];
    for i in 0..count {
        let cells = damping(i).into_iter().map(number);
        rows.push(std::iter::once(name(i)).chain(cells).collect());
    }
    out!("{}", table(&rows))?;
    Ok(())
}
