//! The picture of the vehicle: side view with its tanks, and its beam in the first bending mode.

use crate::figure::{COLOURS, FRAME};
use crate::raster;
use ahv::data::Data;
use ahv::flight::Setup;
use ahv::structure::Modes;
use ahv::vehicle::structure;
use anyhow::{Result, anyhow};
use plotters::prelude::*;

/// Side of the square picture, pixels.
const SIZE: u32 = 400;
/// It is drawn this much larger and averaged.
const FINE: u32 = 4;
/// Empty border, as a part of the side.
const BORDER: f64 = 0.03;
/// Heights are drawn this much larger than lengths: the vehicle is slender.
const STRETCH: f64 = 2.6;
/// Place of the nose and of the undeformed beam below the upper edge, as parts of the side.
const NOSE: f64 = 0.36;
const BEAM: f64 = 0.78;
/// Deflection of the beam at the nose, as a part of the side.
const DEFLECTION: f64 = 0.12;
/// Part of the local height that a tank fills.
const TANK: f64 = 0.74;
/// Thickness of lines, as a part of the side.
const LINE: f64 = 0.018;

/// A place: station, m from the nose; height above the nose, m.
type Place = (f64, f64);

/// The picture as a PNG.
pub fn png() -> Result<Vec<u8>> {
    let build = Setup::new()?.parameters.build;
    let data = Data::embedded()?;
    let (beam, oscillators) = structure(&data, &build)?;
    let modes = Modes::solve(&beam, &oscillators)?;
    let shape = modes.shape[0].w.iter().enumerate();
    let bent: Vec<_> = shape.map(|(node, w)| (beam.station(node), *w)).collect();

    let side = SIZE * FINE;
    let mut pixels = vec![0; (side * side * 3) as usize];
    let area = BitMapBackend::with_buffer(&mut pixels, (side, side)).into_drawing_area();
    draw(&area, &data, &bent).map_err(|error| anyhow!("the picture cannot be drawn: {error}"))?;
    drop(area);
    raster::png(&pixels, side, FINE)
}

fn draw<B: DrawingBackend>(
    area: &DrawingArea<B, plotters::coord::Shift>,
    data: &Data,
    bent: &[Place],
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let vehicle = &data.vehicle;
    let side = f64::from(SIZE * FINE);
    let length = vehicle.geometry.length_m.value;
    let per_metre = side * (1.0 - 2.0 * BORDER) / length;
    let pixel = |(x, z): Place| {
        let down = NOSE * side - z * per_metre * STRETCH;
        ((BORDER * side + x * per_metre).round() as i32, down.round() as i32)
    };
    let along = |x: f64, share: f64| {
        let down = (BEAM - share * DEFLECTION) * side;
        ((BORDER * side + x * per_metre).round() as i32, down.round() as i32)
    };
    let fill = |places: &[Place], colour: RGBColor| {
        area.draw(&Polygon::new(places.iter().map(|p| pixel(*p)).collect::<Vec<_>>(), colour))
    };
    let line = ShapeStyle::from(&COLOURS[1]).filled().stroke_width((LINE * side) as u32);
    area.fill(&WHITE)?;

    // The walls, from the nose aft; they meet at the tail.
    let fore = vehicle.geometry.fore_body_m.value;
    let rear = fore + vehicle.geometry.nacelle_m.value;
    let lowest = -fore * vehicle.outline.lower_angle_rad.value.tan();
    let tail = length * vehicle.outline.upper_angle_rad.value.tan();
    let upper = |x: f64| x / length * tail;
    let lower = |x: f64| match x {
        x if x < fore => x / fore * lowest,
        x if x < rear => lowest,
        x => lowest + (x - rear) / (length - rear) * (tail - lowest),
    };
    let body = [(0.0, 0.0), (length, tail), (rear, lowest), (fore, lowest)];
    fill(&body, RGBColor(176, 186, 196))?;
    let cowl = lowest - vehicle.engine.duct_height_m.value;
    let half = 0.5 * vehicle.engine.duct_height_m.value;
    fill(
        &[(fore, lowest), (fore, cowl + half), (fore + half, cowl), (rear, cowl), (rear, lowest)],
        FRAME,
    )?;
    // The elevator, a plate about its station.
    let chord = 0.5 * vehicle.outline.elevator_area_m2_per_m.value;
    let (at, height) =
        (vehicle.outline.elevator_station_m.value, vehicle.outline.elevator_height_m.value);
    let plate =
        [(at - chord, height), (at, height + 0.16), (at + chord, height), (at, height - 0.16)];

    fill(&plate, FRAME)?;
    for tank in &vehicle.tank {
        let half = 0.5 * tank.length_m.value;
        let [front, back] = [-half, half].map(|d| tank.centre_m.value + d);
        let back = back.min(length - 0.06 * length);
        let inside = |x: f64, share: f64| {
            let (low, high) = (lower(x), upper(x));
            (x, 0.5 * (low + high) + 0.5 * TANK * share * (high - low))
        };
        fill(
            &[inside(front, -1.0), inside(front, 1.0), inside(back, 1.0), inside(back, -1.0)],
            WHITE,
        )?;
        // The liquid leans.
        fill(
            &[inside(front, -1.0), inside(front, 0.2), inside(back, 0.75), inside(back, -1.0)],
            COLOURS[0],
        )?;
    }

    let straight = [along(0.0, 0.0), along(length, 0.0)];
    area.draw(&PathElement::new(
        straight,
        FRAME.mix(0.5).stroke_width((LINE * side / 3.0) as u32),
    ))?;
    let nose = bent.first().map_or(1.0, |(_, w)| *w);
    let curve: Vec<_> = bent.iter().map(|(x, w)| along(*x, w / nose)).collect();
    area.draw(&PathElement::new(curve, line))?;
    // The sloshing masses on it.
    for tank in &vehicle.tank {
        let near = bent.iter().min_by(|a, b| {
            let [a, b] = [a, b].map(|(x, _)| (x - tank.centre_m.value).abs());
            a.total_cmp(&b)
        });
        let Some((x, w)) = near else { continue };
        area.draw(&Circle::new(
            along(*x, w / nose),
            (2.2 * LINE * side) as i32,
            COLOURS[0].filled(),
        ))?;
    }
    area.present()
}
