//! The claims as Markdown.

use super::claims::{HARDLY, SLIGHT, Tested};
use super::markdown::{escape, percent, table, value};

pub fn render(claims: &[Tested]) -> String {
    let rows: Vec<[String; 4]> = claims
        .iter()
        .map(|claim| {
            [
                format!("({})", claim.id),
                claim.source.to_string(),
                claim.text.to_string(),
                claim.outcome.verdict.text(),
            ]
        })
        .collect();
    let mut text = table(["", "where", "claim", "verdict"], 3, &rows);
    for claim in claims {
        if let Some(note) = &claim.outcome.note {
            text += &format!("* ({}) {}\n", claim.id, escape(note));
        }
    }
    text += &format!(
        "\nOne rule serves all claims of a direction: it is reproduced if at every step of the way every root \
         that is meant stands on the claimed side of its start. By how much is said with the verdict, and \
         not judged: the paper prints no sizes. Where it has words for them, what changes by less than {:.0} % \
         changes \"little\" or \"hardly\", and \"slightly\" ends at {:.0} %.\n\n",
        100.0 * HARDLY,
        100.0 * SLIGHT
    );
    let rows: Vec<[String; 5]> = claims
        .iter()
        .flat_map(|claim| {
            claim.outcome.measures.iter().map(|measure| {
                [
                    format!("({})", claim.id),
                    value(measure.start),
                    value(measure.end),
                    percent(measure.change),
                    measure.what.clone(),
                ]
            })
        })
        .collect();
    text += "The numbers behind them:\n\n";
    text += &table(["", "start", "end", "change", "what"], 1, &rows);
    text
}
