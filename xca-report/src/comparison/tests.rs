//! The forms of the report, read again by what reads such files.

mod browser;

use super::*;
use crate::planted::{SubstateOrFailure, with_harm};
use scraper::{Html, Selector};
use std::collections::HashSet;

fn rounded() -> ComparisonReport {
    with_harm(SubstateOrFailure::Position(2), 9, 1)
}

#[test]
fn csv_files_have_all_rows_with_all_digits() {
    let comparison = rounded();
    let files = csv_files::all(&comparison).unwrap();
    let rows = files.iter().map(|(name, content)| {
        let mut reader = csv::Reader::from_reader(content.as_slice());
        // The reader refuses rows of other lengths than that of the header.
        let rows: Result<Vec<csv::StringRecord>, _> = reader.records().collect();
        (*name, rows.unwrap())
    });
    let rows: Vec<_> = rows.collect();
    let numbers: Vec<(&str, usize)> = rows.iter().map(|(name, rows)| (*name, rows.len())).collect();
    let observables = 3 * comparison.observables.len();
    // Two engines, 21 states, 5 substates, one of them with a component that differs.
    assert_eq!(
        numbers,
        [
            ("engines.csv", 3),
            ("differences.csv", 11),
            ("divergence.csv", 210),
            ("observables.csv", observables)
        ]
    );
    let harmed = &rows[0].1[1];
    assert_eq!((&harmed[0], &harmed[13], &harmed[14]), ("harmed", "ROUNDING", "9"));
    let seconds = comparison.engines[1].step_seconds.unwrap().median;
    assert_eq!(harmed[7].parse::<f64>().unwrap(), seconds);
    let position = &rows[1].1[2];
    assert_eq!((&position[1], &position[3], &position[10]), ("Grain.position", "1", "item 2"));
}

#[test]
fn json_holds_everything() {
    let json = serde_json::to_value(rounded()).unwrap();
    assert_eq!((&json["program"], &json["verdict"]), (&"plate".into(), &"ROUNDING".into()));
    let harmed = &json["engines"][1];
    assert_eq!(harmed["first_difference"]["worst"]["place"], serde_json::json!({ "item": 2 }));
    assert_eq!(harmed["differences"]["substates"].as_array().unwrap().len(), 5);
    assert_eq!(harmed["history"].as_array().unwrap().len(), 21);
    let share = json["engines"][2]["engine_figures"]["share_of_cells_worked_on"].as_f64();
    assert!(share.is_some_and(|share| share > 0.0 && share <= 1.0), "{share:?}");
    assert!(harmed["step_seconds"]["median"].as_f64().is_some_and(|seconds| seconds > 0.0));
    assert_eq!(json["compiler"], "rustc 1.95.0");
}

#[test]
fn markdown_tables_have_rows_of_one_length() {
    let text = markdown::markdown(&rounded());
    let mut tables = 0;
    for block in text.split("\n\n").filter(|block| block.starts_with("| ")) {
        tables += 1;
        let columns: HashSet<usize> =
            block.lines().map(|line| line.replace("\\|", "").matches('|').count()).collect();
        assert_eq!(columns.len(), 1, "{block}");
        assert!(block.lines().nth(1).unwrap().starts_with("| --- |"), "{block}");
    }
    assert_eq!(tables, 4);
    assert!(
        text.starts_with("# A plate <1>: 20 steps of 3 items on 3 engines") || text.contains("**ROUNDING**")
    );
    assert!(text.contains("harmed: one \\<bit\\> & no more"), "{text}");
}

