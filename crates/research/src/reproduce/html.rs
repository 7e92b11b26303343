//! The report as one self-contained HTML file.

use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd, TextMergeStream, html};

const STYLE: &str = include_str!("report.css");

/// Renders Markdown; `svg` gives the drawing of a link.
pub fn render(markdown: &str, title: &str, svg: impl Fn(&str) -> Option<String>) -> String {
    let mut contents = String::new();
    let mut events = Vec::new();
    let mut heading: Option<String> = None;
    let mut image = false;
    // A number and its per cent sign stay on one line.
    let markdown = &markdown.replace(" %", "\u{a0}%");
    // Escaped letters are separate events; merged, so that a verdict is one text.
    for event in TextMergeStream::new(Parser::new_ext(markdown, Options::ENABLE_TABLES)) {
        match event {
            Event::Start(Tag::Image { dest_url, .. }) => {
                image = true;
                let drawing = svg(&dest_url).unwrap_or_default();
                events.push(Event::InlineHtml(
                    format!("<span class=\"figure\" tabindex=\"0\">{drawing}").into(),
                ));
            }
            // The alternative text of a drawing repeats the title above it.
            Event::End(TagEnd::Image) => {
                image = false;
                events.push(Event::InlineHtml("</span>".into()));
            }
            _ if image => {}
            Event::Start(Tag::Heading { level, classes, attrs, .. }) => {
                heading = Some(String::new());
                let number = events.len();
                let id = Some(CowStr::from(format!("h{number}")));
                events.push(Event::Start(Tag::Heading { level, id, classes, attrs }));
            }
            Event::End(TagEnd::Heading(level)) => {
                if let Some(words) = heading.take() {
                    entry(&mut contents, level as usize, &words, &events);
                }
                events.push(Event::End(TagEnd::Heading(level)));
            }
            Event::Text(words) => {
                if let Some(heading) = &mut heading {
                    heading.push_str(&words);
                }
                match mark(&words) {
                    Some(class) => {
                        let mut span = format!("<span class=\"{class}\">");
                        escape(&mut span, &words);
                        span.push_str("</span>");
                        events.push(Event::InlineHtml(span.into()));
                    }
                    None => events.push(Event::Text(words)),
                }
            }
            other => events.push(other),
        }
    }
    let mut body = String::new();
    html::push_html(&mut body, events.into_iter());
    // Wide tables scroll by themselves instead of the page.
    let body = body
        .replace("<table>", "<div class=\"table\" tabindex=\"0\"><table>")
        .replace("</table>", "</table></div>")
        // A cell without words is no heading.
        .replace("<th style=\"text-align: left\"></th>", "<td></td>")
        .replace("<th style=\"text-align: right\"></th>", "<td></td>");
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <nav>\n{contents}</nav>\n<main>\n{body}</main>\n</body>\n</html>\n"
    )
}

/// A line of the table of contents; the heading is the last one pushed.
fn entry(contents: &mut String, level: usize, words: &str, events: &[Event]) {
    let heading = events.iter().rev().find_map(|event| match event {
        Event::Start(Tag::Heading { id: Some(id), .. }) => Some(id),
        _ => None,
    });
    if let (2, Some(id)) = (level, heading) {
        contents.push_str(&format!("<a href=\"#{id}\">"));
        escape(contents, words);
        contents.push_str("</a>\n");
    }
}

/// CSS class of a text that starts with the symbol of a verdict.
fn mark(words: &str) -> Option<&'static str> {
    match words.chars().next()? {
        '✓' => Some("yes"),
        '≈' | '◐' => Some("half"),
        '✗' => Some("no"),
        '∅' => Some("never"),
        _ => None,
    }
}

fn escape(text: &mut String, words: &str) {
    for letter in words.chars() {
        match letter {
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '&' => text.push_str("&amp;"),
            '"' => text.push_str("&quot;"),
            _ => text.push(letter),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::markdown::table;

    #[test]
    fn text_stays_text() {
        let rows = [["a|b <i> & *c* I_yy".to_string(), "✗ x < y".to_string()]];
        let page = render(&table(["", ""], 1, &rows), "t", |_| None);
        assert!(page.contains("a|b &lt;i&gt; &amp; *c* I_yy"), "{page}");
        assert!(page.contains("<span class=\"no\">✗ x &lt; y</span>"), "{page}");
    }

    #[test]
    fn drawings_are_inside_the_page() {
        let page = render("## A & B\n\n![A](figures/a.svg)\n", "t", |link| {
            Some(format!("<svg>{link}</svg>"))
        });
        assert!(page.contains("<svg>figures/a.svg</svg>") && !page.contains("<img"), "{page}");
        assert!(page.contains(">A &amp; B</a>"), "{page}");
    }
}
