//! The figure: error against the shortest time of the repetitions, both logarithmic.

use super::precision::{OURS, Point};
use ahv_tool::figure::{self, Area, COLOURS, Drawing, Drawn, FONT, FRAME, GRID};
use ahv_tool::workspace::Files;
use anyhow::Result;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::path::Path;

// Sizes in pixels at scale one.
const SIZE: (u32, u32) = (800, 560);
const TEXT: u32 = 15;
/// Width of the legend on the right.
const LEGEND: u32 = 218;
/// Prefixes of the names of methods of one origin, which share a colour.
const ORIGINS: [&[&str]; 5] =
    [&[OURS], &["ode_solvers"], &["CVODE", "ARKODE"], &["SciPy"], &["diffsol"]];

/// precision.svg and precision.png.
pub fn files(points: &[Point], directory: &Path) -> Result<Files> {
    figure::files(&Precision(points), SIZE, &directory.join("precision"))
}

struct Precision<'a>(&'a [Point]);

impl Drawing for Precision<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B> {
        draw(area, self.0, scale)
    }
}

/// The powers of ten around some values.
fn decades(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let logs = values.map(libm::log10);
    let (least, largest) =
        logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    libm::exp10(least.floor())..libm::exp10(largest.ceil())
}

fn draw<B: DrawingBackend>(area: &Area<B>, points: &[Point], scale: u32) -> Drawn<B> {
    let x = decades(points.iter().map(|point| point.seconds.least));
    let y = decades(points.iter().map(|point| point.error));
    let text = (FONT, TEXT * scale).into_font().color(&BLACK);
    let (width, _) = area.dim_in_pixel();
    let (left, legend) = area.split_horizontally(width - LEGEND * scale);
    let mut chart = ChartBuilder::on(&left)
        .margin(12 * scale)
        .set_label_area_size(LabelAreaPosition::Left, 64 * scale)
        .set_label_area_size(LabelAreaPosition::Bottom, 44 * scale)
        .build_cartesian_2d(x.log_scale(), y.log_scale())?;
    let power = |value: &f64| format!("1e{}", libm::log10(*value).round());
    chart
        .configure_mesh()
        .max_light_lines(0)
        .bold_line_style(GRID.stroke_width(scale))
        .axis_style(FRAME.stroke_width(scale))
        .set_all_tick_mark_size(5 * scale)
        .label_style(text.clone())
        .axis_desc_style(text.clone())
        .x_label_formatter(&power)
        .y_label_formatter(&power)
        .x_desc("seconds for a flight of 1 s with an elevator doublet")
        .y_desc("largest scaled error of a state")
        .draw()?;
    let mut methods: Vec<_> = points.iter().map(|point| &point.method).collect();
    methods.dedup();
    methods.sort_by_key(|method| origin(method));
    let mut drawn = [0; ORIGINS.len()];
    for (number, method) in methods.into_iter().enumerate() {
        let origin = origin(method);
        let (colour, kind) = (COLOURS[origin], drawn[origin]);
        drawn[origin] += 1;
        let own = points.iter().filter(|point| point.method == *method);
        let own: Vec<_> = own.map(|point| (point.seconds.least, point.error)).collect();
        let line = colour.stroke_width(if method.starts_with(OURS) { 4 } else { 2 } * scale);
        chart.draw_series(LineSeries::new(own.clone(), line))?;
        for place in &own {
            mark(area, chart.backend_coord(place), kind, colour, scale)?;
        }
        let y = ((40 + 26 * number as u32) * scale) as i32;
        let (start, end) = (2 * scale as i32, 30 * scale as i32);
        legend.draw(&PathElement::new([(start, y), (end, y)], line))?;
        mark(&legend, ((start + end) / 2, y), kind, colour, scale)?;
        let style = text.clone().pos(Pos::new(HPos::Left, VPos::Center));
        legend.draw_text(method, &style, (end + 6 * scale as i32, y))?;
    }
    Ok(())
}

/// Position among the origins.
fn origin(method: &str) -> usize {
    let begins = |names: &&[&str]| names.iter().any(|name| method.starts_with(name));
    ORIGINS.iter().position(begins).unwrap_or(ORIGINS.len() - 1)
}

/// Draws a filled or hollow disc or square, to distinguish methods of one colour.
fn mark<B: DrawingBackend>(
    area: &Area<B>,
    (x, y): (i32, i32),
    kind: usize,
    colour: RGBColor,
    scale: u32,
) -> Drawn<B> {
    let fill = if kind.is_multiple_of(2) { colour } else { WHITE };
    for (size, colour) in [(5 * scale as i32, colour), (3 * scale as i32, fill)] {
        let style = colour.filled();
        match kind {
            0 | 1 => area.draw(&Circle::new((x, y), size, style))?,
            _ => area.draw(&Rectangle::new([(x - size, y - size), (x + size, y + size)], style))?,
        }
    }
    Ok(())
}
