//! extra/org.fmi-standard.fmi-ls-ref: the reference flight as an experiment that tools can find and
//! repeat (FMI Layered Standard References, 1.0.0-alpha.1).

use super::{Files, cross_check};
use crate::fly::STEP;
use crate::model_description::ModelDescription;
use anyhow::Result;
use fmi_model::describe::Xml;

const NAME: &str = "org.fmi-standard.fmi-ls-ref";
/// Root of the FMU relative to the directory of the standard.
const UP: &str = "../../";
const EXPERIMENTS: &str = "experiments.xml";
const DESCRIPTION: &str = "Elevator doublet from level flight";

/// Manifest and experiment.
pub fn files(model: &ModelDescription) -> Result<Files> {
    let path = |name: &str| format!("extra/{NAME}/{name}");
    Ok(Files::from([
        (path("fmi-ls-manifest.xml"), manifest()?.into_bytes()),
        (path(EXPERIMENTS), experiments(model)?.into_bytes()),
    ]))
}

fn manifest() -> Result<String> {
    let [inputs, outputs] =
        ["in.csv", "ref.csv"].map(|file| UP.to_string() + &cross_check::path(file));
    let related = [
        ("text/xml", EXPERIMENTS.to_string(), "experiment", "Reference flight"),
        ("text/csv", inputs, "testcase", "Its inputs"),
        ("text/csv", outputs, "result", "Its outputs, to 1e-9 of the largest value"),
        (
            "text/html",
            format!("{UP}documentation/index.html"),
            "document",
            "Variables, validity, limits, how to cite",
        ),
    ];
    let attributes = [
        ("xmlns:fmi-ls", "http://fmi-standard.org/fmi-ls-manifest".to_string()),
        ("fmi-ls:fmi-ls-name", NAME.to_string()),
        ("fmi-ls:fmi-ls-version", "1.0.0-alpha.1".to_string()),
        (
            "fmi-ls:fmi-ls-description",
            "Layered Standard providing information on related files included in an FMU."
                .to_string(),
        ),
    ];
    let mut xml = Xml::new()?;
    xml.parent("fmiReferences", &attributes, |xml| {
        related.iter().try_for_each(|(kind, source, role, description)| {
            let attributes = [
                ("type", (*kind).to_string()),
                ("source", source.clone()),
                ("role", (*role).to_string()),
                ("description", (*description).to_string()),
            ];
            xml.leaf("Related", &attributes)
        })
    })?;
    Ok(xml.finish()?)
}

fn experiments(model: &ModelDescription) -> Result<String> {
    let default = &model.experiment;
    let options = [
        ("startTime", Some("0".to_string())),
        ("stopTime", default.stop_time.map(|time| time.to_string())),
        ("tolerance", default.tolerance.map(|tolerance| format!("{tolerance:e}"))),
        ("stepSize", Some(STEP.to_string())),
    ];
    let options = options.into_iter().filter_map(|(key, value)| Some((key, value?)));
    let name = [("name", "doublet".to_string()), ("description", DESCRIPTION.to_string())];
    let source = |file: &str| [("source", UP.to_string() + &cross_check::path(file))];
    let mut xml = Xml::new()?;
    xml.parent("Experiments", &[], |xml| {
        xml.parent("Experiment", &name.into_iter().chain(options).collect::<Vec<_>>(), |xml| {
            xml.leaf("Stimuli", &source("in.csv"))?;
            xml.leaf("References", &source("ref.csv"))
        })
    })?;
    Ok(xml.finish()?)
}