/// Also where the place of a difference is long, and with five engines.
#[test]
fn tables_fit_the_terminal() {
    let mut comparison = rounded();
    let (text, lines) = (text(&comparison), tables(&comparison));
    for name in ["threads", "time a step", "least – largest", "items/s", "speed-up", "precision", "set-up"]
    {
        assert!(lines.iter().any(|line| line.contains(name)), "{name}: {text}");
    }
    assert!(!text.contains("adapter"), "{text}");
    for number in 0..3 {
        let mut other = comparison.engines[1].clone();
        other.name = format!("parts:{number}:cpu:16@f32");
        comparison.engines.push(other);
        for observable in &mut comparison.observables {
            observable.last.push(observable.last[1]);
            observable.drift.extend(observable.drift.get(1).copied());
        }
    }
    let lines = tables(&comparison);
    let below = lines.iter().any(|line| line.starts_with("    ") && line.ends_with("parts:2:cpu:16@f32: 67"));
    assert!(below, "{lines:#?}");
}

/// The lines of the tables, which fit.
fn tables(comparison: &ComparisonReport) -> Vec<String> {
    let text = text(comparison);
    let (tables, _) = text.split_once("\n\nnote: ").unwrap();
    let lines: Vec<String> = tables.lines().map(str::to_owned).collect();
    assert!(lines.iter().all(|line| line.chars().count() <= 100), "{tables}");
    lines
}

#[test]
fn the_terminal_shows_tables_and_verdicts() {
    let text = text(&rounded());
    assert!(text.contains(
        "harmed is ROUNDING: it differs from reference from step 9 on, most in Grain.position.x of item 2"
    ));
    assert!(text.contains("cpu:2 is IDENTICAL: the same bits as reference in all of 21 states"), "{text}");
    assert!(text.contains("note: harmed: one <bit> & no more") && text.contains("chaotic"));
    let alike = with_harm(SubstateOrFailure::Kind(0), 21, 5);
    assert_eq!(alike.verdict, xca_compare::Verdict::Identical);
    assert!(!super::text(&alike).contains("chaotic"));
}

fn texts(page: &Html, selector: &str) -> Vec<String> {
    let selector = Selector::parse(selector).unwrap();
    page.select(&selector).map(|element| element.text().collect()).collect()
}

/// An element that loads something, or a style that does.
fn assert_self_contained(text: &str, page: &Html) {
    for attribute in ["src", "href", "srcset", "data", "action", "xlink:href"] {
        assert!(texts(page, &format!("[{}]", attribute.replace(':', "\\:"))).is_empty(), "{attribute}");
    }
    for element in ["script", "link", "iframe", "object", "embed", "img", "base"] {
        assert!(texts(page, element).is_empty(), "{element}");
    }
    let addresses: Vec<&str> = text.match_indices("://").map(|(at, _)| &text[at - 4..at + 22]).collect();
    assert!(addresses.iter().all(|address| *address == "http://www.w3.org/2000/svg"), "{addresses:?}");
    assert!(!text.contains("url(") && !text.contains("@import"));
}

#[test]
fn the_page_is_sound_and_needs_nothing_but_itself() {
    let text = page::page(&rounded()).unwrap();
    let page = Html::parse_document(&text);
    assert_eq!(page.errors, Vec::<std::borrow::Cow<'_, str>>::new());
    assert_self_contained(&text, &page);
    assert_eq!(texts(&page, "title"), ["A plate <1>: engines compared"]);
    assert_eq!(texts(&page, "#verdicts .verdict"), ["ROUNDING", "IDENTICAL"]);
    assert_eq!(texts(&page, "#notes li"), ["harmed: one <bit> & no more"]);
    assert_eq!(texts(&page, "#verdicts p").len(), 1);
    // Each for wide and for narrow pages.
    for width in [".wide", ".narrow"] {
        let times = texts(&page, &format!("#plots {width} svg"));
        assert!(times.len() == 2 && times[0].contains("harmed"), "{times:?}");
        assert_eq!(texts(&page, &format!("#divergence {width} svg")).len(), 1);
    }
    assert_eq!(texts(&page, "#divergence .legend li"), ["Grain.position"]);
    assert_eq!(texts(&page, "tbody tr").len(), 3 + 1 + 11 + rounded().observables.len());
    let alike = page::page(&with_harm(SubstateOrFailure::Kind(0), 21, 5)).unwrap();
    assert!(texts(&Html::parse_document(&alike), "#divergence, #verdicts p").is_empty());
}
