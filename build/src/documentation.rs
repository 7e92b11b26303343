//! Writes an FMU's documentation: what the model's page says, around the table of its variables.

mod variables;

use crate::models::Content;
use anyhow::Result;
use fmi_model::standard::Standard;
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use variables::Described;

/// On a narrow screen each variable is a paragraph: name, meaning, then the other columns.
const STYLE: &str = "\
body{font:16px/1.5 sans-serif;color:#1a1a1a;background:#fff;max-width:60em;margin:2em auto;padding:0 1em;\
overflow-wrap:break-word}img{max-width:100%}a{padding:.3em 0;color:#0054a6}\
pre{overflow-x:auto}.figure{display:block;overflow-x:auto}.figure svg{min-width:560px}.figure math{min-width:max-content}\
.table{overflow-x:auto}table{border-collapse:collapse;font-size:14px}\
th,td{border:1px solid #bbb;padding:.2em .5em;text-align:left;vertical-align:top}th{background:#eee}\
td.n{text-align:right}td:last-child{min-width:18em}\
@media(max-width:44em){thead{display:none}table,tbody{display:block}\
tr{display:flex;flex-wrap:wrap;column-gap:.9em;padding:.6em 0;border-bottom:1px solid #bbb}\
td,td.n{order:2;border:0;padding:0;color:#555;text-align:left}td:empty{display:none}\
td:nth-child(2),td:last-child{order:1;flex-basis:100%;min-width:0;color:inherit}\
td:nth-child(2){font-size:16px;font-weight:bold}\
td:nth-child(1)::before{content:'ref. '}td:nth-child(4)::before{content:'unit '}\
td:nth-child(5)::before{content:'start '}}";

/// What the page says of FMI 2.0, and of FMI 3.0.
const FMI3: [(&str, &str); 3] = [
    ("fmi2SetDebugLogging", "fmi3SetDebugLogging"),
    ("ends early with fmi2Discard", "ends early with terminateSimulation"),
    (
        "follow the derivatives (orders 1 to 3) that\nthe master sets for the step",
        "move linearly to where\nthe master says that they will be at its end",
    ),
];

/// What a page says besides the variables, as XHTML.
pub struct Page {
    /// What the model is, a sentence, if the model description does not say it.
    pub about: Option<&'static str>,
    /// Paragraphs below the title.
    pub summary: String,
    /// Headings and paragraphs above the table of variables.
    pub sections: String,
    /// The same below it.
    pub closing: String,
}

/// The page, as valid XHTML; `machines` are the packaged platforms. The same sources give the same bytes.
pub fn html(content: &Content, standard: Standard, machines: &[String]) -> Result<String> {
    let Page { about, summary, sections, closing } = &content.page;
    let described = Described::parse(content.xml(Standard::Fmi3))?;
    let rows = described.rows()?;
    let same = if machines.len() > 1 {
        " All compute the same bits, and a serialised state of one can be restored on another."
    } else {
        ""
    };
    let machines = format!("<p>It runs on {}.{same}</p>", machines.join(" and on "));
    let [identifier, version, license, guid] =
        ["modelName", "version", "license", "instantiationToken"]
            .map(|key| described.of_model(key));
    let (identifier, version, license, guid) = (identifier?, version?, license?, guid?);
    let about = match about {
        Some(about) => about.to_string(),
        None => format!("{}.", described.of_model("description")?),
    };
    let interfaces = described.interfaces();
    let fmi = match standard {
        Standard::Fmi2 => "2.0",
        Standard::Fmi3 => "3.0",
    };
    let page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"/>\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\
         <title>{identifier} {version}</title><style>{STYLE}</style></head>\n<body>\n<main>\n\
         <h1>{identifier} {version}</h1>\n\
         <p>{about} FMI {fmi} for {interfaces}. Model {guid}.</p>\n\
         {summary}\n{machines}\n\
         {sections}\n\
         <h2 id=\"variables\">Variables</h2>\n\
         <div class=\"table\" tabindex=\"0\"><table>\n<thead><tr><th>ref.</th><th>name</th><th>kind</th><th>unit</th>\
         <th>start</th><th>range</th><th>meaning</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n\
         {closing}\
         <h2>Licences</h2>\n<p>{license}. The texts, and those of the libraries inside the binary, are in \
         <a href=\"licenses/\">licenses</a>.</p>\n</main>\n</body>\n</html>\n",
    );
    Ok(match standard {
        Standard::Fmi2 => page,
        Standard::Fmi3 => FMI3.iter().fold(page, |page, (two, three)| page.replace(two, three)),
    })
}

/// A text in Markdown as XHTML; of a link into the repository its text remains.
pub fn html_of(markdown: &str) -> String {
    let mut is_inside = false;
    let events = Parser::new_ext(markdown, Options::ENABLE_TABLES).filter(|event| match event {
        Event::Start(Tag::Link { dest_url, .. }) => {
            is_inside = !dest_url.contains(':');
            !is_inside
        }
        Event::End(TagEnd::Link) => !std::mem::take(&mut is_inside),
        _ => true,
    });
    let mut page = String::new();
    pulldown_cmark::html::push_html(&mut page, events);
    page
}

/// A number without the rounding errors of unit conversion.
pub fn plain(value: f64) -> String {
    const DIGITS: f64 = 1e9;
    ((value * DIGITS).round() / DIGITS).to_string()
}

#[cfg(test)]
mod tests {
    use crate::model_description::ModelDescription;
    use crate::models::MODELS;
    use fmi_model::standard::Standard;

    #[test]
    fn a_link_into_the_repository_is_its_text_and_a_table_is_one() {
        let text = "[a](../b.md) [c](https://d.e)\n\n| f |\n|---|\n| g |\n";
        let page = super::html_of(text);
        assert!(page.starts_with("<p>a <a href=\"https://d.e\">c</a></p>"), "{page}");
        assert!(page.contains("<td>g</td>"), "{page}");
    }

    #[test]
    fn page_is_well_formed_and_names_every_variable() {
        for model in MODELS {
            let content = (model.content)().unwrap();
            let page = super::html(&content, Standard::Fmi3, &["Linux".to_string()]).unwrap();
            let mut reader = quick_xml::Reader::from_str(&page);
            while !matches!(reader.read_event().unwrap(), quick_xml::events::Event::Eof) {}
            for variable in
                ModelDescription::parse(content.xml(Standard::Fmi2)).unwrap().variables()
            {
                let name = &variable.name;
                assert!(page.contains(&format!("<code>{name}</code>")), "{name}");
            }
        }
    }
}
