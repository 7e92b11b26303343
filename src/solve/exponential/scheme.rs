//! The stages of the exponential method: when they are, and what each is made of.

/// Stages after the first.
pub(super) const STAGES: usize = 4;
/// Inner Lobatto points, (1 -+ 1/sqrt 5)/2.
pub(super) const LOBATTO: [f64; 2] = [0.276_393_202_250_021, 0.723_606_797_749_979];
/// Times of the stages over the step.
pub(super) const NODES: [f64; STAGES] = [2.0 / 3.0, 1.0, LOBATTO[0], LOBATTO[1]];
/// The stage that may end the step.
pub(super) const EARLY: usize = 1;
/// For each stage, and for the step itself, the stages whose D it is made of.
pub(super) const SOURCES: [&[usize]; STAGES + 1] = [&[], &[0], &[0, 1], &[1, 2], &[2, 3, 1]];
/// Where each row of [`SOURCES`] begins among the weights, and where they end: one weight for f(x0) in
/// each row, and one for each source.
pub(super) const ROWS: [usize; STAGES + 2] = {
    let (mut rows, mut row) = ([0; STAGES + 2], 0);
    while row < SOURCES.len() {
        rows[row + 1] = rows[row] + 1 + SOURCES[row].len();
        row += 1;
    }
    rows
};
/// Most sources of a stage.
pub(super) const DEGREE: usize = 3;
/// When a stage is, or the step's end, over the step.
pub(super) fn node(stage: usize) -> f64 {
    *NODES.get(stage).unwrap_or(&1.0)
}

/// Coefficients of s, s^2 and s^3 of the polynomial that is one at the node of `own`, zero at those
/// of the other sources and at 0.
pub(super) const fn course(sources: &[usize], own: usize) -> [f64; DEGREE] {
    let mut coefficients = [1.0 / NODES[own], 0.0, 0.0];
    let mut i = 0;
    while i < sources.len() {
        if sources[i] != own {
            let other = NODES[sources[i]];
            let per = 1.0 / (NODES[own] - other);
            let [a, b, _] = coefficients;
            coefficients = [-other * per * a, per * (a - other * b), per * b];
        }
        i += 1;
    }
    coefficients
}
