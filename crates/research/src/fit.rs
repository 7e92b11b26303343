//! `cargo ahv fit`: fits the curves of eq. (4) to the first-principles model and writes a coefficient set.

mod regression;

use crate::cli::Fit;
use crate::shock_expansion::elastic::{self, COMPARED};
use crate::shock_expansion::stream::Stream;
use crate::shock_expansion::{Attitude, ShockExpansion};
use ahv::air::Atmosphere;
use ahv::data::{
    AeroData, AeroSet, Data, DataFile, EARTH, EarthData, PARKER2007, VEHICLE, VehicleData,
};
use ahv::dynamics::trim::trim;
use ahv::flight::Parameters;
use ahv::structure::{FLEXIBLE, Modes};
use ahv::vehicle::{ALPHA, Configuration, Vehicle, VehicleOptions, structure};
use ahv_tool::table::{row, table};
use ahv_tool::workspace::{MAX_DATA_BYTES, read_text, root, shown, write};
use anyhow::{Result, anyhow, bail};
use regression::{Axis, COEFFICIENTS, Deviation, Sample, TERMS, deviation, fit, samples};
use std::fmt::Write;

/// alpha and delta_e in deg, phi.
const GRID: [Axis; 3] = [(-2.0, 1.0, 8), (-20.0, 5.0, 9), (0.0, 0.1, 11)];
/// Held-out points, midway between those of the grid.
const HELD_OUT: [Axis; 3] = [(-1.5, 1.0, 7), (-17.5, 5.0, 8), (0.05, 0.1, 10)];
/// Other Mach numbers at which the fit is compared with the model.
const ELSEWHERE: [f64; 4] = [7.0, 7.5, 8.5, 9.0];
const SOURCE: &str = "regression of shock_expansion, see cargo ahv fit";

/// Input data of the fit.
struct Inputs {
    vehicle: VehicleData,
    earth: EarthData,
    published: AeroData,
}

/// Coefficients and table of errors.
struct Fitted {
    factors: [Vec<f64>; 4],
    rows: Vec<Vec<String>>,
}

pub fn run(options: &Fit) -> Result<()> {
    let file = root().join("src/data/aero/shock_expansion.toml");
    let inputs = Inputs {
        vehicle: VehicleData::embedded(&VEHICLE)?,
        earth: EarthData::embedded(&EARTH)?,
        published: AeroData::embedded(&PARKER2007)?,
    };
    let result = regress(&inputs)?;
    let (text, compared) = text(&inputs, &result)?;
    if !options.check {
        write(&file, &text)?;
    }
    out!("{}", table(&result.rows))?;
    out!("\nElastic terms: difference of strip theory from panels\n{}", table(&compared))?;
    if !options.check {
        return outln!("wrote {}", shown(&file));
    }
    if read_text(&file, MAX_DATA_BYTES)? != text {
        bail!(
            "{} is not what the model says; run `cargo ahv fit`, then `cargo ahv describe`, and \
             commit the results",
            shown(&file)
        );
    }
    outln!("{} is up to date", shown(&file))
}

