//! The engine of each part of a space, as a word: `cpu`, `cpu:2`, `gpu`, `gpu:NVIDIA`.

use super::cpu::{CpuKind, THREADS};
use super::gpu::{ADAPTER, GpuKind};
use super::kind::EngineKind;
use super::options::EngineOptions;
use xca_core::Engine;
use xca_record::Failure;

/// The kind of engine that a word names, and what is chosen of it.
pub(super) fn parse(word: &str) -> Result<(&'static dyn EngineKind, EngineOptions), String> {
    let (name, detail) = word.split_once(':').map_or((word, None), |(name, rest)| (name, Some(rest)));
    let (kind, option): (&dyn EngineKind, _) = match name {
        "cpu" => (&CpuKind, THREADS),
        "gpu" => (&GpuKind, ADAPTER),
        other => return Err(format!("a part runs on the cpu or the gpu engine, not on `{other}`")),
    };
    detail.map_or(Ok(()), option.check)?;
    let none = EngineOptions::default();
    Ok((kind, detail.into_iter().fold(none, |options, detail| options.with(option.name, detail))))
}

/// The engine of a part. Without a choice, it has so many threads, or its adapter by its number.
pub(super) fn engine(word: &str, number: usize, threads: usize) -> Result<Box<dyn Engine>, Failure> {
    let (kind, chosen) = parse(word)?;
    let own = EngineOptions::default().with(THREADS.name, threads.to_string());
    kind.make(&chosen.or(&own.with(ADAPTER.name, format!("turn {number}"))))
}
