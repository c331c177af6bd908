//! Comparisons and ensembles as people read them: pages with plots, tables and text.
//!
//! | module | tells |
//! |---|---|
//! | [`comparison`] | a comparison of engines, as text, Markdown, CSV, JSON and a page for browsers |
//! | [`ensemble`] | mean and spread of an ensemble, as a page for browsers |
//! | [`table`] | anything, as a table on a terminal |

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

pub mod comparison;
pub mod ensemble;
#[cfg(test)]
mod planted;
pub mod table;
