//! Tables 1 to 3, cell by cell.

use super::point::Point;
use super::roots::{Name, Root, find};
use super::verdict::{Aim, Verdict, difference};
use crate::published::{Columns, Poles, Table1, Zeros};
use serde::Serialize;

pub const COLUMNS: [&str; 3] = ["rigid body", "even mass", "sloshing mass"];

/// A printed number beside ours, rad/s.
#[derive(Debug, Clone, Serialize)]
pub struct Cell {
    pub row: String,
    pub column: &'static str,
    pub paper: f64,
    pub ours: Option<f64>,
    /// ours/paper - 1.
    pub difference: Option<f64>,
    /// The best that implausible numbers can do: the far end of the trade-off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub far: Option<f64>,
    #[serde(flatten)]
    pub verdict: Verdict,
}

/// A mode of ours that the paper does not print.
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
}

impl Table {
    /// Puts the far end of the trade-off beside our numbers.
    pub fn beside(mut self, far: Self) -> Self {
        for (cell, far) in self.cells.iter_mut().zip(far.cells) {
            cell.far = far.ours;
        }
        self
    }
}

const INERTIA: &str = "one inertia, small jump";
const DAMPING: &str = "structural damping";
const DRIVE: &str = "drive of the mode";
const STIFFNESS: &str = "elastic coefficients";
const BALANCE: &str = "balanced forces";
const PHUGOID: &str = "scale height";
const NEUTRAL: &str = "nearly neutral";

/// The reasons in full.
pub const REASONS: [(&str, &str); 7] = [
    (
        INERTIA,
        "the size of the short period and of the real zeros goes with 1/sqrt(I_yy). Neither printed \
         nor published I_yy gives the printed poles (erratum 3). Where a set has an identified one, \
         it serves three columns at once, and elastic terms derived from rigid fits give too little \
         of the printed jump from rigid to flexible (erratum 20).",
    ),
    (
        DAMPING,
        "the paper does not print its structural damping; what the air adds to it is derived here \
         from the mode shapes, not fitted (erratum 17).",
    ),
    (
        DRIVE,
        "a zero lies where elevator and fuel leave V and gamma alone, so its place is decided by how \
         the controls drive the mode. Those coefficients are not public (erratum 17). The printed zeros of the even \
         column contradict its poles (erratum 19).",
    ),
    (
        STIFFNESS,
        "the air's stiffness on a mode is derived, since C^eta and N_i are not public (erratum 17).",
    ),
    (
        BALANCE,
        "the real part is what is left of forces that balance in trim: small beside any of them.",
    ),
    (
        PHUGOID,
        "erratum 13 again. Elasticity lowers the frequency by far less than the printed values ask.",
    ),
    (
        NEUTRAL,
        "all forces go with dynamic pressure, so flight along a line of equal dynamic pressure is \
         neutral but for gravity and the static deflection (erratum 15).",
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
        self.cells.push(Cell { row, column, paper, ours, difference, far: None, verdict });
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

    /// A real root of ours; one that oscillates is no counterpart.
    fn real(&mut self, roots: &[Root], row: &str, name: Name, paper: f64, because: &str) {
        let ours = find(roots, name).filter(|root| root.value.im == 0.0).map(|root| root.value.re);
        let because = if ours.is_some() { because } else { "ours is a pair that oscillates" };
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

/// Natural frequencies; they depend on no coefficient set.
pub fn table1(printed: &Table1, points: &[Point; 3]) -> Table {
    let mut cells = Vec::new();
    for ((column, printed), point) in
        COLUMNS[1..].iter().zip([&printed.even, &printed.slosh]).zip(&points[1..])
    {
        let mut builder = Builder { cells: Vec::new(), column };
        for (i, paper) in printed.iter().enumerate() {
            let row = format!("{} mode", crate::modes::ordinal(i));
            builder.compare(
                row,
                *paper,
                Some(point.vehicle.omega[i]),
                "the identification misses it",
            );
        }
        cells.extend(builder.cells);
    }
    Table { number: 1, title: "Natural frequencies, rad/s", cells, unprinted: Vec::new() }
}

pub fn table2(printed: &Columns<Poles>, points: &[Point; 3]) -> Table {
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
            builder.real(poles, &name.to_string(), name, paper, INERTIA);
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
    }
}

pub fn table3(printed: &Columns<Zeros>, points: &[Point; 3]) -> Table {
    let mut cells = Vec::new();
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
                builder.real(zeros, &name.to_string(), name, paper, INERTIA);
            }
        }
        builder.pairs(zeros, &printed.aeroelastic, [DRIVE, DRIVE]);
        cells.extend(builder.cells);
    }
    Table {
        number: 3,
        title: "Transmission zeros from [δe, φ] to [V, γ], rad/s",
        cells,
        unprinted: unprinted(&points[2].zeros),
    }
}
