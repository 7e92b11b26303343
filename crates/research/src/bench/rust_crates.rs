//! Integrators of other crates with our right-hand side.

use crate::methods::Counted;
use ahv::solve::System as _;
use ahv::vehicle::{NOMINAL, STATES, State};
use anyhow::Result;
use ode_solvers::{Dop853, OutputType, SVector, System};

/// Integrates a state over an interval (s) at a tolerance. The state is scaled by its nominal values, so that one
/// absolute tolerance is equivalent to that of our flights.
pub type Step = fn(&Scaled, [f64; 2], &State, f64) -> Result<State>;

/// The methods of the crates.
pub const CRATES: &[(&str, Step)] = &[
    ("ode_solvers", ode_solvers),
    #[cfg(feature = "diffsol")]
    ("diffsol tsit45", super::diffsol::tsit45),
    #[cfg(feature = "diffsol")]
    ("diffsol BDF", super::diffsol::bdf),
];

/// Names and locked versions of the crates.
pub fn versions() -> Result<Vec<String>> {
    let lock: toml::Table = toml::from_str(include_str!("../../../../Cargo.lock"))?;
    let packages = lock["package"].as_array().into_iter().flatten();
    let named = packages.filter_map(|package| {
        Some([package.get("name")?.as_str()?, package.get("version")?.as_str()?])
    });
    let used = |name| CRATES.iter().any(|(method, _)| method.split(' ').next() == Some(name));
    Ok(named.filter(|[name, _]| used(name)).map(|name| name.join(" ")).collect())
}

/// The vehicle in one communication step, with scaled state.
pub struct Scaled<'a>(pub &'a Counted<'a>);

impl Scaled<'_> {
    pub fn rates(&self, y: &[f64]) -> State {
        let x = std::array::from_fn(|i| y[i] * NOMINAL[i]);
        let rates = self.0.derivatives(0.0, &x);
        std::array::from_fn(|i| rates[i] / NOMINAL[i])
    }
}

/// Integrates one communication step from a restart.
pub fn step(
    method: Step,
    system: &Counted,
    interval: [f64; 2],
    x: &mut State,
    tolerance: f64,
) -> Result<()> {
    let start = std::array::from_fn(|i| x[i] / NOMINAL[i]);
    let end = method(&Scaled(system), interval, &start, tolerance)?;
    *x = std::array::from_fn(|i| end[i] * NOMINAL[i]);
    Ok(())
}

type Vector = SVector<f64, STATES>;

impl System<f64, Vector> for &Scaled<'_> {
    fn system(&self, _: f64, y: &Vector, rates: &mut Vector) {
        *rates = self.rates(y.as_slice()).into();
    }
}

/// DOP853.
fn ode_solvers(
    system: &Scaled,
    [start, end]: [f64; 2],
    y: &State,
    tolerance: f64,
) -> Result<State> {
    let y = Vector::from(*y);
    let mut stepper = Dop853::new(system, start, end, end - start, y, tolerance, tolerance);
    stepper.set_output(OutputType::Sparse);
    stepper.integrate()?;
    Ok(stepper.y_out().last().map_or(y, |state| *state).into())
}
