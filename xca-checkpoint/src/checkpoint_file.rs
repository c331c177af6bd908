//! A checkpoint whose state is read when it is needed.

use crate::file::{self, Opened, unread};
use crate::planes::{BLOCK, read_block, size_of_numbers};
use crate::{Checkpoint, CheckpointError, Description};
use std::fs::File;
use std::io::{self, BufReader, Seek};
use std::path::{Path, PathBuf};
use xca_core::engine::Plane;
use xca_core::{Engine, Model, RunError, RunOptions, Simulation};
use xca_io::regular_file;

/// A checkpoint whose description has been read, and whose state is still in the file. A file that another
/// run replaces meanwhile stays what it was.
#[derive(Debug)]
pub struct CheckpointFile {
    path: PathBuf,
    file: File,
    description: Description,
    /// The place of the data in the file.
    start: u64,
}

/// A run that cannot resume from a checkpoint.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The file could not be read.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// The engine cannot run the model, or the state is that of another model.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl Checkpoint {
    /// Reads a file. A damaged file is an error.
    pub fn read(path: &Path) -> Result<Self, CheckpointError> {
        CheckpointFile::open(path)?.read()
    }
}

impl CheckpointFile {
    /// Opens a file, and checks that it is whole.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read, is no checkpoint, or is damaged.
    pub fn open(path: &Path) -> Result<Self, CheckpointError> {
        let failed = |source| CheckpointError::Read { path: path.to_owned(), source };
        let file = regular_file::open(path).map_err(failed)?;
        let found = file.metadata().map_err(failed)?.len();
        let Opened { description, start } = file::open(path, &mut buffered(&file), found)?;
        Ok(Self { path: path.to_owned(), file, description, start })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The run and the step.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Reads the whole state.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read, or its data do not match its description.
    pub fn read(self) -> Result<Checkpoint, CheckpointError> {
        let file = self.data().map_err(|error| unread(&self.path, error))?;
        let snapshot = file::read(&self.path, &self.description, file)?;
        Ok(Checkpoint { description: self.description, snapshot })
    }

    /// Starts a model on an engine in this state. Cells go to the engine block by block, if it takes rows.
    ///
    /// # Errors
    /// As [`Self::read`], and as [`Simulation::resume_blocks`].
    pub fn resume(
        &self,
        model: &Model,
        engine: &dyn Engine,
        options: RunOptions,
    ) -> Result<Simulation, ResumeError> {
        let mut file = self.data().map_err(|error| unread(&self.path, error))?;
        let read = |plane: Plane, block: &mut [u8]| {
            let size = size_of_numbers(&self.description, plane).unwrap_or(1);
            let read = read_block(&mut file, size, block);
            read.map_err(|error| ResumeError::Checkpoint(unread(&self.path, error)))
        };
        Simulation::resume_blocks(model, engine, options, &self.description.outline(), BLOCK, read)
    }

    /// The data of the file.
    fn data(&self) -> io::Result<BufReader<&File>> {
        let mut file = buffered(&self.file);
        file.seek(io::SeekFrom::Start(self.start))?;
        Ok(file)
    }
}

fn buffered(file: &File) -> BufReader<&File> {
    BufReader::with_capacity(1 << 18, file)
}
