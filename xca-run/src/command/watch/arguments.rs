//! The options of `watch`.

use crate::command::arguments::{RunArguments, interval, steps};
use crate::command::look::LookArguments;
use crate::command::voice::Voice;
use clap::Args;

/// What is watched.
#[derive(Args, Debug, Clone)]
pub(in crate::command) struct WatchArguments {
    /// Stop after N steps [default: when the model stops]
    #[arg(long, value_name = "N", value_parser = steps)]
    pub(super) steps: Option<u64>,

    /// Draw every N steps, and at least every half second [default: 1/1000 of the model's steps]
    #[arg(long, value_name = "N", value_parser = interval)]
    pub(super) every: Option<u64>,

    /// Maximum number of pictures per second
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u16).range(1..=60))]
    pub(super) fps: u16,

    #[command(flatten)]
    pub(super) look: LookArguments,
}

impl WatchArguments {
    /// What a run would be told.
    pub(in crate::command) fn as_of_run(&self) -> RunArguments {
        RunArguments {
            steps: self.steps,
            out: None,
            every: None,
            checkpoint_every: None,
            formats: Vec::new(),
            allow_non_finite: true,
            overwrite: false,
            print_source: false,
            voice: Voice::default(),
        }
    }
}
