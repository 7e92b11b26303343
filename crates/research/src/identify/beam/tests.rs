//! Known numbers are recovered, and sensitivities agree with Rayleigh's quotient.

use super::model::{DATA, Model, printed};
use super::numbers::{COORDINATES, STATIONS, names, rounded, values};
use super::report::sensitivity;
use crate::identify::levenberg_marquardt::minimise;
use ahv::data::{Data, DataFile, VehicleData};
use ahv::flight::Parameters;
use ahv::structure::{FLEXIBLE, Modes};
use ahv::vehicle::{Configuration, VehicleOptions, structure};
use nalgebra::DVector;

fn model() -> Model {
    Model::new(Data::embedded().unwrap(), printed().unwrap()).unwrap()
}

/// Level, tilt, the bend amidships, both centres, a length and the mass centre: as many as there are
/// data.
const FREE: [usize; DATA] = [0, 1, 4, 9, 10, 11, 13];

#[test]
fn seven_numbers_are_recovered_from_seven_data() {
    let mut truth = DVector::zeros(COORDINATES);
    for (i, value) in FREE.into_iter().zip([-0.1, 0.15, 0.3, -0.2, 0.25, 0.3, 0.5]) {
        truth[i] = value;
    }
    // The first even frequency sets the prior: that of the table, to stay with the same one.
    let mut model = model();
    let vehicle = model.prior.vehicle(&truth);
    model.wanted = model.found(&vehicle).unwrap();
    let held: Vec<_> = (0..COORDINATES).map(|i| !FREE.contains(&i)).collect();
    let mut point = DVector::zeros(COORDINATES);
    for weight in [1e6, 1e4, 1e2, 1.0, 1e-4] {
        let fit = minimise(&|p| model.residual(p), &point, &held, weight, (1e-7, 200)).unwrap();
        point = fit.point;
    }
    assert!((&point - &truth).amax() < 1e-4, "{point} is not {truth}");
}

/// By Rayleigh's quotient, d ln omega / d ln EI over all stations adds up to half of the share of
/// the strain energy that is in the beam.
#[test]
fn slopes_by_stiffness_add_up_to_half_of_the_beams_energy() {
    let data = Data::embedded().unwrap();
    let model = model();
    let slopes = sensitivity(&model, &data.vehicle).unwrap();
    let options = Parameters::new(&data).options;
    let columns = [Configuration::EvenMassBeam, Configuration::SloshBeam];
    for (column, configuration) in columns.into_iter().enumerate() {
        let (beam, oscillators) =
            structure(&data, &VehicleOptions { configuration, ..options }).unwrap();
        let modes = Modes::solve(&beam, &oscillators).unwrap();
        for mode in 0..FLEXIBLE {
            let row = slopes.row(column * FLEXIBLE + mode);
            let sum: f64 = row.columns(0, STATIONS).sum();
            let truth = modes.beam_energy_share[mode] / 2.0;
            assert!((sum - truth).abs() < 1e-7, "{configuration:?}, {mode}: {sum} is not {truth}");
        }
        if configuration == Configuration::EvenMassBeam {
            let tanks = slopes.view((0, STATIONS), (FLEXIBLE, slopes.ncols() - STATIONS));
            assert_eq!(tanks.amax(), 0.0, "tanks move no even frequency");
        }
    }
}

/// The sensitivities predict the effect of a change of one per cent.
#[test]
fn slopes_are_those_of_finite_changes() {
    let data = Data::embedded().unwrap();
    let model = model();
    let slopes = sensitivity(&model, &data.vehicle).unwrap();
    let before = model.found(&data.vehicle).unwrap();
    let mut moved = data.vehicle.clone();
    moved.beam.stiffness_n_m2_per_m.value[4] *= 1.01;
    let after = model.found(&moved).unwrap();
    for i in 0..DATA {
        let (change, told) = (libm::log(after[i] / before[i]), slopes[(i, 4)] * libm::log(1.01));
        // The second derivative contributes about a per cent.
        assert!((change - told).abs() < 0.02 * told.abs() + 1e-6, "{change} is not {told}");
    }
}

#[test]
fn a_file_that_is_already_right_stays_as_it_is() {
    let data = *Data::embedded().unwrap().vehicle;
    let text = ahv::data::VEHICLE.text;
    assert_eq!(values(&rounded(data.clone())), values(&data));
    let known: Vec<_> = names().iter().map(|_| "all digits".to_string()).collect();
    let again = super::file(text, &data, &known).unwrap();
    assert_eq!(values(&VehicleData::parse("again", &again).unwrap()), values(&data));
    // Everything else is unchanged.
    let rest = |text: &str| -> Vec<String> {
        let own = |line: &&str| !line.contains("identify beam");
        text.lines().filter(own).map(str::to_string).collect()
    };
    assert_eq!(rest(&again), rest(text));
    assert_eq!(again.matches("all digits").count(), names().len() + 1, "the share occurs twice");
}
