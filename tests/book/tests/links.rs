//! Every link and every picture of the book leads to something that is there.

use scraper::{Html, Selector};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fs;
use std::path::{Component, Path, PathBuf};

type Failure = Box<dyn Error + Send + Sync>;

/// A page of the book, as far as links are concerned.
struct Page {
    anchors: BTreeSet<String>,
    /// Of links and pictures.
    targets: Vec<String>,
}

impl Page {
    fn read(path: &Path) -> Result<Self, Failure> {
        let html = Html::parse_document(&fs::read_to_string(path)?);
        let values = |selector: &str, attribute: &str| -> Result<Vec<String>, Failure> {
            let selector = Selector::parse(selector).map_err(|error| error.to_string())?;
            let values = html.select(&selector).filter_map(|element| element.attr(attribute));
            Ok(values.map(str::to_owned).collect())
        };
        let targets = [values("main a[href]", "href")?, values("main img[src]", "src")?].concat();
        Ok(Self { anchors: values("[id]", "id")?.into_iter().collect(), targets })
    }
}

/// All pages, by their path in the book.
fn pages(folder: &Path) -> Result<BTreeMap<PathBuf, Page>, Failure> {
    let mut pages = BTreeMap::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let is_page = path.extension().is_some_and(|extension| extension == "html");
        if is_page && let Some(name) = path.file_name() {
            pages.insert(PathBuf::from(name), Page::read(&path)?);
        }
    }
    Ok(pages)
}

/// What is wrong with a link of a page, if anything is.
fn fault(folder: &Path, pages: &BTreeMap<PathBuf, Page>, page: &Path, target: &str) -> Option<String> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
    let path = if path.is_empty() { page } else { Path::new(path) };
    if path.components().any(|part| !matches!(part, Component::Normal(_) | Component::CurDir)) {
        return Some(format!("{}: {target} leads out of the book", page.display()));
    }
    if !folder.join(path).is_file() {
        return Some(format!("{}: {target} does not exist", page.display()));
    }
    let has_anchor = |page: &Page| anchor.is_empty() || page.anchors.contains(anchor);
    let is_there = pages.get(path).is_none_or(has_anchor);
    (!is_there).then(|| format!("{}: {target} has no such heading", page.display()))
}

#[test]
fn every_link_leads_somewhere() -> Result<(), Failure> {
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    xca_tests_book::build(folder)?;
    let pages = pages(folder)?;
    let links = || {
        pages.iter().flat_map(|(path, page)| page.targets.iter().map(move |target| (path, target.as_str())))
    };
    let faults: Vec<_> = links().filter_map(|(page, target)| fault(folder, &pages, page, target)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(links().count() > 100 && pages.len() > 15, "{} pages", pages.len());
    Ok(())
}

/// The test above finds what it looks for.
#[test]
fn broken_links_are_found() -> Result<(), Failure> {
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    fs::write(folder.join("a.html"), r#"<main><h2 id="here">Here</h2><img src="picture.png"></main>"#)?;
    let pages = pages(folder)?;
    let found = |target: &str| fault(folder, &pages, Path::new("a.html"), target).is_some();
    assert_eq!(pages[Path::new("a.html")].targets, ["picture.png"]);
    let broken = ["picture.png", "b.html", "#there", "a.html#there", "../README.md", "/a.html"];
    assert_eq!(broken.map(found), [true; 6]);
    assert_eq!(["#here", "a.html#here", "a.html", "https://example.org/b.html"].map(found), [false; 4]);
    Ok(())
}
