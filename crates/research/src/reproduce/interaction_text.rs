//! The text about the interaction, written around the computed numbers.

use super::interaction::{EMPTY, HYBRID, Interaction, Limit};
use super::markdown::{minus, percent};
use super::roots::Name;
use super::tables::COLUMNS;
use super::veering::Veering;

/// Pole and zero closer than this, against the frequency, hide a mode from a loop.
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

/// What the structure alone does.
pub fn structure(veering: &[Veering]) -> String {
    let mut text =
        "The liquid's own frequency is swept; air plays no part. The two slosh modes climb \
                    with it until they reach the first flexible mode. There nothing crosses: two \
                    modes exchange their nature and keep apart.\n\n"
            .to_string();
    for column in veering {
        let fuel = format!("{:.0} %", 100.0 * column.fuel);
        let change = column.change(3).last().copied().unwrap_or(0.0) / 100.0;
        let Some(exchange) = column.exchange else { continue };
        let [lower, middle, upper] = exchange.omega.map(|omega| format!("{omega:.1}"));
        text += &format!(
            "* **{fuel} fuel:** below {:.1} rad/s the lowest mode is mostly liquid, above it mostly \
             beam. There the two hybrids, at {lower} and {upper} rad/s, hold {} and {} of their \
             strain energy in the liquid: neither is \"the\" flexible mode. The mode between them, \
             at {middle} rad/s, stays liquid ({}): in it the tanks move so that the beam's first \
             shape is hardly driven. The next flexible mode changes by {} over the whole sweep.\n",
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

/// What the air adds: short period and zeros.
pub fn coupling(interaction: &Interaction) -> String {
    let moved = |kind, name| share(interaction.moved(0, kind, name));
    let mut text = format!(
        "**Slosh and short period.** In the unstable short-period motion {} of the kinetic energy is \
         elastic, and {} of that is in the liquid. Dropping the two slosh modes (11 states, as the \
         paper counts, instead of 15) moves the unstable pole by {}, the right zero by {} and the \
         first aeroelastic pole by {}. ",
        share(interaction.short_period_elastic),
        share(interaction.short_period_slosh),
        moved("pole", Name::UnstableShortPeriod),
        moved("zero", Name::RightZero),
        moved("pole", Name::Flexible(0)),
    );
    text += &format!(
        "The short-period poles are real: s takes the part ω²/(s² + ω²) of a sloshing mass along, which rises from \
         0 to 1 around ω = |s|, without a peak. A liquid slower than {} rad/s stays behind when the body turns; a \
         faster one goes with it and adds its inertia. So the poles move towards the axis most around \
         that frequency, which is near the 5 rad/s of the paper (claim (g)).\n\n",
        limit(interaction, COLUMNS[2]).map_or(String::new(), |limit| short(limit.pole))
    );
    let sum = |of: &str| interaction.zeros.iter().find(|zeros| zeros.of == of).map(|z| z.sum);
    if let (Some(even), Some(slosh)) = (sum(COLUMNS[1]), sum(COLUMNS[2])) {
        let largest = interaction.zeros.iter().max_by(|a, b| a.sum.abs().total_cmp(&b.sum.abs()));
        text += &format!(
            "**Asymmetry of the zeros.** The real zeros of a rigid body are exactly ±. What answers \
             to rates (modal damping, dampers in the tanks, air on a beam that moves) breaks that: \
             their sum is {} with even mass and {} with sloshing mass. ",
            short(even),
            short(slosh)
        );
        if let Some(largest) = largest {
            text += &format!("The largest here is {} ({}). ", short(largest.sum), largest.of);
        }
        text += "The paper prints sums of −1.79, −1.80 and −2.11, the first of them for a rigid \
                 body: sloshing cannot be their cause.\n\n";
    }
    text
}

/// Half a page for whoever closes the loop.
pub fn designer(interaction: &Interaction, veering: &[Veering]) -> String {
    let mut text = String::new();
    if let (Some(rigid), Some(slosh)) =
        (limit(interaction, COLUMNS[0]), limit(interaction, COLUMNS[2]))
    {
        text += &format!(
            "* **The window is set by the rigid body, and slosh moves its frames.** A loop has to be \
             faster than the pole at {} and slower than the zero at {} rad/s. A single loop that \
             contains both has a sensitivity peak of at least (z + p)/(z − p) = {:.2}; for the rigid \
             body it is {:.2}. Two loops, on V and γ, can do better only as far as the directions of \
             pole and zero differ. Another control surface or another output moves the zero; a \
             controller does not.\n",
            short(slosh.pole),
            short(slosh.zero),
            slosh.peak,
            rigid.peak
        );
    }
    if let (Some(full), Some(empty)) = (limit(interaction, COLUMNS[2]), limit(interaction, EMPTY)) {
        text += &format!(
            "* **Fuel moves everything.** From full to empty the pole goes from {} to {}, the zero \
             from {} to {}, and the least peak from {:.2} to {:.2}. ",
            short(full.pole),
            short(empty.pole),
            short(full.zero),
            short(empty.zero),
            full.peak,
            empty.peak
        );
        if let (Some(from), Some(to)) = (full.flexible, empty.flexible) {
            text += &format!(
                "The first aeroelastic frequency goes from {from:.1} to {to:.1} rad/s: a notch has to \
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
            "* **How much of the liquid the loop sees.** With full tanks the slosh poles at {first} \
             and {second} rad/s stand {near} and {far} of their frequency from a zero. "
        );
        text += match f64::max(a.apart, b.apart) < HIDDEN {
            true => {
                "So elevator and fuel barely move the liquid as seen from V and γ, and eleven states \
                 serve to shape the loop. But a loop that cannot move the liquid cannot damp it \
                 either: its damping comes from baffles. Keep the fifteen states for the check of \
                 margins and for limits on the liquid's motion.\n"
            }
            false => {
                "That is far enough for the loop to move the liquid, for better or worse: shape it \
                 on fifteen states.\n"
            }
        };
    }
    let mut exchanges: Vec<_> =
        veering.iter().filter_map(|column| Some(column.exchange?.slosh_frequency)).collect();
    exchanges.sort_by(f64::total_cmp);
    let exchanges: Vec<_> = exchanges.into_iter().map(|at| format!("{at:.0}")).collect();
    text += &format!(
        "* **Keep the liquid's frequency away from the beam's.** At {HYBRID} rad/s and half fuel the \
         first aeroelastic pole carries {} of its elastic energy in the liquid and its damping ratio \
         is {:.3} instead of {:.3} at 2 rad/s: the tank's damper works for the beam. That is no \
         bargain. Two modes now answer where one did, their names depend on fuel, and the damping \
         rests on baffles. Tanks whose liquid sloshes near {} rad/s call for filters placed by mode \
         shape, not by number.\n",
        share(interaction.hybrid_share),
        interaction.hybrid_damping[1],
        interaction.hybrid_damping[0],
        if exchanges.is_empty() { format!("{HYBRID}") } else { exchanges.join(" to ") }
    );
    text += "* **What these numbers are not.** They are of one flight condition, small motions, linear \
             slosh with one mass per tank and this coefficient set. Stiffness, tanks and elastic loads \
             are identified or derived (errata 16 and 17): trust directions and ratios before digits.\n\n";
    text
}
