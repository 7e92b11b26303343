//! Versions of the standard.

/// A version of the Functional Mock-up Interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standard {
    /// FMI 2.0.
    Fmi2,
    /// FMI 3.0.
    Fmi3,
}

impl Standard {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Fmi2, Self::Fmi3];

    /// Name of a model's FMU: `<identifier>.fmu` and `<identifier>_fmi3.fmu`.
    pub fn file_name(self, identifier: &str) -> String {
        match self {
            Self::Fmi2 => format!("{identifier}.fmu"),
            Self::Fmi3 => format!("{identifier}_fmi3.fmu"),
        }
    }
}
