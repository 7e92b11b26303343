//! Tables 1 to 3, compared cell by cell.

use super::operating_point::OperatingPoint;
use super::roots::{Name, Root, find};
use super::verdict::{Aim, Verdict, difference};
use crate::identify::size;
use crate::published::{Columns, Poles, Table1, Zeros};
use serde::Serialize;

pub const COLUMNS: [&str; 3] = ["rigid body", "even mass", "sloshing mass"];

/// A printed number and ours, rad/s.
#[derive(Debug, Clone, Serialize)]
pub struct Cell {
    pub row: String,
    pub column: &'static str,
    pub paper: f64,
    pub ours: Option<f64>,
    /// ours/paper - 1.
    pub difference: Option<f64>,
    /// The best fit with one inertia and free stations, all other numbers published.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub best: Option<f64>,
    #[serde(flatten)]
    pub verdict: Verdict,
}

/// A pole or zero that the paper does not print.
#[derive(Debug, Clone, Serialize)]
pub struct Unprinted {
    pub row: String,
    pub re: f64,
    pub im: f64,
}

#[derive(Debug, Clone, Serialize)]
pub struct Table {
    pub number: u8,
    pub title: &'static str,
    pub cells: Vec<Cell>,
    pub unprinted: Vec<Unprinted>,
    /// Geometric means of the two real zeros, which eqs (3)-(4) do give (erratum 14).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub means: Vec<Cell>,
}

impl Table {
    /// Adds the numbers of the best fit with one inertia and free stations.
    pub fn beside(mut self, best: Self) -> Self {
        for (cell, best) in self.cells.iter_mut().zip(best.cells) {
            cell.best = best.ours;
        }
        for (mean, best) in self.means.iter_mut().zip(best.means) {
            mean.best = best.ours;
        }
        self
    }
}

const VEHICLE: &str = "one vehicle";
const UNEQUAL: &str = "unequal pair";
const DAMPING: &str = "structural damping";
const SENSOR: &str = "where gamma is read";
const RATES: &str = "small difference";
const STIFFNESS: &str = "elastic coefficients";
const BALANCE: &str = "balanced forces";
const PHUGOID: &str = "scale height";
const NEUTRAL: &str = "nearly neutral";

/// Short and full text of each reason.
pub const REASONS: [(&str, &str); 9] = [
    (
        VEHICLE,
        "three columns share one inertia, one shift of the mass centre and one set of tanks, but would need \
         slightly different ones (\"Where the printed digits come from\"). The published inertia fits none of \
         them (erratum 3).",
    ),
    (
        UNEQUAL,
        "the printed pair is unequal; eqs (3)-(4) give a nearly symmetric pair, exactly symmetric \
         without a beam (erratum 14). The geometric mean is compared below the table.",
    ),
    (
        DAMPING,
        "the paper does not print its structural damping. One ratio per mode is used for both columns, and \
         the aerodynamic damping is derived from the mode shapes (erratum 17).",
    ),
    (
        SENSOR,
        "the frequency of a zero depends on where on the body gamma is read and on how elevator and fuel \
         excite the mode. The paper states neither: the station is identified, the modal forces are derived \
         (erratum 17).",
    ),
    (
        RATES,
        "the real part of a zero is a small difference between sensor and control influence, and far more \
         sensitive to both than its frequency. It is shown but not identified.",
    ),
    (
        STIFFNESS,
        "the aerodynamic stiffness of a mode is derived, as C^eta and N_i were not found (erratum 17). It \
         lowers the frequency of the first mode. The printed frequency is higher with air, 23.34 in Table 1 and \
         23.78 in Table 2, but not that of the even column.",
    ),
    (BALANCE, "the real part is the small remainder of forces that balance in trim."),
    (
        PHUGOID,
        "see erratum 13. Elasticity lowers the frequency by far less than in the printed values.",
    ),
    (
        NEUTRAL,
        "all forces are proportional to dynamic pressure, so a flight at constant dynamic pressure is \
         neutrally stable except for gravity and the static deflection (erratum 15).",
    ),
];

struct Builder {
    cells: Vec<Cell>,
    column: &'static str,
}

impl Builder {
    fn put(&mut self, row: String, paper: f64, ours: Option<f64>, verdict: Verdict) {
        let difference = ours.and_then(|ours| difference(paper, ours));
        let column = self.column;
        self.cells.push(Cell { row, column, paper, ours, difference, best: None, verdict });
    }

    fn compare(&mut self, row: String, paper: f64, ours: Option<f64>, because: &str) {
        let aim = match &row {
            row if row.ends_with("mode") => Aim::Identified,
            row if row.ends_with("imaginary part") => Aim::Frequency,
            row if row.ends_with("real part") => Aim::Damping,
            _ => Aim::Real,
        };
        let signed = matches!(aim, Aim::Damping | Aim::Real);
        self.put(row, paper, ours, Verdict::of(paper, ours, aim, signed, because));
    }

    /// Compares a real root; an oscillating one has no counterpart.
    fn real(&mut self, roots: &[Root], row: &str, name: Name, paper: f64, because: &str) {
        let ours = find(roots, name).filter(|root| root.value.im == 0.0).map(|root| root.value.re);
        let because = if ours.is_some() { because } else { "ours is an oscillating pair" };
        self.compare(row.into(), paper, ours, because);
    }

