//! Integration of x' = f(t, x) over one interval, landing exactly on its end. Knows no aircraft.

/// What is integrated.
pub trait System<const N: usize> {
    /// f(t, x); zero for states that are not in use.
    fn derivatives(&self, t: f64, x: &[f64; N]) -> [f64; N];
    /// Whether the model still holds at t and x; an accepted step never ends where it does not.
    fn holds(&self, t: f64, x: &[f64; N]) -> bool;
    /// Typical size of each state, for the tolerance.
    fn nominal(&self) -> &[f64; N];
    /// Whether f has numbers at x: a trial state may be anywhere.
    fn in_domain(&self, _x: &[f64; N]) -> bool {
        true
    }
    /// Whether neither f nor `holds` changes with time: what a step leaves as it is then stays so.
    fn is_autonomous(&self) -> bool {
        false
    }
}

/// How an interval ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// At its end.
    Complete,
    /// At the last instant at which the model holds.
    Invalid(f64),
    /// Nowhere: no step holds the tolerance from this instant on.
    StepTooSmall(f64),
    /// At this instant, after [`MAX_TRIALS`].
    TooManySteps(f64),
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
    /// Weights of a second estimate of lower order, which steadies the first; zeros for none.
    pub error_low: [f64; S],
    /// The estimate falls as h to this power.
    pub error_order: i32,
}

/// What a trial step comes to.
pub struct Trial<const N: usize> {
    /// State at its end.
    pub next: [f64; N],
    /// Derivatives there, if the method needs them.
    pub slope: Option<[f64; N]>,
    /// Its error over the tolerance.
    pub error: f64,
    /// The error falls as the step's length to this power.
    pub order: i32,
}

/// A step to be tried.
pub struct Attempt<'a, S, const N: usize> {
    /// What moves.
    pub system: &'a S,
    /// Where from.
    pub x: &'a [f64; N],
    /// Derivatives there.
    pub slope: &'a [f64; N],
    /// When from, s.
    pub t: f64,
    /// For how long, s.
    pub h: f64,
    /// Relative tolerance.
    pub tolerance: f64,
}

/// Rates where f has no numbers, per second: no step that meets them holds its tolerance, and
/// nothing made of them overflows.
const WILD: f64 = 1e30;

/// f(t, x) at any x.
#[inline(always)]
fn rates<S: System<N>, const N: usize>(system: &S, t: f64, x: &[f64; N]) -> [f64; N] {
    if system.in_domain(x) { system.derivatives(t, x) } else { [WILD; N] }
}

impl<S: System<N>, const N: usize> Attempt<'_, S, N> {
    /// f at a stage.
    #[inline(always)]
    pub fn rates(&self, t: f64, x: &[f64; N]) -> [f64; N] {
        rates(self.system, t, x)
    }

    /// Largest error of a state over the tolerance, if the step ends in `next` and the error grew by
    /// `rates`, 1/s.
    #[inline(always)]
    pub fn error(&self, next: &[f64; N], rates: &[f64; N]) -> f64 {
        let nominal = self.system.nominal();
        let mut largest = 0.0;
        for i in 0..N {
            let size = nominal[i] + self.x[i].abs().max(next[i].abs());
            largest = worse(largest, self.h / (self.tolerance * size) * rates[i]);
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
    /// Where a step leads, and how far it may be off.
    fn trial<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N>;
}

/// Step control: keeps the proposal for the next step between intervals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integrator {
    /// Relative tolerance per step, with respect to |x| + nominal.
    pub tolerance: f64,
    /// Proposed length of the next step, s.
    pub proposal: f64,
}

/// Aimed share of the tolerance: the next step should pass at the first try.
const SAFETY: f64 = 0.9;
/// Largest fall and rise of the step from one to the next (Hairer, Norsett, Wanner, Solving
/// Ordinary Differential Equations I, 2nd ed., section II.4).
const FACTORS: [f64; 2] = [0.2, 6.0];
/// A step shorter than this, s, or than the resolution of time below, makes no progress.
const SMALLEST: f64 = 1e-13;
/// Roundings of the time that a step must be worth.
const ROUNDINGS: f64 = 8.0;
/// The instant at which the model ceases to hold is located to this length, s.
const EXIT_RESOLUTION: f64 = 1e-9;
/// Trials in one interval: seconds of computing, and hours of flight. A stable vehicle never leaves its
/// envelope, so a longer interval would not end.
pub const MAX_TRIALS: usize = 1_000_000;

impl Integrator {
    /// A fresh integrator; `proposal` (s) is only a first guess.
    pub fn new(tolerance: f64, proposal: f64) -> Self {
        Self { tolerance, proposal }
    }

    /// Moves `x` from `start` to `end`. `first` holds f(start, x) if the caller knows it; on return
    /// it holds f at the state reached, if the method computes that.
    ///
    /// The rest of the interval is cut into equal steps, none longer than the proposal, so no
    /// sliver is left at its end.
    pub fn advance<const N: usize>(
        &mut self,
        method: &mut impl Method<N>,
        system: &impl System<N>,
        x: &mut [f64; N],
        [start, end]: [f64; 2],
        first: &mut Option<[f64; N]>,
    ) -> Outcome {
        let mut t = start;
        // First instant at which the model is known not to hold.
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
            let resolution = ROUNDINGS * f64::EPSILON * t.abs();
            if invalid <= end {
                if remaining < EXIT_RESOLUTION.max(4.0 * resolution) {
                    *first = Some(slope);
                    return Outcome::Invalid(t);
                }
                h = h.min(0.5 * remaining);
            }
            if h < SMALLEST.max(resolution) && h < remaining {
                *first = Some(slope);
                return Outcome::StepTooSmall(t);
            }
            let tolerance = self.tolerance;
            let trial = method.trial(&Attempt { system, x, slope: &slope, t, h, tolerance });
            let error = trial.error;
            // One that is no number counts as far too long a step.
            let factor = if error == 0.0 {
                FACTORS[1]
            } else if error.is_finite() {
                let exponent = -1.0 / f64::from(trial.order);
                (SAFETY * libm::pow(error, exponent)).clamp(FACTORS[0], FACTORS[1])
            } else {
                FACTORS[0]
            };
            let wanted = h * factor;
            if error.is_nan() || error > 1.0 {
                self.proposal = wanted;
                continue;
            }
            if !system.holds(t + h, &trial.next) {
                // Rounding may put t + h beyond the end of the interval, where nothing looks for it.
                invalid = target.min(t + h);
                continue;
            }
            // A step cut by the interval's end says nothing against the longer proposal.
            self.proposal = if factor >= 1.0 { wanted.max(self.proposal) } else { wanted };
            // The steps to come would be this one again, as many as there are.
            let rests =
                system.is_autonomous() && trial.next == *x && self.proposal >= method.max_step();
            t = if rests || last && invalid > end { end } else { t + h };
            *x = trial.next;
            *first = trial.slope;
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
        // No stage has met the step's end.
        let error = if attempt.system.in_domain(&next) { error } else { f64::INFINITY };
        Trial { next, slope: None, error, order: self.error_order }
    }
}

/// Larger of two magnitudes; unlike `f64::max` it keeps a NaN.
#[inline(always)]
fn worse(largest: f64, value: f64) -> f64 {
    let magnitude = value.abs();
    if magnitude > largest || magnitude.is_nan() { magnitude } else { largest }
}

/// sum_j weights_j stages_j. Over all states, in use or not: a fixed length keeps the sum in registers.
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
