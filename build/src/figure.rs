//! Renders figures as SVG and PNG; fonts, colours and labels of all figures.

use crate::raster;
use crate::workspace::Files;
use anyhow::{Result, anyhow};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{BoldPoints, Ranged};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};
use std::ops::Range;
use std::path::Path;

/// Figures are drawn larger by this factor, ...
const DRAWING_SCALE: u32 = 4;
/// ... and the PNG is averaged over squares of this many pixels: the backend has no antialiasing.
const AVERAGING_SQUARE: u32 = 2;

pub const FONT: &str = "sans-serif";
/// Blue, vermillion, green, reddish purple and orange of Okabe and Ito's palette, which
/// colour-blind readers tell apart.
pub const COLOURS: [RGBColor; 5] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
];
pub const GRID: RGBColor = RGBColor(225, 225, 225);
pub const FRAME: RGBColor = RGBColor(90, 90, 90);

pub type Area<B> = DrawingArea<B, Shift>;
pub type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// A figure that can be drawn at any scale.
pub trait Drawing {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B>
    where
        B::ErrorType: 'static;
}

/// The files `stem`.svg and `stem`.png; size in pixels at scale one.
pub fn files(drawing: &impl Drawing, size: (u32, u32), stem: &Path) -> Result<Files> {
    // With a built-in font the figure is the same on every machine.
    register_font(FONT, FontStyle::Normal, dejavu::sans::regular())
        .map_err(|_| anyhow!("the built-in font cannot be read"))?;
    let (svg, png) = (stem.with_extension("svg"), stem.with_extension("png"));
    // Backends round to whole pixels, so both drawings are large and displayed smaller.
    let (width, height) = (size.0 * DRAWING_SCALE, size.1 * DRAWING_SCALE);
    let mut text = String::new();
    draw(
        &SVGBackend::with_string(&mut text, (width, height)).into_drawing_area(),
        drawing,
        DRAWING_SCALE,
    )?;
    let drawn = format!("width=\"{width}\" height=\"{height}\"");
    let shown = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    let text = text.replacen(&drawn, &shown, 1);

    let mut pixels = vec![0; width as usize * height as usize * 3];
    let backend = BitMapBackend::with_buffer(&mut pixels, (width, height));
    draw(&backend.into_drawing_area(), drawing, DRAWING_SCALE)?;
    let pixels = raster::png(&pixels, width, AVERAGING_SQUARE)?;
    Ok(Files::from([(svg, text.into_bytes()), (png, pixels)]))
}

fn draw<B: DrawingBackend>(area: &Area<B>, drawing: &impl Drawing, scale: u32) -> Result<()>
where
    B::ErrorType: 'static,
{
    let failed = |error| anyhow!("the figure cannot be drawn: {error}");
    area.fill(&WHITE).map_err(failed)?;
    drawing.draw(area, scale).map_err(failed)?;
    area.present().map_err(failed)
}

/// Number of decimals that the labels of an axis need.
pub fn decimals(range: Range<f64>, labels: usize) -> usize {
    let ticks = RangedCoordf64::from(range).key_points(BoldPoints(labels));
    let &[first, second, ..] = ticks.as_slice() else { return 6 };
    let rounded = |tick: f64, digits: i32| (tick * 10f64.powi(digits)).round() / 10f64.powi(digits);
    let near = |tick: &f64, digits| (rounded(*tick, digits) - tick).abs() < 1e-3 * (second - first);
    let needed = (0..6).find(|digits| ticks.iter().all(|tick| near(tick, *digits)));
    needed.unwrap_or(6) as usize
}

/// Label of a number on an axis; a number that rounds to zero has no sign.
pub fn label(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if !digits.contains(|c| matches!(c, '1'..='9')) => digits.to_string(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_on_an_axis_are_short() {
        assert_eq!(decimals(0.0..0.015, 6), 3);
        assert_eq!(decimals(0.9998..1.0028, 6), 4, "steps of 0.0005");
        assert_eq!(decimals(0.0..0.04, 6), 2);
        assert_eq!(decimals(-0.1..0.1, 6), 2);
        assert_eq!(decimals(0.0..50.0, 6), 0);
        assert_eq!(label(-1e-17, 2), "0.00");
        assert_eq!(label(-0.25, 2), "-0.25");
    }
}
