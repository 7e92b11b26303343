//! The exponential method on small systems: its functions against their recursion, oscillators
//! against closed forms and DOP853.

use ahv::solve::{
    Attempt, Blocks, DOP853, Decoupling, Exponential, Integrator, Method, Outcome, System, Trial,
    phis,
};
use nalgebra::{DMatrix, Matrix4, SMatrix, SVector, Vector4};

/// Two slow states around an oscillator, of which the first is driven by it; states 1 and 2 are the
/// fast ones.
const SLOW: usize = 1;

fn dense(blocks: &Blocks<4>) -> Matrix4<f64> {
    Matrix4::from_columns(&std::array::from_fn::<_, 4, _>(|j| {
        Vector4::from(blocks.times(&std::array::from_fn(|i| f64::from(i == j))))
    }))
}

/// The exponential by its series: 40 terms are plenty, as no eigenvalue here exceeds 2.
fn series(z: Matrix4<f64>) -> Matrix4<f64> {
    let mut term = Matrix4::identity();
    let mut sum = term;
    for k in 1..40 {
        term = term * z / f64::from(k);
        sum += term;
    }
    sum
}

#[test]
fn verif_the_functions_are_those_of_the_exponential() {
    // Damped, undamped and unstable oscillators, two real eigenvalues, a chain, nothing.
    let cases = [
        [0.0, 1.0, -36.0, -1.2],
        [0.0, 1.0, -36.0, 0.0],
        [0.1, 1.0, -9.0, 0.3],
        [-0.5, 1.0, 12.0, -0.4],
        [0.0, 1.0, 0.0, 0.0],
        [0.0; 4],
    ];
    for [a, b, c, d] in cases {
        let blocks = Blocks::<4>::of(|i, j| match (i, j) {
            (1, 1) => a,
            (1, 2) => b,
            (2, 1) => c,
            (2, 2) => d,
            _ => 0.0,
        });
        for t in [1e-6, 0.01, 0.3] {
            let l = dense(&blocks);
            // phi_k = z phi_(k+1) + 1/k!, down to the exponential.
            let functions = phis(&blocks, t).map(|f| {
                Matrix4::from_diagonal(&f.identity.into())
                    + Matrix4::from_diagonal(&f.linear.into()) * l
            });
            let mut below = series(l * t);
            let mut factorial = 1.0;
            for (k, phi) in functions.iter().enumerate() {
                factorial *= k.max(1) as f64;
                let recurred = l * t * phi + Matrix4::identity() / factorial;
                // The entries differ in size by the frequency.
                let scale = below.amax();
                assert!(
                    (recurred - below).amax() < 1e-14 * scale,
                    "phi_{k}, {t} s: {recurred} {below}"
                );
                below = *phi;
            }
        }
    }
}

/// An oscillator with a cubic spring that drives a slow state, and feels it.
struct Duffing {
    stiffening: f64,
}

const OMEGA: f64 = 20.0;

impl System<4> for Duffing {
    fn derivatives(&self, _: f64, x: &[f64; 4]) -> [f64; 4] {
        let force = -OMEGA * OMEGA * (x[1] + self.stiffening * x[1] * x[1] * x[1]);
        [x[1] - 0.1 * self.stiffening * x[0], x[2], force + self.stiffening * x[0], 0.0]
    }
    fn holds(&self, _: f64, _: &[f64; 4]) -> bool {
        true
    }
    fn nominal(&self) -> &[f64; 4] {
        &[1.0, 1.0, OMEGA, 1.0]
    }
}

fn exponential(system: &Duffing) -> Exponential<4, SLOW, 2> {
    let mut jacobian = DMatrix::zeros(3, 3);
    jacobian[(0, 1)] = 1.0;
    jacobian[(1, 2)] = 1.0;
    jacobian[(2, 1)] = -OMEGA * OMEGA;
    Exponential::new(Decoupling::new(&jacobian, system.nominal()))
}

/// One step of some length from a time, a state and its slope.
fn tried(
    method: &mut impl Method<4>,
    system: &impl System<4>,
    [x, slope]: [&[f64; 4]; 2],
    [t, h]: [f64; 2],
    tolerance: f64,
) -> Trial<4> {
    method.trial(&Attempt { system, x, slope, t, h, tolerance })
}

/// The state after 1 s in equal steps, whatever their error: none is below a tolerance of zero, so that
/// none ends early; all are below a huge one.
fn forced(
    method: &mut impl Method<4>,
    system: &impl System<4>,
    steps: u32,
    tolerance: f64,
) -> [f64; 4] {
    let mut x = [0.3, 1.0, 2.0, 0.0];
    for step in 0..steps {
        let [start, end] = [step, step + 1].map(|i| f64::from(i) / f64::from(steps));
        let slope = system.derivatives(start, &x);
        x = tried(method, system, [&x, &slope], [start, end - start], tolerance).next;
    }
    x
}

