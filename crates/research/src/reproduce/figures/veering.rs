//! Veering of slosh and flexible modes.

use super::axes::{Axes, LEFT, range, text};
use super::marker::{self, look};
use crate::reproduce::veering::Veering;
use ahv::structure::MODES;
use ahv_tool::figure::{Area, Drawing, Drawn, FRAME};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub const SIZE: (u32, u32) = (1000, 1160);
/// Number of lowest modes, whose frequencies the sloshing frequency passes.
const LOW: usize = 3;

/// One column per fuel level.
pub struct Figure<'a>(pub &'a [Veering]);

impl Drawing for Figure<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B>
    where
        B::ErrorType: 'static,
    {
        let inner = area.margin(4 * scale, 4 * scale, 4 * scale, 4 * scale);
        let (head, body) = inner.split_vertically(36 * scale);
        legend(&head, scale)?;
        let x_name = "frequency of the liquid alone, rad/s";
        for (column, half) in body.split_evenly((1, self.0.len())).iter().enumerate() {
            let veering = &self.0[column];
            let rows = half.split_by_breakpoints([0; 0], [440, 670].map(|y| y * scale as i32));
            let steps = &veering.steps;
            let x = [0.0, *steps.last().unwrap_or(&1.0)];
            let label = |letter: usize, words: &str| {
                let letter = ["a", "b", "c", "d", "e", "f"][letter + column];
                format!("({letter}) {words}, {:.0} % fuel", 100.0 * veering.fuel)
            };
            let low = veering.omega[..LOW].iter().flatten().copied();
            let top = range(low, 1.0)[1];
            let panels = [
                (label(0, "frequency"), [x_name, "rad/s"], [0.0, top]),
                (label(2, "4th and 5th, change"), ["", "%"], {
                    let changes = (LOW..MODES).flat_map(|i| veering.change(i));
                    range(changes.collect::<Vec<_>>().into_iter(), 1.0)
                }),
                (label(4, "share of slosh"), [x_name, "of strain energy"], [-0.03, 1.03]),
            ];
            for (number, (cell, (title, names, y))) in rows.iter().zip(&panels).enumerate() {
                let axes = Axes { title, names: *names, x, y: *y };
                let plot = axes.draw(cell, scale)?;
                let modes = match number {
                    0 => 0..LOW,
                    1 => LOW..MODES,
                    _ => 0..MODES,
                };
                if number == 0 {
                    let end = x[1].min(top);
                    plot.dashed(&[(0.0, 0.0), (end, end)], (2, 4), FRAME.stroke_width(scale))?;
                }
                for i in modes {
                    let values = match number {
                        0 => veering.omega[i].clone(),
                        1 => veering.change(i),
                        _ => veering.slosh[i].clone(),
                    };
                    let points: Vec<_> = steps.iter().copied().zip(values).collect();
                    let look = look(i);
                    plot.line(&points, look.colour.stroke_width(2 * scale))?;
                    // Offset from curve to curve, so that markers do not hide each other.
                    for point in points.iter().skip(6 + 5 * i).step_by(32) {
                        marker::draw(&plot.area, look, plot.place(*point), true, scale)?;
                    }
                }
            }
        }
        Ok(())
    }
}

fn legend<B: DrawingBackend>(area: &Area<B>, scale: u32) -> Drawn<B> {
    let style = text(scale).pos(Pos::new(HPos::Left, VPos::Center));
    let unit = scale as i32;
    let mut x = LEFT as i32 * unit;
    area.draw_text("modes by frequency:", &style, (x, 16 * unit))?;
    x += 220 * unit;
    for i in 0..MODES {
        marker::draw(area, look(i), (x, 16 * unit), true, scale)?;
        let words = ["1st", "2nd", "3rd", "4th", "5th"][i];
        area.draw_text(words, &style, (x + 12 * unit, 16 * unit))?;
        x += 80 * unit;
    }
    area.draw_text("dotted: liquid alone", &style, (x, 16 * unit))
}
