//! The plots of the page, as SVG.

use super::{ReportError, sheets};
use crate::compare::lane::Check;
use crate::compare::result::{Comparison, EngineResult};
use crate::numbers::significant;
use plotters::prelude::*;

const WIDTH: u32 = 860;
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

/// Median time of a step with least and largest, of each engine.
pub(super) fn times(comparison: &Comparison) -> Result<Option<String>, ReportError> {
    let bar = |engine: &EngineResult| {
        let step = engine.step_seconds?;
        let range = Some([step.least * 1e3, step.largest * 1e3]);
        let text = sheets::seconds(step.median);
        Some(Bar { name: engine.name.clone(), value: step.median * 1e3, range, text })
    };
    bars(comparison.engines.iter().filter_map(bar).collect(), "milliseconds a step")
}

/// How many times as fast each engine is as the first one.
pub(super) fn speed_ups(comparison: &Comparison) -> Result<Option<String>, ReportError> {
    let bar = |engine: &EngineResult| {
        let value = engine.speed_up?;
        Some(Bar { name: engine.name.clone(), value, range: None, text: significant(value, 3) })
    };
    let what = format!("times as fast as {}", comparison.first_name());
    bars(comparison.engines.iter().filter_map(bar).collect(), &what)
}

fn bars(bars: Vec<Bar>, what: &str) -> Result<Option<String>, ReportError> {
    let longest =
        bars.iter().map(|bar| bar.range.map_or(bar.value, |[_, largest]| largest)).fold(0.0, f64::max);
    if bars.is_empty() || !(longest.is_finite() && longest > 0.0) {
        return Ok(None);
    }
    let widest = bars.iter().map(|bar| bar.name.chars().count()).max().unwrap_or(0);
    let left = u32::try_from(widest * 8 + 16).unwrap_or(WIDTH).clamp(70, WIDTH / 3);
    let height = 56 + 34 * u32::try_from(bars.len()).unwrap_or(100).min(100);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (WIDTH, height)).into_drawing_area();
        let mut chart = ChartBuilder::on(&root)
            .margin(4)
            .x_label_area_size(40)
            .y_label_area_size(left)
            .build_cartesian_2d(0.0..longest * 1.15, (0..bars.len() - 1).into_segmented())
            .map_err(plot_error)?;
        // From above in the order of the command line.
        let row = |index: usize| bars.len() - 1 - index;
        let name = |at: &SegmentValue<usize>| match at {
            SegmentValue::CenterOf(at) if *at < bars.len() => bars[row(*at)].name.clone(),
            _ => String::new(),
        };
        chart
            .configure_mesh()
            .disable_y_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(GRID)
            .x_labels(8)
            .y_labels(bars.len())
            .y_label_formatter(&name)
            .x_desc(what)
            .label_style(("sans-serif", 14).into_font().color(&TEXT))
            .draw()
            .map_err(plot_error)?;
        for (index, bar) in bars.iter().enumerate() {
            let at = row(index);
            let corners = [(0.0, SegmentValue::Exact(at)), (bar.value, SegmentValue::Exact(at + 1))];
            let mut rectangle = Rectangle::new(corners, BAR.filled());
            rectangle.set_margin(6, 6, 0, 0);
            chart.draw_series([rectangle]).map_err(plot_error)?;
            let mut end = bar.value;
            if let Some([least, largest]) = bar.range {
                end = end.max(largest);
                let line = [least, largest].map(|value| (value, SegmentValue::CenterOf(at)));
                chart.draw_series([PathElement::new(line, TEXT.stroke_width(2))]).map_err(plot_error)?;
            }
            let style = ("sans-serif", 14).into_font().color(&TEXT);
            let place = EmptyElement::at((end, SegmentValue::CenterOf(at)))
                + Text::new(bar.text.clone(), (6, -7), style);
            chart.draw_series([place]).map_err(plot_error)?;
        }
        root.present().map_err(plot_error)?;
    }
    Ok(Some(svg))
}

/// How far an engine is from the first one over time: a line for each substate, in powers of ten. Nothing where it never is.
pub(super) fn divergence(engine: &EngineResult) -> Result<Option<String>, ReportError> {
    let lines = lines(&engine.history);
    let all = || lines.iter().flat_map(|(_, points)| points).map(|(_, value)| *value);
    let (least, largest) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    let last = engine.history.iter().map(|check| check.step).max().unwrap_or(0).max(1) as f64;
    if !least.is_finite() {
        return Ok(None);
    }
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (WIDTH, 340)).into_drawing_area();
        let mut chart = ChartBuilder::on(&root)
            .margin(8)
            .margin_right(24)
            .x_label_area_size(44)
            .y_label_area_size(70)
            .build_cartesian_2d(0.0..last, least.floor() - 0.5..largest.ceil() + 0.5)
            .map_err(plot_error)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(GRID)
            .x_labels(10)
            .y_labels(9)
            .x_label_formatter(&|step| significant(*step, 6))
            .y_label_formatter(&|power| format!("1e{}", significant(*power, 3)))
            .x_desc("step")
            .y_desc("relative RMS difference")
            .label_style(("sans-serif", 14).into_font().color(&TEXT))
            .draw()
            .map_err(plot_error)?;
        for (index, (name, points)) in lines.iter().enumerate() {
            let colour = LINES[index % LINES.len()];
            let dots = points.iter().map(|point| Circle::new(*point, 2, colour.filled()));
            chart.draw_series(dots).map_err(plot_error)?;
            chart
                .draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))
                .map_err(plot_error)?
                .label(name.clone())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerRight)
            .background_style(WHITE.mix(0.85))
            .border_style(GRID)
            .label_font(("sans-serif", 13).into_font().color(&TEXT))
            .draw()
            .map_err(plot_error)?;
        root.present().map_err(plot_error)?;
    }
    Ok(Some(svg))
}

/// The substates that ever differ, each with the steps at which it does and the logarithm of how far it is away.
fn lines(history: &[Check]) -> Vec<(String, Vec<(f64, f64)>)> {
    let mut lines: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
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
