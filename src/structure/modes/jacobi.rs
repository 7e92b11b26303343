//! Small dense symmetric eigenproblems by Jacobi rotations.
//!
//! Jacobi finds the small eigenvalues of a graded positive definite matrix to as many digits as
//! the large ones (Demmel and Veselic, SIAM J. Matrix Anal. Appl. 13(4), 1992, 1204-1245); QR
//! iterations do not. A slow slosh mode beside a fast flexible one makes such matrices. Only
//! `+ - * / sqrt` occur: the same bits on every platform.

/// Sweeps after which the rotations stop in any case; seven or eight are usual.
const SWEEPS: usize = 40;

/// Eigenvalues, largest first, each with its unit eigenvector.
pub(super) fn eigen(mut a: Vec<Vec<f64>>) -> Vec<(f64, Vec<f64>)> {
    let n = a.len();
    let mut vectors: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|k| if i == k { 1.0 } else { 0.0 }).collect()).collect();
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for p in 0..n {
            for q in p + 1..n {
                let (app, aqq, apq) = (a[p][p], a[q][q], a[p][q]);
                if apq.abs() <= f64::EPSILON * (app * aqq).abs().sqrt() {
                    continue;
                }
                rotated = true;
                let half_cotangent = (aqq - app) / (2.0 * apq);
                let root = (1.0 + half_cotangent * half_cotangent).sqrt();
                let tangent = 1.0 / (half_cotangent.abs() + root).copysign(half_cotangent);
                let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
                let sine = tangent * cosine;
                for row in &mut a {
                    (row[p], row[q]) = turn(row[p], row[q], cosine, sine);
                }
                turn_rows(&mut a, p, q, cosine, sine);
                a[p][p] = app - tangent * apq;
                a[q][q] = aqq + tangent * apq;
                a[p][q] = 0.0;
                a[q][p] = 0.0;
                turn_rows(&mut vectors, p, q, cosine, sine);
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

fn turn(x: f64, y: f64, cosine: f64, sine: f64) -> (f64, f64) {
    (cosine * x - sine * y, sine * x + cosine * y)
}

/// Turns row p into row q; p < q.
fn turn_rows(rows: &mut [Vec<f64>], p: usize, q: usize, cosine: f64, sine: f64) {
    let (head, tail) = rows.split_at_mut(q);
    for (x, y) in head[p].iter_mut().zip(&mut tail[0]) {
        (*x, *y) = turn(*x, *y, cosine, sine);
    }
}
