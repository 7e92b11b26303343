//! Report of the identification of `xu2015`.

use super::l_curve::{Model, Point, bends};
use super::numbers::{MOVABLE, written_move};
use super::resolution::Resolution;
use super::stations::Stations;
use ahv_tool::table::{number, row, table};
use anyhow::{Result, anyhow};
use nalgebra::DVector;
use serde_json::{Value, json};
use std::fmt::Write;

/// Values of the cells with one set, its trims and its stations.
struct Filled {
    name: &'static str,
    values: Vec<f64>,
    trims: Vec<[f64; 3]>,
    stations: Stations,
}

impl Filled {
    fn new(model: &Model, name: &'static str, point: &DVector<f64>) -> Result<Self> {
        let none = || anyhow!("{name} has no trim");
        let set = model.origin.moved(point).ok_or_else(none)?;
        let values = model.values(&set).ok_or_else(none)?;
        let trims = model.trims(&set).ok_or_else(none)?;
        Ok(Self { name, values, trims, stations: model.stations(&set)? })
    }
}

/// Results of the identification.
pub struct Report<'a> {
    model: &'a Model,
    path: &'a [Point],
    knee: usize,
    chosen: &'a Point,
    best: &'a Point,
    filled: [Filled; 4],
    knowledge: Resolution,
}

