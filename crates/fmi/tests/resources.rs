//! A model with data in the resources of its package.
#![allow(missing_docs)]

use fmi_model::failure::Failure;
use fmi_model::identity::{fnv, guid_of, hash_of_table};
use fmi_model::instance::{Instance, Interface};
use fmi_model::instantiate::{NotInstantiated, Request};
use fmi_model::{About, Kind, Model, ModelError, Refused, Resources, Saving, Simulation, Variable};
use std::path::{Path, PathBuf};

/// A model that names one of two letters, or of three, if its package has a file `third`.
#[derive(Debug, Clone, PartialEq)]
struct Letters {
    third: bool,
    letter: f64,
}

#[derive(Debug)]
struct Named(f64);

#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct Unreadable(&'static str);

impl ModelError for Unreadable {}

const LETTERS: &[(&str, i32, &str)] = &[("a", 1, ""), ("b", 2, ""), ("c", 3, "")];

impl Model for Letters {
    type Simulation = Named;
    type Error = Unreadable;

    const ABOUT: About = About::new("letters", "1");
    const VARIABLES: &'static [Variable<Self>] = &[Variable::parameter(
        "letter",
        Kind::Enumeration("Letter", LETTERS),
        "Letter",
        |letters: &Self| letters.letter,
        |letters, value| letters.letter = value,
    )
    .with_items(|letters| &LETTERS[..2 + usize::from(letters.third)])];
    const RESOURCES: Resources<Self> = Resources::Identified(|folder| match folder.join("third") {
        file if file.is_file() => Ok(Self { third: true, letter: 3.0 }),
        _ => Err(Unreadable("there is no file third")),
    });

    fn new() -> Result<Self, Unreadable> {
        Ok(Self { third: false, letter: 1.0 })
    }

    fn identity(&self) -> u128 {
        if self.third { fnv(Self::IDENTITY, b"third") } else { Self::IDENTITY }
    }

    fn start(&self, time_s: f64, _tolerance: f64) -> Result<Named, Unreadable> {
        Ok(Named(time_s))
    }
}

impl Simulation for Named {
    type Sample = ();
    type Error = Unreadable;

    const SAVING: Option<Saving<Self>> = Some(Saving {
        count: 1,
        save: |named, numbers| numbers.push(named.0),
        check: |numbers| numbers[0].is_finite(),
        load: |named, numbers| named.0 = numbers[0],
    });

    fn time(&self) -> f64 {
        self.0
    }

    fn evaluate(&mut self) -> Result<&(), Unreadable> {
        Ok(&())
    }

    fn advance(&mut self, end_s: f64) -> Result<(), Unreadable> {
        self.0 = end_s;
        Ok(())
    }
}

/// A folder with the file, and one without it.
fn folders() -> [PathBuf; 2] {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR")).join("resources");
    let [with, without] = ["with", "without"].map(|name| scratch.join(name));
    std::fs::create_dir_all(&with).unwrap();
    std::fs::create_dir_all(&without).unwrap();
    std::fs::write(with.join("third"), "").unwrap();
    [with, without]
}

fn instantiate(
    token: &str,
    resources: Option<&Path>,
) -> Result<Instance<Letters>, NotInstantiated> {
    Instance::instantiate(Request {
        name: "one",
        interface: Interface::CoSimulation,
        token_argument: "fmuGUID",
        token,
        resources: resources.map(Path::to_path_buf),
        logging_on: false,
    })
}

/// Tokens of the built-in model and of that with the third letter.
fn tokens() -> [String; 2] {
    let identity = hash_of_table(&Letters::ABOUT, Letters::VARIABLES);
    [identity, fnv(identity, b"third")].map(guid_of)
}

#[test]
fn data_are_read_only_for_their_own_token() {
    let ([with, without], [own, third]) = (folders(), tokens());
    for folder in [Some(with.as_path()), Some(&without), None] {
        let built_in = instantiate(&own, folder).unwrap();
        assert!(built_in.state().is_ok());
    }
    let mut other = instantiate(&third, Some(&with)).unwrap();
    other.get_integer(&[0], |_, letter| assert_eq!(letter, 3)).unwrap();
    for (token, folder, told) in [
        (third.as_str(), None, "the master does not say where the resources are"),
        (&third, Some(without.as_path()), "there is no file third"),
        ("{0}", Some(&with), "belong to {third}"),
    ] {
        let refused = instantiate(token, folder).unwrap_err().to_string();
        let start = format!("fmuGUID is {token}, not that of the built-in data, {own}, and ");
        assert!(refused.starts_with(&start), "{refused}");
        assert!(refused.contains(&told.replace("{third}", &third)), "{refused}");
    }
}

#[test]
fn items_are_those_of_the_data() {
    let ([with, _], [own, third]) = (folders(), tokens());
    let mut built_in = instantiate(&own, None).unwrap();
    let refused = built_in.set_integer(&[0], &[3]).unwrap_err();
    let Failure::Refused(Refused { expected, .. }) = refused else { panic!("{refused}") };
    assert_eq!(expected, "choose one of 1 a, 2 b");
    let mut other = instantiate(&third, Some(&with)).unwrap();
    for letter in [1, 2, 3] {
        other.set_integer(&[0], &[letter]).unwrap();
    }
    let refused = other.set_integer(&[0], &[4]).unwrap_err().to_string();
    assert!(refused.ends_with("choose one of 1 a, 2 b, 3 c"), "{refused}");
}

#[test]
fn a_state_belongs_to_its_data_and_a_reset_keeps_them() {
    let ([with, _], [own, third]) = (folders(), tokens());
    let built_in = instantiate(&own, None).unwrap();
    let mut other = instantiate(&third, Some(&with)).unwrap();
    let bytes = [&built_in, &other].map(|it| it.state().unwrap().encode().unwrap());
    assert!(built_in.deserialize(&bytes[0]).is_ok() && other.deserialize(&bytes[1]).is_ok());
    assert!(built_in.deserialize(&bytes[1]).is_err() && other.deserialize(&bytes[0]).is_err());
    other.set_integer(&[0], &[1]).unwrap();
    other.reset().unwrap();
    other.get_integer(&[0], |_, letter| assert_eq!(letter, 3)).unwrap();
}
