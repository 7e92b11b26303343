//! Before a flight: the parameters, and the flight that starts from them.

use super::in_flight::Flight;
use super::inputs::Inputs;
use super::method::{DEFAULT_TOLERANCE, FIRST_STEP, Method, method};
use super::parameters::{InputMode, Offsets, Parameters};
use crate::data::Data;
use crate::dynamics::trim;
use crate::dynamics::trim::Trim;
use crate::error::{Error, LimitedKind, StartCause};
use crate::solve::Integrator;
use crate::structure::{FLEXIBLE, MODES, SLOSH};
use crate::vehicle::{
    ALPHA, CONTROLS, FUEL, GUSTS, PHI, Q, State, Vehicle, VehicleOptions, eta, eta_dot,
};
use std::sync::Arc;

/// What a flight starts from.
#[derive(Debug, Clone)]
pub struct Setup {
    data: Arc<Data>,
    /// Parameters.
    pub parameters: Parameters,
}

impl PartialEq for Setup {
    fn eq(&self, other: &Self) -> bool {
        let same_data =
            Arc::ptr_eq(&self.data, &other.data) || self.data.packed() == other.data.packed();
        self.parameters == other.parameters && same_data
    }
}

impl Setup {
    /// Default parameters of the built-in vehicle.
    ///
    /// # Errors
    /// [`Error::Data`] if the data are not those of a vehicle.
    pub fn new() -> Result<Self, Error> {
        Ok(Self::of(Data::embedded()?))
    }

    /// Default parameters of a vehicle with these data.
    pub fn of(data: Data) -> Self {
        Self { parameters: Parameters::new(&data), data: Arc::new(data) }
    }

    /// The data of the vehicle.
    pub fn data(&self) -> &Data {
        &self.data
    }

    /// A flight from time zero, with the default tolerance.
    ///
    /// # Errors
    /// Those of [`Setup::start`].
    pub fn fly(&self) -> Result<Flight, Error> {
        self.start(0.0, DEFAULT_TOLERANCE)
    }

    /// Builds the vehicle and finds the initial state: a flight from `time` (s), with a relative
    /// tolerance of its integration and inputs at zero.
    ///
    /// # Errors
    /// [`Error::Trim`] if there is no trim, [`Error::StartOutside`] if the start values lie outside the
    /// region where the curve fits hold.
    pub fn start(&self, time: f64, tolerance: f64) -> Result<Flight, Error> {
        let Parameters { options, trim: trimmed, input_mode, alpha0, q0, eta0, offsets } =
            self.parameters;
        let vehicle = built(&self.data, &options)?;
        let steady = if trimmed {
            trim::trim(&vehicle, &options.condition)?
        } else {
            let mut state = options.condition.start(&vehicle.atmosphere);
            state[FUEL] = vehicle.fuel;
            state[ALPHA] = alpha0;
            state[Q] = q0;
            for (i, eta_i) in eta0.into_iter().enumerate().take(vehicle.modes) {
                state[eta(i)] = eta_i;
            }
            Trim { state, control: [0.0; 2] }
        };
        let mut state = steady.state;
        disturb(&vehicle, &mut state, &offsets);
        if !vehicle.holds(&state, &steady.control, [0.0; GUSTS]) {
            return Err(start_outside(&vehicle, &state, &steady, &self.parameters));
        }
        let deviation = trimmed && input_mode == InputMode::DeviationFromTrim;
        let about = match trimmed {
            true => steady,
            // Of the condition, so that a start from it flies as one with trim does.
            false => trim::trim(&vehicle, &options.condition).unwrap_or(steady),
        };
        Ok(Flight {
            base: if deviation { steady.control } else { [0.0; 2] },
            method: boxed(&vehicle, &about),
            vehicle,
            trim: steady,
            inputs: Inputs::ZERO,
            time,
            legs: None,
            integrator: Integrator::new(tolerance, FIRST_STEP),
            state,
            slope: None,
            sample: None,
            limit_said: [false; CONTROLS],
        })
    }
}

