//! Engines as the command line names them.

use crate::engines::{EngineChoice, EngineError, EngineKind, EngineOptions, EngineWords, Engines, Helper};
use std::time::Instant;
use xca_compare::Contender;
use xca_core::{Precision, UnknownPrecision};
use xca_record::Failure;

/// An engine with a precision: `reference`, `cpu:2`, `gpu:NVIDIA`, `cpu@f32`.
#[derive(Debug)]
pub(crate) struct Choice<'a> {
    text: String,
    kind: &'a dyn EngineKind,
    engine: EngineChoice,
    precision: Option<Precision>,
}

/// A text that names no engine.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ChoiceError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    Precision(#[from] UnknownPrecision),
}

impl<'a> Choice<'a> {
    pub(crate) fn new(text: &str, engines: &'a Engines) -> Result<Self, ChoiceError> {
        let text = text.trim();
        let (word, precision) = text.rsplit_once('@').map_or((text, None), |(word, end)| (word, Some(end)));
        let precision = precision.map(str::parse).transpose()?;
        let engine = EngineWords::new(engines).parse(word)?;
        Ok(Self { text: text.to_owned(), kind: engines.kind(&engine.name)?, engine, precision })
    }

    /// The name of the engine.
    pub(crate) fn engine(&self) -> &'static str {
        self.kind.name()
    }

    /// What this process does where it is only there to help another one.
    pub(crate) fn helper(&self) -> Result<Option<Box<dyn Helper>>, Failure> {
        self.kind.helper()
    }

    /// Whether the engine has this option.
    pub(crate) fn knows(&self, option: &str) -> bool {
        self.kind.options().iter().any(|own| own.name == option)
    }

    /// Makes the engine. Where it does not say so itself, `Real` is `precision`, and `options` are chosen as
    /// far as it knows them.
    pub(crate) fn contender(
        &self,
        engines: &Engines,
        options: &EngineOptions,
        precision: Precision,
    ) -> Result<Contender, EngineError> {
        let mut chosen = self.engine.options.clone();
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
        assert_eq!(choice.engine.options.get("adapter"), Some("llvm pipe"));
        let choice = Choice::new(" reference ", &engines).unwrap();
        let unheeded = none.with("arithmetic", "strict");
        assert_eq!(choice.contender(&engines, &unheeded, Precision::F64).unwrap().name, "reference");
    }

    #[test]
    fn what_is_no_engine_is_told() {
        let engines = Engines::default();
        for (text, wanted) in [
            ("cup", "unknown engine `cup`; there are cpu[:N], gpu[:N|NAME], "),
            ("cpu@f16", "`f16` is not a precision"),
            ("cpu:0@f32", "engine `cpu:0`: the number of threads must be at least 1"),
        ] {
            let error = Choice::new(text, &engines).unwrap_err().to_string();
            assert!(error.contains(wanted), "{error}");
        }
    }
}
