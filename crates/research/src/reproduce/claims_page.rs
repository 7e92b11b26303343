//! The section on the claims, as Markdown.

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
        "\nOne rule serves all claims of a direction: a claim is reproduced if, at every step of the sweep, every \
         root concerned is on the claimed side of its start. The verdict states the size of the change but does \
         not judge it, as the paper prints no sizes. Where the paper describes a size in words, \"little\" and \
         \"hardly\" mean less than {:.0} %, and \"slightly\" at most {:.0} %.\n\n",
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
    text += "The numbers:\n\n";
    text += &table(["", "start", "end", "change", "what"], 1, &rows);
    text
}
