//! Writes the FMU's documentation from the table of variables and the vehicle data.

use crate::workspace::{MAX_TEXT_BYTES, read_text, root};
use ahv::flight::{Flight, Setup};
use ahv::vehicle::MAX_GUST_M_PER_S;
use anyhow::Result;
use fmi_model::standard::Standard;
use fmi_model::{Kind, Model, Role, Variable, identity::guid_in_package};
use quick_xml::escape::escape;
use std::fmt::Write;

/// On a narrow screen each variable is a paragraph: name, meaning, then the other columns.
const STYLE: &str = "\
body{font:16px/1.5 sans-serif;color:#1a1a1a;background:#fff;max-width:60em;margin:2em auto;padding:0 1em;\
overflow-wrap:break-word}img{max-width:100%}a{padding:.3em 0;color:#0054a6}\
.table{overflow-x:auto}table{border-collapse:collapse;font-size:14px}\
th,td{border:1px solid #bbb;padding:.2em .5em;text-align:left;vertical-align:top}th{background:#eee}\
td.n{text-align:right}td:last-child{min-width:18em}\
@media(max-width:44em){thead{display:none}table,tbody{display:block}\
tr{display:flex;flex-wrap:wrap;column-gap:.9em;padding:.6em 0;border-bottom:1px solid #bbb}\
td,td.n{order:2;border:0;padding:0;color:#555;text-align:left}td:empty{display:none}\
td:nth-child(2),td:last-child{order:1;flex-basis:100%;min-width:0;color:inherit}\
td:nth-child(2){font-size:16px;font-weight:bold}\
td:nth-child(1)::before{content:'ref. '}td:nth-child(4)::before{content:'unit '}\
td:nth-child(5)::before{content:'start '}}";

const EQUATIONS: &str = "\
<p>The vehicle moves over a spherical, non-rotating earth with inverse-square gravity. Rigid-body states are
airspeed, altitude, flight-path angle, incidence and pitch rate; all forces are per metre of
width.</p>
<ul>
<li>Airspeed: thrust along the flight path minus drag, divided by mass, minus gravity along the path.</li>
<li>Flight-path angle: lift and the normal component of thrust, divided by mass and airspeed, minus gravity
normal to the path, plus the centrifugal term of the curved earth.</li>
<li>Incidence: pitch rate minus the rate of the flight-path angle. Attitude is incidence plus flight-path angle.</li>
<li>Pitch: moment of air and thrust about the mass centre, divided by the pitch inertia.</li>
<li>Modes: each is a damped oscillator driven by its generalised aerodynamic force. The modes are
those of the free-free beam with the sloshing masses on their springs, so they contain the force of the
propellant; the dampers of the sloshing masses couple them. Pitch, bending and slosh
share one mass matrix, with the mass centre and pitch inertia of the coefficient set.</li>
<li>Lift, drag, moment and thrust: dynamic pressure times a curve fit in incidence, elevator, fuel ratio, bending
and its rates. The incidence is that of the body, which the sloshing liquid turns. Pitch-rate terms from
strip theory are multiplied by <code>pitch_rate_factor</code>.</li>
<li>Sensors are fixed to a point of the bent body: its flight path, attitude and accelerations are those of
the mass centre plus the contributions of pitch rate, bending and slosh.</li>
<li>In moving air, incidence, airspeed and Mach number are relative to the air, and lift
and drag are normal to and along the velocity through it. The gust is uniform along the vehicle.</li>
<li>With <code>fuel_burn</code> the engine consumes fuel from the tanks; mass, mass centre and modes change with it.</li>
</ul>
<p>Between communication points the inputs are constant, or follow the derivatives (orders 1 to 3) that
the master sets for the step. The states are integrated by an exponential method, which advances the
decoupled oscillators exactly, or, while inputs vary within the step, by an explicit Runge-Kutta method of
order 8. Both control their error and end exactly on the communication point, so a communication step
may be of any length. Communication points that differ by less than a millionth of the step, or by rounding to
nine decimals, are the same instant.</p>
<p>In Model Exchange the master integrates. The third flexible mode, 108 rad/s with little damping, limits
fixed-step methods: with explicit Euler it is unstable at steps above about 0.4 ms, and the master gives no
warning. At the default step size of 0.2 ms all modes decay and the error of a
flight is a few per cent of its excursion; solvers with error control, such as CVODE, choose their own steps.</p>";

const SUMMARY: &str = "\
<p><img src=\"../model.png\" alt=\"Side view with two tanks; below, the first bending mode\" \
width=\"300\"/></p>
<p>Inputs are elevator, fuel ratio and the vertical and horizontal velocity of the air; outputs are the
rigid-body motion, the flexible and sloshing modes, the loads and the sensor readings. The fuselage is a
free-free beam of finite elements; the sloshing masses of two tanks are part of its modes. The library
opens no windows and depends only on the system.</p>";

/// Where the numbers are.
const BUILT_IN: &str = "<p>It contains all data and reads no files.</p>";
const OWN: &str =
    "<p>It reads the data of this vehicle from <code>resources</code>, and refuses others.</p>";