    fn pairs(&mut self, roots: &[Root], pairs: &[[f64; 2]], because: [&str; 2]) {
        for (i, [re, im]) in pairs.iter().enumerate() {
            let name = Name::Flexible(i);
            let ours = find(roots, name).map(|root| root.value);
            self.compare(format!("{name}, real part"), *re, ours.map(|v| v.re), because[0]);
            self.compare(format!("{name}, imaginary part"), *im, ours.map(|v| v.im), because[1]);
        }
    }
}

fn unprinted(roots: &[Root]) -> Vec<Unprinted> {
    let slosh = |root: &&Root| matches!(root.name, Some(Name::Slosh(_)));
    let row = |root: &Root| root.name.map_or_else(String::new, |name| name.to_string());
    roots
        .iter()
        .filter(slosh)
        .map(|root| Unprinted { row: row(root), re: root.value.re, im: root.value.im })
        .collect()
}

/// Rounds to the printed digits.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// The right and the left real zero.
pub fn real_zeros(zeros: &[Root]) -> Option<[f64; 2]> {
    real_pair(zeros, [Name::RightZero, Name::LeftZero])
}

/// The unstable and the stable pole of the short period.
pub fn short_period(poles: &[Root]) -> Option<[f64; 2]> {
    real_pair(poles, [Name::UnstableShortPeriod, Name::StableShortPeriod])
}

fn real_pair(roots: &[Root], names: [Name; 2]) -> Option<[f64; 2]> {
    let [right, left] = names.map(|name| find(roots, name).map(|root| root.value));
    let (right, left) = (right?, left?);
    (right.im == 0.0 && left.im == 0.0).then_some([right.re, left.re])
}

/// Natural frequencies; they depend on no coefficient set.
pub fn table1(printed: &Table1, points: &[OperatingPoint; 3]) -> Table {
    let mut cells = Vec::new();
    for ((column, printed), point) in
        COLUMNS[1..].iter().zip([&printed.even, &printed.slosh]).zip(&points[1..])
    {
        let mut builder = Builder { cells: Vec::new(), column };
        for (i, paper) in printed.iter().enumerate() {
            let row = format!("{} mode", ahv_tool::modes::ordinal(i));
            builder.compare(
                row,
                *paper,
                Some(point.vehicle.omega[i]),
                "not met by the identification",
            );
        }
        cells.extend(builder.cells);
    }
    Table {
        number: 1,
        title: "Natural frequencies, rad/s",
        cells,
        unprinted: Vec::new(),
        means: Vec::new(),
    }
}

pub fn table2(printed: &Columns<Poles>, points: &[OperatingPoint; 3]) -> Table {
    let mut cells = Vec::new();
    for ((column, printed), point) in COLUMNS.into_iter().zip(printed.all()).zip(points) {
        let rigid = column == COLUMNS[0];
        let mut builder = Builder { cells: Vec::new(), column };
        let poles = &point.poles;
        let phugoid = find(poles, Name::Phugoid).map(|root| root.value);
        let [re, im] = printed.long_term;
        builder.compare("long term, real part".into(), re, phugoid.map(|v| v.re), BALANCE);
        let row = "long term, imaginary part".to_string();
        let ours = phugoid.map(|v| v.im);
        match rigid {
            true => builder.put(row, im, ours, Verdict::Impossible { erratum: 13 }),
            false => builder.compare(row, im, ours, PHUGOID),
        }
        for (name, paper) in
            [Name::UnstableShortPeriod, Name::StableShortPeriod].into_iter().zip(printed.short_term)
        {
            builder.real(poles, &name.to_string(), name, paper, VEHICLE);
        }
        let height = find(poles, Name::Height).map(|root| root.value.re);
        match rigid {
            true => {
                let verdict = Verdict::Impossible { erratum: 15 };
                builder.put("height".into(), printed.height, height, verdict);
            }
            false => builder.compare("height".into(), printed.height, height, NEUTRAL),
        }
        builder.pairs(poles, &printed.aeroelastic, [DAMPING, STIFFNESS]);
        cells.extend(builder.cells);
    }
    Table {
        number: 2,
        title: "Poles at Mach 8 and 25.9 km, rad/s",
        cells,
        unprinted: unprinted(&points[2].poles),
        means: Vec::new(),
    }
}

pub fn table3(printed: &Columns<Zeros>, points: &[OperatingPoint; 3]) -> Table {
    let (mut cells, mut means) = (Vec::new(), Vec::new());
    for ((column, printed), point) in COLUMNS.into_iter().zip(printed.all()).zip(points) {
        let rigid = column == COLUMNS[0];
        let mut builder = Builder { cells: Vec::new(), column };
        let zeros = &point.zeros;
        for (name, paper) in
            [Name::RightZero, Name::LeftZero, Name::ZeroAtOrigin].into_iter().zip(printed.real)
        {
            if rigid && paper != 0.0 {
                let ours = find(zeros, name).map(|root| root.value.re);
                let verdict = Verdict::Impossible { erratum: 14 };
                builder.put(name.to_string(), paper, ours, verdict);
            } else {
                builder.real(zeros, &name.to_string(), name, paper, UNEQUAL);
            }
        }
        builder.pairs(zeros, &printed.aeroelastic, [RATES, SENSOR]);
        cells.extend(builder.cells);
        let mut builder = Builder { cells: Vec::new(), column };
        let [right, left, _] = printed.real;
        let ours = real_zeros(zeros).map(size);
        builder.compare(column.into(), rounded(size([right, left])), ours, VEHICLE);
        means.extend(builder.cells);
    }
    Table {
        number: 3,
        title: "Transmission zeros from [δe, φ] to [V, γ], rad/s",
        cells,
        unprinted: unprinted(&points[2].zeros),
        means,
    }
}
