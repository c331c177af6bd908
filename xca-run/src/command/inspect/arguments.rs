//! The options of `inspect`, and its help.

use crate::command::definition::Definition;
use crate::command::help::with_help;
use clap::{Args, Command};
use std::path::PathBuf;

pub(in crate::command) const NAME: &str = "inspect";

const ABOUT: &str = "Show what a run or a checkpoint holds";

/// What is looked at, and how it is told.
#[derive(Args, Debug, Clone)]
pub(in crate::command) struct InspectArguments {
    /// Output directory of a run, or a checkpoint. Shows the state of the latest checkpoint, or else of the
    /// last frames
    #[arg(value_name = "DIR|CHECKPOINT")]
    pub(super) path: PathBuf,

    /// Show the values of this cell and of its items
    #[arg(long, value_name = "X,Y,Z", value_parser = cell)]
    pub(super) cell: Option<[usize; 3]>,

    /// Show the values of the items with this label
    #[arg(long, value_name = "N")]
    pub(super) label: Option<u32>,

    /// Print JSON
    #[arg(long)]
    pub(super) json: bool,
}

pub(in crate::command) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let examples = [
        format!("{name} inspect out/{name}"),
        format!("{name} inspect out/{name}/checkpoints/step_00000500.checkpoint --cell 3,4,0"),
        format!("{name} inspect out/{name} --label 17 --json"),
    ];
    with_help(InspectArguments::augment_args(Command::new(NAME)), ABOUT, &examples)
}

fn cell(text: &str) -> Result<[usize; 3], &'static str> {
    const WANTED: &str = "a cell is three whole numbers, such as 3,4,0";
    let indices: Result<Vec<usize>, _> = text.split(',').map(|index| index.trim().parse()).collect();
    indices.map_err(|_| WANTED)?.try_into().map_err(|_| WANTED)
}