const CITE: &str = "\
<h2>How to cite</h2>
<p>This model, with its version and the identifier above; and the paper whose vehicle it is:</p>
<p>Xu Xiaodong, Huang Yimin, Cai Xiaobin: <i>Flight Dynamic Analysis of Hypersonic Vehicle Considering
Liquid-Solid Coupling</i>. Transactions of Nanjing University of Aeronautics and Astronautics 32(1),
2015, 81-88. doi:10.16356/j.1005-1120.2015.01.081</p>
<p>The published rigid-body curve fits are those of Parker, Serrani, Yurkovich, Bolender and Doman:
<i>Control-Oriented Modeling of an Air-Breathing Hypersonic Vehicle</i>. Journal of Guidance, Control,
and Dynamics 30(3), 2007, 856-869.</p>";

const REPORT: &str = "\
<h2>How to report a problem</h2>
<p>First simulate the case in <a href=\"cross-check/\">cross-check</a>: inputs, options and reference outputs
in the format of the FMI cross-check. If your tool gives different outputs, the problem is in the
import. Otherwise send the authors: version and identifier of the model; platform,
tool and its version; parameters, inputs, step size and tolerance; the log with all
categories on (<code>fmi2SetDebugLogging</code>); the result and what you expected.</p>";

/// What the page says of FMI 2.0, and of FMI 3.0.
const FMI3: [(&str, &str); 3] = [
    ("fmi2SetDebugLogging", "fmi3SetDebugLogging"),
    ("ends early with fmi2Discard", "ends early with terminateSimulation"),
    (
        "follow the derivatives (orders 1 to 3) that\nthe master sets for the step",
        "move linearly to where\nthe master says that they will be at its end",
    ),
];

/// The page, as valid XHTML; `machines` are the packaged platforms. The same sources give the same bytes.
pub fn html(setup: &Setup, standard: Standard, machines: &[String]) -> Result<String> {
    let mut rows = String::new();
    // Inputs come first, whatever their value reference.
    let (inputs, others): (Vec<_>, Vec<_>) = Setup::VARIABLES
        .iter()
        .enumerate()
        .partition(|(_, variable)| matches!(variable.role, Role::Input(_)));
    for (reference, variable) in inputs.into_iter().chain(others) {
        variable_row(&mut rows, reference, variable, setup)?;
    }
    let same = if machines.len() > 1 {
        " All compute the same bits, and a serialised state of one can be restored on another."
    } else {
        ""
    };
    let machines = format!("<p>It runs on {}.{same}</p>", machines.join(" and on "));
    let data = if setup.data().own_files.is_empty() { BUILT_IN } else { OWN };
    let limits = limits(&setup.fly()?);
    let changes = changes()?;
    let (version, guid) = (env!("CARGO_PKG_VERSION"), guid_in_package(setup));
    let fmi = match standard {
        Standard::Fmi2 => "2.0",
        Standard::Fmi3 => "3.0",
    };
    let page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"/>\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\
         <title>ahv {version}</title><style>{STYLE}</style></head>\n<body>\n\
         <h1>ahv {version}</h1>\n\
         <p>Longitudinal flight of an air-breathing hypersonic vehicle with a flexible fuselage and \
         sloshing propellant, after Xu, Huang and Cai, Trans. Nanjing Univ. Aero. Astro. 32(1), \
         2015, 81-88. FMI {fmi} for Co-Simulation and Model Exchange. Model {guid}.</p>\n\
         {SUMMARY}\n{data}\n{machines}\n\
         <h2>Use</h2>\n\
         <p>With default parameters the vehicle flies level and trimmed; <code>delta_e</code> and \
         <code>phi</code> are deviations from trim. It is unstable in pitch: without a controller \
         even rounding errors grow, so uncontrolled flight is meaningful for a few seconds only.</p>\n\
         <h2>Equations</h2>\n{EQUATIONS}\n\
         <h2>Validity and limits</h2>\n{limits}\n\
         <h2>Variables</h2>\n\
         <div class=\"table\"><table>\n<thead><tr><th>ref.</th><th>name</th><th>kind</th><th>unit</th>\
         <th>start</th><th>range</th><th>meaning</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n\
         {CITE}\n{REPORT}\n\
         <h2>Changes</h2>\n{changes}\n\
         <h2>Licences</h2>\n<p>{}. The texts, and those of the libraries inside the binary, are in \
         <a href=\"licenses/\">licenses</a>.</p>\n</body>\n</html>\n",
        env!("CARGO_PKG_LICENSE")
    );
    Ok(match standard {
        Standard::Fmi2 => page,
        Standard::Fmi3 => FMI3.iter().fold(page, |page, (two, three)| page.replace(two, three)),
    })
}

/// A number without the rounding errors of unit conversion.
fn plain(value: f64) -> String {
    const DIGITS: f64 = 1e9;
    ((value * DIGITS).round() / DIGITS).to_string()
}

