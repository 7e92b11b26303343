//! The exponential method on small systems: its functions against their recursion, oscillators
//! against closed forms and DOP853.

use ahv::solve::{
    Attempt, Blocks, DOP853, Decoupling, Exponential, Integrator, Method, Outcome, System, Trial,
    phis,
};
use nalgebra::{DMatrix, Matrix4, SMatrix, SVector, Vector4};
use std::cell::Cell;

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
            recur::<4>(&blocks, t);
            recur::<6>(&blocks, t);
        }
    }
}

/// phi_k = z phi_(k+1) + 1/k!, down to the exponential, for the first K functions.
fn recur<const K: usize>(blocks: &Blocks<4>, t: f64) {
    let l = dense(blocks);
    let functions = phis::<4, K>(blocks, t).map(|f| {
        Matrix4::from_diagonal(&f.identity.into()) + Matrix4::from_diagonal(&f.linear.into()) * l
    });
    let mut below = series(l * t);
    let mut factorial = 1.0;
    for (k, phi) in functions.iter().enumerate() {
        factorial *= k.max(1) as f64;
        let recurred = l * t * phi + Matrix4::identity() / factorial;
        // The entries differ in size by the frequency.
        let scale = below.amax();
        assert!((recurred - below).amax() < 1e-14 * scale, "phi_{k}, {t} s: {recurred} {below}");
        below = *phi;
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

/// A system that counts its right-hand sides.
struct Counted<'a, S> {
    system: &'a S,
    calls: Cell<usize>,
}

impl<S: System<4>> System<4> for Counted<'_, S> {
    fn derivatives(&self, t: f64, x: &[f64; 4]) -> [f64; 4] {
        self.calls.set(self.calls.get() + 1);
        self.system.derivatives(t, x)
    }
    fn holds(&self, _: f64, _: &[f64; 4]) -> bool {
        true
    }
    fn nominal(&self) -> &[f64; 4] {
        self.system.nominal()
    }
}

/// Rungs of the method, by the right-hand sides of a step that ends there.
const EARLY: usize = 2;
const WHOLE: usize = 5;
const FINE: usize = 10;

/// One step that ends at a given rung, whatever its error: at the first for a huge tolerance, at the second for none,
/// at the third for one which the second misses by less than it can gain.
fn forced_step(
    method: &mut impl Method<4>,
    system: &impl System<4>,
    start: [&[f64; 4]; 2],
    step: [f64; 2],
    rung: usize,
) -> Trial<4> {
    let tolerances = match rung {
        EARLY => 9..10,
        WHOLE => -400..-399,
        _ => -40..9,
    };
    tolerances
        .rev()
        .find_map(|digits| {
            let counted = Counted { system, calls: Cell::new(0) };
            let trial = tried(method, &counted, start, step, 10.0_f64.powi(digits));
            (counted.calls.get() == rung).then_some(trial)
        })
        .unwrap_or_else(|| panic!("no tolerance ends a step at {rung} right-hand sides"))
}

/// The state after 1 s in equal steps that end at a given rung.
fn forced(
    method: &mut impl Method<4>,
    system: &impl System<4>,
    steps: u32,
    rung: usize,
) -> [f64; 4] {
    let mut x = [0.3, 1.0, 2.0, 0.0];
    for step in 0..steps {
        let [start, end] = [step, step + 1].map(|i| f64::from(i) / f64::from(steps));
        let slope = system.derivatives(start, &x);
        x = forced_step(method, system, [&x, &slope], [start, end - start], rung).next;
    }
    x
}

/// The same with DOP853.
fn exact(system: &impl System<4>, steps: u32) -> [f64; 4] {
    let mut x = [0.3, 1.0, 2.0, 0.0];
    for step in 0..steps {
        let [start, end] = [step, step + 1].map(|i| f64::from(i) / f64::from(steps));
        let slope = system.derivatives(start, &x);
        x = tried(&mut &DOP853, system, [&x, &slope], [start, end - start], 1e9).next;
    }
    x
}

#[test]
fn verif_linear_oscillators_are_exact_at_any_step() {
    let system = Duffing { stiffening: 0.0 };
    let (sin, cos) = OMEGA.sin_cos();
    let exact = [0.3 + (sin + 0.1 * (1.0 - cos)) / OMEGA, cos + 0.1 * sin, 2.0 * cos - OMEGA * sin];
    for (steps, rung) in [(11, EARLY), (11, WHOLE), (40, EARLY), (1000, EARLY), (1000, WHOLE)] {
        let x = forced(&mut exponential(&system), &system, steps, rung);
        for i in 0..3 {
            assert!(
                (x[i] - exact[i]).abs() < 1e-12 * system.nominal()[i],
                "{steps} steps, state {i}"
            );
        }
    }
}

