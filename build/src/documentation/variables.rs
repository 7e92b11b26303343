//! The table of variables of a page, from modelDescription.xml of FMI 3.0: there each variable is one element.

use super::plain;
use anyhow::{Context, Result};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Attributes of an element, escaped as in the file: XHTML has the same escapes.
type Attributes = BTreeMap<String, String>;

/// What a page needs of a model description.
#[derive(Default)]
pub struct Described {
    root: Attributes,
    has_exchange: bool,
    /// Number and name of the items of each enumeration.
    items: BTreeMap<String, Vec<(String, String)>>,
    variables: Vec<Attributes>,
}

impl Described {
    pub fn parse(xml: &str) -> Result<Self> {
        let mut found = Self::default();
        let (mut path, mut enumeration) = (Vec::new(), String::new());
        let mut reader = Reader::from_str(xml);
        loop {
            match reader.read_event()? {
                Event::Start(element) => {
                    found.add(&element, &path, &mut enumeration)?;
                    path.push(element.name().into_inner().to_string());
                }
                Event::Empty(element) => found.add(&element, &path, &mut enumeration)?,
                Event::End(_) => drop(path.pop()),
                Event::Eof => return Ok(found),
                _ => {}
            }
        }
    }

    fn add(
        &mut self,
        element: &BytesStart,
        path: &[String],
        enumeration: &mut String,
    ) -> Result<()> {
        let attributes = attributes(element)?;
        let within = path.last().map(String::as_str);
        match (within, element.name().as_ref()) {
            (None, _) => self.root = attributes,
            (_, "ModelExchange") => self.has_exchange = true,
            (_, "EnumerationType") => *enumeration = get(&attributes, "name").to_string(),
            (Some("EnumerationType"), "Item") => {
                let item = ["value", "name"].map(|key| get(&attributes, key).to_string());
                self.items.entry(enumeration.clone()).or_default().push(item.into());
            }
            (Some("ModelVariables"), _) => self.variables.push(attributes),
            _ => {}
        }
        Ok(())
    }

    /// An attribute of the model.
    pub fn of_model(&self, key: &str) -> Result<&str> {
        let found = self.root.get(key).map(String::as_str);
        found.with_context(|| format!("modelDescription.xml has no {key}"))
    }

    /// Names of the interfaces.
    pub fn interfaces(&self) -> &'static str {
        if self.has_exchange { "Co-Simulation and Model Exchange" } else { "Co-Simulation" }
    }

    /// The rows of the table; inputs come first, whatever their value reference.
    pub fn rows(&self) -> Result<String> {
        let mut rows = String::new();
        let is = |variable: &&Attributes, causality| get(variable, "causality") == causality;
        let states: BTreeSet<_> =
            self.variables.iter().filter_map(|variable| variable.get("derivative")).collect();
        let (inputs, others): (Vec<_>, Vec<_>) = self
            .variables
            .iter()
            .filter(|variable| !is(variable, "independent"))
            .partition(|variable| is(variable, "input"));
        for variable in inputs.into_iter().chain(others) {
            self.row(&mut rows, variable, &states)?;
        }
        Ok(rows)
    }

    fn row(
        &self,
        text: &mut String,
        variable: &Attributes,
        states: &BTreeSet<&String>,
    ) -> Result<()> {
        let attribute = |key| get(variable, key);
        let is_state = variable.get("valueReference").is_some_and(|own| states.contains(own));
        let role = match (attribute("causality"), is_state) {
            ("output", true) => "output, state",
            ("local", true) => "state",
            ("local", false) => "derivative",
            ("calculatedParameter", _) => "calculated parameter",
            (causality, _) => causality,
        };
        let items = self.items.get(attribute("declaredType"));
        let start = match (items, attribute("start")) {
            (Some(items), start) => {
                let item = items.iter().find(|(number, _)| number == start);
                item.map_or(start.to_string(), |(_, name)| name.clone())
            }
            (None, start) => start.parse().map_or(start.to_string(), plain),
        };
        let range = match (items, variable.get("min"), variable.get("max")) {
            (Some(items), ..) => {
                let items = items.iter().map(|(number, name)| format!("{number} {name}"));
                items.collect::<Vec<_>>().join("<br/>")
            }
            (None, Some(min), Some(max)) => format!("{min} to {max}"),
            _ => String::new(),
        };
        writeln!(
            text,
            "<tr><td class=\"n\">{}</td><td><code>{}</code></td><td>{role}</td><td>{}</td>\
             <td class=\"n\">{start}</td><td>{range}</td><td>{}</td></tr>",
            attribute("valueReference"),
            attribute("name"),
            attribute("unit"),
            attribute("description"),
        )?;
        Ok(())
    }
}

fn get<'a>(attributes: &'a Attributes, key: &str) -> &'a str {
    attributes.get(key).map_or("", String::as_str)
}

fn attributes(element: &BytesStart) -> Result<Attributes> {
    let pair = |attribute: Result<quick_xml::events::attributes::Attribute, _>| {
        let attribute = attribute.context("modelDescription.xml is not well-formed")?;
        let name = attribute.key.into_inner().to_string();
        Ok((name, attribute.value.into_owned()))
    };
    element.attributes().map(pair).collect()
}
