//! The plots of the page, as SVG.

use super::error::ReportError;
use super::sheets;
use plotters::prelude::*;
use xca_compare::Check;
use xca_compare::{ComparisonReport, EngineResult};
use xca_io::numbers::significant;

const TEXT: RGBColor = RGBColor(0x2b, 0x2f, 0x36);
const GRID: RGBColor = RGBColor(0xe3, 0xe6, 0xea);
const BAR: RGBColor = RGBColor(0x3b, 0x6e, 0xa5);
/// Colours that are told apart also by people who see few of them (Okabe and Ito).
const LINES: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x55, 0x55, 0x55),
];

/// A plot, drawn once for wide pages and once for narrow ones: shrunk to the width of a phone, its text could
/// not be read.
#[derive(Debug)]
pub(super) struct Plot {
    pub(super) wide: String,
    pub(super) narrow: String,
    /// What the lines mean, and their colours.
    pub(super) legend: Vec<(String, String)>,
}

/// In pixels; about as many as the page has room for, so that text is as large as beside the plot.
const WIDE: u32 = 860;
const NARROW: u32 = 340;
/// The size of text, and the room that a character takes at most, on the average of a word.
const SIZE: u32 = 14;
const CHARACTER: u32 = 7;

fn room(text: &str) -> u32 {
    u32::try_from(text.chars().count()).unwrap_or(100).min(100) * CHARACTER
}

fn plot_error(error: impl std::fmt::Display) -> ReportError {
    ReportError::Plot(error.to_string())
}

/// A bar with its name and the text at its end.
struct Bar {
    name: String,
    value: f64,
    /// The least and the largest value that was measured.
    range: Option<[f64; 2]>,
    text: String,
}

impl Bar {
    /// Up to where it or its line goes.
    fn end(&self) -> f64 {
        self.range.map_or(self.value, |[_, largest]| largest.max(self.value))
    }
}

/// Median time of a step with least and largest, of each engine.
pub(super) fn times(comparison: &ComparisonReport) -> Result<Option<Plot>, ReportError> {
    let spreads = || comparison.engines.iter().filter_map(|engine| engine.step_seconds);
    let (factor, unit) = sheets::unit_of(spreads().map(|step| step.largest).fold(0.0, f64::max));
    let bar = |engine: &EngineResult| {
        let step = engine.step_seconds?;
        let range = Some([step.least * factor, step.largest * factor]);
        let text = sheets::seconds(step.median);
        Some(Bar { name: engine.name.clone(), value: step.median * factor, range, text })
    };
    bars(&comparison.engines.iter().filter_map(bar).collect::<Vec<_>>(), &format!("{unit} a step"))
}

/// How many times as fast each engine is as the first one.
pub(super) fn speed_ups(comparison: &ComparisonReport) -> Result<Option<Plot>, ReportError> {
    let bar = |engine: &EngineResult| {
        let value = engine.speed_up?;
        Some(Bar { name: engine.name.clone(), value, range: None, text: significant(value, 3) })
    };
    let what = format!("times as fast as {}", comparison.first_name());
    bars(&comparison.engines.iter().filter_map(bar).collect::<Vec<_>>(), &what)
}

fn bars(bars: &[Bar], what: &str) -> Result<Option<Plot>, ReportError> {
    let longest = bars.iter().map(Bar::end).fold(0.0, f64::max);
    if bars.is_empty() || !(longest.is_finite() && longest > 0.0) {
        return Ok(None);
    }
    let [wide, narrow] = [WIDE, NARROW].map(|width| draw_bars(bars, longest, what, width));
    Ok(Some(Plot { wide: wide?, narrow: narrow?, legend: Vec::new() }))
}

/// A text cut to so many pixels; the table beside the plot has all of it.
fn cut(text: &str, pixels: u32) -> String {
    if room(text) <= pixels {
        return text.to_owned();
    }
    let kept = (pixels / CHARACTER).saturating_sub(1) as usize;
    text.chars().take(kept).chain(['…']).collect()
}

