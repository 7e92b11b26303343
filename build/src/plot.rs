//! The figure of a flight: a panel for each group of signals that vary, as SVG and PNG.

use crate::curve::{Curve, dashes};
use crate::figure::{self, Area, COLOURS, Drawing, Drawn, FONT, FRAME, GRID, decimals, label};
use crate::panels::{PANELS, Panel};
use crate::record::Record;
use crate::workspace::Files;
use anyhow::Result;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::path::Path;

// Sizes in pixels at scale one. The text is large, so that it can be read on a phone.
const WIDTH: u32 = 800;
const ROW_HEIGHT: u32 = 210;
const TITLE_HEIGHT: u32 = 30;
/// Height of a line of the title.
const LINE_HEIGHT: u32 = 24;
const MARGIN: u32 = 6;
/// Width of the labels of the vertical axis.
const AXIS_WIDTH: u32 = 66;
/// Height of the title of the time axis.
const TIME_AXIS_HEIGHT: u32 = 22;
const TEXT_SIZE: u32 = 16;
/// Longest line of the title, characters.
const MAX_TITLE_CHARACTERS: usize = 80;
/// Labels on a vertical axis.
const MAX_LABELS: usize = 6;
/// PNG pixels per pixel at scale one.
const PNG_PIXELS_PER_PIXEL: usize = 2;

/// flight.svg and flight.png; none of an FMU whose variables no panel shows.
pub fn figures(record: &Record, title: &str, directory: &Path) -> Result<Files> {
    let title = lines(title, MAX_TITLE_CHARACTERS);
    let mut panels = moving(record, false);
    if panels.is_empty() {
        panels = moving(record, true);
    }
    if panels.is_empty() {
        return Ok(Files::new());
    }
    let rows = panels.len().div_ceil(2) as u32;
    let height =
        2 * MARGIN + LINE_HEIGHT * title.len() as u32 + ROW_HEIGHT * rows + TIME_AXIS_HEIGHT;
    figure::files(&Flight { title, panels }, (WIDTH, height), &directory.join("flight"))
}

/// Panels with their curves: those that vary, or `all`.
fn moving(record: &Record, all: bool) -> Vec<(Panel, Vec<Curve>)> {
    PANELS
        .into_iter()
        .map(|panel| {
            let mut curves = Curve::of(&panel, record, all);
            curves
                .iter_mut()
                .for_each(|curve| curve.decimate(PNG_PIXELS_PER_PIXEL * WIDTH as usize));
            (panel, curves)
        })
        .filter(|(_, curves)| !curves.is_empty())
        .collect()
}

/// Breaks a text after commas.
fn lines(text: &str, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for part in text.split_inclusive(", ") {
        let line = lines.last_mut().filter(|line| {
            let length = line.chars().count() + part.trim_end().chars().count();
            line.is_empty() || length <= most
        });
        match line {
            Some(line) => line.push_str(part),
            None => lines.push(part.to_string()),
        }
    }
    lines
}

struct Flight {
    title: Vec<String>,
    panels: Vec<(Panel, Vec<Curve>)>,
}

impl Drawing for Flight {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B> {
        let inner = area.margin(MARGIN * scale, MARGIN * scale, MARGIN * scale, MARGIN * scale);
        let text = (FONT, TEXT_SIZE * scale).into_font().color(&BLACK);
        let text = text.pos(Pos::new(HPos::Left, VPos::Center));
        for (number, line) in self.title.iter().enumerate() {
            let middle = (number as u32 * LINE_HEIGHT + LINE_HEIGHT / 2) * scale;
            inner.draw_text(line.trim_end(), &text, ((MARGIN * scale) as i32, middle as i32))?;
        }
        let (_, body) = inner.split_vertically(LINE_HEIGHT * self.title.len() as u32 * scale);
        let rows = self.panels.chunks(2);
        let last = rows.len() - 1;
        let cuts = (1..=last as u32).map(|row| (ROW_HEIGHT * row * scale) as i32);
        let cells = body.split_by_breakpoints([0; 0], cuts.collect::<Vec<_>>());
        for (number, (row, cell)) in rows.zip(&cells).enumerate() {
            // A single panel in the last row has the full width.
            for ((panel, curves), half) in row.iter().zip(cell.split_evenly((1, row.len()))) {
                draw_panel(&half, panel, curves, scale, number == last)?;
            }
        }
        Ok(())
    }
}

