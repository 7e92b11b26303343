//! terminalsAndIcons: inputs and outputs in groups that a tool connects and draws as one (FMI 2.0.4,
//! section 2.3; the file itself is that of FMI 3.0, section 2.4.9).

use super::Files;
use crate::figure::{COLOURS, FRAME};
use crate::raster;
use anyhow::{Result, anyhow};
use fmi_model::describe::terminals::{Side, Terminal, terminals_and_icons};
use plotters::prelude::*;

const TERMINALS: [Terminal; 6] = [
    Terminal {
        name: "controls",
        description: "What an autopilot commands",
        side: Side::Input,
        variables: &["delta_e", "phi"],
    },
    Terminal {
        name: "air",
        description: "Motion of the air",
        side: Side::Input,
        variables: &["w_gust", "u_gust"],
    },
    Terminal {
        name: "motion",
        description: "Rigid-body motion",
        side: Side::Output,
        variables: &["V", "gamma", "h", "alpha", "q", "theta"],
    },
    Terminal {
        name: "structure",
        description: "Bending of the fuselage and sloshing of the propellant",
        side: Side::Output,
        variables: &["eta1", "eta2", "eta3", "slosh1", "slosh2"],
    },
    Terminal {
        name: "loads",
        description: "Forces, moment and what they scale with",
        side: Side::Output,
        variables: &["lift", "drag", "thrust", "moment", "mach", "qbar", "n_z", "choking_margin"],
    },
    Terminal {
        name: "sensors",
        description: "What an inertial measurement unit and an incidence vane on the bent body see",
        side: Side::Output,
        variables: &["theta_imu", "q_imu", "gamma_imu", "n_z_imu", "n_x_imu", "alpha_probe"],
    },
];

/// Side of a terminal's picture, pixels, and how much larger it is drawn.
const PIXELS: u32 = 40;
const FINE: u32 = 4;

/// A triangle that points along the signal: full for an input, hollow for an output.
fn png(terminal: Side) -> Result<Vec<u8>> {
    let side = PIXELS * FINE;
    let mut pixels = vec![0; (side * side * 3) as usize];
    let area = BitMapBackend::with_buffer(&mut pixels, (side, side)).into_drawing_area();
    draw(terminal, &area).map_err(|error| anyhow!("the icon cannot be drawn: {error}"))?;
    drop(area);
    raster::png(&pixels, side, FINE)
}

fn draw<B: DrawingBackend>(
    terminal: Side,
    area: &DrawingArea<B, plotters::coord::Shift>,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let side = (PIXELS * FINE) as i32;
    let triangle = |border: i32| {
        // The border is as wide at the slopes as at the straight side.
        [(border, 2 * border), (side - 2 * border, side / 2), (border, side - 2 * border)]
    };
    area.fill(&WHITE)?;
    area.draw(&Polygon::new(triangle(0).to_vec(), FRAME))?;
    let inside = if terminal == Side::Input { COLOURS[0] } else { WHITE };
    area.draw(&Polygon::new(triangle(side / 16).to_vec(), inside))?;
    area.present()
}

/// The directory, with the picture of the vehicle as its icon.
pub fn files(picture: &[u8]) -> Result<Files> {
    let mut files = Files::from([
        (
            "terminalsAndIcons/terminalsAndIcons.xml".to_string(),
            terminals_and_icons(&TERMINALS)?.into_bytes(),
        ),
        ("terminalsAndIcons/icon.png".to_string(), picture.to_vec()),
    ]);
    for side in [Side::Input, Side::Output] {
        files.insert(format!("terminalsAndIcons/{}.png", side.icon()), png(side)?);
    }
    Ok(files)
}
