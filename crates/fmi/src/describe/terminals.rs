//! terminalsAndIcons.xml: inputs and outputs in groups that a tool connects and draws as one (FMI 2.0.4,
//! section 2.3; the file itself is that of FMI 3.0, section 2.4.9).

use super::xml::Xml;
use std::io;

/// A group of variables.
#[derive(Debug, Clone, Copy)]
pub struct Terminal {
    /// Name.
    pub name: &'static str,
    /// Description for users.
    pub description: &'static str,
    /// On which side it is drawn, and with which icon.
    pub side: Side,
    /// Names of its variables.
    pub variables: &'static [&'static str],
}

/// Side of the model's icon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Left.
    Input,
    /// Right.
    Output,
}

impl Side {
    /// Name of the icon in `terminalsAndIcons`, without its ending.
    pub fn icon(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Output => "output",
        }
    }
}

/// The model's icon fills the coordinate system from minus to plus this.
const HALF: f64 = 100.0;
/// Side of a terminal's icon, in these coordinates.
const SIDE: f64 = 20.0;
/// A model's icon is 20 mm wide.
const TO_MM: f64 = 0.1;

/// The whole file; without terminals it says where the model's icon is.
///
/// # Errors
/// None: writing to memory does not fail.
pub fn terminals_and_icons(terminals: &[Terminal]) -> io::Result<String> {
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
        if terminals.is_empty() {
            return Ok(());
        }
        xml.parent("Terminals", &[], |xml| {
            for side in [Side::Input, Side::Output] {
                let group: Vec<_> = terminals.iter().filter(|t| t.side == side).collect();
                let x = if side == Side::Input { -HALF } else { HALF };
                for (place, terminal) in group.iter().enumerate() {
                    // From above, evenly over the height.
                    let below = (2 * place + 1) as f64 / (2 * group.len()) as f64;
                    terminal.write(xml, &square([x, HALF - below * 2.0 * HALF], 0.5 * SIDE))?;
                }
            }
            Ok(())
        })
    })?;
    xml.finish()
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
            let icon = [("iconBaseName", self.side.icon().to_string())];
            xml.leaf("TerminalGraphicalRepresentation", &[place, &icon].concat())
        })
    }
}
