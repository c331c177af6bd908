//! Engines as the command line names them.

use crate::engines::{EngineError, EngineKind, EngineOptions, Engines};
use std::time::Instant;
use xca_compare::Contender;
use xca_core::{Precision, UnknownPrecision};

/// An engine with what it is given: `reference`, `cpu:2`, `gpu:NVIDIA`, `cpu@f32`.
#[derive(Debug)]
pub(crate) struct Choice<'a> {
    text: String,
    kind: &'a dyn EngineKind,
    options: EngineOptions,
    precision: Option<Precision>,
}

/// A text that names no engine.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ChoiceError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    Precision(#[from] UnknownPrecision),
    #[error("there is nothing to choose of the {0} engine by a colon")]
    Nothing(&'static str),
}

impl<'a> Choice<'a> {
    pub(crate) fn new(text: &str, engines: &'a Engines) -> Result<Self, ChoiceError> {
        let text = text.trim();
        let (engine, precision) = match text.rsplit_once('@') {
            Some((engine, precision)) => (engine, Some(precision.parse()?)),
            None => (text, None),
        };
        let (name, which) = match engine.split_once(':') {
            Some((name, which)) => (name, Some(which)),
            None => (engine, None),
        };
        let kind = engines.kind(name)?;
        let mut options = EngineOptions::default();
        if let Some(which) = which {
            let option = kind.options().first().ok_or(ChoiceError::Nothing(kind.name()))?;
            options = options.with(option.name, which);
        }
        Ok(Self { text: text.to_owned(), kind, options, precision })
    }

    /// Whether the engine has this option.
    pub(crate) fn knows(&self, option: &str) -> bool {
        self.kind.options().iter().any(|own| own.name == option)
    }

    /// Makes the engine. Where it does not say so itself, `Real` is `precision`, and `options` are chosen as far as it knows them.
    pub(crate) fn contender(
        &self,
        engines: &Engines,
        options: &EngineOptions,
        precision: Precision,
    ) -> Result<Contender, EngineError> {
        let mut chosen = self.options.clone();
        for (option, value) in options.iter().filter(|(option, _)| self.knows(option)) {
            if chosen.get(option).is_none() {
                chosen = chosen.with(option, value);
            }
        }
        let begin = Instant::now();
        let engine = engines.engine(self.kind.name(), &chosen)?;
        let precision = self.precision.unwrap_or(precision);
        Ok(Contender { name: self.text.clone(), engine, precision, making: begin.elapsed() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn engines_are_named_with_what_they_are_given() {
        let (engines, none) = (Engines::default(), EngineOptions::default());
        let choice = Choice::new("cpu:3@f32", &engines).unwrap();
        let contender =
            choice.contender(&engines, &none.clone().with("threads", "1"), Precision::F64).unwrap();
        assert_eq!((contender.engine.name(), contender.engine.threads()), ("cpu", 3));
        assert_eq!((contender.precision, contender.name.as_str()), (Precision::F32, "cpu:3@f32"));
        let choice = Choice::new("gpu:llvm pipe", &engines).unwrap();
        assert_eq!(choice.options.get("adapter"), Some("llvm pipe"));
        let choice = Choice::new(" reference ", &engines).unwrap();
        let unheeded = none.with("arithmetic", "strict");
        assert_eq!(choice.contender(&engines, &unheeded, Precision::F64).unwrap().name, "reference");
    }

    #[test]
    fn what_is_no_engine_is_told() {
        let engines = Engines::default();
        for (text, wanted) in [
            ("cup", "there is no engine `cup`; there are cpu, gpu, parts, reference"),
            ("cpu@f16", "`f16` is not a precision"),
            ("reference:2", "nothing to choose of the reference engine"),
        ] {
            let error = Choice::new(text, &engines).unwrap_err().to_string();
            assert!(error.contains(wanted), "{error}");
        }
        for (text, wanted) in [("cpu:0", "0 threads do nothing"), ("cpu:two", "it must be a whole number")] {
            let choice = Choice::new(text, &engines).unwrap();
            let error = choice.contender(&engines, &EngineOptions::default(), Precision::F64).unwrap_err();
            assert!(error.to_string().contains(wanted), "{error}");
        }
    }
}
