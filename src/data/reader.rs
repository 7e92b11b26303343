//! Reads the data from a text in TOML or from their packed form: the numbers in the order of the definitions,
//! without keys. What is read from TOML is packed on the way, so that a file and its packed form agree.
//!
//! A number stands as `{ value, unit, source, status }`; keys, units and ranges are checked. Reading goes on after a
//! problem, with zeros, and fails at the end. Not serde and toml: with them the library would be half as large again.

use super::document::{self, Node, Table};
use super::quantity::Quantity;
use super::ranges;
use crate::short::short;
use std::slice;

/// Reliability of a number.
const STATUS: [&str; 5] = ["published", "converted", "derived", "identified", "assumed"];

/// What is wrong with a file, and at which key or line.
#[derive(Debug, Default, PartialEq)]
pub struct Problem {
    pub key: String,
    pub problem: String,
}

/// What stands at a key.
pub trait Entry: Sized {
    /// Reads it where the reader stands.
    fn read(reader: &mut Reader) -> Self;
}

/// Reads a struct from the table of its fields; all have to be named, in an order that does not change.
macro_rules! fields {
    ($($name:ident { $($field:ident),* $(,)? })*) => {$(
        impl crate::data::reader::Entry for $name {
            fn read(reader: &mut crate::data::reader::Reader) -> Self {
                reader.keys(&[$(stringify!($field)),*]);
                Self { $($field: reader.entry(stringify!($field))),* }
            }
        }
    )*};
}
pub(crate) use fields;

/// Reads a text in TOML; returns the data and their packed form.
pub fn parse<T: Entry>(text: &str) -> Result<(T, Vec<u8>), Problem> {
    let root = document::parse(text)
        .map_err(|error| Problem { key: format!("line {}", error.line), problem: error.problem })?;
    let root = Node::Table(root);
    let mut reader = Reader { node: Some(&root), ..Reader::new(Form::Toml(Vec::new())) };
    let data = T::read(&mut reader);
    match (reader.problem, reader.form) {
        (None, Form::Toml(packed)) => Ok((data, packed)),
        (problem, _) => Err(problem.unwrap_or_default()),
    }
}

/// Reads the packed form.
pub fn unpack<T: Entry>(packed: &[u8]) -> Result<T, Problem> {
    let mut reader = Reader::new(Form::Packed(packed));
    let data = T::read(&mut reader);
    reader.problem.map_or(Ok(data), Err)
}

/// What is read.
#[derive(Debug)]
enum Form<'a> {
    /// A tree of TOML, with what is packed of it so far.
    Toml(Vec<u8>),
    /// What is left of the packed form.
    Packed(&'a [u8]),
}

/// Stands at a key.
#[derive(Debug)]
pub struct Reader<'a> {
    form: Form<'a>,
    /// The key's value in TOML, if it is there.
    node: Option<&'a Node<'a>>,
    /// The key, and those above it.
    path: Vec<&'a str>,
    problem: Option<Problem>,
}

impl<'a> Reader<'a> {
    fn new(form: Form<'a>) -> Self {
        Self { form, node: None, path: Vec::new(), problem: None }
    }

    /// The first problem is the one that is told.
    fn problem(&mut self, problem: String) {
        let key = self.path.join(".");
        self.problem.get_or_insert(Problem { key, problem });
    }

    /// The entry of a key of the table where the reader stands. Not inlined: called for every key.
    #[inline(never)]
    pub fn entry<T: Entry>(&mut self, key: &'static str) -> T {
        let table = self.node;
        self.enter(key);
        let entry = T::read(self);
        self.leave(table);
        entry
    }

    fn enter(&mut self, key: &'a str) {
        self.path.push(key);
        self.node = match self.node {
            Some(Node::Table(table)) => table.get(key),
            _ => None,
        };
    }

    fn leave(&mut self, above: Option<&'a Node<'a>>) {
        self.path.pop();
        self.node = above;
    }

    /// Checks that here is a table without other keys.
    pub fn keys(&mut self, known: &[&str]) {
        let Form::Toml(_) = self.form else { return };
        match self.node {
            Some(Node::Table(Table(entries))) => {
                if let Some((key, _)) = entries.iter().find(|(key, _)| !known.contains(key)) {
                    self.path.push(key);
                    self.problem(format!("unknown key, must be one of {}", known.join(", ")));
                    self.path.pop();
                }
            }
            Some(_) => self.problem("must be a table".to_string()),
            None => self.problem("is missing".to_string()),
        }
    }

    /// The next bytes of the packed form, or those of TOML, which are packed.
    fn bytes<const N: usize>(&mut self, of_toml: [u8; N]) -> [u8; N] {
        match &mut self.form {
            Form::Toml(packed) => {
                packed.extend_from_slice(&of_toml);
                of_toml
            }
            Form::Packed(rest) => match rest.split_first_chunk() {
                Some((bytes, after)) => {
                    *rest = after;
                    *bytes
                }
                None => {
                    self.problem("the packed form ends early".to_string());
                    [0; N]
                }
            },
        }
    }

    fn count(&mut self, of_toml: usize) -> usize {
        u32::from_le_bytes(self.bytes((of_toml as u32).to_le_bytes())) as usize
    }

