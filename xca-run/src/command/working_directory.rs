//! The working directory that a run was begun in: the relative paths of its command line go from there.

use super::outcome::Unable;
use std::env;
use std::path::{Path, PathBuf};

/// The working directory of an earlier run, until this is dropped.
#[derive(Debug)]
pub(super) struct WorkingDirectory {
    /// That of this process, where it is another.
    own: Option<PathBuf>,
}

impl WorkingDirectory {
    /// Goes there; stays here where there is no such folder any more, as on another machine.
    pub(super) fn enter(directory: &str) -> Result<Self, Unable> {
        let directory = Path::new(directory);
        let own = env::current_dir().ok().filter(|own| own != directory && directory.is_dir());
        if own.is_some() {
            env::set_current_dir(directory).map_err(Unable::failed)?;
        }
        Ok(Self { own })
    }

    /// That of this process, as a run tells it; empty where it has none.
    pub(super) fn present() -> String {
        env::current_dir().map(|path| path.display().to_string()).unwrap_or_default()
    }
}

impl Drop for WorkingDirectory {
    fn drop(&mut self) {
        if let Some(own) = &self.own {
            // It was there a moment ago; what is written afterwards has paths of its own.
            let _ = env::set_current_dir(own);
        }
    }
}
