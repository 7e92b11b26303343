//! Misfit against distance from the published numbers.

use super::axes::{Axes, Scale};
use super::marker::{self, look};
use crate::identify::TradeOff;
use ahv_tool::figure::{Area, COLOURS, Drawing, Drawn, FRAME};
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

pub const SIZE: (u32, u32) = (1000, 510);
/// Weights of this many decades are labelled.
const WRITTEN: f64 = 2.0;

/// Neighbours beyond the knee further apart than this, in decades of distance, are different local minima.
const VALLEY: f64 = 0.5;

pub struct Figure<'a>(pub &'a TradeOff);

/// Range of positive values with a margin, in decades.
fn decades(values: impl Iterator<Item = f64> + Clone, [below, above]: [f64; 2]) -> [f64; 2] {
    let min = values.clone().fold(f64::INFINITY, f64::min);
    let max = values.fold(0.0, f64::max);
    [min * libm::exp10(-below), max * libm::exp10(above)]
}

impl Drawing for Figure<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B>
    where
        B::ErrorType: 'static,
    {
        let trade_off = self.0;
        let places = &trade_off.places;
        let inner = area.margin(4 * scale, 4 * scale, 4 * scale, 4 * scale);
        let axes = Axes {
            title: "Misfit to Tables 2 and 3 against distance from the published numbers",
            names: ["distance from parker2007: sum of (ln ratio / sd)²", "misfit"],
            x: decades(places.iter().map(|place| place.distance), [0.3, 0.8]),
            y: decades(places.iter().map(|place| place.misfit), [0.12, 0.2]),
        };
        let plot = axes.draw_scaled(&inner, scale, Scale::Logarithmic)?;
        let at =
            |distance: f64, misfit: f64| plot.place((libm::log10(distance), libm::log10(misfit)));
        let points: Vec<_> = places
            .iter()
            .map(|place| (libm::log10(place.distance), libm::log10(place.misfit)))
            .collect();
        let style = COLOURS[0].stroke_width(2 * scale);
        for (i, pair) in points.windows(2).enumerate() {
            // Different local minima are connected by a dashed line.
            let far = i > trade_off.knee && pair[1].0 - pair[0].0 > VALLEY;
            match far {
                true => plot.dashed(pair, (5, 5), style)?,
                false => plot.line(pair, style)?,
            }
        }
        let unit = scale as i32;
        for (i, place) in places.iter().enumerate() {
            let (x, y) = at(place.distance, place.misfit);
            let decade = libm::log10(place.weight);
            let whole = (decade - decade.round()).abs() < 1e-6;
            if i == trade_off.knee {
                continue;
            }
            marker::draw(&plot.area, look(0), (x, y), false, scale)?;
            if whole && (decade.round() % WRITTEN).abs() < 0.5 {
                let words = format!("weight {}", libm::exp10(decade.round()));
                plot.write(&words, (x + 9 * unit, y - 9 * unit), HPos::Left)?;
            }
        }
        let knee = &places[trade_off.knee];
        let (x, y) = at(knee.distance, knee.misfit);
        let mut mark = look(1);
        mark.colour = COLOURS[1];
        marker::draw(&plot.area, mark, (x, y), true, scale)?;
        let foot = (x, plot.size().1 - 14 * unit);
        let line = vec![(x, y + 8 * unit), (x, foot.1 - 10 * unit)];
        plot.area.draw(&PathElement::new(line, FRAME.stroke_width(scale)))?;
        plot.write("knee: xu2015", foot, HPos::Center)
    }
}