fn draw_panel<B: DrawingBackend>(
    area: &Area<B>,
    panel: &Panel,
    curves: &[Curve],
    scale: u32,
    last: bool,
) -> Drawn<B> {
    let (title, body) = area.split_vertically(TITLE_HEIGHT * scale);
    draw_head(&title, panel, curves, scale)?;
    let [min, max] = range(curves, panel.min_half_range);
    let end = curves.iter().flat_map(|curve| curve.points.last()).map(|point| point.0);
    let end = end.fold(0.0, f64::max);

    let mut chart = ChartBuilder::on(&body)
        .margin_right(14 * scale)
        .set_label_area_size(LabelAreaPosition::Left, AXIS_WIDTH * scale)
        .set_label_area_size(
            LabelAreaPosition::Bottom,
            if last { 22 + TIME_AXIS_HEIGHT } else { 22 } * scale,
        )
        .build_cartesian_2d(0.0..if end > 0.0 { end } else { 1.0 }, min..max)?;
    let decimals = decimals(min..max, MAX_LABELS);
    let text = (FONT, TEXT_SIZE * scale).into_font().color(&BLACK);
    chart
        .configure_mesh()
        .x_labels(8)
        .y_labels(MAX_LABELS)
        .max_light_lines(0)
        .bold_line_style(GRID.stroke_width(scale))
        .axis_style(FRAME.stroke_width(scale))
        .set_all_tick_mark_size(4 * scale)
        .label_style(text.clone())
        .axis_desc_style(text)
        .x_label_formatter(&|time| format!("{}", (time * 1e6).round() / 1e6))
        .y_label_formatter(&|value| label(*value, decimals))
        .x_desc(if last { "time, s" } else { "" })
        .draw()?;
    for curve in curves.iter().rev() {
        let style = COLOURS[curve.number].stroke_width(2 * scale);
        let points = curve.points.iter().copied();
        match curve.dashes(max - min) {
            None => chart.draw_series(LineSeries::new(points, style))?,
            Some((dash, gap)) => {
                let series = DashedLineSeries::new(points, dash * scale, gap * scale, style);
                chart.draw_series(series)?
            }
        };
    }
    Ok(())
}

/// Title on the left, legend of several curves on the right: above the curves, never over them.
fn draw_head<B: DrawingBackend>(
    area: &Area<B>,
    panel: &Panel,
    curves: &[Curve],
    scale: u32,
) -> Drawn<B> {
    let (width, height) = area.dim_in_pixel();
    let (width, middle, unit) = (width as i32, height as i32 / 2, scale as i32);
    let middle = middle + 4 * unit;
    let title = (FONT, TEXT_SIZE * scale).into_font().color(&BLACK);
    let left = title.clone().pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(panel.title, &left, (MARGIN as i32 * unit, middle))?;
    if panel.curves.len() < 2 {
        return Ok(());
    }
    let mut x = width - 14 * unit;
    for curve in curves.iter().rev() {
        let style = COLOURS[curve.number].stroke_width(2 * scale);
        let (length, _) = area.estimate_text_size(curve.label, &title)?;
        let text = title.clone().pos(Pos::new(HPos::Right, VPos::Center));
        area.draw_text(curve.label, &text, (x, middle))?;
        x -= length as i32 + 4 * unit;
        let line = [(x - 22 * unit, middle), (x, middle)];
        match dashes(curve.number) {
            None => area.draw(&PathElement::new(line, style))?,
            Some((dash, gap)) => {
                let (dash, gap) = (dash * scale, gap * scale);
                area.draw(&DashedPathElement::new(line, dash, gap, style))?
            }
        }
        x -= 22 * unit + 10 * unit;
    }
    Ok(())
}

/// Range with a margin around the curves, never smaller than twice `least`.
fn range(curves: &[Curve], least: f64) -> [f64; 2] {
    let [min, max] = curves
        .iter()
        .map(Curve::range)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], [c, d]| [a.min(c), b.max(d)]);
    let half = (0.55 * (max - min)).max(least);
    let middle = 0.5 * (min + max);
    [middle - half, middle + half]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_noise_is_not_blown_up() {
        let points = vec![(0.0, 1.0), (1.0, 1.0 + 1e-15)];
        let [min, max] = range(&[Curve { number: 0, label: "", points }], 0.5);
        assert!(max - min > 0.99);
    }

    #[test]
    fn a_long_title_breaks_after_commas() {
        assert_eq!(lines("Rigid, mach0=9, a.csv", 80), ["Rigid, mach0=9, a.csv"]);
        assert_eq!(lines("Rigid, mach0=9, a.csv", 14), ["Rigid, ", "mach0=9, a.csv"]);
    }

    #[test]
    fn an_fmu_without_variables_to_draw_has_no_picture() {
        let names = ["time", "u", "y"].map(String::from).to_vec();
        let record = Record { names, rows: vec![vec![0.0; 3], vec![1.0; 3]] };
        assert!(figures(&record, "actuator", Path::new("")).unwrap().is_empty());
    }

    #[test]
    fn a_flight_of_many_rows_makes_a_small_picture() {
        let names = ["time", "eta1", "eta2"].map(String::from).to_vec();
        let wave = |n: i32, rate: f64| libm::sin(f64::from(n) * rate);
        let rows = (0..200_000).map(|n| vec![f64::from(n) * 1e-3, wave(n, 0.3), wave(n, 0.7)]);
        let record = Record { names, rows: rows.collect() };
        for (file, content) in figures(&record, "many", Path::new("")).unwrap() {
            assert!(content.len() < 1_000_000, "{}: {} bytes", file.display(), content.len());
        }
    }
}
