//! Figs 3 and 5: the beam's stiffness and its mode shapes.

use super::axes::{Axes, Plot, range, text};
use super::marker::{self, look};
use ahv::data::VehicleData;
use ahv::structure::{Beam, FLEXIBLE, Modes, Oscillator};
use ahv_tool::figure::{Area, COLOURS, Drawing, Drawn, FRAME};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub const STIFFNESS_SIZE: (u32, u32) = (1000, 470);
pub const SHAPES_SIZE: (u32, u32) = (1000, 1090);

/// Fig. 3.
pub struct Stiffness<'a> {
    pub data: &'a VehicleData,
    pub beam: &'a Beam,
}

impl Drawing for Stiffness<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B>
    where
        B::ErrorType: 'static,
    {
        const GIGA: f64 = 1e-9;
        let inner = area.margin(4 * scale, 4 * scale, 4 * scale, 4 * scale);
        let stations = &self.data.beam.stiffness_station_m.value;
        let values = &self.data.beam.stiffness_n_m2_per_m.value;
        let top = values.iter().copied().fold(0.0, f64::max) * GIGA * 1.12;
        let axes = Axes {
            title: "Bending stiffness EI per metre of width: identified stations, 500 elements",
            names: ["x from the nose, m", "EI, GN m²/m"],
            // A margin for the markers at the ends.
            x: [-0.02, 1.02].map(|share| share * self.beam.length_m()),
            y: [0.0, top],
        };
        let plot = axes.draw(&inner, scale)?;
        tanks(&plot, self.data)?;
        // Steps, as each element has a constant stiffness.
        let steps: Vec<_> = self
            .beam
            .stiffness
            .iter()
            .enumerate()
            .flat_map(|(e, ei)| {
                let ends = [e, e + 1].map(|node| self.beam.station(node));
                ends.map(|x| (x, ei * GIGA))
            })
            .collect();
        plot.line(&steps, COLOURS[0].stroke_width(2 * scale))?;
        for (x, ei) in stations.iter().zip(values) {
            marker::draw(&plot.area, look(0), plot.place((*x, ei * GIGA)), false, scale)?;
        }
        Ok(())
    }
}

/// Draws the extent of the tanks in the background.
fn tanks<B: DrawingBackend>(plot: &Plot<B>, data: &VehicleData) -> Drawn<B> {
    let (_, height) = plot.size();
    for tank in &data.tank {
        let half = 0.5 * tank.length_m.value;
        let [left, right] = [-half, half].map(|d| plot.place((tank.centre_m.value + d, 0.0)).0);
        let corners = [(left, 1), (right, height - 1)];
        plot.area.draw(&Rectangle::new(corners, FRAME.mix(0.12).filled()))?;
        // Free of curves.
        let at = ((left + right) / 2, 14 * plot.scale as i32);
        plot.write(&format!("{} tank", tank.name), at, HPos::Center)?;
    }
    Ok(())
}

/// Fig. 5.
pub struct Shapes<'a> {
    pub data: &'a VehicleData,
    pub even: &'a Modes,
    pub slosh: &'a Modes,
    pub beam: &'a Beam,
    pub oscillators: &'a [Oscillator],
}

impl Drawing for Shapes<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B>
    where
        B::ErrorType: 'static,
    {
        let inner = area.margin(4 * scale, 4 * scale, 4 * scale, 4 * scale);
        let (head, body) = inner.split_vertically(30 * scale);
        self.legend(&head, scale)?;
        for (i, cell) in body.split_evenly((FLEXIBLE, 1)).iter().enumerate() {
            let omega = [self.even, self.slosh].map(|modes| modes.omega_rad_per_s[i]);
            let title = format!(
                "{} mode: {:.2} rad/s with even mass, {:.2} rad/s with sloshing mass",
                ahv_tool::modes::ordinal(i),
                omega[0],
                omega[1]
            );
            let curves = [self.even, self.slosh].map(|modes| self.curve(modes, i));
            let masses: Vec<_> = self
                .oscillators
                .iter()
                .zip(&self.slosh.slosh_displacement)
                .map(|(o, relative)| {
                    let w = self.slosh.shape[i].w[o.node];
                    (self.beam.station(o.node), w, w + relative[i])
                })
                .collect();
            let deflections = curves.iter().flatten().map(|(_, w)| *w);
            let axes = Axes {
                title: &title,
                names: [if i + 1 == FLEXIBLE { "x from the nose, m" } else { "" }, "deflection"],
                x: [0.0, self.beam.length_m()],
                y: range(deflections, 2.0),
            };
            let plot = axes.draw(cell, scale)?;
            tanks(&plot, self.data)?;
            let zero = [(0.0, 0.0), (self.beam.length_m(), 0.0)];
            plot.line(&zero, FRAME.stroke_width(scale))?;
            plot.line(&curves[0], COLOURS[0].stroke_width(2 * scale))?;
            plot.dashed(&curves[1], (9, 4), COLOURS[1].stroke_width(2 * scale))?;
            for (x, node, mass) in masses {
                plot.line(&[(x, node), (x, mass)], COLOURS[1].stroke_width(scale))?;
                let mut square = look(1);
                square.colour = COLOURS[1];
                marker::draw(&plot.area, square, plot.place((x, mass)), true, scale)?;
            }
        }
        Ok(())
    }
}

impl Shapes<'_> {
    fn curve(&self, modes: &Modes, i: usize) -> Vec<(f64, f64)> {
        let nodes = modes.shape[i].w.iter().enumerate();
        nodes.map(|(node, w)| (self.beam.station(node), *w)).collect()
    }

    fn legend<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B> {
        let style = text(scale).pos(Pos::new(HPos::Left, VPos::Center));
        let unit = scale as i32;
        let y = 16 * unit;
        let line = |x: i32| vec![(x * unit, y), ((x + 36) * unit, y)];
        let blue = COLOURS[0].stroke_width(2 * scale);
        area.draw(&PathElement::new(line(84), blue))?;
        area.draw_text("even mass", &style, (126 * unit, y))?;
        let points = line(258).into_iter();
        let red = COLOURS[1].stroke_width(2 * scale);
        let dashes = plotters::element::DashedPathElement::new(points, 9 * scale, 4 * scale, red);
        area.draw(&dashes)?;
        area.draw_text("sloshing mass, beam", &style, (300 * unit, y))?;
        marker::draw(area, look(1), (538 * unit, y), true, scale)?;
        area.draw_text("sloshing mass itself; nose = 1", &style, (552 * unit, y))
    }
}
