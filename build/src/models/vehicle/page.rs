//! What the vehicle's page says besides its variables.

use crate::documentation::{Page, html_of, plain};
use crate::workspace::{MAX_TEXT_BYTES, read_text, root};
use ahv::flight::{Flight, Setup};
use ahv::vehicle::MAX_GUST_M_PER_S;
use anyhow::Result;

/// Formulas in MathML, and a drawing of the signs.
const FORMULAS: &str = include_str!("../../../pages/equations.html");
const SIGNS: &str = include_str!("../../../pages/axes.svg");

const EQUATIONS: &str = "\
<ul>
<li>The earth is a sphere that does not rotate; gravity falls with the square of the distance.</li>
<li>The modes are those of the free-free beam with the sloshing masses on their springs, so they contain the force of the
propellant; the dampers of the sloshing masses couple them. Pitch, bending and slosh
share one mass matrix, with the mass centre and pitch inertia of the coefficient set.</li>
<li>The incidence of the curve fits is that of the body, which the sloshing liquid turns. Pitch-rate terms from
strip theory are multiplied by <code>pitch_rate_factor</code>.</li>
<li>Sensors are fixed to a point of the bent body: its flight path, attitude and accelerations are those of
the mass centre plus the contributions of pitch rate, bending and slosh.</li>
<li>In moving air, incidence, airspeed and Mach number are relative to the air, and lift
and drag are normal to and along the velocity through it. The gust is uniform along the vehicle.</li>
<li>With <code>fuel_burn</code> the engine consumes fuel from the tanks; mass, mass centre and modes change with it.</li>
</ul>
<p>Between communication points the inputs are constant, or follow the derivatives (orders 1 to 3) that
the master sets for the step. The states are integrated by an exponential method, which advances the
decoupled oscillators exactly. It controls its error and ends exactly on the communication point and where a
moving input meets its limit, so a communication step
may be of any length. Communication points that differ by less than a millionth of the step, or by rounding to
nine decimals, are the same instant.</p>
<p>In Model Exchange the master integrates. The third flexible mode, 108 rad/s with little damping, limits
fixed-step methods: with explicit Euler it is unstable at steps above about 0.4 ms, and the master gives no
warning. At the default step size of 0.2 ms all modes decay and the error of a
flight is a few per cent of its excursion; solvers with error control, such as CVODE, choose their own steps.</p>";

const SUMMARY: &str = "\
<p><img src=\"../terminalsAndIcons/icon.png\" alt=\"Side view with two tanks; below, the first bending mode\" \
width=\"300\"/></p>
<p>Inputs are elevator, fuel ratio and the vertical and horizontal velocity of the air; outputs are the
rigid-body motion, the flexible and sloshing modes, the loads and the sensor readings. The fuselage is a
free-free beam of finite elements; the sloshing masses of two tanks are part of its modes. The library
opens no windows and depends only on the system.</p>";

/// Where the numbers are.
const BUILT_IN: &str = "<p>It contains all data and reads no files.</p>";
const OWN: &str =
    "<p>It reads the data of this vehicle from <code>resources</code>, and refuses others.</p>";

const LEFT_OUT: &str = "\
<p>The motion is longitudinal, and all forces are per metre of width. Bending is that of a linear beam and the liquid moves on
linear springs: both hold while deflections are small against vehicle and tanks. Elevator and fuel act without delay, and
readings come without one; actuators and sensors are models of their own. Heating, and the pressure in the exhaust, are not
modelled. <code>cargo ahv reproduce</code> compares every table of the paper with this model, cell by cell.</p>";

