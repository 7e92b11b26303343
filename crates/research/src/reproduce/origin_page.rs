//! The section on the origin of the printed digits, as Markdown.

use super::markdown::{escape, minus, percent, printed, table, value};
use super::origin::{Asked, Case, OUTPUT, Origin, PITCH_DAMPING};
use crate::identify::size;

const FOOT: f64 = 0.3048;

fn pair([right, left]: [f64; 2]) -> String {
    format!("{}, {}", value(right), value(left))
}

/// Table of short-period poles, real zeros and their products.
fn cases<'a>(head: &str, cases: impl IntoIterator<Item = &'a Case>) -> String {
    let row = |case: &Case| {
        [
            case.what.clone(),
            pair(case.poles),
            value(case.pole_product()),
            format!("{:.3}", size(case.zeros)),
            value(case.zero_product()),
        ]
    };
    let rows: Vec<_> = cases.into_iter().map(row).collect();
    let head = [head, "short period", "product", "real zeros, geometric mean", "product"];
    table(head, 0, &rows)
}

fn asked(all: &[Asked]) -> String {
    let row = |asked: &Asked| {
        [
            asked.column.to_string(),
            format!("{:.2}·10⁵", 1e-5 * asked.inertia),
            format!("{:.2}", asked.mass_centre_m),
            format!("{:.1}", asked.mass_centre_m / FOOT),
        ]
    };
    let rows: Vec<_> = all.iter().map(row).collect();
    table(["", "inertia, kg m²/m", "mass centre, m", "mass centre, ft"], 0, &rows)
}

fn zeros(origin: &Origin) -> String {
    let [mean, body] = &origin.gamma;
    let of = |case: &Case, what: &str| -> [String; 4] {
        std::array::from_fn(|i| match i {
            0 => what.to_string(),
            _ => case.pairs.get(i - 1).map_or("none".into(), |omega| value(*omega)),
        })
    };
    let rows = [
        of(mean, "γ of the mean axes, eq. (3)"),
        of(body, "γ of the body near its mass centre"),
        of(&origin.printed[1], "printed"),
    ];
    table(["imaginary parts", "1st", "2nd", "3rd"], 0, &rows)
}

fn unequal(origin: &Origin) -> String {
    let row = |case: &Case| [case.what.clone(), pair(case.poles), pair(case.zeros)];
    let mut rows: Vec<_> = origin.unequal.iter().map(row).collect();
    rows.push(row(&Case { what: "printed".into(), ..origin.printed[0].clone() }));
    table(["", "short period", "real zeros"], 0, &rows)
}

/// Largest unstable pole among some cases.
fn peak(cases: &[Case]) -> f64 {
    cases.iter().map(|case| case.poles[0]).fold(0.0, f64::max)
}

fn hypothesis() -> String {
    "## Where the printed digits come from\n\n\
     **Hypothesis.** All three columns come from the published curve fits (parker2007) with a pitch inertia near \
     6.4·10⁵ kg m²/m, which is not printed. In the flexible columns the mass centre is 8 to 11 ft further aft than \
     that of the rigid body and of the printed densities. γ of Table 3 is that of a point of the beam near \
     this mass centre, not of the mean axes of eq. (3). No source says so: it is inferred from the digits. \
     Unless stated otherwise, this command computes every number below with the published \
     coefficients.\n\n"
        .into()
}

