//! A package with data of its own, as a master instantiates it.

use super::{Api, Slave};
use crate::common::reference;
use crate::master::Api as _;
use ahv::data::{Data, OwnFile, OwnFiles, PARKER2007, VEHICLE};
use ahv::flight::Setup;
use ahv::variables::TABLE;
use fmi_model::identity::{guid, guid_of};
use fmi_model::instance::Interface;
use fmi_model::standard::Standard;
use fmi_model::status::Status;
use fmi_model::{Kind, Model, Role, location};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Our vehicle, which starts higher, and the published coefficients as its own.
fn files() -> OwnFiles {
    let vehicle = VEHICLE.text.replacen("value = 25900", "value = 26500", 1);
    let file = |name: &str, text: String| Some(OwnFile { name: name.to_string(), text });
    OwnFiles {
        vehicle: file(OwnFiles::VEHICLE, vehicle),
        coefficients: file(OwnFiles::COEFFICIENTS, PARKER2007.text.to_string()),
    }
}

fn setup(files: &OwnFiles) -> Setup {
    Setup::of(Data::with(files).unwrap())
}

/// A folder of resources with these files, and how a master names it; its name has what a URI encodes.
fn resources(files: &OwnFiles) -> (TempDir, String) {
    let directory = TempDir::with_prefix("mine 100% grün ").unwrap();
    for file in [&files.vehicle, &files.coefficients].into_iter().flatten() {
        fs::write(directory.path().join(&file.name), &file.text).unwrap();
    }
    let place = match Api::STANDARD {
        Standard::Fmi2 => location::uri(directory.path()),
        Standard::Fmi3 => directory.path().to_str().unwrap().to_string(),
    };
    (directory, place)
}

fn instance<'a>(api: &'a Api, guid: &str, folder: &str) -> Result<Slave<'a>, String> {
    let made = Slave::of_package(api, Interface::CoSimulation, guid, Some(folder), false);
    made.map_err(|log| {
        assert_eq!((log.len(), log[0].status), (1, Status::Error), "{log:?}");
        log[0].message.clone()
    })
}

#[test]
fn an_own_vehicle_has_its_own_defaults_items_and_flight() {
    let api = Api::load();
    let files = files();
    for files in [
        OwnFiles { coefficients: None, ..files.clone() },
        OwnFiles { vehicle: None, ..files.clone() },
        files,
    ] {
        let (setup, (directory, uri)) = (setup(&files), resources(&files));
        let token = guid_of(setup.identity());
        let path = directory.path().to_str().unwrap();
        for folder in [uri.clone(), format!("{uri}/"), path.to_string()] {
            let own = instance(&api, &token, &folder).unwrap();
            assert_eq!(own.begin(), Status::Ok);
            for variable in &TABLE {
                let Role::Parameter { .. } = variable.role else { continue };
                let value = variable.start(&setup).unwrap();
                if let Kind::Real(_) = variable.kind {
                    assert_eq!(own.get(variable.name), value, "{}", variable.name);
                }
            }
            let has_own = if files.coefficients.is_some() { Status::Ok } else { Api::REFUSED };
            assert_eq!(own.set_enumeration("aero", 4), has_own);
            assert_eq!(own.exit(), Status::Ok);
            for step in 0..20 {
                assert_eq!(own.step(f64::from(step) * 0.01, 0.01), Status::Ok);
            }
            let trimmed = setup.fly().unwrap().trim().state[ahv::vehicle::ALPHA];
            assert_eq!(own.get("alpha_trim").to_bits(), trimmed.to_bits());
        }
    }
}

#[test]
fn two_vehicles_in_one_process_do_not_meet_and_refuse_the_others_states() {
    let api = Api::load();
    let files = files();
    let (_directory, uri) = resources(&files);
    let token = guid_of(setup(&files).identity());
    let fly = |slave: &Slave| {
        slave.start_as(3);
        for step in 0..20 {
            assert_eq!(slave.step(f64::from(step) * 0.01, 0.01), Status::Ok);
        }
        slave.bits()
    };
    let alone = [fly(&Slave::new(&api)), fly(&instance(&api, &token, &uri).unwrap())];
    assert_ne!(alone[0], alone[1]);
    let (ours, own) = (Slave::new(&api), instance(&api, &token, &uri).unwrap());
    for slave in [&ours, &own] {
        slave.start_as(3);
    }
    for step in 0..20 {
        for slave in [&ours, &own] {
            assert_eq!(slave.step(f64::from(step) * 0.01, 0.01), Status::Ok);
        }
    }
    assert_eq!([ours.bits(), own.bits()], alone);
    let states = [&ours, &own].map(|slave| {
        let state = slave.save();
        let bytes = slave.bytes(state);
        slave.free(state);
        bytes
    });
    for (slave, theirs) in [(&ours, &states[1]), (&own, &states[0])] {
        let (status, state) = slave.state_of(theirs);
        assert!(status == Status::Error && state.is_null());
        let message = slave.message().message;
        assert!(message.contains("of this model") && message.contains("another"), "{message}");
    }
    let (status, state) = own.state_of(&states[1]);
    assert_eq!((status, own.load(state)), (Status::Ok, Status::Ok));
    own.free(state);
    assert_eq!((own.reset(), fly(&own)), (Status::Ok, alone[1].clone()));
}

