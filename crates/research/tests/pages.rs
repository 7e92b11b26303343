//! The HTML pages, report and documentation of the FMU, are readable on a phone 400 px wide, as far as this can be
//! tested without a browser.

use fmi_model::standard::Standard;
use std::fs;
use std::process::Command;
use std::sync::LazyLock;
use tempfile::TempDir;

/// Width of the screen and smallest legible text, px.
const SCREEN: f64 = 400.0;
const LEGIBLE: f64 = 12.0;
/// Minimum contrast of text with the page (WCAG 2.2, AA).
const CONTRAST: f64 = 4.5;
/// Pixels of one rem or em, the default of browsers.
const REM: f64 = 16.0;

/// All kinds of figures except the trade-off, which takes long and has the same axes.
static REPORT: LazyLock<String> = LazyLock::new(|| {
    let directory = TempDir::new().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_ahv-research"))
        .args(["reproduce", "--only", "table1,fig3,fig5,fig6,interaction", "--output"])
        .arg(directory.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    fs::read_to_string(directory.path().join("report.html")).unwrap()
});

fn documentation() -> String {
    let content = (ahv_tool::models::VEHICLE.content)().unwrap();
    ahv_tool::documentation::html(&content, Standard::Fmi2, &["Linux".to_string()]).unwrap()
}

fn between<'a>(text: &'a str, from: &str, to: &str) -> Option<&'a str> {
    Some(text.split_once(from)?.1.split_once(to)?.0)
}

/// Selector, property and value of every declaration, including those for narrow screens and print.
fn style(page: &str) -> Vec<(&str, &str, &str)> {
    let style = between(page, "<style>", "</style>").unwrap();
    let rules = style.split('}').filter_map(|rule| rule.rsplit_once('{'));
    rules
        .flat_map(|(selector, declarations)| {
            let selector = selector.rsplit("*/").next().unwrap_or_default().trim();
            declarations.split(';').filter_map(move |declaration| {
                let (property, value) = declaration.split_once(':')?;
                Some((selector, property.trim(), value.trim()))
            })
        })
        .collect()
}

/// A length in pixels; `None` if it depends on the screen.
fn pixels(value: &str) -> Option<f64> {
    let units = [("rem", REM), ("em", REM), ("px", 1.0)];
    units
        .into_iter()
        .find_map(|(unit, size)| Some(value.strip_suffix(unit)?.parse::<f64>().ok()? * size))
}

fn number(text: &str, from: &str) -> f64 {
    between(text, from, "\"").unwrap().parse().unwrap()
}

/// Relative luminance of #rgb or #rrggbb.
fn luminance(colour: &str) -> Option<f64> {
    let digits = colour.strip_prefix('#')?;
    let digits: String = match digits.len() {
        3 => digits.chars().flat_map(|digit| [digit, digit]).collect(),
        6 => digits.to_string(),
        _ => return None,
    };
    let linear = |at: usize| {
        let part = f64::from(u8::from_str_radix(&digits[at..at + 2], 16).unwrap()) / 255.0;
        if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
    };
    Some(0.2126 * linear(0) + 0.7152 * linear(2) + 0.0722 * linear(4))
}

#[test]
fn pages_fit_a_narrow_screen_and_wider_content_scrolls_by_itself() {
    for page in [REPORT.as_str(), &documentation()] {
        assert!(page.contains("name=\"viewport\" content=\"width=device-width, initial-scale=1\""));
        let style = style(page);
        let scrolls = |selector: &str| style.contains(&(selector, "overflow-x", "auto"));
        let tables = page.matches("<table>").count();
        assert!(tables > 0 && scrolls(".table"), "{style:?}");
        // The keyboard reaches what scrolls.
        let reached = page.matches("<div class=\"table\" tabindex=\"0\"><table>").count();
        assert_eq!(reached, tables);
        let figures = page.matches("<svg").count();
        assert_eq!(page.matches("class=\"figure\" tabindex=\"0\"><svg").count(), figures);
        assert!(figures == 0 || scrolls(".figure"));
        for (selector, property, value) in &style {
            let inside =
                [".figure svg", "table", "td"].iter().any(|box_| selector.starts_with(box_));
            let wide = pixels(value).is_some_and(|width| width > SCREEN);
            let fixed = matches!(*property, "width" | "min-width");
            assert!(inside || !fixed || !wide, "{selector}: {property}: {value}");
        }
        for image in page.split("<img").skip(1) {
            assert!(number(image, "width=\"") < SCREEN, "{image}");
        }
    }
}

#[test]
fn text_inside_figures_is_legible_on_a_narrow_screen() {
    let page = REPORT.as_str();
    let style = style(page);
    let least = style.iter().find(|(selector, property, _)| {
        selector.ends_with(".figure svg") && *property == "min-width"
    });
    let shown = least.and_then(|(.., value)| pixels(value)).unwrap().max(SCREEN);
    let mut texts = 0;
    for figure in page.split("<svg").skip(1) {
        let view = between(figure, "viewBox=\"", "\"").unwrap();
        let drawn: f64 = view.split(' ').nth(2).unwrap().parse().unwrap();
        for text in figure.split("</svg>").next().unwrap().split("<text").skip(1) {
            let size = number(text, "font-size=\"") * shown / drawn;
            assert!(size >= LEGIBLE, "{size} px: {text}");
            texts += 1;
        }
    }
    assert!(texts > 50, "{texts}");
}

#[test]
fn text_of_the_pages_has_enough_contrast() {
    for page in [REPORT.as_str(), &documentation()] {
        let style = style(page);
        let colours: Vec<_> = style
            .iter()
            .filter(|(_, property, _)| *property == "color")
            .filter_map(|(.., value)| Some((value, 1.05 / (luminance(value)? + 0.05))))
            .collect();
        assert!(colours.len() > 2, "{style:?}");
        for (colour, contrast) in colours {
            assert!(contrast >= CONTRAST, "{colour}: {contrast:.2}");
        }
    }
}
