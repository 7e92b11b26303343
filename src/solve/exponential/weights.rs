//! Weights of the stages for a step length.

use super::scheme::{BASES, NODES, ROWS};
use crate::solve::blocks::{Blocks, MatrixFunction, phis};
use std::ops::Range;

/// Of each stage c_i h phi_1(c_i h L), then h a_ij(h L) of each source.
#[derive(Debug, Clone)]
pub(super) struct Weights<const N: usize, const LENGTH: usize> {
    /// Step length they were computed for, s.
    pub h: f64,
    rows: [MatrixFunction<N>; LENGTH],
}

impl<const N: usize, const LENGTH: usize> Weights<N, LENGTH> {
    /// None yet.
    pub const NONE: Self = Self { h: 0.0, rows: [MatrixFunction::ZERO; LENGTH] };

    /// Those of `stage`, where `first` is the first stage that has weights here.
    #[inline(always)]
    pub fn of(&self, stage: usize, first: usize) -> &[MatrixFunction<N>] {
        &self.rows[ROWS[stage] - ROWS[first]..ROWS[stage + 1] - ROWS[first]]
    }

    /// Computes those of some stages for steps of length `h`, s; PHIS is the number of functions phi_k that they
    /// need.
    #[inline(always)]
    pub fn prepare<const PHIS: usize>(&mut self, stages: Range<usize>, linear: &Blocks<N>, h: f64) {
        if self.h == h {
            return;
        }
        self.h = h;
        let full = monomials::<N, PHIS>(linear, h, 1.0);
        let first = ROWS[stages.start];
        for stage in stages {
            let integrals = match NODES[stage] {
                1.0 => full,
                node => monomials(linear, h, node),
            };
            let (row, end) = (ROWS[stage], ROWS[stage + 1]);
            self.rows[row - first] = integrals[0];
            let weights = self.rows[row - first + 1..end - first].iter_mut();
            for (weight, basis) in weights.zip(&BASES[row - stage..]) {
                *weight = MatrixFunction::ZERO;
                for (factor, integral) in basis.iter().zip(&integrals[1..]) {
                    weight.add(*factor, integral);
                }
            }
        }
    }
}

/// Integrals from 0 to c h of exp((c h - s) L) (s/h)^k ds = h c^(k+1) k! phi_(k+1)(c h L), k = 0, 1, ...
#[inline(always)]
fn monomials<const N: usize, const PHIS: usize>(
    linear: &Blocks<N>,
    h: f64,
    c: f64,
) -> [MatrixFunction<N>; PHIS] {
    let mut factor = h;
    let phis = phis::<N, PHIS>(linear, c * h);
    std::array::from_fn(|k| {
        factor *= c * k.max(1) as f64;
        phis[k].scaled(factor)
    })
}