/// The power of the step by which the errors of some and four times as many steps differ where the rest is large.
fn order(rung: usize, steps: u32) -> f64 {
    let system = Duffing { stiffening: 0.5 };
    let exact = exact(&system, 4000);
    let error = |steps| {
        let x = forced(&mut exponential(&system), &system, steps, rung);
        (0..3).map(|i| ((x[i] - exact[i]) / system.nominal()[i]).abs()).fold(0.0, f64::max)
    };
    (error(steps) / error(4 * steps)).log2() / 2.0
}

#[test]
fn verif_the_second_rung_converges_with_order_four_or_more_where_the_rest_is_large() {
    // The stages' share of a step's error falls with the fourth power of the step, that of the
    // quadrature with the sixth.
    let order = order(WHOLE, 160);
    assert!((3.9..6.5).contains(&order), "order {order}");
}

#[test]
fn verif_the_first_rung_converges_with_order_two_or_more_where_the_rest_is_large() {
    let order = order(EARLY, 160);
    assert!((2.8..4.5).contains(&order), "order {order}");
}

#[test]
fn verif_the_third_rung_converges_with_order_five_or_more_where_the_rest_is_large() {
    let order = order(FINE, 40);
    assert!((4.9..7.5).contains(&order), "order {order}");
}

#[test]
fn verif_the_error_found_is_no_less_than_that_of_the_step() {
    let system = Duffing { stiffening: 0.5 };
    let start = [0.3, 1.0, 2.0, 0.0];
    let slope = system.derivatives(0.0, &start);
    let mut ends = [0; 11];
    for (halvings, tolerance) in (3..20).flat_map(|n| [(n, 1e-6), (n, 1e-9)]) {
        let h = 0.5_f64.powi(halvings);
        let counted = Counted { system: &system, calls: Cell::new(0) };
        let attempt = Attempt { system: &counted, x: &start, slope: &slope, t: 0.0, h, tolerance };
        let step = exponential(&system).trial(&attempt);
        ends[counted.calls.get()] += 1;
        let exact = (0..64).fold(start, |x, i| {
            let slope = system.derivatives(0.0, &x);
            let step = [h * f64::from(i) / 64.0, h / 64.0];
            tried(&mut &DOP853, &system, [&x, &slope], step, tolerance).next
        });
        let rates = std::array::from_fn(|i| (step.next[i] - exact[i]) / h);
        let error = attempt.error(&exact, &rates);
        // Rounding is a few 1e-16.
        assert!(error < step.error + 1e-15 / tolerance, "{h} s: {error}, found {}", step.error);
    }
    for rung in [EARLY, WHOLE, FINE] {
        assert!(ends[rung] > 2, "{} steps ended at {rung} right-hand sides", ends[rung]);
    }
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
    // The stiff order conditions sum_j b_j(z) c_j^k / k! = phi_(k+1)(z) at z = 1.25i: for k up to 5, 3 and 1 in a
    // step that ends at the third, second and first rung; beyond the first two for no other.
    for (rung, highest) in [(FINE, 5), (WHOLE, 3), (EARLY, 1)] {
        for power in 0..=highest + 1 {
            let system = Forced { power };
            let mut method = exponential(&Duffing { stiffening: 0.0 });
            let ours = forced(&mut method, &system, 16, rung);
            let exact = exact(&system, 1000);
            let error = (0..3)
                .map(|i| ((ours[i] - exact[i]) / system.nominal()[i]).abs())
                .fold(0.0, f64::max);
            // The rule of the third rung is so good that an error would not show.
            if rung != FINE || power <= highest {
                assert_eq!(error < 1e-12, power <= highest, "t^{power}, {rung}: {error:e}");
            }
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

/// The method without a linear part.
fn without_linear_part() -> Exponential<4, SLOW, 2> {
    Exponential::new(Decoupling::new(&DMatrix::zeros(3, 3), Dahlquist.nominal()))
}

#[test]
fn verif_the_digits_of_a_step_length_that_its_weights_lack_cost_none() {
    // Steps whose lengths differ by less than 2^-33 share their weights; the state moves on nevertheless.
    let (x, h) = ([1.0; 4], 0.25);
    let longer = h * (1.0 + 0.9 * 0.5_f64.powi(33));
    for rung in [EARLY, WHOLE, FINE] {
        let [short, long] = [h, longer].map(|h| {
            forced_step(&mut without_linear_part(), &Dahlquist, [&x, &x], [0.0, h], rung).next[1]
        });
        let moved = (long - short) / ((longer - h) * h.exp());
        assert!((moved - 1.0).abs() < 0.05, "{rung}: {moved}");
    }
}

#[test]
fn verif_the_classical_order_is_three_and_two() {
    // Without a linear part this is a Runge-Kutta method. Of its polynomial R(z) the coefficient of z^4 is
    // b A A c = 1/24 - 2/9 (3/4 b_1 + b_2 a_20), as stage 0 has order 1 and the others order 2.
    let (z, x) = (0.5_f64.powi(7), [1.0; 4]);
    let step = |rung: usize| {
        forced_step(&mut without_linear_part(), &Dahlquist, [&x, &x], [0.0, z], rung).next[1]
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
