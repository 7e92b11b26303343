//! Text of the interaction sections of the report, with the computed numbers.

use super::interaction::{EMPTY, HYBRID, Interaction, Limit};
use super::markdown::{minus, percent};
use super::roots::Name;
use super::tables::COLUMNS;
use super::veering::Veering;

/// Relative distance of pole and zero below which a feedback loop hardly affects a mode.
const HIDDEN: f64 = 0.03;

fn share(part: f64) -> String {
    match part {
        ..0.001 => format!("{:.3} %", 100.0 * part),
        ..0.1 => format!("{:.1} %", 100.0 * part),
        _ => format!("{:.0} %", 100.0 * part),
    }
}

/// Three digits, for prose.
fn short(number: f64) -> String {
    let digits = (2.0 - libm::log10(number.abs()).floor()).clamp(0.0, 6.0) as usize;
    minus(format!("{number:.digits$}"))
}

/// Section on the structure without air.
pub fn structure(veering: &[Veering]) -> String {
    let mut text =
        "The frequency of the liquid is swept, without air. The frequencies of the two slosh modes \
                    rise with it until they reach the first flexible mode. There the modes veer: \
                    two of them exchange their shapes and their frequencies do not cross.\n\n"
            .to_string();
    for column in veering {
        let fuel = format!("{:.0} %", 100.0 * column.fuel);
        let change = column.change(3).last().copied().unwrap_or(0.0) / 100.0;
        let Some(exchange) = column.exchange else { continue };
        let [lower, middle, upper] = exchange.omega.map(|omega| format!("{omega:.1}"));
        text += &format!(
            "* **{fuel} fuel:** below {:.1} rad/s the lowest mode is mostly liquid, above it mostly \
             beam. There two hybrid modes, at {lower} and {upper} rad/s, have {} and {} of their \
             strain energy in the liquid: neither is \"the\" flexible mode. The mode between them, \
             at {middle} rad/s, remains a slosh mode ({}): its tanks move so that they hardly excite the \
             first bending shape. The frequency of the next flexible mode changes by {} over the sweep.\n",
            exchange.slosh_frequency,
            share(exchange.slosh[0]),
            share(exchange.slosh[2]),
            share(exchange.slosh[1]),
            percent(change)
        );
    }
    text + "\n"
}

fn limit<'a>(interaction: &'a Interaction, of: &str) -> Option<&'a Limit> {
    interaction.limits.iter().find(|limit| limit.of == of)
}

/// Section on the coupling with short period and zeros.
pub fn coupling(interaction: &Interaction) -> String {
    let moved = |kind, name| share(interaction.moved(0, kind, name));
    let mut text = format!(
        "**Slosh and short period.** In the unstable short-period mode {} of the kinetic energy is \
         elastic, and {} of that is in the liquid. Omitting the two slosh modes (11 states, the number in \
         the paper, instead of 15) changes the unstable pole by {}, the right-half-plane zero by {} and the \
         first aeroelastic pole by {}. ",
        share(interaction.short_period_elastic),
        share(interaction.short_period_slosh),
        moved("pole", Name::UnstableShortPeriod),
        moved("zero", Name::RightZero),
        moved("pole", Name::Flexible(0)),
    );
    text += &format!(
        "At a real pole s the body carries the fraction ω²/(s² + ω²) of a sloshing mass, which rises from \
         0 to 1 around ω = |s|, without a peak. A liquid slower than {} rad/s lags when the body turns; a \
         faster one moves with it and adds its inertia. The poles therefore move towards the axis fastest around \
         that frequency, which is near the 5 rad/s of the paper (claim (g)).\n\n",
        limit(interaction, COLUMNS[2]).map_or(String::new(), |limit| short(limit.pole))
    );
    let sum = |of: &str| interaction.zeros.iter().find(|zeros| zeros.of == of).map(|z| z.sum);
    if let (Some(even), Some(slosh)) = (sum(COLUMNS[1]), sum(COLUMNS[2])) {
        let largest = interaction.zeros.iter().max_by(|a, b| a.sum.abs().total_cmp(&b.sum.abs()));
        text += &format!(
            "**Asymmetry of the zeros.** The real zeros of the rigid body are exactly symmetric. Forces \
             that depend on rates (modal damping, tank dampers, air on the moving beam) make them \
             asymmetric: their sum is {} with even mass and {} with sloshing mass. ",
            short(even),
            short(slosh)
        );
        if let Some(largest) = largest {
            text += &format!("The largest sum is {} ({}). ", short(largest.sum), largest.of);
        }
        text += "The printed sums are −1.79, −1.80 and −2.11, the first for a rigid \
                 body: sloshing cannot be the cause.\n\n";
    }
    text
}

