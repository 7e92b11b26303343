//! The report as Markdown (CommonMark with tables).

use super::report::{ERRATA, Figure, PAPER, Report, SetReport, count};
use super::tables::{COLUMNS, Cell, REASONS, Table};
use super::verdict::{Aim, NEAR, RANKS, difference};
use super::{claims_page, identified, interaction::Interaction, interaction_text, origin_page};
use ahv_tool::table::number;

/// The second column of Tables 2 and 3.
const BEST: &str = "one inertia, free stations";

/// Escapes text, so that nothing in it becomes emphasis, a cell or HTML.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        if matches!(letter, '\\' | '|' | '*' | '_' | '<' | '>' | '[' | ']' | '`' | '&' | '~') {
            escaped.push('\\');
        }
        escaped.push(letter);
    }
    escaped
}

/// A table; the cells are escaped here. Columns between the first and the last `words` are numbers, aligned
/// to the right.
pub fn table<const N: usize>(head: [&str; N], words: usize, rows: &[[String; N]]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let mut text = line(&head.map(escape));
    let rule: [String; N] = std::array::from_fn(|column| {
        let left = column == 0 || column + words >= N;
        if left { ":---" } else { "---:" }.to_string()
    });
    text += &line(&rule);
    for row in rows {
        text += &line(&row.each_ref().map(|cell| escape(cell)));
    }
    text + "\n"
}

/// Replaces hyphens of a number by minus signs.
pub fn minus(text: String) -> String {
    text.replace("e-", "e\u{2212}").replacen('-', "\u{2212}", usize::from(text.starts_with('-')))
}

/// A number of ours.
pub fn value(value: f64) -> String {
    minus(number(value))
}

/// A number as the paper prints it.
pub fn printed(value: f64) -> String {
    minus(if value != 0.0 && value.abs() < 1e-3 {
        format!("{value:.3e}")
    } else {
        value.to_string()
    })
}

/// A relative change.
pub fn percent(change: f64) -> String {
    let percent = 100.0 * change;
    let digits = match percent.abs() {
        100.0.. => 0,
        1.0.. => 1,
        _ => 2,
    };
    let text = format!("{percent:+.digits$}");
    // A number that rounds to zero has no sign.
    let zero = !text.contains(|c| matches!(c, '1'..='9'));
    let text = if zero { text.replace(['+', '-'], "") } else { text };
    text.replace('-', "\u{2212}") + " %"
}

pub fn complex([re, im]: [f64; 2]) -> String {
    if im == 0.0 { value(re) } else { format!("{} ± {}i", value(re), value(im)) }
}

pub fn render(report: &Report) -> String {
    let mut text = format!("# The paper's results compared with ours\n\n{}\n\n", escape(PAPER));
    text += &format!(
        "Computed by ahv {}. Values are in rad/s unless stated otherwise; quantities are per metre of \
         vehicle width. Difference is ours/paper \u{2212} 1: positive if ours is larger in size.\n\n",
        report.version
    );
    text += &summary(report);
    if let Some(table) = &report.table1 {
        text += "## Table 1\n\nNatural frequencies do not depend on the coefficient set.\n\n";
        text += &cells(table);
    }
    text += &figures(&report.figures);
    for set in &report.sets {
        text += &set_report(set, report.sets.len() > 1);
    }
    if !report.veering.is_empty() {
        text += "## Veering of slosh and bending modes\n\n![Veering](figures/veering.svg)\n\n";
        text += &interaction_text::structure(&report.veering);
    }
    for set in &report.sets {
        if let Some(interaction) = &set.interaction {
            text += &interaction_page(set.name, interaction, report);
        }
    }
    if let Some(origin) = &report.origin {
        text += &origin_page::render(origin);
    }
    if let Some(trade_off) = &report.trade_off {
        text += &identified::trade_off(trade_off);
    }
    if let Some(fit) = &report.fit {
        text += &identified::fit(fit);
    }
    if report.errata.is_some() {
        text += &errata();
    }
    text
}

