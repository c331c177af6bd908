//! The report as one page for browsers, which needs nothing but itself.

use super::error::ReportError;
use super::plots::{self, Plot};
use super::sheets::{self, Sheet};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use xca_compare::Verdict;
use xca_compare::{ComparisonReport, EngineResult};

/// What the page may load: nothing, from anywhere.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'";

const STYLE: &str = "
:root { color-scheme: light }
body { font: 15px/1.5 system-ui, sans-serif; color: #2b2f36; background: #f4f5f7; margin: 0; overflow-wrap: break-word }
main { max-width: 1160px; margin: 0 auto; padding: 24px 20px 48px }
h1 { font-size: 22px; margin: 0 0 12px } h2 { font-size: 17px; margin: 0 0 10px }
section { background: #fff; border: 1px solid #e3e6ea; border-radius: 8px; padding: 16px 20px; margin: 0 0 18px }
.scroll { overflow-x: auto } table { border-collapse: collapse; font-size: 13.5px; width: 100% }
th, td { padding: 5px 8px; text-align: left; border-bottom: 1px solid #eceef1 }
th { color: #667; font-weight: 600 } .number { text-align: right; font-variant-numeric: tabular-nums } th, .number { white-space: nowrap }
th:first-child, td:first-child { position: sticky; left: 0; background: #fff; padding-left: 0 }
.verdict { display: inline-block; padding: 1px 9px; border-radius: 10px; font-size: 12.5px; font-weight: 700; color: #fff }
.IDENTICAL { background: #1a7f4b } .ROUNDING { background: #a86a00 } .DIFFERENT { background: #b3261e }
.note { background: #fff7e0; border-color: #ecd58a } ul { margin: 0; padding-left: 18px } li { margin: 3px 0 }
ul.plain { list-style: none; padding: 0 } dl { display: grid; grid-template-columns: max-content 1fr; gap: 2px 18px; margin: 0; font-size: 13.5px }
dt { color: #667 } dd { margin: 0; min-width: 0; overflow-wrap: anywhere } svg { width: 100%; height: auto; display: block }
.narrow { display: none } .narrow svg { max-width: 520px }
.legend { display: flex; flex-wrap: wrap; gap: 2px 18px; list-style: none; padding: 0; font-size: 13.5px }
.legend span { display: inline-block; width: 18px; height: 3px; vertical-align: middle; margin-right: 6px }
figure { margin: 0 0 14px } figcaption { font-size: 13.5px; color: #667; margin-bottom: 4px } p { margin: 10px 0 0 }
@media (max-width: 860px) { .wide { display: none } .narrow { display: block } td { white-space: nowrap } }
@media (max-width: 560px) {
  main { padding: 16px 10px 32px } section { padding: 12px } dl { grid-template-columns: 1fr } dd { margin-bottom: 6px }
}
";

pub(super) fn page(comparison: &ComparisonReport) -> Result<String, ReportError> {
    let (times, speed_ups) = (plots::times(comparison)?, plots::speed_ups(comparison)?);
    let mut divergence = Vec::new();
    for engine in &comparison.engines {
        divergence.extend(plots::divergence(engine)?.map(|plot| (&engine.name, plot)));
    }
    let first = comparison.first_name();
    let notes = sheets::notes(comparison);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (comparison.subject.title) ": engines compared" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                main {
                    h1 { (sheets::headline(comparison)) }
                    section id="verdicts" {
                        h2 { "Do they agree with " (first) "?" }
                        ul class="plain" {
                            @for engine in &comparison.engines {
                                @if let Some(verdict) = engine.verdict { (found(engine, verdict, first)) }
                            }
                        }
                        @if comparison.differs() { p { (sheets::CHAOS) } }
                    }
                    @if !notes.is_empty() {
                        section class="note" id="notes" { ul { @for note in &notes { li { (note) } } } }
                    }
                    section id="plots" {
                        h2 { "Times at a glance" }
                        @if let Some(plot) = &times {
                            (figure("Median time of a step; the dark line goes from the least to the largest", plot))
                        }
                        @if let Some(plot) = &speed_ups { (figure("Speed-up", plot)) }
                    }
                    @if !divergence.is_empty() {
                        section id="divergence" {
                            h2 { "Divergence over time" }
                            @for (name, plot) in &divergence {
                                (figure(&format!("{name}: distance from {first}, in relation to the largest value of each substate"), plot))
                            }
                        }
                    }
                    @for sheet in &sheets::all(comparison) { (table(sheet)) }
                    section id="circumstances" {
                        h2 { "Circumstances" }
                        dl { @for (name, value) in sheets::circumstances(comparison) { dt { (name) } dd { (value) } } }
                    }
                }
            }
        }
    };
    Ok(page.into_string())
}

fn found(engine: &EngineResult, verdict: Verdict, first: &str) -> Markup {
    html! {
        li {
            strong { (engine.name) } " "
            span class={ "verdict " (verdict) } { (verdict) } " "
            (sheets::finding(engine, first))
        }
    }
}

/// A plot, of which the library that draws has escaped all texts.
pub(super) fn figure(caption: &str, plot: &Plot) -> Markup {
    html! {
        figure {
            figcaption { (caption) }
            @if !plot.legend.is_empty() {
                ul class="legend" {
                    @for (name, colour) in &plot.legend { li { span style=(format!("background: {colour}")) {} (name) } }
                }
            }
            div class="wide" { (PreEscaped(&plot.wide)) }
            div class="narrow" { (PreEscaped(&plot.narrow)) }
        }
    }
}

fn table(sheet: &Sheet) -> Markup {
    let class = |column: usize| if sheet.right.contains(&column) { "number" } else { "text" };
    html! {
        section {
            h2 { (sheet.title) }
            // Wider than a phone: it is moved, by touch or by keys, and the first column stays.
            div class="scroll" role="region" aria-label=(sheet.title) tabindex="0" { table {
                thead { tr { @for (column, name) in sheet.header.iter().enumerate() { th class=(class(column)) { (name) } } } }
                tbody {
                    @for row in &sheet.rows {
                        tr { @for (column, cell) in row.iter().enumerate() { td class=(class(column)) { (cell) } } }
                    }
                }
            } }
        }
    }
}
