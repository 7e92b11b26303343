//! The pages on identified and fitted numbers, as Markdown.

use super::fit_errors::FitErrors;
use super::markdown::{escape, percent, table, value};
use crate::identify::{Moved, TradeOff};

/// Which numbers of `xu2015` moved, and what more would have cost.
pub fn trade_off(of: &TradeOff) -> String {
    let (knee, end) = (&of.places[of.knee], &of.places[of.places.len() - 1]);
    let [poles, zeros] = of.best_errors;
    let elastic = of.numbers.iter().find(|number| number.key == "reference.elastic_scale");
    let mut text = format!(
        "## How xu2015 was found\n\n![Trade-off](figures/tradeoff.svg)\n\n\
         Each point is the vehicle with the least misfit + weight × distance. Misfit: sum over the cells \
         of (relative error / wanted accuracy)². Distance from parker2007: sum over the numbers of \
         (ln ratio / doubt)². The knee is the first sharpest bend, coming from the published numbers: \
         weight {}, distance {}, misfit {}. From there to the far end the misfit falls to {}, for {:.0} \
         times the distance. Along a dashed piece the compromise changes from one valley to another. Moves of less \
         than 1 % are put back, which gives the set: distance {}, misfit {}.\n\n\
         **What one inertia and free stations can do.** The second column of Tables 2 and 3 frees the inertia, the \
         mass centre of the beam, the stations of γ and of the elevator, structural damping and the size of \
         the elastic terms, and keeps every other coefficient published: misfit {}, at {} times the derived \
         elastic terms. Its short-period poles are {:.1} to {:.1} % off, the geometric means of the real \
         zeros {:.1} to {:.1} %. Where things sit:\n\n* xu2015: {}\n* free stations: {}\n\n**Moved numbers**\n\n",
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
        "moved by",
        "doubt",
        "standard error",
        "decided by the tables",
        "far end",
        "free stations",
        "1 % or 1 cm more moves most",
    ];
    let rows: Vec<_> = moved.iter().map(row).collect();
    text += &table(head, 1, &rows);
    text += "**Numbers that stay**\n\n";
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

/// A factor, or a difference with its sign and unit.
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

/// How well the curves of `shock_expansion` fit.
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
    text + "From `cargo ahv fit`, as its data file states it.\n\n"
}