#[test]
fn data_that_are_not_those_of_the_description_are_refused_by_name() {
    let api = Api::load();
    let files = files();
    let (directory, uri) = resources(&files);
    let token = guid_of(setup(&files).identity());
    let other = "{00000000-0000-0000-0000-000000000000}";
    let refused = instance(&api, other, &uri).err().unwrap();
    assert!(refused.contains(&format!("belong to {token}")), "{refused}");
    assert!(instance(&api, &guid::<Setup>(), &uri).is_ok(), "the built-in vehicle reads nothing");
    let file = directory.path().join(OwnFiles::VEHICLE);
    let text = fs::read_to_string(&file).unwrap();
    let huge = " ".repeat(1_000_001);
    for (damaged, told) in [
        (text.replacen("value = 26500", "value = 26501", 1), "belong to {"),
        (
            text.replacen("value = 30.48", "value = -1", 1),
            "geometry.length_m: -1 must lie in [0.001",
        ),
        (text[..text.len() / 2].to_string(), "vehicle.toml: "),
        ("[".repeat(100_000), "vehicle.toml: line 1: "),
        (huge, "more than 1 MB"),
    ] {
        fs::write(&file, damaged).unwrap();
        let refused = instance(&api, &token, &uri).err().unwrap();
        assert!(refused.contains(told), "{told}: {refused}");
    }
    fs::write(&file, b"\xff\xfe").unwrap();
    let refused = instance(&api, &token, &uri).err().unwrap();
    assert!(refused.contains("vehicle.toml cannot be read"), "{refused}");
    for name in [OwnFiles::VEHICLE, OwnFiles::COEFFICIENTS] {
        fs::remove_file(directory.path().join(name)).unwrap();
    }
    let refused = instance(&api, &token, &uri).err().unwrap();
    assert!(refused.contains(&format!("belong to {}", guid::<Setup>())), "{refused}");
    let nowhere = Slave::of_package(&api, Interface::CoSimulation, &token, None, false);
    let log = nowhere.err().unwrap();
    assert!(log[0].message.contains("does not say where the resources are"), "{log:?}");
}

#[test]
#[cfg(unix)]
fn only_regular_files_are_read() {
    let api = Api::load();
    let files = files();
    let token = guid_of(setup(&files).identity());
    let (directory, _) = resources(&files);
    let scratch = TempDir::new().unwrap();
    let file = scratch.path().join(OwnFiles::VEHICLE);
    let folder = scratch.path().to_str().unwrap();
    let no_file = |what: &str| {
        let refused = instance(&api, &token, folder).err().unwrap();
        assert!(refused.contains("it is no regular file"), "{what}: {refused}");
    };
    fs::create_dir(&file).unwrap();
    no_file("a folder");
    fs::remove_dir(&file).unwrap();
    for target in [Path::new("/dev/zero"), &directory.path().join(OwnFiles::VEHICLE)] {
        std::os::unix::fs::symlink(target, &file).unwrap();
        no_file("a link");
        fs::remove_file(&file).unwrap();
    }
    assert!(std::process::Command::new("mkfifo").arg(&file).status().unwrap().success());
    no_file("a pipe");
}

#[test]
fn the_description_of_an_own_vehicle_has_what_depends_on_its_data() {
    let files = files();
    let (setup, built_in) = (setup(&files), Setup::new().unwrap());
    assert_ne!(setup.identity(), built_in.identity());
    assert_eq!(
        setup.description(),
        format!("{}; data: vehicle.toml, aero.toml", built_in.description())
    );
    let aero = &TABLE[reference("aero") as usize];
    let items = |setup: &Setup| match aero.kind_in(setup) {
        Kind::Enumeration(_, items) => items.len(),
        _ => 0,
    };
    assert_eq!([items(&built_in), items(&setup)], [3, 4]);
    assert_eq!([aero.start(&built_in), aero.start(&setup)], [Some(1.0), Some(4.0)]);
    let refused = aero.check(&built_in, 4.0).unwrap_err().to_string();
    assert!(refused.ends_with("1 xu2015, 2 parker2007, 3 shock_expansion"), "{refused}");
}
