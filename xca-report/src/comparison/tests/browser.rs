//! The page as a reader sees it, in a browser without a screen.

use super::rounded;
use crate::comparison::page;
use crate::comparison::plots::{self, Plot};
use crate::planted::{SubstateOrFailure, with_harm};
use scraper::{Html, Selector};
use serde_json::{Value, json};
use std::collections::HashSet;
use std::fs;
use std::io;
use std::path::Path;
use std::process::{Command, Output};
use xca_compare::Check;
use xca_compare::ComparisonReport;
use xca_compare::Spread;

/// The widths of a page on a desk, on half of it, and on a phone.
const WIDTHS: [u32; 3] = [1280, 870, 400];

/// The browser that CHROMIUM names, or one of those that are known by name.
fn browser() -> String {
    let named = std::env::var("CHROMIUM").ok().filter(|name| !name.is_empty());
    let known = ["chromium", "chromium-browser", "google-chrome"].map(str::to_owned);
    let answers = |browser: &String| {
        Command::new(browser).arg("--version").output().is_ok_and(|said| said.status.success())
    };
    let found = named.into_iter().chain(known).find(answers);
    found.expect("no Chromium was found: run `bash scripts/browser`, or name one in the variable CHROMIUM")
}

/// Lets the browser open a file in a folder, with a profile of its own and no word to anyone.
fn open(folder: &Path, file: &str, arguments: &[String]) -> Output {
    Command::new(browser())
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .args(["--hide-scrollbars", "--window-size=2600,2400", "--enable-logging=stderr"])
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .args(arguments)
        .arg(format!("file://{}", folder.join(file).display()))
        .output()
        .unwrap()
}

/// The page in frames of all widths, and a script that collects what it is told from within them.
fn frames(of: &str) -> String {
    let frame =
        |width: u32| format!("<iframe src='{of}' width='{width}' height='2300' frameborder='0'></iframe>");
    format!(
        "<!DOCTYPE html><meta charset='utf-8'><body style='margin: 0'><pre>[]</pre>{}<script>\
         const all = []; addEventListener('message', ({{ data }}) => {{ all.push(data); \
         document.querySelector('pre').textContent = JSON.stringify(all) }})</script>",
        WIDTHS.map(frame).concat()
    )
}

/// What a reader sees of a page, at each of the widths.
fn seen(text: &str) -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let policy = "default-src 'none'; ";
    assert!(text.contains(policy));
    // The page forbids scripts; this copy allows the one that measures, and forbids as much else as the page
    // does.
    let measured = text.replace(policy, &format!("{policy}script-src 'unsafe-inline'; "));
    let script = format!("<script>{}</script></head>", include_str!("measure.js"));
    fs::write(folder.path().join("page.html"), measured.replace("</head>", &script)).unwrap();
    fs::write(folder.path().join("frames.html"), frames("page.html")).unwrap();
    let output =
        open(folder.path(), "frames.html", &["--dump-dom", "--virtual-time-budget=5000"].map(str::to_owned));
    let said = String::from_utf8_lossy(&output.stderr);
    let words: Vec<&str> = said.lines().filter(|line| line.contains("CONSOLE")).collect();
    let dom = Html::parse_document(&String::from_utf8_lossy(&output.stdout));
    let found: String =
        dom.select(&Selector::parse("pre").unwrap()).flat_map(|element| element.text()).collect();
    let mut found: Vec<Value> =
        serde_json::from_str(&found).unwrap_or_else(|error| panic!("{error}: {said}"));
    assert_eq!(found.len(), WIDTHS.len(), "{said}");
    found.sort_by_key(|found| std::cmp::Reverse(found["page"].as_u64()));
    for one in &mut found {
        one["console"] = json!(words);
    }
    found
}

/// Checks all that must hold of any page, at any width; gives what was seen.
fn assert_pleasant(comparison: &ComparisonReport) -> Vec<Value> {
    assert_pleasant_page(&page::page(comparison).unwrap())
}

