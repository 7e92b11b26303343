//! Tracks poles and zeros through a sweep.

use super::roots::Root;

/// Modal assurance criterion of two motions: 1 if they are the same, 0 if they share no energy.
pub fn assurance(a: &Root, b: &Root) -> f64 {
    a.direction.dotc(&b.direction).norm_sqr()
}

/// Distance of two roots of neighbouring steps, in eigenvector and value. Neither alone is enough: crossing modes
/// have equal values, the halves of a pair equal eigenvectors.
fn distance(a: &Root, b: &Root) -> f64 {
    /// Roots closer than this count as equal, rad/s.
    const ORIGIN: f64 = 1e-3;
    let apart = (a.value - b.value).norm() / (a.frequency() + b.frequency() + ORIGIN);
    (1.0 - assurance(a, b)) + 2.0 * apart
}

/// For every root of `from` the index of its continuation in `to`, matching the nearest pairs first.
pub fn matches(from: &[Root], to: &[Root]) -> Vec<Option<usize>> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::with_capacity(from.len() * to.len());
    for (i, a) in from.iter().enumerate() {
        pairs.extend(to.iter().enumerate().map(|(k, b)| (distance(a, b), i, k)));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut next = vec![None; from.len()];
    let mut taken = vec![false; to.len()];
    for (_, i, k) in pairs {
        if next[i].is_none() && !taken[k] {
            next[i] = Some(k);
            taken[k] = true;
        }
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Complex, DVector};

    fn root(value: Complex<f64>, motion: [f64; 2]) -> Root {
        let direction = DVector::from_iterator(2, motion.map(Complex::from)).normalize();
        Root { value, name: None, direction, elastic: 1.0, slosh: 0.0 }
    }

    /// Two oscillators, sorted by frequency; the first rises through the second.
    fn step(first: f64) -> Vec<Root> {
        let mut roots = vec![
            root(Complex::new(-0.1, first), [1.0, 0.05]),
            root(Complex::new(-0.1, 5.0), [-0.05, 1.0]),
        ];
        roots.sort_by(|a, b| a.value.im.total_cmp(&b.value.im));
        roots
    }

    #[test]
    fn branches_go_through_a_crossing() {
        let mut roots = step(4.0);
        let mut place = 0;
        for number in 1..=20 {
            let next = step(4.0 + 0.1 * f64::from(number) + 1e-3);
            place = matches(&roots, &next)[place].unwrap();
            roots = next;
        }
        assert_eq!(place, 1, "sorting would have left the branch in the first place");
        assert!((roots[place].value.im - 6.001).abs() < 1e-12);
    }

    #[test]
    fn halves_of_a_pair_are_not_mixed_up() {
        let pair =
            [root(Complex::new(-1.0, 3.0), [1.0, 0.0]), root(Complex::new(-1.0, -3.0), [1.0, 0.0])];
        let next =
            [root(Complex::new(-1.1, -3.1), [1.0, 0.0]), root(Complex::new(-1.1, 3.1), [1.0, 0.0])];
        assert_eq!(matches(&pair, &next), [Some(1), Some(0)]);
    }
}
