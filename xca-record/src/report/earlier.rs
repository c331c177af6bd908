//! What the report of an earlier run tells: whoever has written or changed it.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};
use xca_checkpoint::Difference;
use xca_io::regular_file;

/// No report has more bytes.
const LONGEST: u64 = 64 << 20;

/// A report that cannot be used.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum ReadReportError {
    #[error("cannot read {}", path.display())]
    Read { path: PathBuf, source: io::Error },
    #[error("{} is not JSON: {message}", path.display())]
    Syntax { path: PathBuf, message: String },
    #[error("{} is not the report of a run: {key}{message}", path.display())]
    Shape { path: PathBuf, key: String, message: String },
}

/// A report, if there is one.
pub fn read(path: &Path) -> Result<Option<Value>, ReadReportError> {
    let bytes = match regular_file::read(path, LONGEST) {
        Err(error) if [io::ErrorKind::NotFound, io::ErrorKind::NotADirectory].contains(&error.kind()) => {
            return Ok(None);
        }
        Err(source) => return Err(ReadReportError::Read { path: path.to_owned(), source }),
        Ok(bytes) => bytes,
    };
    let syntax = |error: serde_json::Error| ReadReportError::Syntax {
        path: path.to_owned(),
        message: error.to_string(),
    };
    serde_json::from_slice(&bytes).map(Some).map_err(syntax)
}

/// The parts of a report that a command wants; the error names the key of the first one that is missing or
/// wrong.
pub fn parts<T: DeserializeOwned>(path: &Path, report: &Value) -> Result<T, ReadReportError> {
    serde_path_to_error::deserialize(report).map_err(|error| {
        let key = match error.path().to_string().as_str() {
            "." => String::new(),
            key => format!("`{key}`: "),
        };
        ReadReportError::Shape { path: path.to_owned(), key, message: error.into_inner().to_string() }
    })
}

/// What a report tells of a run before it was resumed; all nothing where there is no such file.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub struct Earlier {
    /// The version of the framework; its presence says whose report this is.
    pub xca: Option<String>,
    /// The name of the program.
    pub program: Option<String>,
    command_line: Option<Vec<String>>,
    pub(super) started: Option<String>,
    pub(super) resumed: Vec<Value>,
    progress: EarlierProgress,
    /// What was written below the folder.
    pub files: Vec<String>,
}

/// What the run had taken when this was written last: after its last checkpoint, or at its end.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub struct EarlierProgress {
    outcome: String,
    reason: Option<String>,
    /// How many steps were done.
    pub steps: u64,
    /// How many were to be done, which may be more than the checkpoint tells.
    pub steps_wanted: Option<u64>,
    pub set_up_seconds: f64,
    pub step_seconds: f64,
    pub wall_seconds: f64,
}

impl Earlier {
    /// Reads a report, if there is one.
    pub fn read(path: &Path) -> Result<Option<Self>, ReadReportError> {
        read(path)?.map(|report| parts(path, &report)).transpose()
    }

    /// Whether it is the report of what this subcommand did.
    pub fn is_of(&self, subcommand: &str) -> bool {
        self.command_line.as_ref().and_then(|words| words.get(1)).is_some_and(|word| word == subcommand)
    }

    /// Whether there is nothing left to do.
    pub fn has_ended(&self) -> bool {
        ["done", "stopped"].contains(&self.progress.outcome.as_str())
    }

    /// Why the model has stopped the run, if it has.
    pub fn stop_reason(&self) -> Option<&str> {
        self.progress.reason.as_deref().filter(|_| self.progress.outcome == "stopped")
    }

    /// How this is the report of another run than one with this command line.
    pub fn difference(&self, command_line: &[String]) -> Option<Difference> {
        let own = self.command_line.as_ref().filter(|own| *own != command_line)?;
        Some(Difference { what: "command line", found: command_line.join(" "), wanted: own.join(" ") })
    }

    /// What the run had taken.
    pub fn taken(&self) -> &EarlierProgress {
        &self.progress
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_of_another_shape_are_refused_with_the_key() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.json");
        assert!(Earlier::read(&path).unwrap().is_none());
        for (text, wanted) in [
            (r#"{"progress": 5}"#, "`progress`: invalid type: integer `5`, expected an object"),
            (r#"{"progress": {"step_seconds": "x"}}"#, "`progress.step_seconds`: invalid type: string"),
            (r#"{"files": ["a", 7]}"#, "`files[1]`: invalid type: integer `7`"),
            (r#"{"command_line": {}}"#, "`command_line`: invalid type: map"),
            ("7", "run.json is not the report of a run: invalid type: integer `7`"),
            ("{", "run.json is not JSON: EOF"),
        ] {
            std::fs::write(&path, text).unwrap();
            let error = Earlier::read(&path).unwrap_err().to_string();
            assert!(error.contains(wanted), "{error}");
        }
        std::fs::write(&path, r#"{"xca": "1", "notes": 5, "progress": {"outcome": "done"}}"#).unwrap();
        assert!(Earlier::read(&path).unwrap().unwrap().has_ended());
    }
}
