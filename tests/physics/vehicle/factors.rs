//! Each factor against the same change made in the text of a data file.

use super::edited::{SETS, Texts, add, edit};
use crate::model::{CONFIGURATIONS, data, options, setup};
use ahv::data::AeroSet;
use ahv::dynamics::linear::LinearModel;
use ahv::dynamics::trim::trim;
use ahv::error::{Error, StartCause};
use ahv::flight::Setup;
use ahv::fmu::Message;
use ahv::vehicle::{Configuration, Factors, Vehicle, VehicleOptions};
use fmi_model::table::find;

/// The mass centre moved twice, or once by the sum: a rounding of metres, which trim and modes multiply.
const ROUNDING: f64 = 1e-9;

/// Where a number stands.
enum File {
    Vehicle,
    Earth,
    Set,
}

/// Name of the variable, its field, and the keys that it multiplies: file, table, names.
type Row = (
    &'static str,
    fn(&mut Factors) -> &mut f64,
    &'static [(File, &'static str, &'static [&'static str])],
);

const BODY: &[&str] = &["constant", "alpha", "alpha2", "alpha3"];
const ELEVATOR: &[&str] = &["delta_e", "delta_e2", "delta_e3", "alpha_delta_e"];

const ROWS: [Row; 11] = [
    (
        "mass_factor",
        |f| &mut f.mass,
        &[(File::Vehicle, "mass", &["fore_beam_kg_per_m2", "aft_beam_kg_per_m2"])],
    ),
    ("inertia_factor", |f| &mut f.inertia, &[(File::Set, "inertia", &["i_yy_kg_m2_per_m"])]),
    ("density_factor", |f| &mut f.density, &[(File::Earth, "air", &["sea_level_pressure_pa"])]),
    ("lift_factor", |f| &mut f.lift, &[(File::Set, "lift", BODY), (File::Set, "lift_phi", BODY)]),
    ("drag_factor", |f| &mut f.drag, &[(File::Set, "drag", BODY), (File::Set, "drag_phi", BODY)]),
    (
        "moment_alpha_factor",
        |f| &mut f.moment_alpha,
        &[(File::Set, "moment", &["alpha", "alpha2"])],
    ),
    (
        "elevator_factor",
        |f| &mut f.elevator,
        &[
            (File::Set, "lift", ELEVATOR),
            (File::Set, "drag", ELEVATOR),
            (File::Set, "moment", ELEVATOR),
        ],
    ),
    (
        "thrust_factor",
        |f| &mut f.thrust,
        &[(File::Set, "thrust", BODY), (File::Set, "thrust_phi", BODY)],
    ),
    ("elastic_factor", |f| &mut f.elastic, &[(File::Set, "reference", &["elastic_scale"])]),
    (
        "stiffness_factor",
        |f| &mut f.stiffness,
        &[(File::Vehicle, "beam", &["stiffness_n_m2_per_m"])],
    ),
    (
        "structural_damping_factor",
        |f| &mut f.structural_damping,
        &[(File::Set, "inertia", &["structural_damping"])],
    ),
];

/// The texts with the keys of a row times a factor.
fn multiplied((name, _, changes): &Row, factor: f64) -> Texts {
    let mut texts = Texts::new();
    for set in 0..SETS.len() {
        let mut found = 0;
        for (file, table, keys) in *changes {
            for key in *keys {
                let text = match file {
                    File::Set => &mut texts.sets[set],
                    // Once is enough.
                    _ if set > 0 => continue,
                    File::Vehicle => &mut texts.vehicle,
                    File::Earth => &mut texts.earth,
                };
                found += usize::from(edit(text, table, key, &|value| value * factor));
            }
        }
        assert!(found > 0 || set > 0, "{name} changes nothing in the files of set {set}");
    }
    texts
}

