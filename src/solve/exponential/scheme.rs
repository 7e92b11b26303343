//! Stages of the exponential method, and the Lagrange polynomials through their sources.

use std::ops::Range;

/// Stages beyond x0.
pub(super) const STAGES: usize = 10;
/// Inner points of the Lobatto rules with four and six points, on [0, 1].
const LOBATTO_4: [f64; 2] = [0.276_393_202_250_021, 0.723_606_797_749_979];
const LOBATTO_6: [f64; 4] = [
    0.117_472_338_035_267_66,
    0.357_384_241_759_677_4,
    0.642_615_758_240_322_6,
    0.882_527_661_964_732_4,
];
/// Nodes c_i of the stages.
pub(super) const NODES: [f64; STAGES] = [
    2.0 / 3.0,
    1.0,
    LOBATTO_4[0],
    LOBATTO_4[1],
    1.0,
    LOBATTO_6[0],
    LOBATTO_6[1],
    LOBATTO_6[2],
    LOBATTO_6[3],
    1.0,
];
/// Stages whose D each stage interpolates.
pub(super) const SOURCES: [&[usize]; STAGES] = [
    &[],
    &[0],
    &[0, 1],
    &[1, 2],
    &[2, 3, 1],
    &[2, 3, 4],
    &[2, 3, 4, 5],
    &[3, 4, 5, 6],
    &[4, 5, 6, 7],
    &[5, 6, 7, 8, 4],
];
/// Last stages of the three rungs, at which a step may end.
pub(super) const ENDS: [usize; 3] = [1, 4, 9];
/// Stages of the first two rungs, of which a step of moderate accuracy needs no others, and of the third.
pub(super) const COARSE: Range<usize> = 0..ENDS[1] + 1;
pub(super) const FINE: Range<usize> = ENDS[1] + 1..STAGES;
/// Largest degree of an interpolating polynomial of these stages.
pub(super) const COARSE_DEGREE: usize = degree(COARSE);
pub(super) const FINE_DEGREE: usize = degree(FINE);

const fn degree(stages: Range<usize>) -> usize {
    let (mut largest, mut stage) = (0, stages.start);
    while stage < stages.end {
        if SOURCES[stage].len() > largest {
            largest = SOURCES[stage].len();
        }
        stage += 1;
    }
    largest
}

/// Index of the first weight of each stage, and the number of weights: each stage has one weight for F0
/// and one for each source.
pub(super) const ROWS: [usize; STAGES + 1] = {
    let (mut rows, mut row) = ([0; STAGES + 1], 0);
    while row < STAGES {
        rows[row + 1] = rows[row] + 1 + SOURCES[row].len();
        row += 1;
    }
    rows
};

/// Coefficients of theta, theta^2, ... of the Lagrange polynomial l_j of source `j`: 1 at its node, 0 at those
/// of the other sources and at theta = 0.
pub(super) const fn lagrange(sources: &[usize], j: usize) -> [f64; FINE_DEGREE] {
    let mut coefficients = [0.0; FINE_DEGREE];
    coefficients[0] = 1.0 / NODES[j];
    let mut i = 0;
    while i < sources.len() {
        if sources[i] != j {
            let other = NODES[sources[i]];
            let per = 1.0 / (NODES[j] - other);
            let mut k = FINE_DEGREE - 1;
            while k > 0 {
                coefficients[k] = per * (coefficients[k - 1] - other * coefficients[k]);
                k -= 1;
            }
            coefficients[0] *= -other * per;
        }
        i += 1;
    }
    coefficients
}

/// Coefficients of the Lagrange polynomials of all sources of all stages, indexed as [`ROWS`] less the stage: a weight for
/// F0 has none.
pub(super) const BASES: [[f64; FINE_DEGREE]; ROWS[STAGES] - STAGES] = {
    let (mut bases, mut stage, mut next) = ([[0.0; FINE_DEGREE]; ROWS[STAGES] - STAGES], 0, 0);
    while stage < STAGES {
        let mut source = 0;
        while source < SOURCES[stage].len() {
            bases[next] = lagrange(SOURCES[stage], SOURCES[stage][source]);
            next += 1;
            source += 1;
        }
        stage += 1;
    }
    bases
};
