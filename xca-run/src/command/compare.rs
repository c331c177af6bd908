//! The subcommand `compare`.

use super::arguments::{interval, steps};
use super::choice::Choice as ModelChoice;
use super::definition::Definition;
use super::engine::{help, with_shared_options};
use super::help::{with_help, with_model};
use super::outcome::{Ended, Unable};
use super::prepare::warn;
use super::voice::Voice;
use crate::contender::Choice;
use crate::engines::{EngineError, EngineOptions, Engines};
use crate::interrupt::Interrupt;
use crate::options::number_in;
use crate::progress::Progress;
use clap::{Args, Command};
use std::path::PathBuf;
use xca_compare::{CompareError, Comparison};
use xca_compare::{Subject, Verdict};
use xca_core::RunError;
use xca_record::Monitor;
use xca_report::comparison::{self, Files};

pub(super) const NAME: &str = "compare";

const ABOUT: &str = "Run the model on several engines; compare their results bit by bit, and their times";

/// Which engines are compared, and how.
#[derive(Args, Debug, Clone)]
pub(super) struct CompareArguments {
    /// Engines to compare; the first is the reference for the others. Each is written as for --engine of
    /// `run`. A precision can follow: reference, cpu:2, gpu:llvmpipe, parts:3:cpu, cpu@f32
    #[arg(long, value_name = "ENGINE,…", value_delimiter = ',', default_value = "reference,cpu")]
    engines: Vec<String>,

    /// Number of steps [default: the model's]
    #[arg(long, value_name = "N", value_parser = steps)]
    steps: Option<u64>,

    /// Times that each engine is timed
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = repeats)]
    repeats: usize,

    /// Compare the states every N steps, then find the first step that differs [default: 50 times in the
    /// run]
    #[arg(long, value_name = "N", value_parser = interval)]
    check_every: Option<u64>,

    /// Largest difference that counts as rounding, relative to the largest value of the substate [default:
    /// 1e-9, or 1e-4 with f32]
    #[arg(long, value_name = "X", value_parser = number_in(0.0..))]
    tolerance: Option<f64>,

    /// Output directory [default: out/NAME-compare]. Overwrites an earlier comparison
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    #[command(flatten)]
    voice: Voice,
}

fn repeats(text: &str) -> Result<usize, &'static str> {
    text.parse()
        .ok()
        .filter(|number| (1..=1000).contains(number))
        .ok_or("it must be a whole number from 1 to 1000")
}

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let command = with_model(Command::new(NAME), definition).next_help_heading(None::<&str>);
    let examples = [
        format!("{name} compare"),
        format!("{name} compare --engines reference,cpu:1,cpu:2,gpu --steps 200"),
        format!("{name} compare --engines cpu,cpu@f32 --repeats 1"),
    ];
    let command = with_shared_options(CompareArguments::augment_args(command), definition.engines);
    with_help(command, ABOUT, &examples)
}

/// Compares engines.
pub(super) fn compare(
    model: &ModelChoice<'_>,
    arguments: CompareArguments,
    options: &EngineOptions,
    command_line: Vec<String>,
) -> Result<Ended, Unable> {
    let precision = model.arguments.given(None).precision;
    let engines = model.definition.engines;
    let choices = choices(engines, &arguments.engines, options)?;
    for choice in &choices {
        if let Some(helper) = choice.helper().map_err(Unable::Refused)? {
            let given = model.arguments.given(arguments.steps);
            return help(&*helper, || Ok(model.set_up(&given)?.model));
        }
    }
    let contenders = choices.iter().map(|choice| choice.contender(engines, options, precision));
    let contenders = contenders.collect::<Result<Vec<_>, EngineError>>().map_err(Unable::refused)?;
    let given = model.arguments.given(arguments.steps);
    let set_up = model.set_up(&given)?;
    warn(&set_up);
    let definition = model.definition;
    let subject = Subject {
        commit: option_env!("XCA_COMMIT"),
        compiler: option_env!("XCA_COMPILER"),
        program: definition.name.to_owned(),
        version: definition.version.to_owned(),
        title: set_up.title.clone(),
        command_line,
    };
    let comparison = Comparison::new(set_up).map_err(Unable::refused)?;
    let mut comparison = comparison.subject(subject).seed(given.seed).repeats(arguments.repeats);
    if let Some(steps) = given.steps {
        comparison = comparison.steps(steps);
    }
    if let Some(every) = arguments.check_every {
        comparison = comparison.check_every(every);
    }
    if let Some(tolerance) = arguments.tolerance {
        comparison = comparison.tolerance(tolerance);
    }
    let comparison = contenders.into_iter().fold(comparison, Comparison::contender);
    let folder =
        arguments.out.unwrap_or_else(|| PathBuf::from("out").join(format!("{}-compare", definition.name)));
    let files = Files::prepare(&folder, &comparison.set_up().inputs).map_err(Unable::refused)?;
    let interrupt = Interrupt::install().map_err(Unable::failed)?;
    let mut terminal =
        Terminal { line: arguments.voice.line(Some(comparison.work())), interrupt: &interrupt };
    let result = comparison.run(&mut terminal);
    terminal.line.finish();
    let mut comparison = match result {
        Err(CompareError::Interrupted) => return Ok(Ended::Interrupted),
        Err(CompareError::Run(RunError::Start(error))) => return Err(Unable::refused(error)),
        Err(error @ CompareError::Memory(_)) => return Err(Unable::refused(error)),
        result => result.map_err(Unable::failed)?,
    };
    files.write(&mut comparison).map_err(Unable::failed)?;
    let text = || format!("{}\n\n{}", comparison::text(&comparison), files.told());
    arguments.voice.tell(&comparison, text)?;
    Ok(if comparison.verdict == Verdict::Different { Ended::Different } else { Ended::Done })
}

/// The line that shows how many steps are done, and Ctrl-C.
struct Terminal<'a> {
    line: Progress,
    interrupt: &'a Interrupt,
}

impl Monitor for Terminal<'_> {
    fn at(&mut self, step: u64) {
        self.line.at(step);
    }

    fn is_interrupted(&self) -> bool {
        self.interrupt.is_raised()
    }
}

/// The engines that take part. What is chosen for all of them is for those that know it, of which there must
/// be one.
fn choices<'a>(
    engines: &'a Engines,
    named: &[String],
    options: &EngineOptions,
) -> Result<Vec<Choice<'a>>, Unable> {
    let choices = named.iter().map(|text| Choice::new(text, engines)).collect::<Result<Vec<_>, _>>();
    let choices = choices.map_err(Unable::refused)?;
    engines.check(choices.iter().map(Choice::engine), NAME).map_err(Unable::refused)?;
    if let Some((option, _)) = options.iter().find(|(option, _)| !choices.iter().any(|it| it.knows(option))) {
        return Err(Unable::refused(format!("none of the compared engines has --{option}; remove it")));
    }
    Ok(choices)
}

#[cfg(test)]
mod tests;
