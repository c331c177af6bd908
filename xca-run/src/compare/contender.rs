//! Engines as the command line names them.

use crate::engines::{Arithmetic, EngineError, EngineName, EngineOptions};
use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;
use std::time::{Duration, Instant};
use xca_core::{Engine, Precision};

/// An engine with what it is given: `reference`, `cpu:2`, `gpu:NVIDIA`, `cpu@f32`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Choice {
    text: String,
    name: EngineName,
    options: EngineOptions,
    precision: Option<Precision>,
}

/// An engine that takes part.
#[derive(Debug)]
pub(crate) struct Contender {
    /// As on the command line.
    pub(crate) name: String,
    pub(crate) engine: Box<dyn Engine>,
    pub(crate) precision: Precision,
    /// What it took to make the engine.
    pub(crate) making: Duration,
}

impl FromStr for Choice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let (engine, precision) = match text.rsplit_once('@') {
            Some((engine, precision)) => {
                (engine, Some(precision.parse::<Precision>().map_err(|error| error.to_string())?))
            }
            None => (text, None),
        };
        let (name, which) = match engine.split_once(':') {
            Some((name, which)) => (name, Some(which)),
            None => (engine, None),
        };
        let name = EngineName::from_str(name, false).map_err(|_| {
            let names: Vec<String> = EngineName::value_variants().iter().map(ToString::to_string).collect();
            format!("there is no engine `{name}`; there are {}", names.join(", "))
        })?;
        let mut options = EngineOptions::default();
        match (name, which) {
            (_, None) => {}
            (EngineName::Gpu, Some(adapter)) => options.adapter = Some(adapter.to_owned()),
            (_, Some(threads)) => options.threads = Some(crate::command::threads(threads)?),
        }
        Ok(Self { text: text.to_owned(), name, options, precision })
    }
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Choice {
    /// Makes the engine. Where it does not say so itself, `Real` is `precision`, and `arithmetic` is that of GPUs.
    pub(crate) fn contender(
        &self,
        precision: Precision,
        arithmetic: Option<Arithmetic>,
    ) -> Result<Contender, EngineError> {
        let mut options = self.options.clone();
        if self.name == EngineName::Gpu {
            options.arithmetic = arithmetic;
        }
        let begin = Instant::now();
        let engine = self.name.engine(&options)?;
        let precision = self.precision.unwrap_or(precision);
        Ok(Contender { name: self.text.clone(), engine, precision, making: begin.elapsed() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn engines_are_named_with_what_they_are_given() {
        let choice: Choice = "cpu:3@f32".parse().unwrap();
        let contender = choice.contender(Precision::F64, None).unwrap();
        assert_eq!((contender.engine.name(), contender.engine.threads()), ("cpu", 3));
        assert_eq!((contender.precision, contender.name.as_str()), (Precision::F32, "cpu:3@f32"));
        let choice: Choice = "gpu:llvm pipe".parse().unwrap();
        assert_eq!(choice.options.adapter.as_deref(), Some("llvm pipe"));
        assert_eq!(" reference ".parse::<Choice>().unwrap().to_string(), "reference");
    }

    #[test]
    fn what_is_no_engine_is_told() {
        for (text, wanted) in [
            ("cup", "there is no engine `cup`; there are cpu, gpu, reference"),
            ("cpu:0", "0 threads do nothing"),
            ("cpu:two", "it must be a whole number"),
            ("cpu@f16", "`f16` is not a precision"),
        ] {
            let error = text.parse::<Choice>().unwrap_err();
            assert!(error.contains(wanted), "{error}");
        }
        let error = "reference:2".parse::<Choice>().unwrap().contender(Precision::F64, None).unwrap_err();
        assert!(error.to_string().contains("serial"), "{error}");
    }
}
