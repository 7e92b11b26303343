//! Shared by the integration tests.
#![allow(dead_code)]

use ahv::data::{AeroSet, Data};
use ahv::flight::{Flight, Parameters, Setup};
use ahv::vehicle::{Configuration, NOMINAL, STATES, State, Vehicle, VehicleOptions};
use fmi_model::table::find;

pub const CONFIGURATIONS: [Configuration; 3] =
    [Configuration::Rigid, Configuration::EvenMassBeam, Configuration::SloshBeam];

pub const AERO_SETS: [AeroSet; 3] = [AeroSet::Xu2015, AeroSet::Parker2007, AeroSet::ShockExpansion];

pub fn data() -> Data {
    Data::embedded().expect("the embedded data are valid")
}

/// The data with another lower wall, duct and gas.
pub fn other_engine(lower: f64, duct: f64, contraction: f64, gamma: f64) -> Data {
    let mut data = data();
    data.vehicle.outline.lower_angle_rad.value = lower;
    data.vehicle.engine.duct_height_m.value = duct;
    data.vehicle.engine.nozzle_area_ratio.value = contraction;
    data.earth.air.heat_capacity_ratio.value = gamma;
    data
}

/// The default build of a configuration.
pub fn options(configuration: Configuration) -> VehicleOptions {
    VehicleOptions { configuration, ..Parameters::new(&data()).options }
}

pub fn vehicle(configuration: Configuration) -> Vehicle {
    Vehicle::new(&data(), &options(configuration)).expect("the default vehicle can be built")
}

/// The vehicle with a coefficient set of choice.
pub fn vehicle_with(aero: AeroSet, configuration: Configuration) -> Vehicle {
    let options = VehicleOptions { aero, ..options(configuration) };
    Vehicle::new(&data(), &options).expect("the default vehicle can be built")
}

/// The default builds of all configurations with all coefficient sets.
pub fn builds() -> impl Iterator<Item = VehicleOptions> {
    CONFIGURATIONS.into_iter().flat_map(|configuration| {
        AERO_SETS.map(|aero| VehicleOptions { aero, ..options(configuration) })
    })
}

/// A trimmed default flight.
pub fn flight(configuration: Configuration) -> Flight {
    flight_with(|parameters| parameters.options.configuration = configuration)
}

/// A flight with other parameters than the default ones.
pub fn flight_with(edit: impl FnOnce(&mut Parameters)) -> Flight {
    let mut setup = Setup::new().expect("the embedded data are valid");
    edit(&mut setup.parameters);
    setup.fly().unwrap_or_else(|error| panic!("{error}"))
}

/// Default parameters, but for variables of the table.
pub fn setup(settings: &[(&str, f64)]) -> Setup {
    let mut setup = Setup::new().expect("the embedded data are valid");
    for (name, value) in settings {
        let variable = find::<Setup>(name).expect(name);
        variable.set(&mut setup, *value).unwrap_or_else(|error| panic!("{error}"));
    }
    setup
}

/// What a variable of the table is in a flight; not of parameters.
pub fn shown(flight: &mut Flight, name: &str) -> f64 {
    let default = Setup::new().expect("the embedded data are valid");
    let variable = find::<Setup>(name).expect(name);
    variable.value(&default, flight).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// |a - b| relative to the larger of |b| and `floor`.
pub fn deviation(a: f64, b: f64, floor: f64) -> f64 {
    (a - b).abs() / b.abs().max(floor)
}

/// Largest deviation of a state, with its typical size for floor.
pub fn distance(a: &State, b: &State) -> f64 {
    (0..STATES).map(|i| deviation(a[i], b[i], NOMINAL[i])).fold(0.0, f64::max)
}

pub fn assert_close(what: &str, got: f64, expected: f64, tolerance: f64) {
    let deviation = deviation(got, expected, f64::MIN_POSITIVE);
    assert!(
        deviation <= tolerance,
        "{what}: {got} against {expected}, off by {deviation:.2e} (limit {tolerance:.0e})"
    );
}
