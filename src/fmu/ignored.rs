//! Parameters without effect.

use crate::flight::Parameters;
use crate::vehicle::Configuration;

/// Names of the parameters that do nothing beside the others as they are, and why.
pub fn ignored(parameters: &Parameters) -> impl Iterator<Item = (&'static str, &'static str)> {
    let configuration = parameters.options.configuration;
    let rigid = configuration == Configuration::Rigid;
    [
        (parameters.trim, "trim = true starts from trimmed flight", &WITHOUT_TRIM[..]),
        (rigid, "a rigid vehicle does not bend", &OF_BENDING),
        (configuration != Configuration::SloshBeam, "nothing sloshes", &OF_SLOSHING),
    ]
    .into_iter()
    .filter(|(holds, _, _)| *holds)
    .flat_map(|(_, why, names)| names.iter().map(move |name| (*name, why)))
}

const WITHOUT_TRIM: [&str; 5] = ["alpha0", "q0", "eta10", "eta20", "eta30"];

const OF_BENDING: [&str; 9] = [
    "eta1_offset",
    "eta1_dot_offset",
    "eta2_offset",
    "eta2_dot_offset",
    "eta3_offset",
    "eta3_dot_offset",
    "elastic_factor",
    "stiffness_factor",
    "structural_damping_factor",
];

const OF_SLOSHING: [&str; 6] = [
    "slosh_damping",
    "slosh_frequency",
    "slosh1_offset",
    "slosh1_dot_offset",
    "slosh2_offset",
    "slosh2_dot_offset",
];
