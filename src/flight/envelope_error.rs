//! Why a flight ends.

use super::controlled_vehicle::in_effect;
use super::inputs::Inputs;
use crate::error::Error;
use crate::vehicle::{Control, FUEL, State, Vehicle};

/// First look beyond the last valid instant, s, and how often it is doubled: to a second.
const LOOK: f64 = 1e-9;
const LOOKS: u32 = 30;

/// What ends a flight: of all that limits it, what does not hold a moment later, along the rates. The
/// nearest limit need not be the one: of fuel for a microsecond nearly all may be left.
pub(super) fn envelope_error(
    vehicle: &Vehicle,
    base: &Control,
    x: &State,
    inputs: &Inputs,
    time_s: f64,
) -> Error {
    let (control, gust) = in_effect(vehicle, base, &inputs.values);
    // Not `derivatives`: a second call of it would keep it from being inlined in the steps.
    let (rates, _) = vehicle.derivatives_and_outputs(x, &control, gust);
    let looks = (0..LOOKS).map(|doublings| LOOK * f64::from(1 << doublings));
    let beyond = std::iter::once(0.0).chain(looks).find_map(|later| {
        let x: State = std::array::from_fn(|i| x[i] + later * rates[i]);
        let (control, gust) = in_effect(vehicle, base, &inputs.at(later));
        (!vehicle.holds(&x, &control, gust)).then_some((x, control, gust))
    });
    let (outside, u, wind) = beyond.unwrap_or((*x, control, gust));
    let tightest = vehicle.tightest(&outside, &u, wind);
    if vehicle.fuel_table.is_some() && outside[FUEL] <= tightest.margin() * vehicle.fuel {
        return Error::Fuel { time_s };
    }
    let limited = vehicle
        .limited_quantities(x, &control, gust)
        .find(|limited| limited.kind == tightest.kind)
        .unwrap_or(tightest);
    Error::Envelope { limited, time_s }
}
