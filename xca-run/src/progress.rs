//! What a run shows of itself: a line while it goes on, a table at its end.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use xca_io::numbers::{duration_text, rate_text, significant};
use xca_report::table::table;

/// The line that shows how far a run has come: steps done and to do, steps a second, time left.
///
/// It goes to stderr, and only if that is a terminal. A run whose end is not known (it ends at a criterion)
/// shows no time left.
///
/// ```
/// use xca_run::progress::Progress;
///
/// let progress = Progress::new(Some(1000));
/// for step in 1..=1000 {
///     // ... the step ...
///     progress.at(step);
/// }
/// progress.finish();
/// ```
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A line for a run of `total` steps, or of an unknown number.
    #[must_use]
    pub fn new(total: Option<u64>) -> Self {
        if std::io::stderr().is_terminal() {
            Self::on(total, ProgressDrawTarget::stderr_with_hz(10))
        } else {
            Self::hidden()
        }
    }

    /// A line for so many things, which are called so.
    #[must_use]
    pub fn counting(total: u64, things: &str) -> Self {
        let line = Self::new(Some(total));
        let template = format!("{{bar:32}} {{pos}}/{{len}} {things}, {{elapsed}}  {{msg}}");
        if let Ok(style) = ProgressStyle::with_template(&template) {
            line.bar.set_style(style.progress_chars("━╸─"));
        }
        line
    }

    /// A line that no one sees.
    #[must_use]
    pub fn hidden() -> Self {
        Self::on(None, ProgressDrawTarget::hidden())
    }

    fn on(total: Option<u64>, target: ProgressDrawTarget) -> Self {
        let bar = ProgressBar::with_draw_target(total, target);
        let template = if total.is_some() {
            "{bar:32} {pos}/{len} steps, {rate}{left}  {msg}"
        } else {
            "{spinner} {pos} steps, {rate}, {elapsed}  {msg}"
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(
                style
                    .progress_chars("━╸─")
                    .with_key("rate", |state: &ProgressState, out: &mut dyn std::fmt::Write| {
                        let _ = out.write_str(&rate_text(state.per_sec()));
                    })
                    .with_key("left", |state: &ProgressState, out: &mut dyn std::fmt::Write| {
                        let _ = out.write_str(&left_text(state.eta()));
                    })
                    .with_key("elapsed", |state: &ProgressState, out: &mut dyn std::fmt::Write| {
                        let _ = out.write_str(&duration_text(state.elapsed()));
                    }),
            );
        }
        Self { bar }
    }

    /// `steps` are done. May be called after every step: the line itself is redrawn ten times a second at
    /// most.
    pub fn at(&self, steps: u64) {
        self.bar.set_position(steps);
    }

    /// `steps` were done before, by a run that this one goes on with.
    pub fn begin_at(&self, steps: u64) {
        self.bar.set_position(steps);
        self.bar.reset_eta();
    }

    /// Shows a text at the end of the line, such as what is being written.
    pub fn message(&self, text: &str) {
        self.bar.set_message(text.to_owned());
    }

    /// Does `work`, which prints, with the line out of the way.
    pub fn suspend<R>(&self, work: impl FnOnce() -> R) -> R {
        self.bar.suspend(work)
    }

    /// Leaves the line as it is and ends it; the next output starts on a line of its own.
    pub fn finish(&self) {
        self.bar.abandon();
    }
}

/// The time that is left, behind a comma; nothing where it is not known yet, or there is next to none.
fn left_text(left: Duration) -> String {
    if left.as_millis() < 50 { String::new() } else { format!(", {} left", duration_text(left)) }
}

/// One line of the table at the end of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// The quantity, such as `kinetic energy`.
    pub name: String,
    /// Its unit, such as `J`; empty for a number.
    pub unit: String,
    /// Its value before the first step; `None` if it was not measured.
    pub initial: Option<f64>,
    /// Its value after the last step; `None` if it was not measured.
    pub last: Option<f64>,
    /// How far it has come from where it should have stayed; `None` if the model does not keep it.
    pub drift: Option<f64>,
}

