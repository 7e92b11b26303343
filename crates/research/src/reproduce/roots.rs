//! Poles and zeros with their eigenvectors and names.

use super::eigenvectors::direction;
use ahv::structure::FLEXIBLE;
use nalgebra::{Complex, DMatrix, DVector};
use serde::{Serialize, Serializer};
use std::fmt;

/// Name of a pole or zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Name {
    Phugoid,
    Height,
    UnstableShortPeriod,
    StableShortPeriod,
    RightZero,
    LeftZero,
    ZeroAtOrigin,
    /// Aeroelastic, counted from 0.
    Flexible(usize),
    /// Sloshing, counted from 0.
    Slosh(usize),
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let ordinal = ahv_tool::modes::ordinal;
        match self {
            Self::Phugoid => write!(f, "long term"),
            Self::Height => write!(f, "height"),
            Self::UnstableShortPeriod => write!(f, "short term, unstable"),
            Self::StableShortPeriod => write!(f, "short term, stable"),
            Self::RightZero => write!(f, "real zero, right"),
            Self::LeftZero => write!(f, "real zero, left"),
            Self::ZeroAtOrigin => write!(f, "real zero, origin"),
            Self::Flexible(i) => write!(f, "{} aeroelastic", ordinal(*i)),
            Self::Slosh(i) => write!(f, "{} slosh", ordinal(*i)),
        }
    }
}

impl Serialize for Name {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// A pole or zero.
#[derive(Debug, Clone)]
pub struct Root {
    pub value: Complex<f64>,
    /// `None` for the lower half of a pair.
    pub name: Option<Name>,
    /// Unit vector of mass-weighted velocities, so that products of two directions do not depend on the
    /// coordinates.
    pub direction: DVector<Complex<f64>>,
    /// Elastic share of the kinetic energy.
    pub elastic: f64,
    /// Sloshing share of the elastic kinetic energy.
    pub slosh: f64,
}

/// Maps states to mass-weighted velocities: three of the rigid motion; of the modes, the mean motion of the body,
/// its bending, and the sloshing masses.
#[derive(Debug, Clone)]
pub struct Metric {
    pub matrix: DMatrix<f64>,
    /// Rows of the sloshing masses, the last ones.
    pub sloshing: usize,
}

/// Rows of the rigid motion.
pub const RIGID_ROWS: usize = 3;
/// Rows of the body's mean translation and rotation in the modes.
pub const BODY_ROWS: usize = 2;

impl Root {
    fn new(matrix: &DMatrix<f64>, metric: &Metric, value: Complex<f64>) -> Self {
        let motion = direction(matrix, value);
        let velocity = metric.matrix.map(Complex::from) * motion;
        let size = velocity.norm();
        // A motion without velocity, such as a constant height, has no direction.
        let direction = if size > 0.0 { velocity.unscale(size) } else { velocity };
        let energy = |rows: std::ops::Range<usize>| -> f64 {
            direction.as_slice()[rows].iter().map(|entry| entry.norm_sqr()).sum()
        };
        let count = direction.len();
        let elastic = energy(RIGID_ROWS..count);
        let slosh = energy(count - metric.sloshing..count);
        let slosh = if elastic > 0.0 { slosh / elastic } else { 0.0 };
        Self { value, name: None, direction, elastic, slosh }
    }

    pub fn frequency(&self) -> f64 {
        self.value.norm()
    }
}

/// Eigenvalues of a matrix with directions in a metric, without names.
pub fn roots(matrix: &DMatrix<f64>, values: &[Complex<f64>], metric: &Metric) -> Vec<Root> {
    values.iter().map(|&value| Root::new(matrix, metric, value)).collect()
}

/// Names the elastic pairs, and returns the indices of all others, fastest first. Elastic are the pairs with the
/// most elastic energy, as many as there are modes; of these, the slosh modes have the most sloshing energy.
/// A missing pair counts as flexible: with a sensor on the body, its zeros can be two fast real ones.
fn name_elastic(roots: &mut [Root], flexible: usize, slosh: usize) -> Vec<usize> {
    let upper = |i: &usize| roots[*i].value.im > 0.0;
    let mut pairs: Vec<usize> = (0..roots.len()).filter(upper).collect();
    pairs.sort_by(|&a, &b| roots[b].elastic.total_cmp(&roots[a].elastic));
    pairs.truncate(flexible + slosh);
    pairs.sort_by(|&a, &b| roots[a].slosh.total_cmp(&roots[b].slosh));
    let split = pairs.len().saturating_sub(slosh);
    let (beam, liquid) = pairs.split_at_mut(split);
    for (part, name) in [(beam, Name::Flexible as fn(usize) -> Name), (liquid, Name::Slosh)] {
        part.sort_by(|&a, &b| roots[a].frequency().total_cmp(&roots[b].frequency()));
        for (number, &i) in part.iter().enumerate() {
            roots[i].name = Some(name(number));
        }
    }
    let rigid = |i: &usize| roots[*i].name.is_none() && roots[*i].value.im >= 0.0;
    let mut rest: Vec<usize> = (0..roots.len()).filter(rigid).collect();
    let frequency = |i: usize| roots[i].frequency();
    rest.sort_by(|&a, &b| frequency(b).total_cmp(&frequency(a)));
    // The lower half of an elastic pair has no name and is not a rigid motion.
    rest
}

/// Names poles. Of the five rigid-body poles the fastest two are the short period, the slowest pair is
/// the phugoid, and the remaining real one is the height mode.
pub fn name_poles(roots: &mut [Root], slosh: usize, flexible: bool) {
    let rest = name_elastic(roots, if flexible { FLEXIBLE } else { 0 }, slosh);
    for (rank, &i) in rest.iter().enumerate() {
        let value = roots[i].value;
        let fast = rank == 0 || (rank == 1 && roots[rest[0]].value.im == 0.0);
        roots[i].name = Some(match (fast, value.im > 0.0) {
            (true, true) => Name::UnstableShortPeriod,
            (true, false) if value.re > 0.0 => Name::UnstableShortPeriod,
            (true, false) => Name::StableShortPeriod,
            (false, true) => Name::Phugoid,
            (false, false) => Name::Height,
        });
    }
}

/// Names zeros. Of the slowest three rigid-body zeros, the slowest is that of the height. Faster ones come
/// from a flexible mode and have no counterpart in the paper.
pub fn name_zeros(roots: &mut [Root], slosh: usize, flexible: bool) {
    let rest = name_elastic(roots, if flexible { FLEXIBLE } else { 0 }, slosh);
    let rest = &rest[rest.len().saturating_sub(RIGID_ZEROS)..];
    for (rank, &i) in rest.iter().enumerate() {
        roots[i].name = Some(match (rank + 1 == rest.len(), roots[i].value.re > 0.0) {
            (true, _) => Name::ZeroAtOrigin,
            (false, true) => Name::RightZero,
            (false, false) => Name::LeftZero,
        });
    }
}

/// Number of zeros of a rigid body: its five states minus V and gamma.
const RIGID_ZEROS: usize = 3;

/// The root with a name.
pub fn find(roots: &[Root], name: Name) -> Option<&Root> {
    roots.iter().find(|root| root.name == Some(name))
}
