//! The results of a report; serialised as `report.json`.

use super::claims::Tested;
use super::fit_errors::FitErrors;
use super::inertia_laws::Laws;
use super::interaction::Interaction;
use super::origin::Origin;
use super::sweep::Sweep;
use super::tables::Table;
use super::veering::Veering;
use super::verdict::{RANKS, Verdict};
use crate::identify::TradeOff;
use serde::Serialize;

pub const ERRATA: &str = include_str!("../../../../src/data/errata.md");
pub const PAPER: &str = "Xu, Huang, Cai, \"Flight dynamic analysis of hypersonic vehicle considering liquid-solid coupling\", Trans. Nanjing Univ. Aero. Astro. 32(1), 2015, 81-88";

/// A drawing in `figures/`.
#[derive(Debug, Clone, Serialize)]
pub struct Figure {
    /// File name without extension.
    pub file: String,
    pub title: String,
    pub caption: String,
}

#[derive(Debug, Clone, Serialize)]
pub struct SetReport {
    pub name: &'static str,
    pub description: &'static str,
    pub tables: Vec<Table>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub claims: Vec<Tested>,
    pub figures: Vec<Figure>,
    pub sweeps: Vec<Sweep>,
    /// The unstable pole over fuel under several laws of inertia.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub laws: Option<Laws>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interaction: Option<Interaction>,
}

#[derive(Debug, Clone, Serialize)]
pub struct Report {
    pub paper: &'static str,
    pub version: &'static str,
    /// Results that do not depend on the coefficient set.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table1: Option<Table>,
    pub figures: Vec<Figure>,
    pub veering: Vec<Veering>,
    pub sets: Vec<SetReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub origin: Option<Origin>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trade_off: Option<TradeOff>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fit: Option<FitErrors>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub errata: Option<&'static str>,
}

/// The number of each verdict.
pub fn count<'a>(verdicts: impl Iterator<Item = &'a Verdict>) -> [usize; RANKS.len()] {
    let mut count = [0; RANKS.len()];
    for verdict in verdicts {
        count[verdict.rank()] += 1;
    }
    count
}