fn draw_bars(bars: &[Bar], longest: f64, what: &str, width: u32) -> Result<String, ReportError> {
    let names = width * 2 / 5;
    let left = bars.iter().map(|bar| room(&bar.name)).max().unwrap_or(0).min(names) + 16;
    // What the texts at the ends of the bars need.
    let right = bars.iter().map(|bar| room(&bar.text)).max().unwrap_or(0) + 14;
    // Half of a number at the end of the axis has room in the margin.
    let margin = 24;
    let plot = width - left - 4 - margin;
    let farthest = longest * f64::from(plot) / f64::from(plot - right.min(plot / 2));
    let height = 56 + 34 * u32::try_from(bars.len()).unwrap_or(100).min(100);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (width, height)).into_drawing_area();
        let mut chart = ChartBuilder::on(&root)
            .margin(4)
            .margin_right(margin)
            .x_label_area_size(40)
            .y_label_area_size(left)
            .build_cartesian_2d(0.0..farthest, (0..bars.len() - 1).into_segmented())
            .map_err(plot_error)?;
        // From above in the order of the command line.
        let row = |index: usize| bars.len() - 1 - index;
        let name = |at: &SegmentValue<usize>| match at {
            SegmentValue::CenterOf(at) if *at < bars.len() => cut(&bars[row(*at)].name, names),
            _ => String::new(),
        };
        chart
            .configure_mesh()
            .disable_y_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(GRID)
            .x_labels((plot / 60).max(2) as usize)
            .y_labels(bars.len())
            .x_label_formatter(&|value| significant(*value, 4))
            .y_label_formatter(&name)
            .x_desc(cut(what, plot))
            .label_style(("sans-serif", SIZE).into_font().color(&TEXT))
            .draw()
            .map_err(plot_error)?;
        for (index, bar) in bars.iter().enumerate() {
            let at = row(index);
            let corners = [(0.0, SegmentValue::Exact(at)), (bar.value, SegmentValue::Exact(at + 1))];
            let mut rectangle = Rectangle::new(corners, BAR.filled());
            rectangle.set_margin(6, 6, 0, 0);
            chart.draw_series([rectangle]).map_err(plot_error)?;
            if let Some(range) = bar.range {
                let line = range.map(|value| (value, SegmentValue::CenterOf(at)));
                chart.draw_series([PathElement::new(line, TEXT.stroke_width(2))]).map_err(plot_error)?;
            }
            let style = ("sans-serif", SIZE).into_font().color(&TEXT);
            let place = EmptyElement::at((bar.end(), SegmentValue::CenterOf(at)))
                + Text::new(bar.text.clone(), (6, -6), style);
            chart.draw_series([place]).map_err(plot_error)?;
        }
        root.present().map_err(plot_error)?;
    }
    Ok(svg)
}

/// How far an engine is from the first one over time: a line for each substate, in powers of ten. Nothing
/// where it never is.
pub(super) fn divergence(engine: &EngineResult) -> Result<Option<Plot>, ReportError> {
    let lines = lines(&engine.history);
    let all = || lines.iter().flat_map(|(_, points)| points).map(|(_, value)| *value);
    let (least, largest) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    let last = engine.history.iter().map(|check| check.step).max().unwrap_or(0).max(1) as f64;
    if !least.is_finite() {
        return Ok(None);
    }
    let range = [least.floor() - 0.5, largest.ceil() + 0.5];
    let [wide, narrow] = [WIDE, NARROW].map(|width| draw_lines(&lines, last, range, width));
    let legend = lines.iter().zip(LINES.iter().cycle());
    let legend =
        legend.map(|((name, _), RGBColor(r, g, b))| (name.clone(), format!("#{r:02x}{g:02x}{b:02x}")));
    Ok(Some(Plot { wide: wide?, narrow: narrow?, legend: legend.collect() }))
}

fn draw_lines(
    lines: &[Line],
    last: f64,
    [least, largest]: [f64; 2],
    width: u32,
) -> Result<String, ReportError> {
    // The largest number at the axis.
    let step = room(&significant(last, 6));
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (width, 300)).into_drawing_area();
        let mut chart = ChartBuilder::on(&root)
            .margin(8)
            .margin_right(step / 2 + 12)
            .x_label_area_size(42)
            .y_label_area_size(66)
            .build_cartesian_2d(0.0..last, least..largest)
            .map_err(plot_error)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(GRID)
            .x_labels((width / (step + 30)).max(2) as usize)
            // Whole powers of ten and no others.
            .y_labels((largest - least).min(9.0) as usize)
            .x_label_formatter(&|step| significant(*step, 6))
            .y_label_formatter(&|power| format!("1e{}", significant(*power, 3)))
            .x_desc("step")
            .y_desc("relative RMS difference")
            .label_style(("sans-serif", SIZE).into_font().color(&TEXT))
            .draw()
            .map_err(plot_error)?;
        for ((_, points), colour) in lines.iter().zip(LINES.iter().cycle()) {
            let dots = points.iter().map(|point| Circle::new(*point, 2, colour.filled()));
            chart.draw_series(dots).map_err(plot_error)?;
            let line = LineSeries::new(points.iter().copied(), colour.stroke_width(2));
            chart.draw_series(line).map_err(plot_error)?;
        }
        root.present().map_err(plot_error)?;
    }
    Ok(svg)
}

/// A substate, with steps and logarithms of a distance.
type Line = (String, Vec<(f64, f64)>);

/// The substates that ever differ, each with the steps at which it does and the logarithm of how far it is
/// away.
fn lines(history: &[Check]) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    for check in history {
        for (name, rms) in check.substates.iter().filter(|(_, rms)| *rms > 0.0 && rms.is_finite()) {
            let point = (check.step as f64, rms.log10());
            match lines.iter_mut().find(|(known, _)| known == name) {
                Some((_, points)) => points.push(point),
                None => lines.push((name.clone(), vec![point])),
            }
        }
    }
    lines
}
