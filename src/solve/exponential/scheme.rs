//! Nodes of the exponential method and the Lagrange polynomials of its stages.

/// Stages beyond x0.
pub(super) const STAGES: usize = 4;
/// Inner Lobatto points, (1 -+ 1/sqrt 5)/2.
pub(super) const LOBATTO: [f64; 2] = [0.276_393_202_250_021, 0.723_606_797_749_979];
/// Nodes c_i of the stages.
pub(super) const NODES: [f64; STAGES] = [2.0 / 3.0, 1.0, LOBATTO[0], LOBATTO[1]];
/// Stage at which the step may end.
pub(super) const EARLY: usize = 1;
/// For each stage and for the end of the step, the stages whose D it interpolates.
pub(super) const SOURCES: [&[usize]; STAGES + 1] = [&[], &[0], &[0, 1], &[1, 2], &[2, 3, 1]];
/// Index of the first weight of each row of [`SOURCES`], and the number of weights: each row has one
/// weight for F0 and one for each source.
pub(super) const ROWS: [usize; STAGES + 2] = {
    let (mut rows, mut row) = ([0; STAGES + 2], 0);
    while row < SOURCES.len() {
        rows[row + 1] = rows[row] + 1 + SOURCES[row].len();
        row += 1;
    }
    rows
};
/// Largest degree of an interpolating polynomial.
pub(super) const DEGREE: usize = 3;
/// Node of a stage; 1 for the end of the step.
pub(super) fn node(stage: usize) -> f64 {
    *NODES.get(stage).unwrap_or(&1.0)
}

/// Coefficients of theta, theta^2 and theta^3 of the Lagrange polynomial l_j of source `j`: 1 at its
/// node, 0 at those of the other sources and at theta = 0.
pub(super) const fn lagrange(sources: &[usize], j: usize) -> [f64; DEGREE] {
    let mut coefficients = [1.0 / NODES[j], 0.0, 0.0];
    let mut i = 0;
    while i < sources.len() {
        if sources[i] != j {
            let other = NODES[sources[i]];
            let per = 1.0 / (NODES[j] - other);
            let [a, b, _] = coefficients;
            coefficients = [-other * per * a, per * (a - other * b), per * b];
        }
        i += 1;
    }
    coefficients
}
