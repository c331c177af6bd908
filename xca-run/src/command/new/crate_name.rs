//! Names that cargo, or the crate that `new` writes, cannot have.

/// Why a text cannot be the name of a crate.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub(super) enum NameError {
    #[error(
        "the name of a crate has small letters, digits, `-` and `_`, begins with a letter, \
         and has at most 64 characters, such as waves"
    )]
    Form,
    #[error("`{0}` is a keyword of Rust; give another name, such as {0}-model")]
    Keyword(String),
    #[error("`{0}` is a folder that cargo builds in; give another name, such as {0}-model")]
    BuildFolder(String),
    #[error("`{0}` is the name of a device on Windows; give another name, such as {0}-model")]
    Device(String),
    #[error("`{0}` is a crate or module that the new crate uses; give another name, such as {0}-model")]
    Used(String),
}

const KEYWORDS: &str = "abstract as async await become box break const continue crate do dyn else enum extern \
    false final fn for gen if impl in let loop macro match mod move mut override priv pub ref return self static \
    struct super trait true try type typeof unsafe unsized use virtual where while yield";

const BUILD_FOLDERS: &str = "build deps examples incremental";

const DEVICES: &str = "aux con nul prn com0 com1 com2 com3 com4 com5 com6 com7 com8 com9 \
    lpt0 lpt1 lpt2 lpt3 lpt4 lpt5 lpt6 lpt7 lpt8 lpt9";

/// Crates of Rust and of this workspace, and modules of the prelude.
const USED: &str = "alloc core proc_macro std test xca xca_core xca_run clap directions";

/// Reads the name of a crate.
///
/// # Errors
/// If cargo refuses the name, or the crate that is written would not compile under it.
pub(super) fn crate_name(text: &str) -> Result<String, NameError> {
    let is_allowed = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"-_".contains(&byte);
    let begins_well = text.starts_with(|first: char| first.is_ascii_lowercase());
    if !begins_well || text.len() > 64 || !text.bytes().all(is_allowed) {
        return Err(NameError::Form);
    }
    let module = text.replace('-', "_");
    let is_in = |words: &str| words.split_whitespace().any(|word| word == module);
    let name = text.to_owned();
    if is_in(KEYWORDS) {
        Err(NameError::Keyword(name))
    } else if is_in(BUILD_FOLDERS) {
        Err(NameError::BuildFolder(name))
    } else if is_in(DEVICES) {
        Err(NameError::Device(name))
    } else if is_in(USED) {
        Err(NameError::Used(name))
    } else {
        Ok(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_crates() {
        for name in ["waves", "w", "excitable-medium_2", "console", "tests"] {
            assert_eq!(crate_name(name).as_deref(), Ok(name));
        }
        for name in ["", "2d", "-x", "Waves", "a b", "a/b", "..", "wåves", &"w".repeat(65)] {
            assert_eq!(crate_name(name), Err(NameError::Form), "{name}");
        }
    }

    #[test]
    fn names_with_another_meaning_are_refused_with_the_reason() {
        for (name, reason) in [
            ("fn", "keyword"),
            ("gen", "keyword"),
            ("deps", "cargo builds in"),
            ("incremental", "cargo builds in"),
            ("con", "device on Windows"),
            ("com7", "device on Windows"),
            ("test", "crate or module"),
            ("proc-macro", "crate or module"),
            ("xca-core", "crate or module"),
        ] {
            let error = crate_name(name).unwrap_err().to_string();
            assert!(error.contains(reason) && error.contains(&format!("{name}-model")), "{error}");
            assert!(crate_name(&format!("{name}-model")).is_ok());
        }
    }
}
