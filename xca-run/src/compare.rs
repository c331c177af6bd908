//! Engines that are compared, as the command line names them, and what is told of it.
//!
//! [`report`] tells a comparison as text, Markdown, CSV, JSON and a page for browsers.

mod contender;
pub(crate) mod report;

pub(crate) use contender::Choice;

#[cfg(test)]
mod tests;