fn assert_pleasant_page(text: &str) -> Vec<Value> {
    let all = seen(text);
    for (seen, width) in all.iter().zip(WIDTHS) {
        assert_eq!(seen["page"], width);
        assert_eq!(seen["content"], width, "the page is wider than its window");
        assert_eq!((&seen["loads"], &seen["console"]), (&json!([]), &json!([])));
        assert_eq!(seen["faults"], json!([]), "at {width}");
        for plot in seen["plots"].as_array().unwrap() {
            let number = |name: &str| plot[name].as_f64().unwrap();
            assert!(
                number("width") > 0.7 * f64::from(width) && number("height") > 60.0,
                "at {width}: {plot}"
            );
            assert!(number("least_text") > 9.5 && number("least_text") < 18.0, "at {width}: {plot}");
            assert_eq!(plot["faults"], json!([]), "at {width}");
        }
        for table in seen["tables"].as_array().unwrap() {
            assert!(table["rows"].as_u64() > Some(0) && table["faults"] == json!([]), "at {width}: {table}");
        }
    }
    all
}

/// The texts of the badges, white on a colour.
fn badges(seen: &Value) -> Vec<(String, String)> {
    let badges = seen["verdicts"].as_array().unwrap().iter();
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    badges
        .map(|badge| {
            assert_eq!(badge["colour"], "rgb(255, 255, 255)");
            (text(&badge["text"]), text(&badge["background"]))
        })
        .collect()
}

const GREEN: &str = "rgb(26, 127, 75)";
const AMBER: &str = "rgb(168, 106, 0)";
const RED: &str = "rgb(179, 38, 30)";

#[track_caller]
fn assert_shown(
    comparison: ComparisonReport,
    harmed: (&str, &str),
    plots: usize,
    tables: usize,
) -> Vec<Value> {
    // The times of this machine, whatever they are, decide nothing here.
    let all = assert_pleasant(&timed(comparison, [31.4e-3, 2.83e-3, 1.5e-3]));
    for seen in &all {
        let of = |(text, colour): (&str, &str)| (text.to_owned(), colour.to_owned());
        assert_eq!(badges(seen), [of(harmed), of(("IDENTICAL", GREEN))]);
        let tables_seen = seen["tables"].as_array().unwrap();
        assert_eq!((seen["plots"].as_array().unwrap().len(), tables_seen.len()), (plots, tables));
        // On a desk they are there at once.
        let moves = tables_seen.iter().any(|table| table["hidden"].as_u64() > Some(0));
        assert_eq!(moves, seen["page"] != WIDTHS[0], "at {}", seen["page"]);
        assert!(
            seen["headings"].to_string().contains("\"Do they agree with reference?\""),
            "{}",
            seen["headings"]
        );
    }
    all
}

#[test]
fn engines_that_agree_are_shown() {
    assert_shown(with_harm(SubstateOrFailure::Kind(0), 21, 5), ("IDENTICAL", GREEN), 2, 4);
}

#[test]
fn rounding_is_shown() {
    for seen in assert_shown(rounded(), ("ROUNDING", AMBER), 3, 4) {
        // The first colour of the lines.
        assert_eq!(seen["legend"], json!([["Grain.position", "rgb(0, 114, 178)"]]));
    }
}

#[test]
fn differences_and_failures_are_shown() {
    assert_shown(with_harm(SubstateOrFailure::Kind(0), 3, 1), ("DIFFERENT", RED), 3, 4);
    assert_shown(with_harm(SubstateOrFailure::Failure, 4, 5), ("DIFFERENT", RED), 2, 4);
}

/// Names, titles and numbers of engines as they may come.
#[test]
fn long_names_have_room() {
    let mut comparison = with_harm(SubstateOrFailure::Temperature(33), 2, 1);
    comparison.subject.title =
        "A plate of uncommonly_long_words_that_no_one_would_want_to_break_anywhere".to_owned();
    comparison.engines[1].device.insert("adapter".to_owned(), "NVIDIA GeForce RTX 4090 Laptop GPU".into());
    comparison.engines[1].name = "gpu:NVIDIA GeForce RTX 4090 Laptop GPU@f32".to_owned();
    let more = comparison.engines[2].clone();
    for threads in 1..14 {
        let mut engine = more.clone();
        engine.name = format!("cpu:{threads}@f64");
        comparison.engines.push(engine);
    }
    for observable in &mut comparison.observables {
        observable.last.resize(comparison.engines.len(), observable.last[2]);
    }
    assert_pleasant(&comparison);
}

/// A comparison as if the engines had taken these times for a step, give or take a tenth.
fn timed(mut comparison: ComparisonReport, times: [f64; 3]) -> ComparisonReport {
    for (engine, median) in comparison.engines.iter_mut().zip(times) {
        // One that failed has none.
        engine.speed_up = engine.step_seconds.map(|_| times[0] / median);
        engine.step_seconds =
            engine.step_seconds.map(|_| Spread { median, least: 0.9 * median, largest: 1.1 * median });
    }
    comparison
}

