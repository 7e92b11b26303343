//! The picture: error against the least time of the repetitions, both logarithmic.

use super::precision::{OURS, Point};
use ahv_tool::figure::{self, Area, Drawing, Drawn, FONT, FRAME, GRID};
use ahv_tool::workspace::Files;
use anyhow::Result;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::path::Path;

/// Size in pixels at scale one.
const SIZE: (u32, u32) = (900, 560);
/// Room for the legend on the right, pixels at scale one.
const LEGEND: u32 = 190;
/// As many as there are methods: figure's five, and greys.
const COLOURS: [RGBColor; 10] = [
    figure::COLOURS[0],
    figure::COLOURS[4],
    figure::COLOURS[1],
    figure::COLOURS[2],
    figure::COLOURS[3],
    RGBColor(120, 120, 120),
    RGBColor(0, 0, 0),
    RGBColor(170, 140, 90),
    RGBColor(90, 170, 140),
    RGBColor(200, 120, 200),
];

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
    let logs = values.map(f64::log10);
    let (least, largest) =
        logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    10f64.powf(least.floor())..10f64.powf(largest.ceil())
}

fn draw<B: DrawingBackend>(area: &Area<B>, points: &[Point], scale: u32) -> Drawn<B> {
    let x = decades(points.iter().map(|point| point.seconds.least));
    let y = decades(points.iter().map(|point| point.error));
    let text = (FONT, 13 * scale).into_font().color(&BLACK);
    let (width, _) = area.dim_in_pixel();
    let (left, legend) = area.split_horizontally(width - LEGEND * scale);
    let mut chart = ChartBuilder::on(&left)
        .margin(12 * scale)
        .set_label_area_size(LabelAreaPosition::Left, 64 * scale)
        .set_label_area_size(LabelAreaPosition::Bottom, 44 * scale)
        .build_cartesian_2d(x.log_scale(), y.log_scale())?;
    let power = |value: &f64| format!("1e{}", value.log10().round());
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
    for (number, method) in methods.into_iter().enumerate() {
        let colour = COLOURS[number % COLOURS.len()];
        let own = points.iter().filter(|point| point.method == *method);
        let own: Vec<_> = own.map(|point| (point.seconds.least, point.error)).collect();
        let line = colour.stroke_width(if method.starts_with(OURS) { 4 } else { 2 } * scale);
        chart.draw_series(LineSeries::new(own.clone(), line))?;
        let y = ((40 + 24 * number as u32) * scale) as i32;
        let (start, end) = (2 * scale as i32, 26 * scale as i32);
        legend.draw(&PathElement::new([(start, y), (end, y)], line))?;
        // Where the colours begin anew, the dots are hollow.
        let fill = if number < COLOURS.len() { colour } else { WHITE };
        for (radius, colour) in [(4, colour), (2, fill)] {
            let dot = |&place: &_| Circle::new(place, radius * scale, colour.filled());
            chart.draw_series(own.iter().map(dot))?;
            let middle = ((start + end) / 2, y);
            legend.draw(&Circle::new(middle, radius * scale, colour.filled()))?;
        }
        let style = text.clone().pos(Pos::new(HPos::Left, VPos::Center));
        legend.draw_text(method, &style, (end + 6 * scale as i32, y))?;
    }
    Ok(())
}