/// Section for the control designer.
pub fn designer(interaction: &Interaction, veering: &[Veering]) -> String {
    let mut text = String::new();
    if let (Some(rigid), Some(slosh)) =
        (limit(interaction, COLUMNS[0]), limit(interaction, COLUMNS[2]))
    {
        text += &format!(
            "* **The rigid body determines the usable bandwidth; slosh changes it slightly.** A loop must be \
             faster than the pole at {} and slower than the zero at {} rad/s. A single loop that \
             contains both has a sensitivity peak of at least (z + p)/(z − p) = {:.2}; for the rigid \
             body it is {:.2}. Two loops, on V and γ, can do better only if the directions of \
             pole and zero differ. Another control surface or another output moves the zero; feedback \
             does not.\n",
            short(slosh.pole),
            short(slosh.zero),
            slosh.peak,
            rigid.peak
        );
    }
    if let (Some(full), Some(empty)) = (limit(interaction, COLUMNS[2]), limit(interaction, EMPTY)) {
        text += &format!(
            "* **Everything changes with fuel.** From full to empty tanks the pole moves from {} to {}, the zero \
             from {} to {}, and the minimum peak from {:.2} to {:.2}. ",
            short(full.pole),
            short(empty.pole),
            short(full.zero),
            short(empty.zero),
            full.peak,
            empty.peak
        );
        if let (Some(from), Some(to)) = (full.flexible, empty.flexible) {
            text += &format!(
                "The first aeroelastic frequency rises from {from:.1} to {to:.1} rad/s: a notch must \
                 be scheduled with fuel, or be wide."
            );
        }
        text += "\n";
    }
    let mut slosh = interaction.dipoles.iter().filter(|d| matches!(d.name, Name::Slosh(_)));
    if let (Some(a), Some(b)) = (slosh.next(), slosh.next()) {
        let frequency = |[re, im]: [f64; 2]| libm::hypot(re, im);
        let [first, second] = [frequency(a.pole), frequency(b.pole)].map(short);
        let [near, far] = [a.apart, b.apart].map(share);
        text += &format!(
            "* **Controllability of the liquid.** With full tanks the slosh poles at {first} \
             and {second} rad/s are {near} and {far} of their frequency away from a zero. "
        );
        text += match f64::max(a.apart, b.apart) < HIDDEN {
            true => {
                "The loop from elevator and fuel to V and γ hardly affects the liquid, so eleven states \
                 are enough to design it. For the same reason it cannot damp the liquid: \
                 damping comes from baffles. Use the fifteen states to check \
                 margins and the limits on the liquid's motion.\n"
            }
            false => {
                "That is far enough for the loop to affect the liquid, for better or worse: design it \
                 with fifteen states.\n"
            }
        };
    }
    let mut exchanges: Vec<_> =
        veering.iter().filter_map(|column| Some(column.exchange?.slosh_frequency)).collect();
    exchanges.sort_by(f64::total_cmp);
    let exchanges: Vec<_> = exchanges.into_iter().map(|at| format!("{at:.0}")).collect();
    text += &format!(
        "* **Keep the sloshing frequency away from the bending frequency.** At {HYBRID} rad/s and half fuel the \
         first aeroelastic mode has {} of its elastic energy in the liquid, and its damping ratio \
         is {:.3} instead of {:.3} at 2 rad/s, because the tank damper also damps the beam. This is no \
         advantage: two modes respond instead of one, which is which depends on fuel, and the damping \
         depends on baffles. If the liquid sloshes near {} rad/s, design filters by mode \
         shape, not by mode number.\n",
        share(interaction.hybrid_share),
        interaction.hybrid_damping[1],
        interaction.hybrid_damping[0],
        if exchanges.is_empty() { format!("{HYBRID}") } else { exchanges.join(" to ") }
    );
    text += "* **Validity.** The numbers hold for one flight condition, small motions, linear \
             slosh with one mass per tank, and this coefficient set. Stiffness, tanks and elastic loads \
             are identified or derived (errata 16 and 17): trust directions and ratios more than digits.\n\n";
    text
}
