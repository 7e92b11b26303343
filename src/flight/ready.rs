//! What the parameters alone decide: vehicle, trim, and what the inputs are added to.

use crate::decoupling::Decoupling;
use crate::dynamics::{Control, FUEL, NOMINAL, RIGID, STATES, State, Vehicle};
use crate::error::Error;
use crate::exponential::Exponential;
use crate::linear::Linear;
use crate::modes::MODES;
use crate::parameters::{InputMode, Parameters};
use crate::trim::{self, Trim};
use crate::vehicle::Data;

/// An initialised flight's vehicle.
#[derive(Debug, Clone)]
pub struct Ready {
    pub vehicle: Vehicle,
    pub trim: Trim,
    /// What the inputs are added to: the trim where they are deviations.
    pub base: Control,
    /// Integrates between the master's instants.
    pub method: Exponential<STATES, SLOW, FAST>,
}

impl Ready {
    /// Builds the vehicle and finds its initial state.
    fn new(data: &Data, parameters: &Parameters) -> Result<Self, Error> {
        let Parameters { build, trim: trimmed, input_mode, alpha0, q0, eta0 } = *parameters;
        let vehicle = Vehicle::new(data, &build)?;
        let trim = if trimmed {
            trim::trim(&vehicle, &build.condition)?
        } else {
            let mut state = build.condition.start(&vehicle.atmosphere);
            state[FUEL] = vehicle.fuel;
            state[3] = alpha0;
            state[4] = q0;
            for (i, eta) in eta0.into_iter().enumerate().take(vehicle.modes) {
                state[RIGID + 2 * i] = eta;
            }
            if !vehicle.aero.envelope.holds(&vehicle.atmosphere, &state) {
                return Err(start_outside(&vehicle, &state));
            }
            Trim { state, control: [0.0; 2] }
        };
        let deviation = trimmed && input_mode == InputMode::DeviationFromTrim;
        let base = if deviation { trim.control } else { [0.0; 2] };
        let steady = match trimmed {
            true => trim,
            // Of the condition, so that a start from it flies as one with trim does.
            false => trim::trim(&vehicle, &build.condition).unwrap_or(trim),
        };
        let method = method(&vehicle, &steady);
        Ok(Self { vehicle, trim, base, method })
    }

    /// What is in the slot; an empty one is filled, and the state becomes the initial one.
    pub fn of<'a>(
        slot: &'a mut Option<Self>,
        state: &mut State,
        data: &Data,
        parameters: &Parameters,
    ) -> Result<&'a mut Self, Error> {
        match slot {
            Some(ready) => Ok(ready),
            None => {
                let ready = Self::new(data, parameters)?;
                *state = ready.trim.state;
                Ok(slot.insert(ready))
            }
        }
    }
}

/// Incidence, pitch rate and modes: the states that move fast.
const FAST: usize = 2 + 2 * MODES;
/// Those before them.
const SLOW: usize = RIGID - 2;

/// The method for a vehicle, its fast motion decoupled about steady flight.
pub fn method(vehicle: &Vehicle, steady: &Trim) -> Exponential<STATES, SLOW, FAST> {
    let jacobian = Linear::new(vehicle, &steady.state, &steady.control).a;
    Exponential::new(Decoupling::new(&jacobian, &NOMINAL))
}

/// Start values without trim, by the names of their parameters.
fn start_outside(vehicle: &Vehicle, state: &State) -> Error {
    let tightest = vehicle.aero.envelope.tightest(&vehicle.atmosphere, state);
    let variable = match tightest.variable {
        "h" => "altitude0",
        "mach" => "mach0",
        _ => "alpha0",
    };
    let [min, max] = tightest.limits;
    let expected = format!("the curve fits hold in [{min:.6}, {max:.6}]");
    Error::Value { variable: variable.into(), value: tightest.value, expected }
}
