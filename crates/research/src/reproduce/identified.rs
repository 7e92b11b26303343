//! The sections on identified and fitted numbers, as Markdown.

use super::fit_errors::FitErrors;
use super::markdown::{escape, percent, table, value};
use crate::identify::{Moved, TradeOff};

/// Section on the identification of `xu2015`.
pub fn trade_off(of: &TradeOff) -> String {
    let (knee, end) = (&of.places[of.knee], &of.places[of.places.len() - 1]);
    let [poles, zeros] = of.best_errors;
    let elastic = of.numbers.iter().find(|number| number.key == "reference.elastic_scale");
    let mut text = format!(
        "## Identification of xu2015\n\n![Trade-off](figures/tradeoff.svg)\n\n\
         Each point minimises misfit + weight × distance. Misfit: sum over the cells \
         of (relative error / wanted accuracy)². Distance from parker2007: sum over the numbers of \
         (ln ratio / prior standard deviation)². The knee is the first local maximum of curvature, starting from the \
         published numbers: weight {}, distance {}, misfit {}. At the far end the misfit is {}, at {:.0} \
         times the distance. Dashed lines connect different local minima. Numbers that change by less \
         than 1 % are reset to the published ones, which gives the set: distance {}, misfit {}.\n\n\
         **Best fit with one inertia and free stations.** The second column of Tables 2 and 3 fits the inertia, the \
         mass centre of the beam, the stations of γ and of the elevator, structural damping and the size of \
         the elastic terms; all other coefficients are published: misfit {}, with {} times the derived \
         elastic terms. The errors of its short-period poles are {:.1} to {:.1} %, of the geometric means of the real \
         zeros {:.1} to {:.1} %. Stations:\n\n* xu2015: {}\n* free stations: {}\n\n**Changed numbers**\n\n",
        value(knee.weight),
        value(knee.distance),
        value(knee.misfit),
        value(end.misfit),
        end.distance / knee.distance,
        value(of.chosen.distance),
        value(of.chosen.misfit),
        value(of.best.misfit),
        elastic.map_or("", |number| &number.best_moved_by),
        100.0 * poles[0],
        100.0 * poles[1],
        100.0 * zeros[0],
        100.0 * zeros[1],
        escape(&of.stations.text()),
        escape(&of.best_stations.text()),
    );
    let (moved, still): (Vec<_>, Vec<_>) =
        of.numbers.iter().partition(|number| number.identified != number.published);
    let row = |number: &&Moved| {
        [
            number.key.to_string(),
            value(number.published),
            value(number.identified),
            by_how_much(number, &number.moved_by),
            within(number, number.doubt),
            within(number, number.error),
            format!("{:.0} %", 100.0 * number.decided_by_data),
            by_how_much(number, &number.far_moved_by),
            by_how_much(number, &number.best_moved_by),
            format!("{} by {}", number.strongest, percent(0.01 * number.slope)),
        ]
    };
    let head = [
        "",
        "parker2007",
        "xu2015",
        "change",
        "prior standard deviation",
        "standard error",
        "determined by the tables",
        "far end",
        "free stations",
        "most sensitive cell, per 1 % or 1 cm",
    ];
    let rows: Vec<_> = moved.iter().map(row).collect();
    text += &table(head, 1, &rows);
    text += "**Unchanged numbers**\n\n";
    let rows: Vec<[String; 6]> = still
        .iter()
        .map(|number| {
            let [key, published, _, _, _, _, decided, far, best, strongest] = row(number);
            [key, published, decided, far, best, strongest]
        })
        .collect();
    let head = [head[0], head[1], head[6], head[7], head[8], head[9]];
    text += &table(head, 1, &rows);
    text + "Doubt: the factor, or the difference, that costs 1. Standard errors are formal: they take the wanted \
            accuracies for errors of the tables and the norm for what is known beforehand, and no \
            vehicle under eqs (3)-(4) meets the tables that closely. What the tables do not decide is \
            the published number.\n\n"
}

/// A factor, or a difference with sign and unit.
fn by_how_much(number: &Moved, by: &str) -> String {
    match (number.difference, by.strip_prefix('-')) {
        (false, _) => format!("× {by}"),
        (true, Some(size)) => format!("\u{2212}{size} m"),
        (true, None) => format!("+{by} m"),
    }
}

fn within(number: &Moved, size: f64) -> String {
    if number.difference { format!("± {size:.2} m") } else { format!("×/÷ {size:.3}") }
}

/// Section on the errors of the fit `shock_expansion`.
pub fn fit(fit: &FitErrors) -> String {
    let mut text = format!(
        "## How well the curves of shock\\_expansion fit\n\n{} In brackets: per cent of the range of \
         values.\n\n",
        escape(&fit.samples)
    );
    let [a, b, c, d] = std::array::from_fn(|i| fit.coefficients.get(i).map_or("", String::as_str));
    let rows: Vec<[String; 7]> = fit
        .rows
        .iter()
        .map(|row| {
            let shares = fit.percent(row).filter(|_| !row.what.starts_with("range"));
            let cell = |i: usize| {
                let number = row.values.get(i).map_or(String::new(), |v| format!("{v:.5}"));
                let share = shares.as_ref().and_then(|shares| shares.get(i));
                share.map_or(number.clone(), |share| format!("{number} ({share:.1})"))
            };
            let [points, choked] = [row.points, row.choked].map(|count| count.to_string());
            [row.what.clone(), points, choked, cell(0), cell(1), cell(2), cell(3)]
        })
        .collect();
    text += &table(["", "points", "choked", a, b, c, d], 0, &rows);
    text + "From `cargo ahv fit`, as stated in its data file.\n\n"
}
