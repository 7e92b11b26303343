//! Where sensors are: between the nodes of the beam, at the mass centre, off the body.

use crate::model::{data, flight, options, setup};
use ahv::error::Error;
use ahv::flight::Setup;
use ahv::fmu::Message;
use ahv::vehicle::{Body, Configuration, DELTA_E, Vehicle, VehicleDefinition};
use fmi_model::table::find;

#[test]
fn verif_between_the_nodes_a_sensor_is_on_the_cubic_of_its_element() {
    let data = data();
    let plain = options(Configuration::SloshBeam);
    let shapes = Body::new(&VehicleDefinition::new(&data, &plain)).unwrap().displacements();
    let element =
        data.vehicle.geometry.length_m.value / f64::from(data.vehicle.beam.elements.value);
    for (node, part) in [(0, 0.25), (137, 0.5), (499, 0.9)] {
        let mut options = plain;
        options.stations.imu = (node as f64 + part) * element;
        let vehicle = Vehicle::new(&data, &options).unwrap();
        for (i, shape) in shapes.iter().enumerate() {
            let [w0, s0, w1, s1] = [0, 1, 2, 3].map(|k| shape[2 * node + k]);
            // Divided differences of Hermite's interpolation.
            let mean = (w1 - w0) / element;
            let (second, third) = (mean - s0, s1 - 2.0 * mean + s0);
            let w = w0 + element * part * (s0 + part * (second + (part - 1.0) * third));
            let slope = s0 + 2.0 * part * second + (3.0 * part - 2.0) * part * third;
            for (got, expected) in [(0, w), (1, slope)] {
                let off = (vehicle.airframe.imu[got][i] - expected).abs();
                assert!(off < 1e-12, "mode {i} at {}: {off:.1e}", options.stations.imu);
            }
        }
    }
}

#[test]
fn verif_at_the_mass_centre_of_a_rigid_body_sensors_show_the_states() {
    let centre = flight(Configuration::Rigid).vehicle().airframe.mass_centre;
    let mut flight = setup(&[
        ("configuration", 1.0),
        ("imu_station", centre),
        ("probe_station", centre),
        ("q_offset", 0.05),
        ("alpha_offset", 0.01),
    ])
    .fly()
    .unwrap();
    flight.set_input(DELTA_E, 0.02);
    let loads = flight.evaluate().unwrap().outputs.loads;
    let mut shown = |name: &str| crate::model::shown(&mut flight, name);
    let weight = shown("n_z") / loads.normal;
    let (sin, cos) = shown("alpha").sin_cos();
    let axial = loads.drag * cos - loads.lift * sin;
    // The thrust is along the axis: across it there is none of it, along it all of it.
    for (name, expected) in [
        ("gamma_imu", shown("gamma")),
        ("theta_imu", shown("theta")),
        ("q_imu", shown("q")),
        ("n_z_imu", shown("n_z")),
        ("n_x_imu", (loads.thrust - axial) * weight),
        ("alpha_probe", shown("alpha")),
    ] {
        let off = (shown(name) - expected).abs();
        assert!(off < 1e-14, "{name}: {} and {expected}", shown(name));
    }
}

#[test]
fn verif_a_sensor_off_the_body_is_refused_by_name_value_and_range() {
    let length = data().vehicle.geometry.length_m.value;
    for name in ["imu_station", "probe_station"] {
        let variable = find::<Setup>(name).unwrap();
        for (value, told) in [(-1e-9, "-1e-9"), (1e4, "10000"), (f64::NAN, "NaN")] {
            let text = variable.set(&mut setup(&[]), value).unwrap_err().to_string();
            assert!(text.contains(name) && text.contains(told), "{text}");
        }
        let error = setup(&[(name, length + 1e-9)]).fly().unwrap_err();
        let Error::SensorOffBody { station_m, .. } = error else { panic!("{error}") };
        assert_eq!(station_m, length + 1e-9);
        let told = Message(error).to_string();
        assert!(told.starts_with(&format!("{name} = {station_m} is refused")), "{told}");
        assert!(told.contains(&format!("from 0 to {length} m")), "{told}");
        for end in [0.0, length] {
            setup(&[(name, end)]).fly().unwrap();
        }
    }
}
