//! The figure of a flight: eight panels over a common time axis, for screen (SVG) and print (PNG).

use crate::figure::{self, Area, COLOURS, Drawing, Drawn, FONT, FRAME, GRID, decimals, label};
use crate::panels::{PANELS, Panel};
use crate::record::Record;
use crate::workspace::Files;
use anyhow::Result;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::path::Path;

/// Size in pixels at scale one.
const SIZE: (u32, u32) = (1100, 1000);
/// Room for the numbers of the vertical axis, pixels at scale one.
const LEFT: u32 = 54;
/// Most labels on a vertical axis.
const LABELS: usize = 7;

/// flight.svg and flight.png.
pub fn figures(record: &Record, directory: &Path) -> Result<Files> {
    figure::files(&Flight(record), SIZE, &directory.join("flight"))
}

struct Flight<'a>(&'a Record);

impl Drawing for Flight<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B> {
        draw_all(area, self.0, scale)
    }
}

fn draw_all<B: DrawingBackend>(area: &Area<B>, record: &Record, scale: u32) -> Drawn<B> {
    let margin = 6 * scale;
    let inner = area.margin(margin, margin, margin, margin);
    // The bottom panels carry the time axis and its name.
    let (_, height) = inner.dim_in_pixel();
    let axis = 22 * scale;
    let row = (height - axis) / 4;
    for (half, panels) in inner.split_evenly((1, 2)).iter().zip(PANELS) {
        let cuts = [row, 2 * row, 3 * row].map(|y| y as i32);
        for ((cell, panel), number) in
            half.split_by_breakpoints([0; 0], cuts).iter().zip(panels).zip(1..)
        {
            draw_panel(cell, &panel, record, scale, number == 4)?;
        }
    }
    Ok(())
}

fn draw_panel<B: DrawingBackend>(
    area: &Area<B>,
    panel: &Panel,
    record: &Record,
    scale: u32,
    last: bool,
) -> Drawn<B> {
    let head = 26 * scale;
    let (title, body) = area.split_vertically(head);
    draw_head(&title, panel, scale)?;

    let times: Vec<f64> = record.values(0).collect();
    let curves: Vec<Vec<f64>> = panel
        .curves
        .iter()
        .filter_map(|(name, _)| record.column(name))
        .map(|column| {
            let first = record.values(column).next().unwrap_or(0.0);
            let zero = if panel.deviation { first } else { 0.0 };
            record.values(column).map(|value| (value - zero) * panel.factor).collect()
        })
        .collect();
    let [min, max] = range(curves.iter().flatten().copied(), panel.least);
    let end = times.last().copied().unwrap_or(1.0);

    let mut chart = ChartBuilder::on(&body)
        .margin_right(14 * scale)
        .set_label_area_size(LabelAreaPosition::Left, LEFT * scale)
        .set_label_area_size(LabelAreaPosition::Bottom, if last { 40 } else { 18 } * scale)
        .build_cartesian_2d(0.0..end, min..max)?;
    let decimals = decimals(max - min, LABELS);
    let text = (FONT, 13 * scale).into_font().color(&BLACK);
    chart
        .configure_mesh()
        .x_labels(9)
        .y_labels(LABELS)
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
    for (number, values) in curves.iter().enumerate().rev() {
        let points = points(&times, values, panel.held);
        draw_curve(&mut chart, points, number, scale)?;
    }
    Ok(())
}

type Chart<'a, B> = ChartContext<
    'a,
    B,
    Cartesian2d<plotters::coord::types::RangedCoordf64, plotters::coord::types::RangedCoordf64>,
>;

/// The first curve is solid, the second dashed, the third dotted, so that they differ without
/// colour.
fn draw_curve<B: DrawingBackend>(
    chart: &mut Chart<B>,
    points: Vec<(f64, f64)>,
    number: usize,
    scale: u32,
) -> Drawn<B> {
    let style = COLOURS[number].stroke_width(2 * scale);
    match dashes(number) {
        None => chart.draw_series(LineSeries::new(points, style))?,
        Some((dash, gap)) => {
            let series = DashedLineSeries::new(points, dash * scale, gap * scale, style);
            chart.draw_series(series)?
        }
    };
    Ok(())
}

fn dashes(number: usize) -> Option<(u32, u32)> {
    [None, Some((9, 4)), Some((3, 3))][number]
}

/// Title on the left, legend of several curves on the right: above the curves, never over them.
fn draw_head<B: DrawingBackend>(area: &Area<B>, panel: &Panel, scale: u32) -> Drawn<B> {
    let (width, height) = area.dim_in_pixel();
    let (width, middle, unit) = (width as i32, height as i32 / 2, scale as i32);
    let middle = middle + 4 * unit;
    let title = (FONT, 14 * scale).into_font().color(&BLACK);
    let left = title.clone().pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(panel.title, &left, (LEFT as i32 * unit, middle))?;
    if panel.curves.len() < 2 {
        return Ok(());
    }
    let mut x = width - 14 * unit;
    for (number, (_, label)) in panel.curves.iter().enumerate().rev() {
        let style = COLOURS[number].stroke_width(2 * scale);
        let (length, _) = area.estimate_text_size(label, &title)?;
        let text = title.clone().pos(Pos::new(HPos::Right, VPos::Center));
        area.draw_text(label, &text, (x, middle))?;
        x -= length as i32 + 6 * unit;
        let line = [(x - 26 * unit, middle), (x, middle)];
        match dashes(number) {
            None => area.draw(&PathElement::new(line, style))?,
            Some((dash, gap)) => {
                let (dash, gap) = (dash * scale, gap * scale);
                area.draw(&DashedPathElement::new(line, dash, gap, style))?
            }
        }
        x -= 26 * unit + 16 * unit;
    }
    Ok(())
}

/// Curve points; a held value is drawn with steps.
fn points(times: &[f64], values: &[f64], held: bool) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = Vec::with_capacity(2 * times.len());
    for (&time, &value) in times.iter().zip(values) {
        if let (true, Some(&(_, before))) = (held, points.last()) {
            points.push((time, before));
        }
        points.push((time, value));
    }
    points
}

/// Range with some air around the values, and never smaller than twice `least`.
fn range(values: impl Iterator<Item = f64> + Clone, least: f64) -> [f64; 2] {
    let min = values.clone().fold(f64::INFINITY, f64::min);
    let max = values.fold(f64::NEG_INFINITY, f64::max);
    let (min, max) = if min <= max { (min, max) } else { (0.0, 0.0) };
    let half = (0.55 * (max - min)).max(least);
    let middle = 0.5 * (min + max);
    [middle - half, middle + half]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_noise_is_not_blown_up() {
        let [min, max] = range([1.0, 1.0 + 1e-15].into_iter(), 0.5);
        assert!(max - min > 0.99);
    }
}
