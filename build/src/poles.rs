//! `cargo ahv poles`: prints poles and transmission zeros.

use crate::cli::Poles;
use crate::modes::ordinal;
use crate::table::{NOISE, number, row, table};
use crate::trim::{configuration, setup};
use ahv::dynamics::linear::LinearModel;
use ahv::flight::Setup;
use ahv::fmu::Message;
use ahv::structure::FLEXIBLE;
use anyhow::Result;
use fmi_model::{Kind, table::find};
use nalgebra::Complex;
use serde_json::{Value, json};
use std::f64::consts::LN_2;

/// A real pole, or a complex pair by its upper half.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Root {
    re: f64,
    im: f64,
}

impl Root {
    fn frequency(self) -> f64 {
        libm::hypot(self.re, self.im)
    }

    fn text(self) -> String {
        match self.im {
            0.0 => number(self.re),
            im => format!("{} ± {}i", number(self.re), number(im)),
        }
    }
}

/// Poles with their names, and zeros, of one configuration.
struct Linearised {
    configuration: String,
    poles: Vec<(String, Root)>,
    /// To V and the flight-path angle of [`ANGLES`].
    zeros: [Vec<Root>; 2],
}

/// Flight-path angles whose zeros are shown: of the mass centre, and of the IMU.
const ANGLES: [&str; 2] = ["gamma", "gamma_imu"];

pub fn run(options: &Poles) -> Result<()> {
    let all = if options.all { linearise_all(options)? } else { vec![linearise(options, None)?] };
    if options.analyse.json {
        let values: Vec<Value> = all.iter().map(as_json).collect();
        outln!("{:#}", Value::from(values))?;
    } else if let [one] = all.as_slice() {
        print_one(one)?;
    } else {
        print_side_by_side(&all)?;
    }
    Ok(())
}

fn linearise_all(options: &Poles) -> Result<Vec<Linearised>> {
    let items = match find::<Setup>("configuration").map(|variable| variable.kind) {
        Some(Kind::Enumeration(_, items)) => items,
        _ => &[],
    };
    items.iter().map(|(name, _, _)| linearise(options, Some(name))).collect()
}

fn linearise(options: &Poles, configured: Option<&str>) -> Result<Linearised> {
    let mut set = crate::cli::Set { settings: options.analyse.set.settings.clone() };
    set.settings.extend(configured.map(|name| format!("configuration={name}")));
    let setup = setup(&options.analyse.own_vehicle, &set)?;
    let flight = setup.fly().map_err(Message)?;
    let (vehicle, trim) = (flight.vehicle(), flight.trim());
    let linear = [LinearModel::new, LinearModel::with_imu_gamma]
        .map(|linear| linear(vehicle, &trim.state, &trim.control));
    let roots = |values: Vec<Complex<f64>>| -> Vec<Root> {
        // The upper half of a pair represents both.
        let upper = values.into_iter().filter(|root| root.im >= 0.0);
        upper.map(|root| Root { re: root.re, im: root.im }).collect()
    };
    Ok(Linearised {
        configuration: configuration(&setup),
        poles: named(roots(linear[0].poles()), &vehicle.omega[..vehicle.modes]),
        zeros: linear.map(|linear| roots(linear.zeros())),
    })
}

/// Names the poles, in the order of the paper's tables. Each mode takes the pair with the nearest
/// frequency; the others are rigid-body poles.
fn named(mut roots: Vec<Root>, omega: &[f64]) -> Vec<(String, Root)> {
    let mut modes: Vec<(String, Root)> = Vec::new();
    for (mode, &omega) in omega.iter().enumerate() {
        let distance = |root: &Root| (root.frequency() - omega).abs();
        let nearest = (0..roots.len())
            .filter(|&i| roots[i].im > 0.0)
            .min_by(|&a, &b| distance(&roots[a]).total_cmp(&distance(&roots[b])));
        let Some(nearest) = nearest else { continue };
        let name = match mode.checked_sub(FLEXIBLE) {
            None => format!("{} aeroelastic", ordinal(mode)),
            Some(slosh) => format!("{} slosh", ordinal(slosh)),
        };
        modes.push((name, roots.remove(nearest)));
    }
    // Five rigid poles: the short period is the fastest pair or the two fastest real poles.
    roots.sort_by(|a, b| b.frequency().total_cmp(&a.frequency()));
    let fast = if roots.first().is_some_and(|root| root.im > 0.0) { 1 } else { 2 };
    let short = roots.drain(..fast.min(roots.len())).map(|root| ("short period".into(), root));
    let mut poles: Vec<_> = short.collect();
    // Of the three slow poles a pair is the phugoid; the height mode is the slowest real pole.
    let height = roots.iter().rposition(|root| root.im == 0.0).map(|i| roots.remove(i));
    let mut all: Vec<_> = roots.into_iter().map(|root| ("phugoid".to_string(), root)).collect();
    all.append(&mut poles);
    all.extend(height.map(|root| ("height".to_string(), root)));
    all.append(&mut modes);
    all
}