fn regress(inputs: &Inputs) -> Result<Fitted> {
    let model = ShockExpansion::new(&inputs.vehicle, &inputs.earth);
    let atmosphere = Atmosphere::new(&inputs.earth);
    let default = &inputs.vehicle.default;
    let at = |mach: f64| model.medium.ahead(&atmosphere, mach, default.altitude_m.value);
    let take = |ahead: &Stream, axes| samples(&model, ahead, &inputs.published, axes);

    let design = at(default.mach.value);
    let (grid, choked) = take(&design, GRID)?;
    let (held_out, held_out_choked) = take(&design, HELD_OUT)?;
    let mut factors: [Vec<f64>; 4] = Default::default();
    for (coefficient, factors) in factors.iter_mut().enumerate() {
        *factors = fit(&grid, coefficient)?;
    }

    let heads = ["", "points", "choked"].into_iter().chain(COEFFICIENTS);
    let mut rows = vec![heads.map(str::to_string).collect::<Vec<_>>()];
    let mut report = |name: &str, samples: &[Sample], choked: usize, of: fn(&Deviation) -> f64| {
        let mut cells = vec![name.to_string(), samples.len().to_string(), choked.to_string()];
        for (coefficient, factors) in factors.iter().enumerate() {
            cells.push(format!("{:.5}", of(&deviation(samples, coefficient, factors))));
        }
        rows.push(cells);
    };
    report("range of values", &grid, choked, |d| d.range);
    report("fit, rms", &grid, choked, |d| d.rms);
    report("fit, largest", &grid, choked, |d| d.largest);
    report("held out, rms", &held_out, held_out_choked, |d| d.rms);
    report("held out, largest", &held_out, held_out_choked, |d| d.largest);
    for mach in ELSEWHERE {
        let (samples, choked) = take(&at(mach), HELD_OUT)?;
        report(&format!("at Mach {mach}, rms"), &samples, choked, |d| d.rms);
    }
    Ok(Fitted { factors, rows })
}

fn line(key: &str, value: &str, unit: &str, source: &str, status: &str) -> String {
    format!(
        "{key} = {{ value = {value}, unit = \"{unit}\", source = \"{source}\", \
         status = \"{status}\" }}\n"
    )
}

/// A line of the published set.
fn copied(table: &str, key: &str) -> Result<String> {
    let (header, start) = (format!("[{table}]"), format!("{key} = "));
    let lines = PARKER2007.text.lines().skip_while(|line| *line != header);
    let found = lines
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .find(|line| line.starts_with(&start));
    let line = found.ok_or_else(|| anyhow!("{}: no {table}.{key}", PARKER2007.name))?;
    Ok(format!("{line}\n"))
}

/// The data file, and the errors of its elastic terms. The elastic derivatives are taken at incidence and
/// elevator of the rigid trim, which does not depend on them.
fn text(inputs: &Inputs, result: &Fitted) -> Result<(String, Vec<Vec<String>>)> {
    let first = with_fit(inputs, &file(inputs, result, [0.0; 2], &[])?)?;
    let options = options(&first, Configuration::Rigid);
    let trimmed = trim(&Vehicle::new(&first, &options)?, &options.condition)?;
    let [delta_e, phi] = trimmed.control;
    let attitude = Attitude { alpha: trimmed.state[ALPHA], delta_e, phi };

    let elastic = [attitude.alpha, delta_e];
    let second = with_fit(inputs, &file(inputs, result, elastic, &[])?)?;
    let rows = compare(&second, &attitude)?;
    Ok((file(inputs, result, elastic, &rows)?, rows))
}

/// The embedded data with another fit.
fn with_fit(inputs: &Inputs, text: &str) -> Result<Data> {
    Ok(Data {
        shock_expansion: AeroData::parse("aero/shock_expansion.toml", text)?.into(),
        vehicle: inputs.vehicle.clone().into(),
        earth: inputs.earth.clone().into(),
        ..Data::embedded()?
    })
}

fn options(data: &Data, configuration: Configuration) -> VehicleOptions {
    VehicleOptions { configuration, aero: AeroSet::ShockExpansion, ..Parameters::new(data).options }
}