/// The changelog without its title, headings one level lower.
fn changes() -> Result<String> {
    let text = read_text(&root().join("CHANGELOG.md"), MAX_TEXT_BYTES)?;
    let text = text.split_once("\n## ").map_or("", |(_, versions)| versions);
    let text = format!("## {text}").replace("\n## ", "\n### ");
    let mut page = String::new();
    pulldown_cmark::html::push_html(&mut page, pulldown_cmark::Parser::new(&format!("#{text}")));
    Ok(page)
}

fn limits(flight: &Flight) -> String {
    let vehicle = flight.vehicle();
    let envelope = &vehicle.aero.envelope;
    let between = |[min, max]: [f64; 2], factor: f64, unit: &str| {
        format!("{} to {}{unit}", plain(min * factor), plain(max * factor))
    };
    let degrees = 1f64.to_degrees();
    let [elevator, fuel] = vehicle.limits;
    format!(
        "<p>The default curve fits are valid for Mach {}, altitude {} and incidence {}. Outside this \
         region a step ends early with fmi2Discard, with time and state of the last valid instant. So does a \
         flight in which a sloshing mass would move further than its liquid is deep, which is little in \
         nearly empty tanks, or, with aero = shock_expansion, the burner chokes. Controls saturate at \
         elevator {} and fuel ratio {}, gusts at {}; this also limits inputs that their derivatives carry \
         beyond the range in which they can be set. If no trim exists inside these limits, initialisation fails \
         and names the limit that was hit. Values that are not finite are refused and change nothing.</p>",
        between(envelope.mach, 1.0, ""),
        between(envelope.altitude, 1e-3, " km"),
        between(envelope.alpha, degrees, " deg"),
        between([-elevator, elevator], degrees, " deg"),
        between([0.0, fuel], 1.0, ""),
        between([-MAX_GUST_M_PER_S, MAX_GUST_M_PER_S], 1.0, " m/s"),
    )
}

fn variable_row(
    text: &mut String,
    reference: usize,
    variable: &Variable<Setup>,
    setup: &Setup,
) -> Result<()> {
    let role = match variable.role {
        Role::Input(_) => "input",
        Role::Output(_) => "output",
        Role::OutputState(_) => "output, state",
        Role::LocalState(_) => "state",
        Role::Derivative(_) => "derivative",
        Role::Parameter { .. } => "parameter",
        Role::Calculated(_) => "calculated parameter",
    };
    let unit = match variable.kind {
        Kind::Real(unit) => unit.name,
        Kind::Integer | Kind::Boolean | Kind::Enumeration(..) => "",
    };
    let start =
        variable.start(setup).map_or(String::new(), |value| match variable.kind_in(setup) {
            Kind::Real(_) | Kind::Integer => plain(value),
            Kind::Boolean => (value != 0.0).to_string(),
            Kind::Enumeration(_, items) => {
                let item = items.iter().find(|(_, number, _)| f64::from(*number) == value);
                item.map_or(String::new(), |(name, ..)| name.to_string())
            }
        });
    let range = match (variable.kind_in(setup), variable.range) {
        (Kind::Enumeration(_, items), _) => {
            let items = items.iter().map(|(name, number, _)| format!("{number} {name}"));
            items.collect::<Vec<_>>().join("<br/>")
        }
        (_, Some([min, max])) => format!("{min} to {max}"),
        (_, None) => String::new(),
    };
    writeln!(
        text,
        "<tr><td class=\"n\">{reference}</td><td><code>{}</code></td><td>{role}</td><td>{unit}</td>\
         <td class=\"n\">{start}</td><td>{range}</td><td>{}</td></tr>",
        escape(variable.name),
        escape(variable.description),
    )?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use ahv::flight::Setup;
    use fmi_model::Model;
    use fmi_model::standard::Standard;

    #[test]
    fn page_is_well_formed_and_names_every_variable() {
        let page =
            super::html(&Setup::new().unwrap(), Standard::Fmi3, &["Linux".to_string()]).unwrap();
        let mut reader = quick_xml::Reader::from_str(&page);
        while !matches!(reader.read_event().unwrap(), quick_xml::events::Event::Eof) {}
        for variable in Setup::VARIABLES {
            assert!(page.contains(&format!("<code>{}</code>", variable.name)), "{}", variable.name);
        }
    }

    #[test]
    fn page_cites_the_paper_as_the_citation_file_does_and_tells_changes() {
        let page = super::html(&Setup::new().unwrap(), Standard::Fmi3, &["Linux".to_string()])
            .unwrap()
            .replace('\n', " ");
        let citation = include_str!("../../CITATION.cff");
        for key in ["    title: ", "    doi: ", "    journal: "] {
            let (_, rest) = citation.split_once(&format!("\n{key}")).unwrap();
            let value = rest.lines().next().unwrap().trim_matches('"');
            assert!(page.contains(value), "{value}");
        }
        assert!(page.contains(concat!("<h3>", env!("CARGO_PKG_VERSION"), "</h3>")));
    }
}
