//! Dense symmetric positive definite eigenproblems by the cyclic Jacobi method.
//!
//! Each rotation in the plane (p, q) annihilates a_pq:
//!
//! ```text
//! zeta = (a_qq - a_pp) / (2 a_pq),   t = sign(zeta) / (|zeta| + sqrt(1 + zeta^2))
//! c = 1 / sqrt(1 + t^2),   s = t c
//! a_pp <- a_pp - t a_pq,   a_qq <- a_qq + t a_pq
//! ```
//!
//! (Golub, Van Loan, Matrix Computations, 4th ed., section 8.5). Sweeps end when |a_pq| <= eps sqrt(a_pp
//! a_qq) for all p < q: then small eigenvalues of a graded matrix, such as those of fast flexible modes
//! beside slow slosh modes, have the same relative accuracy as large ones, unlike with QR (Demmel,
//! Veselic, Jacobi's method is more accurate than QR, SIAM J. Matrix Anal. Appl. 13(4), 1992, 1204-1245).
//! Only `+ - * / sqrt` occur: the same bits on every platform.

/// Limit of sweeps; seven or eight are usual.
const MAX_SWEEPS: usize = 40;

/// Eigenvalues, largest first, each with its unit eigenvector.
pub(super) fn eigen(mut a: Vec<Vec<f64>>) -> Vec<(f64, Vec<f64>)> {
    let n = a.len();
    let mut vectors: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|k| if i == k { 1.0 } else { 0.0 }).collect()).collect();
    for _ in 0..MAX_SWEEPS {
        let mut rotated = false;
        for p in 0..n {
            for q in p + 1..n {
                let (app, aqq, apq) = (a[p][p], a[q][q], a[p][q]);
                if apq.abs() <= f64::EPSILON * (app * aqq).abs().sqrt() {
                    continue;
                }
                rotated = true;
                let zeta = (aqq - app) / (2.0 * apq);
                let root = (1.0 + zeta * zeta).sqrt();
                let tangent = 1.0 / (zeta.abs() + root).copysign(zeta);
                let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
                let sine = tangent * cosine;
                for row in &mut a {
                    (row[p], row[q]) = rotate(row[p], row[q], cosine, sine);
                }
                rotate_rows(&mut a, p, q, cosine, sine);
                a[p][p] = app - tangent * apq;
                a[q][q] = aqq + tangent * apq;
                a[p][q] = 0.0;
                a[q][p] = 0.0;
                rotate_rows(&mut vectors, p, q, cosine, sine);
            }
        }
        if !rotated {
            break;
        }
    }
    let mut pairs: Vec<_> = vectors.into_iter().enumerate().map(|(i, v)| (a[i][i], v)).collect();
    pairs.sort_by(|x, y| y.0.total_cmp(&x.0));
    pairs
}

fn rotate(x: f64, y: f64, cosine: f64, sine: f64) -> (f64, f64) {
    (cosine * x - sine * y, sine * x + cosine * y)
}

/// Rotates rows p and q, p < q.
fn rotate_rows(rows: &mut [Vec<f64>], p: usize, q: usize, cosine: f64, sine: f64) {
    let (head, tail) = rows.split_at_mut(q);
    for (x, y) in head[p].iter_mut().zip(&mut tail[0]) {
        (*x, *y) = rotate(*x, *y, cosine, sine);
    }
}
