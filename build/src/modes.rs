//! Prints the modes that are kept.

use crate::cli::Analyse;
use crate::table::{number, row, table};
use crate::trim::{configuration, flight, model, ready};
use ahv::modes::FLEXIBLE;
use anyhow::Result;
use serde_json::json;
use std::f64::consts::TAU;

/// What a mode is called: flexible ones first, then those of the sloshing masses.
pub fn name(mode: usize) -> String {
    match mode.checked_sub(FLEXIBLE) {
        None => format!("{} flexible", ordinal(mode)),
        Some(slosh) => format!("{} slosh", ordinal(slosh)),
    }
}

/// 1st for 0.
pub fn ordinal(index: usize) -> &'static str {
    ["1st", "2nd", "3rd"].get(index).copied().unwrap_or("next")
}

pub fn run(options: &Analyse) -> Result<()> {
    let flight = flight(&model()?, &options.set)?;
    let (vehicle, _) = ready(&flight)?;
    let count = vehicle.modes;
    let damping = |i: usize, k: usize| vehicle.damping[i][k];
    let ratio = |i: usize| damping(i, i) / (2.0 * vehicle.omega[i]);
    if options.json {
        let modes: Vec<_> = (0..count)
            .map(|i| {
                json!({
                    "name": name(i),
                    "omega_rad_per_s": vehicle.omega[i],
                    "damping_ratio": ratio(i),
                    "damping_per_s": &vehicle.damping[i][..count],
                    "slosh_displacement": vehicle.slosh.map(|tank| tank[i]),
                })
            })
            .collect();
        println!("{:#}", json!({ "configuration": configuration(&flight), "modes": modes }));
        return Ok(());
    }
    println!("Modes, {}", configuration(&flight));
    if count == 0 {
        println!("  none: the vehicle is rigid");
        return Ok(());
    }
    let mut rows =
        vec![row(["mode", "frequency, rad/s", "Hz", "damping ratio", "fore slosh", "aft slosh"])];
    for i in 0..count {
        let mut cells = vec![name(i)];
        let omega = vehicle.omega[i];
        cells.extend([omega, omega / TAU, ratio(i)].map(number));
        cells.extend(vehicle.slosh.map(|tank| number(tank[i])));
        rows.push(cells);
    }
    print!("{}", table(&rows));
    println!("  slosh: displacement of the sloshing mass in its tank per unit of the modal");
    println!("  coordinate, which is the nose deflection for flexible modes\n");
    println!("Damping matrix, 1/s");
    let mut rows = vec![std::iter::once(String::new()).chain((0..count).map(name)).collect()];
    for i in 0..count {
        let cells = (0..count).map(|k| number(damping(i, k)));
        rows.push(std::iter::once(name(i)).chain(cells).collect());
    }
    print!("{}", table(&rows));
    Ok(())
}
