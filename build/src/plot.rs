//! The figure of a flight: eight panels over a common time axis, for screen (SVG) and print (PNG).

use crate::record::Record;
use crate::workspace::{read, write};
use anyhow::{Result, anyhow};
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use std::path::{Path, PathBuf};

/// Size in pixels at scale one.
const SIZE: (u32, u32) = (1100, 1000);
/// The PNG is drawn this much larger, ...
const DRAWN: u32 = 4;
/// ... and averaged over squares of this size: the backend does not smooth lines itself.
const AVERAGED: u32 = 2;
const FONT: &str = "sans-serif";

/// Okabe and Ito's palette, in the order of its contrast on white: blue, vermillion, green.
const COLOURS: [RGBColor; 3] = [RGBColor(0, 114, 178), RGBColor(213, 94, 0), RGBColor(0, 158, 115)];
const GRID: RGBColor = RGBColor(225, 225, 225);
const FRAME: RGBColor = RGBColor(90, 90, 90);

const DEGREES: f64 = 180.0 / std::f64::consts::PI;
const MILLIMETRES: f64 = 1e3;

/// Curves in one unit.
struct Panel {
    title: &'static str,
    unit: &'static str,
    /// Name of the variable and its label.
    curves: &'static [(&'static str, &'static str)],
    /// Shown = value * factor.
    factor: f64,
    /// Show the deviation from the first value.
    deviation: bool,
    /// Constant between communication points, so drawn with steps.
    held: bool,
    /// Half of the smallest range shown, so that rounding noise stays flat.
    least: f64,
}

const PANEL: Panel = Panel {
    title: "",
    unit: "",
    curves: &[],
    factor: 1.0,
    deviation: false,
    held: false,
    least: 1e-3,
};

/// Left column, then right column.
const PANELS: [[Panel; 4]; 2] = [
    [
        Panel {
            title: "Airspeed, deviation",
            unit: "m/s",
            curves: &[("V", "V − V(0)")],
            deviation: true,
            ..PANEL
        },
        Panel {
            title: "Flight path",
            unit: "deg",
            curves: &[("gamma", "γ")],
            factor: DEGREES,
            ..PANEL
        },
        Panel {
            title: "Incidence, attitude",
            unit: "deg",
            curves: &[("alpha", "α"), ("theta", "θ")],
            factor: DEGREES,
            ..PANEL
        },
        Panel {
            title: "Pitch rate",
            unit: "deg/s",
            curves: &[("q", "q")],
            factor: DEGREES,
            ..PANEL
        },
    ],
    [
        Panel {
            title: "Flexible modes, at the nose",
            unit: "mm",
            curves: &[("eta1", "η1"), ("eta2", "η2"), ("eta3", "η3")],
            factor: MILLIMETRES,
            ..PANEL
        },
        Panel {
            title: "Sloshing masses",
            unit: "mm",
            curves: &[("slosh1", "fore tank"), ("slosh2", "aft tank")],
            factor: MILLIMETRES,
            ..PANEL
        },
        Panel {
            title: "Elevator, in effect",
            unit: "deg",
            curves: &[("delta_e_effective", "δe")],
            factor: DEGREES,
            held: true,
            least: 0.1,
            ..PANEL
        },
        Panel {
            title: "Fuel ratio, in effect",
            unit: "1",
            curves: &[("phi_effective", "φ")],
            held: true,
            least: 0.01,
            ..PANEL
        },
    ],
];

/// Writes flight.svg and flight.png.
pub fn write_figures(record: &Record, directory: &Path) -> Result<[PathBuf; 2]> {
    // An own font: the figure looks the same on a machine that has none.
    register_font(FONT, FontStyle::Normal, dejavu::sans::regular())
        .map_err(|_| anyhow!("the built-in font cannot be read"))?;
    let (svg, png) = (directory.join("flight.svg"), directory.join("flight.png"));
    draw(&SVGBackend::new(&svg, SIZE).into_drawing_area(), record, 1)?;
    // An empty file means that nothing was drawn, which plotters does not report.
    if read(&svg)?.is_empty() {
        return Err(anyhow!("{} stayed empty", svg.display()));
    }

    let (width, height) = (SIZE.0 * DRAWN, SIZE.1 * DRAWN);
    let mut pixels = vec![0; width as usize * height as usize * 3];
    let backend = BitMapBackend::with_buffer(&mut pixels, (width, height));
    draw(&backend.into_drawing_area(), record, DRAWN)?;
    write(&png, encode(&average(&pixels, width), width / AVERAGED, height / AVERAGED)?)?;
    Ok([svg, png])
}

