//! The model description obeys the rules of the standard that its schema does not express.

use super::*;
use crate::model_description::{Kind, ModelDescription, Real};
use quick_xml::events::{BytesStart, Event};

/// Every element with its depth, in document order.
fn elements(xml: &str) -> Vec<(usize, BytesStart<'static>)> {
    let mut reader = quick_xml::Reader::from_str(xml);
    let (mut depth, mut found) = (0, Vec::new());
    loop {
        match reader.read_event().unwrap() {
            Event::Start(start) => {
                found.push((depth, start.into_owned()));
                depth += 1;
            }
            Event::Empty(start) => found.push((depth, start.into_owned())),
            Event::End(_) => depth -= 1,
            Event::Eof => return found,
            _ => {}
        }
    }
}

fn attribute(element: &BytesStart, name: &str) -> Option<String> {
    let found = element.try_get_attribute(name).unwrap()?;
    Some(found.value.into_owned())
}

/// Descriptions of all models for FMI 2.0.
fn descriptions() -> Vec<String> {
    MODELS.map(|model| committed(model, Standard::Fmi2).unwrap()).to_vec()
}

#[test]
fn elements_stand_in_the_order_of_the_schema() {
    let order = [
        "ModelExchange",
        "CoSimulation",
        "UnitDefinitions",
        "TypeDefinitions",
        "LogCategories",
        "DefaultExperiment",
        "ModelVariables",
        "ModelStructure",
    ];
    for xml in descriptions() {
        let elements = elements(&xml);
        let at = |depth| elements.iter().filter(move |(found, _)| *found == depth);
        let names: Vec<_> =
            at(1).map(|(_, element)| element.name().into_inner().to_string()).collect();
        let known = |name: &String| order.iter().position(|known| known == name).unwrap();
        assert!(names.iter().map(known).is_sorted_by(|a, b| a < b), "{names:?}");
        for needed in ["CoSimulation", "ModelVariables", "ModelStructure"] {
            assert!(names.iter().any(|name| name == needed), "{needed}");
        }
        let variables = at(2).filter(|(_, element)| element.name().as_ref() == "ScalarVariable");
        for (row, (_, element)) in variables.enumerate() {
            assert_eq!(attribute(element, "valueReference"), Some(row.to_string()));
        }
    }
}

#[test]
fn unknowns_ascend_and_have_one_kind_per_dependency() {
    for xml in descriptions() {
        let count = ModelDescription::parse(&xml).unwrap().variables().len();
        for (_, element) in elements(&xml) {
            let Some(list) = attribute(&element, "dependencies") else { continue };
            let indices: Vec<usize> =
                list.split_whitespace().map(|index| index.parse().unwrap()).collect();
            assert!(indices.is_sorted_by(|a, b| a < b), "{element:?}");
            assert!(indices.iter().all(|index| (1..=count).contains(index)), "{element:?}");
            if let Some(kinds) = attribute(&element, "dependenciesKind") {
                assert_eq!(kinds.split_whitespace().count(), indices.len(), "{element:?}");
            }
        }
    }
}

#[test]
fn start_values_lie_within_their_limits_and_every_enumeration_has_items() {
    for xml in descriptions() {
        let model = ModelDescription::parse(&xml).unwrap();
        for variable in model.variables() {
            let Some(start) = variable.start() else { continue };
            match &variable.kind {
                Kind::Real(Real { min: Some(min), max: Some(max), .. }) => {
                    assert!((*min..=*max).contains(&start), "{}", variable.name);
                }
                Kind::Enumeration(_) => {
                    let known =
                        |item: &crate::model_description::Item| f64::from(item.value) == start;
                    assert!(model.items(variable).iter().any(known), "{}", variable.name);
                }
                _ => {}
            }
        }
    }
}

#[test]
fn one_unit_per_name_with_degrees_for_rates() {
    let xml = committed(&VEHICLE, Standard::Fmi2).unwrap();
    let elements = elements(&xml);
    let named = |element: &str, name: &str| {
        let same = |found: &BytesStart| {
            found.name().as_ref() == element && attribute(found, "name").as_deref() == Some(name)
        };
        elements.iter().filter(|(_, found)| same(found)).count()
    };
    assert_eq!(named("Unit", "rad/s"), 1);
    assert_eq!(named("DisplayUnit", "deg/s"), 1);
}