/// Section with the number of each verdict.
fn summary(report: &Report) -> String {
    let row = |name: String, counts: [usize; RANKS.len()]| -> [String; 1 + RANKS.len()] {
        let mut cells = vec![name];
        cells.extend(counts.map(|count| count.to_string()));
        cells.try_into().unwrap_or_default()
    };
    let cells = |table: &Table| count(table.cells.iter().map(|cell| &cell.verdict));
    let mut rows = Vec::new();
    if let Some(table) = &report.table1 {
        rows.push(row("Table 1".into(), cells(table)));
    }
    for set in &report.sets {
        for table in &set.tables {
            rows.push(row(format!("Table {}, {}", table.number, set.name), cells(table)));
        }
        if !set.claims.is_empty() {
            let counts = count(set.claims.iter().map(|claim| &claim.outcome.verdict));
            rows.push(row(format!("Claims of figs 6 to 8, {}", set.name), counts));
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    let [a, b, c, d, e] = RANKS;
    let aims: Vec<_> =
        Aim::ALL.iter().map(|aim| format!("{} {} %", aim.of_what(), aim.percent())).collect();
    format!(
        "## Verdicts\n\n{}A number is reproduced if it is within the limit of its kind: {}. It is near within \
         {NEAR} times that limit; beyond, at most its sign is right. The limits are the same for \
         every coefficient set, cell and column. \"Not by eqs (3)-(4)\" means that no vehicle under these \
         equations has the number, as an erratum derives and a test proves.\n\n",
        table(["", a, b, c, d, e], 0, &rows),
        aims.join(", ")
    )
}

fn cells(of: &Table) -> String {
    let mut text = String::new();
    for column in COLUMNS {
        let cells: Vec<_> = of.cells.iter().filter(|cell| cell.column == column).collect();
        if !cells.is_empty() {
            text += &format!("**{column}**\n\n{}", rows(&cells));
        }
    }
    if !of.means.is_empty() {
        let means: Vec<_> = of.means.iter().collect();
        text += &format!("**Geometric mean of the real zeros (erratum 14)**\n\n{}", rows(&means));
    }
    if !of.unprinted.is_empty() {
        let list: Vec<_> = of
            .unprinted
            .iter()
            .map(|root| format!("{} {}", root.row, complex([root.re, root.im])))
            .collect();
        text += &format!("Not in the paper, sloshing mass: {}.\n\n", list.join("; "));
    }
    text
}

fn rows(cells: &[&Cell]) -> String {
    let common = |cell: &Cell| {
        let ours = cell.ours.map_or("none".into(), value);
        let off = cell.difference.map_or(String::new(), percent);
        [cell.row.clone(), printed(cell.paper), ours, off, cell.verdict.text()]
    };
    if cells.iter().all(|cell| cell.best.is_none()) {
        let rows: Vec<_> = cells.iter().map(|cell| common(cell)).collect();
        return table(["", "paper", "ours", "difference", "verdict"], 1, &rows);
    }
    let head = ["", "paper", "ours", "difference", BEST, "difference", "verdict"];
    let with_best = |cell: &&Cell| {
        let best = cell.best.map_or("none".into(), value);
        let off = cell.best.and_then(|best| difference(cell.paper, best));
        let [row, paper, ours, ours_off, verdict] = common(cell);
        [row, paper, ours, ours_off, best, off.map_or(String::new(), percent), verdict]
    };
    table(head, 1, &cells.iter().map(with_best).collect::<Vec<_>>())
}

/// Explains the reasons that the verdicts give in two words.
fn reasons(tables: &[Table]) -> String {
    let mut text = "**Reasons**\n\n".to_string();
    for (short, long) in REASONS {
        let given = |cell: &Cell| cell.verdict.because() == Some(short);
        if tables.iter().flat_map(|table| table.cells.iter().chain(&table.means)).any(given) {
            text += &format!("* *{}:* {}\n", escape(short), escape(long));
        }
    }
    text + "\n"
}

fn figures(figures: &[Figure]) -> String {
    let mut text = String::new();
    for figure in figures {
        text += &format!(
            "## {}\n\n![{}](figures/{}.svg)\n\n{}\n\n",
            figure.title,
            escape(&figure.title),
            figure.file,
            escape(&figure.caption)
        );
    }
    text
}

fn set_report(set: &SetReport, many: bool) -> String {
    let mut text = String::new();
    let about = if many { format!(" ({})", set.name) } else { String::new() };
    if !(set.tables.is_empty() && set.claims.is_empty() && set.figures.is_empty()) {
        text +=
            &format!("## Coefficient set {}\n\n{}.\n\n", escape(set.name), escape(set.description));
    }
    for table in &set.tables {
        text += &format!("## Table {}{about}\n\n{}\n\n", table.number, escape(table.title));
        text += &cells(table);
    }
    if !set.tables.is_empty() {
        text += &reasons(&set.tables);
    }
    text += &figures(&set.figures);
    if !set.claims.is_empty() {
        text += &format!("## Claims of figs 6 to 8{about}\n\n");
        text += &claims_page::render(&set.claims);
    }
    text
}

fn interaction_page(name: &str, interaction: &Interaction, report: &Report) -> String {
    let mut text = format!("## Interaction of slosh, beam and short period: {}\n\n", escape(name));
    text += &interaction_text::coupling(interaction);
    for order in &interaction.orders {
        let rows: Vec<[String; 5]> = order
            .roots
            .iter()
            .map(|root| {
                [
                    root.name.to_string(),
                    root.kind.to_string(),
                    complex(root.kept),
                    root.dropped.map_or("none".into(), complex),
                    root.moved.map_or(String::new(), |moved| format!("{:.2} %", 100.0 * moved)),
                ]
            })
            .collect();
        text += &format!("**With slosh modes (15 states) and without (11): {}**\n\n", order.title);
        text += &table(["", "", "15 states", "11 states", "change"], 0, &rows);
    }
    text += "**Real zeros**\n\n";
    let rows: Vec<[String; 4]> = interaction
        .zeros
        .iter()
        .map(|zeros| [zeros.of.clone(), value(zeros.right), value(zeros.left), value(zeros.sum)])
        .collect();
    text += &table(["", "right", "left", "sum"], 0, &rows);
    text += "**What a control designer should take from it**\n\n";
    text += &interaction_text::designer(interaction, &report.veering);
    text
}

/// The errata, headings one level lower.
fn errata() -> String {
    ERRATA
        .lines()
        .map(|line| if line.starts_with('#') { format!("#{line}\n") } else { format!("{line}\n") })
        .collect()
}