/// A vehicle, in a frame of its own: putting it together takes several times its room.
#[inline(never)]
fn built(data: &Data, options: &VehicleOptions) -> Result<Box<Vehicle>, Error> {
    Ok(Box::new(Vehicle::new(data, options)?))
}

/// The method for a vehicle, likewise.
#[inline(never)]
fn boxed(vehicle: &Vehicle, steady: &Trim) -> Box<Method> {
    Box::new(method(vehicle, steady))
}

/// Adds the offsets. Those of the sloshing masses are of their displacements: the slosh modes take what
/// the flexible ones leave.
fn disturb(vehicle: &Vehicle, state: &mut State, offsets: &Offsets) {
    state[ALPHA] += offsets.alpha;
    state[Q] += offsets.q;
    let slosh = &vehicle.airframe.slosh;
    for (first, offset) in [(eta(0), &offsets.displacement), (eta_dot(0), &offsets.rate)] {
        let mut modes = [0.0; MODES];
        modes[..FLEXIBLE].copy_from_slice(&offset[..FLEXIBLE]);
        let left: [f64; SLOSH] = std::array::from_fn(|tank| {
            let flexible = slosh[tank].iter().zip(&modes);
            offset[FLEXIBLE + tank] - flexible.map(|(per, eta)| per * eta).sum::<f64>()
        });
        if vehicle.modes == MODES && left != [0.0; SLOSH] {
            let [a, b] = [0, 1].map(|tank| [slosh[tank][FLEXIBLE], slosh[tank][FLEXIBLE + 1]]);
            let determinant = a[0] * b[1] - a[1] * b[0];
            modes[FLEXIBLE] = (left[0] * b[1] - a[1] * left[1]) / determinant;
            modes[FLEXIBLE + 1] = (a[0] * left[1] - left[0] * b[0]) / determinant;
        }
        for (i, eta) in modes.into_iter().enumerate().take(vehicle.modes) {
            state[first + 2 * i] += eta;
        }
    }
}

/// A start where the model does not hold, and the parameter that leads there.
fn start_outside(
    vehicle: &Vehicle,
    start: &State,
    steady: &Trim,
    parameters: &Parameters,
) -> Error {
    let still = [0.0; GUSTS];
    let limited = vehicle.tightest(start, &steady.control, still);
    let (offsets, options) = (&parameters.offsets, &parameters.options);
    let sloshing = |tank: usize| {
        let offset = offsets.displacement[FLEXIBLE + tank];
        // The flexible mode that moves the liquid of the tank most.
        let moved = |i: &usize| (vehicle.airframe.slosh[tank][*i] * parameters.eta0[*i]).abs();
        let bending = (0..FLEXIBLE)
            .max_by(|i, k| moved(i).total_cmp(&moved(k)))
            .filter(|i| !parameters.trim && moved(i) > 0.0);
        match bending {
            _ if offset != 0.0 => StartCause::SloshOffset(tank, offset),
            Some(i) => StartCause::Bending(i, parameters.eta0[i]),
            None if options.slosh_frequency > 0.0 => {
                StartCause::SloshFrequency(options.slosh_frequency)
            }
            None => StartCause::FuelFraction(options.fuel_fraction),
        }
    };
    let offset = StartCause::IncidenceOffset(offsets.alpha);
    let cause = match limited.kind {
        LimitedKind::Altitude => StartCause::Altitude(limited.value),
        LimitedKind::Mach => StartCause::Mach(options.condition.mach),
        LimitedKind::Incidence if parameters.trim || offsets.alpha != 0.0 => offset,
        LimitedKind::Incidence => StartCause::Incidence(limited.value),
        LimitedKind::Slosh(tank) => sloshing(tank),
        // The burner chokes: for the incidence, or for the fuel that the trim takes.
        _ if offsets.alpha != 0.0 && vehicle.holds(&steady.state, &steady.control, still) => offset,
        _ if parameters.trim => StartCause::TrimFuelRatio(steady.control[PHI]),
        _ => StartCause::Incidence(parameters.alpha0),
    };
    Error::StartOutside { limited, cause }
}