/// Every square of pixels becomes one.
fn average(pixels: &[u8], width: u32) -> Vec<u8> {
    let (width, square) = (width as usize, AVERAGED as usize);
    let height = pixels.len() / 3 / width;
    let mut small = Vec::with_capacity(pixels.len() / square / square);
    for y in (0..height).step_by(square) {
        for x in (0..width).step_by(square) {
            for channel in 0..3 {
                let cells = (0..square * square).map(|cell| {
                    let (x, y) = (x + cell % square, y + cell / square);
                    usize::from(pixels[(y * width + x) * 3 + channel])
                });
                small.push((cells.sum::<usize>() / (square * square)) as u8);
            }
        }
    }
    small
}

fn encode(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    // At 200 dots per inch the figure is 11 by 10 inches.
    let per_metre = (200.0 / 0.0254_f64).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(file)
}

type Area<B> = DrawingArea<B, Shift>;
type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

fn draw<B: DrawingBackend>(area: &Area<B>, record: &Record, scale: u32) -> Result<()>
where
    B::ErrorType: 'static,
{
    draw_all(area, record, scale).map_err(|error| anyhow!("the figure cannot be drawn: {error}"))
}

fn draw_all<B: DrawingBackend>(area: &Area<B>, record: &Record, scale: u32) -> Drawn<B> {
    area.fill(&WHITE)?;
    let margin = 6 * scale;
    let inner = area.margin(margin, margin, margin, margin);
    // The bottom panels carry the time axis and its name.
    let (_, height) = inner.dim_in_pixel();
    let axis = 26 * scale;
    let row = (height - axis) / 4;
    for (half, panels) in inner.split_evenly((1, 2)).iter().zip(PANELS) {
        let cuts = [row, 2 * row, 3 * row].map(|y| y as i32);
        for ((cell, panel), number) in
            half.split_by_breakpoints([0; 0], cuts).iter().zip(panels).zip(1..)
        {
            draw_panel(cell, &panel, record, scale, number == 4)?;
        }
    }
    area.present()
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
        .set_label_area_size(LabelAreaPosition::Left, 62 * scale)
        .set_label_area_size(LabelAreaPosition::Bottom, if last { 44 } else { 18 } * scale)
        .build_cartesian_2d(0.0..end, min..max)?;
    let decimals = decimals(max - min);
    let text = (FONT, 13 * scale).into_font().color(&BLACK);
    chart
        .configure_mesh()
        .x_labels(9)
        .y_labels(5)
        .max_light_lines(0)
        .bold_line_style(GRID.stroke_width(scale))
        .axis_style(FRAME.stroke_width(scale))
        .set_all_tick_mark_size(4 * scale)
        .label_style(text.clone())
        .axis_desc_style(text)
        .x_label_formatter(&|time| format!("{}", (time * 1e6).round() / 1e6))
        // Minus zero is no number that an axis should show.
        .y_label_formatter(&|value| format!("{:.decimals$}", value + 0.0))
        .x_desc(if last { "time, s" } else { "" })
        .y_desc(panel.unit)
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

/// Title on the left, legend on the right: above the curves, never over them.
fn draw_head<B: DrawingBackend>(area: &Area<B>, panel: &Panel, scale: u32) -> Drawn<B> {
    let (width, height) = area.dim_in_pixel();
    let (width, middle, unit) = (width as i32, height as i32 / 2, scale as i32);
    let middle = middle + 4 * unit;
    let title = (FONT, 14 * scale).into_font().color(&BLACK);
    let left = title.clone().pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(panel.title, &left, (62 * unit, middle))?;
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

/// Decimals that tell apart about five labels over a range.
fn decimals(range: f64) -> usize {
    (1.0 - (range / 2.0).log10().floor()).clamp(0.0, 6.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averaging_keeps_the_order_of_pixels() {
        let pixel = |value: u8| [value; 3];
        let pixels =
            [pixel(0), pixel(4), pixel(10), pixel(10), pixel(0), pixel(4), pixel(10), pixel(10)];
        assert_eq!(average(pixels.as_flattened(), 4), [[2; 3], [10; 3]].as_flattened());
    }

    #[test]
    fn rounding_noise_is_not_blown_up() {
        let [min, max] = range([1.0, 1.0 + 1e-15].into_iter(), 0.5);
        assert!(max - min > 0.99);
    }
}
