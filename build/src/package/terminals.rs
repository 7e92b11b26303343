//! terminalsAndIcons: inputs and outputs in groups that a tool connects and draws as one (FMI 2.0.4,
//! section 2.3; the file itself is that of FMI 3.0, section 2.4.9).

use super::Files;
use crate::figure::{COLOURS, FRAME};
use crate::raster;
use crate::xml::Xml;
use anyhow::{Result, anyhow};
use plotters::prelude::*;
use std::io;

/// A group of variables.
struct Terminal {
    name: &'static str,
    description: &'static str,
    icon: Icon,
    variables: &'static [&'static str],
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Icon {
    Input,
    Output,
}

const TERMINALS: [Terminal; 6] = [
    Terminal {
        name: "controls",
        description: "What an autopilot commands",
        icon: Icon::Input,
        variables: &["delta_e", "phi"],
    },
    Terminal {
        name: "air",
        description: "Motion of the air",
        icon: Icon::Input,
        variables: &["w_gust", "u_gust"],
    },
    Terminal {
        name: "motion",
        description: "Rigid-body motion",
        icon: Icon::Output,
        variables: &["V", "gamma", "h", "alpha", "q", "theta"],
    },
    Terminal {
        name: "structure",
        description: "Bending of the fuselage and sloshing of the propellant",
        icon: Icon::Output,
        variables: &["eta1", "eta2", "eta3", "slosh1", "slosh2"],
    },
    Terminal {
        name: "loads",
        description: "Forces, moment and what they scale with",
        icon: Icon::Output,
        variables: &["lift", "drag", "thrust", "moment", "mach", "qbar", "n_z", "choking_margin"],
    },
    Terminal {
        name: "sensors",
        description: "What an inertial measurement unit and an incidence vane on the bent body see",
        icon: Icon::Output,
        variables: &["theta_imu", "q_imu", "gamma_imu", "n_z_imu", "n_x_imu", "alpha_probe"],
    },
];

/// The icon fills the coordinate system from minus to plus this.
const HALF: f64 = 100.0;
/// Side of a terminal's icon, in these coordinates.
const SIDE: f64 = 20.0;
/// A vehicle's icon is 20 mm wide.
const TO_MM: f64 = 0.1;
/// Side of a terminal's picture, pixels, and how much larger it is drawn.
const PIXELS: u32 = 40;
const FINE: u32 = 4;

impl Icon {
    fn base_name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Output => "output",
        }
    }

    /// A triangle that points along the signal: full for an input, hollow for an output.
    fn png(self) -> Result<Vec<u8>> {
        let side = PIXELS * FINE;
        let mut pixels = vec![0; (side * side * 3) as usize];
        let area = BitMapBackend::with_buffer(&mut pixels, (side, side)).into_drawing_area();
        self.draw(&area).map_err(|error| anyhow!("the icon cannot be drawn: {error}"))?;
        drop(area);
        raster::png(&pixels, side, FINE)
    }

    fn draw<B: DrawingBackend>(
        self,
        area: &DrawingArea<B, plotters::coord::Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let side = (PIXELS * FINE) as i32;
        let triangle = |border: i32| {
            // The border is as wide at the slopes as at the straight side.
            [(border, 2 * border), (side - 2 * border, side / 2), (border, side - 2 * border)]
        };
        area.fill(&WHITE)?;
        area.draw(&Polygon::new(triangle(0).to_vec(), FRAME))?;
        let inside = if self == Self::Input { COLOURS[0] } else { WHITE };
        area.draw(&Polygon::new(triangle(side / 16).to_vec(), inside))?;
        area.present()
    }
}

/// The directory, with the picture of the vehicle as its icon.
pub fn files(picture: &[u8]) -> Result<Files> {
    let mut files = Files::from([
        ("terminalsAndIcons/terminalsAndIcons.xml".to_string(), xml()?.into_bytes()),
        ("terminalsAndIcons/icon.png".to_string(), picture.to_vec()),
    ]);
    for icon in [Icon::Input, Icon::Output] {
        files.insert(format!("terminalsAndIcons/{}.png", icon.base_name()), icon.png()?);
    }
    Ok(files)
}

fn xml() -> Result<String> {
    let square = |[x, y]: [f64; 2], half: f64| {
        [("x1", x - half), ("y1", y - half), ("x2", x + half), ("y2", y + half)]
            .map(|(key, value)| (key, value.to_string()))
    };
    let mut xml = Xml::new()?;
    xml.parent("fmiTerminalsAndIcons", &[("fmiVersion", "3.0".to_string())], |xml| {
        xml.parent("GraphicalRepresentation", &[], |xml| {
            let whole = square([0.0, 0.0], HALF);
            let scaling = ("suggestedScalingFactorTo_mm", TO_MM.to_string());
            xml.leaf("CoordinateSystem", &[whole.as_slice(), &[scaling]].concat())?;
            xml.leaf("Icon", &whole)
        })?;
        xml.parent("Terminals", &[], |xml| {
            for icon in [Icon::Input, Icon::Output] {
                let side: Vec<_> = TERMINALS.iter().filter(|t| t.icon == icon).collect();
                let x = if icon == Icon::Input { -HALF } else { HALF };
                for (place, terminal) in side.iter().enumerate() {
                    // From above, evenly over the height.
                    let below = (2 * place + 1) as f64 / (2 * side.len()) as f64;
                    terminal.write(xml, &square([x, HALF - below * 2.0 * HALF], 0.5 * SIDE))?;
                }
            }
            Ok(())
        })
    })?;
    Ok(xml.finish()?)
}

impl Terminal {
    fn write(&self, xml: &mut Xml, place: &[(&str, String)]) -> io::Result<()> {
        let attributes = [
            ("name", self.name.to_string()),
            // Variables of the same name belong together, and either side may have more.
            ("matchingRule", "bus".to_string()),
            ("description", self.description.to_string()),
        ];
        xml.parent("Terminal", &attributes, |xml| {
            for name in self.variables {
                let attributes = [
                    ("variableName", (*name).to_string()),
                    ("memberName", (*name).to_string()),
                    ("variableKind", "signal".to_string()),
                ];
                xml.leaf("TerminalMemberVariable", &attributes)?;
            }
            let icon = [("iconBaseName", self.icon.base_name().to_string())];
            xml.leaf("TerminalGraphicalRepresentation", &[place, &icon].concat())
        })
    }
}
