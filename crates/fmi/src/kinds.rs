//! Units, kinds of values, dependencies.

/// A unit with the exponents of its base units and, where users think in another one, how to show
/// it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Name, as in the XML.
    pub name: &'static str,
    /// Name of the quantity that it measures; also the name of its type in the XML.
    pub quantity: Option<&'static str>,
    /// Exponents of kg, m, s, rad.
    pub base: [i32; 4],
    /// Name of the display unit and its size in the unit's inverse: shown = value * factor.
    pub display: Option<(&'static str, f64)>,
    /// Other units that a tool for FMI 3.0 may show it in, likewise.
    pub others: &'static [(&'static str, f64)],
}

impl Unit {
    /// None is declared: the variable takes the unit of what it is connected to.
    pub const NONE: &Self = &Self::new("", None, [0; 4]);
    /// The unit of pure numbers.
    pub const ONE: &Self = &Self::new("1", None, [0; 4]);
    /// Seconds.
    pub const SECOND: &Self = &Self::new("s", Some("Time"), [0, 0, 1, 0]);

    /// Whether it is one that the XML names.
    pub const fn is_declared(&self) -> bool {
        !self.name.is_empty()
    }

    /// A unit that is shown as it is.
    pub const fn new(name: &'static str, quantity: Option<&'static str>, base: [i32; 4]) -> Self {
        Self { name, quantity, base, display: None, others: &[] }
    }

    /// The unit, shown in another one: shown = value * factor.
    pub const fn displayed_as(self, name: &'static str, factor: f64) -> Self {
        Self { display: Some((name, factor)), ..self }
    }

    /// The unit, with others to show it in: shown = value * factor.
    pub const fn with_others(self, others: &'static [(&'static str, f64)]) -> Self {
        Self { others, ..self }
    }
}

/// Items of an enumeration: name, number, description.
pub type Items = &'static [(&'static str, i32, &'static str)];

/// What values a variable takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A real number in a unit.
    Real(&'static Unit),
    /// A whole number of 32 bits.
    Integer,
    /// True or false.
    Boolean,
    /// One of a list of named numbers: name of the type, then its items.
    Enumeration(&'static str, Items),
}

/// On which states and inputs a variable depends, and how. A bit for every state by number, then one
/// for every input; each in one mask only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dependencies {
    /// In any way.
    pub dependent: u64,
    /// Linearly, with a factor that is fixed after initialisation.
    pub fixed: u64,
    /// Linearly, with a factor that never changes.
    pub constant: u64,
}

impl Dependencies {
    /// On nothing.
    pub const NONE: Self = Self { dependent: 0, fixed: 0, constant: 0 };
    /// On every state and input, in any way.
    pub const ALL: Self = Self { dependent: u64::MAX, ..Self::NONE };

    /// On what has a bit in the mask, in any way.
    pub const fn dependent(mask: u64) -> Self {
        Self { dependent: mask, ..Self::NONE }
    }

    /// Linearly, with a factor that is fixed after initialisation.
    pub const fn fixed(mask: u64) -> Self {
        Self { fixed: mask, ..Self::NONE }
    }

    /// Linearly, with a factor that never changes.
    pub const fn constant(mask: u64) -> Self {
        Self { constant: mask, ..Self::NONE }
    }
}