fn poles(origin: &Origin) -> String {
    let [rigid, even, slosh] = &origin.printed;
    let off = |i: usize| percent(origin.rigid.poles[i] / rigid.poles[i] - 1.0);
    let mut text = format!(
        "**Evidence: the rigid column.** The published set with the mass centre at 55 ft and this inertia gives the \
         short-period poles to {} and {}, the geometric mean of the real zeros to {}.\n\n",
        off(0),
        off(1),
        percent(size(origin.rigid.zeros) / size(rigid.zeros) - 1.0)
    );
    let named = Case { what: "printed".into(), ..rigid.clone() };
    text += &cases("rigid body", [&origin.rigid, &named]);
    text += &format!(
        "**Evidence: from rigid to beam the poles move and the zeros stay.** From rigid to even mass the \
         printed product of the poles changes by a factor of {:.2}, that of the zeros by {:.2}.\n\n",
        even.pole_product() / rigid.pole_product(),
        even.zero_product() / rigid.zero_product(),
    );
    text += &cases("printed", [rigid, even, slosh]);
    text +=
        "*Another inertia* scales both products alike, so it is not the cause (rigid body):\n\n";
    text += &cases("inertia", &origin.inertias);
    text += &format!(
        "*Elastic terms* up to 20 times the derived ones are not enough: the unstable pole of the even column reaches {} at \
         most, the printed one is {}. Moreover, the printed frequencies of that column agree with Table 1, without \
         air, to every digit:\n\n",
        value(peak(&origin.elastic)),
        value(even.poles[0])
    );
    let row = |case: &Case| [case.what.clone(), pair(case.poles), value(case.pole_product())];
    let rows: Vec<_> = origin.elastic.iter().map(row).collect();
    text += &table(["elastic terms", "short period", "product"], 0, &rows);
    text += "*A mass centre further aft* is: it lengthens the arm of the normal force. The zeros hardly \
             change: with γ held the normal force is constant, and the vehicle is turned by a couple, which is \
             the same about every point (even mass):\n\n";
    text += &cases("mass centre aft by", &origin.shifts);
    text += "Inertia and mass centre of each column, from its two products alone:\n\n";
    text + &asked(&origin.asked)
}

fn outputs(origin: &Origin) -> String {
    let mut text = "**Evidence: the zeros are those of the body.** Even column of xu2015. With γ of the mean axes \
                    each pair of zeros stays near its pole. With γ of the body near the mass centre, where the \
                    paper fixes its beam, the zeros come much nearer to the printed ones:\n\n"
        .to_string();
    text += &zeros(origin);
    text += "**Unequal real zeros: possible causes.** Under eqs (3)-(4) the real zeros of a rigid vehicle are symmetric \
             (erratum 14); a beam makes them unequal by a thousandth. Changes that do give them, rigid body:\n\n";
    text += &unequal(origin);
    text + &format!(
        "The lift due to q is γ' = −{OUTPUT} q, a coefficient C_Lq of {}, which no vehicle has. Pitch \
         damping (M_q = {} 1/s) gives the zeros but wrong poles. The most likely cause is therefore a part of θ in \
         the output, intended or not. It is not modelled, as the paper does not mention it.\n\n",
        minus(format!("{:.0}", origin.lift_q)),
        printed(PITCH_DAMPING)
    )
    .replace("C_Lq", "C\\_Lq")
    .replace("M_q", "M\\_q")
}

fn rest(origin: &Origin) -> String {
    let printed_inertia: Vec<_> =
        origin.printed_inertia.iter().map(|case| value(case.poles[0])).collect();
    let mut text = format!(
        "**Rejected**\n\n* The printed inertia, 2.224·10⁵: the unstable poles are {}.\n",
        printed_inertia.join(", ")
    );
    text += "\nThe following were computed separately, not by this command:\n\n";
    for rejected in [
        "An inertia of 86,723 slug ft², usual in this family, with either mass: no jump.",
        "The thrust moment counted twice, as printed in eqs (3) and (4): (zero/pole)² of the rigid body is 3.22 \
         instead of the printed 3.82; counted once it is 3.77.",
        "Modal forces without the modal mass, or in other units: the unstable pole is at most 3.24.",
        "Aerodynamic forces from the slope at the tips only: 3.21 (even), 3.37 (slosh).",
        "Thrust independent of dynamic pressure: a phugoid of 0.041 rad/s, which is further off.",
    ] {
        text += &format!("* {}\n", escape(rejected));
    }
    text += "\n**Unexplained**\n\n";
    for open in [
        "The phugoid, 0.0238 rad/s, and its growth (erratum 13).",
        "The height pole, −2.49·10⁻⁴ (erratum 15).",
        "The unequal real zeros (erratum 14, and above).",
        "The mass centre of the beam near 64 ft, although its printed densities put it at 55 ft.",
        "The first frequency of the slosh column, which is higher with air and should be lower.",
    ] {
        text += &format!("* {open}\n");
    }
    text + "\n"
}

pub fn render(origin: &Origin) -> String {
    hypothesis() + &poles(origin) + &outputs(origin) + &rest(origin)
}
