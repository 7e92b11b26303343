//! Integration of x' = f(t, x) over one interval, with step-size control.
//!
//! ```text
//! err = max_i |e_i| / (tolerance (max(|x_i|, |next_i|) + nominal_i))      accepted if err <= 1
//! next step = h clamp(0.9 err^(-1/p), 0.2, 6)                             err falls as h^p
//! ```
//!
//! (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., section II.4). What
//! remains of an interval is divided into equal steps, so the last one ends exactly at its end.

/// The system that is integrated.
pub trait System<const N: usize> {
    /// f(t, x); zero for unused states.
    fn derivatives(&self, t: f64, x: &[f64; N]) -> [f64; N];
    /// Whether the model still holds at t and x; an accepted step never ends where it does not.
    fn holds(&self, t: f64, x: &[f64; N]) -> bool;
    /// Nominal value of each state, for the tolerance.
    fn nominal(&self) -> &[f64; N];
    /// Whether f is finite at x: a trial state may lie far outside the model's range.
    fn in_domain(&self, _x: &[f64; N]) -> bool {
        true
    }
    /// True if f and `holds` do not depend on time; an unchanged state is then an equilibrium.
    fn is_autonomous(&self) -> bool {
        false
    }
}

/// How an interval ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// The end was reached.
    Complete,
    /// The model ceases to hold after this instant.
    Invalid(f64),
    /// No step of useful length meets the tolerance at this instant.
    StepTooSmall(f64),
    /// [`MAX_TRIALS`] steps reached this instant only.
    TooManySteps(f64),
    /// A step ended at this instant, and one was wanted.
    Paused(f64),
}

/// An explicit Runge-Kutta method with an error estimate made of two embedded methods.
pub struct Tableau<const S: usize> {
    /// Runge-Kutta matrix, strictly lower triangular.
    pub a: [[f64; S]; S],
    /// Weights.
    pub b: [f64; S],
    /// Abscissae.
    pub c: [f64; S],
    /// Weights of the error estimate of the higher embedded order.
    pub error: [f64; S],
    /// Weights of a second estimate of lower order; zeros for none. See [`super::DOP853`].
    pub error_low: [f64; S],
    /// Power of h with which the estimate falls.
    pub error_order: i32,
}

/// Result of a trial step.
pub struct Trial<const N: usize> {
    /// State at its end.
    pub next: [f64; N],
    /// Derivatives there, if the method needs them.
    pub slope: Option<[f64; N]>,
    /// Error over the tolerance.
    pub error: f64,
    /// Length that the next step should have, over that of this one.
    pub factor: f64,
}

/// [`Trial::factor`] of a step whose error falls with h^order. NaN counts as an infinite error.
#[inline(always)]
pub fn step_factor(error: f64, order: i32) -> f64 {
    let [least, largest] = STEP_FACTORS;
    // Most steps are this accurate: they need no power.
    let negligible: f64 = (0..order).map(|_| SAFETY / largest).product();
    if error < negligible {
        largest
    } else if error.is_finite() {
        (SAFETY * libm::pow(error, -1.0 / f64::from(order))).clamp(least, largest)
    } else {
        least
    }
}

/// A trial step.
pub struct Attempt<'a, S, const N: usize> {
    /// System.
    pub system: &'a S,
    /// State at its start.
    pub x: &'a [f64; N],
    /// Derivatives at its start.
    pub slope: &'a [f64; N],
    /// Time at its start, s.
    pub t: f64,
    /// Length, s.
    pub h: f64,
    /// Relative tolerance.
    pub tolerance: f64,
}

/// Rates in place of f outside its domain, per second: large enough for the step to be rejected, small
/// enough that nothing computed from them overflows.
const OUT_OF_DOMAIN_RATE: f64 = 1e30;

/// f(t, x), or [`OUT_OF_DOMAIN_RATE`].
#[inline(always)]
fn rates<S: System<N>, const N: usize>(system: &S, t: f64, x: &[f64; N]) -> [f64; N] {
    if system.in_domain(x) { system.derivatives(t, x) } else { [OUT_OF_DOMAIN_RATE; N] }
}

impl<S: System<N>, const N: usize> Attempt<'_, S, N> {
    /// f at a stage.
    #[inline(always)]
    pub fn rates(&self, t: f64, x: &[f64; N]) -> [f64; N] {
        rates(self.system, t, x)
    }

    /// err of a step that ends in `next` with the errors h `rates`.
    #[inline(always)]
    pub fn error(&self, next: &[f64; N], rates: &[f64; N]) -> f64 {
        let nominal = self.system.nominal();
        let mut largest = 0.0;
        for i in 0..N {
            let size = nominal[i] + self.x[i].abs().max(next[i].abs());
            largest = larger_or_nan(largest, self.h / (self.tolerance * size) * rates[i]);
        }
        largest
    }
}

/// A one-step method.
pub trait Method<const N: usize> {
    /// Longest step, s.
    fn max_step(&self) -> f64 {
        f64::INFINITY
    }
    /// Takes a trial step.
    fn trial<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N>;
}

/// Step-size control. The proposed step is kept between intervals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integrator {
    /// Relative tolerance per step, with respect to |x| + nominal.
    pub tolerance: f64,
    /// Proposed length of the next step, s.
    pub proposal: f64,
}