/// The table of diagnostics, ready to be printed: quantity, unit, initial and final value to six significant
/// digits, and the drift of what is conserved. Lines do not end in blanks; there is no line end after the
/// last.
#[must_use]
pub fn summary(diagnostics: &[Diagnostic]) -> String {
    let text = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| significant(value, 6));
    let has_drift = diagnostics.iter().any(|diagnostic| diagnostic.drift.is_some());
    let columns = if has_drift { 5 } else { 4 };
    let header = ["quantity", "unit", "initial", "final", "drift"].into_iter().take(columns);
    let rows = diagnostics.iter().map(|Diagnostic { name, unit, initial, last, drift }| {
        let drift = drift.map_or_else(String::new, |drift| significant(drift, 2));
        let row = [name.clone(), unit.clone(), text(*initial), text(*last), drift];
        row.into_iter().take(columns).collect::<Vec<_>>()
    });
    table(header.collect::<Vec<_>>(), rows, &[2, 3, 4])
}

#[cfg(test)]
mod tests {
    use super::*;
    use indicatif::TermLike;
    use std::io;
    use std::sync::{Arc, Mutex};

    /// A terminal that keeps what is written to it.
    #[derive(Debug, Clone, Default)]
    struct Paper(Arc<Mutex<String>>);

    impl TermLike for Paper {
        fn width(&self) -> u16 {
            100
        }
        fn move_cursor_up(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_down(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_right(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_left(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn write_line(&self, text: &str) -> io::Result<()> {
            self.write_str(&format!("{text}\n"))
        }
        fn write_str(&self, text: &str) -> io::Result<()> {
            self.0.lock().unwrap().push_str(text);
            Ok(())
        }
        fn clear_line(&self) -> io::Result<()> {
            self.write_str("\r")
        }
        fn flush(&self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn the_line_shows_steps_rate_and_time_left() {
        let paper = Paper::default();
        let progress = Progress::on(Some(200), ProgressDrawTarget::term_like(Box::new(paper.clone())));
        progress.at(50);
        progress.message("writing");
        progress.at(100);
        progress.finish();
        let text = paper.0.lock().unwrap().clone();
        let line = text.rsplit('\r').find(|line| !line.trim().is_empty()).unwrap();
        assert!(line.contains("100/200 steps, "), "{text}");
        assert!(line.contains(" steps/s") && line.trim_end().ends_with("  writing"), "{line}");
        assert_eq!(left_text(Duration::from_secs(42)), ", 42 s left");
        assert_eq!(left_text(Duration::from_millis(30)), "");
        let spinner = Progress::on(None, ProgressDrawTarget::term_like(Box::new(paper.clone())));
        spinner.at(7);
        spinner.finish();
        assert!(paper.0.lock().unwrap().contains(" 7 steps, "));
    }

    #[test]
    fn a_hidden_line_is_no_trouble() {
        let progress = Progress::hidden();
        progress.at(3);
        assert_eq!(progress.suspend(|| 7), 7);
        progress.finish();
    }

    #[test]
    fn the_table_is_aligned() {
        let line = |name: &str, unit: &str, initial, last| Diagnostic {
            name: name.to_owned(),
            unit: unit.to_owned(),
            initial,
            last,
            drift: None,
        };
        let table = summary(&[
            line("particles", "", Some(2602.0), Some(2602.0)),
            line("kinetic energy", "J", Some(0.0), Some(0.011_240_501)),
            line("largest overlap", "m", None, Some(1.2345678e-7)),
        ]);
        let expected = " quantity          unit   initial        final
───────────────────────────────────────────────
 particles                   2602         2602
 kinetic energy    J            0    0.0112405
 largest overlap   m            -   1.23457e-7";
        assert_eq!(table, expected);
        let mut kept = line("volume", "m^3", Some(10.0), Some(10.0));
        kept.drift = Some(-1.26e-15);
        let expected = " quantity   unit   initial   final      drift
──────────────────────────────────────────────
 volume     m^3         10      10   -1.3e-15
 contacts                0      12";
        assert_eq!(summary(&[kept, line("contacts", "", Some(0.0), Some(12.0))]), expected);
    }
}