/// Compares the derived elastic terms with direct integration over panels.
fn compare(data: &Data, attitude: &Attitude) -> Result<Vec<Vec<String>>> {
    let model = ShockExpansion::new(&data.vehicle, &data.earth);
    let mut rows: Vec<_> = COMPARED.iter().map(|name| vec![name.to_string()]).collect();
    for configuration in [Configuration::EvenMassBeam, Configuration::SloshBeam] {
        let options = options(data, configuration);
        let vehicle = Vehicle::new(data, &options)?;
        let (beam, oscillators) = structure(data, &options)?;
        let modes = Modes::solve(&beam, &oscillators)?;
        let condition = &options.condition;
        let ahead = model.medium.ahead(&vehicle.atmosphere, condition.mach, condition.altitude);
        let direct = model.elastic(&ahead, attitude, &vehicle.aero, &beam, &modes)?;
        let found = elastic::deviation(&vehicle.airframe.elastic, &direct, FLEXIBLE);
        for (row, value) in rows.iter_mut().zip(found) {
            row.push(format!("{:.0} %", 100.0 * value));
        }
    }
    rows.insert(0, row(["", "EvenMassBeam", "SloshBeam"]));
    Ok(rows)
}

fn file(
    inputs: &Inputs,
    result: &Fitted,
    elastic: [f64; 2],
    compared: &[Vec<String>],
) -> Result<String> {
    let mut text = String::from(
        "# Curve fits of eq. (4) to the first-principles air and engine model. Written by `cargo ahv fit`:\n\
         # do not edit. Angles in rad; C_T is thrust over dynamic pressure and reference area.\n#\n",
    );
    let degrees = |(first, step, count): Axis| {
        format!("{first} to {} in steps of {step}", first + step * (count - 1) as f64)
    };
    let [alpha, delta_e, phi] = GRID;
    let default = &inputs.vehicle.default;
    writeln!(
        text,
        "# Least squares at Mach {}, {} m: alpha {} deg, delta_e {} deg,\n\
         # phi {:.0} to {:.0} in steps of {} where the burner is not choked. Held-out points are midway.\n\
         # The fit ignores choking: a flight ends where the choking margin of the envelope is exceeded.\n#",
        default.mach.value,
        default.altitude_m.value,
        degrees(alpha),
        degrees(delta_e),
        phi.0,
        phi.0 + phi.1 * (phi.2 - 1) as f64,
        phi.1,
    )?;
    for line in table(&result.rows).lines() {
        writeln!(text, "# {}", line.trim_end())?;
    }

    text.push_str(
        "#\n# Elastic terms are derived by strip theory as for the published set: see src/air/strip_theory.rs. Their difference\n\
         # from an integration of the local incidence over panels, norm over the flexible modes:\n#\n",
    );
    for line in table(compared).lines() {
        writeln!(text, "# {}", line.trim_end())?;
    }

    text.push_str("\n[reference]\n");
    text.push_str(&copied("reference", "area_m2_per_m")?);
    text.push_str(&copied("reference", "chord_m")?);
    text.push_str(&copied("reference", "moment_centre_m")?);
    text.push_str(&copied("reference", "thrust_arm_m")?);
    let source = "where the elastic derivatives are taken: rigid trim of this set";
    for (key, angle) in ["elastic_alpha_rad", "elastic_delta_e_rad"].into_iter().zip(elastic) {
        text.push_str(&line(key, &format!("{angle:.5}"), "rad", source, "derived"));
    }
    text.push_str(&copied("reference", "elastic_scale")?);
    text.push_str("\n[inertia]\n");
    text.push_str(&copied("inertia", "i_yy_kg_m2_per_m")?);
    text.push_str(&copied("inertia", "structural_damping")?);
    for (terms, factors) in TERMS.iter().zip(&result.factors) {
        let mut table = "";
        for (term, factor) in terms.iter().zip(factors) {
            if term.table != table {
                table = term.table;
                writeln!(text, "\n[{table}]")?;
            }
            let value = format!("{factor:?}");
            text.push_str(&line(term.key, &value, term.unit(), SOURCE, "derived"));
        }
    }
    text.push_str("\n[envelope]\n");
    text.push_str(&copied("envelope", "alpha_rad")?);
    text.push_str(&copied("envelope", "mach")?);
    text.push_str(&copied("envelope", "altitude_m")?);
    let source = "the fit is made where the burner is not choked";
    text.push_str(&line("choking_margin", "0.0", "1", source, "derived"));
    Ok(text)
}
