//! The command line of a model's program.

mod arguments;
mod choice;
mod clashes;
mod compare;
mod config;
mod definition;
mod engine;
mod help;
mod initial;
mod inspect;
mod list;
mod look;
mod new;
mod outcome;
mod parse;
mod prepare;
mod render;
mod resume;
mod run;
mod subcommands;
mod sweep;
mod under_way;
mod voice;
mod watch;
mod working_directory;

pub use config::ConfigError;

use crate::engines::{EngineKind, Engines};
use crate::interrupt::EXIT_INTERRUPTED;
use crate::launcher;
use crate::program::{Given, Program};
use crate::terminal;
use clap::Command;
use definition::{Definition, SetUpModel};
use outcome::{Ended, Unable};
use parse::Invocation;
use std::ffi::OsString;
use std::fmt;
use std::panic::{self, AssertUnwindSafe};
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};
use std::thread;
use xca_record::{Failure, SetUp};

/// The exit code of a run that failed.
const FAILED: u8 = 1;
/// The exit code of a run that could not begin.
const REFUSED: u8 = 2;
/// The exit code of a comparison whose engines do not agree.
const DIFFERENT: u8 = 3;

/// The whole of a program: reads the command line, runs the model, reports.
///
/// `fn main() -> ExitCode { xca_run::main!(MyModel) }` is all that a model's program needs beside its
/// [`Program`](crate::Program). The version of the program is that of the crate that this is written in.
/// Errors are shown as one line and the lines of their causes; the exit codes are those that `--help` lists.
#[macro_export]
macro_rules! main {
    ($program:ty) => {
        $crate::CommandLine::of::<$program>(::core::env!("CARGO_PKG_VERSION")).main()
    };
}

/// As [`main!`], of a model that has no options of its own: its name, a line about it, and how it is made.
#[macro_export]
macro_rules! main_of {
    ($name:expr, $about:expr, $set_up:expr $(,)?) => {
        $crate::CommandLine::of_model($name, $about, ::core::env!("CARGO_PKG_VERSION"), $set_up).main()
    };
}

/// The command line of a model's program. [`main!`] and [`main_of!`] are the short ways to one with the
/// engines of the framework.
pub struct CommandLine<'a> {
    name: &'static str,
    about: &'static str,
    version: &'static str,
    examples: &'static str,
    options: fn(Command) -> Command,
    set_up: Box<SetUpModel<'a>>,
    engines: Engines,
}

impl fmt::Debug for CommandLine<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, version, engines, .. } = self;
        f.debug_struct("CommandLine")
            .field("name", name)
            .field("version", version)
            .field("engines", engines)
            .finish_non_exhaustive()
    }
}

impl<'a> CommandLine<'a> {
    /// That of a program, whose version is mostly `env!("CARGO_PKG_VERSION")`.
    pub fn of<P: Program>(version: &'static str) -> Self {
        Self {
            name: P::NAME,
            about: P::ABOUT,
            version,
            examples: P::EXAMPLES,
            options: P::augment_args,
            set_up: Box::new(|matches, given| {
                let program = P::from_arg_matches(matches).map_err(Unable::CommandLine)?;
                program.set_up(given).map_err(Unable::Refused)
            }),
            engines: Engines::default(),
        }
    }

    /// That of a model without options of its own.
    pub fn of_model(
        name: &'static str,
        about: &'static str,
        version: &'static str,
        set_up: impl Fn(Given) -> Result<SetUp, Failure> + 'a,
    ) -> Self {
        Self {
            name,
            about,
            version,
            examples: "--steps 500 --engine reference",
            options: std::convert::identity,
            set_up: Box::new(move |_, given| set_up(given).map_err(Unable::Refused)),
            engines: Engines::default(),
        }
    }

    /// Offers another kind of engine. It takes the place of one with the same name.
    #[must_use]
    pub fn engine(mut self, kind: impl EngineKind + 'static) -> Self {
        self.engines = self.engines.with(kind);
        self
    }

    /// Reads the arguments of the process, does what they say, and tells how it went.
    pub fn main(self) -> ExitCode {
        main_of(&self.definition())
    }

    /// Reads arguments, with the configuration that they name. Runs nothing, but gives what `inspect` would
    /// print.
    ///
    /// # Errors
    /// What [`CommandLine::main`] would print.
    #[doc(hidden)]
    pub fn read(&self, arguments: &[OsString]) -> Result<String, Failure> {
        let text = match parse::invocation(&self.definition(), arguments) {
            Ok(Invocation::Inspect(definition, arguments)) => inspect::text(definition, &arguments),
            other => other.map(|_| String::new()),
        };
        text.map_err(Unable::into_failure)
    }

