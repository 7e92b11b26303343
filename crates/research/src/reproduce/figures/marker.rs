//! Marker shapes, which distinguish curves without colour.

use crate::reproduce::roots::Name;
use ahv_tool::figure::{Area, COLOURS, Drawn};
use plotters::prelude::*;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    Circle,
    Square,
    Diamond,
    Up,
    Down,
}

/// Colour and marker of a branch.
#[derive(Debug, Clone, Copy)]
pub struct Look {
    pub colour: RGBColor,
    pub shape: Shape,
}

/// Colour and marker of one of five modes.
pub fn look(number: usize) -> Look {
    let shapes = [Shape::Circle, Shape::Square, Shape::Diamond, Shape::Up, Shape::Down];
    Look { colour: COLOURS[number % 5], shape: shapes[number % 5] }
}

impl Look {
    pub fn of(name: Name) -> Self {
        match name {
            Name::Flexible(i) => look(i),
            Name::Slosh(i) => look(3 + i),
            _ => Self { colour: BLACK, shape: Shape::Circle },
        }
    }
}

impl Shape {
    /// Corners around the middle.
    fn corners(self, (x, y): (i32, i32), radius: f64) -> Vec<(i32, i32)> {
        // Of about equal area.
        let (count, turn, size) = match self {
            Self::Circle => (24, 0.0, 1.0),
            Self::Square => (4, 45.0, 1.22),
            Self::Diamond => (4, 0.0, 1.3),
            Self::Up => (3, -90.0, 1.4),
            Self::Down => (3, 90.0, 1.4),
        };
        (0..count)
            .map(|corner| {
                let angle = f64::to_radians(turn + 360.0 * f64::from(corner) / f64::from(count));
                let (sin, cos) = libm::sincos(angle);
                let reach = size * radius;
                (x + (reach * cos).round() as i32, y + (reach * sin).round() as i32)
            })
            .collect()
    }
}

/// An open or a filled marker.
pub fn draw<B: DrawingBackend>(
    area: &Area<B>,
    look: Look,
    at: (i32, i32),
    filled: bool,
    scale: u32,
) -> Drawn<B> {
    let mut corners = look.shape.corners(at, 5.0 * f64::from(scale));
    let fill = if filled { look.colour } else { WHITE };
    area.draw(&Polygon::new(corners.clone(), fill.filled()))?;
    corners.push(corners[0]);
    area.draw(&PathElement::new(corners, look.colour.stroke_width(3 * scale / 2)))
}

/// An arrowhead along a curve in pixels, in the middle of its length; none on a curve hidden by the markers at its
/// ends.
pub fn arrow<B: DrawingBackend>(
    area: &Area<B>,
    colour: RGBColor,
    points: &[(i32, i32)],
    scale: u32,
) -> Drawn<B> {
    let unit = f64::from(scale);
    let length = |pair: &[(i32, i32)]| {
        libm::hypot(f64::from(pair[1].0 - pair[0].0), f64::from(pair[1].1 - pair[0].1))
    };
    let total: f64 = points.windows(2).map(length).sum();
    if total < 26.0 * unit {
        return Ok(());
    }
    // Start and end of the arrowhead along the curve.
    let mut at = [0.5 * total - 6.0 * unit, 0.5 * total + 6.0 * unit].into_iter().map(|way| {
        let mut passed = 0.0;
        let index = points.windows(2).position(|pair| {
            passed += length(pair);
            passed >= way
        });
        points[index.map_or(points.len() - 1, |index| index + 1)]
    });
    let (Some(tail), Some(tip)) = (at.next(), at.next()) else { return Ok(()) };
    let (dx, dy) = (f64::from(tip.0 - tail.0), f64::from(tip.1 - tail.1));
    let size = libm::hypot(dx, dy);
    if size == 0.0 {
        return Ok(());
    }
    let (ux, uy) = (dx / size, dy / size);
    let corner = |along: f64, across: f64| {
        let x = f64::from(tail.0) + unit * (along * ux - across * uy);
        let y = f64::from(tail.1) + unit * (along * uy + across * ux);
        (x.round() as i32, y.round() as i32)
    };
    let head = vec![corner(0.0, 5.0), corner(12.0, 0.0), corner(0.0, -5.0), corner(3.0, 0.0)];
    area.draw(&Polygon::new(head, colour.filled()))
}