/// All that a vehicle flies by: its numbers, trim and linear model at the condition, and burn.
fn numbers(vehicle: &Vehicle, options: &VehicleOptions) -> Vec<f64> {
    let mut numbers = vehicle.airframe.to_row().to_vec();
    numbers.extend(vehicle.omega);
    let steady = trim(vehicle, &options.condition).unwrap_or_else(|error| panic!("{error}"));
    numbers.extend(steady.state);
    numbers.extend(steady.control);
    let LinearModel { a, b, .. } = LinearModel::new(vehicle, &steady.state, &steady.control);
    numbers.extend(a.iter().chain(b.iter()));
    if let Some(burn) = &vehicle.fuel_table {
        for part in [1.0, 0.61, 0.2, 0.003] {
            numbers.extend(burn.airframe(vehicle.fuel * part).to_row());
        }
    }
    numbers
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

fn assert_alike(row: &Row, factor: f64, options: &VehicleOptions) {
    let (plain, texts) = (data(), multiplied(row, factor).data());
    let mut factors = Factors::default();
    *row.1(&mut factors) = factor;
    let asked = Vehicle::new(&plain, &VehicleOptions { factors, ..*options }).unwrap();
    let written = Vehicle::new(&texts, options).unwrap();
    let [asked, written] = [asked, written].map(|vehicle| numbers(&vehicle, options));
    assert_eq!(bits(&asked), bits(&written), "{} = {factor}: {options:?}", row.0);
    // What does not bend has no use for the last three.
    if options.configuration != Configuration::Rigid {
        let without = numbers(&Vehicle::new(&plain, options).unwrap(), options);
        assert_ne!(bits(&asked), bits(&without), "{} does nothing", row.0);
    }
}

#[test]
fn verif_a_factor_is_the_same_change_in_the_file_bit_for_bit() {
    for row in &ROWS {
        for configuration in CONFIGURATIONS {
            for aero in SETS {
                for factor in [1.03, 0.96] {
                    assert_alike(row, factor, &VehicleOptions { aero, ..options(configuration) });
                }
            }
        }
    }
}

#[test]
fn verif_a_factor_is_the_same_change_in_the_file_while_fuel_burns() {
    let burning = VehicleOptions { fuel_burn: true, ..options(Configuration::SloshBeam) };
    for row in &ROWS {
        assert_alike(row, 1.03, &burning);
    }
}

#[test]
fn verif_a_shift_of_the_mass_centre_is_the_same_shift_in_the_file() {
    const SHIFT: f64 = 0.31;
    let key = "mass_centre_shift_m";
    let mut texts = Texts::new();
    for text in &mut texts.sets {
        if !edit(text, "inertia", key, &|shift| shift + SHIFT) {
            let line = format!(
                "{key} = {{ value = {SHIFT}, unit = \"m\", source = \"a test\", status = \"assumed\" }}"
            );
            add(text, "inertia", &line);
        }
    }
    let (plain, texts) = (data(), texts.data());
    let factors = Factors { mass_centre_shift_m: SHIFT, ..Factors::default() };
    for fuel_burn in [false, true] {
        for (aero, configuration) in
            SETS.into_iter().flat_map(|set| CONFIGURATIONS.map(|c| (set, c)))
        {
            if fuel_burn && (aero, configuration) != (AeroSet::Xu2015, Configuration::SloshBeam) {
                continue;
            }
            let options = VehicleOptions { aero, fuel_burn, ..options(configuration) };
            let asked = Vehicle::new(&plain, &VehicleOptions { factors, ..options }).unwrap();
            let without = Vehicle::new(&plain, &options).unwrap();
            let moved = asked.airframe.mass_centre - without.airframe.mass_centre;
            assert!((moved - SHIFT).abs() < 1e-12, "{moved}");
            if configuration == Configuration::Rigid {
                // The file's is that of the flexible ones.
                let written = Vehicle::new(&texts, &options).unwrap();
                assert_eq!(written.airframe.mass_centre, without.airframe.mass_centre);
                continue;
            }
            let written = Vehicle::new(&texts, &options).unwrap();
            let [asked, written] = [asked, written].map(|vehicle| numbers(&vehicle, &options));
            for (i, (asked, written)) in asked.into_iter().zip(written).enumerate() {
                let off = (asked - written).abs() / written.abs().max(1.0);
                assert!(off < ROUNDING, "{options:?}, number {i}: {asked}, {written}, {off:.1e}");
            }
        }
    }
}

#[test]
fn verif_factors_without_a_trim_are_refused_with_the_limit() {
    for configuration in CONFIGURATIONS {
        for (settings, limit) in [
            ([("density_factor", 0.1), ("lift_factor", 1.0)], "alpha = "),
            ([("elevator_factor", 0.3), ("mass_factor", 1.2)], "delta_e = "),
            ([("thrust_factor", 0.1), ("drag_factor", 2.0)], "phi = "),
        ] {
            let mut setup = setup(&settings);
            setup.parameters.options.configuration = configuration;
            setup.parameters.options.aero = AeroSet::Parker2007;
            let error = setup.fly().unwrap_err();
            assert!(matches!(error, Error::Trim { .. }), "{settings:?}: {error}");
            let text = Message(error).to_string();
            assert!(text.contains(limit) && text.contains("is beyond ["), "{settings:?}: {text}");
        }
        // The first-principles engine chokes before it needs more fuel than it can get.
        let mut setup = setup(&[("thrust_factor", 0.1)]);
        setup.parameters.options.configuration = configuration;
        setup.parameters.options.aero = AeroSet::ShockExpansion;
        let error = setup.fly().unwrap_err();
        let Error::StartOutside { cause: StartCause::TrimFuelRatio(phi), .. } = error else {
            panic!("{error}")
        };
        let told = Message(error).to_string();
        assert!(told.starts_with(&format!("phi_trim = {phi} ")), "{told}");
        assert!(told.contains("it makes choking_margin -"), "{told}");
    }
}

#[test]
fn verif_an_inertia_that_no_body_has_is_refused_in_a_flight_too() {
    let setup = setup(&[("inertia_factor", 0.1), ("mass_centre_shift", 3.0)]);
    let error = setup.fly().unwrap_err();
    let Error::Inertia { inertia, least, .. } = error else { panic!("{error}") };
    assert!(inertia < least, "{inertia} {least}");
    assert!(Message(error).to_string().contains("inertia_factor"));
}

#[test]
fn verif_a_factor_that_is_none_is_refused_by_name_value_and_range() {
    let none = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for (name, ..) in &ROWS {
        for value in none.into_iter().chain([0.0, -0.0, -1.0, 1e9]) {
            assert_refused(name, value);
        }
    }
    for name in ["mass_centre_shift", "pitch_rate_factor"] {
        for value in none.into_iter().chain([-3.1, 10.1]) {
            assert_refused(name, value);
        }
        setup(&[(name, 0.0)]).fly().unwrap();
    }
}

fn assert_refused(name: &str, value: f64) {
    let (variable, mut setup) = (find::<Setup>(name).unwrap(), setup(&[]));
    let before = setup.clone();
    let error = variable.set(&mut setup, value).unwrap_err();
    let text = error.to_string();
    assert_eq!((error.variable, error.value.to_bits()), (name, value.to_bits()));
    let [min, max] = variable.range.unwrap();
    let range = if value.is_finite() { format!("[{min}, {max}]") } else { "finite".into() };
    assert!(text.contains(name) && text.contains(&range), "{text}");
    assert_eq!(setup, before);
}

#[test]
fn verif_without_factors_the_files_are_flown_bit_for_bit() {
    for configuration in CONFIGURATIONS {
        let options = options(configuration);
        assert_eq!(options.factors, Factors::default());
        let read = Texts::new().data();
        let [one, other] =
            [&data(), &read].map(|data| numbers(&Vehicle::new(data, &options).unwrap(), &options));
        assert_eq!(bits(&one), bits(&other));
    }
}