/// Safety factor of the next step.
const SAFETY: f64 = 0.9;
/// Limits of the ratio of successive steps.
const STEP_FACTORS: [f64; 2] = [0.2, 6.0];
/// Shortest step, s.
const MIN_STEP_S: f64 = 1e-13;
/// Shortest step in units of the rounding error of time.
const MIN_STEP_ROUNDINGS: f64 = 8.0;
/// Resolution of the instant at which the model ceases to hold, s.
const EXIT_RESOLUTION_S: f64 = 1e-9;
/// Limit of trial steps in one interval, hours of flight: otherwise the interval of a stable vehicle could be
/// endless.
pub const MAX_TRIALS: usize = 1_000_000;

impl Integrator {
    /// An integrator with a first guess of the step, s.
    pub fn new(tolerance: f64, proposal: f64) -> Self {
        Self { tolerance, proposal }
    }

    /// Integrates `x` from `start` to `end`. `first` holds f(start, x) if the caller knows it; on return
    /// it holds f at the state reached, if the method computes that.
    pub fn advance<const N: usize>(
        &mut self,
        method: &mut impl Method<N>,
        system: &impl System<N>,
        x: &mut [f64; N],
        interval: [f64; 2],
        first: &mut Option<[f64; N]>,
    ) -> Outcome {
        self.run(method, system, x, interval, first, false)
    }

    /// The same, by one step only if `once`.
    pub fn run<const N: usize>(
        &mut self,
        method: &mut impl Method<N>,
        system: &impl System<N>,
        x: &mut [f64; N],
        [start, end]: [f64; 2],
        first: &mut Option<[f64; N]>,
        once: bool,
    ) -> Outcome {
        let mut t = start;
        // Earliest instant at which the model is known not to hold.
        let mut invalid = f64::INFINITY;
        let mut slope = first.unwrap_or_else(|| rates(system, t, x));
        for _ in 0..MAX_TRIALS {
            if t >= end {
                return Outcome::Complete;
            }
            let target = end.min(invalid);
            let remaining = target - t;
            let pieces = libm::ceil(remaining / self.proposal.min(method.max_step())).max(1.0);
            let (mut h, last) = (remaining / pieces, pieces == 1.0);
            let resolution = MIN_STEP_ROUNDINGS * f64::EPSILON * t.abs();
            if invalid <= end {
                if remaining < EXIT_RESOLUTION_S.max(4.0 * resolution) {
                    *first = Some(slope);
                    return Outcome::Invalid(t);
                }
                h = h.min(0.5 * remaining);
            }
            if h < MIN_STEP_S.max(resolution) && h < remaining {
                *first = Some(slope);
                return Outcome::StepTooSmall(t);
            }
            let tolerance = self.tolerance;
            let trial = method.trial(&Attempt { system, x, slope: &slope, t, h, tolerance });
            let Trial { error, factor, .. } = trial;
            let wanted = h * factor;
            if error.is_nan() || error > 1.0 {
                self.proposal = wanted;
                continue;
            }
            if !system.holds(t + h, &trial.next) {
                // Rounding may put t + h beyond the end of the interval.
                invalid = target.min(t + h);
                continue;
            }
            // A step shortened by the interval's end does not shorten the proposal.
            self.proposal = if factor >= 1.0 { wanted.max(self.proposal) } else { wanted };
            let equilibrium =
                system.is_autonomous() && trial.next == *x && self.proposal >= method.max_step();
            t = if equilibrium || last && invalid > end { end } else { t + h };
            *x = trial.next;
            *first = trial.slope;
            if t < end && once {
                return Outcome::Paused(t);
            }
            if t < end {
                slope = trial.slope.unwrap_or_else(|| system.derivatives(t, x));
            }
        }
        if t < end { Outcome::TooManySteps(t) } else { Outcome::Complete }
    }
}

impl<const N: usize, const STAGES: usize> Method<N> for &Tableau<STAGES> {
    #[inline]
    fn trial<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N> {
        let &Attempt { x, slope, t, h, .. } = attempt;
        let mut stages = [[0.0; N]; STAGES];
        stages[0] = *slope;
        let advanced = |sum: [f64; N]| std::array::from_fn(|i| x[i] + h * sum[i]);
        for stage in 1..STAGES {
            let trial = advanced(combine(&stages[..stage], &self.a[stage]));
            stages[stage] = attempt.rates(t + self.c[stage] * h, &trial);
        }
        let next = advanced(combine(&stages, &self.b));
        let [high, low] = [&self.error, &self.error_low]
            .map(|weights| attempt.error(&next, &combine(&stages, weights)));
        let error = match low {
            0.0 => high,
            // Hairer, Norsett, Wanner, 2nd ed., eq. (II.10.17).
            _ => high * high / libm::sqrt(high * high + 0.01 * low * low).max(f64::MIN_POSITIVE),
        };
        // No stage has evaluated f at `next`.
        let error = if attempt.system.in_domain(&next) { error } else { f64::INFINITY };
        Trial { next, slope: None, error, factor: step_factor(error, self.error_order) }
    }
}

/// Larger of two magnitudes; unlike `f64::max` it returns NaN if either is.
#[inline(always)]
fn larger_or_nan(largest: f64, value: f64) -> f64 {
    let magnitude = value.abs();
    if magnitude > largest || magnitude.is_nan() { magnitude } else { largest }
}

/// sum_j weights_j stages_j, over all N states: a fixed length keeps the sum in registers.
#[inline]
fn combine<const N: usize>(stages: &[[f64; N]], weights: &[f64]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (stage, &weight) in stages.iter().zip(weights) {
        if weight != 0.0 {
            for i in 0..N {
                sum[i] += weight * stage[i];
            }
        }
    }
    sum
}
