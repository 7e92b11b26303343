//! Polynomial interpolation.

use ahv::solve::Chebyshev;

/// Places between the points.
fn places() -> impl Iterator<Item = f64> {
    (0..=97).map(|i| 1.0 - 2.0 * f64::from(i) / 97.0)
}

fn interpolated<const N: usize>(function: impl Fn(f64) -> f64, x: f64) -> [f64; 2] {
    let chebyshev = Chebyshev::<N>::new();
    let values = chebyshev.points.map(function);
    chebyshev.weights(x).map(|weights| weights.iter().zip(values).map(|(w, y)| w * y).sum())
}

fn check_powers<const N: usize>() {
    for power in 0..N as i32 {
        for x in places() {
            let [value, slope] = interpolated::<N>(|x| x.powi(power), x);
            let expected = match power {
                0 => 0.0,
                power => f64::from(power) * x.powi(power - 1),
            };
            let rounding = 1e-15 * (N * N) as f64;
            assert!((value - x.powi(power)).abs() < rounding, "{N}: x^{power} at {x}");
            assert!((slope - expected).abs() < 10.0 * rounding, "{N}: slope of x^{power} at {x}");
        }
    }
}

#[test]
fn verif_polynomials_come_back_with_their_slopes() {
    check_powers::<2>();
    check_powers::<3>();
    check_powers::<8>();
    check_powers::<17>();
}

#[test]
fn verif_the_error_falls_as_the_nearest_pole_says() {
    // 1/(1 + (x/a)^2) has poles at i a and -i a, on the ellipse whose semi-axes add up to rho.
    let a: f64 = 0.75;
    let rho = a + (1.0 + a * a).sqrt();
    let function = |x: f64| 1.0 / (1.0 + (x / a) * (x / a));
    let error = |interpolated: &dyn Fn(f64) -> f64| {
        places().map(|x| (interpolated(x) - function(x)).abs()).fold(0.0, f64::max)
    };
    let coarse = error(&|x| interpolated::<9>(function, x)[0]);
    let fine = error(&|x| interpolated::<17>(function, x)[0]);
    let factor = coarse / fine / rho.powi(8);
    assert!((0.5..2.0).contains(&factor), "{coarse:.1e} to {fine:.1e}: {factor}");
}
