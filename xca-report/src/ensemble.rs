//! Mean and spread of what a sweep has observed, as a page for browsers that needs nothing but itself.

use maud::{DOCTYPE, PreEscaped, html};
use plotters::coord::Shift;
use plotters::prelude::*;
use xca_core::statistics::mean_and_deviation;
use xca_ensemble::Finished;
use xca_io::numbers::significant;
use xca_record::Failure;

/// The page.
pub const PAGE: &str = "summary.html";

const TEXT: RGBColor = RGBColor(0x2b, 0x2f, 0x36);
const GRID: RGBColor = RGBColor(0xe3, 0xe6, 0xea);
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
/// In pixels.
const SIZE: (u32, u32) = (760, 340);

const STYLE: &str = "
body { font: 15px/1.5 system-ui, sans-serif; color: #2b2f36; background: #f4f5f7; margin: 0 }
main { max-width: 820px; margin: 0 auto; padding: 24px 20px 48px } h1 { font-size: 22px }
figure { background: #fff; border: 1px solid #e3e6ea; border-radius: 8px; padding: 16px 20px; margin: 0 0 18px }
figcaption { font-weight: 600 } svg { width: 100%; height: auto; display: block }
ul { display: flex; flex-wrap: wrap; gap: 2px 18px; list-style: none; padding: 0; margin: 4px 0; font-size: 13.5px }
li span { display: inline-block; width: 18px; height: 3px; vertical-align: middle; margin-right: 6px }
";

/// Mean and sample standard deviation over the seeds, at one value of the first parameter.
struct Point {
    x: f64,
    mean: f64,
    deviation: f64,
}

/// The values of one observable, for one combination of the other parameters.
struct Line {
    name: String,
    points: Vec<Point>,
}

/// The page of all observables over the parameter that is named first; nothing where no parameter is swept or
/// nothing is observed.
pub fn page(title: &str, finished: &[Finished]) -> Result<Option<String>, Failure> {
    let Some(parameter) = finished.first().and_then(|first| first.member.parameters.first()) else {
        return Ok(None);
    };
    let Some(observed) = finished.iter().find(|finished| !finished.observables.is_empty()) else {
        return Ok(None);
    };
    let mut figures = Vec::new();
    for (number, observable) in observed.observables.iter().enumerate() {
        let lines = lines(finished, number);
        let name = match observable.unit.as_str() {
            "" => observable.name.clone(),
            unit => format!("{} ({unit})", observable.name),
        };
        figures.push((name, plot(&lines, &parameter.parameter)?, lines));
    }
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body { main {
                h1 { (title) }
                p { "Mean over the seeds; bars are one sample standard deviation to each side." }
                @for (name, svg, lines) in &figures {
                    figure {
                        figcaption { (name) }
                        @if lines.len() > 1 {
                            ul { @for (line, colour) in lines.iter().zip(LINES.iter().cycle()) {
                                li { span style=(format!("background: rgb({}, {}, {})", colour.0, colour.1, colour.2)) {} (line.name) }
                            } }
                        }
                        (PreEscaped(svg))
                    }
                }
            } }
        }
    };
    Ok(Some(page.into_string()))
}

/// One line for each combination of the parameters but the first.
fn lines(finished: &[Finished], observable: usize) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    let mut values: Vec<&str> = Vec::new();
    let mut at = 0;
    while at < finished.len() {
        let parameters = &finished[at].member.parameters;
        let group = finished[at..].iter().take_while(|other| other.member.parameters == *parameters);
        let group: Vec<&Finished> = group.collect();
        at += group.len();
        let others = parameters[1..].iter().map(|own| format!("{} = {}", own.parameter, own.value));
        let name = others.collect::<Vec<_>>().join(", ");
        // States and lists stand side by side in the order in which they were given.
        let value = parameters[0].value.as_str();
        let place = values.iter().position(|known| *known == value).unwrap_or_else(|| {
            values.push(value);
            values.len() - 1
        });
        let x = value.parse().unwrap_or(place as f64);
        let observed = group.iter().filter_map(|row| row.observables.get(observable));
        let numbers: Vec<f64> = observed.map(|it| it.value).filter(|value| can_be_drawn(*value)).collect();
        if let Some(point) = point(x, &numbers) {
            match lines.iter_mut().find(|line| line.name == name) {
                Some(line) => line.points.push(point),
                None => lines.push(Line { name, points: vec![point] }),
            }
        }
    }
    lines
}

/// Whether an axis can have this number. Plotters searches for ever for ticks in a span that overflows.
fn can_be_drawn(number: f64) -> bool {
    number.abs() < 1e300
}

fn point(x: f64, values: &[f64]) -> Option<Point> {
    let [mean, deviation] = mean_and_deviation(values);
    (!values.is_empty() && can_be_drawn(x)).then_some(Point { x, mean, deviation })
}

fn plot(lines: &[Line], parameter: &str) -> Result<String, Failure> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        // The errors of the library name its backend.
        draw(&root, lines, parameter).map_err(|error| error.to_string())?;
        root.present().map_err(|error| error.to_string())?;
    }
    Ok(svg)
}

