//! Walls, cut into panels, and the forces on them.

use super::stream::{Medium, Stream};
use crate::gas::GasError;

/// Panels per wall; the error of the midpoint rule is below 1e-3 on the plume, where the pressure is steepest.
pub const PANELS: usize = 100;

/// A force per metre of width and its point of application; x aft and z up from the nose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Force {
    /// Station, m.
    pub x: f64,
    /// Height, m.
    pub z: f64,
    /// Along the axis, aft, N/m.
    pub aft: f64,
    /// Across the axis, up, N/m.
    pub up: f64,
}

/// A flat wall.
#[derive(Debug, Clone, Copy)]
pub struct Wall {
    /// Front end: station and height, m.
    pub from: [f64; 2],
    /// Rear end: station and height, m.
    pub to: [f64; 2],
    /// 1 if the stream is below it, -1 if above.
    pub side: f64,
}

impl Wall {
    /// The force on each panel from an excess pressure (Pa) as a function of the position, 0 to 1.
    pub fn pressed(&self, pressure: impl Fn(f64) -> f64) -> impl Iterator<Item = Force> {
        let [[x0, z0], [x1, z1]] = [self.from, self.to];
        let (length, rise, share) = (x1 - x0, z1 - z0, 1.0 / PANELS as f64);
        let side = self.side;
        (0..PANELS).map(move |panel| {
            let place = (panel as f64 + 0.5) * share;
            let load = side * pressure(place) * share;
            let (x, z) = (x0 + place * length, z0 + place * rise);
            Force { x, z, aft: -load * rise, up: load * length }
        })
    }

    /// The forces of a stream, and the stream at the rear end. The wall turns the stream by an angle (rad) that
    /// varies with the station: at a sharp corner at the front end, then isentropically. Pressures are relative to
    /// `ambient` (Pa).
    ///
    /// # Errors
    /// [`GasError`] if there is no such flow.
    pub fn washed(
        &self,
        medium: &Medium,
        stream: &Stream,
        ambient: f64,
        angle: impl Fn(f64) -> f64,
        forces: &mut Vec<Force>,
    ) -> Result<Stream, GasError> {
        let mut met = angle(self.from[0]);
        let mut stream = medium.turned(stream, met)?;
        for unit in self.pressed(|_| 1.0) {
            let next = angle(unit.x);
            stream = medium.bent(&stream, next - met)?;
            met = next;
            let excess = stream.pressure - ambient;
            forces.push(Force { aft: excess * unit.aft, up: excess * unit.up, ..unit });
        }
        medium.bent(&stream, angle(self.to[0]) - met)
    }
}
