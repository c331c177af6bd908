//! Engines as the command line names them, in one word: `cpu`, `cpu:2`, `gpu:NVIDIA`, `parts:3:cpu`.

use super::kind::EngineDetail;
use super::options::EngineOptions;
use super::{EngineError, EngineKind, Engines};

/// An engine as it is chosen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct EngineChoice {
    pub(crate) name: String,
    pub(crate) options: EngineOptions,
}

/// What words a program understands. It holds no engine, so that a parser of the command line can own it.
#[derive(Debug, Clone)]
pub(crate) struct EngineWords {
    kinds: Vec<KindWords>,
}

/// A kind of engine, as far as its words are concerned.
#[derive(Debug, Clone, Copy)]
struct KindWords {
    name: &'static str,
    about: &'static str,
    detail: Option<EngineDetail>,
}

impl KindWords {
    fn new(kind: &dyn EngineKind) -> Self {
        Self { name: kind.name(), about: kind.about(), detail: kind.detail() }
    }

    /// `cpu[:N]`.
    fn form(&self) -> String {
        let name = self.name;
        match self.detail {
            None => name.to_owned(),
            Some(EngineDetail { option, is_required: true }) => format!("{name}:{}", option.value_name),
            Some(EngineDetail { option, .. }) => format!("{name}[:{}]", option.value_name),
        }
    }
}

impl EngineWords {
    pub(crate) fn new(engines: &Engines) -> Self {
        Self { kinds: engines.kinds().map(KindWords::new).collect() }
    }

    /// The forms of all words.
    pub(crate) fn forms(&self) -> String {
        self.kinds.iter().map(KindWords::form).collect::<Vec<_>>().join(", ")
    }

    /// A line about each kind.
    pub(crate) fn about(&self) -> String {
        let forms: Vec<String> = self.kinds.iter().map(KindWords::form).collect();
        let width = forms.iter().map(String::len).max().unwrap_or(0);
        let line = |(form, kind): (&String, &KindWords)| format!("- {form:width$}  {}", kind.about);
        forms.iter().zip(&self.kinds).map(line).collect::<Vec<_>>().join("\n")
    }

    /// Reads a word.
    ///
    /// # Errors
    /// Where it names no engine, or what stands after the colon makes no sense.
    pub(crate) fn parse(&self, word: &str) -> Result<EngineChoice, EngineError> {
        let word = word.trim();
        let (name, rest) = word.split_once(':').map_or((word, None), |(name, rest)| (name, Some(rest)));
        let kind = self.kinds.iter().find(|kind| kind.name == name);
        let kind = kind.ok_or_else(|| EngineError::Unknown { name: name.to_owned(), known: self.forms() })?;
        let wrong = |reason: String| EngineError::Word { word: word.to_owned(), reason };
        let options = EngineOptions::default();
        let options = match (kind.detail, rest) {
            (None, Some(_)) => return Err(wrong(format!("the {name} engine takes nothing after a colon"))),
            (Some(detail), None) if detail.is_required => {
                return Err(wrong(format!("write {}", kind.form())));
            }
            (Some(_), Some("")) => {
                return Err(wrong(format!("the value after the colon is missing; write {}", kind.form())));
            }
            (Some(EngineDetail { option, .. }), Some(value)) => {
                (option.check)(value).map_err(wrong)?;
                options.with(option.name, value)
            }
            (_, None) => options,
        };
        Ok(EngineChoice { name: name.to_owned(), options })
    }
}

impl EngineChoice {
    /// With options that are given beside the word.
    ///
    /// # Errors
    /// Where the word says the same already.
    pub(crate) fn with(self, others: &EngineOptions) -> Result<Self, EngineError> {
        if let Some((option, _)) = others.iter().find(|(option, _)| self.options.get(option).is_some()) {
            return Err(EngineError::Twice { engine: self.name, option: option.to_owned() });
        }
        Ok(Self { name: self.name, options: self.options.or(others) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_engines_with_what_they_are_given() {
        let words = EngineWords::new(&Engines::default());
        let chosen = |word: &str, option: &str| {
            let choice = words.parse(word).unwrap();
            (choice.name, choice.options.get(option).map(str::to_owned))
        };
        let with = |name: &str, value: &str| (name.to_owned(), Some(value.to_owned()));
        assert_eq!(chosen("cpu", "threads"), ("cpu".to_owned(), None));
        assert_eq!(chosen("cpu:3", "threads"), with("cpu", "3"));
        assert_eq!(chosen("gpu:llvm pipe", "adapter"), with("gpu", "llvm pipe"));
        assert_eq!(chosen(" parts:3:cpu:2 ", "parts"), with("parts", "3:cpu:2"));
        assert_eq!(chosen("reference", "threads"), ("reference".to_owned(), None));
    }

    #[test]
    fn what_is_no_word_is_told_with_its_form() {
        let words = EngineWords::new(&Engines::default());
        for (word, wanted) in [
            ("cup", "unknown engine `cup`; there are cpu[:N], gpu[:N|NAME], "),
            ("cpu:0", "engine `cpu:0`: the number of threads must be at least 1"),
            ("cpu:two", "it must be a whole number"),
            ("cpu:", "the value after the colon is missing; write cpu[:N]"),
            ("reference:2", "the reference engine takes nothing after a colon"),
            ("parts", "engine `parts`: write parts:N:cpu[:THREADS]"),
            ("parts:3", "say what runs each part: parts:3:cpu"),
            ("parts:0:cpu", "whole number from 1"),
            ("parts:3:mpi", "a part runs on the cpu or the gpu engine, not on `mpi`"),
        ] {
            let said = words.parse(word).unwrap_err().to_string();
            assert!(said.contains(wanted), "{word}: {said}");
        }
    }

    #[test]
    fn nothing_is_said_twice() {
        let words = EngineWords::new(&Engines::default());
        let threads = EngineOptions::default().with("threads", "3");
        assert_eq!(words.parse("cpu").unwrap().with(&threads).unwrap().options, threads);
        let said = words.parse("cpu:2").unwrap().with(&threads).unwrap_err().to_string();
        assert_eq!(said, "--threads is given twice, also after the colon of the cpu engine; remove one");
    }
}