/// Damping ratio; empty for a pole at the origin.
fn ratio(root: Root) -> String {
    match root.frequency() {
        ..NOISE => String::new(),
        frequency => number(-root.re / frequency),
    }
}

/// Time to double or halve the amplitude, s.
fn doubling(root: Root) -> String {
    let verb = if root.re > 0.0 { "doubles" } else { "halves" };
    match root.re.abs() {
        ..NOISE => "constant".to_string(),
        rate => format!("{verb} in {}", number(LN_2 / rate)),
    }
}

fn print_one(linearised: &Linearised) -> Result<()> {
    outln!("Poles, {}, rad/s", linearised.configuration)?;
    let mut rows = vec![row(["mode", "pole", "frequency", "damping ratio", "amplitude, s"])];
    for (name, root) in &linearised.poles {
        rows.push(vec![
            name.clone(),
            root.text(),
            number(root.frequency()),
            ratio(*root),
            doubling(*root),
        ]);
    }
    out!("{}", table(&rows))?;
    for (angle, zeros) in ANGLES.into_iter().zip(&linearised.zeros) {
        outln!("\nTransmission zeros from delta_e, phi to V, {angle}, rad/s")?;
        let mut rows = vec![row(["", "zero", "frequency"])];
        for (index, root) in zeros.iter().enumerate() {
            rows.push(vec![(index + 1).to_string(), root.text(), number(root.frequency())]);
        }
        out!("{}", table(&rows))?;
    }
    Ok(())
}

fn print_side_by_side(all: &[Linearised]) -> Result<()> {
    let head = |title: &str| {
        let names = all.iter().map(|one| one.configuration.clone());
        std::iter::once(title.to_string()).chain(names).collect::<Vec<_>>()
    };
    // The configuration with most poles names the rows. A name may occur twice (two real poles of one mode):
    // the n-th pole of a name is in the n-th row of that name.
    let Some(longest) = all.iter().max_by_key(|one| one.poles.len()) else { return Ok(()) };
    let mut names: Vec<&String> = longest.poles.iter().map(|(name, _)| name).collect();
    for one in all {
        for (name, _) in &one.poles {
            let count = |list: &[&String]| list.iter().filter(|other| **other == name).count();
            let own: Vec<&String> = one.poles.iter().map(|(name, _)| name).collect();
            while count(&names) < count(&own) {
                names.push(name);
            }
        }
    }
    outln!("Poles, rad/s")?;
    let mut rows = vec![head("mode")];
    for (index, name) in names.iter().enumerate() {
        let before = names[..index].iter().filter(|other| *other == name).count();
        let cell = |one: &Linearised| {
            let mut same = one.poles.iter().filter(|(other, _)| other == *name);
            same.nth(before).map_or(String::new(), |(_, root)| root.text())
        };
        rows.push(std::iter::once(name.to_string()).chain(all.iter().map(cell)).collect());
    }
    out!("{}", table(&rows))?;
    for (output, angle) in ANGLES.into_iter().enumerate() {
        outln!("\nTransmission zeros from delta_e, phi to V, {angle}, rad/s")?;
        let mut rows = vec![head("")];
        let count = all.iter().map(|one| one.zeros[output].len()).max().unwrap_or(0);
        for index in 0..count {
            let cell = |one: &Linearised| {
                one.zeros[output].get(index).map_or(String::new(), |zero| zero.text())
            };
            rows.push(
                std::iter::once((index + 1).to_string()).chain(all.iter().map(cell)).collect(),
            );
        }
        out!("{}", table(&rows))?;
    }
    Ok(())
}

fn as_json(linearised: &Linearised) -> Value {
    let root = |root: &Root| json!({ "re": root.re, "im": root.im });
    let pole = |(name, value): &(String, Root)| json!({ "mode": name, "re": value.re, "im": value.im, "frequency": value.frequency() });
    json!({
        "configuration": linearised.configuration,
        "unit": "rad/s",
        "poles": linearised.poles.iter().map(pole).collect::<Vec<_>>(),
        "zeros": linearised.zeros[0].iter().map(root).collect::<Vec<_>>(),
        "zeros_imu": linearised.zeros[1].iter().map(root).collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poles_get_the_names_of_the_paper() {
        let real = |re: f64| Root { re, im: 0.0 };
        let pair = |re: f64, im: f64| Root { re, im };
        let poles = named(
            vec![real(-2e-4), pair(1e-4, 0.02), real(4.8), real(-4.7), pair(-0.3, 24.0)],
            &[23.0],
        );
        let names: Vec<_> = poles.iter().map(|(name, _)| name.as_str()).collect();
        let expected = ["phugoid", "short period", "short period", "height", "1st aeroelastic"];
        assert_eq!(names, expected);
        assert_eq!(poles[3].1, real(-2e-4));
    }
}