/// A comparison as if the positions had come apart so far, in powers of ten, in so many steps.
fn apart(mut comparison: ComparisonReport, steps: u64, [from, to]: [f64; 2]) -> ComparisonReport {
    let check = |part: u64| {
        let distance = 10_f64.powf(from + (to - from) * part as f64 / 16.0);
        Check { step: steps * part / 16, substates: vec![("Grain.position".to_owned(), distance)] }
    };
    comparison.engines[1].history = (0..=16).map(check).collect();
    comparison
}

/// What is written at axes and bars depends on the numbers; all kinds of them, on one page.
#[test]
fn all_numbers_have_room_in_plots() {
    let comparison = rounded();
    let mut figures = String::new();
    let mut add = |plot: Option<Plot>| figures.push_str(&page::figure("", &plot.unwrap()).into_string());
    for exponent in -8..5 {
        for mantissa in [1.0, 1.497, 2.51, 3.999, 6.05, 9.996] {
            let time = mantissa * 10_f64.powi(exponent);
            let timed = timed(comparison.clone(), [time, time * 0.371, time * 0.00123]);
            add(plots::times(&timed).unwrap());
            add(plots::speed_ups(&timed).unwrap());
        }
    }
    for steps in [16, 100, 8945, 1_234_567, 2_000_000_000] {
        for powers in
            [[-16.3, -16.2], [-16.0, -15.0], [-16.9, -9.2], [-17.0, 0.0], [-200.0, 150.0], [2.0, 7.5]]
        {
            add(plots::divergence(&apart(comparison.clone(), steps, powers).engines[1]).unwrap());
        }
    }
    let page = page::page(&comparison).unwrap().replace("</main>", &format!("{figures}</main>"));
    assert!(assert_pleasant_page(&page)[0]["plots"].as_array().unwrap().len() > 180);
}

/// That the tests above could fail: what is put on a page here is seen.
#[test]
fn faults_of_a_page_are_seen() {
    let faults = [
        "<img src='https://example.org/a.png'>",
        "<div style='width: 900px'>wide</div>",
        "<p style='width: 40px; overflow: hidden; white-space: nowrap; font-size: 9px'>much too long</p>",
        "<svg width='300' height='80'><text x='-20' y='20'>one</text><text x='0' y='22'>two</text></svg>",
        "<div style='overflow: hidden; width: 90px'><table><tr><td>a<td class='number'>a long text</table></div>",
    ];
    let page = page::page(&rounded()).unwrap().replace("</main>", &format!("{}</main>", faults.concat()));
    let seen = seen(&page).remove(2);
    for list in ["loads", "console"] {
        assert!(seen[list].to_string().contains("https://example.org/a.png"), "{}", seen[list]);
    }
    assert!(seen["content"].as_u64() > Some(800));
    let faults = ["is cut off", "is too small to read"].map(|fault| format!("p \"much too long\" {fault}"));
    assert_eq!(seen["faults"], json!(faults));
    let last = |list: &str| seen[list].as_array().unwrap().last().unwrap()["faults"].clone();
    assert_eq!(last("plots"), json!(["\"one\" leaves the plot", "\"one\" and \"two\" overlap"]));
    assert_eq!(last("tables"), json!(["its end cannot be reached"]));
}

#[test]
fn the_picture_has_the_colours() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("page.html"), page::page(&rounded()).unwrap()).unwrap();
    let picture = folder.path().join("page.png");
    let said = open(folder.path(), "page.html", &[format!("--screenshot={}", picture.display())]);
    assert!(picture.is_file(), "{}", String::from_utf8_lossy(&said.stderr));
    let colours = colours(&picture);
    // A bar, a line of the divergence, and a verdict.
    for colour in [[0x3b, 0x6e, 0xa5], [0x00, 0x72, 0xb2], [0x1a, 0x7f, 0x4b]] {
        assert!(colours.contains(&colour), "{colour:?} is not in the picture");
    }
}

fn colours(picture: &Path) -> HashSet<[u8; 3]> {
    let file = io::BufReader::new(fs::File::open(picture).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    let size = info.color_type.samples();
    pixels[..info.buffer_size()].chunks_exact(size).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}