impl<'a> Report<'a> {
    pub fn new(
        model: &'a Model,
        path: &'a [Point],
        knee: usize,
        [chosen, best]: [&'a Point; 2],
    ) -> Result<Self> {
        let published = DVector::zeros(MOVABLE.len());
        let last = path.last().ok_or_else(|| anyhow!("an empty path"))?;
        let filled = [
            Filled::new(model, "parker2007", &published)?,
            Filled::new(model, "xu2015", &chosen.fit.point)?,
            Filled::new(model, "free_stations", &best.fit.point)?,
            Filled::new(model, "unbound", &last.fit.point)?,
        ];
        let knowledge = Resolution::new(&model.sensitivity(chosen)?, chosen.weight)?;
        Ok(Self { model, path, knee, chosen, best, filled, knowledge })
    }

    pub fn text(&self) -> Result<String> {
        let mut text = String::from(
            "Misfit: sum over the cells of (relative error / wanted accuracy)^2\n\
             Distance from parker2007: sum over the numbers of (ln ratio / sd)^2, or (difference / sd)^2,\n\
             where sd is the prior standard deviation\n\n\
             Trade-off: minimum of misfit + weight x distance; the knee is the first local maximum\n\
             of the curvature of ln misfit over ln distance; \"unbound\" is the last line\n",
        );
        text += &self.trade_off();
        text += "\nChanged numbers: factors on parker2007, or differences in m; changes of less than 1 % are reset\n";
        text += &self.numbers();
        let weight = self.chosen.weight;
        writeln!(
            text,
            "\nDetermined by the data: singular values above {}",
            number(weight.sqrt())
        )?;
        text += &self.combinations();
        text += "\nCells, rad/s; those without a wanted accuracy are not fitted\n";
        text += &self.cells();
        text += "\nTrim: incidence, elevator, fuel ratio\n";
        text += &self.trims();
        text += "\nfree_stations: best fit with one inertia and free stations; all coefficients except the \
                 elevator's moment are published\n";
        for filled in &self.filled {
            writeln!(text, "{}: {}", filled.name, filled.stations.text())?;
        }
        Ok(text)
    }

    fn trade_off(&self) -> String {
        let mut rows = vec![row(["weight", "distance", "misfit", "curvature", ""])];
        for (i, (point, bend)) in self.path.iter().zip(bends(self.path)).enumerate() {
            let mark = if i == self.knee { "knee" } else { "" };
            rows.push(vec![
                format!("{:.1e}", point.weight),
                number(point.distance()),
                number(point.misfit()),
                format!("{bend:.2}"),
                mark.to_string(),
            ]);
        }
        let [distance, misfit] = [self.chosen.distance(), self.chosen.misfit()].map(number);
        rows.push(vec!["xu2015".into(), distance, misfit, String::new(), String::new()]);
        let [distance, misfit] = [self.best.distance(), self.best.misfit()].map(number);
        rows.push(vec!["free_stations".into(), distance, misfit, String::new(), String::new()]);
        table(&rows)
    }

    fn numbers(&self) -> String {
        let origin = &self.model.origin;
        let last = self.path.last().map_or_else(Vec::new, |point| origin.values(&point.fit.point));
        let values = self.model.origin.values(&self.chosen.fit.point);
        let mut rows = vec![row([
            "number",
            "doubt",
            "parker2007",
            "xu2015",
            "change",
            "determined by data",
            "unbound",
        ])];
        for (i, ((key, doubt), [old, new])) in MOVABLE.into_iter().zip(values).enumerate() {
            let factor = if new == old { "-".to_string() } else { written_move(key, [old, new]) };
            rows.push(vec![
                key.to_string(),
                format!("{doubt:.2}"),
                number(old),
                number(new),
                factor,
                format!("{:.0} %", 100.0 * self.knowledge.resolution[i]),
                last.get(i).map_or(String::new(), |pair| written_move(key, *pair)),
            ]);
        }
        table(&rows)
    }

    fn combinations(&self) -> String {
        let limit = self.chosen.weight.sqrt();
        let mut rows = vec![row(["singular value", "combination of ln ratio / sd"])];
        for (column, value) in self.knowledge.singular_values.iter().enumerate() {
            if *value < limit && column > 0 {
                break;
            }
            let parts = self.knowledge.combination(column);
            let parts: Vec<_> =
                parts.iter().map(|(key, part)| format!("{part:+.2} {key}")).collect();
            rows.push(vec![number(*value), parts.join("  ")]);
        }
        table(&rows)
    }

    fn cells(&self) -> String {
        let mut head =
            vec!["table, column".to_string(), "cell".into(), "printed".into(), "wanted".into()];
        for filled in &self.filled {
            head.extend([filled.name.to_string(), "error".into()]);
        }
        let mut rows = vec![head];
        for (i, cell) in self.model.cells.iter().enumerate() {
            let mut line = vec![
                format!("{}, {:?}", cell.table, cell.column),
                cell.name.clone(),
                number(cell.printed),
                cell.wanted.map_or("-".into(), |wanted| format!("{:.0} %", 100.0 * wanted)),
            ];
            for filled in &self.filled {
                let value = filled.values[i];
                line.extend([number(value), format!("{:+.1} %", 100.0 * cell.error(value))]);
            }
            rows.push(line);
        }
        table(&rows)
    }

    fn trims(&self) -> String {
        let mut rows = vec![row(["set", "Rigid", "EvenMassBeam", "SloshBeam"])];
        for filled in &self.filled {
            let cell = |[alpha, delta_e, phi]: &[f64; 3]| {
                let [alpha, delta_e] = [alpha, delta_e].map(|angle| angle.to_degrees());
                format!("{alpha:.2} deg, {delta_e:.2} deg, {phi:.3}")
            };
            let cells = filled.trims.iter().map(cell);
            rows.push(std::iter::once(filled.name.to_string()).chain(cells).collect());
        }
        table(&rows)
    }

    pub fn json(&self) -> Value {
        let values = self.model.origin.values(&self.chosen.fit.point);
        let numbers: Vec<_> = MOVABLE
            .into_iter()
            .zip(values)
            .enumerate()
            .map(|(i, ((key, doubt), [old, new]))| {
                json!({
                    "key": key,
                    "doubt": doubt,
                    "parker2007": old,
                    "xu2015": new,
                    "moved_by": written_move(key, [old, new]),
                    "moved": new != old,
                    "decided_by_data": self.knowledge.resolution[i],
                })
            })
            .collect();
        let path: Vec<_> = self
            .path
            .iter()
            .zip(bends(self.path))
            .enumerate()
            .map(|(i, (point, bend))| {
                let numbers: serde_json::Map<_, _> = MOVABLE
                    .into_iter()
                    .zip(self.model.origin.values(&point.fit.point))
                    .map(|((key, _), [_, new])| (key.to_string(), json!(new)))
                    .collect();
                json!({
                    "weight": point.weight,
                    "distance": point.distance(),
                    "misfit": point.misfit(),
                    "bend": bend,
                    "knee": i == self.knee,
                    "numbers": numbers,
                })
            })
            .collect();
        let cells: Vec<_> = self
            .model
            .cells
            .iter()
            .enumerate()
            .map(|(i, cell)| {
                let mut line = json!({
                    "table": cell.table,
                    "column": format!("{:?}", cell.column),
                    "name": cell.name,
                    "printed": cell.printed,
                    "wanted": cell.wanted,
                });
                for filled in &self.filled {
                    let value = filled.values[i];
                    line[filled.name] = json!({ "value": value, "error": cell.error(value) });
                }
                line
            })
            .collect();
        let trims: serde_json::Map<_, _> = self
            .filled
            .iter()
            .map(|filled| (filled.name.to_string(), json!(filled.trims)))
            .collect();
        let stations: serde_json::Map<_, _> = self
            .filled
            .iter()
            .map(|filled| (filled.name.to_string(), json!(filled.stations)))
            .collect();
        let combinations: Vec<_> = (0..self.knowledge.singular_values.len())
            .map(|column| {
                let parts = self.knowledge.combination(column);
                let parts: Vec<_> =
                    parts.iter().map(|(key, p)| json!({"key": key, "part": p})).collect();
                json!({ "singular_value": self.knowledge.singular_values[column], "parts": parts })
            })
            .collect();
        json!({
            "set": "xu2015",
            "origin": "parker2007",
            "weight": self.chosen.weight,
            "distance": self.chosen.distance(),
            "misfit": self.chosen.misfit(),
            "numbers": numbers,
            "trade_off": path,
            "cells": cells,
            "trims_rad_rad_1": trims,
            "stations": stations,
            "free_stations": { "distance": self.best.distance(), "misfit": self.best.misfit() },
            "combinations": combinations,
        })
    }
}
