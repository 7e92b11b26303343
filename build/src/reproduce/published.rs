//! What the paper prints.

use anyhow::{Context, Result};
use serde::Deserialize;

const PUBLISHED_TOML: &str = include_str!("../../../src/data/published.toml");

/// `published.toml`, rad/s.
#[derive(Debug, Deserialize)]
pub struct Published {
    pub table1: Table1,
    pub table2: Columns<Poles>,
    pub table3: Columns<Zeros>,
}

#[derive(Debug, Deserialize)]
pub struct Table1 {
    pub even: [f64; 3],
    pub slosh: [f64; 3],
}

/// One entry per configuration.
#[derive(Debug, Deserialize)]
pub struct Columns<T> {
    pub rigid: T,
    pub even: T,
    pub slosh: T,
}

/// Pairs are real and imaginary part.
#[derive(Debug, Deserialize)]
pub struct Poles {
    pub long_term: [f64; 2],
    pub short_term: [f64; 2],
    pub height: f64,
    #[serde(default)]
    pub aeroelastic: Vec<[f64; 2]>,
}

#[derive(Debug, Deserialize)]
pub struct Zeros {
    pub real: [f64; 3],
    #[serde(default)]
    pub aeroelastic: Vec<[f64; 2]>,
}

impl<T> Columns<T> {
    /// In the order of the configurations.
    pub fn all(&self) -> [&T; 3] {
        [&self.rigid, &self.even, &self.slosh]
    }
}

impl Published {
    pub fn embedded() -> Result<Self> {
        toml::from_str(PUBLISHED_TOML).context("published.toml")
    }
}