const CITE: &str = "\
<h2 id=\"cite\">How to cite</h2>
<p>This model, with its version and the identifier above; and the paper whose vehicle it is:</p>
<p>Xu Xiaodong, Huang Yimin, Cai Xiaobin: <i>Flight Dynamic Analysis of Hypersonic Vehicle Considering
Liquid-Solid Coupling</i>. Transactions of Nanjing University of Aeronautics and Astronautics 32(1),
2015, 81-88. doi:10.16356/j.1005-1120.2015.01.081</p>
<p>The published rigid-body curve fits are those of Parker, Serrani, Yurkovich, Bolender and Doman:
<i>Control-Oriented Modeling of an Air-Breathing Hypersonic Vehicle</i>. Journal of Guidance, Control,
and Dynamics 30(3), 2007, 856-869.</p>
<pre tabindex=\"0\">@software{ahv,
  title = {ahv: a flexible, sloshing air-breathing hypersonic vehicle as FMUs of FMI 2.0 and 3.0},
  author = {{The ahv authors}},
  version = {VERSION},
}
@article{xu2015,
  title = {Flight Dynamic Analysis of Hypersonic Vehicle Considering Liquid-Solid Coupling},
  author = {Xu, Xiaodong and Huang, Yimin and Cai, Xiaobin},
  journal = {Transactions of Nanjing University of Aeronautics and Astronautics},
  volume = {32}, number = {1}, pages = {81--88}, year = {2015},
  doi = {10.16356/j.1005-1120.2015.01.081},
}</pre>";

const REPORT: &str = "\
<h2>How to report a problem</h2>
<p>First simulate the case in <a href=\"cross-check/\">cross-check</a>: inputs, options and reference outputs
in the format of the FMI cross-check. If your tool gives different outputs, the problem is in the
import. Otherwise send the authors: version and identifier of the model; platform,
tool and its version; parameters, inputs, step size and tolerance; the log with all
categories on (<code>fmi2SetDebugLogging</code>); the result and what you expected.</p>";

const ABOUT: &str = "\
Longitudinal flight of an air-breathing hypersonic vehicle with a flexible fuselage and sloshing propellant, after \
Xu, Huang and Cai, Trans. Nanjing Univ. Aero. Astro. 32(1), 2015, 81-88.";

const USE: &str = "\
<p>With default parameters the vehicle flies level and trimmed; <code>delta_e</code> and <code>phi</code> are \
deviations from trim. It is unstable in pitch: without a controller even rounding errors grow, so uncontrolled \
flight is meaningful for a few seconds only.</p>";

pub fn page(setup: &Setup) -> Result<Page> {
    let data = if setup.data().own_files.is_empty() { BUILT_IN } else { OWN };
    let limits = limits(&setup.fly()?);
    let changes = changes()?;
    let cite = CITE.replace("VERSION", env!("CARGO_PKG_VERSION"));
    Ok(Page {
        about: Some(ABOUT),
        summary: format!("{SUMMARY}\n{data}"),
        sections: format!(
            "<h2>Use</h2>\n{USE}\n\
             <h2 id=\"signs\">Signs</h2>\n<div class=\"figure\" tabindex=\"0\">{SIGNS}</div>\n<h2 id=\"equations\">Equations</h2>\n{FORMULAS}{EQUATIONS}\n\
             <h2 id=\"validity\">Validity and limits</h2>\n{limits}\n{LEFT_OUT}"
        ),
        closing: format!("{cite}\n{REPORT}\n<h2>Changes</h2>\n{changes}\n"),
    })
}

/// The changelog without its title, headings one level lower.
fn changes() -> Result<String> {
    let text = read_text(&root().join("CHANGELOG.md"), MAX_TEXT_BYTES)?;
    let text = text.split_once("\n## ").map_or("", |(_, versions)| versions);
    let text = format!("## {text}").replace("\n## ", "\n### ");
    Ok(html_of(&format!("#{text}")))
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

#[cfg(test)]
mod tests {
    use crate::documentation::html;
    use crate::models::VEHICLE;
    use fmi_model::standard::Standard;

    #[test]
    fn page_cites_the_paper_as_the_citation_file_does_and_tells_changes() {
        let page = html(&(VEHICLE.content)().unwrap(), Standard::Fmi3, &["Linux".to_string()])
            .unwrap()
            .replace('\n', " ");
        let citation = include_str!("../../../../CITATION.cff");
        for key in ["title: ", "    title: ", "    doi: ", "    journal: "] {
            let (_, rest) = citation.split_once(&format!("\n{key}")).unwrap();
            let value = rest.lines().next().unwrap().trim_matches('"');
            assert!(page.contains(value), "{value}");
        }
        assert!(page.contains(concat!("<h3>", env!("CARGO_PKG_VERSION"), "</h3>")));
    }
}
