//! The cells of Tables 2 and 3: printed number, wanted accuracy, value of a vehicle.

use crate::published::Published;
use ahv::dynamics::linear::LinearModel;
use ahv::dynamics::trim::Trim;
use ahv::vehicle::{Configuration, Vehicle};
use anyhow::Result;
use nalgebra::Complex;

/// The columns of the tables.
pub const COLUMNS: [Configuration; 3] =
    [Configuration::Rigid, Configuration::EvenMassBeam, Configuration::SloshBeam];

/// Wanted relative accuracies, the weights of the misfit.
const SHORT_PERIOD: f64 = 0.05;
const REAL_ZERO: f64 = 0.08;
const POLE: [Option<f64>; 2] = [Some(0.02), Some(0.10)];
/// The real part of a zero, a small difference of sensor and control influence, is not fitted.
const ZERO: [Option<f64>; 2] = [Some(0.10), None];

/// One printed number.
#[derive(Debug, Clone)]
pub struct Cell {
    pub table: u8,
    pub column: Configuration,
    pub name: String,
    pub printed: f64,
    /// Wanted accuracy; `None` for a number that is shown but not fitted.
    pub wanted: Option<f64>,
}

impl Cell {
    /// Relative error.
    pub fn error(&self, value: f64) -> f64 {
        value / self.printed - 1.0
    }
}

/// Name, printed number, wanted accuracy.
type Line = (String, f64, Option<f64>);

/// Frequency and decay of the aeroelastic pairs.
fn pairs(list: &[[f64; 2]], what: &str, [frequency, rate]: [Option<f64>; 2]) -> Vec<Line> {
    let named = list.iter().enumerate().flat_map(|(i, [decay, omega])| {
        let of = |part: &str| format!("{} aeroelastic {what}, {part}", ahv_tool::modes::ordinal(i));
        [(of("frequency"), *omega, frequency), (of("real part"), *decay, rate)]
    });
    named.collect()
}

/// Geometric mean of a pair of real roots of opposite sign. Eqs (3)-(4), without derivatives with respect to q,
/// give symmetric zeros; the printed ones are not symmetric (errata.md), so their mean is compared.
pub fn size([right, left]: [f64; 2]) -> f64 {
    (-right * left).abs().sqrt()
}

/// All cells, column by column, in the order of [`values`].
pub fn cells() -> Result<Vec<Cell>> {
    let Published { table2, table3, .. } = Published::embedded()?;
    let columns =
        [(table2.rigid, table3.rigid), (table2.even, table3.even), (table2.slosh, table3.slosh)];
    let mut cells = Vec::new();
    for (column, (poles, zeros)) in COLUMNS.into_iter().zip(columns) {
        let [unstable, stable] = poles.short_term;
        let [right, left, _] = zeros.real;
        let mut second = vec![
            ("short-period pole, unstable".to_string(), unstable, Some(SHORT_PERIOD)),
            ("short-period pole, stable".to_string(), stable, Some(SHORT_PERIOD)),
            ("phugoid, frequency".to_string(), poles.long_term[1], None),
            ("phugoid, real part".to_string(), poles.long_term[0], None),
            ("height mode".to_string(), poles.height, None),
        ];
        second.extend(pairs(&poles.aeroelastic, "pole", POLE));
        let mut third = vec![
            ("real zeros, geometric mean".to_string(), size([right, left]), Some(REAL_ZERO)),
            ("right-half-plane zero".to_string(), right, None),
            ("left-half-plane zero".to_string(), left, None),
        ];
        third.extend(pairs(&zeros.aeroelastic, "zero", ZERO));
        for (table, list) in [(2, second), (3, third)] {
            cells.extend(list.into_iter().map(|(name, printed, wanted)| Cell {
                table,
                column,
                name,
                printed,
                wanted,
            }));
        }
    }
    Ok(cells)
}

/// Poles or zeros, sorted.
struct Roots {
    /// Ascending.
    real: Vec<f64>,
    /// Upper halves of the pairs, by frequency.
    pairs: Vec<Complex<f64>>,
}

impl Roots {
    fn new(all: Vec<Complex<f64>>) -> Self {
        let mut real: Vec<f64> = all.iter().filter(|root| root.im == 0.0).map(|r| r.re).collect();
        real.sort_by(f64::total_cmp);
        Self { real, pairs: all.into_iter().filter(|root| root.im > 0.0).collect() }
    }

    /// The largest and smallest real root, if their signs differ.
    fn outer(&self) -> Option<[f64; 2]> {
        let (left, right) = (*self.real.first()?, *self.real.last()?);
        (left < 0.0 && right > 0.0).then_some([right, left])
    }

    /// The fastest `count` pairs: those of the flexible modes, above the slosh modes.
    fn flexible(&self, count: usize) -> Option<&[Complex<f64>]> {
        self.pairs.get(self.pairs.len().checked_sub(count)?..)
    }
}

/// The unstable and the stable pole of the short period; `None` if it oscillates.
pub fn short_period(linear: &LinearModel) -> Option<[f64; 2]> {
    Roots::new(linear.poles()).outer()
}

/// Values of a trimmed vehicle in the cells of its column; `None` if its roots are of another kind than the
/// printed ones.
pub fn values(vehicle: &Vehicle, trim: &Trim) -> Option<Vec<f64>> {
    let linear = LinearModel::with_imu_gamma(vehicle, &trim.state, &trim.control);
    let (poles, zeros) = (Roots::new(linear.poles()), Roots::new(linear.zeros()));
    let flexible = vehicle.modes.min(ahv::structure::FLEXIBLE);
    let [unstable, stable] = poles.outer()?;
    let phugoid = poles.pairs.first()?;
    let height = poles.real.iter().copied().min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let mut values = vec![unstable, stable, phugoid.im, phugoid.re, height];
    values.extend(poles.flexible(flexible)?.iter().flat_map(|pole| [pole.im, pole.re]));
    let outer = zeros.outer()?;
    values.extend([size(outer), outer[0], outer[1]]);
    values.extend(zeros.flexible(flexible)?.iter().flat_map(|zero| [zero.im, zero.re]));
    Some(values)
}