    fn definition(&self) -> Definition<'_> {
        let Self { name, about, version, examples, options, set_up, engines } = self;
        let (name, about, version, examples) = (*name, *about, *version, *examples);
        Definition { name, about, version, examples, options: *options, set_up: &**set_up, engines }
    }
}

fn main_of(definition: &Definition<'_>) -> ExitCode {
    xca_machine::return_large_pieces();
    let arguments: Vec<OsString> = std::env::args_os().collect();
    let panics = Panics::caught();
    // After a panic nothing of the definition is used.
    let all = AssertUnwindSafe(|| execute(parse::invocation(definition, &arguments)?));
    let ended = panic::catch_unwind(all);
    if launcher::is_silent() && !matches!(ended, Ok(Ok(_))) {
        thread::sleep(launcher::PATIENCE);
    }
    match ended {
        Ok(Ok(Ended::Done)) => ExitCode::SUCCESS,
        Ok(Ok(Ended::Different)) => ExitCode::from(DIFFERENT),
        Ok(Ok(Ended::Interrupted)) => ExitCode::from(EXIT_INTERRUPTED),
        Ok(Err(Unable::Refused(error))) => {
            terminal::complain(&*error);
            ExitCode::from(REFUSED)
        }
        Ok(Err(Unable::RefusedOffering(error, other))) => {
            terminal::complain(&*error);
            terminal::remark(&other);
            ExitCode::from(REFUSED)
        }
        Ok(Err(Unable::Failed(error))) => {
            terminal::complain(&*error);
            ExitCode::from(FAILED)
        }
        Ok(Err(Unable::FailedLeaving(error, left))) => {
            terminal::complain(&*error);
            terminal::remark(&left);
            ExitCode::from(FAILED)
        }
        // Help is printed once.
        Ok(Err(Unable::CommandLine(error))) if launcher::is_silent() && !error.use_stderr() => {
            ExitCode::SUCCESS
        }
        Ok(Err(Unable::CommandLine(error))) => {
            let shown = terminal::show(&error);
            match shown {
                _ if error.use_stderr() => ExitCode::from(REFUSED),
                Ok(()) => ExitCode::SUCCESS,
                Err(error) => {
                    terminal::complain(&error);
                    ExitCode::from(FAILED)
                }
            }
        }
        Err(_) => {
            terminal::remark(&format!("error: {}", panics.last()));
            ExitCode::from(FAILED)
        }
    }
}

fn execute(invocation: Invocation<'_>) -> Result<Ended, Unable> {
    match invocation {
        Invocation::Run(invocation) => run::run(*invocation),
        Invocation::Render(run, arguments) => render::render(&run, &arguments),
        Invocation::Draw(definition, path, arguments, command_line) => {
            render::draw(definition, &path, &arguments, &command_line)
        }
        Invocation::Watch(run, arguments) => watch::watch(&run, &arguments),
        Invocation::New(arguments) => new::new(&arguments),
        Invocation::List(choice, arguments) => list::list(&choice, &arguments),
        Invocation::Compare(choice, arguments, options, command_line) => {
            compare::compare(&choice, *arguments, &options, command_line)
        }
        Invocation::Sweep(choice, on, arguments) => sweep::sweep(&choice, on, arguments),
        Invocation::Inspect(definition, arguments) => inspect::inspect(definition, &arguments),
        Invocation::Resume(definition, arguments, on) => resume::resume(definition, &arguments, &on),
    }
}

/// The last panic's message. A panic is a mistake in the program; its user should read a sentence, not a
/// trace, unless he asks for one.
struct Panics;

static LAST_PANIC: Mutex<Option<String>> = Mutex::new(None);

impl Panics {
    /// From now on panics are kept, not shown. With `RUST_BACKTRACE` they are shown as always.
    fn caught() -> Self {
        if std::env::var_os("RUST_BACKTRACE").is_none() {
            panic::set_hook(Box::new(|info| {
                let payload = info.payload();
                let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
                let text = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
                let place = info.location().map(|place| format!(" ({}:{})", place.file(), place.line()));
                let text = format!("{text}{}", place.unwrap_or_default());
                *LAST_PANIC.lock().unwrap_or_else(PoisonError::into_inner) = Some(text);
            }));
        }
        Self
    }

    fn last(&self) -> String {
        let last = LAST_PANIC.lock().unwrap_or_else(PoisonError::into_inner).take();
        format!("a mistake in the program: {}", last.as_deref().unwrap_or("see above"))
    }
}
