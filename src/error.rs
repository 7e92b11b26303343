//! What can go wrong, with the variable, the value and the limit.

use crate::short::short;

/// A failure of the model. The text is what a user reads in the log of a simulation master.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A data file does not hold what the model needs.
    #[error("{file}: {key}: {problem}")]
    Data {
        /// Name of the data file.
        file: String,
        /// Key inside the file, with its table: `beam.elements`.
        key: String,
        /// What is wrong, with value and limit.
        problem: String,
    },
    /// A variable was given a value that it cannot take.
    #[error("{variable} = {} is refused: {expected}", short(*value))]
    Value {
        /// Name of the variable.
        variable: String,
        /// The refused value.
        value: f64,
        /// What would be accepted.
        expected: String,
    },
    /// The eigenmodes of the beam with its sloshing masses were not found.
    #[error(
        "only {found} of the {count} lowest modes of the beam were found; \
         check stiffness, masses and sloshing frequencies"
    )]
    Modes {
        /// Modes asked for.
        count: usize,
        /// Modes found.
        found: usize,
    },
    /// No body with these masses and tanks has the pitch inertia that is asked for.
    #[error(
        "a pitch inertia of {inertia:.5e} kg m^2/m is refused: beam and sloshing masses, {own:.5e} by \
         themselves, with the mass centre moved by {shift_m:.3} m, need more than {least:.5e}; raise \
         inertia_factor or inertia.i_yy_kg_m2_per_m, or move the tanks towards the mass centre"
    )]
    Inertia {
        /// Inertia about the mass centre that is asked for, kg m^2/m.
        inertia: f64,
        /// The least that leaves the beam a positive kinetic energy, kg m^2/m.
        least: f64,
        /// Inertia by density and sloshing masses, kg m^2/m.
        own: f64,
        /// Mass centre asked for less that by density and sloshing masses, m.
        shift_m: f64,
    },
    /// No level flight within the limits of vehicle and curve fits.
    #[error(
        "no trim at mach0 = {}, altitude0 = {} m, gamma0 = {} rad: {limit} \
         (largest residual {residual:.3e}); choose another flight condition, factors nearer to 1, or \
         trim = false",
        short(*mach), short(*altitude_m), short(*gamma_rad)
    )]
    Trim {
        /// Mach number asked for.
        mach: f64,
        /// Altitude asked for, m.
        altitude_m: f64,
        /// Flight-path angle asked for, rad.
        gamma_rad: f64,
        /// Largest scaled residual of the trim equations, with the unknowns cut to their limits.
        residual: f64,
        /// The limit that was hit, with the value that broke it.
        limit: String,
    },
    /// The equations of motion have no value where the search for a trim starts.
    #[error(
        "the vehicle has no finite accelerations at mach0 = {}, altitude0 = {} m: a number of its data, or \
         one of its factors, is much too large or too small",
        short(*mach), short(*altitude_m)
    )]
    NotFinite {
        /// Mach number asked for.
        mach: f64,
        /// Altitude asked for, m.
        altitude_m: f64,
    },
    /// The flight reached the edge of the region in which the curve fits hold.
    #[error(
        "{variable} = {value:.6} reached the edge of its valid range [{min:.6}, {max:.6}] at \
         t = {} s; {}, so the flight ends there",
        short(*time_s), beyond(variable)
    )]
    Envelope {
        /// Name of the variable at the edge of its range.
        variable: &'static str,
        /// Its value at the last valid instant, in the unit of the variable table.
        value: f64,
        /// Lower limit.
        min: f64,
        /// Upper limit.
        max: f64,
        /// The last valid instant, s.
        time_s: f64,
    },
    /// A state so far off that the equations have no numbers.
    #[error(
        "{variable} = {}: the equations have numbers in [{}, {}] only; try a state nearer to flight, \
         or a shorter step",
        short(*value), short(*min), short(*max)
    )]
    Numberless {
        /// Name of the state.
        variable: &'static str,
        /// Its value.
        value: f64,
        /// Lower limit.
        min: f64,
        /// Upper limit.
        max: f64,
    },
    /// The tanks ran empty.
    #[error(
        "fuel_mass reached 0 at t = {} s: the fuel ran out, and the thrust of the curve fits \
         is one with fuel, so the flight ends there; start with a larger fuel_fraction",
        short(*time_s)
    )]
    Fuel {
        /// The last instant with fuel, s.
        time_s: f64,
    },
    /// The integrator cannot hold the tolerance.
    #[error(
        "no step holds the tolerance {tolerance:.1e} at t = {} s; raise the tolerance",
        short(*time_s)
    )]
    StepSize {
        /// Relative tolerance asked for.
        tolerance: f64,
        /// Time reached, s.
        time_s: f64,
    },
    /// The interval takes more steps than anyone waits for.
    #[error(
        "a step of {asked_s:e} s is too long: {trials} steps of the integrator reach t = {} s; \
         go on from there with shorter communication steps",
        short(*time_s)
    )]
    TooLong {
        /// Length of the interval, s.
        asked_s: f64,
        /// Steps tried.
        trials: usize,
        /// Time reached, s.
        time_s: f64,
    },
}

/// What is beyond the range of a limited variable.
fn beyond(variable: &str) -> &'static str {
    match variable {
        "slosh1" | "slosh2" => "beyond it the liquid would leave its depth",
        "choking_margin" => "beyond it the burner chokes",
        _ => "beyond it the curve fits mean nothing",
    }
}
