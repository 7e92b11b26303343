//! `law.json` as it is written.

use crate::error::Error;
use crate::gains::{FEEDBACK_COLUMNS, FILTER_COLUMNS, Gains};
use crate::law::{
    COMMANDS, Design, LONGEST_PERIOD_S, MEASURED, MOST_STATES, SHORTEST_PERIOD_S, WANTED,
};
use fmi_model::instance::LARGEST;
use serde::Deserialize;

/// One design as in the file: n states, sampled every `period_s`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(non_snake_case, reason = "as in the literature")]
pub struct Written {
    period_s: f64,
    fuel_fraction: f64,
    fuel_mass_kg_per_m: f64,
    A: Vec<Vec<f64>>,
    B: Vec<Vec<f64>>,
    C: Vec<Vec<f64>>,
    K: Vec<Vec<f64>>,
    Ki: Vec<Vec<f64>>,
    L: Vec<Vec<f64>>,
    level: [f64; MEASURED],
    trim: [f64; COMMANDS],
    lowest: [f64; COMMANDS],
    highest: [f64; COMMANDS],
    speed_error_m_per_s: f64,
}

/// The file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// Designs.
    pub designs: Vec<Written>,
}

impl Written {
    /// States of the design model.
    pub fn states(&self) -> usize {
        self.A.len()
    }

    /// Checks a design and puts its matrices together.
    pub fn design(&self, number: usize) -> Result<Design, Error> {
        let written = self;
        let refuse = |key, problem| Err(Error::Design { design: number, key, problem });
        let n = written.states();
        if !(WANTED..=MOST_STATES).contains(&n) {
            return refuse(
                "A",
                format!("has {n} rows; {WANTED} to {MOST_STATES} states are possible"),
            );
        }
        for (key, matrix, rows, columns) in [
            ("A", &written.A, n, n),
            ("B", &written.B, n, COMMANDS),
            ("C", &written.C, MEASURED, n),
            ("K", &written.K, COMMANDS, n),
            ("Ki", &written.Ki, COMMANDS, WANTED),
            ("L", &written.L, n, MEASURED),
        ] {
            if matrix.len() != rows {
                return refuse(key, format!("has {} rows; {rows} are needed", matrix.len()));
            }
            if let Some((row, values)) =
                matrix.iter().enumerate().find(|(_, row)| row.len() != columns)
            {
                let (row, found) = (row + 1, values.len());
                return refuse(
                    key,
                    format!("has {found} numbers in row {row}; {columns} are needed"),
                );
            }
        }
        for (key, numbers) in [
            ("A", written.A.concat()),
            ("B", written.B.concat()),
            ("C", written.C.concat()),
            ("K", written.K.concat()),
            ("Ki", written.Ki.concat()),
            ("L", written.L.concat()),
            ("level", written.level.to_vec()),
            ("trim", written.trim.to_vec()),
            ("lowest", written.lowest.to_vec()),
            ("highest", written.highest.to_vec()),
        ] {
            if let Some(value) = numbers.iter().find(|number| number.abs() > LARGEST) {
                return refuse(
                    key,
                    format!("has {value:e}; numbers up to {LARGEST:e} are possible"),
                );
            }
        }
        let period_s = written.period_s;
        if !(SHORTEST_PERIOD_S..=LONGEST_PERIOD_S).contains(&period_s) {
            return refuse(
                "period_s",
                format!(
                    "= {period_s:?} s must be within {SHORTEST_PERIOD_S:e} and {LONGEST_PERIOD_S}"
                ),
            );
        }
        if !(0.0..=1.0).contains(&written.fuel_fraction) {
            return refuse(
                "fuel_fraction",
                format!("= {} must be within 0 and 1", written.fuel_fraction),
            );
        }
        if written.fuel_mass_kg_per_m < 0.0 {
            return refuse(
                "fuel_mass_kg_per_m",
                format!("= {} must not be negative", written.fuel_mass_kg_per_m),
            );
        }
        if written.speed_error_m_per_s <= 0.0 {
            return refuse(
                "speed_error_m_per_s",
                format!("= {} m/s must be positive", written.speed_error_m_per_s),
            );
        }
        for i in 0..COMMANDS {
            let [low, trim, high] = [written.lowest[i], written.trim[i], written.highest[i]];
            if low > high {
                return refuse("lowest", format!("has {low}, more than {high}, the highest"));
            }
            if !(low <= trim && trim <= high) {
                return refuse("trim", format!("has {trim}; its limits are [{low}, {high}]"));
            }
        }
        Ok(Design {
            period_s,
            fuel_fraction: written.fuel_fraction,
            fuel_mass_kg_per_m: written.fuel_mass_kg_per_m,
            level: written.level,
            trim: written.trim,
            lowest: written.lowest,
            highest: written.highest,
            speed_error_m_per_s: written.speed_error_m_per_s,
            gains: gains(written, n),
        })
    }
}

/// The gains of a checked design.
fn gains(written: &Written, n: usize) -> Gains {
    let mut gains = Gains {
        filter: [[0.0; MOST_STATES]; FILTER_COLUMNS],
        measurement: [[0.0; MEASURED]; MOST_STATES],
        feedback: [[0.0; COMMANDS]; FEEDBACK_COLUMNS],
    };
    for row in 0..n {
        for column in 0..n {
            let innovation: f64 =
                (0..MEASURED).map(|m| written.L[row][m] * written.C[m][column]).sum();
            gains.filter[column][row] = written.A[row][column] - innovation;
        }
        for command in 0..COMMANDS {
            gains.filter[MOST_STATES + command][row] = written.B[row][command];
        }
        for measured in 0..MEASURED {
            gains.filter[MOST_STATES + COMMANDS + measured][row] = written.L[row][measured];
        }
    }
    for state in 0..n {
        gains.measurement[state] = std::array::from_fn(|measured| written.C[measured][state]);
    }
    for command in 0..COMMANDS {
        for state in 0..n {
            gains.feedback[state][command] = written.K[command][state];
        }
        for integral in 0..WANTED {
            gains.feedback[MOST_STATES + integral][command] = written.Ki[command][integral];
        }
    }
    gains
}