fn draw(
    root: &DrawingArea<SVGBackend<'_>, Shift>,
    lines: &[Line],
    parameter: &str,
) -> Result<(), Box<dyn std::error::Error>> {
    let points = || lines.iter().flat_map(|line| &line.points);
    let across = around(points().map(|point| [point.x; 2]));
    let up = around(points().map(|point| [point.mean - point.deviation, point.mean + point.deviation]));
    let mut chart = ChartBuilder::on(root)
        .margin(8)
        .margin_right(24)
        .x_label_area_size(42)
        .y_label_area_size(84)
        .build_cartesian_2d(across[0]..across[1], up[0]..up[1])?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GRID)
        .x_label_formatter(&|value| significant(*value, 4))
        .y_label_formatter(&|value| significant(*value, 5))
        .x_desc(parameter)
        .label_style(("sans-serif", 14).into_font().color(&TEXT))
        .draw()?;
    for (line, colour) in lines.iter().zip(LINES.iter().cycle()) {
        let means = line.points.iter().map(|point| (point.x, point.mean));
        chart.draw_series(LineSeries::new(means.clone(), colour.stroke_width(2)))?;
        chart.draw_series(means.map(|mean| Circle::new(mean, 3, colour.filled())))?;
        chart.draw_series(line.points.iter().filter(|point| point.deviation > 0.0).map(|point| {
            let Point { x, mean, deviation } = *point;
            PathElement::new([(x, mean - deviation), (x, mean + deviation)], colour.stroke_width(2))
        }))?;
    }
    Ok(())
}

/// A range with some room on both sides; that of values which differ by rounding alone has a width too.
fn around(ranges: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    let whole = ranges.reduce(|[low, high], [least, most]| [low.min(least), high.max(most)]);
    let [low, high] = whole.unwrap_or([0.0, 1.0]);
    let largest = low.abs().max(high.abs());
    let room = if high - low > 1e-9 * largest { 0.05 * (high - low) } else { 0.5 * largest.max(1e-9) };
    [low - room, high + room]
}

#[cfg(test)]
mod tests {
    use super::*;
    use xca_ensemble::{Assigned, End, Member};
    use xca_record::Observable;

    fn finished(number: usize, parameters: &[(&str, &str)], heat: Option<f64>) -> Finished {
        let parameters = parameters.iter().map(|(parameter, value)| Assigned {
            parameter: (*parameter).to_owned(),
            value: (*value).to_owned(),
        });
        Finished {
            member: Member { number, seed: number as u64, parameters: parameters.collect() },
            end: heat.map_or(End::Failed("lost".to_owned()), |_| End::Done),
            steps: 1,
            observables: heat.map(|heat| Observable::new("heat", "K", heat)).into_iter().collect(),
        }
    }

    #[test]
    fn rounding_is_no_change() {
        let [low, high] = around([[2.0, 2.0 + 1e-15]].into_iter());
        assert!((low - 1.0).abs() < 1e-12 && (high - 3.0).abs() < 1e-12, "{low} {high}");
        assert_eq!(around([[0.0, 0.0]].into_iter()), [-5e-10, 5e-10]);
        assert_eq!(around([[1.0, 2.0], [0.0, 1.5]].into_iter()), [-0.1, 2.1]);
        assert_eq!(around(std::iter::empty()), [-0.05, 1.05]);
    }

    /// Without their limit, an axis with 1e308 on both sides of 0 has no end.
    #[test]
    fn huge_values_are_left_out_of_plots() {
        let value =
            |number: usize, value: f64| finished(number, &[("rate", &number.to_string())], Some(value));
        let rows =
            [value(0, 1e308), value(1, -1e308), value(2, f64::INFINITY), value(3, 1e299), value(4, -1e299)];
        let points: Vec<f64> = lines(&rows, 0)[0].points.iter().map(|point| point.mean).collect();
        assert_eq!(points, [1e299, -1e299]);
        assert!(page("huge", &rows).unwrap().unwrap().contains("<svg"));
        assert!(point(1e308, &[1.0]).is_none());
    }

    #[test]
    fn there_is_a_line_for_each_combination_of_the_others() {
        let rows = [
            finished(0, &[("rate", "0.5"), ("kind", "Wood")], Some(1.0)),
            finished(1, &[("rate", "0.5"), ("kind", "Wood")], Some(3.0)),
            finished(2, &[("rate", "0.5"), ("kind", "Sand")], None),
            finished(3, &[("rate", "2"), ("kind", "Wood")], Some(5.0)),
            finished(4, &[("rate", "2"), ("kind", "Sand")], Some(7.0)),
        ];
        let lines = lines(&rows, 0);
        assert_eq!(
            lines.iter().map(|line| line.name.as_str()).collect::<Vec<_>>(),
            ["kind = Wood", "kind = Sand"]
        );
        let points: Vec<_> =
            lines[0].points.iter().map(|point| [point.x, point.mean, point.deviation]).collect();
        assert_eq!(points, [[0.5, 2.0, 2.0_f64.sqrt()], [2.0, 5.0, 0.0]]);
        let page = page("A <sweep>", &rows).unwrap().unwrap();
        assert!(page.contains("A &lt;sweep&gt;") && page.contains("heat (K)") && page.contains("<svg"));
        assert!(super::page("one run", &[finished(0, &[], Some(1.0))]).unwrap().is_none());
    }
}
