//! A model whose data can be replaced in its package, and inputs that need not be numbers.
#![allow(missing_docs)]

use fmi_model::describe::model_description_of;
use fmi_model::identity::{fnv, guid_of};
use fmi_model::instance::{Instance, Interface};
use fmi_model::instantiate::{NotInstantiated, Request};
use fmi_model::standard::Standard;
use fmi_model::{
    About, Dependencies, Model, ModelError, Resources, Saving, Simulation, Unit, Variable,
};
use std::path::{Path, PathBuf};

/// y = factor u, with the factor in a file of the package, or y = -1 where u is no number.
#[derive(Debug, Clone, PartialEq)]
struct Gain {
    factor: f64,
}

#[derive(Debug)]
struct Amplifier {
    factor: f64,
    time_s: f64,
    inputs: [f64; 2],
    y: f64,
}

#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct Unreadable(String);

impl ModelError for Unreadable {}

impl Model for Gain {
    type Simulation = Amplifier;
    type Error = Unreadable;

    const ABOUT: About = About::new("gain", "1");
    const VARIABLES: &'static [Variable<Self>] = &[
        Variable::input(0, "u", Unit::ONE, "Measurement").accepting_non_finite(),
        Variable::input(1, "offset", Unit::ONE, "A number"),
        Variable::output("y", Unit::ONE, "Output", Dependencies::dependent(0b11), |y: &f64| *y),
    ];
    const RESOURCES: Resources<Self> = Resources::Replaceable(|folder| {
        let text = std::fs::read_to_string(folder.join("factor"));
        let text = text.map_err(|error| Unreadable(format!("factor: {error}")))?;
        let factor =
            text.parse().map_err(|_| Unreadable(format!("factor: {text} is no number")))?;
        Ok(Self { factor })
    });

    fn new() -> Result<Self, Unreadable> {
        Ok(Self { factor: 1.0 })
    }

    fn identity(&self) -> u128 {
        fnv(Self::IDENTITY, &self.factor.to_le_bytes())
    }

    fn start(&self, time_s: f64, _tolerance: f64) -> Result<Amplifier, Unreadable> {
        Ok(Amplifier { factor: self.factor, time_s, inputs: [0.0; 2], y: 0.0 })
    }
}

impl Simulation for Amplifier {
    type Sample = f64;
    type Error = Unreadable;

    const SAVING: Option<Saving<Self>> = Some(Saving {
        count: 3,
        save: |amplifier, numbers| {
            numbers.push(amplifier.time_s);
            numbers.extend(amplifier.inputs);
        },
        check: |numbers| numbers[0].is_finite(),
        load: |amplifier, numbers| {
            amplifier.time_s = numbers[0];
            amplifier.inputs.copy_from_slice(&numbers[1..]);
        },
    });

    fn time(&self) -> f64 {
        self.time_s
    }
    fn inputs(&self) -> &[f64] {
        &self.inputs
    }
    fn set_input(&mut self, number: usize, value: f64) {
        self.inputs[number] = value;
    }
    fn evaluate(&mut self) -> Result<&f64, Unreadable> {
        let [u, offset] = self.inputs;
        self.y = if u.is_finite() { self.factor * u + offset } else { -1.0 };
        Ok(&self.y)
    }
    fn advance(&mut self, end_s: f64) -> Result<(), Unreadable> {
        self.time_s = end_s;
        Ok(())
    }
}

/// A folder whose file holds this text.
fn folder(name: &str, text: Option<&str>) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("replaceable").join(name);
    std::fs::create_dir_all(&folder).unwrap();
    if let Some(text) = text {
        std::fs::write(folder.join("factor"), text).unwrap();
    }
    folder
}

fn instantiate(token: &str, resources: Option<PathBuf>) -> Result<Instance<Gain>, NotInstantiated> {
    Instance::instantiate(Request {
        name: "one",
        interface: Interface::CoSimulation,
        token_argument: "fmuGUID",
        token,
        resources,
        logging_on: false,
    })
}

fn token() -> String {
    guid_of(Gain::IDENTITY)
}

/// y of an instance with an input.
fn y(gain: &mut Instance<Gain>, u: f64) -> f64 {
    gain.set_real(&[0], &[u]).unwrap();
    let mut found = f64::NAN;
    gain.get_real(&[2], |_, value| found = value).unwrap();
    found
}

fn started(resources: Option<PathBuf>) -> Instance<Gain> {
    let mut gain = instantiate(&token(), resources).unwrap();
    gain.setup_experiment(None, 0.0, None).unwrap();
    gain.enter_initialization_mode().unwrap();
    gain.exit_initialization_mode().unwrap();
    gain
}

#[test]
fn data_in_the_folder_are_those_of_the_instance_also_after_a_reset() {
    let mut gain = started(Some(folder("three", Some("3"))));
    assert_eq!(y(&mut gain, 2.0), 6.0);
    gain.reset().unwrap();
    gain.setup_experiment(None, 0.0, None).unwrap();
    gain.enter_initialization_mode().unwrap();
    assert_eq!(y(&mut gain, 2.0), 6.0);
    assert_eq!(y(&mut started(None), 2.0), 2.0);
}

#[test]
fn data_that_cannot_be_read_are_refused_and_never_replaced_by_the_built_in_ones() {
    for (folder, said) in [
        (folder("none", None), "factor: "),
        (folder("letters", Some("three")), "factor: three is no number"),
    ] {
        let refused = instantiate(&token(), Some(folder)).unwrap_err().to_string();
        assert!(refused.starts_with(said), "{refused}");
    }
    let folder = folder("four", Some("4"));
    let refused = instantiate("{0}", Some(folder)).unwrap_err().to_string();
    assert!(refused.contains("are not from the same FMU"), "{refused}");
}

#[test]
fn states_of_other_data_are_refused() {
    let bytes = started(None).state().unwrap().encode().unwrap();
    assert!(started(None).deserialize(&bytes).is_ok());
    let other = started(Some(folder("five", Some("5"))));
    let refused = other.deserialize(&bytes).unwrap_err().to_string();
    assert!(refused.contains("they belong to another model"), "{refused}");
}

#[test]
fn an_input_that_says_so_takes_shows_and_saves_what_is_no_number() {
    let mut waiting = instantiate(&token(), None).unwrap();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut gain = started(None);
        assert_eq!(y(&mut gain, bad), -1.0);
        gain.get_real(&[0], |_, u| assert_eq!(u.to_bits(), bad.to_bits())).unwrap();
        let refused = gain.set_real(&[1], &[bad]).unwrap_err().to_string();
        assert!(refused.contains("a finite number is needed"), "{refused}");
        // Also before the start.
        waiting.set_real(&[0], &[bad]).unwrap();
        for instance in [&mut gain, &mut waiting] {
            let bytes = instance.state().unwrap().encode().unwrap();
            let state = instance.deserialize(&bytes).unwrap();
            instance.set_state(&state).unwrap();
            assert_eq!(instance.state().unwrap().encode().unwrap(), bytes);
        }
    }
}

#[test]
fn the_token_of_the_package_is_that_of_the_table_whatever_the_data() {
    for factor in [1.0, 3.0] {
        let described = model_description_of(&Gain { factor }, Standard::Fmi2).unwrap();
        assert!(described.contains(&token()), "{described}");
    }
}