    fn float(&mut self, of_toml: f64) -> f64 {
        f64::from_le_bytes(self.bytes(of_toml.to_le_bytes()))
    }

    /// The text of a key of a quantity.
    fn text(&mut self, key: &str) -> &'a str {
        let node = match self.node {
            Some(Node::Table(table)) => table.get(key),
            _ => None,
        };
        if let Some(Node::Text(text)) = node {
            return text;
        }
        self.problem(format!("{key} is missing or no text"));
        ""
    }

    /// The numbers of the quantity in TOML: `count`, or any if there is none.
    fn quantity(&mut self, count: Option<usize>) -> &'a [Node<'a>] {
        let Form::Toml(_) = self.form else { return &[] };
        self.keys(&["value", "unit", "source", "status"]);
        let [unit, _, status] = ["unit", "source", "status"].map(|key| self.text(key));
        if !STATUS.contains(&status) {
            self.problem(format!("the status is {status}, must be one of {}", STATUS.join(", ")));
        }
        let value = match self.node {
            Some(Node::Table(table)) => table.get("value"),
            _ => None,
        };
        let numbers = match value {
            Some(Node::List(list)) => list.as_slice(),
            one => one.map_or(&[][..], slice::from_ref),
        };
        let key = self.path.last().copied().unwrap_or_default();
        for node in numbers {
            match node {
                Node::Number(number) => {
                    if let Some(problem) = ranges::problem(key, unit, *number) {
                        self.problem(problem);
                    }
                }
                _ => self.problem("the value must be a number or a list of numbers".to_string()),
            }
        }
        let is_list = matches!(value, Some(Node::List(_)));
        let expected = match count {
            Some(1) if is_list || numbers.is_empty() => "one number".to_string(),
            Some(count) if count != numbers.len() => format!("a list of {count} numbers"),
            None if !is_list => "a list of numbers".to_string(),
            _ => return numbers,
        };
        self.problem(format!("the value must be {expected}"));
        &[]
    }

    fn number(&mut self) -> f64 {
        let number = value(self.quantity(Some(1)).first());
        self.float(number)
    }

    fn numbers(&mut self) -> Vec<f64> {
        let numbers = self.quantity(None);
        let count = self.count(numbers.len());
        let mut read = Vec::new();
        for i in 0..count {
            read.push(self.float(value(numbers.get(i))));
            if self.problem.is_some() {
                break;
            }
        }
        read
    }
}

fn value(node: Option<&Node>) -> f64 {
    match node {
        Some(Node::Number(number)) => *number,
        _ => 0.0,
    }
}

impl Entry for Quantity {
    fn read(reader: &mut Reader) -> Self {
        Self { value: reader.number() }
    }
}

impl Entry for Quantity<u32> {
    fn read(reader: &mut Reader) -> Self {
        let value = reader.number();
        if value.fract() != 0.0 {
            reader.problem(format!("{} must be a whole number", short(value)));
        }
        Self { value: value as u32 }
    }
}

impl Entry for Quantity<Vec<f64>> {
    fn read(reader: &mut Reader) -> Self {
        Self { value: reader.numbers() }
    }
}

impl<const N: usize> Entry for Quantity<[f64; N]> {
    fn read(reader: &mut Reader) -> Self {
        let numbers = reader.quantity(Some(N));
        Self { value: std::array::from_fn(|i| reader.float(value(numbers.get(i)))) }
    }
}

impl<T: Entry> Entry for Option<T> {
    fn read(reader: &mut Reader) -> Self {
        let is_there = reader.node.is_some();
        (reader.bytes([is_there.into()]) != [0]).then(|| T::read(reader))
    }
}

/// Tables in a list, which are called by their names in messages.
impl<T: Entry, const N: usize> Entry for [T; N] {
    fn read(reader: &mut Reader) -> Self {
        let list = reader.node;
        let rows = match list {
            Some(Node::List(rows)) => rows.as_slice(),
            _ => &[],
        };
        if let (Form::Toml(_), true) = (&reader.form, rows.len() != N) {
            reader.problem(format!("must be {N} tables"));
        }
        std::array::from_fn(|i| {
            reader.node = rows.get(i);
            let name = match reader.node {
                Some(Node::Table(row)) => row.get("name"),
                _ => None,
            };
            reader.path.push(if let Some(Node::Text(name)) = name { name } else { "?" });
            let row = T::read(reader);
            reader.leave(list);
            row
        })
    }
}

impl Entry for String {
    fn read(reader: &mut Reader) -> Self {
        let text = match (&reader.form, reader.node) {
            (Form::Toml(_), Some(Node::Text(text))) => *text,
            (Form::Packed(_), _) => "",
            _ => {
                reader.problem("must be a text".to_string());
                ""
            }
        };
        let count = reader.count(text.len());
        let mut bytes = Vec::new();
        for i in 0..count {
            bytes.extend(reader.bytes([text.as_bytes().get(i).copied().unwrap_or_default()]));
            if reader.problem.is_some() {
                break;
            }
        }
        Self::from_utf8_lossy(&bytes).into_owned()
    }
}