const EARLY: f64 = 1e9;
const WHOLE: f64 = 0.0;

#[test]
fn verif_linear_oscillators_are_exact_at_any_step() {
    let system = Duffing { stiffening: 0.0 };
    let (sin, cos) = OMEGA.sin_cos();
    let exact = [0.3 + (sin + 0.1 * (1.0 - cos)) / OMEGA, cos + 0.1 * sin, 2.0 * cos - OMEGA * sin];
    for (steps, tolerance) in [(11, EARLY), (11, WHOLE), (40, EARLY), (1000, EARLY), (1000, WHOLE)]
    {
        let x = forced(&mut exponential(&system), &system, steps, tolerance);
        for i in 0..3 {
            assert!(
                (x[i] - exact[i]).abs() < 1e-12 * system.nominal()[i],
                "{steps} steps, state {i}"
            );
        }
    }
}

/// The power of the step by which the errors of 160 and 640 steps differ where the rest is large.
fn order(tolerance: f64) -> f64 {
    let system = Duffing { stiffening: 0.5 };
    let exact = forced(&mut &DOP853, &system, 4000, EARLY);
    let error = |steps| {
        let x = forced(&mut exponential(&system), &system, steps, tolerance);
        (0..3).map(|i| ((x[i] - exact[i]) / system.nominal()[i]).abs()).fold(0.0, f64::max)
    };
    (error(160) / error(640)).log2() / 2.0
}

#[test]
fn verif_a_whole_step_converges_with_order_four_or_more_where_the_rest_is_large() {
    // The stages' share of a step's error falls with the fourth power of the step, that of the
    // quadrature with the sixth.
    let order = order(WHOLE);
    assert!((3.9..6.5).contains(&order), "order {order}");
}

#[test]
fn verif_an_early_end_converges_with_order_two_or_more_where_the_rest_is_large() {
    let order = order(EARLY);
    assert!((2.8..4.5).contains(&order), "order {order}");
}

#[test]
fn verif_the_error_found_is_no_less_than_that_of_the_step() {
    let system = Duffing { stiffening: 0.5 };
    let (start, tolerance) = ([0.3, 1.0, 2.0, 0.0], 1e-6);
    let slope = system.derivatives(0.0, &start);
    let [mut early, mut whole] = [0, 0];
    for halvings in 3..20 {
        let h = 0.5_f64.powi(halvings);
        let attempt = Attempt { system: &system, x: &start, slope: &slope, t: 0.0, h, tolerance };
        let step = exponential(&system).trial(&attempt);
        let exact = (0..64).fold(start, |x, i| {
            let slope = system.derivatives(0.0, &x);
            let step = [h * f64::from(i) / 64.0, h / 64.0];
            tried(&mut &DOP853, &system, [&x, &slope], step, tolerance).next
        });
        let rates = std::array::from_fn(|i| (step.next[i] - exact[i]) / h);
        let error = attempt.error(&exact, &rates);
        *if step.order == 3 { &mut early } else { &mut whole } += 1;
        // Rounding is a few 1e-10 of this tolerance.
        assert!(error < step.error + 1e-6, "{h} s: {error}, found {}", step.error);
    }
    assert!(early > 2 && whole > 2, "{early} steps ended early, {whole} did not");
}

/// The linear oscillator with a force t^power on every state.
struct Forced {
    power: i32,
}

impl System<4> for Forced {
    fn derivatives(&self, t: f64, x: &[f64; 4]) -> [f64; 4] {
        let force = t.powi(self.power);
        [x[1] + force, x[2] + force, OMEGA * (force - OMEGA * x[1]), 0.0]
    }
    fn holds(&self, _: f64, _: &[f64; 4]) -> bool {
        true
    }
    fn nominal(&self) -> &[f64; 4] {
        &[1.0, 1.0, OMEGA, 1.0]
    }
}

#[test]
fn verif_polynomial_residuals_are_exact() {
    // The stiff order conditions sum_j b_j(z) c_j^k / k! = phi_(k+1)(z) at z = 1.25i: for k up to 3 in a
    // full step, up to 1 in one that ends at its second stage, and for no k beyond.
    for (tolerance, highest) in [(WHOLE, 3), (EARLY, 1)] {
        for power in 0..=highest + 1 {
            let system = Forced { power };
            let mut method = exponential(&Duffing { stiffening: 0.0 });
            let ours = forced(&mut method, &system, 16, tolerance);
            let exact = forced(&mut &DOP853, &system, 1000, EARLY);
            let error = (0..3)
                .map(|i| ((ours[i] - exact[i]) / system.nominal()[i]).abs())
                .fold(0.0, f64::max);
            assert_eq!(error < 1e-12, power <= highest, "t^{power}, {tolerance}: {error:e}");
        }
    }
}

