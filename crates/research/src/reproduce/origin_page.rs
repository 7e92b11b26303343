//! Where the printed digits come from, as Markdown.

use super::markdown::{escape, minus, percent, printed, table, value};
use super::origin::{Asked, Case, OUTPUT, Origin, PITCH_DAMPING};
use crate::identify::size;

const FOOT: f64 = 0.3048;

fn pair([right, left]: [f64; 2]) -> String {
    format!("{}, {}", value(right), value(left))
}

/// Poles, zeros and what each of them says of the vehicle.
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
     6.4·10⁵ kg m²/m, which is printed nowhere. The beam has its mass centre 8 to 11 ft further aft than the \
     rigid body and the printed densities have it. γ of Table 3 belongs to a point of the beam near \
     that mass centre, not to the mean axes of eq. (3). No source says so: this is inferred from the digits. \
     Every number below is computed by this command with the published coefficients, unless it says \
     otherwise.\n\n"
        .into()
}

fn poles(origin: &Origin) -> String {
    let [rigid, even, slosh] = &origin.printed;
    let off = |i: usize| percent(origin.rigid.poles[i] / rigid.poles[i] - 1.0);
    let mut text = format!(
        "**Evidence: the rigid column.** It is the published set at 55 ft with that inertia: the short-period \
         poles are {} and {} off, the geometric mean of the real zeros {}.\n\n",
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
    text += "*Another inertia* scales both products alike, so it is not that (rigid body):\n\n";
    text += &cases("inertia", &origin.inertias);
    text += &format!(
        "*Elastic terms* up to 20 times those derived do not do it. The unstable pole of the even column comes to {} at most, \
         printed is {}; and the printed frequencies of that column are those of Table 1, without air, to \
         every digit there:\n\n",
        value(peak(&origin.elastic)),
        value(even.poles[0])
    );
    let row = |case: &Case| [case.what.clone(), pair(case.poles), value(case.pole_product())];
    let rows: Vec<_> = origin.elastic.iter().map(row).collect();
    text += &table(["elastic terms", "short period", "product"], 0, &rows);
    text += "*A mass centre further aft* does: it lengthens the arm of the normal force. The zeros hardly \
             notice: where γ is held the normal force rests, and what turns the vehicle is a couple, the same \
             about every point (even mass):\n\n";
    text += &cases("mass centre aft by", &origin.shifts);
    text += "Inertia and mass centre that each column asks for, by its two products alone:\n\n";
    text + &asked(&origin.asked)
}

fn outputs(origin: &Origin) -> String {
    let mut text = "**Evidence: the zeros are those of the body.** Even column of xu2015. With γ of the mean axes \
                    each pair of zeros stays near its pole; read on the body, near the mass centre, where the \
                    paper fixes its beam, the pairs move up by most of the way to the printed ones:\n\n"
        .to_string();
    text += &zeros(origin);
    text += "**Unequal real zeros: what would give them.** No vehicle under eqs (3)-(4) has them without a beam \
             (erratum 14); with one, the pair is unequal by a thousandth. What does give them, rigid body:\n\n";
    text += &unequal(origin);
    text + &format!(
        "The lift by q is γ' = −{OUTPUT} q, a coefficient C_Lq of {}, which no vehicle has. Pitch \
         damping (M_q = {} 1/s) gives the zeros and spoils the poles. So a part of θ in the output, by \
         intent or by mistake, is the least unlikely. It is not modelled: nothing printed says it.\n\n",
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
        "**Rejected**\n\n* The printed inertia, 2.224·10⁵: unstable poles of {}.\n",
        printed_inertia.join(", ")
    );
    text += "\nThe following were computed separately, not by this command:\n\n";
    for rejected in [
        "The inertia of 86,723 slug ft² that is usual in this family, with either mass: no jump.",
        "The thrust moment counted twice, as eqs (3) and (4) print it: (zero/pole)² of the rigid body becomes 3.22; \
         printed is 3.82, counted once gives 3.77.",
        "Modal forces without the modal mass, or in other units: the unstable pole peaks at 3.24.",
        "Air that answers to the slope at the tips only: 3.21 (even), 3.37 (slosh).",
        "Thrust that does not go with dynamic pressure: a phugoid of 0.041 rad/s, further off.",
    ] {
        text += &format!("* {}\n", escape(rejected));
    }
    text += "\n**Unexplained**\n\n";
    for open in [
        "The phugoid, 0.0238 rad/s, and its growth (erratum 13).",
        "The height pole, −2.49·10⁻⁴ (erratum 15).",
        "The unequal real zeros (erratum 14, and above).",
        "Why the mass centre of the beam should lie near 64 ft, when its printed densities put it at 55 ft.",
        "The first frequency of the slosh column, which rises with air and should fall.",
    ] {
        text += &format!("* {open}\n");
    }
    text + "\n"
}

pub fn render(origin: &Origin) -> String {
    hypothesis() + &poles(origin) + &outputs(origin) + &rest(origin)
}