/// x' = x in each state.
struct Dahlquist;

impl System<4> for Dahlquist {
    fn derivatives(&self, _: f64, x: &[f64; 4]) -> [f64; 4] {
        *x
    }
    fn holds(&self, _: f64, _: &[f64; 4]) -> bool {
        true
    }
    fn nominal(&self) -> &[f64; 4] {
        &[1.0; 4]
    }
}

#[test]
fn verif_the_classical_order_is_three_and_two() {
    // Without a linear part this is a Runge-Kutta method. Of its polynomial R(z) the coefficient of z^4 is
    // b A A c = 1/24 - 2/9 (3/4 b_1 + b_2 a_20), as stage 0 has order 1 and the others order 2.
    let (z, x) = (0.5_f64.powi(7), [1.0; 4]);
    let step = |tolerance: f64| {
        let linear = Decoupling::<4, SLOW, 2>::new(&DMatrix::zeros(3, 3), Dahlquist.nominal());
        tried(&mut Exponential::new(linear), &Dahlquist, [&x, &x], [0.0, z], tolerance).next[1]
    };
    let second_order = 1.0 + z + z * z / 2.0;
    assert!((step(EARLY) - second_order).abs() < 1e-15);
    let c = (1.0 - 0.2_f64.sqrt()) / 2.0;
    let a20 = 4.5 * c * c * (0.5 - c / 3.0);
    let expected = 1.0 / 24.0 - 2.0 / 9.0 * (0.75 / 12.0 + 5.0 / 12.0 * a20);
    let fourth = (step(WHOLE) - second_order - z.powi(3) / 6.0) / z.powi(4);
    assert!((fourth - expected).abs() < 1e-4, "{fourth}, not {expected}");
}

/// Two equal oscillators, one driven by the other: there is no basis of eigenvectors.
struct Chain(SMatrix<f64, 5, 5>);

impl Chain {
    fn new() -> Self {
        let mut jacobian = SMatrix::zeros();
        for pair in [1, 3] {
            jacobian[(pair, pair + 1)] = 1.0;
            jacobian[(pair + 1, pair)] = -OMEGA * OMEGA;
        }
        jacobian[(4, 1)] = 50.0;
        Self(jacobian)
    }
}

impl System<6> for Chain {
    fn derivatives(&self, _: f64, x: &[f64; 6]) -> [f64; 6] {
        let rates = self.0 * SVector::<f64, 5>::from_column_slice(&x[..5]);
        std::array::from_fn(|i| rates.get(i).copied().unwrap_or(0.0))
    }
    fn holds(&self, _: f64, _: &[f64; 6]) -> bool {
        true
    }
    fn nominal(&self) -> &[f64; 6] {
        &[1.0, 1.0, OMEGA, 1.0, OMEGA, 1.0]
    }
}

/// The state of the chain after 1 s.
fn chained(method: &mut impl Method<6>, system: &Chain) -> [f64; 6] {
    let (mut integrator, mut x) = (Integrator::new(1e-10, 1e-3), [0.0, 1.0, 0.0, 0.5, 3.0, 0.0]);
    let outcome = integrator.advance(method, system, &mut x, [0.0, 1.0], &mut None);
    assert_eq!(outcome, Outcome::Complete);
    x
}

#[test]
fn verif_a_jacobian_that_cannot_be_decoupled_still_gives_a_method() {
    let system = Chain::new();
    let jacobian = DMatrix::from_fn(5, 5, |i, j| system.0[(i, j)]);
    let decoupling = Decoupling::<6, SLOW, 4>::new(&jacobian, system.nominal());
    let x = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];
    let coordinates = decoupling.to_coordinates(&x);
    assert_eq!(coordinates, [0.1, 0.2, 0.3, 0.4, 0.5, 0.0], "each pair is an oscillator by itself");
    assert_eq!(decoupling.to_states(&coordinates), x);
    let ours = chained(&mut Exponential::new(decoupling), &system);
    let theirs = chained(&mut &DOP853, &system);
    for i in 0..6 {
        assert!((ours[i] - theirs[i]).abs() < 1e-7, "state {i}: {} {}", ours[i], theirs[i]);
    }
}
